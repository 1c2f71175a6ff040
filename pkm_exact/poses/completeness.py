"""Proofs that a verified list of poses is all there is.

Rigid motions form a projective variety of dimension 6 and degree 40 in P^16 on which every leg is a hyperplane
(Gallet, Nawratil and Schicho 2015). By the refined theorem of Bezout (Fulton, Intersection Theory, 12.3) the
irreducible components of the section by six hyperplanes have degrees that sum to at most 40. Forty distinct poses, each
isolated because the Jacobian of the legs is regular there, are forty components: nothing else can be left, neither
another pose nor a self-motion.
"""

from __future__ import annotations

from itertools import islice

from flint import nmod_poly

from pkm_exact.algebra.newton import is_regular
from pkm_exact.algebra.primes import primes_below
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.policy import Policy
from pkm_exact.poses.representation import PoseRepresentation
from pkm_exact.poses.study_equations import StudyEquations, free_coordinates
from pkm_exact.verdict import CompletenessRoute

MOTION_DEGREE = 40
"""Degree of the variety of rigid motions in P^16."""


def proved_route(
    representation: PoseRepresentation, problem: ForwardProblem, policy: Policy
) -> CompletenessRoute | None:
    """The argument that proves a verified representation complete, or None if none of those known here applies."""
    full = len(problem.legs) == 6 and representation.univariate.degree == MOTION_DEGREE
    return CompletenessRoute.REFINED_BEZOUT if full and are_isolated(representation, problem, policy) else None


def are_isolated(representation: PoseRepresentation, problem: ForwardProblem, policy: Policy) -> bool:
    """Whether the Jacobian of the legs is proved regular at every pose, by its image modulo some prime.

    "No" means that no proof was found at the primes tried.
    """
    h = representation.univariate.polynomial
    usable = (prime for prime in primes_below(policy.prime_bits) if int(h.leading_coefficient()) % prime)
    for attempt, prime in enumerate(islice(usable, policy.attempts)):
        eliminant = nmod_poly([int(value) % prime for value in h.coeffs()], prime)
        divisor, inverse, _ = eliminant.derivative().xgcd(eliminant)
        if divisor.degree() != 0:
            continue
        equations = StudyEquations(problem, representation.chart, policy.seed + attempt)
        numerators = [representation.univariate.numerators[k] for k in free_coordinates(representation.chart)]
        point = [
            nmod_poly([value % prime for value in numerator], prime) * inverse % eliminant for numerator in numerators
        ]
        if is_regular(equations, eliminant / eliminant.leading_coefficient(), point):
            return True
    return False
