"""Proofs by ranks modulo a prime: nothing at infinity, finitely many points, no point at all.

Ranks of integer matrices are no smaller over Q than modulo a prime. So if homogeneous polynomials contain all
monomials of some degree modulo a prime, they do over Q, and the dimension of what they leave is over Q no greater.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import islice
from random import Random
from typing import Final

from flint import fmpz_mpoly

from pkm_exact.algebra.exact_basis import ExactBasis
from pkm_exact.algebra.graded_algebra import Form, graded_dimensions
from pkm_exact.algebra.primes import primes_from
from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.policy import Policy

ATTEMPTS: Final = 2
"""Primes that are asked: "no" may be the prime's fault."""
MOST_IN_SPACE: Final = 20_000
"""Dimension up to which finiteness is proved in projective space."""
LAST_DEGREE: Final = 200


def top_form(terms: Iterable[tuple[tuple[int, ...], int]]) -> Form:
    """The terms of greatest degree.

    Examples
    --------
    >>> top_form([((2, 0), 3), ((1, 0), 1), ((1, 1), -1)])
    {(2, 0): 3, (1, 1): -1}
    """
    listed = list(terms)
    degree = max(sum(exponents) for exponents, _ in listed)
    return {exponents: value for exponents, value in listed if sum(exponents) == degree}


def terms_of(polynomial: fmpz_mpoly) -> list[tuple[tuple[int, ...], int]]:
    """Exponents and coefficients."""
    return [(tuple(map(int, exponents)), int(value)) for exponents, value in polynomial.to_dict().items()]


def homogeneous(polynomial: fmpz_mpoly) -> Form:
    """The polynomial made homogeneous by a further, first variable."""
    degree = int(polynomial.total_degree())
    return {(degree - sum(exponents), *exponents): value for exponents, value in terms_of(polynomial)}


def elements_of(basis: ExactBasis) -> list[Form]:
    """The elements of an elimination, as top forms."""
    return [top_form((basis.ring.unpack(monomial), value) for monomial, value in element) for element in basis.elements]


def number_of(size: int, forms: Sequence[Form], most: int, policy: Policy, seed: int) -> int | None:
    """The dimension that homogeneous polynomials leave, modulo a prime; None if it is above ``most``, or infinite."""
    last = last_degree(size, forms)
    for prime in islice(primes_from(policy.seed_for(seed, "ranks"), policy.prime_bits), ATTEMPTS):
        found = graded_dimensions(size, forms, prime, last, most)
        if found is not None:
            return sum(found)
    return None


def last_degree(size: int, forms: Sequence[Form]) -> int:
    """The degree in which, at the latest, nothing is left if anything ever is: Macaulay's bound, of n general ones."""
    degrees = sorted((sum(next(iter(form))) for form in forms), reverse=True)
    return min(sum(degree - 1 for degree in degrees[:size]) + 1, LAST_DEGREE)


def room_for(system: PolynomialSystem, most: int, policy: Policy) -> int | None:
    """How many solutions there are at most, if nothing is at infinity; None if more than ``most``."""
    forms = [top_form(terms_of(polynomial)) for polynomial in system.polynomials]
    return number_of(len(system.unknowns), forms, most, policy, system.digest)


def is_empty_in_space(system: PolynomialSystem, policy: Policy) -> bool:
    """Whether it is proved that the polynomials have no common zero in projective space, so none at all."""
    forms = [homogeneous(polynomial) for polynomial in system.polynomials]
    return number_of(len(system.unknowns) + 1, forms, MOST_IN_SPACE, policy, system.digest) is not None


def is_finite_in_space(system: PolynomialSystem, policy: Policy) -> bool:
    """Whether it is proved that the common zeros in projective space, at infinity too, are finitely many."""
    size = len(system.unknowns) + 1
    random = Random(policy.seed_for(system.digest, "hyperplane"))
    further = {tuple(int(i == j) for j in range(size)): random.randrange(1, 1 << 30) for i in range(size)}
    forms = [*(homogeneous(polynomial) for polynomial in system.polynomials), further]
    return number_of(size, forms, MOST_IN_SPACE, policy, system.digest) is not None
