"""Quotient algebras modulo a prime: normal set, multiplication matrices, elements, trace.

An element is a 1 x D row of its coordinates on the normal set; ``element * matrix`` multiplies it by what the matrix
stands for.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

from flint import nmod, nmod_mat

from pkm_exact.algebra.groebner import GroebnerBasis, OutOfReachError
from pkm_exact.algebra.monomials import MonomialRing, divides, exponent_fields
from pkm_exact.algebra.reduction import row_echelon
from pkm_exact.algebra.system import ModularPolynomial


@dataclass(frozen=True)
class QuotientAlgebra:
    """F_p[x] / I for a zero-dimensional ideal I.

    Attributes
    ----------
    prime : int
    ring : MonomialRing
    normal_set : tuple of int
        Monomials outside the leading ideal, increasing; a basis of the algebra. Its first member is 1.
    unknowns : tuple of nmod_mat
        Multiplication matrices: row b of the i-th one holds the coordinates of x_i times the b-th basis monomial.
    """

    prime: int
    ring: MonomialRing
    normal_set: tuple[int, ...]
    unknowns: tuple[nmod_mat, ...]

    @property
    def dimension(self) -> int:
        """Number of solutions over the algebraic closure of F_p, with multiplicity."""
        return len(self.normal_set)

    @cached_property
    def one(self) -> nmod_mat:
        """The element 1."""
        return nmod_mat(1, self.dimension, [1] + [0] * (self.dimension - 1), self.prime)

    @cached_property
    def _paths(self) -> dict[int, tuple[int, int]]:
        """For every normal monomial but 1: an unknown that divides it, and the position of the quotient."""
        position = {monomial: index for index, monomial in enumerate(self.normal_set)}
        paths = {}
        for monomial in self.normal_set[1:]:
            unknown = next(i for i, exponent in enumerate(self.ring.unpack(monomial)) if exponent)
            paths[monomial] = (unknown, position[monomial - self.ring.unknown(unknown)])
        return paths

    @cached_property
    def basis_matrices(self) -> tuple[nmod_mat, ...]:
        """Multiplication matrices of the normal set."""
        matrices = [_identity(self.dimension, self.prime)]
        for monomial in self.normal_set[1:]:
            unknown, quotient = self._paths[monomial]
            matrices.append(matrices[quotient] * self.unknowns[unknown])
        return tuple(matrices)

    @cached_property
    def trace(self) -> nmod_mat:
        """The trace form as a D x 1 column: traces of the multiplications by the normal set."""
        traces = []
        for matrix in self.basis_matrices:
            total = nmod(0, self.prime)
            for index in range(self.dimension):
                total += matrix[index, index]
            traces.append(total)
        return nmod_mat(self.dimension, 1, traces, self.prime)

    def element(self, polynomial: ModularPolynomial) -> nmod_mat:
        """The class of a polynomial, given by packed monomials and coefficients."""
        values = self._monomial_values(polynomial[0])
        total = nmod_mat(1, self.dimension, self.prime)
        for monomial, coefficient in zip(*polynomial, strict=True):
            total += values[monomial] * coefficient
        return total

    def matrix(self, element: nmod_mat) -> nmod_mat:
        """The multiplication matrix of an element."""
        rows = [element]
        for monomial in self.normal_set[1:]:
            unknown, quotient = self._paths[monomial]
            rows.append(rows[quotient] * self.unknowns[unknown])
        return _stack(rows, self.prime)

    def quotient_by(self, element: nmod_mat) -> QuotientAlgebra:
        """The algebra modulo one more relation: the solutions at which the element vanishes."""
        size = self.dimension
        # Largest monomials first, so that what remains is the normal set of the larger ideal.
        reverse = nmod_mat(size, size, [int(i + j == size - 1) for i in range(size) for j in range(size)], self.prime)
        echelon, pivots = row_echelon(self.matrix(element) * reverse)
        leading = {size - 1 - pivot: row for row, pivot in enumerate(pivots)}
        kept = [index for index in range(size) if index not in leading]
        projection = []
        for index in range(size):
            if index in leading:
                projection += [-int(echelon[leading[index], size - 1 - other]) for other in kept]
            else:
                projection += [int(index == other) for other in kept]
        project = nmod_mat(size, len(kept), projection, self.prime)
        select = nmod_mat(len(kept), size, [int(i == j) for i in kept for j in range(size)], self.prime)
        return QuotientAlgebra(
            self.prime,
            self.ring,
            tuple(self.normal_set[index] for index in kept),
            tuple(select * matrix * project for matrix in self.unknowns),
        )

    def _monomial_values(self, monomials: Sequence[int]) -> dict[int, nmod_mat]:
        values = {0: self.one}
        for monomial in sorted(monomials):
            exponents = self.ring.unpack(monomial)
            value, partial = self.one, 0
            for unknown, exponent in enumerate(exponents):
                for _ in range(exponent):
                    partial += self.ring.unknown(unknown)
                    if partial not in values:
                        values[partial] = value * self.unknowns[unknown]
                    value = values[partial]
        return values


def _identity(size: int, prime: int) -> nmod_mat:
    return nmod_mat(size, size, [int(i == j) for i in range(size) for j in range(size)], prime)


def _stack(rows: Sequence[nmod_mat], prime: int) -> nmod_mat:
    entries = [value for row in rows for value in row.entries()]
    return nmod_mat(len(rows), rows[0].ncols(), entries, prime)


def normal_set(basis: GroebnerBasis, limit: int) -> tuple[int, ...]:
    """Monomials that no leading monomial divides, increasing; the staircase must be finite.

    Raises
    ------
    OutOfReachError
        If there are more than ``limit``.
    """
    found = standard_monomials(basis.ring, basis.leading_monomials, limit)
    if found is None:
        raise OutOfReachError("the staircase is infinite")
    return found


def standard_monomials(ring: MonomialRing, leading_monomials: Sequence[int], limit: int) -> tuple[int, ...] | None:
    """Monomials that none of the given ones divides, increasing; None if there are infinitely many.

    Raises
    ------
    OutOfReachError
        If there are finitely many, but more than ``limit``.

    Examples
    --------
    >>> ring = MonomialRing(2)
    >>> found = standard_monomials(ring, [ring.pack((2, 0)), ring.pack((0, 2)), ring.pack((1, 1))], 10)
    >>> [ring.unpack(monomial) for monomial in found]
    [(0, 0), (0, 1), (1, 0)]
    """
    leading = [ring.unpack(monomial) for monomial in leading_monomials]
    if any(not any(exponents) for exponents in leading):
        return ()
    pure = {exponents.index(max(exponents)) for exponents in leading if sum(map(bool, exponents)) == 1}
    if len(pure) < ring.size:
        return None
    barred = [exponent_fields(exponents) for exponents in leading]
    unknowns = [exponent_fields(tuple(int(i == index) for i in range(ring.size))) for index in range(ring.size)]
    packed = [ring.unknown(index) for index in range(ring.size)]
    found = [0]
    layer = [(0, 0, 0)]
    while layer:
        # Each monomial is reached once: only unknowns not before the last one present are raised.
        layer = [
            (raised, monomial + packed[index], index)
            for fields, monomial, last in layer
            for index in range(last, ring.size)
            for raised in (fields + unknowns[index],)
            if not any(divides(lead, raised) for lead in barred)
        ]
        found += [monomial for _, monomial, _ in layer]
        if len(found) > limit:
            raise OutOfReachError(f"more than {limit} solutions")
    return tuple(sorted(found))


def quotient_algebra(basis: GroebnerBasis, limit: int) -> QuotientAlgebra:
    """Multiplication matrices of the unknowns on the normal set of a zero-dimensional Groebner basis."""
    ring, prime = basis.ring, basis.prime
    normal = normal_set(basis, limit)
    border = _BorderReduction(basis, normal)
    border.reduce_all(sorted({monomial + ring.unknown(index) for monomial in normal for index in range(ring.size)}))
    matrices = tuple(border.multiplication(index) for index in range(ring.size))
    return QuotientAlgebra(prime, ring, normal, matrices)


class _BorderReduction:
    """Normal forms of the normal set and its border, in increasing order."""

    def __init__(self, basis: GroebnerBasis, normal: tuple[int, ...]) -> None:
        self.prime = basis.prime
        self.ring = basis.ring
        self.normal = normal
        self.elements = {element[0][0]: element for element in basis.elements}
        self.position = {monomial: index for index, monomial in enumerate(normal)}
        self.unknowns = [self.ring.unknown(index) for index in range(self.ring.size)]
        self.forms: dict[int, list[int]] = {}
        size = len(normal)
        self._tables = [nmod_mat(size, size, self.prime) for _ in self.unknowns]
        self._filled = [bytearray(size) for _ in self.unknowns]

    def multiplication(self, index: int) -> nmod_mat:
        """The matrix of an unknown: row b has its product with the b-th monomial of the normal set."""
        return self._table(index, range(len(self.normal)))

    def _table(self, index: int, rows: Iterable[int]) -> nmod_mat:
        """The same, where these rows are wanted."""
        table, filled, unknown = self._tables[index], self._filled[index], self.unknowns[index]
        for row in rows:
            if not filled[row]:
                for column, value in enumerate(self._form(self.normal[row] + unknown)):
                    if value:
                        table[row, column] = value
                filled[row] = True
        return table

    def reduce_all(self, monomials: Sequence[int]) -> None:
        size = len(self.normal)
        for monomial in monomials:
            if monomial in self.position:
                form = [0] * size
                form[self.position[monomial]] = 1
                self.forms[monomial] = form
            elif monomial in self.elements:
                self.forms[monomial] = self._tail(*self.elements[monomial])
            else:
                self.forms[monomial] = self._climb(monomial)

    def _tail(self, monomials: list[int], coefficients: list[int]) -> list[int]:
        form = [0] * len(self.normal)
        prime = self.prime
        for monomial, coefficient in zip(monomials[1:], coefficients[1:], strict=True):
            if monomial in self.position:
                index = self.position[monomial]
                form[index] = (form[index] - coefficient) % prime
            else:
                form = [(a - coefficient * b) % prime for a, b in zip(form, self._form(monomial), strict=True)]
        return form

    def _form(self, monomial: int) -> list[int]:
        if monomial not in self.forms:
            self.reduce_all([monomial])
        return self.forms[monomial]

    def _climb(self, monomial: int) -> list[int]:
        """Normal form of x_i m from that of a smaller monomial m outside the normal set."""
        exponents = self.ring.unpack(monomial)
        for index, exponent in enumerate(exponents):
            smaller = monomial - self.unknowns[index] if exponent else 0
            if exponent and smaller not in self.position:
                break
        form = self._form(smaller)
        table = self._table(index, (place for place, value in enumerate(form) if value))
        return list(map(int, (nmod_mat(1, len(form), form, self.prime) * table).entries()))
