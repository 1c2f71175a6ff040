"""Numbers of a robot that vary with a design: its legs with variables of the chart in the place of numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.regions.chart import Chart, Parameter, PosePolynomials, rational
from pkm_exact.regions.region_legs import OnCrank, OnHinge, OnSlide, RegionLeg, RegionMachine
from pkm_exact.wording import shown

SCALES: Final = ("base.scale", "platform.scale")
RODS: Final = "rods.length"
_SIDES: Final = {"base": "base", "platform": "platform"}


@dataclass(frozen=True)
class _Place:
    """A coordinate of a joint: of the base or the platform, which leg's, from 0, and which coordinate."""

    side: str
    leg: int
    axis: int


def require_apart(keys: Sequence[str]) -> None:
    """Refuse parameters that move one joint twice.

    Raises
    ------
    InputError
        With their names.
    """
    for scale in SCALES:
        side = scale.split(".")[0]
        for key in keys:
            if scale in keys and key.startswith(f"{side}.joints."):
                raise InputError(f"answer.parameters: {scale} and {key} move one joint; give one of them")


def require_known(key: str, machine: RegionMachine) -> None:
    """Refuse a key that is not a number of the robot's legs.

    Raises
    ------
    InputError
        With what can be given.
    """
    if machine.forms or any(isinstance(leg.actuator, OnHinge) or leg.axis is not None for leg in machine.legs):
        raise InputError("answer.parameters: are known of robots with legs or rods between joints, and no other joints")
    if key in SCALES:
        return
    if key == RODS:
        if all(isinstance(leg.actuator, OnSlide | OnCrank) for leg in machine.legs):
            return
        raise InputError(f"answer.parameters: {shown(key)}: the robot has no rods on slides or cranks; name another")
    if _place(key, machine) is None:
        raise InputError(
            f"answer.parameters: {shown(key)} is unknown; give {', '.join(SCALES)}, {RODS}, or a coordinate such as "
            "base.joints.2.1 (leg and axis, counted from 1)"
        )


def _place(key: str, machine: RegionMachine) -> _Place | None:
    parts = key.split(".")
    if len(parts) != 4 or parts[0] not in _SIDES or parts[1] != "joints":
        return None
    if not all(part.isascii() and part.isdigit() and len(part) <= 2 for part in parts[2:]):
        return None
    leg, axis = int(parts[2]) - 1, int(parts[3]) - 1
    dimension = 2 if machine.motion == "planar" else 3
    return _Place(parts[0], leg, axis) if 0 <= leg < len(machine.legs) and 0 <= axis < dimension else None


def varied_legs(machine: RegionMachine, chart: Chart, pose: PosePolynomials) -> Sequence[RegionLeg]:
    """The legs of a robot with the parameters of a chart in them: polynomials in the place of numbers."""
    legs: list[Any] = list(machine.legs)
    named = dict(zip(pose.ring.names(), pose.ring.gens(), strict=True))
    for parameter in chart.parameters:
        legs = [_varied(leg, k, parameter, named[parameter.name], machine) for k, leg in enumerate(legs)]
    return legs


def _varied(leg: Any, number: int, parameter: Parameter, value: Any, machine: RegionMachine) -> Any:
    if parameter.key == RODS:
        return replace(leg, actuator=replace(leg.actuator, rod_squared=value * value))
    if parameter.key in SCALES:
        side = parameter.key.split(".")[0]
        return replace(leg, **{side: tuple(value * rational(x) for x in getattr(leg, side))})
    place = _place(parameter.key, machine)
    if place is None or place.leg != number:
        return leg
    entries = list(getattr(leg, place.side))
    entries[place.axis] = value
    return replace(leg, **{place.side: tuple(entries)})
