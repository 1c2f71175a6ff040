"""Certificates whose last steps leave less modulo one prime, or modulo 7, than over Q; legs of other lengths.

Translations of a point in a plane, two unknowns of the section; what is missing has a coordinate with the prime below.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

from certificate_tools import golden
from forged_representations import fit_real_poses, representation_through, set_representation
from handmade_systems import complete
from held_mechanisms import Pose, listing

from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.linear import LinearForm
from pkm_exact.constraints.point_in_plane import InPlane

Content = dict[str, Any]
Case = tuple[Callable[[], Content], str]
REJECTED, ACCEPTED = "rejected", "accepted"
PRIME = (1 << 63) - 25
ZERO, ONE = Fraction(0), Fraction(1)
ORIGIN = (ZERO, ZERO, ZERO)
PLANE = InPlane((ZERO, ZERO, ONE), ZERO, ORIGIN)
ALL = [f"{element}{factors}" for element in (0, 1) for factors in ("", " 0", " 1", " 0 0", " 0 1", " 1 1")]


def _claimed(
    places: Sequence[tuple[Fraction | int, Fraction | int]],
    constraints: Sequence[Constraint],
    steps: Sequence[Sequence[str]],
    metric: tuple[int, int, int] = (1, 1, 1),
) -> Content:
    """Places (x, y) of the platform, said to be all."""
    poses = [Pose((1, 0, 0, 0), (0, metric[0] * x, metric[1] * y, 0), metric) for x, y in places]
    content = listing("translation", poses, constraints, form=(0, 0, 0, 0, 0, 1, 3, 0))
    return content | complete("exact-elimination", len(places), elimination=[list(step) for step in steps])


def _circle_and_lines(
    prime: int, places: Sequence[tuple[Fraction | int, Fraction | int]], steps: Sequence[Sequence[str]] = (ALL,)
) -> Content:
    """A circle x^2 + (p - 1) y^2 - (p + 1) x + 1 = 0, and x + (p - 1) y = 1 or p, on a cylinder.

    Modulo p both lines have the direction of a point of the circle at infinity: one of their two points is there.
    """
    half = Fraction(prime + 1, 2)
    circle = Distance((half, ZERO, ZERO), ORIGIN, half**2 - 1)
    square = half**2 - 1 - (1 - half) ** 2 / (prime + 1)
    lines = AxisDistance((half, ZERO, ZERO), (ONE, ONE, ONE), ORIGIN, square)
    return _claimed(places, [PLANE, circle, lines], steps, (1, prime - 1, 1))


def _on_circle(prime: int) -> list[tuple[Fraction | int, Fraction | int]]:
    """All four, those first that are finite modulo the prime."""
    p = Fraction(prime)
    return [(p, -1), (1, 1), (1 / p, 1 / p), (p + (p - 1) / p, -1 / p)]


def _product(
    prime: int, places: Sequence[tuple[Fraction | int, Fraction | int]], step: Sequence[str] = ("0", "1")
) -> Content:
    """(p x - 1) (x - 1) = 0 and y^2 = 1; the unknowns are y and s = x^2 + y^2, the first coefficient for s^2 is p^2."""
    form = [ZERO] * 17
    form[0], form[4], form[16] = Fraction(prime), Fraction(-prime - 1), Fraction(1 - prime)
    lines = AxisDistance(ORIGIN, (ONE, ZERO, ZERO), ORIGIN, ONE)
    return _claimed(places, [PLANE, LinearForm(tuple(form)), lines], [step])


def _places(prime: int) -> list[tuple[Fraction | int, Fraction | int]]:
    """All four, those first that are finite modulo the prime."""
    return [(1, 1), (1, -1), (Fraction(1, prime), 1), (Fraction(1, prime), -1)]


def _one_of_six() -> Content:
    """The pose at home of a planar robot that has more, by the products of its section with one unknown."""
    base = tuple((Fraction(x), Fraction(y), ZERO) for x, y in ((0, 0), (5, 0), (1, 4)))
    platform = tuple((Fraction(x), Fraction(y), ZERO) for x, y in ((1, 1), (3, 1), (2, 3)))
    squares = [sum((a - b) ** 2 for a, b in zip(*joints, strict=True)) for joints in zip(base, platform, strict=True)]
    content = golden("3-rpr-merlet-p")
    content["robot"] |= {"base": _texts(base), "platform": _texts(platform)}
    content["configuration"] |= {"lengths_squared": list(map(str, squares))}
    set_representation(content, representation_through([ZERO], [((ONE, ZERO, ZERO, ZERO), (ZERO,) * 4)]), [0] * 8)
    content["representation"] |= {"chart": [1, 0, 0, 0]}
    fit_real_poses(content, 1)
    steps = [[f"{element}{factor}" for element in range(18) for factor in ("", " 0", " 1", " 2", " 3", " 4", " 5")]]
    return content | {"distinct_solutions": 1} | complete("exact-elimination", 1, elimination=steps)


def _texts(points: Sequence[Sequence[Fraction]]) -> list[list[str]]:
    return [[str(x) for x in point] for point in points]


LAST_STEPS: dict[str, Case] = {
    "a circle and lines, two of four": (lambda: _circle_and_lines(PRIME, _on_circle(PRIME)[:2]), REJECTED),
    "a circle and lines, all four": (lambda: _circle_and_lines(PRIME, _on_circle(PRIME)), ACCEPTED),
    "a circle and lines, another prime": (partial(_circle_and_lines, 7, _on_circle(7)), ACCEPTED),
    "a circle and lines, an element that there is not": (
        lambda: _circle_and_lines(7, _on_circle(7), [["0 0", "0 1", "1 0", "1 1"], ["3"]]),
        REJECTED,
    ),
    "a circle and lines, the last element": (
        lambda: _circle_and_lines(7, _on_circle(7), [["0 0", "0 1", "1 0", "1 1"], ["2"]]),
        ACCEPTED,
    ),
    "one of six poses": (_one_of_six, REJECTED),
    "a first coefficient that is 0, two of four": (lambda: _product(PRIME, _places(PRIME)[:2]), REJECTED),
    "a first coefficient that is 0, two of four by one product": (
        lambda: _product(PRIME, _places(PRIME)[:2], ["1"]),
        REJECTED,
    ),
    "a first coefficient that is 0, all four": (lambda: _product(PRIME, _places(PRIME)), ACCEPTED),
    "a first coefficient of 49": (partial(_product, 7, _places(7)), ACCEPTED),
}


def _longer(*legs: int) -> Content:
    """Some legs have a greater length than at the poses, each by the same square."""
    content = golden("mourrain-l")
    squares = content["configuration"]["lengths_squared"]
    longer = [str(Fraction(square) + (leg in legs)) for leg, square in enumerate(squares)]
    return content | {"configuration": {"name": None, "lengths_squared": longer}}


LENGTHS: dict[str, Case] = {
    "the first leg": (lambda: _longer(0), REJECTED),
    "the second leg": (lambda: _longer(1), REJECTED),
    "the last leg": (lambda: _longer(5), REJECTED),
    "all legs": (lambda: _longer(*range(6)), REJECTED),
}
"""Which legs are longer; where all are, forms without |C|^2 do not tell."""
