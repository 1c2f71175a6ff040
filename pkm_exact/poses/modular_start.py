"""Where the search for poses begins: their number modulo a prime, in a frame in which a formulation has all of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice

from pkm_exact.algebra.groebner import OutOfReachError, UnluckyPrimeError
from pkm_exact.algebra.modular_elimination import Elimination, ModularImage
from pkm_exact.errors import InternalContradictionError
from pkm_exact.formulations.base import FormulatedProblem
from pkm_exact.formulations.registry import formulation_codes, formulation_for
from pkm_exact.formulations.turned import Turn, candidate_turns, formulate_turned
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.policy import Policy
from pkm_exact.poses.modular import ModularPoses, modular_poses
from pkm_exact.stages import Stages


@dataclass(frozen=True)
class Frame:
    """A frame of the platform, and the robot as a formulation writes it there.

    Attributes
    ----------
    formulated : FormulatedProblem
    turn : quaternion of 4 int
        By which the platform frame was turned.
    attempt : int
        Number of frames tried before this one.
    elimination : Elimination
        Of the formulated problem; it goes on from prime to prime.
    metric : tuple of 3 int
    """

    formulated: FormulatedProblem
    turn: Turn
    attempt: int
    elimination: Elimination
    metric: tuple[int, int, int]

    def at_next_prime(self, *, along_trace: bool = False) -> Start:
        """The poses at the next prime; a trace is quicker where many primes are wanted.

        Raises
        ------
        UnluckyPrimeError
            If the prime does not serve.
        OutOfReachError
            If a limit of the policy is met.
        """
        image = self.elimination.following() if along_trace else self.elimination.image()
        poses = modular_poses(self.formulated, image.algebra, self.metric)
        return Start(self, image, poses, None if poses is None else poses.count)


@dataclass(frozen=True)
class Start:
    """The poses modulo a prime.

    Attributes
    ----------
    frame : Frame
    image : ModularImage
    poses : ModularPoses or None
        None if they are infinitely many.
    count : int or None
        Their number, with multiplicity.
    """

    frame: Frame
    image: ModularImage
    poses: ModularPoses | None
    count: int | None


@dataclass
class StartSearch:
    """The search for a start. What one prime says is believed if it is lifted and verified, or if another one agrees.

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
    _frames: list[Frame] = field(init=False, default_factory=list)

    def started(self) -> Start:
        """The poses at further primes, in a frame in which the formulation has coordinates for all of them.

        Raises
        ------
        OutOfReachError
            If there is no such frame among those tried, or a limit of the policy is met.
        """
        turns = candidate_turns(self.policy.seed, self.policy.seed_for(self.problem.digest, "frames"))
        for attempt, turn in enumerate(islice(turns, self.policy.attempts)):
            if attempt == len(self._frames):
                self._frames.append(self._frame(turn, attempt))
            start = self._confirmed(self._frames[attempt])
            if not start.frame.formulated.is_chart or start.count == self._reference_count:
                return start
            # That poses are missing may be the fault of either prime.
            del self._reference_count
            start = self._confirmed(self._frames[attempt])
            if start.count == self._reference_count:
                return start
            self.retries += 1
        raise OutOfReachError(
            f"{self.code} misses poses in every frame of the platform that was tried: they have no finite coordinates"
        )

    def _frame(self, turn: Turn, attempt: int) -> Frame:
        self.stages.enter("formulation")
        formulated = formulate_turned(formulation_for(self.code, self.problem), self.problem, turn)
        elimination = Elimination(formulated.branches[0], self.policy, self.stages.amount)
        return Frame(formulated, turn, attempt, elimination, self.problem.metric)

    @cached_property
    def _reference(self) -> StartSearch:
        """The same search with the formulation that misses no pose, to see whether a chart does."""
        return StartSearch(self.problem, formulation_codes()[0], self.policy, self.stages)

    @cached_property
    def _reference_count(self) -> int | None:
        """Number of poses by that formulation, at further primes; None if infinite."""
        return self._reference.started().count

    def _confirmed(self, frame: Frame) -> Start:
        """The poses at the next prime, or, if there are none or infinitely many, at one of two primes that agree."""
        self.stages.enter("Groebner basis")
        last: Start | None = None
        for _ in range(2 * self.policy.attempts):
            try:
                start = frame.at_next_prime()
            except UnluckyPrimeError:
                self.retries += 1
                continue
            if last is not None and last.count == start.count:
                return last
            self.retries += last is not None
            if start.count:
                return start
            last = start
        raise InternalContradictionError("the number of solutions differs from prime to prime")
