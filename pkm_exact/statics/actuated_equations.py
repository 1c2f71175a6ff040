"""The scalar equations that hold a platform, and what moves each of them: a twist of the platform, its actuators.

An equation F = 0 changes with a twist y of the platform, in rational coordinates, by W.y, and with the value q of an
actuator by -rate q'. So the actuators move with the platform by

    W y = rate q',    q' = J t

An equation may have several actuators, an actuator several equations: W y = R q'. Of a leg of length q the equation is
|C + R B - A|^2 = q^2, W the derivative of the left side and rate 2 q. Of an offset or a product, rate is 1. A drive, a
slide or a crank, moves fields of the constraint along a velocity d: F is a polynomial of degree 2 in its step h d, so
that the rate is (F(-d) - F(d)) / 2, exactly. Of a cylinder about a direction v that is turned, whose square is divided
by |v|^2, that divisor stays as it is: v.d = 0.

References: Gosselin and Angeles, IEEE Trans. Robotics and Automation 6 (1990), 281-290, for the two Jacobians; Shayya
et al., IROS 2014, equations (14) to (17).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, Final, TypeAlias

from pkm_exact.constraints.constraint import Constraint, Role, SquareForm
from pkm_exact.constraints.form import Form
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.mechanism import is_square
from pkm_exact.radicals import RootSum

AnyForm: TypeAlias = Form | SquareForm
_UNIT: Final = Fraction(1)


@dataclass(frozen=True)
class Rate:
    """How the value of an actuator enters an equation.

    Attributes
    ----------
    actuator : int
        Its index.
    value_squared : Fraction or None
        The square of a length that is the value.
    stepped : pair of forms, or None
        The equation with the actuator one unit forth and back along its velocity; without either, the rate is 1.
    """

    actuator: int
    value_squared: Fraction | None = None
    stepped: tuple[AnyForm, AnyForm] | None = None


@dataclass(frozen=True)
class Equation:
    """One scalar equation of a constraint.

    Attributes
    ----------
    name : str
        That of its constraint; of a constraint of several equations with its number.
    form : Form or SquareForm
        It vanishes at the pose.
    size_squared : Fraction
        The square of what makes the wrench one of unit force, or of unit moment where it has no force.
    rates : tuple of Rate
        Of the actuators that enter it.
    """

    name: str
    form: AnyForm
    size_squared: Fraction
    rates: tuple[Rate, ...] = ()


@dataclass(frozen=True)
class Actuator:
    """An actuator.

    Attributes
    ----------
    name : str
    unit : str
        Of its value: "length", "angle" (radians) or "1".
    equation : int
        Index of the equation that gives its speed: the first that it enters and no other actuator has.
    """

    name: str
    unit: str
    equation: int


@dataclass(frozen=True)
class Held:
    """What holds a platform.

    Attributes
    ----------
    equations : tuple of Equation
        In the order of the constraints.
    actuators : tuple of Actuator
    is_redundant : bool
        Kinematically: there are more actuators than equations for them, so that q' does not follow from the twist.
    """

    equations: tuple[Equation, ...]
    actuators: tuple[Actuator, ...] = ()
    is_redundant: bool = False

    @property
    def driven(self) -> tuple[int, ...]:
        """Indices of the equations that are rows of J_x and J_q: those of the actuators, or all that any enters."""
        if self.is_redundant:
            return tuple(index for index, equation in enumerate(self.equations) if equation.rates)
        return tuple(actuator.equation for actuator in self.actuators)

    @property
    def structural(self) -> tuple[int, ...]:
        """Indices of the equations that give no actuator its speed."""
        driven = set(self.driven)
        return tuple(index for index in range(len(self.equations)) if index not in driven)

    @property
    def is_diagonal(self) -> bool:
        """Whether J_q is diagonal for each choice of values: every driven equation has one actuator."""
        return not self.is_redundant and all(
            [rate.actuator for rate in self.equations[actuator.equation].rates] == [k]
            for k, actuator in enumerate(self.actuators)
        )

    @property
    def is_entangled(self) -> bool:
        """Whether a driven equation has several actuators, or an actuator has several equations."""
        entered = [rate.actuator for equation in self.equations for rate in equation.rates]
        return len(set(entered)) < len(entered) or not self.is_diagonal

    def given_by(self, equations: Sequence[int]) -> Held:
        """The same with the speeds of actuators given by these equations."""
        pairs = zip(self.actuators, equations, strict=True)
        return replace(self, actuators=tuple(replace(actuator, equation=index) for actuator, index in pairs))


@dataclass(frozen=True)
class Motor:
    """An actuator as a mechanism has it: the constraint whose value it sets, or what it moves.

    Attributes
    ----------
    name, unit : str
    constraint : str
        Of the equation that gives its speed.
    velocities : mapping, or None
        Of constraints and their fields, for each unit of the value; None if it sets the constraint's own value.
    """

    name: str
    unit: str
    constraint: str
    velocities: Mapping[tuple[str, str], Any] | None = None


def held(constraints: Sequence[tuple[str, Constraint]], metric: Metric, motors: Sequence[Motor]) -> Held:
    """The equations of named constraints and of their motors.

    Raises
    ------
    InputError
        If a motor sets the value of a constraint of several equations.
    """
    equations: list[Equation] = []
    places: dict[str, int] = {}
    for name, constraint in constraints:
        forms, scales = _forms(constraint, metric), constraint.scales(metric, _UNIT)
        steps = [(index, _stepped(name, constraint, motor, metric)) for index, motor in enumerate(motors)]
        places[name] = len(equations)
        for k, (form, scale) in enumerate(zip(forms, scales, strict=True)):
            title = name if len(forms) == 1 else f"{name} ({k + 1})"
            rates = tuple(Rate(index, stepped=(up[k], down[k])) for index, (up, down) in steps if up)
            rates += tuple(
                Rate(index, _square(constraint))
                for index, motor in enumerate(motors)
                if motor.velocities is None and motor.constraint == name
            )
            equations.append(Equation(title, form, scale, tuple(sorted(rates, key=lambda rate: rate.actuator))))
    for motor in motors:
        if motor.velocities is None and len(_forms(dict(constraints)[motor.constraint], metric)) != 1:
            raise InputError(
                f"{motor.name}: drives a constraint of several equations; velocities and forces are not computed "
                "for that"
            )
    given = speed_equations(equations, [places[motor.constraint] for motor in motors])
    first = [places[motor.constraint] for motor in motors]
    found = tuple(Actuator(m.name, m.unit, place) for m, place in zip(motors, given or first, strict=True))
    return Held(tuple(equations), found, is_redundant=given is None)


def speed_equations(equations: Sequence[Equation], preferred: Sequence[int]) -> list[int] | None:
    """An equation of its own for each actuator that enters it, the preferred one if it can be; None if there are none.

    Examples
    --------
    >>> both = Rate(0), Rate(1)
    >>> pair = [Equation("a", (), Fraction(1), both), Equation("b", (), Fraction(1), both[:1])]
    >>> speed_equations(pair, [0, 0]), speed_equations(pair[:1], [0, 0])
    ([1, 0], None)
    """
    entered: list[list[int]] = [[place] for place in preferred]
    for index, equation in enumerate(equations):
        for rate in equation.rates:
            if index not in entered[rate.actuator]:
                entered[rate.actuator].append(index)
    owner: dict[int, int] = {}

    def place(actuator: int, seen: set[int]) -> bool:
        for index in entered[actuator]:
            if index in seen:
                continue
            seen.add(index)
            if index not in owner or place(owner[index], seen):
                owner[index] = actuator
                return True
        return False

    if not all(place(actuator, set()) for actuator in range(len(preferred))):
        return None
    return [index for _, index in sorted((actuator, index) for index, actuator in owner.items())]


def _forms(constraint: Constraint, metric: Metric) -> list[AnyForm]:
    return [*constraint.forms(metric), *constraint.squares(metric)]


def _square(constraint: Constraint) -> Fraction | None:
    """The square of the value that an actuator sets, if it is a length."""
    field = constraint.value_field or ""
    return getattr(constraint, field) if is_square(field) else None


def _stepped(name: str, constraint: Constraint, motor: Motor, metric: Metric) -> tuple[list[AnyForm], list[AnyForm]]:
    """The forms with the motor one unit forth and back; none if it does not move the constraint."""
    moved = {field: step for (place, field), step in (motor.velocities or {}).items() if place == name}
    if not moved:
        return [], []
    found = []
    for sign in (1, -1):
        fields = {field: _sum(getattr(constraint, field), step, sign) for field, step in moved.items()}
        changed: Any = constraint
        forms = _forms(replace(changed, **fields), metric)
        found.append([_divided_alike(*both) for both in zip(forms, _forms(constraint, metric), strict=True)])
    for field, step in moved.items():
        if constraint.squares(metric) and constraint.fields[field] is Role.BASE_DIRECTION:
            _require_turned(motor.name, getattr(constraint, field), step, metric)
    return found[0], found[1]


def _divided_alike(form: AnyForm, before: AnyForm) -> AnyForm:
    """A form after a step, its square divided by what it was divided by before."""
    if isinstance(form, SquareForm) and isinstance(before, SquareForm):
        return replace(form, factor=before.factor)
    return form


def _require_turned(name: str, direction: Any, step: Any, metric: Metric) -> None:
    """Refuse a direction that does not keep its length to first order."""
    change = sum((g * v * d for g, v, d in zip(metric, direction, step, strict=True)), Fraction(0))
    if RootSum.of(change).sign():
        raise InputError(f"{name}: moves a direction and does not turn it; velocities are not computed for that")


def _sum(start: Any, step: Any, sign: int) -> Any:
    if isinstance(start, tuple):
        return tuple(a + b * sign for a, b in zip(start, step, strict=True))
    return start + step * sign
