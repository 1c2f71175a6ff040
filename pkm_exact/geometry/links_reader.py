"""Mechanisms with passive bodies in model files: ``kind = "links"``, with a table for each body and each constraint.

Constraints and configurations are read as those of ``kind = "constraints"``; each constraint also names its two bodies.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.fields import known_keys, label, required, table_field
from pkm_exact.geometry.inverse import UNIT_METRIC, Metric
from pkm_exact.geometry.joints import parse_metric
from pkm_exact.geometry.links import GROUND, LinkBody, Links, number_of, require_names
from pkm_exact.geometry.mechanism_reader import read_mechanism, read_motion
from pkm_exact.geometry.pose_reader import read_pose
from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import MOTIONS
from pkm_exact.wording import shown

_KEYS: Final = (
    *["schema", "name", "kind", "motion", "unit", "source", "metric", "platform", "bodies", "constraints"],
    "configurations",
)
_OWN: Final = ("platform", "bodies")


def read_links_tables(table: dict[str, Any], head: Mapping[str, str]) -> Links:
    """The mechanism that the tables of a model file describe.

    Parameters
    ----------
    table : dict
        The whole file, of kind "links".
    head : mapping
        Name, unit and source, read already.
    """
    known_keys(table, _KEYS, "")
    motion = read_motion(table)
    metric = parse_metric(table["metric"], motion) if "metric" in table else UNIT_METRIC
    bodies = [_body(row, f"bodies[{i}]", motion, metric) for i, row in enumerate(_tables(table, "bodies"), 1)]
    names = [body.name for body in bodies]
    require_names(names)
    joined, rows = [], []
    for i, row in enumerate(_tables(table, "constraints"), 1):
        where = f"constraints[{i}]"
        joined.append(_pair(row, where, names))
        rows.append({key: value for key, value in row.items() if key != "bodies"})
    _refuse_poses(table)
    plain = {key: value for key, value in table.items() if key not in _OWN} | {"constraints": rows}
    return Links(read_mechanism(plain, head), tuple(bodies), tuple(joined), _platform(table, names))


def _tables(table: dict[str, Any], key: str) -> list[dict[str, Any]]:
    rows = required(table, key, "")
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows) or not rows:
        raise InputError(f"{key}: {shown(rows)} is not a list of tables; write [[{key}]] above each")
    return rows


def _body(row: dict[str, Any], where: str, default: Motion, metric: Metric) -> LinkBody:
    known_keys(row, ("name", "motion", "start"), where)
    name = label(row, "name", f"{where}.")
    if name == GROUND:
        raise InputError(f"{where}.name: {shown(GROUND)} is the body that stands still; choose another name")
    motion = default
    if "motion" in row:
        word = label(row, "motion", f"{where}.")
        if word not in MOTIONS:
            raise InputError(f"{where}.motion: {shown(word)} is unknown; use one of: {', '.join(MOTIONS)}")
        motion = MOTIONS[word]
    if "start" not in row:
        return LinkBody(name, motion)
    start = row["start"]
    if default.is_planar and isinstance(start, dict) and not motion.is_planar:
        known_keys(start, ("position",), f"{where}.start")
        start = start | {"half_tangent": 0}
    return LinkBody(name, motion, read_pose(start, f"{where}.start", default if default.is_planar else motion, metric))


def _pair(row: dict[str, Any], where: str, names: Sequence[str]) -> tuple[int, int]:
    given = required(row, "bodies", f"{where}.")
    if not isinstance(given, list) or len(given) != 2:
        raise InputError(f'{where}.bodies: {shown(given)} is not two names of bodies; write bodies = ["base", "b"]')
    first, second = (number_of(name, names, f"{where}.bodies") for name in given)
    if first == second:
        raise InputError(f"{where}.bodies: {shown(given[0])} twice; name two bodies")
    if second == 0:
        raise InputError(f"{where}.bodies: {shown(GROUND)} is the second; name it first")
    return first, second


def _platform(table: dict[str, Any], names: Sequence[str]) -> int:
    """The body that is asked about: the last one if none is named."""
    if "platform" not in table:
        return len(names)
    found = table_field(table, "platform", 'body = "..."')
    known_keys(found, ("body",), "platform")
    number = number_of(required(found, "body", "platform."), names, "platform.body")
    if number == 0:
        raise InputError(f"platform.body: {shown(GROUND)} does not move; name another body")
    return number


def _refuse_poses(table: dict[str, Any]) -> None:
    rows = table.get("configurations", [])
    for i, row in enumerate(rows if isinstance(rows, list) else [], 1):
        if isinstance(row, dict) and "pose" in row:
            raise InputError(
                f"configurations[{i}].pose: does not say where the passive bodies are; give values by the names of "
                "constraints"
            )
