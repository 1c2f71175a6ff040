"""The exact engine: from a robot with locked actuators to all its poses, each step in the order of the pipeline."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial
from typing import TYPE_CHECKING

from flint import fmpz_poly

from pkm_exact.algebra.groebner import UnluckyPrimeError
from pkm_exact.algebra.representation import UnivariateRepresentation
from pkm_exact.claim import Claim
from pkm_exact.claim_wording import DETECTED_NOTE, NO_SOLUTION_NOTE
from pkm_exact.completeness.completeness_proof import (
    CompletenessProof,
    has_as_many_legs_as_freedoms,
    prove_complete,
    prove_inconsistent,
    prove_shortly,
)
from pkm_exact.completeness.pose_slices import MorePoses
from pkm_exact.constraints.distance import Distance
from pkm_exact.errors import InternalContradictionError
from pkm_exact.failures.contradiction import attached
from pkm_exact.final_checks import consistent
from pkm_exact.formulations.registry import formulation_codes, formulation_for
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion_groups import SPATIAL
from pkm_exact.notes import inconsistent_note, isolated_note, motion_note, open_question, singular_notes, turn_notes
from pkm_exact.policy import Policy
from pkm_exact.poses.boxes import DEFAULT_WIDTH, RootEnclosures, exponent_for_width, order_of, pose_boxes
from pkm_exact.poses.expected_size import expected_bits
from pkm_exact.poses.jacobian import pose_jacobians
from pkm_exact.poses.modular import Form, common_charts, common_forms
from pkm_exact.poses.modular_start import Start
from pkm_exact.poses.parameters import Parameters
from pkm_exact.poses.pose import Pose
from pkm_exact.poses.pose_representation import PoseRepresentation, pose_representation
from pkm_exact.poses.search import PoseSearch
from pkm_exact.poses.self_motion import (
    Mobility,
    SelfMotion,
    TranslationalMotion,
    extended_problem,
    mobility,
    translational_motion,
)
from pkm_exact.poses.singularity import are_isolated, singularity
from pkm_exact.poses.study_equations import Chart, free_coordinates
from pkm_exact.roots.isolation import has_root
from pkm_exact.solution import Solution, Statistics
from pkm_exact.stages import Progress, Stages

if TYPE_CHECKING:
    from pkm_exact.completeness.shared_rows import SharedRows
    from pkm_exact.numeric.study_system import Complex


def solve(
    problem: ForwardProblem,
    *,
    formulation: str = "SE3",
    width: Fraction = DEFAULT_WIDTH,
    policy: Policy | None = None,
    progress: Progress | None = None,
) -> Solution:
    """The answer to ``pkm_exact.solve``, which says what is asked and what is raised, as data only."""
    run = _Run(problem, formulation, policy or Policy(), Stages(progress))
    with attached(problem, run.stages, method="exact", formulation=formulation, width=width, policy=run.policy):
        return consistent(run.solution(width))


def solve_row(
    problem: ForwardProblem,
    *,
    width: Fraction = DEFAULT_WIDTH,
    policy: Policy | None = None,
    shared: SharedRows | None = None,
) -> Solution:
    """The answer of ``solve`` to one of many problems that differ in lengths alone, with what others had in common.

    Certificates are the same, to the byte, unless a prime of 62 bits that follows from a digest shows a chart or form
    as it is not over Q: then another representation of the same poses is proved. Statistics differ.
    """
    policy = policy or Policy()
    if not policy.eliminate and (shared is None or shared.may_go_directly):
        found = solve_without_elimination(problem, width=width, policy=policy, shared=shared)
        if shared is not None:
            shared.misses += 1 if found is None else -1
        if found is not None:
            return found
    # It has been tried without, or is not worth the while.
    run = _Run(problem, formulation_codes()[0], replace(policy, eliminate=True), Stages(None), shared)
    with attached(problem, run.stages, method="exact", formulation=run.code, width=width, policy=run.policy):
        return consistent(run.solution(width))


def solve_without_elimination(
    problem: ForwardProblem,
    *,
    width: Fraction = DEFAULT_WIDTH,
    policy: Policy | None = None,
    shared: SharedRows | None = None,
) -> Solution | None:
    """The answer of ``solve`` where doubles lead to all poses, and their number or a short proof shows that; or None.

    Nothing is taken from doubles but what is then verified over Q; that no pose is missing is proved by the number of
    poses, or of poses and points at infinity, and so no elimination need count them.
    """
    run = _Run(problem, formulation_codes()[0], policy or Policy(), Stages(None), shared)
    with attached(problem, run.stages, method="exact", formulation=run.code, width=width, policy=run.policy):
        found = run.general_solution(width)
        return None if found is None else consistent(found)


def _approximate_solutions(problem: ForwardProblem) -> Complex | None:
    """Doubles near solutions, perhaps all of them; None if they are of no use."""
    if problem.motion != SPATIAL:
        return None
    # Floating point is needed for this alone.
    from pkm_exact.numeric.proposed_representation import approximate_solutions

    return approximate_solutions(problem)


def _proposal(
    shared: SharedRows | None,
    points: Complex | None,
    problem: ForwardProblem,
    chosen: Parameters,
    limit_bits: int,
    watch: Callable[[int], None],
) -> UnivariateRepresentation | None:
    """What numerical solutions propose in the chart and form that were chosen modulo a prime."""
    if points is None:
        return None
    # Floating point is needed for this alone.
    from pkm_exact.numeric.proposed_representation import proposed_representation

    denominators = None if shared is None else shared.denominators
    degree = chosen.modular.degree
    return proposed_representation(problem, chosen.chart, chosen.form, degree, limit_bits, watch, denominators, points)


def _proposed_poses(
    problem: ForwardProblem,
    policy: Policy,
    shared: SharedRows | None,
    points: Complex | None,
    watch: Callable[[int], None],
) -> PoseRepresentation | None:
    """The poses proposed in the chart and form that the elimination would take; None if these may be others."""
    if points is None:
        return None
    # Floating point is needed for this alone.
    from pkm_exact.numeric.proposed_representation import first_representation
    from pkm_exact.poses.skipped_choices import are_passed_over

    def forms(chart: Chart) -> list[Form]:
        free = free_coordinates(chart, problem)
        return [form for form in common_forms(chart, policy.seed) if any(form[k] for k in free)]

    denominators = None if shared is None else shared.denominators
    charts = common_charts(policy.seed)
    found = first_representation(problem, charts, forms, policy.lifting_bits, watch, denominators, points)
    if found is None:
        return None
    poses = pose_representation(found.chart, problem, found.univariate)
    return poses if are_passed_over(poses, found.charts, found.forms) else None


@dataclass(frozen=True)
class _Run:
    """One solve: its stages, and what they cost."""

    problem: ForwardProblem
    code: str
    policy: Policy
    stages: Stages
    shared: SharedRows | None = None

    @cached_property
    def search(self) -> PoseSearch:
        """The search for the poses of the problem itself."""
        return PoseSearch(self.problem, self.code, self.policy, self.stages, proposal=self._proposed)

    @cached_property
    def points(self) -> Complex | None:
        """Solutions in doubles, as far as they are found."""
        return _approximate_solutions(self.problem)

    @cached_property
    def motion(self) -> SelfMotion | TranslationalMotion | None:
        """A proof of a self-motion, if one of those known here applies."""
        return self._self_motion()

    def _proposed(
        self, problem: ForwardProblem, chosen: Parameters, limit_bits: int, watch: Callable[[int], None]
    ) -> UnivariateRepresentation | None:
        return _proposal(self.shared, self.points, problem, chosen, limit_bits, watch)

    def solution(self, width: Fraction) -> Solution:
        """The answer, by whichever way the robot goes; boxes are no wider than asked."""
        exponent = exponent_for_width(width)
        formulation_for(self.code, self.problem)  # an unknown code is refused whatever the robot
        self.stages.enter("self-motion")
        motion = self.motion
        if motion is not None:
            note = motion_note(motion, self.problem)
            result = self._result(Claim.POSITIVE_DIMENSIONAL_PROVED, exponent, note)
            return self._with_isolated(replace(result, self_motion=motion), width)
        if self._may_need_no_elimination():
            found = self._by_number(width)
            if found is not None:
                return found
        for _ in range(self.policy.attempts):
            start, representation = self.search.found()
            if representation is None:
                return self._without_list(start, exponent, width)
            try:
                proof = self._proof(start, representation)
            except UnluckyPrimeError:
                continue
            return self._listed(start, representation, proof, width)
        raise InternalContradictionError("there are more poses than any prime shows")

    def general_solution(self, width: Fraction) -> Solution | None:
        """The answer if doubles lead to all poses, and no elimination is needed to prove that."""
        if self.policy.lifting != "numeric":
            return None
        self.stages.enter("self-motion")
        return self._by_number(width) if self.motion is None else None

    def _may_need_no_elimination(self) -> bool:
        """Whether doubles seem to lead to as many poses as there can be."""
        has_basis = self.policy.eliminate or self.policy.lifting != "numeric" or self.code != formulation_codes()[0]
        if has_basis or self.problem.motion != SPATIAL:
            return False
        self.stages.enter("numeric lifting")
        return self.points is not None and len(self.points) == self.problem.solution_bound

    def _by_number(self, width: Fraction) -> Solution | None:
        """The answer, where the poses that doubles lead to are proved to be all by their number or a short proof."""
        self.stages.enter("numeric lifting")
        watch = partial(self.search.tell, expected_bits(self.problem, self.problem.solution_bound))
        representation = _proposed_poses(self.problem, self.policy, self.shared, self.points, watch)
        if representation is None:
            return None
        self.stages.enter("verification")
        if not representation.is_verified(self.problem):
            return None
        self.stages.enter("completeness")
        boundary = None if self.shared is None else self.shared.boundary
        proof = prove_shortly(representation, self.problem, self.policy, boundary)
        return None if proof is None else self._listed(None, representation, proof, width)

    def _without_list(self, start: Start, exponent: int, width: Fraction) -> Solution:
        """The answer where there are infinitely many solutions modulo two primes, or none."""
        if start.count is None:
            motion = self._slices()
            if motion is not None:
                note = motion_note(motion, self.problem)
                result = self._result(Claim.POSITIVE_DIMENSIONAL_PROVED, exponent, note)
                result = replace(result, self_motion=motion, statistics=self._statistics(start))
                return self._with_isolated(result, width)
            result = self._result(Claim.POSITIVE_DIMENSIONAL_DETECTED, exponent, DETECTED_NOTE)
            return self._with_isolated(replace(result, statistics=self._statistics(start)), width)
        return replace(self._without_solutions(exponent), statistics=self._statistics(start))

    def _slices(self) -> MorePoses | None:
        """A proof that the poses are infinitely many over Q, where they are modulo two primes, or None."""
        if has_as_many_legs_as_freedoms(self.problem) and not self.policy.short_proofs:
            return None
        from pkm_exact.completeness.slices import more_poses

        self.stages.enter("slices")
        return more_poses(self.problem, self.policy, self.stages.amount)

    def _without_solutions(self, exponent: int) -> Solution:
        """The answer where there is no solution modulo a prime, not even a complex one."""
        self.stages.enter("completeness")
        proof = prove_inconsistent(self.problem, self.policy, self.stages.amount)
        if proof is not None:
            return self._result(Claim.INCONSISTENT, exponent, inconsistent_note(self.problem), proof)
        return self._result(Claim.NOT_PROVEN_COMPLETE, exponent, NO_SOLUTION_NOTE)

    def _proof(self, start: Start, representation: PoseRepresentation) -> CompletenessProof | None:
        """What proves the list complete, if anything does.

        Raises
        ------
        UnluckyPrimeError
            If another prime shows other poses, or it is proved that there are more.
        """
        self.stages.enter("completeness")
        elimination = start.frame.elimination
        proof = prove_complete(representation, self.problem, self.policy, self.stages.amount, elimination)
        if proof is None and start.frame.at_next_prime().count != start.count:
            raise UnluckyPrimeError("two primes have different poses")
        return proof

    def _listed(
        self, start: Start | None, representation: PoseRepresentation, proof: CompletenessProof | None, width: Fraction
    ) -> Solution:
        """All poses in boxes, and what is proved about their list; without an elimination there is a proof."""
        self.stages.enter("real roots and boxes")
        enclosures = RootEnclosures(representation, self.problem.metric)
        exponent, poses = pose_boxes(enclosures, width)
        self.stages.enter("Jacobians")
        poses, singular = self._with_jacobians(poses, enclosures, proof)
        count = proof.total if proof else (start and start.count) or 0
        turned = () if start is None else turn_notes(start.frame.turn, start.frame.attempt)
        question = () if proof else (open_question(count, representation.univariate.degree),)
        self.stages.leave()
        return Solution(
            problem=self.problem,
            formulation=self.code,
            method="exact",
            claim=Claim.COMPLETE if proof else Claim.NOT_PROVEN_COMPLETE,
            completeness=proof,
            complex_solutions=count,
            distinct_solutions=representation.univariate.degree,
            representation=representation,
            box_exponent=exponent,
            poses=poses,
            notes=(*turned, *singular, *question),
            statistics=self._statistics(start),
        )

    def _with_isolated(self, result: Solution, width: Fraction) -> Solution:
        """The solution with the isolated poses beside a set of positive dimension, as far as they can be certified."""
        # Floating point is needed for this alone.
        from pkm_exact.numeric.poses import isolated_poses

        self.stages.enter("isolated poses")
        found = isolated_poses(self.problem, width)
        self.stages.leave()
        if found is None:
            return result
        isolated, exponent, poses = found
        return replace(
            result,
            complex_solutions=isolated.count,
            distinct_solutions=isolated.count,
            isolated=isolated,
            box_exponent=exponent,
            poses=poses,
            notes=(*result.notes, isolated_note(isolated.count)),
        )

    def _self_motion(self) -> SelfMotion | TranslationalMotion | None:
        """A proof of a self-motion, or None if none of those known here applies."""
        translation = translational_motion(self.problem)
        if translation is not None:
            return translation
        bound = mobility(self.problem)
        motion = None if bound is None else self._witnessed(bound)
        if motion is None:
            return None
        # Floating point is needed for this alone: it proposes.
        from pkm_exact.numeric.real_motion import with_real_motion

        return with_real_motion(self.problem, motion, self.policy)

    def _witnessed(self, bound: Mobility) -> SelfMotion | None:
        """A pose, found by joining legs until finitely many are left, or None if there seems to be none."""
        given = len(self.problem.constraints)
        # Legs that are the same for every robot, then its own; if its poses are all at infinity, none has a solution.
        seeds = self.policy.seed, self.policy.seed_for(self.problem.digest, "further legs")
        for count in range(bound.dimension, self.problem.motion.dimension + 1):
            for extended in (extended_problem(self.problem, count, seed) for seed in seeds):
                search = PoseSearch(extended, formulation_codes()[0], self.policy, Stages())
                start, representation = search.found()
                if start.count is None:
                    break
                if representation is not None:
                    further = tuple(leg for leg in extended.constraints[given:] if isinstance(leg, Distance))
                    return SelfMotion(bound, further, representation)
            else:
                return None
        return None

    def _with_jacobians(
        self, poses: tuple[Pose, ...], enclosures: RootEnclosures, proof: CompletenessProof | None
    ) -> tuple[tuple[Pose, ...], tuple[str, ...]]:
        """The poses with the multiplicities that are proved and what is certified of their Jacobians, and notes."""
        representation = enclosures.representation
        h = representation.univariate.primitive_polynomial
        found: Sequence[tuple[fmpz_poly, int | None]] = ((h, 1),)
        if proof is not None:
            found = proof.multiplicities or found
        elif not are_isolated(representation, self.problem, self.policy):
            found = [(factor, None) for factor, _ in h.factor()[1]]
        singular = [
            None
            if count == 1 or (count is None and are_isolated(representation, self.problem, self.policy, factor))
            else singularity(representation, self.problem, factor)
            for factor, count in found
        ]
        parameters = [pose.parameter for pose in poses if pose.parameter is not None]
        places = [next(k for k, (f, _) in enumerate(found) if has_root(f, parameter)) for parameter in parameters]
        ranks = [None if kind is None else kind.rank for kind in (singular[place] for place in places)]
        jacobians = pose_jacobians(enclosures, self.problem, ranks)
        known = [
            replace(pose, multiplicity=found[place][1], jacobian=jacobian)
            for pose, place, jacobian in zip(poses, places, jacobians, strict=True)
        ]
        order = order_of([pose.box for pose in known])
        notes = singular_notes([singular[places[k]] for k in order], self.problem)
        return tuple(known[k] for k in order), notes

    def _result(self, claim: Claim, exponent: int, note: str, proof: CompletenessProof | None = None) -> Solution:
        """A solution without a representation of poses."""
        self.stages.leave()
        return Solution(
            problem=self.problem,
            formulation=self.code,
            method="exact",
            claim=claim,
            completeness=proof,
            complex_solutions=0,
            distinct_solutions=0,
            representation=None,
            box_exponent=exponent,
            poses=(),
            notes=(note,),
        )

    def _statistics(self, start: Start | None) -> Statistics:
        if start is None:
            return Statistics(seconds=dict(self.stages.seconds))
        return Statistics(
            tuple(start.frame.elimination.primes_used),
            tuple(start.frame.elimination.primes_unlucky),
            self.search.retries,
            len(start.image.basis.elements),
            start.image.dimension,
            dict(self.stages.seconds),
        )
