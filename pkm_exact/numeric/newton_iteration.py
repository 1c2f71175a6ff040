"""Newton-Raphson from a start pose, the usual way to solve forward kinematics: fast, and uncertified.

The unknown is the pose (c, R), see ``numeric.numeric_machine``; the residual f_i of a leg is |c + R B_i - A_i| - l_i.
With n_i the unit vector of leg i, along a velocity v and an angular velocity w of the platform

    df_i = n_i . v + ((R B_i) x n_i) . w,

the Pluecker coordinates of the leg are the row of the Jacobian; of other constraints it is their wrench. A step solves
J (v, w) = -f, in the sense of least squares if there are more constraints than freedoms, and moves to c + v and
exp(w) R; it is halved while |f| does not become smaller.

Reference: J.-P. Merlet, Parallel Robots (2nd ed., 2006), 4.9.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from pkm_exact.errors import PkmExactError
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.home import home_pose
from pkm_exact.numeric.numeric_machine import NumericMachine, Real, StartPose, centred, numeric_pose
from pkm_exact.numeric.numeric_mechanism import numeric_machine
from pkm_exact.numeric.quaternions import turned
from pkm_exact.numeric.uncertified import Ending, NumericPose, Quaternion, UncertifiedSolution


@dataclass(frozen=True)
class NewtonPolicy:
    """Limits of the iteration, for robots of size 1.

    Attributes
    ----------
    residual : float
        Error of a leg's length, or of another constraint, below which the iteration has converged; some hundred
        roundings.
    iterations : int
        Most steps.
    halvings : int
        Most halvings of a step before the iteration is declared stagnated.
    inverse : float
        Size of J^-1 from which J counts as singular; the ratio of step and residual is a lower bound of that size.
    """

    residual: float = 1e-13
    iterations: int = 100
    halvings: int = 30
    inverse: float = 1e12


DEFAULT: Final = NewtonPolicy()


class NotConvergedError(PkmExactError):
    """An iteration did not converge; this says nothing about the poses of the robot."""


def newton(robot: NumericMachine, start: StartPose, policy: NewtonPolicy = DEFAULT) -> NumericPose:
    """Where Newton's method ends from a start pose.

    Parameters
    ----------
    robot : NumericMachine
    start : StartPose
    policy : NewtonPolicy, optional

    Raises
    ------
    InputError
        If the start is no pose of the robot, or far off.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from pkm_exact.constraints.distance import Distance
    >>> from pkm_exact.motions.motion_groups import PLANAR
    >>> joints = [((0, 0), (0, 0), 50), ((10, 0), (4, 0), 26), ((3, 10), (2, 2), 25)]
    >>> rows = [[tuple(map(Fraction, (*a, 0))), tuple(map(Fraction, (*b, 0))), Fraction(l)] for a, b, l in joints]
    >>> robot = numeric_machine(ForwardProblem(tuple(Distance(*row) for row in rows), motion=PLANAR))
    >>> pose = newton(robot, StartPose((4.5, 5.5, 0.0), (1.0, 0.0, 0.0, 0.0)))
    >>> pose.ending.value, [round(x, 9) for x in pose.position]
    ('converged', [5.0, 5.0, 0.0])
    """
    return newton_from(robot, *centred(robot, start), policy)


def newton_from(robot: NumericMachine, c: Real, quaternion: Quaternion, policy: NewtonPolicy = DEFAULT) -> NumericPose:
    """The same from (c, q) in the coordinates of the ``NumericMachine``; q of norm 1."""
    moving = list(robot.motion.twist)
    ending, iteration = Ending.TOO_MANY_ITERATIONS, 0
    with np.errstate(all="ignore"):
        place = robot.at(c, quaternion)
        square = float(place.errors @ place.errors)
        while True:
            if float(place.worst) <= policy.residual:
                ending = Ending.CONVERGED
                break
            if iteration == policy.iterations:
                break
            step = _step(place.transposed_jacobian(), place.errors, moving)
            if step is None or not step @ step <= policy.inverse**2 * square:
                ending = Ending.SINGULAR
                break
            for _ in range(policy.halvings + 1):
                moved, q = c + step[:3], turned(quaternion, step[3:].tolist())
                place = robot.at(moved, q)
                if float(place.errors @ place.errors) < square:
                    break
                step = step / 2
            else:
                ending = Ending.STAGNATED
                break
            c, quaternion, square, iteration = moved, q, float(place.errors @ place.errors), iteration + 1
    return numeric_pose(robot, c, quaternion, ending, iteration)


def solve_newton(problem: ForwardProblem, start: StartPose | None = None) -> UncertifiedSolution:
    """The pose to which Newton's method converges from a start, by default the home pose.

    Raises
    ------
    InputError
        If the start does not fit the robot, or floating point does not.
    NotConvergedError
        If the method does not converge.
    """
    robot = numeric_machine(problem)
    begin = home_pose(robot) if start is None else start
    pose = newton(robot, begin)
    place = "the home pose" if start is None else "the given pose"
    if not pose.converged:
        what = "error of a leg's length" if problem.has_only_distances else "error of a constraint"
        raise NotConvergedError(
            f"Newton's method does not converge from {place} ({pose.ending}; iterations: {pose.iterations}, {what}: "
            f"{pose.residual:.3g}); choose another start, or the method exact"
        )
    numbers = ", ".join(f"{value:.6g}" for value in (*begin.position, *begin.quaternion))
    return UncertifiedSolution(problem, "newton", (pose,), (f"started from {place} ({numbers})",))


def _step(transposed: Real, f: Real, moving: list[int]) -> Real | None:
    """(v, w) with J (v, w) = -f, or as nearly as can be if J has more rows than columns; None if J is singular."""
    step, rows = np.zeros(6), transposed[moving].T
    try:
        if len(rows) == len(moving):
            step[moving] = np.linalg.solve(rows, -f)
        else:
            step[moving], _, rank, _ = np.linalg.lstsq(rows, -f, rcond=None)
            if rank < len(moving):
                return None
    except np.linalg.LinAlgError:
        return None
    return step
