"""What the matrix of a reduction step adds: the rows of its echelon form whose leading monomial is a new one.

Rows are multiples of known polynomials. One row for every leading monomial that occurs is a reducer; with the columns
ordered suitably the reducers are a unit upper triangular block A, next to a block B of the other columns, and the
remaining rows C, D below. Only D - C A^-1 B need be brought to echelon form (Faugere and Lachartre, "Parallel Gaussian
elimination for Groebner bases computations in finite fields", PASCO 2010). Most of the remaining rows depend on each
other, so random combinations of them serve as well, if there are more combinations than the rank that is found.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from random import Random

from flint import nmod_mat

from pkm_exact.algebra.system import ModularPolynomial
from pkm_exact.digests import digest

Row = tuple[int, int]
"""A row of a reduction matrix: index of a basis element and the monomial that multiplies it."""

BLOCK = 48
"""Reducers eliminated at a time."""
FIRST_COMBINATIONS = 24
"""Random combinations of rows tried first."""
SPARE_COMBINATIONS = 4
"""Combinations beyond the rank: that they miss some of the rows' span is as good as impossible."""
RANDOM_BITS = 30
"""Size of the coefficients of the combinations."""


def new_rows(rows: Sequence[Row], known: Sequence[ModularPolynomial], prime: int) -> list[ModularPolynomial]:
    """The rows of the reduced row echelon form whose leading monomials no given row has, largest first.

    Examples
    --------
    >>> new_rows([(0, 0), (1, 0), (2, 0)], [([3, 1], [1, 1]), ([3, 2], [1, 2]), ([2, 0], [1, 1])], 7)
    [([1, 0], [1, 2])]
    """
    reducers, others = _split(rows, known)
    if not others:
        return []
    elimination = _Elimination(reducers, others, known, prime)
    for combined in _combinations(len(others), prime):
        found = elimination.reduced(combined)
        if combined is None or len(found) + SPARE_COMBINATIONS <= combined.nrows():
            break
    return found


def reducing_rows(rows: Sequence[Row], known: Sequence[ModularPolynomial], prime: int) -> list[Row]:
    """As few of the rows as have the same row space: a reducer for every leading monomial, and what is new then.

    Examples
    --------
    >>> reducing_rows([(0, 0), (1, 0), (2, 0)], [([3, 1], [1, 1]), ([3, 1], [1, 1]), ([2, 0], [1, 1])], 7)
    [(0, 0), (2, 0)]
    """
    reducers, others = _split(rows, known)
    left = _Elimination(reducers, others, known, prime).left(None) if others else None
    independent = [] if left is None else row_echelon(left.transpose())[1]
    return [*reducers.values(), *(others[place] for place in independent)]


def row_echelon(matrix: nmod_mat) -> tuple[nmod_mat, list[int]]:
    """Reduced row echelon form and the columns of its pivots."""
    reduced, rank = matrix.rref()
    pivots = []
    column = 0
    for row in range(rank):
        while not reduced[row, column]:
            column += 1
        pivots.append(column)
        column += 1
    return reduced, pivots


def row_matrix(rows: Sequence[Row], known: Sequence[ModularPolynomial], columns: Sequence[int], prime: int) -> nmod_mat:
    """The matrix of the rows on the given monomials; only its non-zero entries cost time."""
    position = {monomial: index for index, monomial in enumerate(columns)}
    matrix = nmod_mat(len(rows), len(columns), prime)
    for number, (index, multiplier) in enumerate(rows):
        for monomial, coefficient in zip(*known[index], strict=True):
            matrix[number, position[monomial + multiplier]] = coefficient
    return matrix


def read_row(matrix: nmod_mat, row: int, columns: Sequence[int], start: int) -> ModularPolynomial:
    """A row as a polynomial; its entries before ``start`` are 0."""
    monomials = []
    coefficients = []
    for column in range(start, len(columns)):
        value = int(matrix[row, column])
        if value:
            monomials.append(columns[column])
            coefficients.append(value)
    return monomials, coefficients


