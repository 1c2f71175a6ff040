"""Regular solutions, and weights of the others: where the derivatives of all polynomials have full rank. All exact."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from random import Random
from typing import Any, Final, TypeAlias

from flint import fmpq_poly, fmpz_poly, nmod_poly

from pkm_exact.certify.checker.budget import charge, limbs, polynomials_cost
from pkm_exact.certify.checker.solutions import irreducible_factors, modulo, primes_for, primitive_part
from pkm_exact.certify.checker.system_document import InfinitePoints, Points
from pkm_exact.certify.checker.system_terms import Monomial, Terms, derivative, homogeneous

Table: TypeAlias = Sequence[Sequence[Mapping[Monomial, int]]]
_LARGEST_WEIGHT: Final = 1 << 16
"""Rows are combined at random; any combinations that give a regular matrix serve."""


@dataclass(frozen=True)
class Weighed:
    """Points with weights: ``factors`` of the eliminant at whose roots the weight is not 1; none if all are regular."""

    total: int
    factors: tuple[tuple[fmpz_poly, int], ...]

    @property
    def are_regular(self) -> bool:
        """Whether all are proved isolated and simple."""
        return not self.factors


def weighed_solutions(points: Points, polynomials: Sequence[Terms]) -> Weighed:
    """The solutions with their weights."""
    size = len(points.numerators)
    table = [[derivative(polynomial, axis) for axis in range(size)] for polynomial in polynomials]
    return _weighed(table, points, square=len(polynomials) == size)


def weighed_at_infinity(infinity: InfinitePoints, polynomials: Sequence[Terms]) -> Weighed:
    """The points at infinity with their weights: rows of the homogeneous polynomials, and of the chart."""
    size = len(infinity.chart)
    zero = (0,) * (size + 1)
    table: list[list[Terms]] = [
        [derivative(homogeneous(polynomial), axis) for axis in range(size + 1)] for polynomial in polynomials
    ]
    table.append([{}, *({zero: value} if value else {} for value in infinity.chart)])
    points = infinity.points
    placed = Points((0, *points.form), points.eliminant, (fmpz_poly(), *points.numerators))
    return _weighed(table, placed, square=len(polynomials) == size)


def _weighed(table: Table, points: Points, *, square: bool) -> Weighed:
    h0 = primitive_part(points.eliminant)
    number = int(h0.degree())
    if _is_full(table, points, h0):
        return Weighed(number, ())
    found = []
    for factor in irreducible_factors(h0):
        if not _is_full(table, points, factor):
            corank = len(points.numerators) - _rank(table, points, factor)
            if corank:
                found.append((factor, 2**corank if square else 1 + corank))
    return Weighed(number + sum((weight - 1) * int(factor.degree()) for factor, weight in found), tuple(found))


def _is_full(table: Table, points: Points, factor: fmpz_poly) -> bool:
    """Whether the columns are proved independent at all roots of a primitive factor of h, modulo some prime."""
    columns = len(table[0])
    if len(table) < columns:
        return False
    terms = sum(len(entry) for row in table for entry in row)
    product = 3000 + 40 * int(factor.length()) * int(factor.length()).bit_length()
    for p in primes_for(factor):
        charge(product * (terms * 4 + columns * columns * (columns + len(table))))
        modulus = modulo(factor, p)
        if modulus.degree() < factor.degree():
            continue
        divisor, inverse, _ = modulo(points.eliminant.derivative(), p).xgcd(modulus)
        if divisor.degree() > 0:
            continue
        x = [modulo(value, p) * inverse % modulus for value in points.numerators]
        matrix = _evaluated(table, x, modulus, nmod_poly([1], p))
        if _has_unit_pivots(_mixed(matrix, columns), modulus):
            return True
    return False


def _rank(table: Table, points: Points, factor: fmpz_poly) -> int:
    """The rank over the field Q[T] / factor."""
    modulus = fmpq_poly(factor)
    columns = len(table[0])
    words = max(limbs(int(value.height_bits())) for value in (points.eliminant, *points.numerators))
    words += int(points.eliminant.degree()) * limbs(int(factor.height_bits()))
    degree = max((sum(monomial) for row in table for entry in row for monomial in entry), default=0)
    length, terms = 2 * int(factor.length()), sum(len(entry) for row in table for entry in row)
    charge(2 * terms * polynomials_cost(length, (degree + 1) * words))
    charge(2 * columns * columns * len(table) * polynomials_cost(length, (degree + 1) * columns * words))
    inverse = fmpq_poly(points.eliminant.derivative()).xgcd(modulus)[1]
    x = [fmpq_poly(value) * inverse % modulus for value in points.numerators]
    left = _evaluated(table, x, modulus, fmpq_poly([1]))
    rank = 0
    for column in range(columns):
        pivot = next((row for row in left if row[column]), None)
        if pivot is not None:
            rank += 1
            left = _cleared(left, pivot, column, pivot[column].xgcd(modulus)[1], modulus)
    return rank


def _evaluated(table: Table, x: Sequence[Any], modulus: Any, one: Any) -> list[list[Any]]:
    """The entries at a point, as residues modulo a polynomial over a field."""
    known: dict[Monomial, Any] = {(0,) * len(x): one % modulus}

    def power(monomial: Monomial) -> Any:
        if monomial not in known:
            axis = next(i for i, exponent in enumerate(monomial) if exponent)
            known[monomial] = power((*monomial[:axis], monomial[axis] - 1, *monomial[axis + 1 :])) * x[axis] % modulus
        return known[monomial]

    return [[sum((value * power(m) for m, value in entry.items()), 0 * one) for entry in row] for row in table]


def _mixed(matrix: list[list[Any]], size: int) -> list[list[Any]]:
    """As many random combinations of the rows as there are columns."""
    random = Random(len(matrix))
    weights = [[random.randrange(1, _LARGEST_WEIGHT) for _ in matrix] for _ in range(size)]
    zero = 0 * matrix[0][0]
    return [
        [sum((w * row[j] for w, row in zip(line, matrix, strict=True)), zero) for j in range(size)] for line in weights
    ]


def _has_unit_pivots(matrix: list[list[Any]], modulus: Any) -> bool:
    """Whether elimination finds a unit in every column: then the determinant is one."""
    left = matrix
    for column in range(len(matrix[0])):
        for row in left:
            divisor, inverse, _ = row[column].xgcd(modulus)
            if row[column] and divisor.degree() == 0:
                left = _cleared(left, row, column, inverse, modulus)
                break
        else:
            return False
    return True


def _cleared(rows: list[list[Any]], pivot: list[Any], column: int, inverse: Any, modulus: Any) -> list[list[Any]]:
    """The rows other than the pivot's, with 0 in a column."""
    scaled = [entry * inverse % modulus for entry in pivot]
    return [
        [(a - row[column] * b) % modulus for a, b in zip(row, scaled, strict=True)] if row[column] else row
        for row in rows
        if row is not pivot
    ]
