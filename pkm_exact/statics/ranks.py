"""Ranks and dependencies of rows over the rationals or over sums of square roots, exactly; lower bounds in balls."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from flint import arb_mat

from pkm_exact.polytopes.rationals import as_fraction, rational_matrix
from pkm_exact.radicals import RootSum


def rationalised(row: Sequence[Any]) -> list[Fraction] | None:
    """A rational multiple of a row of sums of roots by a number that is not 0; None if there is none.

    >>> [str(x) for x in rationalised([RootSum.root(Fraction(2)), RootSum.root(Fraction(8)), Fraction(0)])]
    ['1', '2', '0']
    """
    pivot = next((value for value in row if RootSum.of(value).terms), None)
    if pivot is None:
        return [Fraction(0)] * len(row)
    found = []
    if len(RootSum.of(pivot).terms) > 2:
        return None
    inverse = RootSum.of(pivot).inverse()
    for value in row:
        ratio = (inverse * value).rational
        if ratio is None:
            return None
        found.append(ratio)
    return found


def left_kernel(rows: Sequence[Sequence[Fraction]]) -> list[list[Fraction]]:
    """A basis of the dependencies between rows: of the vectors z with z W = 0.

    >>> [[str(x) for x in z] for z in left_kernel([[Fraction(1)], [Fraction(2)]])]
    [['-2', '1']]
    """
    return kernel([list(column) for column in zip(*rows, strict=True)], len(rows))


def kernel(rows: Sequence[Sequence[Fraction]], width: int) -> list[list[Fraction]]:
    """A basis of the vectors x with W x = 0."""
    if not rows:
        return [[Fraction(int(i == k)) for i in range(width)] for k in range(width)]
    reduced, rank = rational_matrix(rows).rref()
    pivots = [next(c for c in range(width) if reduced[r, c] != 0) for r in range(rank)]
    basis = []
    for free in (c for c in range(width) if c not in pivots):
        vector = [Fraction(0)] * width
        vector[free] = Fraction(1)
        for r, c in enumerate(pivots):
            vector[c] = -as_fraction(reduced[r, free])
        basis.append(vector)
    return basis


def proved_rank(matrix: arb_mat) -> int:
    """A rank that the matrix has at least: a minor of this size, chosen in floating point, is not 0."""
    middle = np.array([float(entry.mid()) for entry in matrix.entries()]).reshape(matrix.nrows(), matrix.ncols())
    if not np.isfinite(middle).all():
        return 0
    rows, columns = _chosen(middle)
    for size in range(len(rows), 0, -1):
        minor = arb_mat([[matrix[r, c] for c in columns[:size]] for r in rows[:size]])
        if not minor.det().contains(0):
            return size
    return 0


def pivots(matrix: arb_mat) -> list[int]:
    """Columns of a minor that is far from 0, in floating point."""
    middle = np.array([float(entry.mid()) for entry in matrix.entries()]).reshape(matrix.nrows(), matrix.ncols())
    return _chosen(middle)[1]


def _chosen(middle: np.ndarray[Any, Any]) -> tuple[list[int], list[int]]:
    """Pivots of an elimination with complete pivoting."""
    left, rows, columns = middle.copy(), [], []
    for _ in range(min(middle.shape)):
        r, c = np.unravel_index(np.argmax(np.abs(left)), left.shape)
        if left[r, c] == 0:
            break
        rows.append(int(r))
        columns.append(int(c))
        left = left - np.outer(left[:, c], left[r, :]) / left[r, c]
        left[r, :] = left[:, c] = 0
    return rows, columns


def root_sum_rank(rows: Sequence[Sequence[Any]]) -> int:
    """The rank over sums of square roots, by elimination without quotients."""
    left = [[RootSum.of(value) for value in row] for row in rows]
    rank = 0
    for column in range(len(rows[0])):
        pivot = next((row for row in left if row[column].terms), None)
        if pivot is None:
            continue
        rank += 1
        left.remove(pivot)
        left = [
            [pivot[column] * value - row[column] * other for value, other in zip(row, pivot, strict=True)]
            for row in left
        ]
    return rank
