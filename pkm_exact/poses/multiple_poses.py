"""The multiplicity of every pose of a list that is complete, exactly.

At least 2^c, where the Jacobian has the corank c at an isolated pose and there are as many equations as freedoms
(``poses.wrenches``).

By the algebra. Let A be the quotient algebra over Q of the poses, u a combination of its unknowns, and f the
irreducible factors of the eliminant. By Stickelberger's theorem (Cox, Little and O'Shea, Using Algebraic Geometry,
section 4.2) the multiplication by u has the characteristic polynomial

    chi(X) = prod_f g_f(X)^m_f,   g_f(X) = prod over the roots t of f of (X - u(t)),

with m_f the multiplicity of the poses at the roots of f. The equation holds modulo every prime p that divides no
denominator. If the images of the g_f are pairwise coprime there, m_f is the greatest m for which g_f^m divides chi
modulo p: an exact number, although nothing is computed but images.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, islice
from random import Random
from typing import TYPE_CHECKING, TypeAlias

from flint import fmpz_poly, nmod_mat, nmod_poly

from pkm_exact.algebra.primes import primes_from
from pkm_exact.errors import InternalContradictionError
from pkm_exact.formulations.motion_variety import MOTION_COORDINATES
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import evaluate, motion_quadrics
from pkm_exact.policy import Policy
from pkm_exact.poses.pose_representation import PoseRepresentation
from pkm_exact.poses.singularity import are_isolated, singularity
from pkm_exact.poses.wrenches import least_multiplicity

if TYPE_CHECKING:
    from pkm_exact.algebra.exact_quotient import ExactQuotient

Multiplicities: TypeAlias = tuple[tuple[fmpz_poly, int], ...]
"""Irreducible factors of the eliminant, with the multiplicity of the poses at their roots."""

# Places of MOTION_COORDINATES in ``geometry.study.motion_quadrics``.
_PLACES = dict(zip(MOTION_COORDINATES, (*range(1, 7), 0, *range(7, 16)), strict=True))


def least_multiplicities(representation: PoseRepresentation, problem: ForwardProblem, policy: Policy) -> Multiplicities:
    """Lower bounds of the multiplicities of isolated poses, by the coranks of the Jacobian."""
    return tuple(
        (factor, 1)
        if are_isolated(representation, problem, policy, factor)
        else (factor, least_multiplicity(problem, singularity(representation, problem, factor).rank))
        for factor, _ in representation.univariate.primitive_polynomial.factor()[1]
    )


def total_of(found: Multiplicities) -> int:
    """Number of solutions with multiplicity."""
    return sum(multiplicity * int(factor.degree()) for factor, multiplicity in found)


def exact_multiplicities(
    representation: PoseRepresentation,
    problem: ForwardProblem,
    quotient: ExactQuotient,
    unknowns: Sequence[str],
    policy: Policy,
) -> Multiplicities:
    """The multiplicities of all poses.

    Parameters
    ----------
    representation : PoseRepresentation
        Of all poses, verified.
    quotient : ExactQuotient
        The quotient algebra of the poses, its matrices commuting.
    unknowns : sequence of str
        Names of its unknowns, of ``MOTION_COORDINATES``.
    policy : Policy

    Raises
    ------
    InternalContradictionError
        If no combination of the unknowns that was tried takes different values at poses that are not conjugate.
    """
    factors = [factor for factor, _ in representation.univariate.primitive_polynomial.factor()[1]]
    seed = policy.seed_for(problem.digest, "multiplicities")
    random = Random(seed)
    for prime in islice(primes_from(seed, policy.prime_bits), policy.attempts):
        weights = {name: random.randrange(1, prime) for name in unknowns}
        found = _modulo(representation, problem.metric, factors, quotient, weights, prime)
        if found is not None:
            return tuple(zip(factors, found, strict=True))
    raise InternalContradictionError("no combination of the unknowns tells the multiple poses apart")


def _modulo(
    representation: PoseRepresentation,
    metric: Sequence[int],
    factors: Sequence[fmpz_poly],
    quotient: ExactQuotient,
    weights: dict[str, int],
    prime: int,
) -> list[int] | None:
    """The multiplicities at the roots of the factors, or None if this prime or these weights do not tell them."""
    left = quotient.characteristic_polynomial(tuple(weights.values()), prime)
    if left is None or any(int(factor.leading_coefficient()) % prime == 0 for factor in factors):
        return None
    parts = [_part(representation, metric, factor, weights, prime) for factor in factors]
    known = [part for part in parts if part is not None]
    if len(known) < len(parts) or any(a.gcd(b).degree() > 0 for a, b in combinations(known, 2)):
        return None
    return [_exponent(part, left) for part in known]


def _part(
    representation: PoseRepresentation, metric: Sequence[int], factor: fmpz_poly, weights: dict[str, int], prime: int
) -> nmod_poly | None:
    """The image of g_f, or None if some rotation has N(e) = 0 modulo the prime."""
    modulus = nmod_poly([int(value) % prime for value in factor.coeffs()], prime)
    x = [
        nmod_poly([value % prime for value in numerator], prime) % modulus
        for numerator in representation.univariate.numerators
    ]
    products = [[left * right % modulus for right in x] for left in x]
    quadrics = motion_quadrics(metric)
    total = nmod_poly([0], prime)
    for name, weight in weights.items():
        total += weight * evaluate(quadrics[_PLACES[name]], products)
    divisor, inverse, _ = (evaluate(quadrics[-1], products) % modulus).xgcd(modulus)
    if divisor.degree() != 0:
        return None
    power = total * inverse % modulus
    size = int(modulus.degree())
    rows = []
    for _ in range(size):
        coefficients = [int(value) for value in power.coeffs()]
        rows.append(coefficients + [0] * (size - len(coefficients)))
        power = power * nmod_poly([0, 1], prime) % modulus
    return nmod_mat(size, size, [value for row in rows for value in row], prime).charpoly()


def _exponent(part: nmod_poly, product: nmod_poly) -> int:
    """The greatest m for which part^m divides the product."""
    exponent = 0
    while product and not product % part:
        product, exponent = product // part, exponent + 1
    return exponent
