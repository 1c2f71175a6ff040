"""Certificates built on primes of the checkers: what is alike modulo the first one, or modulo all, and not over Q."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cache
from math import prod
from typing import Any

from flint import fmpq_poly, fmpz_poly
from forged_completions import called_complete
from forged_representations import fit_real_poses, representation_through, set_representation
from mirrored_robots import mirrored, problem_at_home

from pkm_exact import Robot, certificate, solve
from pkm_exact.certify.checker.solutions import PRIMES as FIRST
from pkm_exact.certify.checker.solutions import primes_for

Content = dict[str, Any]
ROOT = fmpq_poly([0, 1])


@cache
def _both_counted_twice() -> Content:
    """Two legs end in the platform's origin, at (1, 2) or (1, -2); the two poses at the first place count for two each.

    tan(angle / 2) is sqrt(2) or -sqrt(2) there. The determinant of the legs has as factors the distance of the first
    base joints, and that of the third one from there: primes, of which none proves the poses simple.
    """
    h = fmpz_poly([-2, 0, 1])
    primes = [*primes_for(h)]
    distance, reach = prod(primes[::2]), prod(primes[1::2])
    zero, one, two = map(Fraction, range(3))
    base = ((zero, zero, zero), (Fraction(distance), zero, zero), (one + reach, two, zero))
    platform = ((zero, zero, zero), (zero, zero, zero), (one, zero, zero))
    squares = [Fraction(5), Fraction((distance - 1) ** 2 + 4), reach**2 + 1 + Fraction(2 * reach, 3)]
    robot = Robot("made up", "3-RPR", "m", "made up", base, platform)
    whole = certificate(robot, None, solve(robot.problem(squares)))
    content, zeros = {**whole}, fmpq_poly()
    slope, point = fmpq_poly([0, 2]), [fmpq_poly([1]), zeros, zeros, ROOT, zeros, 1 + 2 * ROOT, 2 - ROOT, zeros]
    set_representation(content, [fmpq_poly(h), *(x * slope % fmpq_poly(h) for x in point)], (0, 0, 0, 1, 0, 0, 0, 0))
    fit_real_poses(content, None)
    doubled = [pose | {"multiplicity": 2} for pose in content["poses"]]
    return called_complete(content, whole["elimination"], 4, []) | {"poses": doubled}


# Multiple poses that the algebra tells: modulo the first prime something has no image, or is alike


P = FIRST[0]
"""The prime that is tried first."""
ROOT_OF_42 = pow(42, (P + 1) // 4, P)
"""With this scale the coordinates of both poses have the same sum, modulo P, in which they are combined first."""


@cache
def _mirrored(scale: int) -> Content:
    """A fourfold pose, C = 0 and R = 1, and a double one after a half turn, C = (0, 2 scale)."""
    robot = mirrored(scale, 2 * scale, scale)
    assert robot is not None
    return certificate(robot, None, solve(problem_at_home(robot)))


TURN = Fraction(P - 1, 3)
"""tan(angle / 2) of poses for which e = (1, 0, 0, TURN) / P in the chart e0 + 3 e3 = 1."""
Point = tuple[Fraction, Fraction]


def _turned(x: Fraction, y: Fraction) -> Point:
    t = TURN
    return ((1 - t * t) * x - 2 * t * y) / (1 + t * t), (2 * t * x + (1 - t * t) * y) / (1 + t * t)


def _pose(place: Point, half_tangent: Fraction) -> list[Fraction]:
    """(e, f) in that chart."""
    (x, y), t, zero = place, half_tangent, Fraction(0)
    return [value / (1 + 3 * t) for value in (Fraction(1), zero, zero, t, zero, x + t * y, y - t * x, zero)]


def _showing(
    base: Sequence[Point], platform: Sequence[Point], squares: Sequence[Fraction], poses: Sequence[Any], form: Any
) -> Content:
    """The certificate of a planar robot, with poses (e, f), multiplicities and a separating form of one's own."""
    joints = [tuple((x, y, Fraction(0)) for x, y in side) for side in (base, platform)]
    robot = Robot("made up", "3-RPR", "m", "made up", joints[0], joints[1])
    content = certificate(robot, None, solve(robot.problem(squares)))
    parameters = [sum((c * value for c, value in zip(form, pose, strict=True)), Fraction(0)) for pose, _ in poses]
    shown = {**content}
    set_representation(shown, representation_through(parameters, [(pose[:4], pose[4:]) for pose, _ in poses]), form)
    shown["representation"]["chart"] = [1, 0, 0, 3]
    fit_real_poses(shown, None)
    for pose in shown["poses"]:
        low, high = map(Fraction, pose["parameter"])
        pose["multiplicity"] = next(m for t, (_, m) in zip(parameters, poses, strict=True) if low <= t <= high)
    kept = ("claim", "completeness_route", "elimination", "complex_solutions")
    return shown | {key: content[key] for key in kept}


def _stretched() -> Content:
    """A fourfold pose alone, at C = 0: all legs are stretched. Its parameter is 1 / P."""
    zero, three = Fraction(0), Fraction(3)
    base = [(zero + 4, three), (zero - 4, -three), _turned(three + 1, zero)]
    platform = [(zero, zero), (zero, zero), (zero + 1, zero)]
    squares = [Fraction(25), Fraction(25), Fraction(9)]
    return _showing(base, platform, squares, [(_pose((zero, zero), TURN), 4)], (1, *[0] * 7))


def _mirrored_and_turned() -> Content:
    """That of scale 1 at (1, 3), its base turned: e of the fourfold pose has the denominator P, no parameter has it."""
    robot = mirrored(1, 2, 1)
    assert robot is not None
    squares = [leg.length_squared for leg in problem_at_home(robot).distances]
    (x, y), other = (Fraction(1), Fraction(3)), _turned(Fraction(0), Fraction(2))
    base = [(x + a, y + b) for a, b in (_turned(*joint[:2]) for joint in robot.base_joints)]
    poses = [(_pose((x, y), TURN), 4), (_pose((x + other[0], y + other[1]), -1 / TURN), 2)]
    return _showing(base, [joint[:2] for joint in robot.platform_joints], squares, poses, (0, 0, 0, 0, 0, 1, 0, 0))


Case = tuple[Callable[[], Content], str, str]
SIMPLE = "elimination: it leaves 4 monomials, but the 2 solutions are proved simple"
"""Over Q: the second checker says that they are not proved to fill what is left."""
PRIMES: dict[str, Case] = {
    "two poses that no prime proves simple count for two each": (_both_counted_twice, "rejected", SIMPLE),
    "a norm that is 0 modulo the first prime": (_mirrored_and_turned, "accepted", ""),
    "a parameter that the first prime divides": (_stretched, "accepted", ""),
    "matrices that have no image modulo the first prime": (lambda: _mirrored(P), "accepted", ""),
    "values of two poses that are alike modulo the first prime": (lambda: _mirrored(ROOT_OF_42), "accepted", ""),
}
