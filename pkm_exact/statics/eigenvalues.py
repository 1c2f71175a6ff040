"""Enclosures of the eigenvalues of a symmetric matrix of balls.

With approximate eigenvectors Q, exact as they stand, D = Q^T M Q is nearly diagonal: its eigenvalues differ from its
diagonal by the norm of the rest at most (Weyl), and are those of M times factors between the extreme eigenvalues of
Q^T Q (Ostrowski), which are within |Q^T Q - 1| of 1. Where M = A^T A is enclosed too widely for its least eigenvalue, X
near M^-1/2 serves: with N = (A X)^T A X, M has those of (X X^T)^-1 times factors within |N - 1| of 1. References: Horn
and Johnson, Matrix Analysis, 4.3.1 and 4.5.9.
"""

from __future__ import annotations

from collections.abc import Sequence

import mpmath
import numpy as np
from flint import arb, arb_mat

_DIGITS = 50


def eigenvalues(matrix: arb_mat) -> list[arb] | None:
    """In increasing order, with multiplicities; None if the entries are too wide.

    Examples
    --------
    >>> from flint import arb_mat
    >>> [bool(x.contains(k)) for x, k in zip(eigenvalues(arb_mat([[2, 1], [1, 2]])), (1, 3))]
    [True, True]
    """
    size = matrix.nrows()
    if not all(entry.is_finite() for entry in matrix.entries()):
        return None
    with mpmath.workdps(_DIGITS):
        middle = mpmath.matrix(size, size)
        for i in range(size):
            for j in range(size):
                mantissa, power = matrix[i, j].mid().man_exp()
                middle[i, j] = mpmath.ldexp(mpmath.mpf(int(mantissa)), int(power))
        _, vectors = mpmath.eigsy((middle + middle.T) / 2)
        entries = [_exact(vectors[i, j]) for i in range(size) for j in range(size)]
    q = arb_mat(size, size, entries)
    near = q.transpose() * matrix * q
    defect = q.transpose() * q
    off = norm([near[i, j] for i in range(size) for j in range(size) if i != j])
    slack = norm([defect[i, j] - (1 if i == j else 0) for i in range(size) for j in range(size)])
    if not slack < 1:
        return None
    found = [(near[i, i] + arb(0, off)) / (1 + arb(0, slack)) for i in range(size)]
    return _in_order(found)


def gram_eigenvalues(rows: arb_mat) -> list[arb] | None:
    """Those of A^T A, A the rows of balls; positive ones also where entries are too wide for ``eigenvalues``.

    Examples
    --------
    >>> rows = arb_mat([[arb(1, 1e-7), arb(1, 1e-7)], [arb(0, 1e-10), arb(1e-3, 1e-10)]])
    >>> eigenvalues(rows.transpose() * rows)[0] > 0, gram_eigenvalues(rows)[0] > 0
    (False, True)
    """
    gram = rows.transpose() * rows
    found = eigenvalues(gram)
    if found is None or found[0] > 0:
        return found
    x = inverse_root(gram)
    if x is None:
        return found
    n, reach = gram.nrows(), rows * x
    near = reach.transpose() * reach
    defect = norm([near[i, j] - int(i == j) for i in range(n) for j in range(n)])
    own = eigenvalues(x * x.transpose())
    if own is None or not own[0] > 0 or not defect < 1:
        return found
    return [(1 + arb(0, defect)) / value for value in reversed(own)]


def inverse_root(matrix: arb_mat) -> arb_mat | None:
    """A matrix of exact numbers X near M^-1/2, X^T M X near 1, for the middle of a symmetric M; None if there is none.

    >>> found = inverse_root(arb_mat([[4, 0], [0, 9]]))
    >>> sorted(abs(float(x)) for x in found.entries())[2:]
    [0.3333333333333333, 0.5]
    """
    n = matrix.nrows()
    middle = np.array([[float(matrix[i, j].mid()) for j in range(n)] for i in range(n)])
    if not np.isfinite(middle).all() or not (np.diag(middle) > 0).all():
        return None
    scales = 1 / np.sqrt(np.diag(middle))
    values, vectors = np.linalg.eigh(middle * np.outer(scales, scales))
    if not values[0] > 0:
        return None
    found = scales[:, None] * vectors / np.sqrt(values)
    return arb_mat([[arb(float(x)) for x in row] for row in found])


def _exact(value: mpmath.mpf) -> arb:
    sign, mantissa, power, _ = value._mpf_
    return arb((-int(mantissa) if sign else int(mantissa), int(power)))


def _in_order(values: list[arb]) -> list[arb]:
    """Enclosures of the sorted numbers: the k-th lies between the k-th least lower and the k-th least upper end."""
    lows, highs = _sorted([value.lower() for value in values]), _sorted([value.upper() for value in values])
    return [low.union(high) for low, high in zip(lows, highs, strict=True)]


def _sorted(values: list[arb]) -> list[arb]:
    """Exact numbers, the least first."""
    left, found = list(values), []
    while left:
        least = left[0]
        for value in left[1:]:
            if value < least:
                least = value
        left.remove(least)
        found.append(least)
    return found


def norm(entries: Sequence[arb]) -> arb:
    """An upper bound of the root of the sum of squares."""
    return sum((entry * entry for entry in entries), arb(0)).abs_upper().sqrt().abs_upper()
