"""How the platform of a robot or of a mechanism declared by constraints can move, at an exact pose and at all poses."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.form import Vector, value_at
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Matrix, Metric
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.robot import Robot
from pkm_exact.mobility.constraint_rows import twists_left, within, wrench_rows
from pkm_exact.mobility.generic_rank import GenericRank, generic_rank
from pkm_exact.motions.motion import Motion
from pkm_exact.screws.exact_matrix import Row, rank
from pkm_exact.screws.free_motions import FreeMotions, free_motions
from pkm_exact.wording import shown


@dataclass(frozen=True)
class PoseMobility:
    """The platform's freedoms at a pose.

    Attributes
    ----------
    position : tuple of 3 Fraction
    rotation : 3 rows of 3 Fraction
        The pose, in the coordinates of the model.
    structural_rank, rank : int
        Of the wrenches of what is not actuated, and of all with the actuators locked.
    free, locked : FreeMotions
        With the actuators free, and with them locked.
    """

    position: Vector
    rotation: Matrix
    structural_rank: int
    rank: int
    free: FreeMotions
    locked: FreeMotions


@dataclass(frozen=True)
class PlatformMobility:
    """What holds the platform.

    Attributes
    ----------
    structural, actuated : tuple of str
        Names of the constraints that always hold, and of those that actuators lock.
    motion : Motion
        In which joints that are not declared one by one keep the platform.
    metric : tuple of 3 int
    at : PoseMobility or None
        At the pose that was asked about.
    everywhere : GenericRank or None
        At every pose of the motion, all actuators locked; None if a constraint is no linear form.

    Examples
    --------
    >>> from pkm_exact import platform_mobility, read_robot
    >>> found = platform_mobility(read_robot("models/3-rps.toml"))
    >>> found.structural, found.at is None
    (('hinge 1', 'hinge 2', 'hinge 3'), True)
    """

    structural: tuple[str, ...]
    actuated: tuple[str, ...]
    motion: Motion
    metric: Metric
    at: PoseMobility | None
    everywhere: GenericRank | None


def platform_mobility(
    robot: Robot | Mechanism,
    pose: tuple[Vector, Matrix] | None = None,
    actuated: Collection[str] | None = None,
    configuration: str | None = None,
) -> PlatformMobility:
    """How the platform can move with the actuators free and with them locked.

    Parameters
    ----------
    robot : Robot or Mechanism
    pose : tuple, optional
        Position and rotation matrix in the coordinates of the model; without it, only what holds at every pose is said.
    actuated : collection of str, optional
        Of a robot the legs that are locked, while the others hold nothing; of a mechanism the constraints that are
        actuated, while the others always hold. Those of the model by default.
    configuration : str, optional
        Of robots with cranks or slides, which stand as the configuration says.

    Raises
    ------
    InputError
        If a name is not one of the robot's, or the pose does not fulfil what holds always.

    Examples
    --------
    >>> from pkm_exact.geometry.inverse import rotation_of
    >>> from pkm_exact.geometry.reader import read_robot
    >>> level = rotation_of((Fraction(1), Fraction(0), Fraction(0), Fraction(0)))
    >>> robot = read_robot("models/ssm-exact.toml")
    >>> found = platform_mobility(robot, ((Fraction(0), Fraction(0), Fraction(500)), level))
    >>> found.at.rank, str(found.everywhere.route)
    (6, 'full at a pose')
    """
    constraints, names = _constraints(robot, configuration)
    chosen = _chosen(robot, names, actuated)
    by_name = dict(zip(names, constraints, strict=True))
    always = {name: c for name, c in by_name.items() if isinstance(robot, Mechanism) and name not in chosen}
    locked = {name: c for name, c in by_name.items() if name in chosen}
    every = (*always.values(), *locked.values())
    everywhere = None
    if every and not any(c.squares(robot.metric) for c in every):
        forms = [form for c in every for form in c.forms(robot.metric)]
        everywhere = generic_rank(forms, robot.motion, robot.metric)
    at = None if pose is None else _at(robot, always, locked, pose)
    return PlatformMobility(tuple(always), tuple(locked), robot.motion, robot.metric, at, everywhere)


def _constraints(robot: Robot | Mechanism, configuration: str | None) -> tuple[tuple[Constraint, ...], tuple[str, ...]]:
    if isinstance(robot, Mechanism):
        return robot.constraints, tuple(constraint.name for constraint in robot.constraints)
    if configuration is not None or robot.configurations:
        found = robot.problem(robot.configuration(configuration))
    elif robot.chains:
        raise InputError("configuration: the model has none, so that its cranks or slides stand nowhere; add one")
    else:
        found = robot.problem_at([Fraction(1)] * len(robot.actuated))
    return found.constraints, robot.actuated


def _chosen(robot: Robot | Mechanism, names: Collection[str], actuated: Collection[str] | None) -> list[str]:
    wanted = robot.actuated if actuated is None else actuated
    for name in wanted:
        if name not in names:
            raise InputError(f"actuated: {shown(name)} is not one of the model's; use some of: {', '.join(names)}")
    return [name for name in names if name in wanted]


def _at(
    robot: Robot | Mechanism,
    always: Mapping[str, Constraint],
    locked: Mapping[str, Constraint],
    pose: tuple[Vector, Matrix],
) -> PoseMobility:
    position, rotation = pose
    metric, motion = robot.metric, robot.motion
    _require_pose(robot, always, locked, pose)
    fixed = [row for c in always.values() for row in wrench_rows(c, metric, position, rotation)]
    every = fixed + [row for c in locked.values() for row in wrench_rows(c, metric, position, rotation)]
    width = len(motion.twist)

    def left(rows: list[Row]) -> FreeMotions:
        return free_motions(twists_left(rows, motion, metric, position), metric=metric)

    first, second = rank(within(fixed, motion), width), rank(within(every, motion), width)
    return PoseMobility(position, rotation, first, second, left(fixed), left(every))


def _require_pose(
    robot: Robot | Mechanism,
    always: Mapping[str, Constraint],
    locked: Mapping[str, Constraint],
    pose: tuple[Vector, Matrix],
) -> None:
    """Refuse a pose that does not fulfil what always holds: joints of a mechanism, rods of a length that is fixed."""
    if isinstance(robot, Mechanism):
        for name, constraint in always.items():
            if not robot.holds(constraint, *pose):
                raise InputError(f"--at: {shown(name)} does not hold at this pose; give a pose of the mechanism")
    elif robot.chains:
        for name, constraint in locked.items():
            if any(value_at(form, *pose, robot.metric) for form in constraint.forms(robot.metric)):
                raise InputError(
                    f"--at: {shown(name)} has not its length at this pose with the cranks or slides of the "
                    "configuration; give a pose of that configuration exactly, or another configuration"
                )
