"""What is left of a redundant platform when legs fail: exact ratios for every set of legs.

With a row of the inverse Jacobian M for each leg, the square of the relative manipulability after the failure of a set
S is r^2 = det(M_S^T M_S) / det(M^T M), M_S without the rows of S. By the theorem of Binet and Cauchy the r^2 of all
sets of i of n legs sum up to C(n - m, i), m the number of freedoms. Reference: Ukidve, McInroy and Jafari, "Failure
tolerance of orthogonal Gough-Stewart platforms" (2008).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations

from pkm_exact.errors import InputError
from pkm_exact.screws.exact_matrix import flint_matrix


def relative_manipulability(rows: Sequence[Sequence[Fraction | int]], count: int) -> dict[tuple[int, ...], Fraction]:
    """r^2 for every set of so many legs that fail, counted from 1; 0 if the platform is singular without them.

    Parameters
    ----------
    rows : sequence of rows
        One for each leg: unit force and moment, at least as many as columns.
    count : int

    Raises
    ------
    InputError
        If the platform is singular with all legs.

    Examples
    --------
    >>> found = relative_manipulability([[1, 0], [0, 1], [1, 1]], 1)
    >>> {failed: str(square) for failed, square in found.items()}
    {(1,): '1/3', (2,): '1/3', (3,): '1/3'}
    """
    columns = len(rows[0])
    whole = _gram(rows, columns)
    if not whole:
        raise InputError("rows: the platform is singular with all of its legs; give another pose")
    found = {}
    for failed in combinations(range(len(rows)), count):
        left = [row for k, row in enumerate(rows) if k not in failed]
        found[tuple(k + 1 for k in failed)] = _gram(left, columns) / whole
    return found


def _gram(rows: Sequence[Sequence[Fraction | int]], columns: int) -> Fraction:
    if len(rows) < columns:
        return Fraction(0)
    matrix = flint_matrix(rows, columns)
    value = (matrix.transpose() * matrix).det()
    return Fraction(int(value.p), int(value.q))
