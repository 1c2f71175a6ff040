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
from itertools import combinations

from flint import fmpq, fmpq_mat, nmod_mat, nmod_poly

from pkm_exact.certify.checker.elimination import Elimination, Monomial, Polynomial
from pkm_exact.certify.checker.verdict import GREATEST_NUMBER


@dataclass(frozen=True)
class Algebra:
    """The algebra of all poses: ``basis``, and row b of the i-th matrix is the i-th unknown times the b-th of it."""

    basis: tuple[Monomial, ...]
    unknowns: tuple[fmpq_mat, ...]

    def vanish(self, elements: Iterable[Polynomial]) -> bool:
        """Whether all elements are 0: nothing is used of them but the matrices, applied to the vector of 1.

        An element that was not needed for the matrices, as others reduce its leading monomial, may well not be 0.
        """
        size = len(self.basis)
        vectors = {self.basis[0]: fmpq_mat(1, size, [1] + [0] * (size - 1))}
        for element in elements:
            total = fmpq_mat(1, size)
            for monomial, value in element.items():
                total += self._vector(monomial, vectors) * value
            if total != fmpq_mat(1, size):
                return False
        return True

    def _vector(self, monomial: Monomial, vectors: dict[Monomial, fmpq_mat]) -> fmpq_mat:
        """The coordinates of a monomial: one unknown after another is multiplied to what is in ``vectors``."""
        axes = []
        reached = monomial
        while reached not in vectors:
            axes.append(next(axis for axis, exponent in enumerate(reached) if exponent))
            reached = _shifted(reached, axes[-1], -1)
        for axis in reversed(axes):
            larger = _shifted(reached, axis, 1)
            vectors[larger] = vectors[reached] * self.unknowns[axis]
            reached = larger
        return vectors[monomial]

    def distinct_solutions(self) -> int:
        """The rank of the trace form."""
        size = len(self.basis)
        powers = {self.basis[0]: fmpq_mat([[int(i == j) for j in range(size)] for i in range(size)])}
        for monomial in self.basis[1:]:
            axis = next(i for i, exponent in enumerate(monomial) if exponent)
            powers[monomial] = powers[_shifted(monomial, axis, -1)] * self.unknowns[axis]
        ordered = [powers[monomial] for monomial in self.basis]
        traces = [sum((matrix[i, i] for i in range(size)), fmpq(0)) for matrix in ordered]
        column = fmpq_mat(size, 1, traces)
        return int(fmpq_mat([[value for (value,) in (matrix * column).table()] for matrix in ordered]).rank())

    def characteristic_polynomial(self, weights: Sequence[int], p: int) -> nmod_poly | None:
        """Of multiplication by a combination of the unknowns, modulo p; None if p divides a denominator."""
        size = len(self.basis)
        total = nmod_mat(size, size, p)
        for weight, matrix in zip(weights, self.unknowns, strict=True):
            numerators, denominator = matrix.numer_denom()
            if int(denominator) % p == 0:
                return None
            total += nmod_mat(numerators, p) * (weight * pow(int(denominator), -1, p))
        return total.charpoly()


def quotient_algebra(elimination: Elimination) -> Algebra | None:
    """The algebra of all poses, or None if the matrices do not commute or an element is not 0 in it."""
    basis = elimination.standard(GREATEST_NUMBER)
    reduction = _Reduction(elimination, basis)
    matrices = reduction.matrices()
    cleared = [matrix.numer_denom()[0] for matrix in matrices]
    if any(left * right != right * left for left, right in combinations(cleared, 2)):
        return None
    algebra = Algebra(tuple(basis), tuple(matrices))
    return algebra if algebra.vanish(elimination.elements) else None


def _shifted(monomial: Monomial, axis: int, step: int) -> Monomial:
    return (*monomial[:axis], monomial[axis] + step, *monomial[axis + 1 :])


class _Reduction:
    """Coordinates of monomials on the basis, each found once, as 1 x n matrices."""

    def __init__(self, elimination: Elimination, basis: Sequence[Monomial]) -> None:
        self.size = elimination.size
        self.basis = basis
        self.place = {monomial: index for index, monomial in enumerate(basis)}
        self.leading = {next(iter(element)): element for element in elimination.elements}
        self.known: dict[Monomial, fmpq_mat] = {}

    def matrices(self) -> list[fmpq_mat]:
        """Multiplication by each unknown: row b holds the coordinates of the product with the b-th monomial."""
        return [
            fmpq_mat([list(self.row(_shifted(monomial, axis, 1)).entries()) for monomial in self.basis])
            for axis in range(self.size)
        ]

    def row(self, monomial: Monomial) -> fmpq_mat:
        """Coordinates of a monomial; what they follow from is found first, without recursion however long the chain."""
        pending = [monomial]
        while pending:
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
        values = zip(self.basis, self.known[smaller].entries(), strict=True)
        return [_shifted(other, axis, 1) for other, value in values if value]

    def _lowered(self, monomial: Monomial) -> tuple[int, Monomial]:
        """The first unknown by which a monomial that is neither standard nor leading can be divided to be so again."""
        lowered = ((axis, _shifted(monomial, axis, -1)) for axis in range(self.size) if monomial[axis])
        return next((axis, other) for axis, other in lowered if other not in self.place)

    def combination(self, terms: Iterable[tuple[Monomial, int]]) -> fmpq_mat:
        """Coordinates of a polynomial."""
        total = fmpq_mat(1, len(self.basis))
        for monomial, value in terms:
            total += self.row(monomial) * value
        return total

    def _found(self, monomial: Monomial) -> fmpq_mat:
        total = fmpq_mat(1, len(self.basis))
        if monomial in self.place:
            total[0, self.place[monomial]] = 1
        elif monomial in self.leading:
            (_, lead), *tail = self.leading[monomial].items()
            total = self.combination(tail) * fmpq(-1, lead)
        else:
            axis, smaller = self._lowered(monomial)
            for other, value in zip(self.basis, self.row(smaller).entries(), strict=True):
                if value:
                    total += self.row(_shifted(other, axis, 1)) * value
        return total
