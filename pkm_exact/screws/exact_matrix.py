"""Rational matrices: echelon forms, ranks and null spaces, exactly; data in FLINT, rows of fractions outside."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TypeAlias

from flint import fmpq, fmpq_mat

Row: TypeAlias = tuple[Fraction, ...]


def flint_matrix(rows: Sequence[Sequence[Fraction | int]], columns: int) -> fmpq_mat:
    """The matrix with the given rows, each of so many entries; there may be none."""
    entries = [fmpq(value.numerator, value.denominator) for row in rows for value in row]
    return fmpq_mat(len(rows), columns, entries)


def rows_of(matrix: fmpq_mat) -> tuple[Row, ...]:
    """The rows of a matrix as fractions."""
    return tuple(tuple(Fraction(int(value.p), int(value.q)) for value in row) for row in matrix.tolist())


def echelon(rows: Sequence[Sequence[Fraction | int]], columns: int) -> tuple[tuple[Row, ...], tuple[int, ...]]:
    """The rows that are not 0 of the reduced row echelon form, and the columns of their leading ones.

    Two matrices have the same rows here exactly if their rows span the same space.

    Examples
    --------
    >>> found, pivots = echelon([[2, 4, 0], [1, 2, 1]], 3)
    >>> [[int(value) for value in row] for row in found], pivots
    ([[1, 2, 0], [0, 0, 1]], (0, 2))
    """
    if not rows or not columns:
        return (), ()
    reduced, rank = flint_matrix(rows, columns).rref()
    found = rows_of(reduced)[:rank]
    return found, tuple(next(k for k, value in enumerate(row) if value) for row in found)


def rank(rows: Sequence[Sequence[Fraction | int]], columns: int) -> int:
    """The rank of a matrix.

    Examples
    --------
    >>> rank([[1, 2], [2, 4]], 2)
    1
    """
    return int(flint_matrix(rows, columns).rank()) if rows and columns else 0


def null_space(rows: Sequence[Sequence[Fraction | int]], columns: int) -> tuple[Row, ...]:
    """A basis of all x with A x = 0: for each column without a leading one the x that is 1 there and 0 at the others.

    Examples
    --------
    >>> [[str(value) for value in x] for x in null_space([[1, 2, 0], [0, 0, 1]], 3)]
    [['-2', '1', '0']]
    """
    found, pivots = echelon(rows, columns)
    basis = []
    for free in (k for k in range(columns) if k not in pivots):
        x = [Fraction(0)] * columns
        x[free] = Fraction(1)
        for row, pivot in zip(found, pivots, strict=True):
            x[pivot] = -row[free]
        basis.append(tuple(x))
    return tuple(basis)


def solution(rows: Sequence[Sequence[Fraction | int]], right: Sequence[Fraction | int], columns: int) -> Row | None:
    """The x with A x = b that is 0 at every column without a leading one; None if there is none.

    Examples
    --------
    >>> [int(value) for value in solution([[1, 1], [2, 2]], [3, 6], 2)], solution([[1, 1], [2, 2]], [3, 7], 2)
    ([3, 0], None)
    """
    found, pivots = echelon([[*row, value] for row, value in zip(rows, right, strict=True)], columns + 1)
    if columns in pivots:
        return None
    x = [Fraction(0)] * columns
    for row, pivot in zip(found, pivots, strict=True):
        x[pivot] = row[columns]
    return tuple(x)


def product(left: Sequence[Sequence[Fraction | int]], right: Sequence[Sequence[Fraction | int]]) -> tuple[Row, ...]:
    """The product of two matrices, both with rows.

    Examples
    --------
    >>> [[int(value) for value in row] for row in product([[1, 2]], [[3], [4]])]
    [[11]]
    """
    return rows_of(flint_matrix(left, len(left[0])) * flint_matrix(right, len(right[0])))
