"""Boxes where the checkers' conditions are met, or are not, by little: N(e) is nearly 0, Jacobians have no inverse."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial

from certificate_subjects import Content
from forged_boxes import listed, on_grid
from held_mechanisms import Pose
from held_mechanisms import listing as _posed

from pkm_exact.certify import pure

Case = tuple[Callable[[], Content], str]
REJECTED, ACCEPTED = "rejected", "accepted"
Point = tuple[Fraction, Fraction]

# N(e) near 0

K = 12
Joints = Sequence[tuple[tuple[int, int], int]]
ROBOTS: dict[int, tuple[tuple[Point, Point], Joints]] = {
    5: (
        ((Fraction(-11, 8), Fraction(-11, 8)), (Fraction(7, 8), Fraction(-3, 4))),
        (((3, -6), 3), ((-1, 1), -1), ((0, 0), 2)),
    ),
    4: (
        ((Fraction(-3), Fraction(0)), (Fraction(-9, 4), Fraction(15, 4))),
        (((3, 8), 0), ((-6, -9), 3), ((-12, 10), 2)),
    ),
}
"""By the grid of f: f1 and f2; platform joints, and first coordinates of base joints."""


def _leg(x: Sequence[pure.Gaussian], platform: tuple[int, int], first: int) -> pure.Leg:
    """The leg with this platform joint that has its length at a complex pose: two equations for the base joint."""
    full = [pure.NULL] * 8
    for place, value in zip((0, 3, 5, 6), x, strict=True):
        full[place] = value
    quantities = pure.motion(full[:4], full[4:], pure.ORDINARY).quantities()
    b = (Fraction(platform[0]), Fraction(platform[1]), Fraction(0))
    a = Fraction(first)

    def made(second: Fraction, rest: Fraction) -> pure.Leg:
        return pure.Leg((a, second, Fraction(0)), b, a * a + second * second - rest)

    def value(second: int, rest: int) -> pure.Gaussian:
        form = pure.leg_form(made(Fraction(second), Fraction(rest)), pure.ORDINARY)
        return pure.total(Fraction(c, form[16]) * v for c, v in zip(form, quantities, strict=True))

    start = value(0, 0)
    along, up = value(1, 0) - start, value(0, 1) - start
    det = along.re * up.im - along.im * up.re
    second = (start.im * up.re - start.re * up.im) / det
    return made(second, (along.im * start.re - along.re * start.im) / det)


def _nearly_isotropic(part: int, grid: int) -> Content:
    """A complex solution with e0 + e3 = 1 where N(e) is about 2^-7: the bound of its change is near to that."""
    shift, joints = ROBOTS[grid]
    half = 1 << K - 1
    e = [(Fraction(half + 8, 1 << K), Fraction(half + part, 1 << K))]
    e.append((1 - e[0][0], -e[0][1]))
    x = [pure.Gaussian(*parts) for parts in (*e, *shift)]
    legs = [_leg(x, *joint) for joint in joints]
    zero = (Fraction(0), Fraction(0))
    content = listed((1, 0, 0, 1), on_grid((e[0], zero, zero, e[1], zero, *shift, zero), K, grid))
    return _robot(content, legs)


def _robot(content: Content, legs: Sequence[pure.Leg]) -> Content:
    """Another planar robot."""
    joints = {
        "base": [list(map(str, leg.base)) for leg in legs],
        "platform": [list(map(str, leg.platform)) for leg in legs],
    }
    robot = {**content["robot"], "metric": ["1", "1", "1"], **joints}
    lengths = {"name": None, "lengths_squared": [str(leg.length_squared) for leg in legs]}
    return {**content, "robot": robot, "configuration": lengths}


def _without_inverse() -> Content:
    """All legs are upright where f = 0 and e3 = 0, with lengths of no solution: no equation changes with f1 there."""
    joints = (((0, 1), (0, 0)), ((1, 3), (1, 0)), ((2, -1), (2, 5)))
    points = [tuple((Fraction(x), Fraction(y), Fraction(0)) for x, y in pair) for pair in joints]
    legs = [pure.Leg(a, b, Fraction(2)) for b, a in points]
    zero = (Fraction(0), Fraction(0))
    return _robot(listed((1, 0, 0, 0), on_grid(((Fraction(1), Fraction(1, 2)), *[zero] * 7), K, K)), legs)


FAR = ((-1, -2), (3, 1)), ((3, 2), (0, -2)), ((1, 1), (3, -3))
"""Base and platform joints: coarsely rounded, the Jacobian at ``_far_off`` is singular."""


def _far_off(units: Fraction) -> Content:
    """A real solution with coordinates of 900 bits, e0 + e3 being 1, so many units of the grid beside its centre.

    Matrices of fewer bits have no inverse there, and Newton's method does not leave the centre.
    """
    large, unit = Fraction(1 << 900), Fraction(1, 1 << 7)
    e, f = (large, 1 - large), -large + units * unit
    pose = Pose((e[0], 0, 0, e[1]), (0, f, f, 0))
    legs = [pose.distance((*a, 0), (*b, 0)) for a, b in FAR]
    zero = (Fraction(0), Fraction(0))
    centre = ((e[0], zero[0]), zero, zero, (e[1], zero[0]), zero, *[(-large, zero[0])] * 2, zero)
    content = listed((1, 0, 0, 1))
    boxes = {**content["krawczyk"], "real": [on_grid(centre, 7, 7, real=True)]}
    poses = [{**_posed("planar", [pose], legs)["poses"][0], "parameter": None, "multiplicity": 1}]
    counts = dict.fromkeys(("complex_solutions", "distinct_solutions", "real_poses"), 1)
    content = {**content, **counts, "krawczyk": boxes, "poses": poses, "box_exponent": 31}
    return _robot(content, [pure.Leg(leg.base, leg.platform, leg.length_squared) for leg in legs])


ISOTROPIC: dict[str, Case] = {
    **{
        f"coordinates of 900 bits, {units} units from the centre": (partial(_far_off, units), status)
        for units, status in ((Fraction(2, 5), ACCEPTED), (Fraction(3, 5), REJECTED))
    },
    **{
        f"N(e) is at the border of what is proved, {part}": (partial(_nearly_isotropic, part, grid), status)
        for part, grid, status in ((3, 4, REJECTED), (4, 5, REJECTED), (5, 5, ACCEPTED))
    },
    "a box where the Jacobian has no inverse": (_without_inverse, REJECTED),
}
