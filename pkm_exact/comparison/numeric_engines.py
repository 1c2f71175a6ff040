"""The numeric engines that are compared: from a robot, a number of starts and a seed to where every start ends."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Final, TypeAlias

import numpy as np

from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion import Motion
from pkm_exact.numeric.home import home_pose, random_states
from pkm_exact.numeric.levenberg_marquardt import DescentPolicy, levenberg_marquardt
from pkm_exact.numeric.newton_iteration import newton, newton_from
from pkm_exact.numeric.numeric_machine import NumericMachine
from pkm_exact.numeric.poses import approximations, is_tracked
from pkm_exact.numeric.quaternions import rotation_matrix
from pkm_exact.numeric.study_system import Complex, motion_values
from pkm_exact.numeric.uncertified import NumericPose
from pkm_exact.stages import Amount, Watch

REAL: Final = 1e-6
"""Imaginary part up to which the end of a path, of norm 1 and turned to be as real as it can, is tried as a pose."""


@dataclass(frozen=True)
class Ends:
    """Where the starts of one engine ended.

    Attributes
    ----------
    poses : tuple of NumericPose
        One for every start that ended somewhere among the poses, converged or not.
    others : dict of str to int
        How many ended elsewhere, by reason.
    """

    poses: tuple[NumericPose, ...]
    others: dict[str, int] = field(default_factory=dict)


Engine: TypeAlias = Callable[[ForwardProblem, NumericMachine, int, int, Watch], Ends]


def newton_at_home(_problem: ForwardProblem, robot: NumericMachine, _starts: int, _seed: int, _watch: Watch) -> Ends:
    """Newton's method from the home pose."""
    return Ends((newton(robot, home_pose(robot)),))


def newton_anywhere(_problem: ForwardProblem, robot: NumericMachine, starts: int, seed: int, watch: Watch) -> Ends:
    """Newton's method from random poses."""
    c, quaternions = random_states(robot, starts, seed)
    poses = []
    for i in range(starts):
        watch(Amount(i, starts, "starts"))
        poses.append(newton_from(robot, c[i], tuple(quaternions[:, i].tolist())))
    return Ends(tuple(poses))


def descent(_problem: ForwardProblem, robot: NumericMachine, starts: int, seed: int, _watch: Watch) -> Ends:
    """Levenberg-Marquardt from the same poses."""
    return Ends(levenberg_marquardt(robot, DescentPolicy(starts=starts, seed=seed)))


def path_tracking(problem: ForwardProblem, robot: NumericMachine, _starts: int, _seed: int, watch: Watch) -> Ends:
    """The paths from all solutions of a generic robot; those that end at real points are refined by Newton's method."""
    found = approximations(problem, watch=watch)
    poses, complex_ends = [], 0
    for point in found.points:
        values = motion_values(_full(point, problem.motion))
        turned = point / np.sqrt(values[-1] / abs(values[-1]))
        if np.linalg.norm(turned.imag) > REAL:
            complex_ends += 1
            continue
        e = _full(turned, problem.motion).real[:4]
        q0, q1, q2, q3 = (e / np.linalg.norm(e)).tolist()
        frames, rotation = found.section.frames, rotation_matrix((q0, q1, q2, q3))
        c = frames.base - robot.base_centre + rotation @ (robot.platform_centre - frames.platform)
        c = (c + frames.unit * (values[4:7] / values[-1]).real) / robot.unit
        poses.append(newton_from(robot, c, (q0, q1, q2, q3)))
    lost = problem.solution_bound - len(found.points)
    return Ends(tuple(poses), {"not real": complex_ends, "lost or at infinity": lost})


def _full(point: Complex, motion: Motion) -> Complex:
    """All eight Study coordinates of a solution."""
    full = np.zeros(8, dtype=complex)
    full[list(motion.support)] = point
    return full


ENGINES: Final[dict[str, Engine]] = {
    "newton, home": newton_at_home,
    "newton": newton_anywhere,
    "levenberg-marquardt": descent,
    "path tracking": path_tracking,
}


def engines_for(problem: ForwardProblem) -> dict[str, Engine]:
    """Those that there are for a robot: no paths lead to mechanisms with cylinders or redundant constraints.

    Examples
    --------
    >>> list(engines_for(ForwardProblem(())))
    ['newton, home', 'newton', 'levenberg-marquardt']
    """
    return {name: engine for name, engine in ENGINES.items() if engine is not path_tracking or is_tracked(problem)}
