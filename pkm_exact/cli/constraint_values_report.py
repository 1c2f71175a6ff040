"""Values of a mechanism's constraints at a pose, as a JSON object or as a table."""

from __future__ import annotations

from fractions import Fraction
from math import prod
from typing import Any

from pkm_exact.cli.legs_report import (
    aligned,
    exact_and_bounds,
    mode_object,
    pose_lines,
    pose_object,
    short,
    surd_decimal,
)
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.chains import JointValue
from pkm_exact.geometry.drive_modes import JointModes, joint_values
from pkm_exact.geometry.inverse import Matrix
from pkm_exact.geometry.mechanism import Mechanism, is_square
from pkm_exact.geometry.redundant_drives import Standing
from pkm_exact.geometry.surds import Surd
from pkm_exact.geometry.working_modes import CrankMode, EnclosedCrank, FreeCrank, Mode, PairedMode, SlideMode


def as_object(
    still: Standing, position: Vector, rotation: Matrix, width: Fraction, nearest: Fraction | None = None
) -> dict[str, Any]:
    """The answer as a JSON object: for each constraint its value at the pose, and whether the constraint holds there.

    A value is exact and has bounds; of lengths and radii the squares are given too. Constraints without a value have
    None. ``holds`` is None for actuated constraints: they are given what they need.
    """
    mechanism = still.mechanism
    answer = pose_object(mechanism, position, rotation, nearest) | {
        "constraints": [
            {"name": name, "type": type_, "actuated": holds is None, "holds": holds, **_spelled(value, squared, width)}
            for name, type_, value, squared, holds in _rows(mechanism, position, rotation)
        ]
    }
    if still.configuration is not None:
        values = {
            name: list(map(str, value)) if isinstance(value, tuple) else str(value) for name, value in still.values
        }
        answer["standing"] = {"configuration": still.configuration, "values": values}
    if not mechanism.drives:
        return answer
    joints = joint_values(mechanism, position, rotation)
    return answer | {
        "working_modes": _count(joints),
        "actuators": [
            {
                "name": joint.name,
                "modes": [mode_object(mode, width) for mode in joint.modes],
                "discriminant": None if joint.discriminant is None else str(joint.discriminant),
            }
            for joint in joints
        ],
    }


def _count(joints: tuple[JointModes, ...]) -> int | None:
    """How many working modes there are; None if infinitely many."""
    if any(isinstance(mode, FreeCrank) for joint in joints for mode in joint.modes):
        return None
    return prod(len(joint.modes) for joint in joints)


def _spelled(value: Fraction | None, squared: bool, width: Fraction) -> dict[str, Any]:
    if value is None:
        return {"value": None, "value_squared": None}
    shown = None if squared and value < 0 else exact_and_bounds(Surd.root_of(value) if squared else Surd(value), width)
    return {"value": shown, "value_squared": str(value) if squared else None}


def _rows(
    mechanism: Mechanism, position: Vector, rotation: Matrix
) -> list[tuple[str, str, Fraction | None, bool, bool | None]]:
    """Name, type, value at the pose, whether that is a square, and whether the constraint holds (None if actuated)."""
    values = mechanism.values_at(position, rotation)
    moved = {part.constraint for drive in mechanism.drives for part in drive.parts}
    found: list[tuple[str, str, Fraction | None, bool, bool | None]] = []
    for constraint in mechanism.constraints:
        value = values.get(constraint.name)
        driven = constraint.name in mechanism.actuated or constraint.name in moved
        holds = None if driven else mechanism.holds(constraint, position, rotation)
        value = None if constraint.name in moved else value
        found.append((constraint.name, constraint.type, value, is_square(constraint.value_field or ""), holds))
    return found


def as_text(
    still: Standing, position: Vector, rotation: Matrix, width: Fraction, nearest: Fraction | None = None
) -> str:
    """The answer as a headline, lines for a configuration, and a table."""
    mechanism = still.mechanism
    rows = _rows(mechanism, position, rotation)
    lines = pose_lines(mechanism, position, rotation, nearest)
    if still.configuration is not None:
        free = ", ".join(f"{name} {_spelled_value(value)}" for name, value in still.values)
        lines.append(
            f"{free}, as in configuration {still.configuration}: redundant, the pose is reached with others too"
        )
    actuated = [
        (name, value, squared) for name, _, value, squared, holds in rows if holds is None and value is not None
    ]
    for key, wanted in (("values", False), ("values_squared", True)):
        pairs = ", ".join(f'"{name}" = "{value}"' for name, value, squared in actuated if squared == wanted)
        if pairs:
            lines.append(f"{key} = {{ {pairs} }}")
    table: list[tuple[str, ...]] = [("constraint", "type", "value", "exact", "holds")]
    for name, type_, value, squared, holds in rows:
        number = None if value is None or (squared and value < 0) else Surd.root_of(value) if squared else Surd(value)
        texts = ("", "") if number is None else (surd_decimal(number, width), short(str(number)))
        table.append((name, type_, *texts, {None: "actuated", True: "yes", False: "no"}[holds]))
    lines += ["", *aligned(table)]
    if mechanism.drives:
        lines += _joint_lines(joint_values(mechanism, position, rotation), width)
    return "".join(f"{line}\n" for line in lines)


def _spelled_value(value: JointValue) -> str:
    """A position, or cosine and sine of a crank."""
    return f"(cosine {value[0]}, sine {value[1]})" if isinstance(value, tuple) else str(value)


def _joint_lines(joints: tuple[JointModes, ...], width: Fraction) -> list[str]:
    """Working modes: how many, and every value of every actuator with the discriminant that vanishes where two meet."""
    count = _count(joints)
    unreached = [joint.name for joint in joints if not joint.modes]
    if unreached:
        headline = f"out of reach: {', '.join(unreached)}"
    elif count is None:
        headline = "infinitely many working modes: the angle of a crank does not matter here"
    else:
        headline = f"{count} working mode{'' if count == 1 else 's'}"
    table: list[tuple[str, ...]] = [("actuator", "value", "exact", "discriminant")]
    for joint in joints:
        discriminant = "" if joint.discriminant is None else short(str(joint.discriminant))
        for mode in joint.modes:
            parts = mode.values if isinstance(mode, PairedMode) else ((joint.name, mode),)
            table += [(name, *_shown(value, width), discriminant) for name, value in parts]
    return ["", headline, *(aligned(table) if len(table) > 1 else [])]


def _shown(mode: Mode, width: Fraction) -> tuple[str, str]:
    if isinstance(mode, SlideMode):
        return surd_decimal(mode.position, width), short(str(mode.position))
    if isinstance(mode, FreeCrank):
        return "any angle", ""
    if isinstance(mode, PairedMode):
        raise TypeError("values of two drives are shown one by one")
    if isinstance(mode, EnclosedCrank):
        exact = mode.half_tangent.radicals
        text = f"half tangent {exact}" if exact is not None else "root of a polynomial: see --format json"
        return surd_decimal(mode.half_tangent, width), short(text)
    return _crank(mode, width)


def _crank(mode: CrankMode, width: Fraction) -> tuple[str, str]:
    """The half tangent, if there is one."""
    if mode.half_tangent is None:
        return "180 degrees", "half tangent infinite"
    return surd_decimal(mode.half_tangent, width), short(f"half tangent {mode.half_tangent}")
