"""The actuators of a robot as sliders: names, ranges and steps, and what stands at a slider as an exact value."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import atan2, degrees, floor, log10, sqrt
from typing import TYPE_CHECKING, Final

from pkm_exact.geometry.chains import Crank, JointValue
from pkm_exact.geometry.given_joints import JointWord, crank_weights
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.wording import NO_UNIT

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pkm_exact.geometry.limits import Pair
    from pkm_exact.geometry.robot import Robot

SHARE: Final = 0.2
"""Without limits a slider reaches so far from its value, in parts of it; or of the longest value if it is 0."""
TURN: Final = 45.0
"""Degrees that a crank without limits turns either way."""
STEPS: Final = 1000
"""A range has at least so many steps."""
MOST_DEGREES: Final = 179.0


@dataclass(frozen=True)
class Slider:
    """An actuator.

    Attributes
    ----------
    name : str
        With its unit.
    low, high, step, value : float
        Decimals with few digits, value among them: where it stands at first.
    digits : int
        After the point, of all of them.
    in_degrees : bool
    """

    name: str
    low: float
    high: float
    step: float
    value: float
    digits: int
    in_degrees: bool

    def word(self, value: float) -> JointWord:
        """What stands at the slider, exactly.

        Examples
        --------
        >>> Slider("leg 1", 4.0, 6.0, 0.001, 5.0, 3, False).word(5.1230000001)
        (Fraction(5123, 1000), False)
        """
        return Fraction(f"{value:.{self.digits}f}"), self.in_degrees


def sliders(robot: Robot | Mechanism, configuration: str | None = None) -> tuple[Slider, ...]:
    """The sliders of a robot, at a configuration.

    Examples
    --------
    >>> from pkm_exact import read_robot
    >>> first = sliders(read_robot("models/3-rrr.toml"))[0]
    >>> first.in_degrees, first.value, first.high - first.low
    (True, 53.13, 90.0)
    """
    values = _values(robot, configuration)
    longest = max((abs(value) for value in values), default=1.0) or 1.0
    cranks = [weight is not None for weight in crank_weights(robot)]
    found = []
    for name, value, is_crank, limits in zip(robot.actuated, values, cranks, _limits(robot), strict=True):
        reach = TURN if is_crank else SHARE * (abs(value) or longest)
        low, high = (value - reach, value + reach) if limits is None else map(float, limits)
        if is_crank:
            low, high = max(low, -MOST_DEGREES), min(high, MOST_DEGREES)
        unit = "degrees" if is_crank else robot.unit
        found.append(
            _slider(
                name if unit == NO_UNIT else f"{name} [{unit}]",
                min(low, value),
                max(high, value),
                value,
                in_degrees=is_crank,
            )
        )
    return tuple(found)


def _slider(name: str, low: float, high: float, value: float, *, in_degrees: bool) -> Slider:
    """With ends on the grid of its steps, a power of ten."""
    power = floor(log10(max(high - low, 1e-9) / STEPS))
    step, digits = 10.0**power, max(0, -power)
    low, high, step, value = (round(x, digits) for x in (low, high, step, value))
    return Slider(name, low, high, step, value, digits, in_degrees)


def _values(robot: Robot | Mechanism, name: str | None) -> list[float]:
    """Lengths, positions of slides and products; of cranks degrees."""
    found = robot.configuration(name)
    if isinstance(robot, Mechanism):
        pairs = zip(found.values, robot.are_lengths, crank_weights(robot), strict=True)
        return [_plain(value, weight, squared=is_length) for value, is_length, weight in pairs]
    if not robot.chains:
        return [sqrt(square) for square in found.lengths_squared]
    return [_plain(value, weight) for value, weight in zip(found.joint_values, crank_weights(robot), strict=True)]


def _plain(value: JointValue, weight: int | None, *, squared: bool = False) -> float:
    if isinstance(value, tuple):
        return degrees(atan2(float(value[1]) * sqrt(weight or 1), float(value[0])))
    return sqrt(value) if squared else float(value)


def _limits(robot: Robot | Mechanism) -> Sequence[Pair | None]:
    """The limits of each actuator, where it has some."""
    if robot.limits is None:
        return [None] * len(robot.actuated)
    left = {sort: list(getattr(robot.limits, sort)) for sort in ("lengths", "slides", "angles")}
    return [left[sort].pop(0) if left.get(sort) else None for sort in _sorts(robot)]


def _sorts(robot: Robot | Mechanism) -> list[str]:
    """Under which limits each actuator falls."""
    if isinstance(robot, Mechanism):
        return [robot.sort_of(name) for name in robot.actuated]
    if not robot.chains:
        return ["lengths"] * len(robot.actuated)
    return ["angles" if isinstance(chain, Crank) else "slides" for chain in robot.chains]
