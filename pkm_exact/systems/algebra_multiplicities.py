"""The multiplicities of all solutions, from the quotient algebra over Q.

Multiplication by a combination u of the unknowns has the characteristic polynomial prod_f g_f^m_f over the
irreducible factors f of the
eliminant, g_f the product of X - u(t) over the roots t of f (Stickelberger; Cox, Little and O'Shea, Using Algebraic
Geometry, 4.2). Modulo a prime at which the g_f are coprime the m_f are read off.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, islice
from random import Random

from flint import fmpz_poly, nmod_mat, nmod_poly

from pkm_exact.algebra.exact_quotient import ExactQuotient
from pkm_exact.algebra.primes import primes_from
from pkm_exact.algebra.representation import UnivariateRepresentation
from pkm_exact.policy import Policy
from pkm_exact.systems.regularity import Weights


def algebra_multiplicities(
    representation: UnivariateRepresentation, quotient: ExactQuotient, policy: Policy
) -> Weights | None:
    """The factors with the multiplicity of the solutions at their roots; None if no combination tried tells them."""
    factors = [factor for factor, _ in representation.primitive_polynomial.factor()[1]]
    seed = policy.seed_for([list(map(int, factor.coeffs())) for factor in factors], "multiplicities")
    random = Random(seed)
    for prime in islice(primes_from(seed, policy.prime_bits), policy.attempts):
        weights = [random.randrange(1, prime) for _ in representation.numerators]
        found = _modulo(representation, factors, quotient, weights, prime)
        if found is not None:
            return tuple(
                (tuple(map(int, factor.coeffs())), number) for factor, number in zip(factors, found, strict=True)
            )
    return None


def _modulo(
    representation: UnivariateRepresentation,
    factors: Sequence[fmpz_poly],
    quotient: ExactQuotient,
    weights: Sequence[int],
    prime: int,
) -> list[int] | None:
    whole = quotient.characteristic_polynomial(weights, prime)
    if whole is None or any(int(factor.leading_coefficient()) % prime == 0 for factor in factors):
        return None
    parts = [_part(representation, factor, weights, prime) for factor in factors]
    known = [part for part in parts if part is not None]
    if len(known) < len(parts) or any(a.gcd(b).degree() > 0 for a, b in combinations(known, 2)):
        return None
    return [_exponent(part, whole) for part in known]


def _part(
    representation: UnivariateRepresentation, factor: fmpz_poly, weights: Sequence[int], prime: int
) -> nmod_poly | None:
    """The image of g_f; None if h' is not a unit modulo f and the prime."""
    modulus = nmod_poly(factor, prime)
    divisor, inverse, _ = nmod_poly(representation.polynomial.derivative(), prime).xgcd(modulus)
    if divisor.degree() != 0:
        return None
    value = nmod_poly([0], prime)
    for weight, numerator in zip(weights, representation.numerator_polynomials, strict=True):
        value += weight * nmod_poly(numerator, prime)
    power, size = value * inverse % modulus, int(modulus.degree())
    rows: list[int] = []
    for _ in range(size):
        rows += [int(power[place]) for place in range(size)]
        power = power * nmod_poly([0, 1], prime) % modulus
    return nmod_mat(size, size, rows, prime).charpoly()


def _exponent(part: nmod_poly, product: nmod_poly) -> int:
    """The greatest m for which part^m divides the product."""
    exponent = 0
    while product and not product % part:
        product, exponent = product // part, exponent + 1
    return exponent
