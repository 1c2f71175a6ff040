"""Values of a mechanism's constraints at a pose, as a JSON object or as a table."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from pkm_exact.cli.legs_report import aligned, exact_and_bounds, pose_lines, pose_object, short, surd_decimal
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.inverse import Matrix
from pkm_exact.geometry.mechanism import Mechanism, is_square
from pkm_exact.geometry.surds import Surd


def as_object(
    mechanism: Mechanism, position: Vector, rotation: Matrix, width: Fraction, nearest: Fraction | None = None
) -> dict[str, Any]:
    """The answer as a JSON object: for each constraint its value at the pose, and whether the constraint holds there.

    A value is exact and has bounds; of lengths and radii the squares are given too. Constraints without a value have
    None. ``holds`` is None for actuated constraints: they are given what they need.
    """
    return pose_object(mechanism, position, rotation, nearest) | {
        "constraints": [
            {"name": name, "type": type_, "actuated": holds is None, "holds": holds, **_spelled(value, squared, width)}
            for name, type_, value, squared, holds in _rows(mechanism, position, rotation)
        ]
    }


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
    found: list[tuple[str, str, Fraction | None, bool, bool | None]] = []
    for constraint in mechanism.constraints:
        value = values.get(constraint.name)
        holds = None if constraint.name in mechanism.actuated else mechanism.holds(constraint, position, rotation)
        found.append((constraint.name, constraint.type, value, is_square(constraint.value_field or ""), holds))
    return found


def as_text(
    mechanism: Mechanism, position: Vector, rotation: Matrix, width: Fraction, nearest: Fraction | None = None
) -> str:
    """The answer as a headline, lines for a configuration, and a table."""
    rows = _rows(mechanism, position, rotation)
    lines = pose_lines(mechanism, position, rotation, nearest)
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
    return "".join(f"{line}\n" for line in [*lines, "", *aligned(table)])
