"""Small linear programs over the rationals, exactly: the simplex method with Bland's rule, which always ends."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from pkm_exact.errors import InputError


def greatest(objective: Sequence[Fraction], rows: Sequence[Sequence[Fraction]], bounds: Sequence[Fraction]) -> Fraction:
    """The greatest objective.x over all x with rows x <= bounds, all bounds at least 0, so that x = 0 is one of them.

    Reference: Bland, Mathematics of Operations Research 2 (1977), 103-107.

    Raises
    ------
    InputError
        If it is not bounded, or a bound is negative.

    Examples
    --------
    >>> one, zero = Fraction(1), Fraction(0)
    >>> print(greatest([one, one], [[one, zero], [one, 2 * one]], [one, 3 * one]))
    2
    """
    if any(bound < 0 for bound in bounds):
        raise InputError("linear program: a bound is negative; start from a point that satisfies all")
    # x = u - v with u, v >= 0, and a slack for every row.
    width, count = len(objective), len(rows)
    zero, one = Fraction(0), Fraction(1)
    table = [
        [*row, *(-x for x in row), *(one if i == k else zero for i in range(count)), bound]
        for k, (row, bound) in enumerate(zip(rows, bounds, strict=True))
    ]
    cost = [*(-x for x in objective), *objective, *[zero] * count, zero]
    basis = [2 * width + k for k in range(count)]
    while True:
        column = next((j for j, x in enumerate(cost[:-1]) if x < 0), None)
        if column is None:
            return cost[-1]
        ratios = [(row[-1] / row[column], basis[k], k) for k, row in enumerate(table) if row[column] > 0]
        if not ratios:
            raise InputError("linear program: is not bounded")
        pivot = min(ratios)[2]
        scale = table[pivot][column]
        table[pivot] = [x / scale for x in table[pivot]]
        for k, row in enumerate(table):
            if k != pivot and row[column]:
                table[k] = [x - row[column] * y for x, y in zip(row, table[pivot], strict=True)]
        cost = [x - cost[column] * y for x, y in zip(cost, table[pivot], strict=True)]
        basis[pivot] = column
