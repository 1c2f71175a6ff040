"""The reduced echelon form of an integer matrix over Q, from its images modulo primes, and the proof that it is that.

Let the image modulo each of some primes have the same pivots, r of them, and call A the matrix, B its columns at the
pivots, C the others. Modulo each prime the image's other columns X fulfil B X = C. If an integer D and a small integer
matrix N fulfil N = D X modulo the product M of the primes, M divides B N - D C; if moreover its entries, estimated, are
smaller than M, then B N = D C. So each row of A is, over Q, a combination of the r rows (D, N), and A has rank r at
most; it has rank r at least, as it has so modulo a prime. What is left of a pivot is 0 modulo M, therefore 0. So these
rows, divided by D, are the reduced echelon form.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isqrt, prod
from typing import Final, NamedTuple

from flint import fmpz, fmpz_mat, nmod_mat

from pkm_exact.certify.checker.budget import charge, limbs

_FIRST: Final = (1 << 63) - 25
_COMBINATIONS: Final = 6
"""Combinations of the columns that are looked at for their denominators."""
_REPAIRS: Final = 8
"""Times that a factor is added to a denominator that an entry shows to lack it."""
_BLOCK: Final = 8
"""Residues modulo so many primes are combined first."""
_SLACK: Final = 16
"""Bits by which a fraction must be smaller than what its residue could tell, both above and below."""


class Echelon(NamedTuple):
    """Row i has ``denominator`` at the column ``pivots[i]``, ``numerators[i]`` at ``others``, 0 at the other pivots."""

    pivots: list[int]
    others: list[int]
    denominator: int
    numerators: list[list[int]]


class _Images:
    """Images of one matrix modulo primes that agree in the pivots, the best ones known."""

    def __init__(self, matrix: fmpz_mat) -> None:
        self.shape = matrix.nrows(), matrix.ncols()
        self.pivots: list[int] | None = None
        self.others: list[int] = []
        self.images: list[tuple[int, nmod_mat]] = []
        self.base = 1

    def add(self, p: int, echelon: nmod_mat, rank: int) -> None:
        """Add the echelon form modulo one more prime; p is forgotten, or the others, if it has other pivots."""
        pivots = _staircase(echelon, rank)
        if pivots != self.pivots:
            if self.pivots is not None and (-rank, pivots) > (-len(self.pivots), self.pivots):
                return
            self.pivots, self.others = pivots, sorted(set(range(self.shape[1])) - set(pivots))
            self.images = []
        rows, columns = self.shape
        charge(rows * columns * len(self.others) // 3)
        chosen = nmod_mat(columns, len(self.others), p)
        for place, column in enumerate(self.others):
            chosen[column, place] = 1
        self.images.append((p, echelon * chosen))

    def lifted(self, bits: int) -> Echelon | None:
        """The echelon form over Q of a matrix with entries of that many bits, if these primes prove it."""
        rank, size = len(self.pivots or ()), len(self.others)
        denominator = self._denominator()
        if denominator is None:
            return None
        words = limbs(63 * len(self.images))
        charge(rank * size * len(self.images) * (600 + words // 5))
        parts = [(p, [int(value) for value in part.entries()[: rank * size]]) for p, part in self.images]
        blocks = [_combined(parts[start : start + _BLOCK]) for start in range(0, len(parts), _BLOCK)]
        modulus, flat = _combined(blocks, denominator)
        flat = _centred(flat, modulus)
        for _ in range(_REPAIRS):
            largest = max(flat, key=abs, default=0)
            if (rank * abs(largest) + denominator) << bits < modulus:
                break
            further = _denominator(largest % modulus, modulus)
            if further is None or further == 1:
                return None
            denominator *= further
            charge(rank * size * (600 + 2 * words))
            flat = _centred([value * further % modulus for value in flat], modulus)
        else:
            return None
        numerators = [flat[start : start + size] for start in range(0, rank * size, size)] if size else [[]] * rank
        return Echelon(self.pivots or [], self.others, denominator, numerators)

    def _denominator(self) -> int | None:
        """A common denominator of X, seen in a few of its combinations; other ones each time. None if it is too large.

        A combination may lack a small prime factor of it, but hardly all.
        """
        rows, columns = self.images[0][1].nrows(), len(self.others)
        denominator = 1
        for _ in range(_COMBINATIONS if columns else 0):
            charge(len(self.images) * (2000 + 100 * (rows + columns) + rows * columns // 2))
            self.base += 2
            left, right = _weights(rows, self.base), _weights(columns, self.base + 1)
            values = [
                (p, [int((nmod_mat(1, rows, left, p) * part * nmod_mat(columns, 1, right, p))[0, 0])])
                for p, part in self.images
            ]
            modulus, (residue,) = _combined(values, denominator)
            further = _denominator(residue, modulus)
            if further is None:
                return None
            denominator *= further
        return denominator


def _centred(values: Sequence[int], modulus: int) -> list[int]:
    """The residues that are nearest to 0."""
    return [value - modulus if 2 * value > modulus else value for value in values]


def _combined(parts: Sequence[tuple[int, Sequence[int]]], factor: int = 1) -> tuple[int, list[int]]:
    """Residues modulo the product of coprime numbers, times a factor, from those modulo each (Chinese remainders)."""
    modulus = prod(p for p, _ in parts)
    charge(len(parts) * 8 * limbs(modulus.bit_length()) ** 2)
    total = [0] * len(parts[0][1])
    for p, values in parts:
        cofactor = modulus // p
        weight = cofactor * pow(cofactor, -1, p) * factor % modulus
        total = [old + weight * value for old, value in zip(total, values, strict=True)]
    return modulus, [value % modulus for value in total]


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
    matrix, images = fmpz_mat(table), _Images(fmpz_mat(table))
    reduction = 6 * rows * columns + 12 * sum(map(limbs, sizes))
    elimination = rows * min(rows, columns) * columns // 3 + 20 * rows * columns
    due = 1
    for p in primes():
        charge(reduction + elimination)
        images.add(p, *nmod_mat(matrix, p).rref())
        if len(images.images) >= due:
            due += due // 8 + 1
            found = images.lifted(max(sizes))
            if found is not None:
                return found
    raise AssertionError("there are primes enough")


def primes() -> Iterator[int]:
    """Primes below 2^63, decreasing."""
    candidate = _FIRST
    while True:
        if fmpz(candidate).is_prime():
            yield candidate
        candidate -= 2


def _staircase(echelon: nmod_mat, rank: int) -> list[int]:
    """The columns of the pivots of an echelon form."""
    pivots: list[int] = []
    column = 0
    for row in range(rank):
        while not echelon[row, column]:
            column += 1
        pivots.append(column)
    return pivots


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
