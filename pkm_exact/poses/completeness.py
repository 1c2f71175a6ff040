"""Proofs that a verified list of poses is all there is.

Refined Bezout. Rigid motions form a projective variety of dimension 6 and degree 40 in P^16 on which every leg is a
hyperplane (Gallet, Nawratil and Schicho 2015). By the refined theorem of Bezout (Fulton, Intersection Theory, 12.3) the
irreducible components of the section by six hyperplanes have degrees that sum to at most 40. Forty distinct poses, each
isolated because the Jacobian of the legs is regular there, are forty components: nothing else can be left, neither
another pose nor a self-motion.

Exact elimination. Robots with symmetries have fewer finite solutions, the rest at infinity. An elimination over Q in
the affine coordinates of the section yields members of the ideal of the poses, and the monomials that none of their
leading monomials divide span its quotient algebra. If these are as many as the poses listed, there is no other. If
they are more, the trace form over Q counts the distinct ones (``algebra.exact_quotient``): as many as listed, and again
there is no other. A pose with a regular Jacobian is simple; if the others are conjugate, they share what is left.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice

from flint import fmpz_poly, nmod_poly

from pkm_exact.algebra.elimination import Elimination
from pkm_exact.algebra.exact_basis import ExactBasis, exact_basis
from pkm_exact.algebra.exact_quotient import exact_quotient
from pkm_exact.algebra.newton import is_regular
from pkm_exact.algebra.primes import primes_below
from pkm_exact.algebra.quotient import standard_monomials
from pkm_exact.errors import InternalContradictionError
from pkm_exact.formulations.motion_variety import SE3
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.policy import Policy
from pkm_exact.poses.representation import PoseRepresentation
from pkm_exact.poses.study_equations import StudyEquations
from pkm_exact.verdict import CompletenessRoute

MOTION_DEGREE = 40
"""Degree of the variety of rigid motions in P^16."""


@dataclass(frozen=True)
class CompletenessProof:
    """How a list of poses was proved complete, with what is needed to replay it.

    Attributes
    ----------
    route : CompletenessRoute
    total : int
        Number of complex poses with multiplicity.
    elimination : tuple of tuple of (int, tuple of int)
        For exact elimination: the rows of every matrix, each an element's index and the exponents that multiply it
        (see ``algebra.exact_basis``), on the section of the variety of rigid motions as ``SE3`` writes it.
    """

    route: CompletenessRoute
    total: int
    elimination: tuple[tuple[tuple[int, tuple[int, ...]], ...], ...] = ()


def prove_complete(
    representation: PoseRepresentation, problem: ForwardProblem, policy: Policy
) -> CompletenessProof | None:
    """A proof that a verified representation is complete, or None if none of those known here applies."""
    degree = representation.univariate.degree
    if (
        len(problem.legs) == 6
        and not problem.planar
        and degree == MOTION_DEGREE
        and are_isolated(representation, problem, policy)
    ):
        return CompletenessProof(CompletenessRoute.REFINED_BEZOUT, degree)
    basis = eliminate_exactly(problem, policy)
    bound = None if basis is None else solution_bound(basis, policy)
    if basis is None or bound is None:
        return None
    if bound == degree:
        return _elimination_proof(basis, bound)
    quotient = exact_quotient(basis, policy.dimension_limit)
    if quotient is not None and quotient.commutes and quotient.distinct_solutions == degree:
        return _elimination_proof(basis, bound)
    return None


def multiplicities(
    representation: PoseRepresentation, problem: ForwardProblem, total: int | None, policy: Policy
) -> tuple[tuple[fmpz_poly, int | None], ...]:
    """Factors of h with the multiplicity of their roots as poses; None where it is not determined.

    Parameters
    ----------
    representation : PoseRepresentation
        Verified.
    total : int or None
        Number of solutions with multiplicity, if the representation is proved complete.
    """
    h = representation.univariate.primitive_polynomial
    if total == h.degree():
        return ((h, 1),)
    if are_isolated(representation, problem, policy):
        if total is not None:
            raise InternalContradictionError(
                "all poses are simple, but there are fewer than solutions with multiplicity"
            )
        return ((h, 1),)
    factors = [factor for factor, _ in h.factor()[1]]
    if total is None:
        return tuple((factor, None) for factor in factors)
    singular = [factor for factor in factors if not are_isolated(representation, problem, policy, factor)]
    left = total - sum(int(factor.degree()) for factor in factors if factor not in singular)
    if len(singular) != 1:
        return tuple((factor, None if factor in singular else 1) for factor in factors)
    shared, rest = divmod(left, int(singular[0].degree()))
    if rest or shared < 2:
        raise InternalContradictionError("the multiplicities do not sum to the number of solutions")
    return tuple((factor, shared if factor in singular else 1) for factor in factors)


def prove_inconsistent(problem: ForwardProblem, policy: Policy) -> CompletenessProof | None:
    """A proof that no complex pose exists, by an elimination over Q that ends in a constant; None if it does not."""
    basis = eliminate_exactly(problem, policy)
    return _elimination_proof(basis, 0) if basis is not None and solution_bound(basis, policy) == 0 else None


def eliminate_exactly(problem: ForwardProblem, policy: Policy) -> ExactBasis | None:
    """The elimination over Q of the poses' ideal, along a trace modulo a prime; None if that is not finite there."""
    system = SE3().formulate(problem).system
    image = Elimination(system, policy).image(record=True)
    if image.algebra is None or image.basis.trace is None:
        return None
    return exact_basis(system, image.basis.trace)


def solution_bound(basis: ExactBasis, policy: Policy) -> int | None:
    """An upper bound for the number of solutions with multiplicity, or None if the staircase is infinite."""
    found = standard_monomials(basis.ring, basis.leading_monomials, policy.dimension_limit)
    return None if found is None else len(found)


def _elimination_proof(basis: ExactBasis, total: int) -> CompletenessProof:
    steps = tuple(tuple((index, basis.ring.unpack(monomial)) for index, monomial in step) for step in basis.steps)
    return CompletenessProof(CompletenessRoute.EXACT_ELIMINATION, total, steps)


def are_isolated(
    representation: PoseRepresentation, problem: ForwardProblem, policy: Policy, factor: fmpz_poly | None = None
) -> bool:
    """Whether the Jacobian of the legs is proved regular at every pose, by its image modulo some prime.

    "No" means that no proof was found at the primes tried. With a ``factor`` of h only its roots are looked at.
    """
    h = representation.univariate.polynomial
    looked_at = h if factor is None else factor
    usable = (prime for prime in primes_below(policy.prime_bits) if int(h.leading_coefficient()) % prime)
    for attempt, prime in enumerate(islice(usable, policy.attempts)):
        eliminant = nmod_poly([int(value) % prime for value in looked_at.coeffs()], prime)
        slope = nmod_poly([int(value) % prime for value in h.derivative().coeffs()], prime)
        divisor, inverse, _ = slope.xgcd(eliminant)
        if divisor.degree() != 0:
            continue
        equations = StudyEquations(problem, representation.chart, policy.seed + attempt)
        numerators = [representation.univariate.numerators[k] for k in equations.free]
        point = [
            nmod_poly([value % prime for value in numerator], prime) * inverse % eliminant for numerator in numerators
        ]
        if is_regular(equations, eliminant / eliminant.leading_coefficient(), point):
            return True
    return False
