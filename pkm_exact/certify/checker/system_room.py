"""How many solutions there can be: degrees, and ranks modulo a prime of what homogeneous polynomials leave.

dim A_t, A the polynomials modulo homogeneous ones, is the number of monomials less the rank of an integer matrix:
modulo a prime it is
no smaller than over Q. A_(t+1) is spanned by symbols x_i a, a in a basis of A_t, with the relations x_i (x_j c) = x_j
(x_i c) and the polynomials of degree t + 1.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from itertools import combinations, count, islice
from math import prod
from typing import Final

from flint import fmpz, nmod_mat

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.echelon import pivots_of
from pkm_exact.certify.checker.system_terms import Monomial, Terms, degree
from pkm_exact.certify.checker.verdict import MAX_ELIMINATION_ENTRIES

MOST_SOLUTIONS: Final = 2000
MOST_IN_SPACE: Final = 20_000
LAST_DEGREE: Final = 200
_ATTEMPTS: Final = 3


def bezout_number(polynomials: Sequence[Terms], size: int) -> int | None:
    """The product of the greatest degrees, as many as variables; None if there are fewer polynomials."""
    degrees = sorted(map(degree, polynomials), reverse=True)
    return prod(degrees[:size]) if len(degrees) >= size else None


def multihomogeneous_number(polynomials: Sequence[Terms], groups: Sequence[Sequence[int]]) -> int | None:
    """That of as many polynomials as variables; None if they are not as many."""
    sizes = tuple(map(len, groups))
    if len(polynomials) != sum(sizes):
        return None
    counts = {(0,) * len(groups): 1}
    for polynomial in polynomials:
        charge(len(groups) * (2000 * len(polynomial) + 3000 * len(counts)))
        degrees = [max(sum(monomial[k] for k in group) for monomial in polynomial) for group in groups]
        following: dict[tuple[int, ...], int] = {}
        for key, value in counts.items():
            for place, number in enumerate(degrees):
                if number and key[place] < sizes[place]:
                    larger = (*key[:place], key[place] + 1, *key[place + 1 :])
                    following[larger] = following.get(larger, 0) + value * number
        counts = following
    return counts.get(sizes, 0)


def room(size: int, forms: Sequence[Mapping[Monomial, int]], most: int) -> int | None:
    """The dimension of what homogeneous polynomials leave, a bound for that over Q; None if it is not found."""
    for p in islice(_primes_from(forms), _ATTEMPTS):
        found = _room_modulo(size, forms, most, p)
        if found is not None:
            return found
    return None


def _primes_from(forms: Sequence[Mapping[Monomial, int]]) -> Iterator[int]:
    """Primes of 62 bits that follow from the polynomials: none can be built on them."""
    sizes = sum(len(form) for form in forms)
    charge(sizes * 5000)
    spelled = ";".join(f"{monomial}:{value:x}" for form in forms for monomial, value in sorted(form.items()))
    for number in count():
        digest = sha256(f"{number};{spelled}".encode()).digest()
        candidate = 1 << 61 | int.from_bytes(digest[:8]) >> 3 | 1
        while not fmpz(candidate).is_prime():
            candidate += 2
        yield candidate


def _room_modulo(size: int, forms: Sequence[Mapping[Monomial, int]], most: int, p: int) -> int | None:
    by_degree: dict[int, list[Mapping[Monomial, int]]] = {}
    charge(3000 * sum(map(len, forms)))
    for form in forms:
        image = {monomial: value % p for monomial, value in form.items() if value % p}
        if image:
            by_degree.setdefault(degree(image), []).append(image)
    if 0 in by_degree:
        return 0
    general = _general(size, sorted((number for number, images in by_degree.items() for _ in images), reverse=True))
    parts = _Parts(size, p)
    total = 1
    while True:
        if not parts.extend(by_degree.get(parts.degree + 1, ())):
            return None
        if not parts.dimension:
            return total
        if parts.dimension > (general[parts.degree] if parts.degree < len(general) else 0):
            return None
        total += parts.dimension
        if total > most or parts.degree > LAST_DEGREE:
            return None


def _general(size: int, degrees: Sequence[int]) -> list[int]:
    """What general polynomials of the greatest degrees, as many as unknowns, leave in each degree; [] if too few.

    If what is left has finite dimension, such combinations of the polynomials are a regular sequence, and leave no
    less: a part that is larger shows that it has not.
    """
    if len(degrees) < size:
        return []
    series = [1]
    for number in degrees[:size]:
        charge(1000 * len(series) * number)
        longer = [0] * (len(series) + number - 1)
        for place, value in enumerate(series):
            for step in range(number):
                longer[place + step] += value
        series = longer
    return series


class _Parts:
    """A_0, A_1, .. up to a degree: the dimension of the last, and the matrices of all unknowns into each."""

    def __init__(self, size: int, p: int) -> None:
        self.p = p
        self.size = size
        self.degree = 0
        self.dimension = 1
        self.used = list(range(size))
        """Unknowns that linear forms do not express by others: their symbols suffice."""
        self.others: dict[int, list[int]] = {}
        self.into: list[list[nmod_mat]] = []

    def extend(self, forms: Sequence[Mapping[Monomial, int]]) -> bool:
        """Go to the next degree, in which there are these polynomials; false if a matrix would be too large."""
        width, below = self.dimension, self.into[-1][0].nrows() if self.into else 0
        columns = len(self.used) * width
        rows = len(self.used) * (len(self.used) - 1) // 2 * below + len(forms)
        if rows * columns > MAX_ELIMINATION_ENTRIES:
            return False
        charge(
            3000 * sum(map(len, forms)) * (1 + width) + 400 * rows * columns + rows * columns * min(rows, columns) // 3
        )
        relations = [*self._commuting(), *map(self._row, forms)]
        matrix = nmod_mat(len(relations), columns, self.p)
        for number, relation in enumerate(relations):
            for column, value in relation.items():
                matrix[number, column] = value
        echelon, rank = matrix.rref()
        pivots = pivots_of(echelon, rank)
        place = {pivot: row for row, pivot in enumerate(pivots)}
        free = [column for column in range(columns) if column not in place]
        charge(400 * columns * (len(free) + 1))

        def image(symbol: int) -> list[int]:
            if symbol in place:
                return [-int(echelon[place[symbol], column]) % self.p for column in free]
            return [int(column == symbol) for column in free]

        tables = [[image(block * width + a) for a in range(width)] for block in range(len(self.used))]
        if self.degree == 0:
            self.others = {axis: tables[axis][0] for axis in range(self.size) if axis in place}
            tables = [tables[axis] for axis in free]
            self.used = free
        self._complete([nmod_mat(width, len(free), [v for row in table for v in row], self.p) for table in tables])
        self.dimension = len(free)
        self.degree += 1
        return True

    def _complete(self, matrices: Sequence[nmod_mat]) -> None:
        """The matrices of all unknowns from those whose symbols are used."""
        found = dict(zip(self.used, matrices, strict=True))
        zero = nmod_mat(self.dimension, matrices[0].ncols() if matrices else 0, self.p)
        for axis, weights in self.others.items():
            found[axis] = sum((w * matrix for w, matrix in zip(weights, matrices, strict=True)), zero)
        self.into.append([found[axis] for axis in range(self.size)])

    def _commuting(self) -> list[dict[int, int]]:
        """The relations x_i (x_j c) = x_j (x_i c)."""
        if not self.into:
            return []
        width = self.dimension
        tables = [
            [[(c, int(v)) for c, v in enumerate(row) if v] for row in self.into[-1][axis].tolist()]
            for axis in self.used
        ]
        relations = []
        for i, j in combinations(range(len(self.used)), 2):
            for left, right in zip(tables[i], tables[j], strict=True):
                relation = {i * width + c: value for c, value in right}
                relation.update({j * width + c: -value % self.p for c, value in left})
                relations.append(relation)
        return relations

    def _row(self, form: Mapping[Monomial, int]) -> dict[int, int]:
        """A polynomial of the next degree on the symbols."""
        width = self.dimension
        total: dict[int, int] = {}
        for monomial, value in form.items():
            axis = next(i for i, exponent in enumerate(monomial) if exponent)
            vector = self._vector((*monomial[:axis], monomial[axis] - 1, *monomial[axis + 1 :]))
            blocks = self.others.get(axis)
            weights = [(self.used.index(axis), 1)] if blocks is None else list(enumerate(blocks))
            for block, weight in weights:
                for column, entry in enumerate(vector):
                    place = block * width + column
                    total[place] = (total.get(place, 0) + value * weight * entry) % self.p
        return total

    def _vector(self, monomial: Monomial) -> list[int]:
        """The coordinates of a monomial in the last part."""
        vector = nmod_mat(1, 1, [1], self.p)
        reached = 0
        for axis, exponent in enumerate(monomial):
            for _ in range(exponent):
                matrix = self.into[reached][axis]
                charge(2000 + matrix.nrows() * matrix.ncols() * 2)
                vector = vector * matrix
                reached += 1
        return [int(entry) for entry in vector.entries()]
