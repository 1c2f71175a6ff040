"""Greatest speeds, forces and errors of actuators, and what is wanted of a platform, as users give them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.rational import NumberText, parse_rational
from pkm_exact.wording import shown

KEYS: Final[Mapping[str, str]] = {
    "speeds": "greatest speed of each actuator",
    "forces": "greatest force, or moment, of each actuator, both ways",
    "least_forces": "least force of each actuator, if it is not the negative of the greatest: 0 for cables",
    "resolutions": "greatest error of each actuator's value",
    "length": "a length by which turns are compared with translations",
    "twist": "greatest speeds of the platform, of translation and of rotation: instead of a length",
    "speed": "wanted speed of the platform, in any direction",
    "turn": "wanted angular velocity",
    "force": "wanted force",
    "moment": "wanted moment",
    "spin": "imposed angular velocity, a component for each axis of rotation",
}

_SIGNED: Final = ("least_forces", "spin")
_OF_ACTUATORS: Final = ("speeds", "forces", "least_forces", "resolutions")


@dataclass(frozen=True)
class ActuatorLimits:
    """What actuators can do, and what is wanted; None of what is not known.

    Attributes
    ----------
    speeds, forces, least_forces, resolutions : tuple of Fraction, one for each actuator
    length : Fraction
        By which turns are multiplied to be compared with translations.
    speed, turn, force, moment : Fraction
    spin : tuple of Fraction
    """

    speeds: tuple[Fraction, ...] | None = None
    forces: tuple[Fraction, ...] | None = None
    least_forces: tuple[Fraction, ...] | None = None
    resolutions: tuple[Fraction, ...] | None = None
    length: Fraction | None = None
    speed: Fraction | None = None
    turn: Fraction | None = None
    force: Fraction | None = None
    moment: Fraction | None = None
    spin: tuple[Fraction, ...] | None = None

    @classmethod
    def of(cls, given: Mapping[str, Any], actuators: int) -> ActuatorLimits:
        """Limits from numbers, or lists of them; one number for actuators is that of all.

        Raises
        ------
        InputError
            If a key is unknown, or a number is not exact and positive.

        Examples
        --------
        >>> ActuatorLimits.of({"speeds": "1/2"}, 3).speeds
        (Fraction(1, 2), Fraction(1, 2), Fraction(1, 2))
        """
        found = {key: _numbers(key, value, actuators) for key, value in given.items()}
        if "twist" in found:
            if "length" in found:
                raise InputError("limits: length and twist given; give one of them")
            found["length"] = found.pop("twist")
        limits = cls(**found)
        if limits.least_forces is not None and limits.forces is not None:
            for low, high in zip(limits.least_forces, limits.forces, strict=True):
                if low >= high:
                    raise InputError(f"limits, least_forces: {shown(low)} is not below {shown(high)}; give less")
        return limits

    @property
    def force_ends(self) -> tuple[tuple[Fraction, ...], tuple[Fraction, ...]] | None:
        """Least and greatest forces."""
        if self.forces is None:
            return None
        return self.least_forces or tuple(-x for x in self.forces), self.forces


def _numbers(key: str, value: Any, actuators: int) -> Any:
    """What a key denotes."""
    if key not in KEYS:
        raise InputError(f"limits: {shown(key)} is unknown; use {', '.join(KEYS)}")
    numbers = [parse_rational(_text(x), f"limits, {key}") for x in (value if _is_list(value) else [value])]
    if key not in _SIGNED and any(x <= 0 for x in numbers):
        raise InputError(f"limits, {key}: {shown(min(numbers))} is not positive; give numbers greater than 0")
    if key == "spin":
        return tuple(numbers)
    if key in _OF_ACTUATORS:
        if len(numbers) == 1:
            numbers *= actuators
        if len(numbers) != actuators:
            raise InputError(f"limits, {key}: {len(numbers)} numbers; give 1 or {actuators}, one each actuator")
        return tuple(numbers)
    wanted = 2 if key == "twist" else 1
    if len(numbers) != wanted:
        raise InputError(f"limits, {key}: {len(numbers)} numbers; give {wanted}")
    return numbers[0] / numbers[1] if key == "twist" else numbers[0]


def _is_list(value: object) -> bool:
    return isinstance(value, Sequence) and not isinstance(value, str)


def _text(value: Any) -> Any:
    return NumberText(value) if isinstance(value, str) and "/" not in value else value
