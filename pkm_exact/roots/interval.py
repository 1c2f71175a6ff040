"""Closed intervals with rational ends."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True)
class Interval:
    """A closed interval with rational ends; ``lo == hi`` means that the value is known exactly."""

    lo: Fraction
    hi: Fraction

    def __post_init__(self) -> None:
        if self.lo > self.hi:
            raise ValueError(f"interval ends out of order: {self.lo} > {self.hi}")

    @property
    def width(self) -> Fraction:
        """Difference of the ends."""
        return self.hi - self.lo

    @property
    def midpoint(self) -> Fraction:
        """Mean of the ends."""
        return (self.lo + self.hi) / 2

    def contains(self, value: Fraction) -> bool:
        """Whether ``value`` lies in the closed interval."""
        return self.lo <= value <= self.hi

    def overlaps(self, other: Interval) -> bool:
        """Whether the two closed intervals have a point in common."""
        return self.lo <= other.hi and other.lo <= self.hi
