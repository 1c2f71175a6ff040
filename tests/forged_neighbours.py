"""Certificates of version 1 and of tolerances with poses, boxes or legs that nearly agree, and wrong in one entry."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from math import isqrt

from certificate_subjects import Content, subject
from flint import fmpz_poly
from forged_representations import fit_real_poses, turning
from forgeries import OPEN, as_witnesses, on_circle, point_near
from held_mechanisms import PLACED, Numbers, Pose, listing

Case = tuple[Callable[[], Content], str]
REJECTED, ACCEPTED = "rejected", "accepted"
Point = tuple[Fraction, Fraction]


# Poses on a circle, close to each other


def _circle(*places: Point, form: Sequence[int] = (0, 1, 0), exponent: int = 31) -> Content:
    return on_circle(places, form, exponent, Fraction(1))


def _near(x: Fraction, bits: int = 80) -> Point:
    return point_near(x, bits)


EXACT: Point = (Fraction(3, 5), Fraction(4, 5))
"""At the parameter 3, a point of the finest grid of parameters, if the form is 5 C1."""
STEP = Fraction(1, 1 << 40)
FIVE = (0, 5, 0)
CLOSE: dict[str, Case] = {
    **{
        f"parameters at 3 and {side} of it, {place}": (
            lambda points=points: _circle(*points, form=FIVE, exponent=60),  # type: ignore[misc]
            ACCEPTED,
        )
        for side, sign in (("right", 1), ("left", -1))
        for place, points in (
            ("alone", (EXACT, _near(EXACT[0] + sign * STEP))),
            ("before another", (EXACT, _near(EXACT[0] + sign * STEP), _near(Fraction(9, 10)))),
            ("after another", (EXACT, _near(EXACT[0] + sign * STEP), _near(Fraction(1, 10)))),
        )
    },
    "parameters that differ by 2^-40": (
        lambda: _circle(_near(Fraction(1, 3)), _near(Fraction(1, 3) + STEP), exponent=60),
        ACCEPTED,
    ),
    "two poses in one box": (lambda: _circle(_near(Fraction(1, 3)), _near(Fraction(1, 3) + STEP)), REJECTED),
    "boxes that touch, one coordinate grows and one falls": (
        lambda: _circle(_near(Fraction(65, 100)), _near(Fraction(76, 100)), exponent=2),
        REJECTED,
    ),
    "boxes that touch in one coordinate, the other falls farther": (
        lambda: _circle(_near(Fraction(87, 100)), _near(Fraction(99, 100)), exponent=3),
        ACCEPTED,
    ),
    "boxes that touch in one coordinate, the other agrees": (
        lambda: _circle(_near(Fraction(10, 100)), _near(Fraction(30, 100)), exponent=2),
        REJECTED,
    ),
}


def _turned(h: fmpz_poly) -> Content:
    """A platform on an axis, turned by the angles whose half tangents are the roots of h."""
    content = turning(h, 60)
    fit_real_poses(content, None)
    return content


def _crowded() -> fmpz_poly:
    """Six roots around 4/3, 2^-11 / 3 away and more: the values between them are less than what they are rounded by."""
    x = fmpz_poly([-4, 3])
    u = x * (1 << 11)
    return x * (u**2 - 1) * (u**2 + 1) * (u**2 + 2)


def _steep() -> fmpz_poly:
    """T^6 less all that keeps a bound of its roots, by powers of 2, at 32; the largest is 18."""
    return fmpz_poly([*(-(isqrt(2 ** (7 * i)) - 1) for i in range(6, 1, -1)), 0, 1])


ROOTS: dict[str, Case] = {
    "a root amid six others, where values are rounded by more than they are": (lambda: _turned(_crowded()), ACCEPTED),
    "roots on both sides of 1, where the slope is 0 and an interval ends": (
        lambda: _turned((1 << 40) * fmpz_poly([-1, 1]) ** 2 - 1),
        ACCEPTED,
    ),
    "a root above half of its bound": (lambda: _turned(_steep()), ACCEPTED),
    "a root 2^-40 beside 2^-40 + 2^-50": (
        lambda: _turned(fmpz_poly([-1, 1 << 40]) * fmpz_poly([-1025, 1 << 50]) * fmpz_poly([-2, 0, 1])),
        ACCEPTED,
    ),
    "a root -2^-32 / 3 beside 0, in whose closed cell of the grid 2^-32 that is": (
        lambda: _turned(fmpz_poly([0, 1]) * fmpz_poly([1, 3 << 32]) * fmpz_poly([-2, 0, 1])),
        ACCEPTED,
    ),
    "roots 1 and 3, where halving meets values that fall and that rise": (
        lambda: _turned(fmpz_poly([3, -4, 1])),
        ACCEPTED,
    ),
    "roots 0, 1 and -1": (lambda: _turned(fmpz_poly([0, -1, 0, 1])), ACCEPTED),
    "roots where the slope is 0 between them": (lambda: _turned(fmpz_poly([1, -3, 0, 1])), ACCEPTED),
}


# Boxes in another order


def _swapped(name: str, *paths: str) -> Content:
    content = {**subject(name)}
    for path in paths:
        *outer, last = path.split(".")
        part = content
        for key in outer:
            part[key] = {**part[key]}
            part = part[key]
        first, second, *others = part[last]
        part[last] = [second, first, *others]
    return content


def _nothing_but_a_pose() -> Content:
    pose = {**subject("planar, boxes")["poses"][0], "multiplicity": None}
    return {**subject("nothing known"), "poses": [pose], "real_poses": 1, "box_exponent": 31}


LISTED: dict[str, Case] = {
    "real boxes and poses in the other order": (
        lambda: _swapped("planar, boxes", "krawczyk.real", "poses"),
        REJECTED,
    ),
    "real boxes in the other order": (lambda: _swapped("planar, boxes", "krawczyk.real"), REJECTED),
    "a pose where nothing is listed": (_nothing_but_a_pose, REJECTED),
    "pairs of a tolerance certificate in the other order": (
        lambda: _swapped("tolerance, spatial, complete", "pairs"),
        REJECTED,
    ),
    "boxes of a tolerance certificate in the other order": (
        lambda: _swapped("tolerance, planar, complete", "boxes"),
        REJECTED,
    ),
    **{
        f"version {version!r} of {name}": (
            lambda name=name, version=version: {**subject(name), "version": version},  # type: ignore[misc]
            "malformed",
        )
        for name in ("planar, boxes", "tolerance, planar, complete", "kept-2, planar lines")
        for version in (True, "1", 0, 3, None)
    },
}


# Tolerances


def _tolerant(key: str, place: int, change: Callable[[Content, int], int]) -> Content:
    """An entry of the first box, changed as the box says."""
    content = subject("tolerance, planar, complete")
    first, *others = content["boxes"]
    values = list(first[key])
    values[place] = hex(change(first, place))
    return {**content, "boxes": [{**first, key: values}, *others]}


def _beyond(box: Content, place: int) -> int:
    return int(box["outer"][place], 16) + 1


def _open(boxes: Sequence[int], unproved: Sequence[int]) -> Content:
    content = subject("tolerance-open, planar")
    return {**content, "boxes": [content["boxes"][k] for k in boxes], "unproved": list(unproved)}


def _longest(key: str, factor: Fraction) -> Content:
    content = subject("tolerance, planar, complete")
    first, *others = content["boxes"]
    return {**content, "boxes": [{**first, key: str(Fraction(first[key]) * factor)}, *others]}


TOLERANCES: dict[str, Case] = {
    **{
        f"the inner box is larger in coordinate {place}": (partial(_tolerant, "inner", place, _beyond), REJECTED)
        for place in range(4)
    },
    **{
        f"the outer box is smaller than the core in coordinate {place}": (
            partial(_tolerant, "outer", place, lambda _, __: 1),
            REJECTED,
        )
        for place in range(4)
    },
    **{
        f"the {key} is half of that claimed": (partial(_longest, key, Fraction(1, 2)), REJECTED)
        for key in ("position_error", "rotation_error")
    },
    "numbers without a box in another order": (lambda: _open((0, 1, 2, 3), (4, 2)), REJECTED),
    "a number without a box twice": (lambda: _open((0, 1, 2, 3), (2, 4, 4)), REJECTED),
    "a box that is among those without one": (lambda: _open((0, 1, 2, 3), (1, 2, 4)), REJECTED),
}


# Legs of which one differs

ANY: list[Numbers] = [(7, 1, 2), (-3, 5, 1), (-6, -2, 3), (1, -7, -2), (2, 6, -4), (5, -3, 6)]


def witness_of(pose: Pose, base: Sequence[Numbers], platform: Sequence[Numbers]) -> Content:
    """Witnesses of a motion of a robot of version 1: one pose."""
    legs = [pose.distance(a, b) for a, b in zip(base, platform, strict=True)]
    planar = len(legs) == 3
    second = listing("planar" if planar else "spatial", [pose], legs, None)
    content = {**subject("planar, multiple solutions" if planar else "not proven complete"), **OPEN}
    joints = {
        "base": [list(map(str, leg.base)) for leg in legs],
        "platform": [list(map(str, leg.platform)) for leg in legs],
    }
    content["robot"] = {**content["robot"], "metric": [str(g) for g in pose.metric], **joints}
    content["configuration"] = {"name": None, "lengths_squared": [str(leg.length_squared) for leg in legs]}
    content["elimination"] = None
    return as_witnesses({**content, "representation": second["representation"]})


IDENTITY = Pose((1, 0, 0, 0), (0, 0, 0, 0))
D = (1, 2, 3)


def _equal(place: int, k: int) -> Content:
    """All legs are the same vector, but for one, of the same length."""
    vectors = [[-x if n == place and j == k else x for j, x in enumerate(D)] for n in range(6)]
    base = [[b - d for b, d in zip(joint, vector, strict=True)] for joint, vector in zip(ANY, vectors, strict=True)]
    return witness_of(IDENTITY, base, ANY)


TURNED = {
    "C1 is 0": Pose((2, 0, 0, 1), (0, 4, 3, 0)),
    "a general pose": Pose((2, 0, 0, 1), (0, 3, 4, 0)),
}


def _almost_dependent(column: str) -> tuple[Pose, list[Numbers], list[Numbers]]:
    """Three planar legs whose forms are dependent but for one column, of C1, C2, u1 or u2, which is 0 at the pose.

    Joints lie on lines; A goes as B but for the second leg, or the other way round.
    """
    e = (2, 0, 0, 1)
    along = (0, 1, 1), (0, 2, 4)
    if column in ("u1", "u2"):
        along = (0, 1, 2), (0, 2, 2)
    axis = 0 if column in ("C1", "u1") else 1
    base = [tuple(x if k == axis else 0 for k in range(3)) for x in along[0]]
    platform = [tuple(x if k == axis else 0 for k in range(3)) for x in along[1]]
    for f in ((0, 1, 2, 0), (0, 2, -1, 0), (0, 2, 1, 0), (0, 1, -2, 0)):
        pose = Pose(e, f)
        position, _, turned = pose.quantities()
        if (position if column[0] == "C" else turned)[axis] == 0:
            return pose, base, platform  # type: ignore[return-value]
    raise AssertionError(column)


LEGS: dict[str, Case] = {
    "all legs are the same vector": (lambda: _equal(7, 0), ACCEPTED),
    **{
        f"leg {place + 1} differs in coordinate {k + 1}": (partial(_equal, place, k), REJECTED)
        for place in (0, 1, 5)
        for k in range(3)
    },
    **{
        f"three planar legs that are dependent but for {column}": (
            lambda column=column: witness_of(*_almost_dependent(column)),  # type: ignore[misc]
            REJECTED,
        )
        for column in ("C1", "C2", "u1", "u2")
    },
    "two of three planar legs are one": (
        lambda: witness_of(
            TURNED["a general pose"], [(1, 2, 0), (1, 2, 0), (5, -3, 0)], [(3, 1, 0), (3, 1, 0), (-2, 4, 0)]
        ),
        ACCEPTED,
    ),
    "two of six legs are one": (lambda: witness_of(PLACED, [*ANY[:5], ANY[0]], [*ANY[1:], ANY[1]]), ACCEPTED),
    "six legs": (lambda: witness_of(PLACED, ANY, [*ANY[1:], ANY[0]]), REJECTED),
}

NEIGHBOURS: dict[str, Case] = {**CLOSE, **ROOTS, **LISTED, **TOLERANCES, **LEGS}