def _split(rows: Sequence[Row], known: Sequence[ModularPolynomial]) -> tuple[dict[int, Row], list[Row]]:
    """The shortest row for every leading monomial, and all others."""
    reducers: dict[int, Row] = {}
    others = []
    for row in rows:
        lead = known[row[0]][0][0] + row[1]
        if lead not in reducers:
            reducers[lead] = row
        elif len(known[row[0]][0]) < len(known[reducers[lead][0]][0]):
            others.append(reducers[lead])
            reducers[lead] = row
        else:
            others.append(row)
    return reducers, others


def _combinations(count: int, prime: int) -> Iterator[nmod_mat | None]:
    """Matrices of random combinations of ``count`` rows, more and more, and at last None for the rows themselves."""
    random = Random(digest(prime, count))
    size = FIRST_COMBINATIONS
    while 2 * size < count:
        yield nmod_mat(size, count, [random.getrandbits(RANDOM_BITS) for _ in range(size * count)], prime)
        size *= 2
    yield None


class _Elimination:
    """Reducers and remaining rows in blocks of columns: blocks of leading monomials, then all other monomials."""

    def __init__(
        self, reducers: dict[int, Row], others: Sequence[Row], known: Sequence[ModularPolynomial], prime: int
    ) -> None:
        self.prime = prime
        leads = sorted(reducers, reverse=True)
        rows = [reducers[lead] for lead in leads]
        occurring = {monomial + multiplier for index, multiplier in (*rows, *others) for monomial in known[index][0]}
        self.columns = sorted(occurring - reducers.keys(), reverse=True)
        self.place = {lead: divmod(number, BLOCK) for number, lead in enumerate(leads)}
        blocks = -(-len(leads) // BLOCK)
        self.place |= {monomial: (blocks, number) for number, monomial in enumerate(self.columns)}
        self.widths = [min(BLOCK, len(leads) - start) for start in range(0, len(leads), BLOCK)] + [len(self.columns)]
        self.upper = [self._blocks(rows[start : start + BLOCK], known) for start in range(0, len(leads), BLOCK)]
        self.lower = self._blocks(others, known)
        self.inverses = [blocks[number].inv() for number, blocks in enumerate(self.upper)]

    def _blocks(self, rows: Sequence[Row], known: Sequence[ModularPolynomial]) -> dict[int, nmod_mat]:
        """The rows, cut into blocks of columns; blocks of zeros are left out."""
        place = self.place
        blocks: dict[int, nmod_mat] = {}
        for number, (index, multiplier) in enumerate(rows):
            for monomial, coefficient in zip(*known[index], strict=True):
                block, column = place[monomial + multiplier]
                if block not in blocks:
                    blocks[block] = nmod_mat(len(rows), self.widths[block], self.prime)
                blocks[block][number, column] = coefficient
        return blocks

    def reduced(self, combinations: nmod_mat | None) -> list[ModularPolynomial]:
        """What is left of the remaining rows, or of combinations of them, in reduced row echelon form."""
        left = self.left(combinations)
        if left is None:
            return []
        echelon, pivots = row_echelon(left)
        return [read_row(echelon, row, self.columns, pivot) for row, pivot in enumerate(pivots)]

    def left(self, combinations: nmod_mat | None) -> nmod_mat | None:
        """What is left of the remaining rows, or of combinations of them, on ``columns``; None if that is nothing."""
        left = self.lower
        if combinations is not None:
            left = {number: combinations * block for number, block in left.items()}
        left = dict(left)
        for number, (blocks, inverse) in enumerate(zip(self.upper, self.inverses, strict=True)):
            if number not in left:
                continue
            factor = left.pop(number) * inverse
            for other, block in blocks.items():
                if other > number:
                    product = factor * block
                    left[other] = left[other] - product if other in left else -product
        return left.get(len(self.upper))
