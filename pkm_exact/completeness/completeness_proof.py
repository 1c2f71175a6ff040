"""Proofs that a verified list of poses is all there is.

Refined Bezout. Rigid motions form a projective variety of dimension 6 and degree 40 in P^16 on which every leg is a
hyperplane (Gallet, Nawratil and Schicho 2015), and so do the smaller groups of motions, of smaller degrees. By the
refined theorem of Bezout (Fulton, Intersection Theory, 12.3) the irreducible components of the section by any number
of hyperplanes have degrees that sum to at most 40, or twice that for every cylinder, a quadric. Forty distinct poses,
each isolated because the Jacobian is regular there, are forty components: nothing else can be left, neither another
pose nor a self-motion.

Exact elimination. Robots with symmetries have fewer finite solutions, the rest at infinity. An elimination over Q in
the affine coordinates of the section yields members of the ideal of the poses, and the monomials that none of their
leading monomials divide span its quotient algebra. If these are as many as the poses listed, there is no other. If
they are more, some poses are multiple. A pose at which the Jacobian has corank c counts 2^c times at least
(``poses.multiple_poses``): if these numbers sum to the bound, again there is no other. Or else the trace form over Q
counts the distinct ones (``algebra.exact_quotient``), and there must be as many as listed.

The short ways (``short_proof``) are tried before an elimination. Robots with as many legs as freedoms are eliminated in
the coordinates of ``SE3``, as certificates of version 1 have it, others in those of the closed section.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pkm_exact.algebra.elimination_trace import Trace
from pkm_exact.algebra.exact_basis import ExactBasis, exact_basis
from pkm_exact.algebra.groebner import UnluckyPrimeError
from pkm_exact.algebra.modular_elimination import Elimination
from pkm_exact.algebra.quotient import standard_monomials
from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.claim import CompletenessRoute
from pkm_exact.failures.contradiction import require
from pkm_exact.formulations.motion_variety import SE3
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.policy import Policy
from pkm_exact.poses.multiple_poses import Multiplicities, exact_multiplicities, least_multiplicities, total_of
from pkm_exact.poses.pose_representation import PoseRepresentation
from pkm_exact.poses.self_motion import is_of_legs
from pkm_exact.poses.singularity import are_isolated
from pkm_exact.stages import Watch

if TYPE_CHECKING:
    from pkm_exact.completeness.closed_section import ClosedSection
    from pkm_exact.completeness.conditions import Conditions
    from pkm_exact.completeness.infinity import PointsAtInfinity
    from pkm_exact.completeness.shared_boundary import SharedBoundary


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
        (see ``algebra.exact_basis``), on the section of the variety of rigid motions that ``elimination_system`` gives.
    multiplicities : tuple of (fmpz_poly, int)
        The irreducible factors of the eliminant with the multiplicity of the poses at their roots, if some are
        multiple; empty if all are simple.
    infinity : PointsAtInfinity or None
        For counting at infinity: the points there.
    """

    route: CompletenessRoute
    total: int
    elimination: tuple[tuple[tuple[int, tuple[int, ...]], ...], ...] = ()
    multiplicities: Multiplicities = ()
    infinity: PointsAtInfinity | None = None


def has_as_many_legs_as_freedoms(problem: ForwardProblem) -> bool:
    """Whether it is a hexapod or a planar robot with three legs, which certificates of version 1 can describe.

    The legs of such robots have no names; constraints that a model declares one by one have.
    """
    unnamed = not any(constraint.name for constraint in problem.constraints)
    return unnamed and is_of_legs(problem) and len(problem.constraints) == problem.motion.dimension


def elimination_system(problem: ForwardProblem, section: ClosedSection | None = None) -> PolynomialSystem:
    """The system that is eliminated over Q; the closed section is found unless it is given."""
    if has_as_many_legs_as_freedoms(problem):
        return SE3().formulate(problem).system
    if section is None:
        _, section = _closed(problem)
    return section.system


def _closed(problem: ForwardProblem) -> tuple[Conditions, ClosedSection]:
    """What the robot asks, and its closed section; planar robots with three legs need not load either."""
    from pkm_exact.completeness.closed_section import closed_section
    from pkm_exact.completeness.conditions import Conditions

    conditions = Conditions.of(problem)
    return conditions, closed_section(conditions)


def prove_complete(
    representation: PoseRepresentation,
    problem: ForwardProblem,
    policy: Policy,
    watch: Watch | None = None,
    earlier: Elimination | None = None,
) -> CompletenessProof | None:
    """A proof that a verified representation is complete, or None if none of those known here applies.

    What an earlier elimination of the same system found modulo primes is not found again.

    Raises
    ------
    UnluckyPrimeError
        If it is proved that there are more poses.
    """
    proof, section = _without_elimination(representation, problem, policy)
    if proof is not None:
        return proof
    found = bases(elimination_system(problem, section), policy, watch, earlier)
    proofs = (_by_elimination(basis, representation, problem, policy) for basis in found)
    return next((proof for proof in proofs if proof is not None), None)


def prove_shortly(
    representation: PoseRepresentation, problem: ForwardProblem, policy: Policy, shared: SharedBoundary | None = None
) -> CompletenessProof | None:
    """The proof of ``prove_complete`` where that needs no elimination, or None."""
    return _without_elimination(representation, problem, policy, shared)[0]


