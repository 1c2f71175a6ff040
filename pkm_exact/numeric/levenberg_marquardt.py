"""Levenberg-Marquardt from many random start poses at once, and the distinct poses that it finds. Uncertified.

Residual f and Jacobian J are those of ``numeric.newton_iteration``. A step solves (J^T J + d I)(v, w) = -J^T f; the
damping d is divided by ten after a step that makes |f| smaller, and multiplied by ten, with the step taken back, after
one that does not. So the iteration goes downhill from anywhere, and is Newton's method where it arrives. It stagnates
in places where |f| is least without being zero.

References: D. W. Marquardt, "An algorithm for least-squares estimation of nonlinear parameters" (1963); on the group of
motions the step moves to c + v and exp(w) R as in ``numeric.newton_iteration``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.home import random_states
from pkm_exact.numeric.numeric_machine import NumericMachine, Place, Real, numeric_pose
from pkm_exact.numeric.numeric_mechanism import numeric_machine
from pkm_exact.numeric.quaternions import turned
from pkm_exact.numeric.uncertified import Ending, NumericPose, UncertifiedSolution

METHOD: Final = "levenberg-marquardt"


@dataclass(frozen=True)
class DescentPolicy:
    """Limits of the iteration, for robots of size 1.

    Attributes
    ----------
    starts : int
        Random start poses.
    seed : int
        Seed of the start poses.
    residual : float
        Error of a leg's length, or of another constraint, below which an iteration has converged.
    iterations : int
        Most steps, those taken back included.
    first, least, greatest : float
        Damping: the first one; the least, which keeps the matrix regular; the greatest, beyond which the iteration has
        stagnated.
    progress : float
        Relative decrease of |f|^2 in a step below which the iteration has stagnated.
    distinct : float
        Displacement of a point of the platform up to which two limits count as one pose. Near a multiple pose limits
        scatter by the square root of ``residual`` and more.
    """

    starts: int = 200
    seed: int = 20081125
    residual: float = 1e-13
    iterations: int = 300
    first: float = 1e-2
    least: float = 1e-13
    greatest: float = 1e6
    progress: float = 1e-6
    distinct: float = 1e-5


DEFAULT: Final = DescentPolicy()


def solve_levenberg_marquardt(problem: ForwardProblem, policy: DescentPolicy = DEFAULT) -> UncertifiedSolution:
    """The distinct poses that Levenberg-Marquardt finds from random starts.

    Raises
    ------
    InputError
        If a number of the robot is out of reach of floating point.
    """
    robot = numeric_machine(problem)
    poses = distinct_poses(robot, levenberg_marquardt(robot, policy), policy.distinct)
    note = f"found from {policy.starts} random start poses (seed {policy.seed})"
    return UncertifiedSolution(problem, METHOD, poses, (note,))


def levenberg_marquardt(robot: NumericMachine, policy: DescentPolicy = DEFAULT) -> tuple[NumericPose, ...]:
    """Where the iterations end, one for each random start, in their order."""
    with np.errstate(all="ignore"):
        return _Descent.started(robot, policy).run()


def distinct_poses(robot: NumericMachine, limits: Sequence[NumericPose], distance: float) -> tuple[NumericPose, ...]:
    """The converged limits without repetitions: those no two of which are closer than ``distance`` times the unit.

    Of limits that are close together the one with the least residual stays. Sorted by position, then by rotation.
    """
    chosen: list[NumericPose] = []
    joints = np.empty((0, *robot.markers.shape))
    for limit in sorted((pose for pose in limits if pose.converged), key=lambda pose: (pose.residual, pose.position)):
        rotation = np.array(limit.rotation)
        centre = np.array(limit.position) + rotation @ robot.platform_centre
        place = (rotation @ robot.markers + (centre / robot.unit)[:, None])[None]
        if len(chosen) == 0 or float(np.sqrt(((joints - place) ** 2).sum(axis=1)).max(axis=1).min()) > distance:
            chosen.append(limit)
            joints = np.concatenate([joints, place])
    return tuple(sorted(chosen, key=lambda pose: (pose.position, pose.rotation)))


@dataclass
class _Descent:
    """All iterations: their poses, dampings and what ended them; ``active`` are those that have not ended."""

    robot: NumericMachine
    policy: DescentPolicy
    c: Real
    q: Real
    damping: Real
    steps: NDArray[np.int64]
    endings: list[Ending]
    active: NDArray[np.int64] = field(repr=False)

    @staticmethod
    def started(robot: NumericMachine, policy: DescentPolicy) -> _Descent:
        c, q = random_states(robot, policy.starts, policy.seed)
        count = policy.starts
        endings = [Ending.TOO_MANY_ITERATIONS] * count
        return _Descent(
            robot, policy, c, q, np.full(count, policy.first), np.zeros(count, np.int64), endings, np.arange(count)
        )

    def run(self) -> tuple[NumericPose, ...]:
        place = self.robot.at(self.c, tuple(self.q))
        for _ in range(self.policy.iterations + 1):
            place = place.at(self._retire(place))
            if not len(self.active):
                break
            place = self._step(place)
        return tuple(
            numeric_pose(self.robot, self.c[i], tuple(self.q[:, i].tolist()), ending, int(self.steps[i]))
            for i, ending in enumerate(self.endings)
        )

    def _retire(self, place: Place) -> NDArray[np.bool_]:
        """End what has converged or stagnated; which of the active ones go on."""
        converged = place.worst <= self.policy.residual
        stagnated = ~converged & (self.damping[self.active] > self.policy.greatest)
        for which, ending in ((converged, Ending.CONVERGED), (stagnated, Ending.STAGNATED)):
            for index in self.active[which]:
                self.endings[index] = ending
        going = ~(converged | stagnated)
        self.active = self.active[going]
        return np.asarray(going)

    def _step(self, place: Place) -> Place:
        """One step of all active iterations, taken back where it does not help; the constraints at the new poses."""
        i, f = self.active, place.errors
        moving = list(self.robot.motion.twist)
        transposed = place.transposed_jacobian()[:, moving]
        matrix = transposed @ transposed.transpose(0, 2, 1) + self.damping[i, None, None] * np.eye(transposed.shape[1])
        step = np.zeros((len(i), 6))
        step[:, moving] = np.linalg.solve(matrix, -(transposed @ f[:, :, None]))[:, :, 0]
        c, q = self.c[i] + step[:, :3], np.array(turned(tuple(self.q[:, i]), tuple(step[:, 3:].T)))
        moved = self.robot.at(c, tuple(q))
        before, after = (f * f).sum(axis=1), (moved.errors**2).sum(axis=1)
        better = after < before
        slow = better & (after > (1 - self.policy.progress) * before)
        self.c[i[better]], self.q[:, i[better]] = c[better], q[:, better]
        self.damping[i] = np.where(better, np.maximum(self.damping[i] / 10, self.policy.least), self.damping[i] * 10)
        self.damping[i[slow]] = np.inf  # ends as stagnated, unless it has converged
        self.steps[i] += better
        return place.changed(better, moved)
