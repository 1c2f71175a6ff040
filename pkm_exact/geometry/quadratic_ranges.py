"""Where quadratic polynomials are all not negative: finitely many closed intervals, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TypeAlias

from pkm_exact.radicals import RootSum

Quadratic: TypeAlias = tuple[Fraction, Fraction, Fraction]
"""Coefficients a, b and c of a x^2 + b x + c; a and b may be 0."""

Range: TypeAlias = tuple[RootSum, RootSum]
"""A closed interval; one point if its ends are equal."""


def ranges_of(conditions: Sequence[Quadratic], low: Fraction, high: Fraction) -> tuple[Range, ...]:
    """All x from ``low`` to ``high`` at which no polynomial is negative, in increasing order.

    Examples
    --------
    >>> one, zero = Fraction(1), Fraction(0)
    >>> found = ranges_of([(one, zero, Fraction(-2)), (-one, zero, Fraction(9))], Fraction(-2), Fraction(5))
    >>> [(str(start), str(end)) for start, end in found]
    [('-2', '-sqrt(2)'), ('sqrt(2)', '3')]
    """
    ends: Range = RootSum.of(low), RootSum.of(high)
    found: list[Range] = [ends] if low <= high else []
    for condition in conditions:
        found = [both for one in found for part in _parts(condition, *ends) if (both := _meeting(one, part))]
        found = _joined(found)
    return tuple(found)


def _parts(condition: Quadratic, low: RootSum, high: RootSum) -> list[Range]:
    """Where one polynomial is not negative; the ends may be out of order, for nothing."""
    a, b, c = condition
    if a == 0 and b == 0:
        return [(low, high)] if c >= 0 else []
    if a == 0:
        root = RootSum.of(-c / b)
        return [(root, high) if b > 0 else (low, root)]
    square = b * b - 4 * a * c
    if square < 0:
        return [(low, high)] if a > 0 else []
    step = RootSum.root(square) / (2 * abs(a))
    first, last = step * -1 - b / (2 * a), step - b / (2 * a)
    return [(first, last)] if a < 0 else [(low, first), (last, high)]


def _meeting(one: Range, other: Range) -> Range | None:
    low = one[0] if (one[0] - other[0]).sign() >= 0 else other[0]
    high = one[1] if (one[1] - other[1]).sign() <= 0 else other[1]
    return (low, high) if (high - low).sign() >= 0 else None


def _joined(ranges: Sequence[Range]) -> list[Range]:
    """Neighbours that touch put together: of a double root there are two."""
    found: list[Range] = []
    for low, high in ranges:
        if found and (low - found[-1][1]).sign() <= 0:
            found[-1] = (found[-1][0], high)
        else:
            found.append((low, high))
    return found
