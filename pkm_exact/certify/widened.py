"""Intervals around balls, with room for what others need to find them by their own arithmetic."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Final, TypeAlias

from flint import arb, arb_mat

from pkm_exact.balls import hull
from pkm_exact.polytopes.enclosures import interval_of

Ends: TypeAlias = tuple[Fraction, Fraction]
_SLACK: Final = arb(2) ** -80


def widened(value: arb, scale: arb | int = 0, room: int = 1) -> Ends:
    """The ends of an interval twice as wide, or wider by so many radii, and by a small part of a scale.

    Examples
    --------
    >>> low, high = widened(arb(1, 0.25), 1)
    >>> round(float(low), 6), round(float(high), 6)
    (0.5, 1.5)
    """
    most = abs(value).max(scale if isinstance(scale, arb) else arb(scale)).abs_upper()
    found = interval_of(value + arb(0, (room * value.rad() + _SLACK * most).abs_upper()))
    return Fraction(found.lo), Fraction(found.hi)


def widened_all(values: Sequence[arb], room: int = 1) -> list[Ends]:
    """All of them, with the largest one as their scale."""
    scale = arb(0)
    for value in values:
        scale = scale.max(abs(value).abs_upper())
    return [widened(value, scale, room) for value in values]


def hulls(rows: Sequence[Sequence[Ends]]) -> arb_mat:
    """The matrix of balls that contain intervals."""
    return arb_mat([[hull(*ends) for ends in row] for row in rows])


def texts(ends: Ends) -> list[str]:
    """As certificates spell an interval."""
    return [str(ends[0]), str(ends[1])]
