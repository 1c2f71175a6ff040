"""The certified numeric engine: floating point finds all solutions, Krawczyk's operator proves them, Bezout the rest.

If 40 solutions (6 of a planar robot) are certified, they are all, by the refined theorem of Bezout. If not, because
the robot has fewer finite ones or some are too close to each other, the exact engine answers instead, and says so.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Final

from pkm_exact.engine import solve
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.certification import IsolatedSolutions
from pkm_exact.numeric.krawczyk import ChartSystem
from pkm_exact.numeric.poses import approximations, certified_solutions, motion_degree, real_poses
from pkm_exact.numeric.start import StartSection
from pkm_exact.policy import Policy
from pkm_exact.poses.boxes import DEFAULT_WIDTH
from pkm_exact.poses.completeness import CompletenessProof
from pkm_exact.solution import Solution, Statistics
from pkm_exact.stages import Stages
from pkm_exact.verdict import Claim, CompletenessRoute

ATTEMPTS: Final = 2
"""Times that all paths are tracked, each time along other paths, before the exact engine takes over."""
FORMULATION: Final = "AFD5"
"""The equations are those of the legs and Study's condition in Study coordinates."""


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
    problem : ForwardProblem
        Exact geometry and squared leg lengths.
    width : Fraction
        Largest width of a box, in every coordinate (unit of length, or 1 for rotations).
    policy : Policy, optional
        Limits and random choices.
    progress : callable, optional
        Gets one line when a stage starts.
    start : StartSection, optional
        A section whose solutions are known, close to the robot's (``nearby.nearby_start``), for the first attempt; by
        default the generic one.

    Returns
    -------
    Solution
        With method "krawczyk" and the claim "complete"; or what the exact engine found, with a note.

    Raises
    ------
    PkmExactError
        As ``engine.solve``, if that has to be called.
    """
    policy, stages = policy or Policy(), Stages(progress)
    best = 0
    for attempt in range(ATTEMPTS):
        stages.enter("path tracking")
        try:
            found = approximations(problem, None if attempt else start, policy.seed * attempt)
        except OverflowError:
            break
        stages.enter("Krawczyk operator")
        system, isolated = certified_solutions(problem, found)
        best = max(best, isolated.count)
        if isolated.count == motion_degree(problem):
            return _solution(system, isolated, width, stages)
    stages.leave()
    exact = solve(problem, width=width, policy=policy, progress=progress)
    note = (
        f"the numeric engine certified {best} of {motion_degree(problem)} solutions, which does not prove the list "
        "complete; the exact engine answered instead"
    )
    return replace(exact, notes=(*exact.notes, note))


def _solution(system: ChartSystem, isolated: IsolatedSolutions, width: Fraction, stages: Stages) -> Solution:
    """The answer when all solutions are certified."""
    stages.enter("boxes and Jacobians")
    isolated, exponent, poses = real_poses(system, isolated, width)
    stages.leave()
    return Solution(
        problem=system.problem,
        formulation=FORMULATION,
        method="krawczyk",
        claim=Claim.COMPLETE,
        completeness=CompletenessProof(CompletenessRoute.REFINED_BEZOUT, isolated.count),
        complex_solutions=isolated.count,
        distinct_solutions=isolated.count,
        representation=None,
        box_exponent=exponent,
        poses=poses,
        isolated=isolated,
        statistics=Statistics(seconds=dict(stages.seconds)),
    )
