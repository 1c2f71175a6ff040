"""Numbers as the page shows them: exact ones as they are written, enclosed ones with the digits that are certain."""

from __future__ import annotations

from collections.abc import Sequence
from decimal import MAX_EMAX, MIN_EMIN, ROUND_CEILING, Context, Decimal
from fractions import Fraction
from math import isqrt
from typing import Final

from pkm_exact.geometry.rational import finite_decimal
from pkm_exact.roots.interval import Interval, decimal
from pkm_exact.wording import NO_UNIT

_UPWARDS: Final = Context(prec=2, rounding=ROUND_CEILING, Emin=MIN_EMIN, Emax=MAX_EMAX)
_ABOUT: Final = Context(prec=8, Emin=MIN_EMIN, Emax=MAX_EMAX)
_MOST_DECIMALS: Final = 40


def in_unit(unit: str) -> str:
    """The unit in brackets; nothing if the lengths are pure numbers.

    Examples
    --------
    >>> in_unit("mm"), in_unit("1")
    (' [mm]', '')
    """
    return "" if unit == NO_UNIT else f" [{unit}]"


def unit_words(unit: str) -> str:
    """The unit, or that there is none."""
    return "none, pure numbers" if unit == NO_UNIT else unit


def exact(value: Fraction) -> str:
    """A rational number exactly: as a decimal if it has a finite one that is not long, otherwise as a fraction.

    Examples
    --------
    >>> exact(Fraction(464141, 1000)), exact(Fraction(-1, 3)), exact(Fraction(5))
    ('464.141', '-1/3', '5')
    """
    text = finite_decimal(value)
    return str(value) if text is None or len(text.partition(".")[2]) > _MOST_DECIMALS else text


def times_root(value: Fraction, square: int) -> str:
    """A rational number times the square root of an integer, exactly.

    Examples
    --------
    >>> times_root(Fraction(1, 2), 1), times_root(Fraction(1, 2), 3), times_root(Fraction(3), 4)
    ('0.5', '0.5 √3', '6')
    """
    root = isqrt(square)
    if root * root == square:
        return exact(value * root)
    return f"{exact(value)} √{square}" if value else "0"


def root_of(square: Fraction) -> str:
    """The square root of a positive rational number: exactly if it is rational, otherwise as a root and about.

    Examples
    --------
    >>> root_of(Fraction(25, 4)), root_of(Fraction(1, 3))
    ('2.5', '√(1/3) ≈ 0.57735027')
    """
    numerator, denominator = isqrt(square.numerator), isqrt(square.denominator)
    root = Fraction(numerator, denominator)
    if root * root == square:
        return exact(root)
    about = _ABOUT.sqrt(_ABOUT.divide(Decimal(square.numerator), Decimal(square.denominator)))
    text = exact(square)
    return f"√({text}) ≈ {about}" if "/" in text else f"√{text} ≈ {about}"


def shortened(interval: Interval, digits: int) -> str:
    """As ``decimal``, with at most so many digits after the point; the last one is right to within one unit.

    Examples
    --------
    >>> third = Interval(Fraction(333332, 10**6), Fraction(333334, 10**6))
    >>> decimal(third), shortened(third, 2), shortened(third, 9)
    ('0.33333', '0.33', '0.33333')
    """
    half = Fraction(1, 2 * 10**digits)
    middle = interval.midpoint
    return decimal(interval if interval.width >= 2 * half else Interval(middle - half, middle + half))


def bound(value: Fraction) -> str:
    """Two digits of a number that is not negative, rounded up.

    Examples
    --------
    >>> bound(Fraction(1, 3 * 10**9)), bound(Fraction(0))
    ('3.4e-10', '0')
    """
    rounded = _UPWARDS.divide(Decimal(value.numerator), Decimal(value.denominator))
    return f"{rounded:.1e}" if rounded else "0"


def distance(texts: Sequence[str], intervals: Sequence[Interval]) -> Fraction:
    """How far at most the numbers in these texts are from any number of their intervals.

    Examples
    --------
    >>> distance(["0.5"], [Interval(Fraction(2, 5), Fraction(3, 4))])
    Fraction(1, 4)
    """
    return max(
        max(interval.hi - Fraction(text), Fraction(text) - interval.lo)
        for text, interval in zip(texts, intervals, strict=True)
    )
