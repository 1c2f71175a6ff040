"""How the platform of a robot or of a mechanism declared by constraints can move, at an exact pose and at all poses."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
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
    constraints : tuple of Constraint
        All of these in the order of the model; an actuated one has some value.
    locks : tuple of int
        Places of those that actuators lock.
    motion : Motion
        In which joints that are not declared one by one keep the platform.
    metric : tuple of 3 int
    at : PoseMobility or None
        At the pose that was asked about.
    everywhere : GenericRank or None
        At every pose of the motion, all actuators locked; None if a constraint is no linear form.
    sharing : tuple of str
        Slides and cranks that move several constraints, all actuated: without them, these hold what they share, which
        the freedoms with the actuators free leave out.

    Examples
    --------
    >>> from pkm_exact import platform_mobility, read_robot
    >>> found = platform_mobility(read_robot("models/3-rps.toml"))
    >>> found.structural, found.at is None
    (('hinge 1', 'hinge 2', 'hinge 3'), True)
    """

    structural: tuple[str, ...]
    actuated: tuple[str, ...]
    constraints: tuple[Constraint, ...]
    locks: tuple[int, ...]
    motion: Motion
    metric: Metric
    at: PoseMobility | None
    everywhere: GenericRank | None
    sharing: tuple[str, ...] = ()


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
        actuated, while the others always hold; a slide or crank of it stands for the constraints that it moves. Those
        of the model by default.
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
    if not isinstance(robot, Mechanism):
        kept = [k for k, name in enumerate(names) if name in chosen]
        constraints, names = tuple(constraints[k] for k in kept), tuple(names[k] for k in kept)
    if pose is not None:
        _require_pose(robot, dict(zip(names, constraints, strict=True)), chosen, pose)
    locks = tuple(k for k, name in enumerate(names) if name in chosen)
    found = mobility_of_constraints(constraints, names, locks, robot.motion, robot.metric, pose)
    sharing = (name for name, moved in _moved(robot).items() if len(moved) > 1 and moved & set(chosen))
    return replace(found, sharing=tuple(sharing))


def mobility_of_constraints(
    constraints: Sequence[Constraint],
    names: Sequence[str],
    locks: Sequence[int],
    motion: Motion,
    metric: Metric,
    pose: tuple[Vector, Matrix] | None = None,
) -> PlatformMobility:
    """The same of constraints, of which actuators lock those at some places, at a pose where the others hold."""
    everywhere = None
    if constraints and not any(c.squares(metric) for c in constraints):
        forms = [form for c in constraints for form in c.forms(metric)]
        everywhere = generic_rank(forms, motion, metric)
    always = [c for k, c in enumerate(constraints) if k not in locks]
    at = None if pose is None else _at(always, constraints, motion, metric, pose)
    structural = tuple(name for k, name in enumerate(names) if k not in locks)
    actuated = tuple(names[k] for k in locks)
    return PlatformMobility(structural, actuated, tuple(constraints), tuple(locks), motion, metric, at, everywhere)


def _constraints(robot: Robot | Mechanism, configuration: str | None) -> tuple[tuple[Constraint, ...], tuple[str, ...]]:
    if isinstance(robot, Mechanism):
        locked = robot.constraints
        if robot.drives:
            locked = robot.locked(robot.configuration(configuration).values, "configuration")
        return locked, tuple(constraint.name for constraint in locked)
    if configuration is not None or robot.configurations:
        found = robot.problem(robot.configuration(configuration))
    elif robot.chains:
        raise InputError("configuration: the model has none, so that its cranks or slides stand nowhere; add one")
    else:
        found = robot.problem_at([Fraction(1)] * len(robot.actuated))
    return found.constraints, robot.actuated


def _chosen(robot: Robot | Mechanism, names: Collection[str], actuated: Collection[str] | None) -> list[str]:
    moved = _moved(robot)
    known = [*(name for name in moved if name not in names), *names]
    chosen: set[str] = set()
    for name in robot.actuated if actuated is None else actuated:
        if name not in known:
            raise InputError(f"actuated: {shown(name)} is not one of the model's; use some of: {', '.join(known)}")
        chosen |= moved.get(name, {name})
    return [name for name in names if name in chosen]


def _moved(robot: Robot | Mechanism) -> dict[str, set[str]]:
    """The constraints that each slide or crank of a mechanism moves."""
    if not isinstance(robot, Mechanism):
        return {}
    return {drive.name: {part.constraint for part in drive.parts if _is_not_0(part.axes)} for drive in robot.drives}


def _is_not_0(axes: Sequence[Vector | Fraction]) -> bool:
    return any(any(axis) if isinstance(axis, tuple) else axis for axis in axes)


def _at(
    always: Sequence[Constraint],
    constraints: Sequence[Constraint],
    motion: Motion,
    metric: Metric,
    pose: tuple[Vector, Matrix],
) -> PoseMobility:
    position, rotation = pose
    fixed = [row for c in always for row in wrench_rows(c, metric, position, rotation)]
    every = [row for c in constraints for row in wrench_rows(c, metric, position, rotation)]
    width = len(motion.twist)

    def left(rows: list[Row]) -> FreeMotions:
        return free_motions(twists_left(rows, motion, metric, position), metric=metric)

    first, second = rank(within(fixed, motion), width), rank(within(every, motion), width)
    return PoseMobility(position, rotation, first, second, left(fixed), left(every))


def _require_pose(
    robot: Robot | Mechanism,
    constraints: Mapping[str, Constraint],
    chosen: Collection[str],
    pose: tuple[Vector, Matrix],
) -> None:
    """Refuse a pose that does not fulfil what always holds: joints of a mechanism, rods of a length that is fixed."""
    driven = {name for names in _moved(robot).values() for name in names} - set(robot.actuated)
    for name, constraint in constraints.items():
        if isinstance(robot, Mechanism):
            if (name not in chosen or name in driven) and not robot.holds(constraint, *pose):
                where = " with the actuators of the configuration" if name in driven else ""
                raise InputError(f"--at: {shown(name)} does not hold at this pose{where}; give a pose of the mechanism")
        elif robot.chains and any(value_at(form, *pose, robot.metric) for form in constraint.forms(robot.metric)):
            raise InputError(
                f"--at: {shown(name)} has not its length at this pose with the cranks or slides of the "
                "configuration; give a pose of that configuration exactly, or another configuration"
            )
