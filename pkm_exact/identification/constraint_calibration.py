"""Calibration of any machine: which errors of its geometric parameters measured poses show.

At a measured pose with known joint values every constraint is an equation E(parameters) = 0, and its derivatives by the
coordinates of points and directions, by fixed lengths, offsets and products, by the axes of drives and by the zeros of
actuators are a row of the observation matrix. Every E is of degree 2 at most in each of these numbers, so that
(E(p + 1) - E(p - 1)) / 2 is its derivative, exactly. Coordinates are those of the model file.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, Final, TypeAlias

from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint import Constraint, Role
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector, value_at
from pkm_exact.constraints.on_line import OnLine
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import Crank, JointValue
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Matrix, Metric, dot
from pkm_exact.geometry.mechanism import Mechanism, is_square
from pkm_exact.geometry.robot import Robot
from pkm_exact.geometry.working_modes import platform_point
from pkm_exact.radicals import Number, RootSum
from pkm_exact.screws.exact_matrix import Row
from pkm_exact.wording import shown

Pose: TypeAlias = tuple[Vector, Matrix]
_AXES: Final = "xyz"


@dataclass(frozen=True)
class _Parts:
    """Constraints and drives by their names, and the values of the actuators."""

    constraints: Mapping[str, Constraint]
    drives: Mapping[str, Drive]
    values: Mapping[str, JointValue]


_Change: TypeAlias = Callable[[_Parts, Fraction], _Parts]


@dataclass(frozen=True)
class _Parameter:
    """A number of the geometry: its name, the constraints that it enters, and the machine with more of it."""

    name: str
    enters: tuple[str, ...]
    more: _Change
    factor: Number = Fraction(1)


def as_mechanism(robot: Robot | Mechanism) -> Mechanism:
    """A robot with legs, cranks or slides as a mechanism of distances and drives; a mechanism itself.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_robot
    >>> found = as_mechanism(read_robot("models/3-rrr.toml"))
    >>> [drive.name for drive in found.drives], [constraint.name for constraint in found.constraints]
    (['crank 1', 'crank 2', 'crank 3'], ['leg 1', 'leg 2', 'leg 3'])
    """
    if isinstance(robot, Mechanism):
        return robot
    chains = robot.chains or (None,) * len(robot.base_joints)
    legs, drives = [], []
    for k, (a, b, chain) in enumerate(zip(robot.base_joints, robot.platform_joints, chains, strict=True), 1):
        legs.append(Distance(a, b, Fraction(1) if chain is None else chain.rod_squared, f"leg {k}"))
        if isinstance(chain, Crank):
            drives.append(Drive(f"crank {k}", (Part(f"leg {k}", "base", (chain.at_0, chain.at_90)),), weight=1))
        elif chain is not None:
            drives.append(Drive(f"slide {k}", (Part(f"leg {k}", "base", (chain.direction,)),)))
    actuated = tuple(drive.name for drive in drives) or tuple(leg.name for leg in legs)
    who = robot.name, robot.unit, robot.source
    return Mechanism(*who, tuple(legs), actuated, robot.motion, robot.metric, drives=tuple(drives))


def geometric_parameters(machine: Robot | Mechanism, *, zeros: bool) -> tuple[str, ...]:
    """Names of all parameters: fields of the constraints, axes of the drives, then zeros of the actuators.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_robot
    >>> geometric_parameters(read_robot("models/3-rpr-merlet-p.toml"), zeros=True)[:5]
    ('leg 1 base x', 'leg 1 base y', 'leg 1 platform x', 'leg 1 platform y', 'leg 2 base x')
    """
    mechanism = as_mechanism(machine)
    return tuple(parameter.name for parameter in _parameters(mechanism, None, zeros=zeros))


def geometric_rows(
    machine: Robot | Mechanism, pose: Pose, values: Mapping[str, JointValue] | None = None, *, zeros: bool
) -> tuple[Row, ...]:
    """The derivatives of all constraints at a pose by the parameters, a row for each equation, where all are rational.

    Parameters
    ----------
    machine : Robot or Mechanism
    pose : tuple
        Position and rotation matrix, in the coordinates of the file.
    values : mapping, optional
        Positions of slides, cosine and sine of cranks, by the names of the drives; other actuators have what the pose
        gives them.
    zeros : bool
        Whether the readings of actuators have offsets; lengths must be rational at the pose then.

    Raises
    ------
    InputError
        If a constraint does not hold at the pose, or a drive has no value.

    Examples
    --------
    >>> from pkm_exact.geometry.inverse import rotation_of
    >>> from pkm_exact.geometry.reader import read_robot
    >>> one, zero = Fraction(1), Fraction(0)
    >>> pose = (Fraction(5), Fraction(9, 2), zero), rotation_of((one, zero, zero, zero))
    >>> rows = geometric_rows(read_robot("models/3-rpr-merlet-p.toml"), pose, zeros=False)
    >>> [str(x) for x in rows[0][:4]]
    ['-10', '-9', '10', '9']
    """
    rows = geometric_root_rows(machine, pose, values, zeros=zeros)
    names = geometric_parameters(machine, zeros=zeros)
    for row in rows:
        for name, value in zip(names, row, strict=True):
            if not RootSum.of(value).is_rational:
                root = RootSum.of(value) * Fraction(1, 2)
                raise InputError(
                    f"{shown(name.removesuffix(' zero'))}: has the length {abs(root)} at the pose, not rational; take "
                    "another"
                )
    return tuple(tuple(RootSum.of(value).rational or Fraction(0) for value in row) for row in rows)


def geometric_root_rows(
    machine: Robot | Mechanism, pose: Pose, values: Mapping[str, JointValue] | None = None, *, zeros: bool
) -> tuple[tuple[Number, ...], ...]:
    """The same rows with square roots, for actuators whose lengths are irrational at the pose.

    Examples
    --------
    >>> from pkm_exact.geometry.inverse import rotation_of
    >>> from pkm_exact.geometry.reader import read_robot
    >>> one, zero = Fraction(1), Fraction(0)
    >>> pose = (Fraction(1), Fraction(1), zero), rotation_of((one, zero, zero, zero))
    >>> rows = geometric_root_rows(read_robot("models/3-rpr-merlet-p.toml"), pose, zeros=True)
    >>> print(rows[0][12])
    -2*sqrt(2)
    """
    mechanism = as_mechanism(machine)
    parts = _locked(mechanism, pose, values or {})
    parameters = list(_parameters(mechanism, parts, zeros=zeros))
    rows: list[tuple[Number, ...]] = []
    for name in parts.constraints:
        columns = [
            _derivative(mechanism.metric, parts, name, parameter, pose) if name in parameter.enters else None
            for parameter in parameters
        ]
        count = len(_residuals(parts.constraints[name], pose, mechanism.metric))
        rows += [tuple(Fraction(0) if c is None else c[i] for c in columns) for i in range(count)]
    return tuple(rows)


def _locked(mechanism: Mechanism, pose: Pose, values: Mapping[str, JointValue]) -> _Parts:
    """The machine at a pose: lengths and offsets that are actuated have what they need there."""
    own = mechanism.values_at(*pose)
    constraints = {constraint.name: constraint for constraint in mechanism.constraints}
    drives = {drive.name: drive for drive in mechanism.drives}
    for name in values:
        if name not in drives:
            raise InputError(f"{shown(name)}: is no slide or crank; those are: {', '.join(drives) or 'none'}")
    for name in mechanism.actuated:
        if name in drives:
            if name not in values:
                raise InputError(f"{shown(name)}: has no value; give it beside the pose")
            continue
        changed: Any = constraints[name]
        constraints[name] = replace(changed, **{mechanism.value_field(name): own[name]})
    parts = _Parts(constraints, drives, values)
    for name, constraint in _moved(parts).items():
        if any(_residuals(constraint, pose, mechanism.metric)):
            raise InputError(f"{shown(name)}: does not hold at the pose; give poses that all joints admit, exactly")
    return parts


def _moved(parts: _Parts) -> Mapping[str, Constraint]:
    found = dict(parts.constraints)
    for name, drive in parts.drives.items():
        if name in parts.values:
            found = drive.moved(found, parts.values[name], name)
    return found


def _parameters(mechanism: Mechanism, parts: _Parts | None, *, zeros: bool) -> Iterator[_Parameter]:
    """All of them; without ``parts`` for their names alone."""
    size = 2 if mechanism.motion.is_planar else 3
    for constraint in mechanism.constraints:
        for field, role in constraint.fields.items():
            if field != constraint.value_field or constraint.name not in mechanism.actuated:
                yield from _of_field(constraint.name, field, role, size)
    for drive in mechanism.drives:
        yield from _of_axes(drive, size)
    if zeros:
        for name in mechanism.actuated:
            yield _zero(mechanism, name, parts)


def _of_field(name: str, field: str, role: Role, size: int) -> Iterator[_Parameter]:
    entries: Sequence[tuple[str, int | None]] = [("", None)]
    if role == Role.COEFFICIENTS:
        entries = [(f" {k + 1}", k) for k in range(17)]
    elif role not in (Role.NUMBER, Role.POSITIVE):
        entries = [(f" {_AXES[k]}", k) for k in range(size)]
    for suffix, place in entries:
        yield _Parameter(f"{name} {field}{suffix}", (name,), _field_change(name, field, place))


def _field_change(name: str, field: str, place: int | None) -> _Change:
    def more(parts: _Parts, step: Fraction) -> _Parts:
        changed: Any = parts.constraints[name]
        value = _stepped(getattr(changed, field), place, step)
        return replace(parts, constraints={**parts.constraints, name: replace(changed, **{field: value})})

    return more


def _of_axes(drive: Drive, size: int) -> Iterator[_Parameter]:
    """Those of a drive; parts that it moves alike have one axis."""
    words = ("at_0", "at_90") if drive.is_crank else ("axis",)
    different = list(dict.fromkeys(part.axes for part in drive.parts))
    for number, axes in enumerate(different, 1):
        enters = tuple(part.constraint for part in drive.parts if part.axes == axes)
        of_part = "" if len(different) == 1 else f" of part {number}"
        for k, axis in enumerate(axes):
            places: Sequence[int | None] = range(size) if isinstance(axis, tuple) else (None,)
            for place in places:
                suffix = "" if place is None else f" {_AXES[place]}"
                yield _Parameter(
                    f"{drive.name} {words[k]}{of_part}{suffix}", enters, _axis_change(drive.name, axes, k, place)
                )


def _axis_change(name: str, axes: tuple[Any, ...], k: int, place: int | None) -> _Change:
    def more(parts: _Parts, step: Fraction) -> _Parts:
        drive = parts.drives[name]
        changed = (*axes[:k], _stepped(axes[k], place, step), *axes[k + 1 :])
        moved = tuple(replace(part, axes=changed) if part.axes == axes else part for part in drive.parts)
        return replace(parts, drives={**parts.drives, name: replace(drive, parts=moved)})

    return more


def _zero(mechanism: Mechanism, name: str, parts: _Parts | None) -> _Parameter:
    """What is added to the reading of an actuator; the angle of a crank up to a constant factor."""
    drive = mechanism.drive(name)
    if drive is not None:
        enters = tuple(dict.fromkeys(part.constraint for part in drive.parts))

        def turned(parts: _Parts, step: Fraction) -> _Parts:
            value = parts.values[name]
            if isinstance(value, tuple):
                c, s = value
                new: JointValue = (c - step * drive.weight * s, s + step * c)
            else:
                new = value + step
            return replace(parts, values={**parts.values, name: new})

        return _Parameter(f"{name} zero", enters, turned)
    field = mechanism.value_field(name)
    factor: Number = Fraction(1)
    if parts is not None and is_square(field):
        square = getattr(parts.constraints[name], field)
        factor = RootSum.root(square) * 2
    return _Parameter(f"{name} zero", (name,), _field_change(name, field, None), factor)


def _derivative(metric: Metric, parts: _Parts, name: str, parameter: _Parameter, pose: Pose) -> list[Number]:
    ends = [
        _residuals(_moved(parameter.more(parts, Fraction(step)))[name], pose, metric, parts.constraints[name])
        for step in (1, -1)
    ]
    return [parameter.factor * (after - before) / 2 for after, before in zip(*ends, strict=True)]


def _residuals(constraint: Constraint, pose: Pose, metric: Metric, like: Constraint | None = None) -> list[Fraction]:
    """What vanishes at the poses that a constraint admits, as polynomials in its fields.

    Of a line both planes along the axis on which the direction of ``like`` is largest, so that a step does not change
    the choice.
    """
    if isinstance(constraint, OnLine):
        chosen = like if isinstance(like, OnLine) else constraint
        arm, v = _arm(constraint.point, constraint.platform, pose), constraint.direction
        k = max(range(3), key=lambda axis: (metric[axis] * chosen.direction[axis] ** 2, -axis))
        return [v[k] * arm[i] - v[i] * arm[k] for i in ((k + 1) % 3, (k + 2) % 3)]
    if isinstance(constraint, AxisDistance):
        arm, v = _arm(constraint.point, constraint.platform, pose), constraint.direction
        across = dot(arm, arm, metric) - constraint.radius_squared
        return [across * dot(v, v, metric) - dot(v, arm, metric) ** 2]
    return [Fraction(value_at(form, *pose, metric)) for form in constraint.forms(metric)]


def _arm(point: Vector, joint: Vector, pose: Pose) -> Vector:
    x, y, z = (p - a for p, a in zip(platform_point(joint, *pose), point, strict=True))
    return x, y, z


def _stepped(value: Any, place: int | None, step: Fraction) -> Any:
    if place is None:
        return value + step
    return tuple(entry + step if k == place else entry for k, entry in enumerate(value))
