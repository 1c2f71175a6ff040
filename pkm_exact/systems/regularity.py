"""Where the derivatives of a system have full rank: isolated and simple solutions, and weights of the others.

At an isolated solution at which the Jacobian has the corank c the multiplicity is at least 2^c, if there are as many
polynomials as
unknowns (Fulton, Intersection Theory, 12.4), and at least 1 + c in any case: all derivatives of order 1 of c
functions are 0.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from random import Random
from typing import Any, TypeAlias

from flint import fmpq_poly, fmpz_mpoly, fmpz_poly, nmod_poly

from pkm_exact.algebra.primes import primes_from
from pkm_exact.algebra.representation import UnivariateRepresentation
from pkm_exact.policy import Policy

Table: TypeAlias = Sequence[Sequence[fmpz_mpoly]]
"""A matrix of polynomials."""
Weights: TypeAlias = tuple[tuple[tuple[int, ...], int], ...]
"""Factors of an eliminant, by their coefficients, each with a number for the solutions at its roots."""
ATTEMPTS = 2
"""Primes that are asked whether a rank is full."""
_LARGEST_WEIGHT = 1 << 16


def derivatives(polynomials: Sequence[fmpz_mpoly], size: int) -> list[list[fmpz_mpoly]]:
    """The Jacobian matrix, one row for each polynomial."""
    return [[polynomial.derivative(j) for j in range(size)] for polynomial in polynomials]


def has_full_rank(
    table: Table, points: UnivariateRepresentation, policy: Policy, factor: fmpz_poly | None = None
) -> bool:
    """Whether it is proved, modulo a prime, that the columns of a matrix are independent at all points.

    Parameters
    ----------
    table : sequence of rows
    points : UnivariateRepresentation
    policy : Policy
    factor : fmpz_poly, optional
        A primitive factor of the eliminant, if only the points at its roots are asked about.
    """
    h = points.primitive_polynomial if factor is None else factor
    seed = policy.seed_for(list(map(int, h.coeffs())), "rank")
    for prime in islice(_usable(primes_from(seed, policy.prime_bits), points), ATTEMPTS):
        modulus = nmod_poly(h, prime)
        inverse = nmod_poly(points.polynomial.derivative(), prime).xgcd(modulus)[1]
        x = [nmod_poly(n, prime) * inverse % modulus for n in points.numerator_polynomials]
        matrix = _evaluated(table, x, modulus, nmod_poly([1], prime))
        if _units(_mixed(matrix, Random(seed)), modulus):
            return True
    return False


def weights_at(table: Table, points: UnivariateRepresentation, policy: Policy, *, square: bool) -> Weights:
    """For each irreducible factor of the eliminant a lower bound of the multiplicity of the points at its roots."""
    found = []
    for factor, _ in points.primitive_polynomial.factor()[1]:
        key = tuple(map(int, factor.coeffs()))
        is_full = has_full_rank(table, points, policy, factor)
        corank = 0 if is_full else len(table[0]) - _rank(table, points, factor)
        found.append((key, 2**corank if square else 1 + corank))
    return tuple(found)


def total_weight(weights: Weights) -> int:
    """The sum over all points."""
    return sum((len(key) - 1) * weight for key, weight in weights)


def _usable(primes: Iterator[int], points: UnivariateRepresentation) -> Iterator[int]:
    """Primes modulo which the eliminant keeps its degree and stays squarefree."""
    for prime in primes:
        image = nmod_poly(points.primitive_polynomial, prime)
        if image.degree() == points.degree and image.gcd(image.derivative()).degree() == 0:
            yield prime


def _evaluated(table: Table, x: Sequence[Any], modulus: Any, one: Any) -> list[list[Any]]:
    """The matrix at a point whose coordinates are residues modulo a polynomial over a field."""
    known: dict[tuple[int, ...], Any] = {(0,) * len(x): one % modulus}

    def monomial(exponents: tuple[int, ...]) -> Any:
        if exponents not in known:
            index = next(i for i, exponent in enumerate(exponents) if exponent)
            smaller = (*exponents[:index], exponents[index] - 1, *exponents[index + 1 :])
            known[exponents] = monomial(smaller) * x[index] % modulus
        return known[exponents]

    def value(polynomial: fmpz_mpoly) -> Any:
        total = 0 * one
        for exponents, coefficient in polynomial.to_dict().items():
            total += int(coefficient) * monomial(tuple(map(int, exponents)))
        return total

    return [[value(entry) for entry in row] for row in table]


def _mixed(matrix: list[list[Any]], random: Random) -> list[list[Any]]:
    """Random combinations of the rows, as many as there are columns: if all columns are independent, so they stay."""
    size = len(matrix[0])
    if len(matrix) < size:
        return matrix
    weights = [[random.randrange(1, _LARGEST_WEIGHT) for _ in matrix] for _ in range(size)]
    return [
        [sum((w * row[j] for w, row in zip(line, matrix, strict=True)), 0 * matrix[0][j]) for j in range(size)]
        for line in weights
    ]


def _units(matrix: list[list[Any]], modulus: Any) -> bool:
    """Whether elimination finds a unit as pivot in every column: then some minor is coprime to the modulus."""
    left = matrix
    for column in range(len(matrix[0])):
        for row in left:
            divisor, inverse, _ = row[column].xgcd(modulus)
            if row[column] and divisor.degree() == 0:
                break
        else:
            return False
        left = _reduced(left, row, column, inverse, modulus)
    return True


def _reduced(rows: list[list[Any]], pivot: list[Any], column: int, inverse: Any, modulus: Any) -> list[list[Any]]:
    """The other rows with a 0 in a column."""
    scaled = [entry * inverse % modulus for entry in pivot]
    return [
        [(a - row[column] * b) % modulus for a, b in zip(row, scaled, strict=True)] if row[column] else row
        for row in rows
        if row is not pivot
    ]


def _rank(table: Table, points: UnivariateRepresentation, factor: fmpz_poly) -> int:
    """The rank over the field Q[T] / factor."""
    modulus = fmpq_poly(factor)
    inverse = fmpq_poly(points.polynomial.derivative()).xgcd(modulus)[1]
    x = [fmpq_poly(n) * inverse % modulus for n in points.numerator_polynomials]
    left = _evaluated(table, x, modulus, fmpq_poly([1]))
    rank = 0
    for column in range(len(table[0])):
        pivot = next((row for row in left if row[column]), None)
        if pivot is not None:
            rank += 1
            left = _reduced(left, pivot, column, pivot[column].xgcd(modulus)[1], modulus)
    return rank
