"""The exact engine: from a robot with given leg lengths to all its poses, each step in the order of the pipeline."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import islice

from flint import fmpz_poly

from pkm_exact.algebra.elimination import Elimination, ModularImage
from pkm_exact.algebra.groebner import OutOfReachError, UnluckyPrimeError
from pkm_exact.algebra.lifting import Acceptance, lift_by_newton, lift_by_primes
from pkm_exact.algebra.representation import UnivariateRepresentation, union
from pkm_exact.algebra.rur import ModularRepresentation
from pkm_exact.consistency import consistent
from pkm_exact.contradiction import attached
from pkm_exact.errors import InternalContradictionError
from pkm_exact.formulations.base import FormulatedProblem
from pkm_exact.formulations.registry import formulation as formulation_of
from pkm_exact.formulations.registry import formulation_codes, formulation_for
from pkm_exact.formulations.turned import candidate_turns, formulate_turned
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.notes import isolated_note, motion_note, open_question, singular_notes, turn_notes
from pkm_exact.policy import Policy
from pkm_exact.poses.boxes import DEFAULT_WIDTH, exponent_for_width, in_order, pose_boxes, root_enclosures
from pkm_exact.poses.completeness import CompletenessProof, prove_complete, prove_inconsistent
from pkm_exact.poses.expected_size import expected_bits
from pkm_exact.poses.jacobian import pose_jacobians
from pkm_exact.poses.modular import ModularPoses, modular_poses
from pkm_exact.poses.parameters import Parameters, choose_parameters
from pkm_exact.poses.pose import Pose
from pkm_exact.poses.representation import PoseRepresentation, pose_representation
from pkm_exact.poses.self_motion import (
    Mobility,
    SelfMotion,
    TranslationalMotion,
    extended_problems,
    mobility,
    translational_motion,
)
from pkm_exact.poses.singularity import are_isolated, singularity
from pkm_exact.poses.study_equations import StudyEquations, free_coordinates
from pkm_exact.roots.isolation import has_root
from pkm_exact.solution import Solution, Statistics
from pkm_exact.stages import Amount, Progress, Stages
from pkm_exact.verdict import Claim

SELF_MOTION_ATTEMPTS = 2
"""Lists of further legs tried on a robot that can only move; if its poses are all at infinity, none has a solution."""


def solve(
    problem: ForwardProblem,
    *,
    formulation: str = "SE3",
    width: Fraction = DEFAULT_WIDTH,
    policy: Policy | None = None,
    progress: Progress | None = None,
) -> Solution:
    """All real poses of a robot whose leg lengths are given, each in a box, and what is proved about the list.

    Parameters
    ----------
    problem : ForwardProblem
        Exact geometry and squared leg lengths.
    formulation : str
        Code of the formulation whose Groebner basis is used.
    width : Fraction
        Largest width of a box, in every coordinate (unit of length, or 1 for rotations).
    policy : Policy, optional
        Limits and random choices.
    progress : callable, optional
        Gets one line when a stage starts; its method ``amount``, if it has one, how much of it is done (``stages``).

    Raises
    ------
    InputError
        If the formulation is unknown or does not apply to the robot.
    OutOfReachError, ReconstructionError
        If a limit of the policy is met.
    InternalContradictionError
        If a step contradicts another; no answer is given.
    """
    run = _Run(problem, formulation, policy or Policy(), Stages(progress))
    with attached(problem, run.stages, method="exact", formulation=formulation, width=width, policy=run.policy):
        return consistent(run.solution(width))


@dataclass
class _Run:
    """One solve: its stages, and what they cost."""

    problem: ForwardProblem
    code: str
    policy: Policy
    stages: Stages
    retries: int = 0

    def solution(self, width: Fraction) -> Solution:
        exponent = exponent_for_width(width)
        formulation_for(self.code, self.problem)  # an unknown code is refused whatever the robot
        self.stages.enter("self-motion")
        motion = self._self_motion()
        if motion is not None:
            note = motion_note(motion, self.problem)
            result = self._result(Claim.POSITIVE_DIMENSIONAL_PROVED, exponent, note)
            return self._with_isolated(replace(result, self_motion=motion), width)
        start = self._started()
        statistics = partial(self._statistics, start.elimination, start.image)
        if start.poses is None:
            note = (
                "the solutions form a set of positive dimension at two primes: the robot can move with its legs "
                "locked, or solutions run together at infinity"
            )
            result = self._result(Claim.POSITIVE_DIMENSIONAL_DETECTED, exponent, note)
            return self._with_isolated(replace(result, statistics=statistics()), width)
        if start.poses.count == 0:
            self.stages.enter("completeness")
            proof = prove_inconsistent(self.problem, self.policy, self.stages.amount)
            if proof is not None:
                note = "no pose, real or complex, has these leg lengths"
                return replace(self._result(Claim.INCONSISTENT, exponent, note, proof), statistics=statistics())
            note = "there is no solution, real or complex, modulo two primes; that there is none over Q is not proved"
            return replace(self._result(Claim.NOT_PROVEN_COMPLETE, exponent, note), statistics=statistics())
        representation = self._representation(start)
        self.stages.enter("completeness")
        proof = prove_complete(representation, self.problem, self.policy, self.stages.amount)
        self.stages.enter("real roots and boxes")
        exponent, poses = pose_boxes(representation, self.problem.metric, width)
        self.stages.enter("Jacobians")
        poses, singular = self._with_jacobians(poses, representation, proof)
        question = () if proof else (open_question(start.poses.count, representation.univariate.degree),)
        self.stages.leave()
        return Solution(
            problem=self.problem,
            formulation=self.code,
            method="exact",
            claim=Claim.COMPLETE if proof else Claim.NOT_PROVEN_COMPLETE,
            completeness=proof,
            complex_solutions=proof.total if proof else start.poses.count,
            distinct_solutions=representation.univariate.degree,
            representation=representation,
            box_exponent=exponent,
            poses=poses,
            notes=(*start.notes, *singular, *question),
            statistics=statistics(),
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
        return None if bound is None else self._witnessed(bound)

    def _witnessed(self, bound: Mobility) -> SelfMotion | None:
        """A pose, found by joining legs until finitely many are left, or None if there seems to be none."""
        legs = len(self.problem.legs)
        for count in range(bound.dimension, 7):
            for extended in islice(extended_problems(self.problem, count, self.policy.seed), SELF_MOTION_ATTEMPTS):
                run = _Run(extended, formulation_codes()[0], self.policy, Stages())
                start = run._started()
                if start.poses is None:
                    break
                if start.poses.count > 0:
                    return SelfMotion(bound, extended.legs[legs:], run._representation(start))
            else:
                return None
        return None

    def _with_jacobians(
        self, poses: tuple[Pose, ...], representation: PoseRepresentation, proof: CompletenessProof | None
    ) -> tuple[tuple[Pose, ...], tuple[str, ...]]:
        """The poses with the multiplicities that are proved and what is certified of their Jacobians, and notes."""
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
        enclosures = root_enclosures(representation, self.problem.metric)
        ranks = [None if kind is None else kind.rank for kind in (singular[place] for place in places)]
        jacobians = pose_jacobians(enclosures, self.problem, ranks)
        known = {
            replace(pose, multiplicity=found[place][1], jacobian=jacobian): singular[place]
            for pose, place, jacobian in zip(poses, places, jacobians, strict=True)
        }
        ordered = in_order(known)
        return ordered, singular_notes([known[pose] for pose in ordered], len(self.problem.legs))

    def _started(self) -> _Start:
        """The poses modulo a prime, in a platform frame in which the formulation has coordinates for all of them."""
        formulation = formulation_for(self.code, self.problem)
        expected: int | None = None
        for attempt, turn in enumerate(islice(candidate_turns(self.policy.seed), self.policy.attempts)):
            self.stages.enter("formulation")
            formulated = formulate_turned(formulation, self.problem, turn)
            self.stages.enter("Groebner basis")
            elimination = Elimination(formulated.branches[0], self.policy, self.stages.amount)
            image = self._confirmed_image(elimination)
            poses = modular_poses(formulated, image.algebra, self.problem.metric)
            if formulated.is_chart and attempt == 0:
                expected = self._reference_count()
            count = None if poses is None else poses.count
            if not formulated.is_chart or count == expected:
                return _Start(formulated, elimination, image, poses, turn_notes(turn, attempt))
            self.retries += 1
        raise OutOfReachError(
            f"{self.code} misses poses in every frame of the platform that was tried: they have no finite coordinates"
        )

    def _reference_count(self) -> int | None:
        """Number of poses by the formulation that misses none, to see whether a chart does; None if infinite."""
        formulated = formulation_of(formulation_codes()[0]).formulate(self.problem)
        return self._confirmed_image(Elimination(formulated.system, self.policy, self.stages.amount)).dimension

    def _confirmed_image(self, elimination: Elimination) -> ModularImage:
        """The image at the first prime, or, if it has no solution or infinitely many, at one of two that agree."""
        image = elimination.image()
        for _ in range(self.policy.attempts):
            if image.dimension:
                return image
            second = elimination.image()
            if second.dimension == image.dimension:
                return image
            self.retries += 1
            image = second
        raise InternalContradictionError("the number of solutions differs from prime to prime")

    def _representation(self, start: _Start) -> PoseRepresentation:
        """The verified representation of all poses over Q."""
        poses = start.poses
        for attempt in range(self.policy.attempts):
            self.stages.enter("separating form")
            chosen = None if poses is None else choose_parameters(poses, self.problem, self.policy)
            if chosen is not None:
                lifted = self._lifted(start, chosen, attempt)
                if lifted is not None:
                    return lifted
            self.retries += 1
            self.stages.enter("Groebner basis")
            image = self._confirmed_image(start.elimination)
            poses = modular_poses(start.formulated, image.algebra, self.problem.metric)
        raise InternalContradictionError(
            f"no representation of the poses passed verification in {self.policy.attempts} attempts"
        )

    def _lifted(self, start: _Start, chosen: Parameters, attempt: int) -> PoseRepresentation | None:
        """The poses of each multiplicity over Q, verified, and all of them together; None after an unlucky choice."""
        equations = StudyEquations(self.problem, chosen.chart, self.policy.seed + attempt)
        form = [chosen.form[k] for k in equations.free]
        bits = self.policy.lifting_bits
        images = _further_images(start, chosen, self.problem)
        parts = []
        try:
            if self.policy.lifting == "multimodular":
                accept, watch = self._acceptance(chosen, "lifting by primes"), self._watch(chosen.modular)
                parts.append(lift_by_primes(form, images, bits, accept, watch))
                return pose_representation(chosen.chart, self.problem, parts[0])
            for multiplicity, modular in chosen.modular.parts(start.formulated.fibre).items():
                watch = self._watch(modular)
                if multiplicity == 1:
                    accept = self._acceptance(chosen, "p-adic lifting")
                    parts.append(lift_by_newton(equations, form, modular, bits, accept, watch))
                else:
                    accept = self._acceptance(chosen, "lifting by primes")
                    some = _parts(images, multiplicity, start, self.policy.attempts)
                    parts.append(lift_by_primes(form, some, bits, accept, watch))
        except UnluckyPrimeError:
            return None
        self.stages.enter("verification")
        lifted = pose_representation(chosen.chart, self.problem, union(parts))
        return lifted if len(parts) == 1 or lifted.is_verified(self.problem) else None

    def _watch(self, modular: ModularRepresentation) -> Callable[[int], None]:
        """Says how far the lifting of some solutions has come, of an estimate while there is more to do."""
        expected = expected_bits(self.problem, modular.degree)

        def watch(bits: int) -> None:
            self.stages.amount(Amount(bits, expected if bits < expected else None, "bits", "about"))

        return watch

    def _acceptance(self, chosen: Parameters, stage: str) -> Acceptance:
        """Enters the stage, and tells whether what it lifts are poses, exactly."""

        def accept(lifted: UnivariateRepresentation) -> bool:
            self.stages.enter("verification")
            verified = pose_representation(chosen.chart, self.problem, lifted).is_verified(self.problem)
            if not verified:
                self.stages.enter(stage)
            return verified

        self.stages.enter(stage)
        return accept

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

    def _statistics(self, elimination: Elimination, image: ModularImage) -> Statistics:
        return Statistics(
            tuple(elimination.primes_used),
            tuple(elimination.primes_unlucky),
            self.retries,
            len(image.basis.elements),
            image.dimension,
            dict(self.stages.seconds),
        )


@dataclass(frozen=True)
class _Start:
    """A formulated problem, its elimination, and its poses modulo the first prime (None if infinitely many)."""

    formulated: FormulatedProblem
    elimination: Elimination
    image: ModularImage
    poses: ModularPoses | None
    notes: tuple[str, ...]


def _further_images(start: _Start, chosen: Parameters, problem: ForwardProblem) -> Iterator[ModularRepresentation]:
    """The representation in the chosen chart and form at one prime after another."""
    while True:
        poses = modular_poses(start.formulated, start.elimination.following().algebra, problem.metric)
        coordinates = None if poses is None else poses.coordinates(chosen.chart)
        if poses is not None and coordinates is not None:
            yield poses.representation(coordinates, chosen.form, free_coordinates(chosen.chart, problem))


def _parts(
    images: Iterator[ModularRepresentation], multiplicity: int, start: _Start, misses_allowed: int
) -> Iterator[ModularRepresentation]:
    """Of every image the solutions of one multiplicity.

    Raises
    ------
    UnluckyPrimeError
        If too many primes have none: the multiplicity was an accident of the first prime.
    """
    misses = 0
    for image in images:
        part = image.parts(start.formulated.fibre).get(multiplicity)
        if part is not None:
            yield part
            continue
        misses += 1
        if misses > misses_allowed:
            raise UnluckyPrimeError(f"solutions of multiplicity {multiplicity} appear at the first prime only")
