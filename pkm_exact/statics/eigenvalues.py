"""Enclosures of the eigenvalues of a symmetric matrix of balls.

With approximate eigenvectors Q, exact as they stand, D = Q^T M Q is nearly diagonal: its eigenvalues differ from its
diagonal by the norm of the rest at most (Weyl), and are those of M times factors between the extreme eigenvalues of
Q^T Q (Ostrowski), which are within |Q^T Q - 1| of 1. References: Horn and Johnson, Matrix Analysis, 4.3.1 and 4.5.9.
"""

from __future__ import annotations

import mpmath
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
    off = _norm([near[i, j] for i in range(size) for j in range(size) if i != j])
    slack = _norm([defect[i, j] - (1 if i == j else 0) for i in range(size) for j in range(size)])
    if not slack < 1:
        return None
    found = [(near[i, i] + arb(0, off)) / (1 + arb(0, slack)) for i in range(size)]
    return _in_order(found)


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


def _norm(entries: list[arb]) -> arb:
    """An upper bound of the root of the sum of squares."""
    return sum((entry * entry for entry in entries), arb(0)).abs_upper().sqrt().abs_upper()
