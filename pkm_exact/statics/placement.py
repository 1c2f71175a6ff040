"""A machine put at a pose: which values its constraints and joints have there, and the equations that hold it.

At a rational pose lengths, offsets and products follow from the pose. Slides and cranks reach it in several working
modes, as exact square roots: which of them is meant must be said.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, Final

from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import Crank
from pkm_exact.geometry.drive_modes import joint_values
from pkm_exact.geometry.drives import Drive
from pkm_exact.geometry.inverse import Matrix, distance_squared
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.mechanism import LockedValues, Mechanism
from pkm_exact.geometry.paired_drives import partner_of
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.robot import Configuration, Robot
from pkm_exact.geometry.surds import Surd
from pkm_exact.geometry.working_modes import (
    CrankMode,
    FreeCrank,
    Mode,
    PairedMode,
    SlideMode,
    platform_point,
    working_modes,
)
from pkm_exact.radicals import RootSum
from pkm_exact.statics.actuated_equations import Held, Motor, held
from pkm_exact.wording import shown

_FIRST_AND_LAST: Final = {"-": 0, "+": -1}
_IN_WORDS: Final = {2: "two", 3: "three", 4: "four"}
_NUMBERED: Final = {str(number): number - 1 for number in range(1, 5)}


@dataclass(frozen=True)
class _Place:
    """An exact pose in rational coordinates, and in which working mode it is reached."""

    position: Vector
    rotation: Matrix
    configuration: Any
    modes: str | None


def held_at(
    robot: Machine, position: Vector, rotation: Matrix, configuration: Any = None, modes: str | None = None
) -> Held:
    """What holds a machine at a rational pose.

    Parameters
    ----------
    robot : Machine
    position, rotation
        In the rational coordinates of its metric.
    configuration : Configuration or LockedValues, optional
        Whose joint values are meant, of a machine with slides or cranks; they must reach the pose, exactly.
    modes : str, optional
        Or a sign for each slide and crank: "-" for the first of its values in the order of ``legs``, "+" for the
        last, or its number, from 1.

    Raises
    ------
    InputError
        If the machine cannot be there, or it is not said in which working mode.
    """
    place = _Place(position, rotation, configuration, modes)
    if isinstance(robot, Mechanism):
        return _mechanism(robot, place)
    if not isinstance(robot, Robot):
        raise InputError(f"kind: {robot.kind} is not one that this question can be asked about; ask about its legs")
    if robot.chains:
        return _chains(robot, _chain_values(robot, place))
    joints = zip(robot.base_joints, robot.platform_joints, strict=True)
    squares = [distance_squared(a, b, position, rotation, robot.metric) for a, b in joints]
    for number, square in enumerate(squares, 1):
        if square == 0:
            raise InputError(f"pose: leg {number} has length 0 there, so that it has no direction; give another")
    return _legs(robot.problem(squares))


def held_in_solution(robot: Machine, problem: ForwardProblem, configuration: Any) -> Held:
    """What holds a machine whose actuators are locked, at any of the poses that they leave."""
    if isinstance(robot, Robot) and robot.chains:
        if not isinstance(configuration, Configuration):
            raise InputError(f"configuration: a {robot.kind} robot has joint values in one only; name it")
        return _chains(robot, configuration.joint_values)
    if isinstance(robot, Mechanism):
        found = {constraint.name: constraint for constraint in problem.constraints}
        values = robot.values_of(found)
        if values is None:
            raise InputError("configuration: the solution is not one of this mechanism; give the one that was solved")
        return _held_mechanism(robot, found, dict(zip(robot.actuated, values, strict=True)))
    return _legs(problem)


def _legs(problem: ForwardProblem) -> Held:
    named = [(f"leg {number}", constraint) for number, constraint in enumerate(problem.constraints, 1)]
    return held(named, problem.metric, [Motor(name, "length", name) for name, _ in named])


def _chains(robot: Robot, values: Sequence[Any]) -> Held:
    """A robot with slides or cranks at given values, rational or not."""
    named: list[tuple[str, Constraint]] = []
    motors = []
    places = zip(robot.actuated, robot.chains, robot.base_joints, robot.platform_joints, values, strict=True)
    for name, chain, base, joint, value in places:
        knee: Any
        if isinstance(chain, Crank):
            cosine, sine = value
            knee = tuple(a + cosine * u + sine * v for a, u, v in zip(base, chain.at_0, chain.at_90, strict=True))
            step: Any = tuple(cosine * v - sine * u for u, v in zip(chain.at_0, chain.at_90, strict=True))
            unit = "angle"
        else:
            knee = tuple(a + value * d for a, d in zip(base, chain.direction, strict=True))
            step, unit = chain.direction, "length"
        named.append((name, Distance(knee, joint, chain.rod_squared)))
        motors.append(Motor(name, unit, name, {(name, "base"): step}))
    return held(named, robot.metric, motors)


def _chain_values(robot: Robot, place: _Place) -> list[Any]:
    points = [platform_point(joint, place.position, place.rotation) for joint in robot.platform_joints]
    if place.configuration is not None:
        knees = robot.knees(place.configuration)
        for leg, (chain, knee, point) in enumerate(zip(robot.chains, knees, points, strict=True), 1):
            if sum(g * (k - p) ** 2 for g, k, p in zip(robot.metric, knee, point, strict=True)) != chain.rod_squared:
                raise _unreached(f"leg {leg}", place.configuration.name)
        return list(place.configuration.joint_values)
    legs = zip(robot.chains, robot.base_joints, points, strict=True)
    found = [working_modes(chain, base, point, robot.metric) for chain, base, point in legs]
    return _chosen(list(zip(robot.actuated, found, strict=True)), place.modes)


def _mechanism(robot: Mechanism, place: _Place) -> Held:
    values = _values(robot, place)
    constraints = _driven(robot, values)
    if place.configuration is not None:  # values of constraints that drives have moved too
        values |= _own(robot, place, list(constraints.values()))
    for name in values:
        if robot.drive(name) is None:
            constraints[name] = replace(constraints[name], **{robot.value_field(name): values[name]})
    _require_all(robot, constraints, place)
    return _held_mechanism(robot, constraints, values)


def _driven(robot: Mechanism, values: Mapping[str, Any]) -> dict[str, Any]:
    """The constraints where drives of these values have moved them."""
    constraints: dict[str, Any] = {constraint.name: constraint for constraint in robot.constraints}
    for name, value in values.items():
        drive = robot.drive(name)
        if drive is None:
            continue
        factors = value if isinstance(value, tuple) else (value,)
        for part in drive.parts:
            old = getattr(constraints[part.constraint], part.field)
            new = _moved(old, factors, part.axes)
            constraints[part.constraint] = replace(constraints[part.constraint], **{part.field: new})
    return constraints


def _own(robot: Mechanism, place: _Place, moved: Sequence[Constraint] | None = None) -> dict[str, Any]:
    """The values of actuated constraints at the pose."""
    own = robot.values_at(place.position, place.rotation, moved)
    return {name: own[name] for name in robot.actuated if robot.drive(name) is None}


def _held_mechanism(robot: Mechanism, constraints: Mapping[str, Constraint], values: Mapping[str, Any]) -> Held:
    motors = []
    for name in robot.actuated:
        drive = robot.drive(name)
        if drive is None:
            unit = "1" if robot.value_field(name) == "product" else "length"
            motors.append(Motor(name, unit, name))
        else:
            unit = "angle" if drive.is_crank else "length"
            motors.append(Motor(name, unit, drive.parts[0].constraint, _velocities(drive, values[name])))
    return held(list(constraints.items()), robot.metric, motors)


def _velocities(drive: Drive, value: Any) -> dict[tuple[str, str], Any]:
    """Of the fields that a drive moves, for each unit of its value; of a crank, for each radian."""
    if not drive.is_crank:
        return {(part.constraint, part.field): part.axes[0] for part in drive.parts}
    cosine, sine = value  # the sine divided by sqrt(w)
    root = RootSum.root(Fraction(drive.weight))
    factors = -1 * (root * sine), root * cosine / drive.weight
    zero = Fraction(0)
    return {
        (part.constraint, part.field): _moved(
            zero if isinstance(part.axes[0], Fraction) else (zero,) * 3, factors, part.axes
        )
        for part in drive.parts
    }


def _moved(start: Any, factors: Sequence[Any], axes: Sequence[Any]) -> Any:
    if not isinstance(start, tuple):
        return sum((k * x for k, x in zip(factors, axes, strict=True)), start)
    return tuple(
        sum((k * x for k, x in zip(factors, rest, strict=True)), first)
        for first, *rest in zip(start, *axes, strict=True)
    )


def _values(robot: Mechanism, place: _Place) -> dict[str, Any]:
    """The values of all actuators, by their names: as they follow from the pose, those of drives as they are meant."""
    if place.configuration is not None and not isinstance(place.configuration, LockedValues):
        raise InputError("configuration: is not one of a mechanism; give one of its configurations")
    values = _own(robot, place)
    if len(values) == len(robot.actuated):
        return values
    if place.configuration is not None:
        return dict(zip(robot.actuated, place.configuration.values, strict=True)) | values
    if place.modes is None:
        _require_own_values(robot)
    modes = [
        (found.name, found.modes)
        for found in joint_values(robot, place.position, place.rotation)
        if found.name not in values
    ]
    for (name, _), value in zip(modes, _chosen(modes, place.modes), strict=True):
        values |= value if isinstance(value, dict) else {name: value}
    return values


def _require_own_values(robot: Mechanism) -> None:
    """Refuse drives that move a constraint together: the pose does not say where they are."""
    movers: dict[str, list[str]] = {}
    for drive in robot.drives:
        if partner_of(robot, drive) is not None:
            continue  # they have working modes together
        for name in dict.fromkeys(part.constraint for part in drive.parts):
            movers.setdefault(name, []).append(drive.name)
    for name, found in movers.items():
        if len(found) > 1:
            raise InputError(
                f"pose: {' and '.join(found)} move {shown(name)} together, so that a pose does not say where they are; "
                "name a configuration, in which they stand there"
            )


def _require_all(robot: Mechanism, constraints: Mapping[str, Any], place: _Place) -> None:
    """Refuse a pose at which a constraint does not hold."""
    for name, constraint in constraints.items():
        if robot.holds(constraint, place.position, place.rotation):
            continue
        if place.configuration is not None and any(drive.parts for drive in robot.drives):
            raise _unreached(f"the constraint {shown(name)}", place.configuration.name)
        raise InputError(f"pose: the constraint {shown(name)} does not hold there; give a pose at which it does")


def _unreached(what: str, configuration: str) -> InputError:
    return InputError(
        f"pose: {what} does not hold there in the configuration {shown(configuration)}; give its exact pose, or "
        "working modes"
    )


def _chosen(choices: Sequence[tuple[str, tuple[Mode, ...]]], modes: str | None) -> list[Any]:
    """The joint values that are meant."""
    count = len(choices)
    places = _FIRST_AND_LAST | _NUMBERED
    if modes is not None and (len(modes) != count or set(modes) - set(places)):
        raise InputError(f"modes: {shown(modes)} is not a sign + or - for each of {count} slides or cranks; give that")
    values = []
    for place, (name, found) in enumerate(choices):
        if not found:
            raise InputError(f"pose: {name} does not reach it; give another")
        if modes is None and len(found) > 1:
            raise InputError(
                f"modes: {name} reaches the pose at {_IN_WORDS[len(found)]} joint values; give a sign for each slide "
                f"or crank, such as {'+' * count} ({'-' * count} takes the first values that the command legs lists"
                f"{', digits those of a number' if len(found) > 2 else ''})"
            )
        chosen = places[modes[place]] if modes else 0
        if chosen >= len(found):
            raise InputError(f"modes: {name} has {len(found)} joint values at the pose, no {chosen + 1}; name another")
        values.append(_value(name, found[chosen]))
    return values


def _value(name: str, mode: Mode) -> Any:
    """A position, or cosine and sine; of two drives both by their names."""
    if isinstance(mode, PairedMode):
        return {own: _value(own, value) for own, value in mode.values}
    if isinstance(mode, FreeCrank):
        raise InputError(f"pose: {name} may have any value there; give another")
    if isinstance(mode, SlideMode):
        return _sum(mode.position)
    if isinstance(mode, CrankMode):
        return _sum(mode.cos), _sum(mode.sin)
    cosine, sine = mode.cos.radicals, mode.sin.radicals
    if cosine is None or sine is None:
        raise InputError(f"pose: {name} reaches it at an angle that no square roots express; give another pose")
    return cosine, sine


def _sum(value: Surd) -> RootSum | Fraction:
    return value.p + value.q * RootSum.root(Fraction(value.n)) if value.q else value.p
