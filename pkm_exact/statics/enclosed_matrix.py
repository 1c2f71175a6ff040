"""Matrices of enclosed numbers with named rows and columns, in numpy in one call."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from flint import arb
from numpy.typing import NDArray

from pkm_exact.polytopes.enclosures import BITS, interval_of
from pkm_exact.radicals import RootSum
from pkm_exact.roots.interval import Interval, decimal

_LEAST = Fraction(1, 2 * 10**12)


def shown_number(value: Interval) -> str:
    """The digits that are certain, 12 of them at most.

    >>> shown_number(Interval(Fraction(1, 3), Fraction(1, 3)))
    '0.333333333333'
    >>> shown_number(Interval(Fraction(0), Fraction(1, 10**30)))
    '0.00000000000000'
    """
    room = max(abs(value.lo) * _LEAST, abs(value.hi) * _LEAST, _LEAST / 1000)
    return decimal(Interval(value.lo - room, value.hi + room))


@dataclass(frozen=True, repr=False)
class EnclosedMatrix:
    """A matrix whose entries are proved to lie in intervals.

    Attributes
    ----------
    rows, columns : tuple of str
        Their names.
    entries : tuple of rows of Interval
    exact : tuple of rows of str, or None
        The entries as sums of square roots, where they are known exactly.
    """

    rows: tuple[str, ...]
    columns: tuple[str, ...]
    entries: tuple[tuple[Interval, ...], ...]
    exact: tuple[tuple[str, ...], ...] | None = None

    @classmethod
    def exactly(
        cls, rows: Sequence[str], columns: Sequence[str], values: Sequence[Sequence[RootSum]]
    ) -> EnclosedMatrix:
        """A matrix of sums of square roots."""
        entries = tuple(tuple(Interval(*value.bounds(BITS)) for value in row) for row in values)
        return cls(tuple(rows), tuple(columns), entries, tuple(tuple(map(str, row)) for row in values))

    @classmethod
    def of(cls, rows: Sequence[str], columns: Sequence[str], values: Sequence[Sequence[arb]]) -> EnclosedMatrix:
        """A matrix of balls."""
        return cls(tuple(rows), tuple(columns), tuple(tuple(interval_of(value) for value in row) for row in values))

    def to_numpy(self) -> NDArray[np.float64]:
        """The entries in doubles, each the nearest to the middle of its interval.

        Returns
        -------
        array of shape (rows, columns)
        """
        return np.array([[float(entry) for entry in row] for row in self.entries]).reshape(self.shape)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        return self.to_numpy().astype(dtype or np.float64)

    @property
    def shape(self) -> tuple[int, int]:
        """How many rows and columns there are."""
        return len(self.rows), len(self.columns)

    def __getitem__(self, place: tuple[int, int]) -> Interval:
        row, column = place
        return self.entries[row][column]

    def as_object(self) -> list[list[list[str]]]:
        """Rows of entries as JSON has them: both ends of each interval."""
        return [[[str(entry.lo), str(entry.hi)] for entry in row] for row in self.entries]

    def __str__(self) -> str:
        cells = [["", *self.columns]]
        cells += [[name, *map(shown_number, row)] for name, row in zip(self.rows, self.entries, strict=True)]
        widths = [max(len(row[k]) for row in cells) for k in range(len(cells[0]))]
        lines = ["  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)) for row in cells]
        return "\n".join(line.rstrip() for line in lines)

    def __repr__(self) -> str:
        return f"<EnclosedMatrix {self.shape[0]} x {self.shape[1]}>\n{self}"
