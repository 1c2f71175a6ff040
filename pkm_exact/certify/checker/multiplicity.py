"""Simple and multiple solutions: where the six leg lines are independent, and where they are not. All exact.

The derivative of |C + R B - A|^2 / 2 along a velocity v and an angular velocity w is d.v + (b x d).w, where
d = C + R B - A is the leg and b = R B its arm. If the six lines (d, b x d) are independent, no tangent direction keeps
all lengths: the solution is isolated and simple. If they are not, its multiplicity is at least 2.

How multiple, the algebra of all poses says: see ``multiplicities``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations
from typing import Any, Final, TypeAlias

from flint import fmpq_poly, fmpz_poly, nmod_mat, nmod_poly

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.document import Representation
from pkm_exact.certify.checker.section import unknowns
from pkm_exact.certify.checker.solutions import (
    algebraic_cost,
    irreducible_factors,
    modulo,
    primes_for,
    primitive_part,
    proved_coprime,
)
from pkm_exact.certify.checker.study_motion import Leg, Metric, combination, leg_lines, motion
from pkm_exact.certify.checker.traceform import Algebra

BASES: Final = (3, 5, 7)
"""The unknowns are combined with the powers of one of these numbers; any combination serves that separates."""


_PRODUCTS: Final = 400
"""More than the products in the leg lines and their determinant."""


def are_simple(representation: Representation, legs: Sequence[Leg], metric: Metric) -> bool:
    """Whether all solutions are proved simple; "no" means that no proof was found."""
    return _is_proved_simple(primitive_part(representation.eliminant), representation, legs, metric)


def dependent_factors(representation: Representation, legs: Sequence[Leg], metric: Metric) -> tuple[fmpz_poly, ...]:
    """The irreducible factors of h at whose roots the leg lines are dependent; at others they are not. Exact."""
    factors = irreducible_factors(primitive_part(representation.eliminant))
    doubtful = [
        factor for factor in factors if not _is_proved_simple(factor, representation, legs, metric, briefly=True)
    ]
    return tuple(factor for factor in doubtful if _are_dependent(factor, representation, legs, metric))


def _is_proved_simple(
    factor: fmpz_poly, representation: Representation, legs: Sequence[Leg], metric: Metric, *, briefly: bool = False
) -> bool:
    """Whether the leg lines are proved independent at every root of a primitive factor of h, modulo some prime."""

    def determinant(p: int) -> Any:
        numerators = (*representation.quaternion, *representation.translation)
        charge(_PRODUCTS * 40000)
        return _lines_determinant([modulo(x, p) for x in numerators], modulo(factor, p), legs, metric)

    return proved_coprime(factor, determinant, briefly=briefly)


def _are_dependent(factor: fmpz_poly, representation: Representation, legs: Sequence[Leg], metric: Metric) -> bool:
    """Whether the leg lines are dependent at every root of an irreducible factor of h, over Q."""
    numerators = (*representation.quaternion, *representation.translation)
    charge(_PRODUCTS * algebraic_cost(factor, representation, 4 * len(legs)))
    return not _lines_determinant([fmpq_poly(x) for x in numerators], fmpq_poly(factor), legs, metric)


def multiplicities(
    algebra: Algebra, representation: Representation, legs: Sequence[Leg], metric: Metric
) -> list[tuple[fmpz_poly, int]] | None:
    """Those of the solutions of a robot with legs."""
    return multiplicities_of(algebra, representation, metric, unknowns(legs, metric))


def multiplicities_of(
    algebra: Algebra, representation: Representation, metric: Metric, places: Sequence[int]
) -> list[tuple[fmpz_poly, int]] | None:
    """Those of poses, the unknowns being the coordinates at these places."""

    def value(modulus: nmod_poly, weights: Sequence[int], p: int) -> nmod_poly | None:
        x = [
            Residue(modulo(numerator, p) % modulus, modulus)
            for numerator in (*representation.quaternion, *representation.translation)
        ]
        placed = motion(x[:4], x[4:], metric)
        rotation = [entry for row in placed.rotation for entry in row]
        ordered = [*placed.turned, *placed.position, placed.square, *rotation]
        divisor, inverse, _ = placed.norm.value.xgcd(modulus)
        if divisor.degree() > 0:
            return None
        total = combination(list(weights), [ordered[place] for place in places]).value
        found: nmod_poly = total * inverse % modulus
        return found

    return multiplicities_by(algebra, primitive_part(representation.eliminant), len(places), value)


Value: TypeAlias = Callable[[nmod_poly, Sequence[int], int], "nmod_poly | None"]
"""A combination of the unknowns at the roots of a polynomial modulo p, with given weights; None if it has no image."""


def multiplicities_by(algebra: Algebra, h0: fmpz_poly, size: int, value: Value) -> list[tuple[fmpz_poly, int]] | None:
    """The irreducible factors f of h, each with the multiplicity of the solutions at its roots; None if not found.

    Over Q, multiplication by u has the characteristic polynomial prod_f g_f^m, with g_f the product of X - u(t) over
    the roots t of f. It has so modulo p too, and if the g_f are coprime there, m can be read off.
    """
    factors = irreducible_factors(h0)
    for p, base in ((p, base) for base in BASES for p in primes_for(h0)):
        weights = [pow(base, power, p) for power in range(size)]
        whole = algebra.characteristic_polynomial(weights, p)
        parts = [_part(factor, value, weights, p) for factor in factors]
        known = [part for part in parts if part is not None]
        if whole is None or len(known) < len(parts) or any(a.gcd(b).degree() > 0 for a, b in combinations(known, 2)):
            continue
        return [(factor, sum(1 for _ in _quotients(whole, part))) for factor, part in zip(factors, known, strict=True)]
    return None


def _part(factor: fmpz_poly, value: Value, weights: Sequence[int], p: int) -> nmod_poly | None:
    """g_f modulo p; None if f has not its degree there, or the value no image."""
    charge(3 * 10**6 + 100 * int(factor.length()) ** 3)
    modulus = modulo(factor, p)
    u = None if modulus.degree() < factor.degree() else value(modulus, weights, p)
    if u is None:
        return None
    size = int(modulus.degree())
    rows = []
    for _ in range(size):
        rows += [int(u[power]) for power in range(size)]
        u = u * nmod_poly([0, 1], p) % modulus
    return nmod_mat(size, size, rows, p).charpoly()


def _quotients(product: nmod_poly, part: nmod_poly) -> Iterator[nmod_poly]:
    """product / part, product / part^2, .. as long as the division leaves nothing."""
    while not product % part:
        product //= part
        yield product


def _lines_determinant(point: Sequence[Any], modulus: Any, legs: Sequence[Leg], metric: Metric) -> Any:
    """The determinant of the leg lines at (e, f), in the residue ring of a polynomial over a field."""
    x = [Residue(value % modulus, modulus) for value in point]
    return determinant(leg_lines(legs, motion(x[:4], x[4:], metric))).value


class Residue:
    """A polynomial over a field, modulo another."""

    __slots__ = ("modulus", "value")

    def __init__(self, value: Any, modulus: Any) -> None:
        self.value = value
        self.modulus = modulus

    def __add__(self, other: Residue) -> Residue:
        return Residue(self.value + other.value, self.modulus)

    def __sub__(self, other: Residue) -> Residue:
        return Residue(self.value - other.value, self.modulus)

    def __mul__(self, other: Residue) -> Residue:
        return Residue(self.value * other.value % self.modulus, self.modulus)

    def __rmul__(self, scalar: int) -> Residue:
        return Residue(scalar * self.value, self.modulus)


def determinant(matrix: Sequence[Sequence[Any]]) -> Any:
    """The determinant by expansion along one row after another, without division: n 2^(n-1) products."""
    size = len(matrix)
    minors = {1 << column: matrix[0][column] for column in range(size)}
    for row in matrix[1:]:
        wider: dict[int, Any] = {}
        for columns, minor in minors.items():
            for column in range(size):
                if columns >> column & 1:
                    continue
                term = row[column] * minor
                key = columns | 1 << column
                if key not in wider:  # its last column is the one that is added: subsets come in lexicographic order
                    wider[key] = term
                elif (columns >> column).bit_count() % 2:
                    wider[key] = wider[key] - term
                else:
                    wider[key] = wider[key] + term
        minors = wider
    return minors[(1 << size) - 1]
