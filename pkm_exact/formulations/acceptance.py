"""What a formulation may need of a problem: all motions, linear constraints, or six legs of known length."""

from __future__ import annotations

from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion_groups import SPATIAL

_LEGS = 6


def needs_all_motions(problem: ForwardProblem) -> str | None:
    """Why a formulation of all rigid motions cannot write the problem; None if it can.

    Examples
    --------
    >>> from pkm_exact.motions.motion_groups import PLANAR
    >>> needs_all_motions(ForwardProblem((), motion=PLANAR))
    'spatial robots, but this one is planar'
    """
    if problem.motion == SPATIAL:
        return None
    if problem.motion.is_planar:
        return "spatial robots, but this one is planar"
    return f"spatial robots, but the motion of this one is {problem.motion.name}"


def needs_linear_constraints(problem: ForwardProblem) -> str | None:
    """Why a formulation of linear constraints on all rigid motions cannot write the problem; None if it can.

    Examples
    --------
    >>> needs_linear_constraints(ForwardProblem(())) is None
    True
    """
    reason = needs_all_motions(problem)
    if reason is None and problem.squares:
        return "constraints that are linear on rigid motions, but this robot has one of the type axis-distance"
    return reason


def needs_six_legs(problem: ForwardProblem) -> str | None:
    """Why a formulation by the legs of a hexapod cannot write the problem; None if it can.

    Examples
    --------
    >>> needs_six_legs(ForwardProblem(()))
    'six legs of known length, but this robot has 0 constraints'
    """
    reason = needs_all_motions(problem)
    if reason is not None:
        return reason
    for found in problem.constraints:
        if found.type != "distance":
            return f"six legs of known length, but this robot has a constraint of the type {found.type}"
    count = len(problem.constraints)
    return None if count == _LEGS else f"six legs of known length, but this robot has {count} constraints"
