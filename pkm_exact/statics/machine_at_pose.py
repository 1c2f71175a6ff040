"""Any machine, any pose: what users give becomes a machine at a pose."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pkm_exact.balls import hull
from pkm_exact.errors import InputError
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.pose_reader import read_pose
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.poses.pose import Pose
from pkm_exact.precision import working_precision
from pkm_exact.statics.at_pose import AtPose, at_box, at_rational_pose
from pkm_exact.statics.ball_rows import BITS, BallPose
from pkm_exact.statics.placement import held_at, held_in_solution


def machine_at(
    machine: Machine, pose: Mapping[str, Any] | Pose, configuration: Any = None, modes: str | None = None
) -> AtPose:
    """A machine at a pose of a solution, or at one given as model files give it.

    Raises
    ------
    InputError
        If it is no pose of the machine; the message says what to do.
    """
    if isinstance(pose, Pose):
        if modes is not None:
            raise InputError(
                "modes: belong to an exact pose; the joint values of a solution are those of its configuration"
            )
        chosen = machine.configuration(configuration) if _is_name(configuration) else configuration
        there = machine_at_solution(machine, machine.problem(chosen), pose, chosen)
        _require_own_pose(there)
        return there
    position, rotation = read_pose(
        dict(pose) if isinstance(pose, Mapping) else pose, "pose", machine.motion, machine.metric
    )
    if configuration is not None and _is_name(configuration):
        configuration = machine.configuration(configuration)
    found = held_at(machine, position, rotation, configuration, modes)
    return at_rational_pose(machine, found, position, rotation)


def machine_at_solution(machine: Machine, problem: ForwardProblem, pose: Pose, configuration: Any = None) -> AtPose:
    """A machine at a certified pose of a problem of it."""
    rank = None
    if pose.jacobian is not None:
        rank = pose.jacobian.rank
    elif pose.multiplicity == 1 and problem.equation_count == problem.motion.dimension:
        rank = problem.motion.dimension
    found = held_in_solution(machine, problem, configuration)
    is_multiple = pose.multiplicity is not None and pose.multiplicity > 1
    return at_box(machine, found, pose.position, pose.rotation, rank, is_multiple=is_multiple)


def _require_own_pose(at: AtPose) -> None:
    """Refuse a pose at which a constraint is proved not to hold: lengths, and so J, would be others than its own."""
    with working_precision(BITS):
        position = [hull(x.lo, x.hi) for x in at.position]
        place = BallPose(position, [[hull(x.lo, x.hi) for x in row] for row in at.rotation], at.metric)
        for equation in at.equations:
            if not place.vanishes(equation):
                raise InputError(
                    f"pose: {equation.name} does not hold there, it is a pose of other joint values; name its "
                    "configuration, or give position and rotation"
                )


def _is_name(configuration: Any) -> bool:
    return configuration is None or isinstance(configuration, str)
