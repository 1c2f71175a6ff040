"""Relative manipulability after actuators fail: which share of sqrt(det J^T J) is left without some rows of J.

r^2 = det(J_S^T J_S) / det(J^T J) for the rows S that are left. Over all sets of i failures of m actuators with n
freedoms the squares sum to C(m - n, i) (Binet and Cauchy), so that the best machine has equal ones: Ukidve, McInroy and
Jafari, in Parallel Manipulators: Towards New Applications (2008), chapter 3, theorem 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations
from math import comb
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.radicals import RootSum

MOST_SETS: Final = 5000


def relative_manipulability(rows: Sequence[Sequence[Any]], failed: int) -> dict[tuple[int, ...], Fraction | RootSum]:
    """r^2 for every set of failed rows, exactly.

    r^2 does not depend on how twists are scaled: columns may be in any coordinates.

    Parameters
    ----------
    rows : of numbers
        J, rational or sums of square roots.
    failed : int
        How many fail at once.

    Raises
    ------
    InputError
        If J has not full rank, or there are too many sets, or det J^T J is not rational.

    Examples
    --------
    >>> one, zero = Fraction(1), Fraction(0)
    >>> found = relative_manipulability([(one, zero), (zero, one), (one, one)], 1)
    >>> [str(square) for square in found.values()]
    ['1/3', '1/3', '1/3']
    """
    count, freedoms = len(rows), len(rows[0])
    if comb(count, failed) > MOST_SETS:
        raise InputError(f"failures: {comb(count, failed)} sets are too many; give fewer failures at once")
    whole = RootSum.of(_gram_determinant(rows)).rational
    if not whole:
        raise InputError("failures: J has not full rank, or det J^T J is irrational; no ratio is given")
    found: dict[tuple[int, ...], Fraction | RootSum] = {}
    for chosen in combinations(range(count), failed):
        left = [row for index, row in enumerate(rows) if index not in chosen]
        square = RootSum.of(_gram_determinant(left)) if len(left) >= freedoms else RootSum()
        ratio = square / whole
        rational = ratio.rational
        found[chosen] = ratio if rational is None else rational
    return found


def _gram_determinant(rows: Sequence[Sequence[Any]]) -> Any:
    """det J^T J."""
    width = len(rows[0])
    gram = [[sum((RootSum.of(row[i]) * row[j] for row in rows), RootSum()) for j in range(width)] for i in range(width)]
    rational = [[value.rational for value in line] for line in gram]
    if all(value is not None for line in rational for value in line):
        from pkm_exact.polytopes.rationals import as_fraction, rational_matrix

        return as_fraction(rational_matrix(rational).det())
    return determinant(gram)


def determinant(rows: Sequence[Sequence[Any]]) -> RootSum:
    """A determinant over sums of square roots, by minors of the first rows.

    >>> two = RootSum.root(Fraction(2))
    >>> print(determinant([[two, RootSum.of(1)], [RootSum.of(1), two]]))
    1
    """
    size = len(rows)
    minors: dict[tuple[int, ...], RootSum] = {(): RootSum.of(1)}
    for line in range(size):
        grown: dict[tuple[int, ...], RootSum] = {}
        for columns, value in minors.items():
            for column in range(size):
                if column in columns or not RootSum.of(rows[line][column]).terms:
                    continue
                place = sum(1 for other in columns if other > column)
                key = tuple(sorted((*columns, column)))
                term = value * RootSum.of(rows[line][column])
                grown[key] = grown.get(key, RootSum()) + (-term if place % 2 else term)
        minors = grown
    return minors.get(tuple(range(size)), RootSum())
