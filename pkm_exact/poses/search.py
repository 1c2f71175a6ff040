"""From a problem to all its poses over Q, verified: formulation, elimination, separating form, lifting.

Modulo a prime first: a Groebner basis of the formulation, and the poses in its quotient algebra. Then a chart, a form
that separates them, and the univariate representation, lifted to Q and verified there exactly. A choice that turns out
unlucky is made again, as often as the policy allows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice

from pkm_exact.algebra.groebner import OutOfReachError, UnluckyPrimeError
from pkm_exact.algebra.lifting import Acceptance, lift_by_newton, lift_by_primes
from pkm_exact.algebra.modular_elimination import Elimination, ModularImage
from pkm_exact.algebra.representation import UnivariateRepresentation, union
from pkm_exact.algebra.rur import ModularRepresentation
from pkm_exact.errors import InternalContradictionError
from pkm_exact.formulations.base import FormulatedProblem
from pkm_exact.formulations.registry import formulation as formulation_of
from pkm_exact.formulations.registry import formulation_codes, formulation_for
from pkm_exact.formulations.turned import Turn, candidate_turns, formulate_turned
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.policy import Policy
from pkm_exact.poses.expected_size import expected_bits
from pkm_exact.poses.modular import ModularPoses, modular_poses
from pkm_exact.poses.parameters import Parameters, choose_parameters
from pkm_exact.poses.pose_representation import PoseRepresentation, pose_representation
from pkm_exact.poses.study_equations import StudyEquations, free_coordinates
from pkm_exact.stages import Amount, Stages


@dataclass(frozen=True)
class Start:
    """Where the search begins: the poses modulo a prime.

    Attributes
    ----------
    formulated : FormulatedProblem
    turn : quaternion of 4 int
        By which the platform frame was turned.
    attempt : int
        Number of frames tried before this one.
    elimination : Elimination
    image : ModularImage
        At the first prime.
    poses : ModularPoses or None
        None if they are infinitely many.
    """

    formulated: FormulatedProblem
    turn: Turn
    attempt: int
    elimination: Elimination
    image: ModularImage
    poses: ModularPoses | None


@dataclass
class PoseSearch:
    """The search for the poses of one problem.

    Attributes
    ----------
    problem : ForwardProblem
    code : str
        Of the formulation.
    policy : Policy
    stages : Stages
    retries : int
        Choices that failed and were made again.
    """

    problem: ForwardProblem
    code: str
    policy: Policy
    stages: Stages
    retries: int = 0

    def started(self) -> Start:
        """The poses modulo a prime, in a platform frame in which the formulation has coordinates for all of them.

        Raises
        ------
        OutOfReachError
            If there is no such frame among those tried, or a limit of the policy is met.
        """
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
                return Start(formulated, turn, attempt, elimination, image, poses)
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

    def representation(self, start: Start) -> PoseRepresentation:
        """The verified representation of all poses over Q.

        Raises
        ------
        OutOfReachError, ReconstructionError
            If a limit of the policy is met.
        InternalContradictionError
            If none passes verification.
        """
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

    def _lifted(self, start: Start, chosen: Parameters, attempt: int) -> PoseRepresentation | None:
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


def _further_images(start: Start, chosen: Parameters, problem: ForwardProblem) -> Iterator[ModularRepresentation]:
    """The representation in the chosen chart and form at one prime after another."""
    while True:
        poses = modular_poses(start.formulated, start.elimination.following().algebra, problem.metric)
        coordinates = None if poses is None else poses.coordinates(chosen.chart)
        if poses is not None and coordinates is not None:
            yield poses.representation(coordinates, chosen.form, free_coordinates(chosen.chart, problem))


def _parts(
    images: Iterator[ModularRepresentation], multiplicity: int, start: Start, misses_allowed: int
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
