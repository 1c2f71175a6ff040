"""From a problem to all its poses over Q, verified: formulation, elimination, separating form, lifting.

Modulo a prime first: a Groebner basis of the formulation, and the poses in its quotient algebra (``modular_start``).
Then a chart, a form that separates them, and the univariate representation, lifted to Q and verified there exactly. A
choice that turns out unlucky is made again, as often as the policy allows. A prime, too: at one that divides a
coordinate, or a difference of two, there are other poses, which lift to no representation over Q. So while a lift takes
longer than expected, further primes are asked whether they have as many poses.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Final, TypeAlias

from pkm_exact.algebra.groebner import UnluckyPrimeError
from pkm_exact.algebra.lifting import Acceptance, lift_by_newton, lift_by_primes
from pkm_exact.algebra.newton import Equations
from pkm_exact.algebra.representation import UnivariateRepresentation, union
from pkm_exact.algebra.rur import ModularRepresentation
from pkm_exact.errors import InternalContradictionError, ReconstructionError
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import pose_quartics
from pkm_exact.policy import Policy
from pkm_exact.poses.expected_size import expected_bits
from pkm_exact.poses.modular_start import Start, StartSearch
from pkm_exact.poses.parameters import Parameters, choose_parameters
from pkm_exact.poses.pose_representation import PoseRepresentation, pose_representation
from pkm_exact.poses.study_equations import StudyEquations, free_coordinates
from pkm_exact.stages import Amount, Stages

DOUBT: Final = 2
"""A lift is in doubt at so many times the bits that are expected, and again at twice as many."""
LEAST_DOUBT: Final = 2048
"""Below so many bits a lift is not in doubt: to finish costs less than to ask."""


Proposal: TypeAlias = Callable[
    [ForwardProblem, Parameters, int, Callable[[int], None]], UnivariateRepresentation | None
]
"""What may know the representation on the free coordinates, if it needs no more bits than a limit; is told of bits."""


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
    failures : int
        Representations that failed.
    proposal : callable, optional
        Asked before solutions that are all simple are lifted.
    """

    problem: ForwardProblem
    code: str
    policy: Policy
    stages: Stages
    failures: int = 0
    proposal: Proposal | None = None

    @cached_property
    def starts(self) -> StartSearch:
        """The search modulo primes."""
        return StartSearch(self.problem, self.code, self.policy, self.stages)

    @property
    def retries(self) -> int:
        """Choices that failed and were made again."""
        return self.failures + self.starts.retries

    def found(self) -> tuple[Start, PoseRepresentation | None]:
        """The poses modulo a prime and their representation over Q; None if there are none, or infinitely many.

        Called again, it begins again, at other primes.

        Raises
        ------
        OutOfReachError, ReconstructionError
            If a limit of the policy is met.
        InternalContradictionError
            If no representation passes verification.
        """
        for _ in range(self.policy.attempts):
            start = self.starts.started()
            if not start.count:
                return start, None
            try:
                return start, self.representation(start)
            except UnluckyPrimeError:
                self.failures += 1
        raise InternalContradictionError(
            f"no representation of the poses passed verification in {self.policy.attempts} attempts"
        )

    def representation(self, start: Start) -> PoseRepresentation:
        """The verified representation of all poses over Q.

        Raises
        ------
        UnluckyPrimeError
            If a choice was a bad one: then other primes are to be tried.
        OutOfReachError, ReconstructionError
            If a limit of the policy is met.
        """
        self.stages.enter("separating form")
        chosen = None if start.poses is None else choose_parameters(start.poses, self.problem, self.policy)
        if chosen is None:
            raise UnluckyPrimeError("no chart and form that were tried show all poses")
        try:
            lifted = self._lifted(start, chosen)
        except ReconstructionError:
            self._require_agreement(start, chosen)
            raise
        if lifted is None:
            raise UnluckyPrimeError("the representation did not pass verification")
        return lifted

    def _lifted(self, start: Start, chosen: Parameters) -> PoseRepresentation | None:
        """The poses of each multiplicity over Q, verified, and all of them together; None if these are not."""
        prime = start.image.prime
        seed = self.policy.seed_for(self.problem.digest, prime)
        equations: Equations = StudyEquations(self.problem, chosen.chart, seed)
        if pose_quartics(self.problem):
            from pkm_exact.algebra.equations import SystemEquations
            from pkm_exact.poses.chart_system import chart_system

            equations = SystemEquations(chart_system(self.problem, chosen.chart), seed)
        proposed = self._proposed(start, chosen)
        if proposed is not None:
            return proposed
        form = [chosen.form[k] for k in free_coordinates(chosen.chart, self.problem)]
        bits = self.policy.lifting_bits
        images = _further_images(start, chosen, self.problem, self.policy.attempts)
        parts = []
        if self.policy.lifting == "multimodular":
            stage = "lifting by primes"
            accept, watch = self._acceptance(chosen, stage), self._watch(chosen.modular, start, chosen, stage)
            return pose_representation(chosen.chart, self.problem, lift_by_primes(form, images, bits, accept, watch))
        for multiplicity, modular in chosen.modular.parts(start.frame.formulated.fibre).items():
            stage = "p-adic lifting" if multiplicity == 1 else "lifting by primes"
            accept, watch = self._acceptance(chosen, stage), self._watch(modular, start, chosen, stage)
            if multiplicity == 1:
                parts.append(lift_by_newton(equations, form, modular, bits, accept, watch))
            else:
                some = _parts(images, multiplicity, start, self.policy.attempts)
                parts.append(lift_by_primes(form, some, bits, accept, watch))
        self.stages.enter("verification")
        lifted = pose_representation(chosen.chart, self.problem, union(parts))
        return lifted if len(parts) == 1 or lifted.is_verified(self.problem) else None

    def _proposed(self, start: Start, chosen: Parameters) -> PoseRepresentation | None:
        """What is proposed for simple solutions, if it is right: modulo the prime, and then over Q."""
        if self.proposal is None or self.policy.lifting != "numeric":
            return None
        parts = chosen.modular.parts(start.frame.formulated.fibre)
        if list(parts) != [1]:
            return None
        accept = self._acceptance(chosen, "numeric lifting")
        expected = expected_bits(self.problem, chosen.modular.degree)
        found = self.proposal(self.problem, chosen, self.policy.lifting_bits, partial(self.tell, expected))
        if found is None or not parts[1].is_image_of(found) or not accept(found):
            return None
        return pose_representation(chosen.chart, self.problem, found)

    def _watch(
        self, modular: ModularRepresentation, start: Start, chosen: Parameters, stage: str
    ) -> Callable[[int], None]:
        """Says how far the lifting of some solutions has come, of an estimate, and asks other primes if it is long."""
        expected = expected_bits(self.problem, modular.degree)
        doubtful = max(DOUBT * expected, LEAST_DOUBT)

        def watch(bits: int) -> None:
            nonlocal doubtful
            self.tell(expected, bits)
            if bits > doubtful:
                doubtful *= 2
                self._require_agreement(start, chosen)
                self.stages.enter(stage)

        return watch

    def tell(self, expected: int, bits: int) -> None:
        """Say how many bits are reached, of about so many."""
        self.stages.amount(Amount(bits, expected if bits < expected else None, "bits", "about"))

    def _require_agreement(self, start: Start, chosen: Parameters) -> None:
        """The next prime has as many poses of each multiplicity, in the chart and form chosen.

        Raises
        ------
        UnluckyPrimeError
            If it has not: one of the two is unlucky.
        """
        self.stages.enter("Groebner basis")
        fibre = start.frame.formulated.fibre
        other = _represented(start.frame.at_next_prime(), chosen, ())
        if other is None or _degrees(other, fibre) != _degrees(chosen.modular, fibre):
            raise UnluckyPrimeError("two primes have different poses")

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


