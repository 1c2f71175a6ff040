"""A matrix that is nearly a rotation, as recorded with a few digits, and a rational rotation next to it."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Final, TypeAlias

from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Matrix, Quaternion, rotation_of
from pkm_exact.geometry.ordinary_pose import quaternion_of

Rows: TypeAlias = Sequence[Sequence[Fraction]]

_GRID: Final = 1 << 100
_STEPS: Final = 8
"""Of an iteration that doubles the digits: from one digit to more than the grid has."""


def nearest_rotation(matrix: Rows, where: str = "matrix") -> tuple[Quaternion, Fraction]:
    """A quaternion of the rotation next to a matrix, and by how much an entry of the rotation differs, at most.

    The rotation is the orthogonal factor of the polar decomposition, by Newton's iteration X <- (X + X^-T) / 2 in
    fixed-point numbers (Higham, SIAM J. Sci. Stat. Comput. 7 (1986) 1160). What comes out is an exact rotation, and its
    difference from the matrix is exact.

    Parameters
    ----------
    matrix : 3 x 3 of Fraction
        Row by row, ordinary coordinates.
    where : str
        How messages call it.

    Raises
    ------
    InputError
        If the matrix is not even nearly a rotation.

    Examples
    --------
    >>> rows = [["0.866", "-0.5", "0"], ["0.5", "0.866", "0"], ["0", "0", "1"]]
    >>> _, off = nearest_rotation([[Fraction(entry) for entry in row] for row in rows])
    >>> Fraction(1, 100000) < off < Fraction(1, 10000)
    True
    """
    product = [[sum((row[i] * row[j] for row in matrix), Fraction(0)) - (i == j) for j in range(3)] for i in range(3)]
    if max(abs(entry) for row in product for entry in row) > Fraction(1, 2) or _determinant(matrix) <= 0:
        raise InputError(f"{where}: is not even nearly a rotation; give a matrix whose columns are nearly orthonormal")
    current = [list(row) for row in matrix]
    for _ in range(_STEPS):
        cofactors, determinant = _cofactors(current), _determinant(current)
        current = [
            [_rounded((x + c / determinant) / 2) for x, c in zip(row, others, strict=True)]
            for row, others in zip(current, cofactors, strict=True)
        ]
    e0, e1, e2, e3 = (_rounded(e) for e in quaternion_of(current))
    return (e0, e1, e2, e3), _difference(rotation_of((e0, e1, e2, e3)), matrix)


def _rounded(number: Fraction) -> Fraction:
    return Fraction(round(number * _GRID), _GRID)


def _cofactors(m: Rows) -> list[list[Fraction]]:
    """det X times the inverse of the transposed matrix."""
    return [
        [
            m[(i + 1) % 3][(j + 1) % 3] * m[(i + 2) % 3][(j + 2) % 3]
            - m[(i + 1) % 3][(j + 2) % 3] * m[(i + 2) % 3][(j + 1) % 3]
            for j in range(3)
        ]
        for i in range(3)
    ]


def _determinant(m: Rows) -> Fraction:
    return sum((a * c for a, c in zip(m[0], _cofactors(m)[0], strict=True)), Fraction(0))


def _difference(rotation: Matrix, matrix: Rows) -> Fraction:
    pairs = zip((x for row in rotation for x in row), (x for row in matrix for x in row), strict=True)
    return max(abs(a - b) for a, b in pairs)
