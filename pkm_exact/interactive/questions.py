"""The questions of the engines, asked of a bare problem; their answers can show themselves.

Asked of a robot, by the methods of ``Robot``, they have answers that also certify, check and save themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

import pkm_exact.engine as exact
import pkm_exact.numeric_engine as numeric
from pkm_exact.interactive.answers import Solution, ToleranceResult
from pkm_exact.poses.boxes import DEFAULT_WIDTH

if TYPE_CHECKING:
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.geometry.tolerances import Tolerances
    from pkm_exact.numeric.start import StartSection
    from pkm_exact.policy import Policy
    from pkm_exact.stages import Progress


def solve(
    problem: ForwardProblem,
    *,
    formulation: str = "SE3",
    width: Fraction = DEFAULT_WIDTH,
    policy: Policy | None = None,
    progress: Progress | None = None,
) -> Solution:
    """All real poses of a robot whose actuators are locked, each in a box, and what is proved about the list.

    Parameters
    ----------
    problem : ForwardProblem
        Exact constraints, the motions and the metric.
    formulation : str
        Code of the formulation whose Groebner basis is used. By SE3 there is none where numerical solutions lead
        to as many poses as there can be, which are then proved (``Policy.eliminate``).
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

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
    >>> print(solve(robot.problem(robot.configuration())))
    6 complex solutions, 2 real poses; complete
    """
    return Solution.of(exact.solve(problem, formulation=formulation, width=width, policy=policy, progress=progress))


def solve_krawczyk(
    problem: ForwardProblem,
    *,
    width: Fraction = DEFAULT_WIDTH,
    policy: Policy | None = None,
    progress: Callable[[str], None] | None = None,
    start: StartSection | None = None,
) -> Solution:
    """All real poses of a robot by certified numerics; by the exact engine where these do not suffice.

    Parameters
    ----------
    problem, width, policy, progress
        As for ``solve``.
    start : StartSection, optional
        A section whose solutions are known, close to the robot's (``nearby.nearby_start``), to be tried before the
        generic one.

    Returns
    -------
    Solution
        With method "krawczyk" and the claim "complete"; or what the exact engine found, with a note.

    Raises
    ------
    PkmExactError
        As ``solve``, if that has to be called.

    Examples
    --------
    >>> from pkm_exact import read_robot
    >>> robot = read_robot("models/3-rpr-merlet-p.toml")
    >>> found = solve_krawczyk(robot.problem(robot.configuration()))
    >>> str(found.claim), len(found.poses)
    ('complete', 2)
    """
    return Solution.of(numeric.solve_krawczyk(problem, width=width, policy=policy, progress=progress, start=start))


def tolerance_boxes(
    problem: ForwardProblem,
    tolerances: Tolerances,
    solution: Solution,
    progress: Progress | None = None,
    *,
    asked: Sequence[int] | None = None,
) -> ToleranceResult:
    """For every pose of a solution the box of that pose over all robots within tolerance.

    Parameters
    ----------
    problem : ForwardProblem
        The nominal robot.
    tolerances : Tolerances
        Greatest errors of its data.
    solution : Solution
        Of the nominal robot.
    progress : callable, optional
        Gets one line when a stage starts.
    asked : sequence of int, optional
        Numbers of the poses that matter, from 1; of others nothing is found out, nor whether there are more. By default
        all.

    Raises
    ------
    InputError
        If the robot has not six legs of known length, nor three in the plane.
    ValueError
        If the solution is not one of the problem.

    Examples
    --------
    >>> from pkm_exact import Robot, Tolerances
    >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
    >>> print(tolerance_boxes(robot.problem(robot.configuration()), Tolerances.uniform("0.0001"), robot.solve()))
    2 of 2 poses have a box for every robot within tolerance; complete: every robot within tolerance has exactly 2 \
poses, one in each box
    """
    from pkm_exact.numeric.tolerance import tolerance_boxes as boxes

    found = boxes(problem, tolerances, solution, progress, asked)
    return ToleranceResult.of(found, solution.robot, solution.configuration)
