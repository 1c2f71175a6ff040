"""Closed intervals with rational ends."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from decimal import MAX_EMAX, MIN_EMIN, ROUND_CEILING, Context, Decimal
from fractions import Fraction
from functools import lru_cache
from itertools import repeat
from math import inf, nextafter
from typing import TYPE_CHECKING, Final, TypeAlias

DIGITS_OF_EXACT: Final = 15
"""Decimals shown of a number that is known exactly."""
_LONGEST_FRACTION: Final = 24
_GREATEST: Final = nextafter(inf, 0)
_UPWARDS: Final = Context(prec=2, rounding=ROUND_CEILING, Emin=MIN_EMIN, Emax=MAX_EMAX)

Cell: TypeAlias = tuple[int, int, int]
"""Ends in units of 2^-exponent, and the exponent, at least 0."""
Ends: TypeAlias = tuple[int, int] | tuple[Fraction, Fraction]


@dataclass(frozen=True, repr=False, slots=True)
class Interval:
    """A closed interval with rational ends; ``lo == hi`` means that the value is known exactly.

    ``str`` shows the digits that are certain, the last one to within one unit; ``repr`` adds how far any number of the
    interval is from them at most. ``float`` is the finite double nearest to the midpoint, of one that is too great the
    greatest; ``ball`` says how far off it is, and refuses then.

    Attributes
    ----------
    lo, hi : Fraction

    Examples
    --------
    >>> x = Interval(Fraction(1, 3), Fraction(1, 3) + Fraction(1, 10**5))
    >>> x
    [0.33334 +/- 6.7e-6]
    >>> print(x)
    0.33334
    >>> float(x), f"{x:.3f}", x.width
    (0.33333833333333335, '0.333', Fraction(1, 100000))
    >>> Fraction(1, 3) in x, 0.25 in x
    (True, False)
    """

    lo: Fraction
    hi: Fraction
    cell: Cell | None = field(default=None, init=False, compare=False)
    """What it was made of, if it is one on a grid."""

    def __post_init__(self) -> None:
        # As fractions compare, in a third of the time: answers have hundreds of intervals.
        if self.lo.numerator * self.hi.denominator > self.hi.numerator * self.lo.denominator:
            raise ValueError(f"interval ends out of order: {self.lo} > {self.hi}")

    @classmethod
    def on_grid(cls, low: int, high: int, exponent: int) -> Interval:
        """The interval from low to high, low at most high, in units of 2^-exponent; the exponent is at least 0.

        Its ends become fractions when they are asked for: answers have hundreds of intervals.

        Examples
        --------
        >>> Interval.on_grid(2, 3, 2) == Interval(Fraction(1, 2), Fraction(3, 4))
        True
        """
        found = object.__new__(cls)
        object.__setattr__(found, "cell", (low, high, exponent))
        return found

    @classmethod
    def cells(cls, lows: Sequence[int], highs: Sequence[int], exponent: int) -> list[Interval]:
        """Many intervals on one grid.

        Examples
        --------
        >>> [str(cell) for cell in Interval.cells([2, 4], [3, 6], 2)]
        ['1', '1']
        """
        cells = list(zip(lows, highs, [exponent] * len(lows), strict=True))
        found = list(map(object.__new__, repeat(cls, len(cells))))
        # Nothing else is as quick, and answers have hundreds of intervals.
        deque(map(object.__setattr__, found, repeat("cell"), cells), 0)
        return found

    if not TYPE_CHECKING:  # else any name would pass for an attribute

        def __getattr__(self, name: str) -> Fraction:
            """An end of an interval on a grid, when it is first asked for."""
            if name not in ("lo", "hi") or self.cell is None:
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}", name=name, obj=self)
            *ends, exponent = self.cell
            value = Fraction(ends[name == "hi"], 1 << exponent)
            object.__setattr__(self, name, value)
            return value

    @property
    def is_above_zero(self) -> bool:
        """Whether a number of it is positive.

        Examples
        --------
        >>> [Interval(Fraction(-1), Fraction(high)).is_above_zero for high in (0, 1)]
        [False, True]
        >>> Interval.on_grid(0, 1, 3).is_above_zero
        True
        """
        return (self.hi if self.cell is None else self.cell[1]) > 0

    @property
    def width(self) -> Fraction:
        """Difference of the ends."""
        return self.hi - self.lo

    @property
    def midpoint(self) -> Fraction:
        """Mean of the ends."""
        return (self.lo + self.hi) / 2

    def contains(self, value: Fraction) -> bool:
        """Whether ``value`` lies in the closed interval.

        Examples
        --------
        >>> Interval(Fraction(1), Fraction(2)).contains(Fraction(3, 2))
        True
        """
        return self.lo <= value <= self.hi

    def overlaps(self, other: Interval) -> bool:
        """Whether the two closed intervals have a point in common.

        Examples
        --------
        >>> Interval(Fraction(1), Fraction(2)).overlaps(Interval(Fraction(3), Fraction(4)))
        False
        """
        return self.lo <= other.hi and other.lo <= self.hi

    def ball(self) -> tuple[float, float]:
        """Two doubles, a middle and a half-width: no number of the interval is further from the middle, exactly.

        Raises
        ------
        OverflowError
            If the interval is out of reach of floating point.

        Examples
        --------
        >>> middle, half_width = Interval(Fraction(1, 3), Fraction(1, 3)).ball()
        >>> middle, 0 < half_width < 1e-16
        (0.3333333333333333, True)
        """
        middle = float(self.midpoint)
        exact = max(self.hi - Fraction(middle), Fraction(middle) - self.lo)
        half_width = float(exact)
        return middle, half_width if Fraction(half_width) >= exact else nextafter(half_width, inf)

    def __contains__(self, value: object) -> bool:
        """Whether a number lies in the closed interval, decided exactly: a double is the binary number that it is."""
        if isinstance(value, Decimal):
            value = Fraction(value) if value.is_finite() else float(value)
        if not isinstance(value, int | float | Fraction):
            raise TypeError(f"in an interval are numbers, not {type(value).__name__}; give an int, Fraction or Decimal")
        return bool(self.lo <= value <= self.hi)

    def __float__(self) -> float:
        try:
            return float(self.midpoint)
        except OverflowError:  # infinite it is not: of a condition number that would say that the pose is singular
            return _GREATEST if self.midpoint > 0 else -_GREATEST

    def __format__(self, spec: str) -> str:
        return format(float(self), spec) if spec else str(self)

    def __str__(self) -> str:
        return decimal(self)

    def __repr__(self) -> str:
        if self.lo == self.hi and len(exact := str(self.lo)) <= _LONGEST_FRACTION:
            return f"[{exact}]"
        text = decimal(self)
        farthest = max(self.hi - Fraction(text), Fraction(text) - self.lo)
        bound = _UPWARDS.divide(Decimal(farthest.numerator), Decimal(farthest.denominator))
        return f"[{text} +/- {bound.normalize():.1e}]"


def common_ends(rows: Sequence[Sequence[Interval]]) -> tuple[list[list[Ends]], int]:
    """The ends of intervals in units of 2^-exponent, and the exponent: integers where all are on one grid.

    Examples
    --------
    >>> half, cell = Interval(Fraction(1, 2), Fraction(1)), Interval.on_grid(2, 3, 2)
    >>> common_ends([[cell]]), common_ends([[cell], [half]]) == ([[(cell.lo, cell.hi)], [(half.lo, half.hi)]], 0)
    (([[(2, 3)]], 2), True)
    """
    cells = [interval.cell or (0, 0, -1) for row in rows for interval in row]
    exponents = {exponent for _, _, exponent in cells}
    if len(exponents) != 1 or -1 in exponents:
        return [[(interval.lo, interval.hi) for interval in row] for row in rows], 0
    found = iter(cells)
    return [[next(found)[:2] for _ in row] for row in rows], exponents.pop()


def decimal(interval: Interval) -> str:
    """The midpoint, rounded so that the last digit is right to within one unit for every value in the interval.

    Examples
    --------
    >>> decimal(Interval(Fraction(1, 3), Fraction(1, 3) + Fraction(1, 10**5)))
    '0.33334'
    >>> decimal(Interval(Fraction(-3, 8), Fraction(-3, 8)))
    '-0.375000000000000'
    """
    # In integers, and not in fractions, which are ten times slower: a sweep writes a hundred decimals per row.
    cell = interval.cell
    if cell is not None and cell[0] < cell[1]:
        low, high, exponent = cell
        digits, power = _digits_of_cells(high - low, exponent)
        scaled = _nearest((low + high) * power, 2 << exponent)
    else:
        (low, below), (high, above) = _ratios(interval)
        width = high * below - low * above
        digits = len(str(max(1, below * above // width))) - 1 if width else DIGITS_OF_EXACT
        scaled = _nearest((high * below + low * above) * 10**digits, 2 * below * above)
    sign = "-" if scaled < 0 else ""
    whole, rest = divmod(abs(scaled), 10**digits)
    return f"{sign}{whole}.{rest:0{digits}d}" if digits else f"{sign}{whole}"


@lru_cache(maxsize=64)
def _digits_of_cells(width: int, exponent: int) -> tuple[int, int]:
    """Certain decimals of an interval that is so many units of 2^-exponent wide, and the power of ten for them."""
    digits = len(str(max(1, (1 << exponent) // width))) - 1
    return digits, 10**digits


def _ratios(interval: Interval) -> tuple[tuple[int, int], tuple[int, int]]:
    """Numerators and denominators of the ends."""
    if interval.cell is None:
        return interval.lo.as_integer_ratio(), interval.hi.as_integer_ratio()
    low, high, exponent = interval.cell
    return (low, 1 << exponent), (high, 1 << exponent)


def _nearest(numerator: int, denominator: int) -> int:
    """The integer nearest to a fraction; of two, the even one."""
    floor, rest = divmod(numerator, denominator)
    return floor + (2 * rest > denominator or (2 * rest == denominator and floor % 2 == 1))
