"""Intervals and balls around rational numbers, sums of square roots and balls."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Final

from flint import arb

from pkm_exact.balls import ball
from pkm_exact.radicals import RootSum
from pkm_exact.roots.interval import Interval

BITS: Final = 64
"""Significant bits of the ends of intervals that are not exact."""


def ball_of(value: Any) -> arb:
    """A ball around a number, at the precision in force.

    >>> ball_of(RootSum.root(Fraction(4))) == 2
    True
    """
    if isinstance(value, arb):
        return value
    if not isinstance(value, RootSum):
        return ball(Fraction(value))
    return sum((ball(c) * arb(n).sqrt() for n, c in value.terms), arb(0))


def interval_of(value: Any) -> Interval:
    """An interval around a number: exact if it is known to be rational.

    Examples
    --------
    >>> interval_of(Fraction(1, 3))
    [1/3]
    >>> interval_of(arb(2).sqrt()).width < Fraction(1, 10**14)
    True
    """
    if not isinstance(value, arb):
        number = RootSum.of(value)
        return Interval(*number.bounds(BITS))
    ends = []
    for end, up in ((value.lower(), False), (value.upper(), True)):
        mantissa, power = (int(part) for part in end.man_exp())
        shift = max(0, mantissa.bit_length() - BITS)
        mantissa = -(-mantissa >> shift) if up else mantissa >> shift
        power += shift
        ends.append(Fraction(mantissa << power) if power >= 0 else Fraction(mantissa, 1 << -power))
    return Interval(ends[0], ends[1])
