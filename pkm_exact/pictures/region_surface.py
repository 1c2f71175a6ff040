"""The surface of the parts inside of a map of three variables: faces between them and what is not proved to be good."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Final

from pkm_exact.regions.paving import INSIDE, SPLIT, Part, depths_at, leaves
from pkm_exact.regions.region_components import touching

if TYPE_CHECKING:
    from pkm_exact.regions.region_solver import RegionAnswer

Ends = tuple[tuple[Fraction, Fraction], ...]
Face = tuple[int, bool, Ends]
"""Across which variable, whether towards greater values, and its box: of no width along that variable."""

MOST_FACES: Final = 60_000


def part_ends(answer: RegionAnswer, part: Part) -> Ends:
    """The part's sides as shares of those of the box."""
    depths = depths_at(answer.axes, part.depth, len(part.places))
    return tuple(
        (Fraction(place, 1 << depth), Fraction(place + 1, 1 << depth))
        for place, depth in zip(part.places, depths, strict=True)
    )


def surface(answer: RegionAnswer) -> list[Face]:
    """The faces of the parts inside, on the boundary of the region or next to parts that are not inside.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> text = "[region]\\nposition = [[-1, 1], [-1, 1], [9, 11]]\\nrpy_degrees = [0, 0, 0]\\n"
    >>> text += "[conditions]\\nreachable = true\\n[answer]\\nkind = 'map'\\nsteps = 3"
    >>> len(surface(Robot.load("models/mssm.toml").region(text)))
    6
    """
    places = [k for k, letter in enumerate(answer.word) if letter != SPLIT]
    parts = leaves(answer.word, answer.axes, len(answer.question.chart.variables))
    boxes = {
        place: (letter == INSIDE, part_ends(answer, part)) for place, (letter, part) in zip(places, parts, strict=True)
    }
    found: list[Face] = []
    for is_inside, ends in boxes.values():
        if is_inside:
            found += [(k, side, _flat(ends, k, end)) for k, side, end in _outer(ends)]
    for one, other in touching(answer.word, answer.axes):
        (first, ends), (second, others) = boxes[one], boxes[other]
        if first is not second:
            found.append(_between(ends, others) if first else _between(others, ends))
    return found


def _outer(ends: Ends) -> list[tuple[int, bool, Fraction]]:
    """The sides of a part that lie on the boundary of the box."""
    sides = ((k, side, pair[side]) for k, pair in enumerate(ends) for side in (False, True))
    return [(k, side, end) for k, side, end in sides if end == int(side)]


def _flat(ends: Ends, axis: int, at: Fraction) -> Ends:
    return tuple((at, at) if k == axis else pair for k, pair in enumerate(ends))


def _between(inside: Ends, other: Ends) -> Face:
    """What two parts that share a face have in common, seen from the first."""
    common = tuple((max(a, c), min(b, d)) for (a, b), (c, d) in zip(inside, other, strict=True))
    axis = next(k for k, (low, high) in enumerate(common) if low == high)
    return axis, common[axis][0] == inside[axis][1], common
