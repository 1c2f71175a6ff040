"""The usual numeric practice held against the certified poses: what it finds, misses and makes up, and how far off.

Every engine starts from poses that know nothing of the solutions. Where each start ends is looked up among the
certified poses (``comparison.numeric_distance``); the error of a numeric pose is its true one, with certified bounds,
not a residual.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from time import perf_counter
from typing import Any, Final

from pkm_exact.claim_wording import INFINITE, without_a_list
from pkm_exact.comparison.numeric_distance import Judge, Judged, Landing
from pkm_exact.comparison.numeric_engines import engines_for
from pkm_exact.engine import solve
from pkm_exact.errors import PkmExactError
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.levenberg_marquardt import DescentPolicy
from pkm_exact.numeric.numeric_mechanism import numeric_machine
from pkm_exact.numeric.uncertified import NumericPose
from pkm_exact.poses.jacobian import characteristic_length
from pkm_exact.roots.interval import Interval
from pkm_exact.solution import Solution
from pkm_exact.stages import Amount, tell

WIDTH: Final = Fraction(1, 10**30)
"""Width of the certified boxes: far below what a double resolves."""
STARTS: Final = 100
SEED: Final = DescentPolicy.seed


class NothingToCompareError(PkmExactError):
    """There is no list of all poses; ``solution`` is the certified answer."""

    def __init__(self, solution: Solution) -> None:
        super().__init__(f"the robot has no list of poses to compare with: {without_a_list(solution.claim)}")
        self.solution = solution


@dataclass(frozen=True)
class EngineResult:
    """Where the starts of one numeric engine ended.

    Attributes
    ----------
    engine : str
    poses : tuple of NumericPose
        One for every start that ended somewhere among the poses, converged or not.
    judged : tuple of Judged
        What the certified poses say of each.
    others : dict of str to int
        How many starts ended elsewhere, by reason: paths that are lost, or end at points that are not real.
    seconds : float
        Time of all starts together.
    """

    engine: str
    poses: tuple[NumericPose, ...]
    judged: tuple[Judged, ...]
    others: dict[str, int]
    seconds: float = field(compare=False)

    @property
    def starts(self) -> int:
        """Number of starts."""
        return len(self.poses) + sum(self.others.values())

    @property
    def hits(self) -> dict[int, int]:
        """How many starts ended at each assembly mode that was hit; modes are numbered from 1."""
        return dict(sorted(Counter(judged.mode for judged in self.judged if judged.mode is not None).items()))

    @property
    def endings(self) -> dict[str, int]:
        """How many starts ended for each reason, the most frequent first."""
        counts = Counter(pose.ending.value for pose in self.poses) + Counter(self.others)
        return dict(counts.most_common())

    def count(self, landing: Landing) -> int:
        """How many starts ended so."""
        return sum(judged.landing is landing for judged in self.judged)

    def errors(self, mode: int | None = None) -> tuple[Interval, ...]:
        """The errors of all poses at an assembly mode, or at a given one."""
        return tuple(
            judged.error
            for judged in self.judged
            if judged.error is not None and judged.mode is not None and mode in (None, judged.mode)
        )

    def as_object(self) -> dict[str, Any]:
        """The result as JSON has it; bounds of errors are exact rationals as strings, poses are doubles."""
        return {
            "engine": self.engine,
            "starts": self.starts,
            "endings": self.endings,
            "landings": {landing.value: self.count(landing) for landing in Landing},
            "hits": {str(mode): count for mode, count in self.hits.items()},
            "seconds": self.seconds,
            "limits": [_limit(pose, judged) for pose, judged in zip(self.poses, self.judged, strict=True)],
        }


@dataclass(frozen=True)
class NumericComparison:
    """Numeric engines and the certified poses of one robot.

    Attributes
    ----------
    solution : Solution
        The certified poses, in narrow boxes.
    starts, seed : int
        Random starts of each engine, and their seed.
    results : tuple of EngineResult
    """

    solution: Solution
    starts: int
    seed: int
    results: tuple[EngineResult, ...]

    def missed(self, result: EngineResult) -> tuple[int, ...]:
        """The assembly modes at which no start of an engine ended."""
        return tuple(mode for mode in range(1, len(self.solution.poses) + 1) if mode not in result.hits)

    def __str__(self) -> str:
        total = len(self.solution.poses)
        parts = (f"{result.engine} {len(result.hits)}" for result in self.results)
        return f"of {total} certified pose{'' if total == 1 else 's'}: {', '.join(parts)}"

    def as_object(self) -> dict[str, Any]:
        """The comparison as JSON has it."""
        return {
            "claim": self.solution.claim.value,
            "real_poses": len(self.solution.poses),
            "poses": [
                {
                    "position": [_bounds(c) for c in pose.position],
                    "quaternion": [_bounds(q) for q in pose.quaternion],
                    "multiplicity": pose.multiplicity,
                }
                for pose in self.solution.poses
            ],
            "starts": self.starts,
            "seed": self.seed,
            "engines": [{**result.as_object(), "missed": list(self.missed(result))} for result in self.results],
        }


def compare_numeric(
    problem: ForwardProblem,
    *,
    starts: int = STARTS,
    seed: int = SEED,
    solution: Solution | None = None,
    progress: Callable[[str], None] | None = None,
) -> NumericComparison:
    """The numeric engines on one robot, each limit judged by the certified poses.

    The engines: Newton's method from the home pose and from random poses; Levenberg-Marquardt from the same; and path
    tracking, a parameter homotopy from all 40 solutions of a generic robot (6 of a planar one).

    Parameters
    ----------
    problem : ForwardProblem
    starts : int
        Random start poses; path tracking has starts of its own.
    seed : int
        Their seed.
    solution : Solution, optional
        The certified solution of the same problem, if it is known already.
    progress : callable, optional
        Gets one line when a stage starts.

    Raises
    ------
    InputError
        If a number of the robot is out of reach of floating point.
    PkmExactError
        If the certified engine gives no answer.
    NothingToCompareError
        If it has no list of all poses, since they form a set of positive dimension, or seem to.
    """
    robot = numeric_machine(problem)
    certified = solve(problem, width=WIDTH, progress=progress) if solution is None else solution
    if certified.claim in INFINITE:
        raise NothingToCompareError(certified)
    judge = Judge(problem, certified.poses, characteristic_length(problem))
    results = []
    for name, engine in engines_for(problem).items():
        if progress is not None:
            progress(name)
        begin = perf_counter()
        ends = engine(problem, robot, starts, seed, partial(tell, progress))
        seconds = perf_counter() - begin
        judged = []
        for count, pose in enumerate(ends.poses):
            tell(progress, Amount(count, len(ends.poses), "ends judged"))
            judged.append(judge.judge(pose))
        results.append(EngineResult(name, ends.poses, tuple(judged), ends.others, seconds))
    return NumericComparison(certified, starts, seed, tuple(results))


def _limit(pose: NumericPose, judged: Judged) -> dict[str, Any]:
    return {
        "ending": pose.ending.value,
        "landing": judged.landing.value,
        "mode": judged.mode,
        "error": None if judged.error is None else _bounds(judged.error),
        "residual": pose.residual,
        "iterations": pose.iterations,
        "position": list(pose.position),
        "quaternion": list(pose.quaternion),
    }


def _bounds(interval: Interval) -> list[str]:
    return [str(interval.lo), str(interval.hi)]
