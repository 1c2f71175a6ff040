"""Echelon forms over Q: of few rows, and of a reduction step's many sparse rows, of which only the new are wanted.

As modulo a prime (``reduction``), one row for every leading monomial that occurs is a reducer. Rows of elimination
matrices are sparse: the others, reduced by hand, are left as a small dense matrix S without the reducers' leading
monomials, and the rows of its reduced echelon form are those of the whole matrix's that have new leading monomials. If
the trace is right about the pivots P, that echelon form is S_P^-1 S: a linear system, solved exactly.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from heapq import heapify, heappop, heappush
from math import gcd
from typing import TypeAlias, cast

from flint import fmpq_mat, fmpz_mat

ExactPolynomial: TypeAlias = tuple[tuple[int, int], ...]
"""Packed monomials in decreasing order, each with its integer coefficient; the coefficients are coprime."""


def echelon_form(polynomials: Sequence[ExactPolynomial]) -> list[ExactPolynomial]:
    """The reduced row echelon form over Q, each row cleared to coprime integers, largest leading monomial first.

    Examples
    --------
    >>> echelon_form([((2, 1), (1, 1)), ((2, 1), (0, 3))])
    [((2, 1), (0, 3)), ((1, 1), (0, -3))]
    """
    columns = sorted({monomial for polynomial in polynomials for monomial, _ in polynomial}, reverse=True)
    if not columns:
        return []
    echelon, _, rank = _matrix(polynomials, columns).rref()
    pivots: list[int] = []
    for row in range(rank):
        first = pivots[-1] + 1 if pivots else 0
        pivots.append(next(column for column in range(first, len(columns)) if echelon[row, column]))
    taken = set(pivots)
    others = [column for column in range(len(columns)) if column not in taken]
    return [
        _primitive(
            columns[pivot], int(echelon[row, pivot]), [(columns[k], int(echelon[row, k])) for k in others if k > pivot]
        )
        for row, pivot in enumerate(pivots)
    ]


def exact_new_rows(rows: Sequence[ExactPolynomial], expected: Collection[int]) -> list[ExactPolynomial]:
    """The rows of the reduced row echelon form over Q whose leading monomials no given row has, largest first.

    Parameters
    ----------
    rows : sequence of ExactPolynomial
    expected : collection of int
        Leading monomials that the echelon form is believed to have: if they are right, the way is shorter.

    Examples
    --------
    >>> exact_new_rows([((3, 1), (1, 1)), ((3, 1), (2, 1)), ((2, 2), (0, 1))], {3, 2, 1})
    [((1, 2), (0, 1))]
    """
    reducers, others = _split(rows)
    left = [row for row in (_reduced(other, reducers) for other in others) if row]
    pivots = sorted((monomial for monomial in expected if monomial not in reducers), reverse=True)
    found = _solved(left, pivots) if len(pivots) == len(left) else None
    return echelon_form(left) if found is None else found


def _split(rows: Sequence[ExactPolynomial]) -> tuple[dict[int, ExactPolynomial], list[ExactPolynomial]]:
    """The shortest row for every leading monomial, and all others."""
    reducers: dict[int, ExactPolynomial] = {}
    others = []
    for row in rows:
        known = reducers.get(row[0][0])
        if known is None or len(row) < len(known):
            reducers[row[0][0]] = row
        if known is not None:
            others.append(max(row, known, key=len))
    return reducers, others


def _reduced(row: ExactPolynomial, reducers: Mapping[int, ExactPolynomial]) -> ExactPolynomial:
    """A multiple of the row minus multiples of reducers, without their leading monomials; its integers are coprime."""
    values = dict(row)
    waiting = [-monomial for monomial in values if monomial in reducers]
    heapify(waiting)
    while waiting:
        lead = -heappop(waiting)
        value = values[lead]
        if not value:
            continue
        reducer = reducers[lead]
        common = gcd(value, reducer[0][1])
        scale, factor = reducer[0][1] // common, value // common
        if scale != 1:
            values = {monomial: scale * entry for monomial, entry in values.items()}
        for monomial, entry in reducer:
            if monomial not in values and monomial in reducers:
                heappush(waiting, -monomial)
            values[monomial] = values.get(monomial, 0) - factor * entry
    content = gcd(*values.values())
    return tuple(
        (monomial, values[monomial] // content) for monomial in sorted(values, reverse=True) if values[monomial]
    )


def _solved(rows: Sequence[ExactPolynomial], pivots: Sequence[int]) -> list[ExactPolynomial] | None:
    """The reduced row echelon form if these are its leading monomials, or None."""
    places = set(pivots)
    others = sorted({monomial for row in rows for monomial, _ in row if monomial not in places}, reverse=True)
    if not rows:
        return []
    bound, free = _matrix(rows, pivots), _matrix(rows, others)
    try:
        numerators, denominator = cast(fmpq_mat, bound.solve(free)).numer_denom()
    except ZeroDivisionError:
        return None
    entries = [int(value) for value in numerators.entries()]
    width = len(others)
    found = []
    for row, pivot in enumerate(pivots):
        tail = list(zip(others, entries[row * width : (row + 1) * width], strict=True))
        if any(value and monomial > pivot for monomial, value in tail):
            return None
        found.append(_primitive(pivot, int(denominator), tail))
    return found


def _matrix(rows: Sequence[ExactPolynomial], columns: Sequence[int]) -> fmpz_mat:
    """The rows on some monomials; only what is not 0 costs time."""
    place = {monomial: number for number, monomial in enumerate(columns)}
    matrix = fmpz_mat(len(rows), len(columns))
    for number, row in enumerate(rows):
        for monomial, value in row:
            column = place.get(monomial)
            if column is not None:
                matrix[number, column] = value
    return matrix


def _primitive(lead: int, value: int, tail: Sequence[tuple[int, int]]) -> ExactPolynomial:
    """The polynomial with coprime coefficients and a positive leading one; terms that are 0 are left out."""
    content = gcd(value, *(entry for _, entry in tail))
    content = content if value > 0 else -content
    return (lead, value // content), *((monomial, entry // content) for monomial, entry in tail if entry)
