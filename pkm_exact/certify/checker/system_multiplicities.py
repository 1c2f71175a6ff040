"""How multiple isolated solutions are: the dimensions of their local algebras, by functionals of growing order. Exact.

D_k is the space of the functionals that are 0 on the system and on products of k + 1 of the coordinates y around the
solution. A functional is known by its products with y_1, .., y_n and its value at 1; those of D_(k+1) have their
products in D_k. Where D_k does not grow any more, its dimension is the multiplicity. All is written over Q: the field
K = Q[T] / f of an irreducible factor f of the eliminant has the basis 1, T, .., T^(e - 1).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import comb, gcd, lcm
from typing import NamedTuple, TypeAlias

from flint import fmpq, fmpq_mat, fmpq_poly, fmpz_mat, fmpz_poly

from pkm_exact.certify.checker.budget import charge, limbs, polynomials_cost
from pkm_exact.certify.checker.echelon import Echelon, echelon_form
from pkm_exact.certify.checker.system_document import Points
from pkm_exact.certify.checker.system_terms import Monomial, Terms
from pkm_exact.certify.checker.system_weights import Weighed

Coefficients: TypeAlias = dict[Monomial, fmpq_mat]
"""By products of coordinates, multiplication by their coefficient: row q has T^q times it."""


def multiple_solutions(points: Points, polynomials: Sequence[Terms], weighed: Weighed) -> Weighed:
    """The solutions with their multiplicities instead of weights; all of them must be isolated."""
    total, found = int(points.eliminant.degree()), []
    for factor, _ in weighed.factors:
        degree, number = int(factor.degree()), _dimension(points, polynomials, factor)
        found.append((factor, number // degree))
        total += number - degree
    return Weighed(total, tuple(found))


def _dimension(points: Points, polynomials: Sequence[Terms], factor: fmpz_poly) -> int:
    """The sum of the multiplicities of the solutions at the roots of a factor."""
    places = _Place(points, factor)
    known: list[Coefficients] = [{} for _ in polynomials]
    space = _first(len(points.numerators), int(factor.degree()))
    order = 0
    while True:
        order += 1
        for coefficients, polynomial in zip(known, polynomials, strict=True):
            coefficients.update(places.coefficients(polynomial, order))
        larger = _enlarged(space, known)
        if larger.dimension == space.dimension:
            return space.dimension
        space = larger


class _Place:
    """The solutions z at the roots of a factor, and the coefficients of F(z + y) for polynomials F."""

    def __init__(self, points: Points, factor: fmpz_poly) -> None:
        self.modulus = fmpq_poly(factor)
        self.degree = int(factor.degree())
        words = max(limbs(int(value.height_bits())) for value in (points.eliminant, *points.numerators))
        longest = int(points.eliminant.length())
        words += longest * limbs(int(factor.height_bits()))
        charge(3 * (len(points.numerators) + 2) * polynomials_cost(longest, words))
        inverse = fmpq_poly(points.eliminant.derivative()).xgcd(self.modulus)[1]
        self.coordinates = [fmpq_poly(value) * inverse % self.modulus for value in points.numerators]
        self.powers: dict[Monomial, fmpq_poly] = {(0,) * len(self.coordinates): fmpq_poly([1])}

    def coefficients(self, polynomial: Terms, order: int) -> Coefficients:
        """Those of the products of so many coordinates, but for 0."""
        found: dict[Monomial, fmpq_poly] = {}
        for monomial, value in polynomial.items():
            for part, ways in _divisors(monomial, order):
                rest = self._power(tuple(a - b for a, b in zip(monomial, part, strict=True)))
                charge(2000 + 100 * self.degree * limbs(value.bit_length()) * self._words(rest))
                found[part] = found.get(part, fmpq_poly()) + value * ways * rest
        return {part: self._multiplication(value) for part, value in found.items() if value}

    def _power(self, monomial: Monomial) -> fmpq_poly:
        pending = [monomial]
        while pending[-1] not in self.powers:
            pending.append(_divided(pending[-1])[1])
        value = self.powers[pending.pop()]
        while pending:
            axis, _ = _divided(pending[-1])
            self._charge(value, self.coordinates[axis])
            value = value * self.coordinates[axis] % self.modulus
            self.powers[pending.pop()] = value
        return value

    def _multiplication(self, value: fmpq_poly) -> fmpq_mat:
        entries: list[fmpq] = []
        for _ in range(self.degree):
            entries += [value[place] for place in range(self.degree)]
            self._charge(value, self.modulus)
            value = value * fmpq_poly([0, 1]) % self.modulus
        return fmpq_mat(self.degree, self.degree, entries)

    def _charge(self, one: fmpq_poly, other: fmpq_poly) -> None:
        """For a product and its remainder."""
        charge(3 * polynomials_cost(2 * self.degree, self._words(one) + self._words(other) + self._words(self.modulus)))

    def _words(self, value: fmpq_poly) -> int:
        return limbs(max(int(value.numer().height_bits()), int(value.denom()).bit_length()))


def _divided(monomial: Monomial) -> tuple[int, Monomial]:
    """The first coordinate that divides a product of some, and the rest."""
    axis = next(i for i, exponent in enumerate(monomial) if exponent)
    return axis, (*monomial[:axis], monomial[axis] - 1, *monomial[axis + 1 :])


def _divisors(monomial: Monomial, order: int) -> Iterator[tuple[Monomial, int]]:
    """The monomials of a degree that divide one, and the products of their binomial coefficients."""
    pending: list[tuple[Monomial, int, int]] = [((), order, 1)]
    while pending:
        charge(3000)
        part, left, ways = pending.pop()
        axis = len(part)
        if axis == len(monomial):
            yield part, ways
            continue
        least = max(left - sum(monomial[axis + 1 :]), 0)
        pending += [
            ((*part, exponent), left - exponent, ways * comb(monomial[axis], exponent))
            for exponent in range(least, min(left, monomial[axis]) + 1)
        ]


class _Functionals(NamedTuple):
    """D_k: row b of ``axes[i]`` is y_i times the b-th functional of the basis, row b of ``at_one`` its value at 1."""

    axes: list[fmpq_mat]
    at_one: fmpq_mat

    @property
    def dimension(self) -> int:
        """Over Q."""
        return int(self.at_one.nrows())


def _first(size: int, degree: int) -> _Functionals:
    """D_0: the value at z, times 1, T, .., T^(e - 1)."""
    return _Functionals([fmpq_mat(degree, degree) for _ in range(size)], _unit(degree, degree))


def _unit(rows: int, columns: int) -> fmpq_mat:
    return fmpq_mat(rows, columns, [int(i == j) for i in range(rows) for j in range(columns)])


def _enlarged(space: _Functionals, known: Sequence[Mapping[Monomial, fmpq_mat]]) -> _Functionals:
    """The next larger space, for the coefficients of the polynomials around z."""
    size, dimension, degree = len(space.axes), space.dimension, int(space.at_one.ncols())
    equations = [*_commuting(space), *(row for each in known for row in _vanishing(space, each))]
    found = Echelon([], list(range(size * dimension)), 1, [])
    if equations:
        found = echelon_form(equations)
    pivots, free, denominator, numerators = found
    charge(200 * (len(free) + 1) * size * dimension)
    kernel = fmpz_mat(len(free), size * dimension)
    for number, column in enumerate(free):
        kernel[number, column] = denominator
        for pivot, row in zip(pivots, numerators, strict=True):
            kernel[number, pivot] = -row[number]
    tables = [matrix.tolist() for matrix in space.axes]
    old = fmpq_mat(
        dimension,
        degree + len(free),
        [
            value
            for number, ends in enumerate(space.at_one.tolist())
            for value in (*ends, *(tables[place // dimension][number][place % dimension] for place in free))
        ],
    )
    rows, axes = kernel.tolist(), []
    zeros = [0] * (degree * (degree + len(free)))
    for axis in range(size):
        flat = [value for row in rows for value in row[axis * dimension : (axis + 1) * dimension]]
        part = _product(fmpq_mat(len(free), dimension, flat) * fmpq(1, denominator), old)
        axes.append(fmpq_mat(degree + len(free), degree + len(free), [*zeros, *part.entries()]))
    return _Functionals(axes, _unit(degree + len(free), degree))


def _commuting(space: _Functionals) -> Iterator[list[int]]:
    """For the products L_i of a functional with the coordinates: y_j L_i = y_i L_j."""
    size, dimension = len(space.axes), space.dimension
    whole = [matrix.transpose().numer_denom() for matrix in space.axes]
    tables = [
        ([list(map(int, row)) for row in numerators.tolist()], int(denominator)) for numerators, denominator in whole
    ]
    charge(
        100 * size * size * dimension * dimension * max(limbs(denominator.bit_length()) for _, denominator in tables)
    )
    for j, (by_j, divisor_j) in enumerate(tables):
        for i, (by_i, divisor_i) in enumerate(tables[:j]):
            for left, right in zip(by_j, by_i, strict=True):
                if any(left) or any(right):
                    row = [0] * (size * dimension)
                    row[i * dimension : (i + 1) * dimension] = [value * divisor_i for value in left]
                    row[j * dimension : (j + 1) * dimension] = [-value * divisor_j for value in right]
                    yield row


def _vanishing(space: _Functionals, coefficients: Mapping[Monomial, fmpq_mat]) -> Iterator[list[int]]:
    """For the same: that the functional is 0 at a polynomial, each term taken as one coordinate times the rest."""
    size, dimension, degree = len(space.axes), space.dimension, int(space.at_one.ncols())
    at: dict[Monomial, fmpq_mat] = {(0,) * size: space.at_one}
    blocks = [fmpq_mat(dimension, degree) for _ in range(size)]
    for monomial, matrix in coefficients.items():
        axis, rest = _divided(monomial)
        pending = [rest]
        while pending[-1] not in at:
            pending.append(_divided(pending[-1])[1])
        value = at[pending.pop()]
        while pending:
            value = _product(space.axes[_divided(pending[-1])[0]], value)
            at[pending.pop()] = value
        charge(500 * dimension * degree)
        blocks[axis] += _product(value, matrix)
    for column in range(degree):
        row = [block[number, column] for block in blocks for number in range(dimension)]
        charge(1000 * len(row))
        common = lcm(*(int(value.q) for value in row))
        charge(len(row) * limbs(common.bit_length()) ** 2)
        cleared = [int(value * common) for value in row]
        content = gcd(*cleared)
        if content:
            yield [value // content for value in cleared]


def _product(left: fmpq_mat, right: fmpq_mat) -> fmpq_mat:
    """The product of matrices."""
    words = _words(left) + _words(right)
    charge(1000 + int(left.nrows()) * int(left.ncols()) * int(right.ncols()) * words * (30 + words // 8))
    return left * right


def _words(matrix: fmpq_mat) -> int:
    """Size of the largest number, over a common denominator."""
    numerators, denominator = matrix.numer_denom()
    charge(100 * int(matrix.nrows()) * int(matrix.ncols()) * limbs(int(denominator).bit_length()))
    largest = max((int(abs(value)) for value in numerators.entries()), default=0)
    return limbs(max(largest.bit_length(), int(denominator).bit_length()))
