"""Newton-Raphson from a start pose, the usual way to solve forward kinematics: fast, and uncertified.

The unknown is the pose (c, R), see ``numeric.numeric_robot``; the residual is f_i = |c + R B_i - A_i| - l_i. With n_i
the unit vector of leg i, along a velocity v and an angular velocity w of the platform

    df_i = n_i . v + ((R B_i) x n_i) . w,

the Pluecker coordinates of the leg are the row of the Jacobian. A step solves J (v, w) = -f and moves to c + v and
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
from pkm_exact.numeric.numeric_robot import NumericRobot, Real, StartPose, centred, numeric_pose, numeric_robot
from pkm_exact.numeric.quaternions import rotation_matrix, turned
from pkm_exact.numeric.uncertified import Ending, NumericPose, Quaternion, UncertifiedSolution


@dataclass(frozen=True)
class NewtonPolicy:
    """Limits of the iteration, for robots of size 1.

    Attributes
    ----------
    residual : float
        Error of a leg's length below which the iteration has converged; some hundred roundings.
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


def newton(robot: NumericRobot, start: StartPose, policy: NewtonPolicy = DEFAULT) -> NumericPose:
    """Where Newton's method ends from a start pose.

    Parameters
    ----------
    robot : NumericRobot
    start : StartPose
    policy : NewtonPolicy, optional

    Raises
    ------
    InputError
        If the start is no pose of the robot's kind, or far off.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from pkm_exact.constraints.distance import Distance
    >>> from pkm_exact.motions.motion_groups import PLANAR
    >>> joints = [((0, 0), (0, 0), 50), ((10, 0), (4, 0), 26), ((3, 10), (2, 2), 25)]
    >>> rows = [[tuple(map(Fraction, (*a, 0))), tuple(map(Fraction, (*b, 0))), Fraction(l)] for a, b, l in joints]
    >>> robot = numeric_robot(ForwardProblem(tuple(Distance(*row) for row in rows), motion=PLANAR))
    >>> pose = newton(robot, StartPose((4.5, 5.5, 0.0), (1.0, 0.0, 0.0, 0.0)))
    >>> pose.ending.value, [round(x, 9) for x in pose.position]
    ('converged', [5.0, 5.0, 0.0])
    """
    return newton_from(robot, *centred(robot, start), policy)


def newton_from(robot: NumericRobot, c: Real, quaternion: Quaternion, policy: NewtonPolicy = DEFAULT) -> NumericPose:
    """The same from (c, q) in the coordinates of the ``NumericRobot``; q of norm 1."""
    base, platform, lengths = robot.base, robot.platform, robot.lengths
    rows = moving_rows(robot)
    ending, iteration = Ending.TOO_MANY_ITERATIONS, 0
    with np.errstate(all="ignore"):
        arms, lines, norms = _legs(base, platform, c, quaternion)
        f = norms - lengths
        square = float(f @ f)
        while True:
            if float(abs(f).max()) <= policy.residual:
                ending = Ending.CONVERGED
                break
            if iteration == policy.iterations:
                break
            step = _step(transposed_jacobian(arms, lines, norms), f, rows)
            if step is None or not step @ step <= policy.inverse**2 * square:
                ending = Ending.SINGULAR
                break
            for _ in range(policy.halvings + 1):
                moved, q = c + step[:3], turned(quaternion, step[3:].tolist())
                arms, lines, norms = _legs(base, platform, moved, q)
                f = norms - lengths
                if float(f @ f) < square:
                    break
                step = step / 2
            else:
                ending = Ending.STAGNATED
                break
            c, quaternion, square, iteration = moved, q, float(f @ f), iteration + 1
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
    robot = numeric_robot(problem)
    begin = home_pose(robot) if start is None else start
    pose = newton(robot, begin)
    place = "the home pose" if start is None else "the given pose"
    if not pose.converged:
        raise NotConvergedError(
            f"Newton's method does not converge from {place} ({pose.ending}; iterations: {pose.iterations}, error of a "
            f"leg's length: {pose.residual:.3g}); choose another start, or the method exact"
        )
    numbers = ", ".join(f"{value:.6g}" for value in (*begin.position, *begin.quaternion))
    return UncertifiedSolution(problem, "newton", (pose,), (f"started from {place} ({numbers})",))


def _legs(base: Real, platform: Real, c: Real, quaternion: Quaternion) -> tuple[Real, Real, Real]:
    """R B_i and c + R B_i - A_i in columns, and the length of each leg."""
    arms = rotation_matrix(quaternion) @ platform
    lines = arms + (c[:, None] - base)
    return arms, lines, np.sqrt((lines * lines).sum(axis=0))


def moving_rows(robot: NumericRobot) -> slice | list[int]:
    """Of (v, w) what is not 0: all six, or three if the robot is planar."""
    return [0, 1, 5] if robot.motion.is_planar else slice(6)


def transposed_jacobian(arms: Real, lines: Real, norms: Real) -> Real:
    """(.., 6, n): the Pluecker coordinates (n_i, (R B_i) x n_i) of the legs in columns."""
    units = lines / norms[..., None, :]
    ax, ay, az = arms[..., 0, :], arms[..., 1, :], arms[..., 2, :]
    nx, ny, nz = units[..., 0, :], units[..., 1, :], units[..., 2, :]
    jacobian = np.empty((*units.shape[:-2], 6, units.shape[-1]))
    jacobian[..., :3, :] = units
    jacobian[..., 3, :] = ay * nz - az * ny
    jacobian[..., 4, :] = az * nx - ax * nz
    jacobian[..., 5, :] = ax * ny - ay * nx
    return jacobian


def _step(transposed: Real, f: Real, rows: slice | list[int]) -> Real | None:
    """(v, w) with J (v, w) = -f; None if J is singular."""
    step = np.zeros(6)
    try:
        step[rows] = np.linalg.solve(transposed[rows].T, -f)
    except np.linalg.LinAlgError:
        return None
    return step
