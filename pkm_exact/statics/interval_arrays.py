"""Arrays of intervals in floating point, rounded outwards: bounds that hold for thousands of poses at once.

Sums, products, quotients and square roots of doubles are rounded to the nearest (IEEE 754), so the neighbour of a
result is a bound. Where a bound would be infinite or undefined, it is infinite.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.float64]


@dataclass(frozen=True)
class Intervals:
    """An array of intervals.

    Attributes
    ----------
    lo, hi : arrays of the same shape

    Examples
    --------
    >>> third = Intervals.exactly(1.0) / Intervals.exactly(3.0)
    >>> bool(third.lo < third.hi), bool(third.hi - third.lo < 1e-15)
    (True, True)
    """

    lo: Array
    hi: Array

    @classmethod
    def exactly(cls, values: Any) -> Intervals:
        """Doubles as they are."""
        array = np.asarray(values, dtype=float)
        return cls(array, array)

    def __add__(self, other: Intervals) -> Intervals:
        return _outward(self.lo + other.lo, self.hi + other.hi)

    def __neg__(self) -> Intervals:
        return Intervals(-self.hi, -self.lo)

    def __sub__(self, other: Intervals) -> Intervals:
        return self + -other

    def __mul__(self, other: Intervals) -> Intervals:
        with np.errstate(invalid="ignore", over="ignore"):
            products = [self.lo * other.lo, self.lo * other.hi, self.hi * other.lo, self.hi * other.hi]
        low, high = np.minimum.reduce(products), np.maximum.reduce(products)
        return _outward(np.where(np.isnan(low), -np.inf, low), np.where(np.isnan(high), np.inf, high))

    def __truediv__(self, other: Intervals) -> Intervals:
        """The quotient; without bounds where the divisor may be 0."""
        safe = (other.lo > 0) | (other.hi < 0)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            low, high = np.where(safe, 1 / other.hi, -np.inf), np.where(safe, 1 / other.lo, np.inf)
        reciprocal = _outward(low, high)
        found = self * reciprocal
        return Intervals(np.where(safe, found.lo, -np.inf), np.where(safe, found.hi, np.inf))

    def __getitem__(self, place: Any) -> Intervals:
        return Intervals(self.lo[place], self.hi[place])

    def __abs__(self) -> Intervals:
        low = np.maximum(np.maximum(self.lo, -self.hi), 0)
        return Intervals(low, np.maximum(-self.lo, self.hi))

    def square(self) -> Intervals:
        """The square, not negative."""
        size = abs(self)
        found = _outward(size.lo * size.lo, size.hi * size.hi)
        return Intervals(np.maximum(found.lo, 0), found.hi)

    def root(self) -> Intervals:
        """The square root; of what may be negative, from 0 on."""
        with np.errstate(invalid="ignore"):
            found = _outward(np.sqrt(np.maximum(self.lo, 0)), np.sqrt(np.maximum(self.hi, 0)))
        return Intervals(np.maximum(found.lo, 0), found.hi)

    def ratio(self, size: Intervals) -> Intervals:
        """The quotient of two that are not negative; without an upper bound where the divisor may be 0."""
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            low = np.where(size.hi > 0, self.lo / size.hi, np.inf)
            high = np.where(size.lo > 0, self.hi / size.lo, np.inf)
        found = _outward(low, high)
        return Intervals(np.maximum(found.lo, 0), found.hi)

    def least(self, other: Intervals) -> Intervals:
        """The lesser of two, entry by entry."""
        return Intervals(np.minimum(self.lo, other.lo), np.minimum(self.hi, other.hi))

    def greatest(self, other: Intervals) -> Intervals:
        """The greater of two, entry by entry."""
        return Intervals(np.maximum(self.lo, other.lo), np.maximum(self.hi, other.hi))

    def clipped(self, low: float, high: float) -> Intervals:
        """Its part between two numbers."""
        return Intervals(np.clip(self.lo, low, high), np.clip(self.hi, low, high))


def _outward(low: Array, high: Array) -> Intervals:
    return Intervals(np.nextafter(low, -np.inf), np.nextafter(high, np.inf))
