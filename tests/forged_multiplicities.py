"""Certificates with a multiplicity that is too large, consistent in all else: digest, counts, poses and elimination.

A pose is made double by an elimination that uses, of the polynomials f that vanish at all poses, only those whose
derivative D f along some direction is 0 at this pose. They leave at least one monomial more than there are. The
quadrics from which every elimination begins are elements too; the direction must be such that those with D f not 0 have
leading monomials off the border of what is left: no matrix of multiplication is read off them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations_with_replacement
from math import prod
from typing import Any, TypeAlias

from pkm_exact import Robot, certificate, solve
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.checker.document import Document, read
from pkm_exact.certify.checker.elimination import Polynomial, eliminate
from pkm_exact.certify.checker.section import ORDER, unknowns

Content: TypeAlias = dict[str, Any]
Row: TypeAlias = tuple[int, tuple[int, ...]]
Vector: TypeAlias = tuple[int, int, int]
Pose: TypeAlias = tuple[Sequence[Vector], Vector]
"""The rows of a rotation, and a position."""


def honest(kind: str, base: Sequence[Vector], platform: Sequence[Vector], pose: Pose) -> Content:
    """The certificate of the robot whose legs have the lengths that a pose gives them."""
    joints = [[tuple(Fraction(x) for x in joint) for joint in side] for side in (base, platform)]
    rotation, position = pose
    ends = [[c + _dot(row, joint) for c, row in zip(position, rotation, strict=True)] for joint in platform]
    squares = [
        Fraction(sum((x - y) ** 2 for x, y in zip(a, end, strict=True))) for a, end in zip(base, ends, strict=True)
    ]
    robot = Robot("made up", kind, "m", "made up", tuple(joints[0]), tuple(joints[1]))  # type: ignore[arg-type]
    content = certificate(robot, None, solve(robot.problem(squares)))
    assert content["completeness_route"] == "exact-elimination"
    return content


def forged(
    content: Content, pose: Pose, direction: Mapping[str, Fraction], degree: int, multiplicities: Sequence[int]
) -> Content:
    """The certificate with other multiplicities, by products up to a degree that see no change along the direction.

    The direction is given by those of the coordinates ``section.ORDER`` that are not 0. The robot's metric must be 1.
    """
    document = read(canonical_bytes(sealed(content)))
    steps = _steps(document, pose, direction, degree)
    left = len(eliminate(document.legs, document.metric, steps).elimination.standard(40))
    assert left > content["complex_solutions"]
    elimination = [[" ".join(map(str, (index, *factors))) for index, factors in step] for step in steps]
    poses = [{**p, "multiplicity": m} for p, m in zip(content["poses"], multiplicities, strict=True)]
    return {**content, "complex_solutions": left, "elimination": elimination, "poses": poses}


def _dot(one: Sequence[Any], other: Sequence[Any]) -> Any:
    return sum(x * y for x, y in zip(one, other, strict=True))


def _coordinates(pose: Pose) -> list[int]:
    """(u, C, s, R) at a pose, see ``section.ORDER``."""
    rotation, position = pose
    turned = [_dot(column, position) for column in zip(*rotation, strict=True)]
    return [*turned, *position, _dot(position, position), *(entry for row in rotation for entry in row)]


def _slope(polynomial: Polynomial, point: Sequence[int], direction: Sequence[Fraction]) -> Fraction:
    """The derivative along the direction."""
    return sum(
        (
            value * slope * m[i] * prod(x ** (e - (j == i)) for j, (x, e) in enumerate(zip(point, m, strict=True)))
            for m, value in polynomial.items()
            for i, slope in enumerate(direction)
            if m[i] and slope
        ),
        Fraction(0),
    )


def _steps(document: Document, pose: Pose, direction: Mapping[str, Fraction], degree: int) -> list[list[Row]]:
    """All products whose derivative vanishes at the pose, again and again, until nothing new is found."""
    places = unknowns(document.legs, document.metric)
    point = [_coordinates(pose)[place] for place in places]
    along = [direction.get(ORDER[place], Fraction(0)) for place in places]
    steps: list[list[Row]] = []
    number = 0
    while True:
        elements = eliminate(document.legs, document.metric, steps).elimination.elements
        if len(elements) == number:
            return steps[:-1]
        number = len(elements)
        step = []
        for index, element in enumerate(elements):
            slope = _slope(element, point, along)
            products = _factors(len(point), degree - max(map(sum, element)))
            step += [(index, factors) for factors in products if not slope or not prod(point[i] for i in factors)]
        steps.append(step)


def _factors(size: int, degree: int) -> Iterator[tuple[int, ...]]:
    for count in range(degree + 1):
        yield from combinations_with_replacement(range(size), count)
