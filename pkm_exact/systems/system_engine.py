"""From a polynomial system to its solutions in boxes, with a proof of what is claimed about them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Final, TypeAlias

from pkm_exact.algebra.groebner import UnluckyPrimeError
from pkm_exact.algebra.representation import UnivariateRepresentation
from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.claim import Claim
from pkm_exact.errors import InternalContradictionError, PkmExactError
from pkm_exact.policy import Policy
from pkm_exact.poses.boxes import DEFAULT_WIDTH
from pkm_exact.stages import Progress, Stages
from pkm_exact.systems.infinitely_many import prove_infinite
from pkm_exact.systems.modular_solutions import most_values
from pkm_exact.systems.no_more_solutions import (
    BeyondCheckersError,
    ListedSolutions,
    listed,
    prove_by_bounds,
    prove_by_search,
    prove_complete,
    prove_inconsistent,
)
from pkm_exact.systems.real_boxes import real_solutions
from pkm_exact.systems.solution_search import SolutionSearch, is_verified
from pkm_exact.systems.system_claims import BEYOND_CHECKERS_NOTE, DETECTED_NOTE, MISSING_NOTE, NO_SOLUTION_NOTE
from pkm_exact.systems.system_solution import ListProof, SystemSolution

SYSTEM_POLICY: Final = Policy(degree_limit=256)
"""Limits for systems: their polynomials may have degrees that those of robots have not."""

Proposal: TypeAlias = Callable[[PolynomialSystem], "UnivariateRepresentation | None"]
"""Another program's answer: a representation, which is verified here; None if it says that there are not finitely many
solutions, or none."""


class OracleError(PkmExactError):
    """What another program says of a system is not true."""


def solved_system(
    system: PolynomialSystem,
    *,
    width: Fraction = DEFAULT_WIDTH,
    policy: Policy | None = None,
    progress: Progress | None = None,
    propose: Proposal | None = None,
) -> SystemSolution:
    """The solutions of a system, and what is proved about them.

    Parameters
    ----------
    system : PolynomialSystem
        At least one polynomial, none of them 0.
    width : Fraction
        Greatest width of a box.
    policy : Policy, optional
        Limits and random choices.
    progress : callable, optional
        Gets the name of each stage (``stages``).
    propose : callable, optional
        Another program, in place of the elimination and the lifting. What it says is verified.

    Raises
    ------
    OutOfReachError, ReconstructionError
        If a limit of the policy is met.
    OracleError
        If the other program's answer is not one of solutions of the system.
    InternalContradictionError
        If a step contradicts another; no answer is given.
    """
    run = _Run(system, policy or SYSTEM_POLICY, Stages(progress), width)
    solution = run.solution() if propose is None else run.proposed(propose)
    run.stages.leave()
    return replace(solution, seconds=dict(run.stages.seconds))


@dataclass(frozen=True)
class _Run:
    """One solve."""

    system: PolynomialSystem
    policy: Policy
    stages: Stages
    width: Fraction

    def solution(self) -> SystemSolution:
        """The answer of the internal engine."""
        search = SolutionSearch(self.system, self.policy, self.stages)
        for _ in range(self.policy.attempts):
            found = search.found()
            if found.representation is None:
                return self._without_list(found.dimension)
            try:
                return self._listed(found.representation, search)
            except UnluckyPrimeError:
                continue
        raise InternalContradictionError("there are more solutions than any prime shows")

    def proposed(self, propose: Proposal) -> SystemSolution:
        """The answer with another program's representation, if it has one; that it is one is verified first.

        Raises
        ------
        OracleError
            If it is none.
        """
        self.stages.enter("oracle")
        representation = propose(self.system)
        if representation is None:
            return self.solution()
        self.stages.enter("verification")
        if not is_verified(representation, self.system):
            raise OracleError("the oracle's answer is wrong: not all that it calls solutions are; solve without it")
        found = listed(representation, self.system, self.policy)
        self.stages.enter("completeness")
        proof = prove_by_bounds(found, self.system, self.policy)
        if proof is not None:
            return self._boxed(found, proof)
        search = SolutionSearch(self.system, self.policy, self.stages)
        if self._has_more_modulo_a_prime(search, representation.degree):
            return self._boxed(found, None, (MISSING_NOTE,))
        self.stages.enter("completeness")
        try:
            proof = prove_by_search(found, self.system, self.policy, self.stages.amount, search.elimination)
            return self._boxed(found, proof)
        except UnluckyPrimeError:
            pass
        except BeyondCheckersError:
            return self._boxed(found, None, (BEYOND_CHECKERS_NOTE,))
        return self._boxed(found, None, (MISSING_NOTE,))

    def _has_more_modulo_a_prime(self, search: SolutionSearch, degree: int) -> bool:
        """Whether the system has more distinct solutions modulo a prime: reason enough not to look for a proof."""
        image = search.image()
        if image.algebra is None or not image.dimension:
            return True
        return most_values(image.algebra, self.policy.seed_for(self.system.digest, image.prime)) > degree

    def _without_list(self, dimension: int | None) -> SystemSolution:
        """The answer where there are infinitely many solutions modulo two primes, or none."""
        if dimension is None:
            self.stages.enter("slices")
            witness = prove_infinite(self.system, self.policy, self.stages)
            if witness is not None:
                return SystemSolution(self.system, Claim.POSITIVE_DIMENSIONAL_PROVED, witness=witness)
            return SystemSolution(self.system, Claim.POSITIVE_DIMENSIONAL_DETECTED, notes=(DETECTED_NOTE,))
        self.stages.enter("completeness")
        proof = prove_inconsistent(self.system, self.policy, self.stages.amount)
        if proof is not None:
            return SystemSolution(self.system, Claim.INCONSISTENT, proof)
        return SystemSolution(self.system, Claim.NOT_PROVEN_COMPLETE, notes=(NO_SOLUTION_NOTE,))

    def _listed(self, representation: UnivariateRepresentation, search: SolutionSearch) -> SystemSolution:
        """All solutions in boxes, and what is proved about their list.

        Raises
        ------
        UnluckyPrimeError
            If it is proved that there are more.
        """
        self.stages.enter("completeness")
        found = listed(representation, self.system, self.policy)
        try:
            proof = prove_complete(found, self.system, self.policy, self.stages.amount, search.elimination)
        except BeyondCheckersError:
            return self._boxed(found, None, (BEYOND_CHECKERS_NOTE,))
        return self._boxed(found, proof)

    def _boxed(self, found: ListedSolutions, proof: ListProof | None, notes: tuple[str, ...] = ()) -> SystemSolution:
        self.stages.enter("real roots and boxes")
        known = () if found.is_regular else None if proof is None else proof.multiplicities
        exponent, solutions = real_solutions(found.representation, known, self.width)
        claim = Claim.NOT_PROVEN_COMPLETE if proof is None else Claim.COMPLETE
        return SystemSolution(self.system, claim, proof, found.representation, exponent, solutions, notes)
