"""The algebra that an elimination defines: how many distinct solutions it has, and how multiple they are.

On the monomials that an elimination leaves, multiplication by each unknown has a matrix over Q, read off the elements.
If these matrices commute, exactly, they define an algebra with these monomials as a basis, whose solutions include
every pose (Mourrain 1999). The number of its distinct solutions is the rank of its trace form (Hermite). If all
elements, evaluated by the matrices, are 0 in it, it is the algebra of the poses, and their multiplicities sum to its
dimension: multiplication by a combination of unknowns has its values at the poses as eigenvalues, as often as these are
multiple (Stickelberger).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

from flint import fmpz, fmpz_mat, nmod_mat, nmod_poly

from pkm_exact.certify.checker.budget import charge, limbs
from pkm_exact.certify.checker.echelon import echelon_form
from pkm_exact.certify.checker.elimination import Elimination, shifted
from pkm_exact.certify.checker.packed_monomials import Monomial, Polynomial


@dataclass(frozen=True, eq=False)
class _Fractions:
    """A matrix of rationals in lowest terms: numerators, and one denominator."""

    numerators: fmpz_mat
    denominator: fmpz

    @cached_property
    def words(self) -> int:
        """Size of the largest number."""
        return limbs(max(map(fmpz.bit_length, (self.denominator, *self.numerators.entries()))))

    @cached_property
    def denominator_words(self) -> int:
        """Size of the denominator."""
        return limbs(self.denominator.bit_length())

    def times(self, other: _Fractions) -> _Fractions:
        """The product of matrices."""
        rows, inner, columns = self.numerators.nrows(), self.numerators.ncols(), other.numerators.ncols()
        words = self.words + other.words
        charge(rows * inner * columns * words * (30 + words // 8))
        return _reduced(self.numerators * other.numerators, self.denominator * other.denominator)


def _reduced(numerators: fmpz_mat, denominator: fmpz) -> _Fractions:
    """The fractions in lowest terms."""
    entries = numerators.entries()
    words = limbs(max(map(fmpz.bit_length, (denominator, *entries))))
    charge(len(entries) * (1500 + 2 * words * words))
    common = denominator
    for value in entries:
        common = common.gcd(value)
        if common == 1:
            return _Fractions(numerators, denominator)
    reduced = [value // common for value in entries]
    return _Fractions(fmpz_mat(numerators.nrows(), numerators.ncols(), reduced), denominator // common)


def _combined(terms: Sequence[tuple[int, _Fractions]], divisor: int, size: int) -> _Fractions:
    """The combination of row vectors, divided by a number."""
    common = fmpz(1)
    for _, vector in terms:
        charge(1000 + 4 * limbs(common.bit_length()) * vector.denominator_words)
        common = common.lcm(vector.denominator)
    total, bits = fmpz_mat(1, size), common.bit_length()
    for value, vector in terms:
        words = limbs(bits + value.bit_length()) + vector.words
        charge(size * (1500 + words * words))
        total += vector.numerators * (value * (common // vector.denominator))
    return _reduced(total, common * divisor)


@dataclass(frozen=True)
class Algebra:
    """The algebra of all poses: ``basis``, and row b of the i-th matrix is the i-th unknown times the b-th of it."""

    basis: tuple[Monomial, ...]
    unknowns: tuple[_Fractions, ...]

    def vanish(self, elements: Iterable[Polynomial]) -> bool:
        """Whether all elements are 0: nothing is used of them but the matrices, applied to the vector of 1.

        An element that was not needed for the matrices, as others reduce its leading monomial, may well not be 0.
        """
        size = len(self.basis)
        vectors = {self.basis[0]: _unit(0, size)}
        for element in elements:
            terms = [(value, self._vector(monomial, vectors)) for monomial, value in element.items()]
            if _combined(terms, 1, size).numerators != fmpz_mat(1, size):
                return False
        return True

    def _vector(self, monomial: Monomial, vectors: dict[Monomial, _Fractions]) -> _Fractions:
        """The coordinates of a monomial: one unknown after another is multiplied to what is in ``vectors``."""
        axes = []
        reached = monomial
        charge(3000 * (1 + sum(monomial)))
        while reached not in vectors:
            axes.append(next(axis for axis, exponent in enumerate(reached) if exponent))
            reached = shifted(reached, axes[-1], -1)
        for axis in reversed(axes):
            larger = shifted(reached, axis, 1)
            vectors[larger] = vectors[reached].times(self.unknowns[axis])
            reached = larger
        return vectors[monomial]

    def distinct_solutions(self) -> int:
        """The rank of the trace form."""
        size = len(self.basis)
        one = fmpz_mat([[int(i == j) for j in range(size)] for i in range(size)])
        powers = {self.basis[0]: _Fractions(one, fmpz(1))}
        for monomial in self.basis[1:]:
            axis = next(i for i, exponent in enumerate(monomial) if exponent)
            powers[monomial] = powers[shifted(monomial, axis, -1)].times(self.unknowns[axis])
        ordered = [powers[monomial] for monomial in self.basis]
        traces = [_row([sum((m.numerators[i, i] for i in range(size)), fmpz(0))], m.denominator) for m in ordered]
        column = _stacked(traces)
        table = [[int(value) for value in matrix.times(column).numerators.entries()] for matrix in ordered]
        return len(echelon_form(table).pivots)

    def commutes(self) -> bool:
        """Whether the matrices commute, exactly."""
        size = len(self.basis)
        words = 2 * max(matrix.words for matrix in self.unknowns) + 1
        for left, right in combinations(self.unknowns, 2):
            charge(10_000 + words * size**2 * (12 + 3 * words + 16 * size))
            if left.numerators * right.numerators != right.numerators * left.numerators:
                return False
        return True

    def characteristic_polynomial(self, weights: Sequence[int], p: int) -> nmod_poly | None:
        """Of multiplication by a combination of the unknowns, modulo p; None if p divides a denominator."""
        size = len(self.basis)
        total = nmod_mat(size, size, p)
        for weight, matrix in zip(weights, self.unknowns, strict=True):
            charge(size * size * (20 + 12 * matrix.words) + size**3)
            denominator = int(matrix.denominator)
            if denominator % p == 0:
                return None
            total += nmod_mat(matrix.numerators, p) * (weight * pow(denominator, -1, p))
        charge(50 * size**3)
        return total.charpoly()


def _unit(place: int, size: int) -> _Fractions:
    return _Fractions(fmpz_mat(1, size, [int(place == other) for other in range(size)]), fmpz(1))


def _row(values: Sequence[fmpz], denominator: fmpz) -> _Fractions:
    return _reduced(fmpz_mat(1, len(values), list(values)), denominator)


def _stacked(rows: Sequence[_Fractions]) -> _Fractions:
    """One matrix of all rows."""
    common = fmpz(1)
    for row in rows:
        charge(1000 + 4 * limbs(common.bit_length()) * row.denominator_words)
        common = common.lcm(row.denominator)
    width = rows[0].numerators.ncols()
    words = limbs(common.bit_length())
    charge(sum(width * (500 + words * row.words) for row in rows))
    entries = [value * (common // row.denominator) for row in rows for value in row.numerators.entries()]
    return _reduced(fmpz_mat(len(rows), width, entries), common)


def quotient_algebra(elimination: Elimination, basis: Sequence[Monomial]) -> Algebra | None:
    """The algebra of all poses on the monomials left, or None if matrices do not commute or an element is not 0."""
    algebra = Algebra(tuple(basis), tuple(_Reduction(elimination, basis).matrices()))
    return algebra if algebra.commutes() and algebra.vanish(elimination.elements) else None


class _Reduction:
    """Coordinates of monomials on the basis, each found once."""

    def __init__(self, elimination: Elimination, basis: Sequence[Monomial]) -> None:
        self.size = elimination.size
        self.basis = basis
        self.place = {monomial: index for index, monomial in enumerate(basis)}
        self.leading = {next(iter(element)): element for element in elimination.elements}
        self.known: dict[Monomial, _Fractions] = {}

    def matrices(self) -> list[_Fractions]:
        """Multiplication by each unknown: row b holds the coordinates of the product with the b-th monomial."""
        return [
            _stacked([self.row(shifted(monomial, axis, 1)) for monomial in self.basis]) for axis in range(self.size)
        ]

    def row(self, monomial: Monomial) -> _Fractions:
        """Coordinates of a monomial; what they follow from is found first, without recursion however long the chain."""
        pending = [monomial]
        while pending:
            charge(10**5)
            missing = [other for other in self._needed(pending[-1]) if other not in self.known]
            if missing:
                pending += missing
                continue
            last = pending.pop()
            if last not in self.known:
                self.known[last] = self._found(last)
        return self.known[monomial]

    def _needed(self, monomial: Monomial) -> list[Monomial]:
        """Smaller monomials from whose coordinates those of this one follow, as far as they are known by now."""
        if monomial in self.known or monomial in self.place:
            return []
        if monomial in self.leading:
            return list(self.leading[monomial])[1:]
        axis, smaller = self._lowered(monomial)
        if smaller not in self.known:
            return [smaller]
        values = zip(self.basis, self.known[smaller].numerators.entries(), strict=True)
        return [shifted(other, axis, 1) for other, value in values if value]

    def _lowered(self, monomial: Monomial) -> tuple[int, Monomial]:
        """The first unknown by which a monomial that is neither standard nor leading can be divided to be so again."""
        lowered = ((axis, shifted(monomial, axis, -1)) for axis in range(self.size) if monomial[axis])
        return next((axis, other) for axis, other in lowered if other not in self.place)

    def _found(self, monomial: Monomial) -> _Fractions:
        size = len(self.basis)
        if monomial in self.place:
            return _unit(self.place[monomial], size)
        if monomial in self.leading:
            (_, lead), *tail = self.leading[monomial].items()
            return _combined([(-value, self.row(other)) for other, value in tail], lead, size)
        axis, smaller = self._lowered(monomial)
        vector = self.row(smaller)
        values = zip(self.basis, map(int, vector.numerators.entries()), strict=True)
        terms = [(value, self.row(shifted(other, axis, 1))) for other, value in values if value]
        return _combined(terms, int(vector.denominator), size)
