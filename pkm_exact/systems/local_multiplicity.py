"""How multiple an isolated solution is, exactly: the dimension of its local algebra, by functionals of growing order.

D_k is the space of functionals that are 0 on the polynomials of the system and on all products of k + 1 coordinates
around the solution. One of D_(k+1) is known by its products with the n coordinates, which are in D_k. When D_k does not
grow, its dimension is the multiplicity (Macaulay; Mourrain 1997; the proof is in ``docs/certificates-systems.md``).

All is done over Q: K = Q[T] / f, f an irreducible factor of the eliminant, has the basis 1, T, .., T^(e - 1).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import combinations
from math import comb, lcm, prod
from typing import Final, TypeAlias

from flint import fmpq, fmpq_mat, fmpq_poly, fmpz_mat, fmpz_mpoly, fmpz_poly

from pkm_exact.algebra.representation import UnivariateRepresentation
from pkm_exact.systems.regularity import Weights

MOST_SOLUTIONS: Final = 32
"""Solutions that are not regular, up to which their multiplicities are asked for one by one."""
Exponents: TypeAlias = tuple[int, ...]


def exact_weights(
    polynomials: Sequence[fmpz_mpoly], points: UnivariateRepresentation, weights: Weights, most: int
) -> Weights | None:
    """The factors of the eliminant with the multiplicities of the solutions at their roots, all isolated.

    Parameters
    ----------
    polynomials : sequence of fmpz_mpoly
    points : UnivariateRepresentation
        Solutions.
    weights : Weights
        Lower bounds of their multiplicities, 1 only where they are regular.
    most : int
        The sum that the multiplicities must not exceed.

    Returns
    -------
    Weights or None
        None if there are too many solutions that are not regular, or the sum is exceeded.
    """
    if sum(len(key) - 1 for key, weight in weights if weight > 1) > MOST_SOLUTIONS:
        return None
    left = most - sum((len(key) - 1) * weight for key, weight in weights)
    found = []
    for key, weight in weights:
        degree, exact = len(key) - 1, weight
        if weight > 1:
            number = local_dimension(polynomials, points, fmpz_poly(list(key)), degree * weight + left)
            if number is None:
                return None
            exact = number // degree
            left -= degree * (exact - weight)
        found.append((key, exact))
    return tuple(found)


def local_dimension(
    polynomials: Sequence[fmpz_mpoly], points: UnivariateRepresentation, factor: fmpz_poly, most: int
) -> int | None:
    """The sum of the multiplicities of the solutions at the roots of a factor; None if it is above ``most``.

    Examples
    --------
    >>> from pkm_exact.algebra.system import polynomial_ring
    >>> x, y = polynomial_ring(("x", "y")).gens()
    >>> origin = UnivariateRepresentation((1, 1), (0, 1), ((), ()))
    >>> local_dimension([x**2 - y**3, x * y], origin, fmpz_poly([0, 1]), 9)
    5
    """
    size = len(points.numerators)
    expansions = [_Expansion(polynomial, points, factor) for polynomial in polynomials]
    space = _Functionals.first(size, int(factor.degree()))
    for order in range(1, most + 2):
        larger = space.enlarged([expansion.of_order(order) for expansion in expansions])
        if larger.dimension == space.dimension:
            return space.dimension
        if larger.dimension > most:
            return None
        space = larger
    return None


class _Expansion:
    """The coefficients of a polynomial around the solutions at the roots of f, as matrices on K = Q[T] / f."""

    def __init__(self, polynomial: fmpz_mpoly, points: UnivariateRepresentation, factor: fmpz_poly) -> None:
        self.modulus = fmpq_poly(factor)
        inverse = fmpq_poly(points.polynomial.derivative()).xgcd(self.modulus)[1]
        self.place = [fmpq_poly(n) * inverse % self.modulus for n in points.numerator_polynomials]
        self.terms = {tuple(map(int, e)): int(value) for e, value in polynomial.to_dict().items()}
        self.known: dict[Exponents, fmpq_poly] = {(0,) * len(self.place): fmpq_poly([1])}
        self.lower: dict[Exponents, fmpq_mat] = {}

    def of_order(self, order: int) -> Mapping[Exponents, fmpq_mat]:
        """Multiplication by the coefficients of the products of so many coordinates, and of fewer ones, but for 1."""
        total: dict[Exponents, fmpq_poly] = {}
        for exponents, value in self.terms.items():
            for part in _parts(exponents, order):
                rest = tuple(a - b for a, b in zip(exponents, part, strict=True))
                ways = prod(comb(a, b) for a, b in zip(exponents, part, strict=True))
                total[part] = total.get(part, fmpq_poly()) + value * ways * self._power(rest)
        self.lower |= {part: self._matrix(value) for part, value in total.items() if value}
        return self.lower

    def _power(self, exponents: Exponents) -> fmpq_poly:
        if exponents not in self.known:
            axis = next(i for i, exponent in enumerate(exponents) if exponent)
            self.known[exponents] = self._power(_lowered(exponents, axis)) * self.place[axis] % self.modulus
        return self.known[exponents]

    def _matrix(self, value: fmpq_poly) -> fmpq_mat:
        """Row q has the coordinates of T^q times the value."""
        degree = int(self.modulus.degree())
        rows: list[fmpq] = []
        for _ in range(degree):
            rows += [value[place] for place in range(degree)]
            value = value * fmpq_poly([0, 1]) % self.modulus
        return fmpq_mat(degree, degree, rows)


def _lowered(exponents: Exponents, axis: int) -> Exponents:
    return (*exponents[:axis], exponents[axis] - 1, *exponents[axis + 1 :])


def _parts(exponents: Exponents, order: int) -> Iterator[Exponents]:
    """All exponents that sum to the order and are nowhere greater than the given ones."""
    if not exponents:
        if not order:
            yield ()
        return
    for first in range(max(order - sum(exponents[1:]), 0), min(exponents[0], order) + 1):
        for rest in _parts(exponents[1:], order - first):
            yield (first, *rest)


@dataclass(frozen=True)
class _Functionals:
    """D_k, by a basis.

    Attributes
    ----------
    products : sequence of fmpq_mat, dimension x dimension
        Row b has the product of a coordinate and the b-th functional.
    values : fmpq_mat, dimension x degree
        Row b has the value of the b-th functional at 1, an element of K.
    """

    products: Sequence[fmpq_mat]
    values: fmpq_mat

    @classmethod
    def first(cls, size: int, degree: int) -> _Functionals:
        """D_0: multiples of the value at the solution."""
        unit = fmpq_mat(degree, degree, [int(i == j) for i in range(degree) for j in range(degree)])
        return cls([fmpq_mat(degree, degree)] * size, unit)

    @property
    def dimension(self) -> int:
        """Over Q."""
        return int(self.values.nrows())

    def enlarged(self, expansions: Sequence[Mapping[Exponents, fmpq_mat]]) -> _Functionals:
        """D_(k+1)."""
        size, dimension, degree = len(self.products), self.dimension, int(self.values.ncols())
        kernel, free = _kernel([*self._commuting(), *self._vanishing(expansions)], size * dimension)
        conversion = fmpq_mat(
            [
                [*values, *(self.products[place // dimension][number, place % dimension] for place in free)]
                for number, values in enumerate(self.values.tolist())
            ]
        )
        rows = kernel.tolist() if free else []
        width = degree + len(free)
        products = []
        for axis in range(size):
            part = [value for row in rows for value in row[axis * dimension : (axis + 1) * dimension]]
            entries = (fmpq_mat(len(free), dimension, part) * conversion).entries()
            products.append(fmpq_mat(width, width, [*[0] * (degree * width), *entries]))
        top = [[int(i == j) for j in range(degree)] for i in range(degree)]
        return _Functionals(products, fmpq_mat(top + [[0] * degree] * len(free)))

    def _commuting(self) -> Iterator[list[fmpq]]:
        """Equations of the products of a functional with the coordinates: y_j (y_i L) = y_i (y_j L)."""
        dimension = self.dimension
        columns = [matrix.transpose().tolist() for matrix in self.products]
        for i, j in combinations(range(len(columns)), 2):
            for left, right in zip(columns[j], columns[i], strict=True):
                row = [fmpq(0)] * (len(columns) * dimension)
                row[i * dimension : (i + 1) * dimension] = left
                row[j * dimension : (j + 1) * dimension] = [-value for value in right]
                yield row

    def _vanishing(self, expansions: Sequence[Mapping[Exponents, fmpq_mat]]) -> Iterator[list[fmpq]]:
        """Equations of the products of a functional that is 0 at the polynomials."""
        size, dimension = len(self.products), self.dimension
        known: dict[Exponents, fmpq_mat] = {(0,) * size: self.values}

        def values(exponents: Exponents) -> fmpq_mat:
            """Of the basis, at a product of coordinates."""
            if exponents not in known:
                axis = next(i for i, exponent in enumerate(exponents) if exponent)
                known[exponents] = self.products[axis] * values(_lowered(exponents, axis))
            return known[exponents]

        for expansion in expansions:
            blocks = [fmpq_mat(dimension, int(self.values.ncols())) for _ in range(size)]
            for exponents, matrix in expansion.items():
                axis = next(i for i, exponent in enumerate(exponents) if exponent)
                blocks[axis] += values(_lowered(exponents, axis)) * matrix
            for parts in zip(*(block.transpose().tolist() for block in blocks), strict=True):
                yield [value for part in parts for value in part]


def _kernel(equations: Sequence[Sequence[fmpq]], width: int) -> tuple[fmpq_mat, list[int]]:
    """A basis of the rows that solve equations, each 1 at one of the places listed and 0 at the other ones of them."""
    rows = [_integers(row) for row in equations if any(row)]
    reduced, denominator, rank = fmpz_mat(rows).rref() if rows else (fmpz_mat(0, width), 1, 0)
    pivots: list[int] = []
    for number in range(rank):
        pivots.append(next(c for c in range(pivots[-1] + 1 if pivots else 0, width) if reduced[number, c]))
    free = sorted(set(range(width)) - set(pivots))
    kernel = fmpz_mat(len(free), width)
    for number, column in enumerate(free):
        kernel[number, column] = denominator
        for row, pivot in enumerate(pivots):
            kernel[number, pivot] = -reduced[row, column]
    return fmpq_mat(kernel) * fmpq(1, denominator), free


def _integers(row: Sequence[fmpq]) -> list[int]:
    common = reduce(lcm, (int(value.q) for value in row), 1)
    return [int(value * common) for value in row]
