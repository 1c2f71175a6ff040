"""A mechanism with one platform, declared by its constraints: any joints, legs and sensors, no code.

Some constraints are structural: hinges, lines, fixed lengths. Others are actuated: their values, a length, an offset or
a product, are left to the configurations. With locked actuators all of them together are a forward kinematics problem.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, Final

from pkm_exact.constraints.constraint import Constraint, Role
from pkm_exact.constraints.form import Form, Vector, value_at
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import UNIT_METRIC, Matrix, Metric
from pkm_exact.geometry.limits import Limits
from pkm_exact.geometry.machine import CONSTRAINTS_KIND, Machine
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rational import MAX_COMPUTED_DIGITS, bounded, parse_rational
from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import SPATIAL
from pkm_exact.wording import shown

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
    values : tuple of Fraction
        In the order of the actuated constraints: squared lengths, offsets, products.
    """

    name: str
    values: tuple[Fraction, ...]


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
        Names of the actuated constraints, in the order of ``constraints``.
    motion : Motion
        In which the platform is kept by joints that are not declared one by one.
    metric : tuple of 3 int
        Gram diagonal: all coordinates are rational ones, all products those of the metric.
    configurations : tuple of LockedValues
        The first one is the default.
    limits : Limits or None
        Of actuators, legs and position, if there are any.

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

    def __post_init__(self) -> None:
        if not 1 <= len(self.constraints) <= MOST_CONSTRAINTS:
            raise InputError(f"constraints: {len(self.constraints)} given; give 1 to {MOST_CONSTRAINTS}")
        _refuse_equal("constraints", [constraint.name for constraint in self.constraints])
        _refuse_equal("configurations", [configuration.name for configuration in self.configurations])
        for number, constraint in enumerate(self.constraints, 1):
            _require_directions(constraint, f"constraints[{number}] ({shown(constraint.name)})")
        for name in self.actuated:
            self._value_field(name)
        for configuration in self.configurations:
            self.locked(configuration.values, f"configuration {shown(configuration.name)}")
        if not self.configurations and not self.actuated:
            object.__setattr__(self, "configurations", (LockedValues(FREE, ()),))

    def __repr__(self) -> str:
        return f"Mechanism({self.name!r}, {len(self.constraints)} constraints)"

    def problem(self, locked: LockedValues | Sequence[Fraction | int | str]) -> ForwardProblem:
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
        """The problem for values of the actuated constraints: lengths, or squared ones, offsets, products."""
        fields = [self._value_field(name) for name in self.actuated]
        if squared or len(values) != len(fields):
            return self.problem(values)
        for name, field, value in zip(self.actuated, fields, values, strict=True):
            if is_square(field) and value <= 0:
                raise InputError(f"values, {shown(name)}: {shown(value)} is not positive; give a length greater than 0")
        return self.problem(
            [value * value if is_square(field) else value for field, value in zip(fields, values, strict=True)]
        )

    @property
    def are_lengths(self) -> tuple[bool, ...]:
        """For each actuated constraint whether users give a length, which is positive."""
        return tuple(is_square(self._value_field(name)) for name in self.actuated)

    def locked(self, values: Sequence[Fraction | int | str], where: str) -> tuple[Constraint, ...]:
        """All constraints, the actuated ones with the given values."""
        if len(values) != len(self.actuated):
            wanted = ", ".join(self.actuated) or "none"
            raise InputError(f"{where}: {len(values)} values; give {len(self.actuated)}, for {wanted}")
        found = dict(zip(self.actuated, values, strict=True))
        return tuple(
            self._with_value(constraint, found[constraint.name], f"{where}, {shown(constraint.name)}")
            if constraint.name in found
            else constraint
            for constraint in self.constraints
        )

    def values_at(self, position: Vector, rotation: Matrix) -> dict[str, Fraction]:
        """By how much each linear form of the constraints differs from 0 at a pose, added to the constraint's value.

        The values that the constraints have at the pose: squared lengths, offsets, products. Constraints without a
        value are left out, and so are quadrics.
        """
        values = {}
        for constraint in self.constraints:
            forms = constraint.forms(self.metric)
            if constraint.value_field is not None and len(forms) == 1:
                rest = value_at(forms[0], position, rotation, self.metric)
                values[constraint.name] = getattr(constraint, constraint.value_field) + rest
            for square in constraint.squares(self.metric):
                linear, root = (self._at(form, position, rotation) for form in (square.linear, square.root))
                rest = linear - square.factor * root * root
                values[constraint.name] = getattr(constraint, constraint.value_field or "") + rest
        return values

    def holds(self, constraint: Constraint, position: Vector, rotation: Matrix) -> bool:
        """Whether a constraint holds at a pose, exactly."""
        linear = all(self._at(form, position, rotation) == 0 for form in constraint.forms(self.metric))
        return linear and all(
            self._at(found.linear, position, rotation) == found.factor * self._at(found.root, position, rotation) ** 2
            for found in constraint.squares(self.metric)
        )

    def _at(self, form: Form, position: Vector, rotation: Matrix) -> Fraction:
        return Fraction(value_at(form, position, rotation, self.metric))

    def _value_field(self, name: str) -> str:
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
        field = self._value_field(constraint.name)
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


def _require_directions(constraint: Constraint, where: str) -> None:
    """Refuse a direction that is 0."""
    for field, role in constraint.fields.items():
        if role in (Role.BASE_DIRECTION, Role.PLATFORM_DIRECTION) and not any(getattr(constraint, field)):
            raise InputError(f"{where}.{field}: is 0; give a direction that is not")
