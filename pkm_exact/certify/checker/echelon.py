"""The reduced echelon form of an integer matrix over Q, and the proof that it is that.

Of sparse rows: by rational arithmetic. Of the rows with a leading column the shortest one is subtracted from the
others, until what is left is dense.

Of a dense matrix: from its images modulo primes. Let the image modulo each of some primes have the same pivots, r of
them, and call A the matrix, B its columns at the pivots, C the others. Modulo each prime the image's other columns X
fulfil B X = C. If an integer D and a small integer matrix N fulfil N = D X modulo the product M of the primes, M
divides B N - D C; if moreover its entries, estimated, are smaller than M, then B N = D C. So each row of A is, over Q,
a combination of the r rows (D, N), and A has rank r at most; it has rank r at least, as it has so modulo a prime. What
is left of a pivot is 0 modulo M, therefore 0. So these rows, divided by D, are the reduced echelon form.

N is found from as many of the primes as its size asks for; modulo the others it is compared.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from functools import lru_cache
from math import gcd, isqrt, prod
from typing import Final, NamedTuple, TypeAlias

from flint import fmpz, fmpz_mat, nmod_mat

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.residues import centred, combined, images, primes

_COMBINATIONS: Final = 6
"""Combinations of the columns that are looked at for their denominators."""
_REPAIRS: Final = 8
"""Times that a factor is added to a denominator that an entry shows to lack it."""
_SLACK: Final = 16
"""Bits by which a fraction must be smaller than what its residue could tell, both above and below."""

_DENSE: Final = ((64, 3), (32, 2))
"""More rows than these are dense if a shortest one has more than one entry in so many."""

Row: TypeAlias = dict[int, int]
"""Entries by column, none of them 0."""


class Echelon(NamedTuple):
    """Row i has ``denominator`` at the column ``pivots[i]``, ``numerators[i]`` at ``others``, 0 at the other pivots."""

    pivots: list[int]
    others: list[int]
    denominator: int
    numerators: list[list[int]]


class _Images:
    """Images of one matrix modulo primes that agree in the pivots, the best ones known."""

    def __init__(self, rows: int, columns: int) -> None:
        self.shape = rows, columns
        self.pivots: list[int] | None = None
        self.others: list[int] = []
        self.images: list[tuple[int, nmod_mat]] = []
        self.integers: list[tuple[int, fmpz_mat]] = []
        """Those of the images that were needed so far as integers."""
        self.seen: list[tuple[int, fmpz_mat]] = []
        """Some combinations of the entries of each image."""
        self.due = 1
        """With how many images a lifting is tried next."""

    def add(self, p: int, echelon: nmod_mat, rank: int) -> None:
        """Add the echelon form modulo one more prime; p is forgotten, or the others, if it has other pivots."""
        pivots = _staircase(echelon, rank)
        if pivots != self.pivots:
            if self.pivots is not None and (-rank, pivots) > (-len(self.pivots), self.pivots):
                return
            self.pivots, self.others = pivots, sorted(set(range(self.shape[1])) - set(pivots))
            self.images, self.integers, self.seen, self.due = [], [], [], 1
        rows, columns = self.shape
        size = len(self.others)
        charge(rows * columns * size // 3)
        chosen = nmod_mat(columns, size, p)
        for place, column in enumerate(self.others):
            chosen[column, place] = 1
        part = echelon * chosen
        self.images.append((p, part))
        charge(_COMBINATIONS * (2000 + 100 * (rows + size) + rows * size // 2))
        values = [
            int(
                (nmod_mat(1, rows, _weights(rows, base), p) * part * nmod_mat(size, 1, _weights(size, base + 1), p))[
                    0, 0
                ]
            )
            for base in range(3, 3 + 2 * _COMBINATIONS, 2)
        ]
        self.seen.append((p, fmpz_mat(1, _COMBINATIONS, values)))

    def lifted(self, bits: int) -> Echelon | None:
        """The echelon form over Q of a matrix with entries of that many bits, if these primes prove it."""
        count, rank, size = len(self.images), len(self.pivots or ()), len(self.others)
        if count < self.due:
            return None
        self.due = count + count // 8 + 1
        denominator, expected = self._denominator()
        if denominator is None:
            return None
        modulus, flat = prod(p for p, _ in self.images), self._numerators(denominator, expected // 62 + 2)
        for _ in range(_REPAIRS):
            largest = int(max(flat, key=abs, default=0))
            least = (rank * abs(largest) + denominator) << bits
            if least < modulus:
                break
            further = _denominator(largest % modulus, modulus)
            if further == 1:
                self.due = max(self.due, least.bit_length() // 63 + 1)
            if further is None or further == 1:
                return None
            denominator *= further
            charge(rank * size * (600 + 2 * count))
            flat = [centred(value * further, modulus) for value in flat]
        else:
            return None
        entries = [int(value) for value in flat]
        numerators = [entries[start : start + size] for start in range(0, rank * size, size)] if size else [[]] * rank
        return Echelon(self.pivots or [], self.others, denominator, numerators)

    def _denominator(self) -> tuple[int | None, int]:
        """A common denominator of X, seen in a few of its combinations, and the bits of these times it; or None.

        A combination may lack a small prime factor of it, but hardly all.
        """
        modulus, residues = combined(self.seen, 1)
        denominator = 1
        for residue in residues if self.others else ():
            further = _denominator(int(residue * denominator % modulus), modulus)
            if further is None:
                return None, 0
            denominator *= further
        numerators = [centred(residue * denominator, modulus) for residue in residues]
        return denominator, max(int(value.bit_length()) for value in numerators)

    def _numerators(self, denominator: int, few: int) -> list[fmpz]:
        """The residues of D X that are nearest to 0: those from a few images, if the others have the same, or all."""
        if few < len(self.images):
            flat, others = self._lifted_from(few, denominator), self.images[few:]
            rows, size = others[0][1].nrows(), len(self.others)
            matrix = fmpz_mat(rows, size, flat + [0] * (rows * size - len(flat)))
            found = images(matrix, [p for p, _ in others])
            if all(image == part * denominator for (_, image), (_, part) in zip(found, others, strict=True)):
                return flat
        return self._lifted_from(len(self.images), denominator)

    def _lifted_from(self, count: int, denominator: int) -> list[fmpz]:
        """The residues of D X modulo the product of so many of the primes."""
        rank, size = len(self.pivots or ()), len(self.others)
        for p, part in self.images[len(self.integers) : count]:
            charge(400 * rank * size)
            self.integers.append((p, fmpz_mat(rank, size, [int(value) for value in part.entries()[: rank * size]])))
        return combined(self.integers[:count], denominator)[1]


def echelon_form(table: Sequence[Sequence[int]]) -> Echelon:
    """The reduced echelon form of a matrix that is not 0.

    Examples
    --------
    >>> echelon_form([[2, 4, 6], [1, 2, 4]])
    Echelon(pivots=[0, 2], others=[1], denominator=1, numerators=[[2], [0]])
    """
    rows, columns = len(table), len(table[0])
    charge(200 * rows * columns)
    sizes = [abs(value).bit_length() for row in table for value in row if value]
    known = _Images(rows, columns)
    elimination = rows * min(rows, columns) * columns // 3 + 20 * rows * columns
    for p, image in images(fmpz_mat(table), primes()):
        charge(elimination)
        known.add(p, *image.rref())
        found = known.lifted(max(sizes))
        if found is not None:
            return found
    raise AssertionError("there are primes enough")


def reduced_rows(rows: Iterable[Row], known: Container[int] = ()) -> dict[int, Row]:
    """The rows of the reduced echelon form of a sparse matrix by pivot, each times what makes it coprime integers.

    Of pivots that are ``known`` not all are there.

    Examples
    --------
    >>> reduced_rows([{0: 2, 1: 4, 2: 6}, {0: 1, 1: 2, 2: 4}])
    {2: {2: 1}, 0: {0: 1, 1: 2}}
    """
    waiting: dict[int, list[Row]] = {}
    columns: set[int] = set()
    for row in rows:
        columns.update(row)
        _sort_in(waiting, row)
    width = len(columns)
    steps: list[tuple[int, Row]] = []
    needed: set[int] = set()
    while waiting:
        pivot = min(waiting)
        first, *others = sorted(waiting[pivot], key=len)
        number = sum(map(len, waiting.values()))
        if _is_dense(len(first), number, width - pivot):
            break
        del waiting[pivot]
        for other in others:
            _sort_in(waiting, _without(pivot, other, first))
        if pivot in needed or pivot not in known:
            steps.append((pivot, first))
            needed.update(first)
    found = _of_dense([row for group in waiting.values() for row in group])
    for pivot, row in reversed(steps):
        for column in [column for column in row if column in found]:
            row = _without(column, row, found[column])
        found[pivot] = _primitive(row, row[pivot])
    return found


def _is_dense(length: int, number: int, columns: int) -> bool:
    """Whether a shortest row of so many entries, of so many rows with so many columns, says that these are dense."""
    return any(number > many and share * length > columns for many, share in _DENSE)


def _sort_in(waiting: dict[int, list[Row]], row: Row) -> None:
    """Put a row, if it is not 0, to those with the same first column."""
    if row:
        waiting.setdefault(min(row), []).append(row)


def _without(column: int, row: Row, other: Row) -> Row:
    """A multiple of a row minus one of another row, which both have an entry in a column: the least that has none.

    The row itself is used up.
    """
    lead, factor = other[column], row[column]
    common = gcd(lead, factor) if lead > 0 else -gcd(lead, factor)
    scale, factor = lead // common, factor // common
    length = len(row) + len(other)
    if scale != 1:
        row = {place: scale * value for place, value in row.items()}
    for place, value in other.items():
        entry = row.get(place, 0) - factor * value
        if entry:
            row[place] = entry
        else:
            del row[place]
    bits = sum(map(int.bit_length, row.values()))
    charge(500 * length + bits * bits // (600 * (len(row) + 1)))
    return row if scale == 1 else _primitive(row, 1)


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


def _staircase(echelon: nmod_mat, rank: int) -> list[int]:
    """The columns of the pivots of an echelon form."""
    pivots: list[int] = []
    column = 0
    for row in range(rank):
        while not echelon[row, column]:
            column += 1
        pivots.append(column)
    return pivots


@lru_cache(maxsize=64)
def _weights(number: int, base: int) -> list[int]:
    """Numbers without pattern."""
    return [pow(base, 1000 + power, 65537) for power in range(number)]


def _denominator(residue: int, modulus: int) -> int | None:
    """That of the fraction with this residue, if one is clearly smaller than others would be (Wang 1981)."""
    charge(modulus.bit_length() * (300 + modulus.bit_length() // 20))
    bound = isqrt(modulus) >> _SLACK
    older, newer, before, now = modulus, residue, 0, 1
    while newer > bound:
        quotient = older // newer
        older, newer = newer, older - quotient * newer
        before, now = now, before - quotient * now
    return abs(now) if 0 < abs(now) <= bound else None
