"""Boxes of solutions beside each other: which ones meet, and in which order they are listed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from pkm_exact.poses.isolated_solutions import RADIUS, Box


def meeting(boxes: Sequence[Box]) -> list[Box]:
    """The boxes that meet another one, or its conjugate: neighbours in the real part of e0, which conjugates share."""
    meeting: set[Box] = set()
    finest = max((box.exponents[0] for box in boxes), default=0)
    ends = sorted((_interval(box, finest), place) for place, box in enumerate(boxes))
    for number, ((_, high), place) in enumerate(ends):
        for (low, _), other in ends[number + 1 :]:
            if low > high:
                break
            first, second = boxes[place], boxes[other]
            if not (first.is_disjoint(second) and first.is_disjoint(second.conjugate())):
                meeting |= {first, second}
    return [box for box in boxes if box in meeting]


def _interval(box: Box, finest: int) -> tuple[int, int]:
    """The ends of the box in the real part of e0, in units of the finest grid."""
    middle, shift = box.centre[0][0], finest - box.exponents[0]
    return (middle - RADIUS) << shift, (middle + RADIUS) << shift


def in_order(boxes: Iterable[Box]) -> list[Box]:
    """By their centres."""
    listed = list(boxes)
    finest = [max((box.exponents[half] for box in listed), default=0) for half in (0, 1)]

    def first(box: Box) -> tuple[int, int]:
        shift, (a, b) = finest[0] - box.exponents[0], box.centre[0]
        return a << shift, b << shift

    def centre(box: Box) -> list[tuple[int, int]]:
        shifts = [finest[half] - box.exponents[half] for half in (0, 1)]
        return [(a << shifts[k // 4], b << shifts[k // 4]) for k, (a, b) in enumerate(box.centre)]

    # Mostly the first coordinate tells.
    return sorted(listed, key=first if len(set(map(first, listed))) == len(listed) else centre)
