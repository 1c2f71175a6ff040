"""A mechanism with one platform, declared by its constraints: any joints, legs and sensors, no code.

Some constraints are structural: hinges, lines, fixed lengths. Others are actuated: their values, a length, an offset or
a product, are left to the configurations. With locked actuators all of them together are a forward kinematics problem.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.constraints.constraint import Constraint, Role
from pkm_exact.constraints.form import Form, Vector, value_at
from pkm_exact.errors import InputError
from pkm_exact.geometry.angle_degrees import StandIn
from pkm_exact.geometry.chains import JointValue
from pkm_exact.geometry.drives import Drive
from pkm_exact.geometry.inverse import UNIT_METRIC, Matrix, Metric
from pkm_exact.geometry.kind_names import CONSTRAINTS_KIND
from pkm_exact.geometry.limits import Limits
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rational import MAX_COMPUTED_DIGITS, bounded, parse_rational
from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import SPATIAL
from pkm_exact.radicals import RootSum
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from pkm_exact.geometry.nominal_pose import NominalPose

MOST_CONSTRAINTS: Final = 64
"""Bounds what a model file asks of the solver and a certificate of its checkers."""
FREE: Final = "home"
"""The name of the only configuration of a mechanism without actuators."""


@dataclass(frozen=True)
class LockedValues:
    """Values of the actuated constraints under a name.

    Attributes
    ----------
    name : str
        Unique among the configurations of a mechanism.
    values : tuple
        In the order of the actuators: squared lengths, offsets, products, positions; cosine and sine of a crank.
    stand_ins : tuple of StandIn or str
        Angles among them that were given in degrees and are taken as others, by how much; or sentences.
    """

    name: str
    values: tuple[JointValue, ...]
    stand_ins: tuple[StandIn | str, ...] = ()


@dataclass(frozen=True)
class Mechanism(Machine):
    """A mechanism with one platform.

    Attributes
    ----------
    name, unit, source : str
        Its name, the unit of length, and where the numbers come from.
    constraints : tuple of Constraint
        All of them. The values of the actuated ones are those of no configuration in particular.
    actuated : tuple of str
        Names of the actuators: of constraints whose own values are given, or of drives.
    motion : Motion
        In which the platform is kept by joints that are not declared one by one.
    metric : tuple of 3 int
        Gram diagonal: all coordinates are rational ones, all products those of the metric.
    configurations : tuple of LockedValues
        The first one is the default.
    limits : Limits or None
        Of actuators, legs and position, if there are any.
    nominal : NominalPose or None
        The pose in which it is meant to be.
    kind : str
        "constraints", or the name of the recipe that it was made by (``machines.machine_kinds``).
    drives : tuple of Drive
        Actuators that move parts of constraints: slides, cranks.
    stand_ins : tuple of StandIn
        Angles of the geometry that were given in degrees and are taken as others, by how much.
    cables : bool
        Whether its legs are cables, which only pull.
    bars : tuple of Vector
        For each leg, if there are any: a bar that does not turn, from the platform's joint to the leg's real end.
    feet : tuple of (str, Vector)
        Of planes that stand for a strut, upright on a rail or a crank: the plane's name, and where that begins.

    Examples
    --------
    >>> from pkm_exact.constraints.distance import Distance
    >>> from pkm_exact.motions.motion_groups import TRANSLATION
    >>> rods = [((1, 0, 0), "97/20"), (("-1/2", "4/5", "1/10"), "577/100"), (("-3/5", "-4/5", "-1/5"), "409/100")]
    >>> zero = (Fraction(0),) * 3
    >>> spheres = tuple(
    ...     Distance(tuple(map(Fraction, centre)), zero, Fraction(square), f"rod {k}")
    ...     for k, (centre, square) in enumerate(rods, 1)
    ... )
    >>> delta = Mechanism("Delta", "1", "an example", spheres, motion=TRANSLATION)
    >>> len(delta.problem(delta.configuration()).constraints)
    3
    """

    name: str
    unit: str
    source: str
    constraints: tuple[Constraint, ...]
    actuated: tuple[str, ...] = ()
    motion: Motion = SPATIAL
    metric: Metric = UNIT_METRIC
    configurations: tuple[LockedValues, ...] = ()
    kind: str = CONSTRAINTS_KIND
    limits: Limits | None = None
    nominal: NominalPose | None = None
    drives: tuple[Drive, ...] = ()
    stand_ins: tuple[StandIn, ...] = ()
    cables: bool = False
    bars: tuple[Vector, ...] = ()
    feet: tuple[tuple[str, Vector], ...] = ()

    def __post_init__(self) -> None:
        if not 1 <= len(self.constraints) <= MOST_CONSTRAINTS:
            raise InputError(f"constraints: {len(self.constraints)} given; give 1 to {MOST_CONSTRAINTS}")
        _refuse_equal("constraints", [constraint.name for constraint in self.constraints])
        _refuse_equal("configurations", [configuration.name for configuration in self.configurations])
        moved = {(part.constraint, part.field) for drive in self.drives for part in drive.parts}
        for number, constraint in enumerate(self.constraints, 1):
            own = [field for field in constraint.fields if (constraint.name, field) not in moved]
            _require_directions(constraint, own, f"constraints[{number}] ({shown(constraint.name)})")
        for name in self.actuated:
            if self.drive(name) is None:
                self.value_field(name)
        for configuration in self.configurations:
            self.locked(configuration.values, f"configuration {shown(configuration.name)}")
        if not self.configurations and not self.actuated:
            object.__setattr__(self, "configurations", (LockedValues(FREE, ()),))

    def __repr__(self) -> str:
        return f"Mechanism({self.name!r}, {len(self.constraints)} constraints)"

    def drive(self, name: str) -> Drive | None:
        """The drive of a name; None if that is a constraint whose own value is given."""
        return next((drive for drive in self.drives if drive.name == name), None)

    def problem(self, locked: LockedValues | Sequence[JointValue | int | str]) -> ForwardProblem:
        """The forward kinematics problem of a configuration, or of the values of the actuated constraints.

        Parameters
        ----------
        locked : LockedValues or sequence
            Values as in ``LockedValues``: lengths squared.

        Raises
        ------
        InputError
            If there are not as many values as actuated constraints, or one is not possible.
        """
        values = locked.values if isinstance(locked, LockedValues) else tuple(locked)
        return ForwardProblem(self.locked(values, "values"), self.metric, self.motion)

    def problem_at(self, values: Sequence[Fraction], *, squared: bool = False) -> ForwardProblem:
        """The problem for one number per actuator: lengths, or squared ones, offsets, positions, half tangents."""
        if len(values) != len(self.actuated):
            return self.problem(values)
        found: list[JointValue] = []
        for name, is_length, value in zip(self.actuated, self.are_lengths, values, strict=True):
            drive = self.drive(name)
            if is_length and not squared and value <= 0:
                raise InputError(f"values, {shown(name)}: {shown(value)} is not positive; give a length greater than 0")
            if drive is not None:
                found.append(drive.from_number(value))
            else:
                found.append(value * value if is_length and not squared else value)
        return self.problem(found)

    @property
    def are_lengths(self) -> tuple[bool, ...]:
        """For each actuator whether users give a length, which is positive."""
        return tuple(self.drive(name) is None and is_square(self.value_field(name)) for name in self.actuated)

    def locked(self, values: Sequence[JointValue | int | str], where: str) -> tuple[Constraint, ...]:
        """All constraints, with the given values of the actuators."""
        if len(values) != len(self.actuated):
            wanted = ", ".join(self.actuated) or "none"
            raise InputError(f"{where}: {len(values)} values; give {len(self.actuated)}, for {wanted}")
        found = {constraint.name: constraint for constraint in self.constraints}
        for name, value in zip(self.actuated, values, strict=True):
            drive, place = self.drive(name), f"{where}, {shown(name)}"
            if drive is not None:
                found = drive.moved(found, drive.parsed(value, place), place)
            elif isinstance(value, tuple):
                raise InputError(f"{place}: {shown(value)} is no number; give one")
            else:
                found[name] = self._with_value(found[name], value, place)
        for constraint in found.values() if self.drives else ():
            _require_directions(constraint, constraint.fields, f"{where}, constraint {shown(constraint.name)}")
        return tuple(found.values())

    def values_of(self, found: Mapping[str, Constraint]) -> tuple[JointValue, ...] | None:
        """The values of the actuators that make the constraints others of the same names; None if there are none.

        Where two drives move one point, only those of the configurations are known.
        """
        for configuration in self.configurations:
            if {entry.name: entry for entry in self.locked(configuration.values, "values")} == dict(found):
                return configuration.values
        own = {constraint.name: constraint for constraint in self.constraints}
        values: list[JointValue] = []
        for name in self.actuated:
            drive = self.drive(name)
            place = name if drive is None else drive.parts[0].constraint
            if place not in found or type(found[place]) is not type(own[place]):
                return None
            value = (
                getattr(found[place], self.value_field(name))
                if drive is None
                else drive.recovered(own[place], found[place])
            )
            if value is None:
                return None
            values.append(value)
        return tuple(values)

    def asks(self, problem: ForwardProblem) -> bool:
        """Whether a problem is one of this mechanism, with whatever values of its actuators."""
        values = self.values_of({constraint.name: constraint for constraint in problem.constraints})
        return values is not None and self.problem(values) == problem

    def sort_of(self, name: str) -> str:
        """Under which limits an actuator falls: lengths, slides, angles, or none of them."""
        drive = self.drive(name)
        if drive is not None:
            return "slides" if not drive.is_crank else "angles" if drive.weight == 1 else ""
        field = self.value_field(name)
        return "lengths" if is_square(field) else "slides" if field == "offset" else ""

    def values_at(
        self, position: Vector, rotation: Matrix, moved: Sequence[Constraint] | None = None
    ) -> dict[str, Fraction]:
        """By how much each linear form of the constraints differs from 0 at a pose, added to the constraint's value.

        Of the constraints as the model has them, or where drives have moved them.

        The values that the constraints have at the pose: squared lengths, offsets, products. Constraints without a
        value are left out, and so are quadrics.
        """
        values = {}
        for constraint in self.constraints if moved is None else moved:
            if any(not any(getattr(constraint, field)) for field in _directions(constraint)):
                continue  # a drive gives it
            forms = constraint.forms(self.metric)
            if constraint.value_field is not None and len(forms) == 1:
                rest = value_at(forms[0], position, rotation, self.metric)
                values[constraint.name] = getattr(constraint, constraint.value_field) + rest
            for square in constraint.squares(self.metric):
                linear, root = (self._at(form, position, rotation) for form in (square.linear, square.root))
                rest = linear - square.factor * root * root
                values[constraint.name] = getattr(constraint, constraint.value_field or "") + rest
        return values

    def equation_at(self, constraint: Constraint, position: Vector, rotation: Matrix) -> Fraction:
        """By how much a constraint that is one equation differs from 0 at a pose."""
        forms, squares = constraint.forms(self.metric), constraint.squares(self.metric)
        if len(forms) + len(squares) != 1:
            raise InputError(f"constraint {shown(constraint.name)}: is more than one equation; ask about another")
        if forms:
            return self._at(forms[0], position, rotation)
        linear, root = (self._at(form, position, rotation) for form in (squares[0].linear, squares[0].root))
        return linear - squares[0].factor * root * root

    def holds(self, constraint: Constraint, position: Vector, rotation: Matrix) -> bool:
        """Whether a constraint holds at a pose, exactly. Its numbers may be sums of square roots."""

        def at(form: Form) -> RootSum:
            return RootSum.of(value_at(form, position, rotation, self.metric))

        values = [at(form) for form in constraint.forms(self.metric)]
        for found in constraint.squares(self.metric):
            root = at(found.root)
            values.append(at(found.linear) - root * root * found.factor)
        return all(value.sign() == 0 for value in values)

    def _at(self, form: Form, position: Vector, rotation: Matrix) -> Fraction:
        return Fraction(value_at(form, position, rotation, self.metric))

    def value_field(self, name: str) -> str:
        """The field of a constraint that an actuator sets."""
        for constraint in self.constraints:
            if constraint.name == name:
                if constraint.value_field is None:
                    raise InputError(
                        f"constraint {shown(name)}: the type {constraint.type} has no value that an actuator could "
                        "set; remove actuated"
                    )
                return constraint.value_field
        raise InputError(f"actuated: {shown(name)} is not the name of a constraint; use one that is")

    def _with_value(self, constraint: Constraint, value: Fraction | int | str, where: str) -> Constraint:
        field = self.value_field(constraint.name)
        number = parse_rational(value, where) if isinstance(value, str) else Fraction(value)
        bounded(number, number, where, MAX_COMPUTED_DIGITS)
        if constraint.fields[field] == Role.POSITIVE and number <= 0:
            raise InputError(f"{where}: {shown(number)} is not positive; give a number greater than 0")
        changed: Any = constraint
        found: Constraint = replace(changed, **{field: number})
        return found


def is_square(field: str) -> bool:
    """Whether the value in a field is the square of what users call the value."""
    return field.endswith("_squared")


def _refuse_equal(where: str, names: Sequence[str]) -> None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            raise InputError(f"{where}: the name {shown(name)} is used twice; rename one of them")
        seen.add(name)


def _directions(constraint: Constraint) -> list[str]:
    """The fields that are directions."""
    directions = Role.BASE_DIRECTION, Role.PLATFORM_DIRECTION
    return [field for field, role in constraint.fields.items() if role in directions]


def _require_directions(constraint: Constraint, among: Iterable[str], where: str) -> None:
    """Refuse a direction that is 0, in some of the fields."""
    for field in among:
        if field in _directions(constraint) and not any(getattr(constraint, field)):
            raise InputError(f"{where}.{field}: is 0; give a direction that is not")