def _degrees(modular: ModularRepresentation, fibre: int) -> dict[int, int]:
    """How many solutions have each multiplicity."""
    return {multiplicity: part.degree for multiplicity, part in modular.parts(fibre).items()}


def _represented(start: Start, chosen: Parameters, wanted: Sequence[int]) -> ModularRepresentation | None:
    """The wanted coordinates in the chart and form chosen; None if the chart does not show all poses, or none is."""
    coordinates = start.poses.coordinates(chosen.chart) if start.poses and start.count else None
    return start.poses.representation(coordinates, chosen.form, wanted) if start.poses and coordinates else None


def _further_images(
    start: Start, chosen: Parameters, problem: ForwardProblem, misses_allowed: int
) -> Iterator[ModularRepresentation]:
    """The representation in the chosen chart and form at one prime after another.

    Raises
    ------
    UnluckyPrimeError
        If it has no image at too many of them, one after another: the first prime was the unlucky one.
    """
    wanted = free_coordinates(chosen.chart, problem)
    misses = 0
    while misses <= misses_allowed:
        image = _represented(start.frame.at_next_prime(along_trace=True), chosen, wanted)
        if image is None:
            misses += 1
            continue
        misses = 0
        yield image
    raise UnluckyPrimeError("the chart misses poses at all primes but the first")


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
        part = image.parts(start.frame.formulated.fibre).get(multiplicity)
        if part is not None:
            yield part
            continue
        misses += 1
        if misses > misses_allowed:
            raise UnluckyPrimeError(f"solutions of multiplicity {multiplicity} appear at the first prime only")
