"""Approximate singular vectors in doubles, from which enclosures of singular values are made.

Matrices of few rows or columns are rotated in plain Python, by Hestenes' method of one-sided Jacobi rotations (Golub
and Van Loan, Matrix Computations, section 8.6.3), the same on every machine; numpy, which takes longer to load than
such a robot to solve, is for the others.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot, sqrt
from typing import Final, TypeAlias

Rows: TypeAlias = list[list[float]]
FEW: Final = 4
"""Rows or columns, whichever are fewer, of a matrix that is left to plain Python."""
MOST_SWEEPS: Final = 30
NEGLIGIBLE: Final = 1e-16
"""Cosine of an angle between two columns that counts as right."""
DEPENDENT: Final = 0.5
"""Of a column, or a unit vector, less than this part is left beside others: then another one is taken."""


def singular_vectors(rows: Sequence[Sequence[float]]) -> tuple[Rows, Rows]:
    """Nearly orthogonal matrices U, V of which U^T A V is nearly diagonal; the entries of A are finite.

    Parameters
    ----------
    rows : sequence of sequence of float
        A, with shape (m, n).

    Returns
    -------
    list of list of float
        U, with shape (m, m), as rows.
    list of list of float
        V, with shape (n, n), as rows.

    Examples
    --------
    >>> singular_vectors([[0.0, 2.0], [3.0, 0.0]])
    ([[0.0, 1.0], [1.0, 0.0]], [[1.0, 0.0], [0.0, 1.0]])
    """
    if min(len(rows), len(rows[0])) > FEW:
        return _by_numpy(rows)
    columns = [list(column) for column in zip(*rows, strict=True)]
    if len(rows) < len(columns):
        right, left = singular_vectors(columns)
        return left, right
    columns, right = _rotated(columns)
    sizes = [hypot(*column) for column in columns]
    order = sorted(range(len(columns)), key=lambda k: -sizes[k])
    basis = _orthonormal([columns[k] for k in order], len(rows))
    first = [basis[order.index(k)] for k in range(len(order))] + basis[len(order) :]
    return [list(row) for row in zip(*first, strict=True)], [list(row) for row in zip(*right, strict=True)]


def _rotated(columns: Rows) -> tuple[Rows, Rows]:
    """The columns after rotations that make them orthogonal, and those of the product of the rotations."""
    size = len(columns)
    right = [[float(i == j) for i in range(size)] for j in range(size)]
    for _ in range(MOST_SWEEPS):
        is_done = True
        for j in range(size):
            for i in range(j):
                cosine, sine = _rotation(columns[i], columns[j])
                if not sine:
                    continue
                is_done = False
                for table in (columns, right):
                    pairs = list(zip(table[i], table[j], strict=True))
                    table[i] = [cosine * x - sine * y for x, y in pairs]
                    table[j] = [sine * x + cosine * y for x, y in pairs]
        if is_done:
            break
    return columns, right


def _rotation(first: Sequence[float], second: Sequence[float]) -> tuple[float, float]:
    """Cosine and sine of the rotation that makes two columns orthogonal."""
    a, b, c = _dot(first, first), _dot(second, second), _dot(first, second)
    if abs(c) <= NEGLIGIBLE * sqrt(a * b):
        return 1.0, 0.0
    half = (b - a) / (2 * c)
    tangent = (1.0 if half >= 0 else -1.0) / (abs(half) + hypot(1.0, half))
    cosine = 1 / hypot(1.0, tangent)
    return cosine, cosine * tangent


def _orthonormal(vectors: Sequence[Sequence[float]], size: int) -> Rows:
    """The vectors, longest first, made orthonormal, with unit vectors in place of dependent ones, and to a basis."""
    basis: Rows = []
    units = [[float(i == j) for i in range(size)] for j in range(size)]
    for vector in [*vectors, *([0.0] * size for _ in range(size - len(vectors)))]:
        best = _left(vector, basis)
        if not hypot(*best) > DEPENDENT * hypot(*vector):
            best = max((_left(unit, basis) for unit in units), key=lambda left: hypot(*left))
        length = hypot(*best)
        best = _left([value / length for value in best], basis)
        length = hypot(*best)
        basis.append([value / length for value in best])
    return basis


def _left(vector: Sequence[float], basis: Sequence[Sequence[float]]) -> list[float]:
    """What is left of a vector without its parts along orthonormal ones."""
    left = list(vector)
    for other in basis:
        part = _dot(left, other)
        left = [value - part * along for value, along in zip(left, other, strict=True)]
    return left


def _dot(left: Sequence[float], right: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(left, right, strict=True))


def _by_numpy(rows: Sequence[Sequence[float]]) -> tuple[Rows, Rows]:
    import numpy as np

    left, _, right = np.linalg.svd(np.array(rows))
    return left.tolist(), right.T.tolist()
