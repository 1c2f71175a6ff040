"""The reduced echelon form of an integer matrix over Q.

Of sparse rows, unless they are few and short: by rational arithmetic, as long as that fills few places. A column in
which a row begins is one of the pivots. The one with the fewest entries is eliminated, by its shortest row, whatever
stands on the left of it; rows that begin where no row is asked for need not be reduced any further. What is left is a
dense matrix.

Of a dense matrix: FLINT's. How long that takes depends on how large the numbers in the result are. Where what suffices
for any that there can be is not little, they are estimated before it is begun, from its image modulo a prime and one
combination of its columns, which takes little; nothing else follows from it. Both follow from a digest of the matrix:
none can be made for which they tell too little.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from collections.abc import Set as AbstractSet
from hashlib import sha256
from heapq import heapify, heappop, heappush
from itertools import count
from math import gcd, lcm
from operator import mul
from random import Random
from typing import Final, NamedTuple, TypeAlias

from flint import fmpz, fmpz_mat, nmod_mat

from pkm_exact.certify.checker.budget import charge, limbs

_FILLED: Final = 100
"""A pivot is taken if no more places than these can be filled on account of it."""

_SHORT: Final = 128
"""Bits up to which the entries of a row, on an average, are not divided by what they have in common."""

_LITTLE: Final = 4 * 10**6
"""Operations so few that it is not estimated whether fewer suffice."""

_WORD: Final = 1 << 64
"""Numbers of one word are smaller."""

_SMALL: Final = 200
"""Entries of a matrix of numbers of one word that is taken for a dense one at once: FLINT needs little for it."""

Row: TypeAlias = dict[int, int]
"""Entries by column, none of them 0."""


class Echelon(NamedTuple):
    """Row i has ``denominator`` at the column ``pivots[i]``, ``numerators[i]`` at ``others``, 0 at the other pivots."""

    pivots: list[int]
    others: list[int]
    denominator: int
    numerators: list[list[int]]


def echelon_form(table: Sequence[Sequence[int]]) -> Echelon:
    """The reduced echelon form of a matrix that is not 0.

    Examples
    --------
    >>> echelon_form([[2, 4, 6], [1, 2, 4]])
    Echelon(pivots=[0, 2], others=[1], denominator=2, numerators=[[4], [0]])
    """
    matrix = fmpz_mat(table)
    most = _greatest_cost(table)
    charge(most if most <= _LITTLE else _cost(table, matrix))
    reduced, denominator, rank = matrix.rref()
    pivots = pivots_of(reduced, int(rank))
    others = sorted(set(range(len(table[0]))) - set(pivots))
    numerators = [[int(row[column]) for column in others] for row in reduced.tolist()[: len(pivots)]]
    return Echelon(pivots, others, int(denominator), numerators)


def _greatest_cost(table: Sequence[Sequence[int]]) -> int:
    """Operations that suffice for the echelon form: its entries are minors, which are no larger than all rows allow."""
    rows, columns = len(table), len(table[0])
    rank = min(rows, columns)
    sizes = sorted(max(map(int.bit_length, row)) + rank.bit_length() for row in table)
    words = limbs(sum(sizes[-rank:]))
    primes = 3 + 2 * words  # of about 60 bits each, for a numerator and a denominator
    entries = rows * columns
    modular = primes * (entries * rank // 3 + entries * (50 + 12 * limbs(sizes[-1])) + rank * columns * (100 + primes))
    return modular + rank * entries * words * (30 + words // 8) // 3


def _cost(table: Sequence[Sequence[int]], matrix: fmpz_mat) -> int:
    """Operations for the echelon form, by the size of one combination of its columns, whose own are charged."""
    rows, columns = len(table), len(table[0])
    words = sum(limbs(value.bit_length()) for row in table for value in row if value)
    elimination = rows * min(rows, columns) * columns // 3 + 50 * rows * columns
    charge(2 * elimination + 300 * rows * columns + 60 * words)
    random = Random(_digest(table))
    image = nmod_mat(matrix, next(p for p in count(1 << 62 | random.getrandbits(62)) if fmpz(p).is_prime()))
    chosen, pivots = (pivots_of(*part.rref()) for part in (image.transpose(), image))
    rank = len(pivots)
    weights = [0 if column in pivots else 1 + random.getrandbits(30) for column in range(columns)]
    square = [[table[row][column] for column in pivots] for row in chosen]
    sizes = [max(map(int.bit_length, row)) + rank.bit_length() for row in square]
    charge(rank**3 + (1 + sum(sizes) // 30) * rank * (2 * rank + sum(map(limbs, sizes))))
    sums = fmpz_mat(rank, 1, [sum(map(mul, weights, table[row])) for row in chosen])
    found = fmpz_mat(square).solve(sums).entries()
    heights = [int(value.height_bits()) for value in found]
    bits = lcm(*(int(value.q) for value in found)).bit_length() + max(heights, default=0)
    if rank < columns and min(rows, columns) <= 40:  # FLINT may go by minors then, however small the result is
        charge(rank * rows * columns * limbs(sum(sizes)) * (30 + limbs(sum(sizes)) // 8) // 3)
    primes = 2 + bits // 60  # of about so many bits each
    return primes * (elimination + 12 * words + min(rows, columns) * columns * (100 + primes))


def _digest(table: Sequence[Sequence[int]]) -> int:
    return int.from_bytes(sha256(";".join(",".join(map(hex, row)) for row in table).encode("ascii")).digest(), "big")


def pivots_of(echelon: nmod_mat | fmpz_mat, rank: int) -> list[int]:
    """The columns of the pivots of an echelon form."""
    pivots: list[int] = []
    column = 0
    for row in range(rank):
        while not echelon[row, column]:
            column += 1
        pivots.append(column)
    return pivots


def reduced_rows(rows: Iterable[Row], known: AbstractSet[int] = frozenset()) -> dict[int, Row]:
    """The rows of the reduced echelon form of a sparse matrix by pivot, each times what makes it coprime integers.

    No row is 0. Of pivots that are ``known`` not all need be there.

    Examples
    --------
    >>> reduced_rows([{0: 2, 1: 4, 2: 6}, {0: 1, 1: 2, 2: 4}])
    {0: {0: 1, 1: 2}, 2: {2: 1}}
    """
    listed = list(rows)
    if _are_few_and_short(listed):
        return _of_dense(listed)
    sparse = _Sparse(listed)
    steps = sparse.steps(known)
    found = _of_dense(sparse.left())
    # What is left has no entries in the columns of steps; where some are known, these are known.
    for pivot, row in reversed([] if known else steps):
        for column in [column for column in row if column in found]:
            row, _, _ = _without(column, row, found[column])
        found[pivot] = _primitive(row, row[pivot])
    return found


def _are_few_and_short(rows: Sequence[Row]) -> bool:
    return len(rows) * len(set().union(*rows)) <= _SMALL and all(
        -_WORD < value < _WORD for row in rows for value in row.values()
    )


class _Sparse:
    """Rows with the places of their entries, column by column, and the columns in which they begin."""

    def __init__(self, rows: list[Row]) -> None:
        self._rows = rows
        self._places: dict[int, set[int]] = {}
        for place, row in enumerate(rows):
            for column in row:
                self._places.setdefault(column, set()).add(place)
        self._leads = {place: min(row) for place, row in enumerate(rows)}
        self._waiting = [(len(self._places[column]), column) for column in set(self._leads.values())]
        heapify(self._waiting)

    def left(self) -> list[Row]:
        """The rows that no step has used up."""
        return [self._rows[place] for place in self._leads]

    def steps(self, known: AbstractSet[int]) -> list[tuple[int, Row]]:
        """Eliminate columns that a row begins in, of the known ones if any are known: the columns and their rows."""
        found: list[tuple[int, Row]] = []
        while self._waiting:
            number, column = heappop(self._waiting)
            there = self._places.get(column, set())
            charge(2000 + 500 * len(there))
            if len(there) > number:  # others have come since
                heappush(self._waiting, (len(there), column))
            elif there and (not known or column in known):
                chosen = min(there, key=lambda place: (len(self._rows[place]), place))
                if (len(there) - 1) * (len(self._rows[chosen]) - 1) <= _FILLED:
                    found.append((column, self._rows[chosen]))
                    self._eliminate(column, chosen)
        return found

    def _eliminate(self, column: int, chosen: int) -> None:
        """Subtract a row from all others with an entry in a column."""
        first = self._rows[chosen]
        del self._leads[chosen]
        places = self._places
        for other in first:
            places[other].discard(chosen)
        there, places[column] = places[column], set()
        for place in there:
            row, new, gone = _without(column, self._rows[place], first)
            self._rows[place] = row
            for other in new:
                places[other].add(place)
            for other in gone:
                places[other].discard(place)
            self._begin(place, row)

    def _begin(self, place: int, row: Row) -> None:
        """Note where a row begins, if it is not 0."""
        before = self._leads.pop(place)
        if row:
            self._leads[place] = lead = min(row)
            if lead != before:
                heappush(self._waiting, (len(self._places[lead]), lead))


def _without(column: int, row: Row, other: Row) -> tuple[Row, list[int], list[int]]:
    """A multiple of a row minus one of another row, which both have an entry in a column: one that has none.

    With the columns in which it has an entry and the row had none, and those that lost theirs. The row itself is used
    up. What is done takes little beside what led to the entries, and is charged for at once.
    """
    lead, factor = other[column], row[column]
    common = gcd(lead, factor)
    scale, multiple = lead // common, factor // common
    if scale < 0:
        scale, multiple = -scale, -multiple
    if scale != 1:
        row = {place: scale * value for place, value in row.items()}
    new, gone = [], []
    before = row.get
    for place, value in other.items():
        entry = before(place)
        if entry is None:
            row[place] = -multiple * value
            new.append(place)
        elif entry := entry - multiple * value:
            row[place] = entry
        else:
            del row[place]
            gone.append(place)
    bits = sum(map(int.bit_length, row.values()))
    charge(
        500 * (len(row) + len(other))
        + lead.bit_length() * factor.bit_length() // 750
        + bits * bits // (600 * (len(row) + 1))
    )
    is_short = bits <= _SHORT * len(row)
    return row if scale == 1 or is_short else _primitive(row, 1), new, gone


def _primitive(row: Row, sign: int) -> Row:
    """The row divided by what its entries have in common, and by a sign."""
    content = gcd(*row.values())
    if sign < 0:
        content = -content
    return row if content in (0, 1) else {column: value // content for column, value in row.items()}


def _of_dense(rows: Sequence[Row]) -> dict[int, Row]:
    """The same form of rows that are dense."""
    columns = sorted({column for row in rows for column in row})
    if not columns:
        return {}
    form = echelon_form([[row.get(column, 0) for column in columns] for row in rows])
    others = [columns[place] for place in form.others]
    found = {}
    for pivot, numerators in zip(form.pivots, form.numerators, strict=True):
        entries = {column: value for column, value in zip(others, numerators, strict=True) if value}
        found[columns[pivot]] = _primitive({columns[pivot]: form.denominator, **entries}, form.denominator)
    return found