def _without_elimination(
    representation: PoseRepresentation, problem: ForwardProblem, policy: Policy, shared: SharedBoundary | None = None
) -> tuple[CompletenessProof | None, ClosedSection | None]:
    """The proof by the number of poses, or a short one, and the closed section if that was needed."""
    degree = representation.univariate.degree
    if (
        not problem.motion.is_planar
        and degree == problem.solution_bound
        and are_isolated(representation, problem, policy)
    ):
        return CompletenessProof(CompletenessRoute.REFINED_BEZOUT, degree), None
    if not goes_shortly(problem, policy):
        return None, None
    conditions, section = _closed(problem)
    return _shortly(representation, problem, policy, conditions, section, shared), section


def goes_shortly(problem: ForwardProblem, policy: Policy) -> bool:
    """Whether short ways are tried: not on planar robots with three legs, whose eliminations are shorter."""
    if not has_as_many_legs_as_freedoms(problem):
        return True
    return policy.short_proofs and not problem.motion.is_planar


def _shortly(
    representation: PoseRepresentation,
    problem: ForwardProblem,
    policy: Policy,
    conditions: Conditions,
    section: ClosedSection,
    shared: SharedBoundary | None,
) -> CompletenessProof | None:
    """A proof without an elimination, in which multiple poses count twice."""
    from pkm_exact.completeness.short_proof import short_proof

    degree = representation.univariate.degree
    found: Multiplicities = ()
    if not are_isolated(representation, problem, policy):
        least = least_multiplicities(representation, problem, policy)
        found = tuple((factor, min(multiplicity, 2)) for factor, multiplicity in least)
    total = total_of(found) if found else degree
    proof = short_proof(conditions, degree, total, policy, section, shared)
    return None if proof is None else CompletenessProof(proof.route, total, (), found, proof.infinity)


def _by_elimination(
    basis: ExactBasis, representation: PoseRepresentation, problem: ForwardProblem, policy: Policy
) -> CompletenessProof | None:
    """The proof that an elimination over Q gives, or None if it gives none."""
    degree, bound = representation.univariate.degree, solution_bound(basis, policy)
    if bound is None:
        return None
    require(bound >= degree, "there is room for fewer solutions than were verified", bound=bound, verified=degree)
    if bound == degree:
        return _elimination_proof(basis, bound)
    found = least_multiplicities(representation, problem, policy)
    if total_of(found) < bound:
        from pkm_exact.algebra.exact_quotient import exact_quotient

        quotient = exact_quotient(basis, policy.dimension_limit)
        if quotient is None:
            return None
        rank = quotient.distinct_solutions
        if rank > degree:
            raise UnluckyPrimeError(f"there are {rank} poses, and {degree} of them were found")
        require(rank == degree, "the trace form counts other solutions than were verified", rank=rank, verified=degree)
        names = elimination_system(problem).unknowns
        found = exact_multiplicities(representation, problem, quotient, names, policy)
    total = total_of(found)
    require(total == bound, "the multiplicities do not sum to the number of solutions", sum=total, bound=bound)
    return _elimination_proof(basis, bound, found)


def prove_inconsistent(problem: ForwardProblem, policy: Policy, watch: Watch | None = None) -> CompletenessProof | None:
    """A proof that no complex pose exists, a short one or by an elimination over Q that ends in a constant, or None."""
    section = None
    if goes_shortly(problem, policy):
        from pkm_exact.completeness.short_proof import short_proof

        conditions, section = _closed(problem)
        proof = short_proof(conditions, 0, 0, policy, section)
        if proof is not None:
            return CompletenessProof(proof.route, 0, infinity=proof.infinity)
    found = (
        solution_bound(basis, policy) == 0 and basis for basis in bases(elimination_system(problem), policy, watch)
    )
    return next((_elimination_proof(basis, 0) for basis in found if basis), None)


def bases(
    system: PolynomialSystem, policy: Policy, watch: Watch | None = None, earlier: Elimination | None = None
) -> Iterator[ExactBasis]:
    """Eliminations over Q of a system's ideal, along traces modulo primes at which it is finite.

    What one trace does not prove, another may, if its prime was unlucky; but a prime that gives a trace a second time
    shows that it is the robot's. None follows.
    """
    elimination = Elimination(system, policy)
    if earlier is not None:
        elimination = elimination.knowing(earlier)
    traces: list[Trace | None] = []
    for _ in range(policy.attempts):
        trace = elimination.trace()
        if trace in traces:
            return
        traces.append(trace)
        if trace is not None:
            with suppress(UnluckyPrimeError):
                yield exact_basis(system, trace, watch)


def solution_bound(basis: ExactBasis, policy: Policy) -> int | None:
    """An upper bound for the number of solutions with multiplicity, or None if the staircase is infinite."""
    found = standard_monomials(basis.ring, basis.leading_monomials, policy.dimension_limit)
    return None if found is None else len(found)


def _elimination_proof(basis: ExactBasis, total: int, found: Multiplicities = ()) -> CompletenessProof:
    steps = tuple(tuple((index, basis.ring.unpack(monomial)) for index, monomial in step) for step in basis.steps)
    return CompletenessProof(CompletenessRoute.EXACT_ELIMINATION, total, steps, found)
