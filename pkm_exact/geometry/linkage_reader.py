"""Mechanisms of bodies and joints in model files: ``kind = "chains"``, with a table for each body and each joint."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.fields import known_keys, label, required
from pkm_exact.geometry.joint_types import JOINT_TYPES, JointGeometry, JointType, SixCoordinates
from pkm_exact.geometry.linkage import MOST_BODIES, MOST_FREEDOMS, Joint, Linkage
from pkm_exact.geometry.rational import parse_rational, parse_vector
from pkm_exact.wording import shown

_KEYS: Final = ("schema", "name", "kind", "unit", "source", "base", "platform", "bodies", "joints")
_COMMON: Final = ("name", "type", "bodies", "actuated")


def read_linkage_tables(table: dict[str, Any], head: Mapping[str, str]) -> Linkage:
    """The mechanism that the tables of a model file describe.

    Parameters
    ----------
    table : dict
        The whole file, of kind "chains".
    head : mapping
        Name, unit and source, read already.
    """
    known_keys(table, _KEYS, "")
    bodies = [_body(row, f"bodies[{i}]") for i, row in enumerate(_tables(table, "bodies", MOST_BODIES), 1)]
    joints = [_joint(row, f"joints[{i}]") for i, row in enumerate(_tables(table, "joints", MOST_FREEDOMS), 1)]
    base = label(table, "base", "") if "base" in table else bodies[0]
    platform = label(table, "platform", "") if "platform" in table else bodies[-1]
    return Linkage(head["name"], head["unit"], head["source"], tuple(bodies), tuple(joints), base, platform)


def _tables(table: dict[str, Any], key: str, most: int) -> list[dict[str, Any]]:
    rows = required(table, key, "")
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise InputError(f"{key}: {shown(rows)} is not a list of tables; write [[{key}]] above each")
    if not 1 <= len(rows) <= most:
        raise InputError(f"{key}: {len(rows)} given; give 1 to {most}")
    return rows


def _body(row: dict[str, Any], where: str) -> str:
    known_keys(row, ("name",), where)
    return label(row, "name", f"{where}.")


def _joint(row: dict[str, Any], where: str) -> Joint:
    name, type_name = label(row, "name", f"{where}."), label(row, "type", f"{where}.")
    if type_name not in JOINT_TYPES:
        raise InputError(f"{where}.type: {shown(type_name)} is unknown; use one of: {', '.join(JOINT_TYPES)}")
    found = JOINT_TYPES[type_name]
    known_keys(row, (*_COMMON[:3], *found.fields, _COMMON[3]), where)
    bodies = required(row, "bodies", f"{where}.")
    if not isinstance(bodies, list) or len(bodies) != 2 or not all(isinstance(body, str) for body in bodies):
        raise InputError(f'{where}.bodies: {shown(bodies)} is not two names of bodies; write bodies = ["a", "b"]')
    joint = Joint(name, type_name, (bodies[0], bodies[1]), _geometry(row, where, found))
    return Joint(name, type_name, joint.bodies, joint.geometry, _actuated(row, where, len(joint.twists)))


def _geometry(row: dict[str, Any], where: str, found: JointType) -> JointGeometry:
    read: dict[str, Any] = {}
    if "point" in found.fields:
        read["point"] = parse_vector(required(row, "point", f"{where}."), f"{where}.point")
    if "pitch" in found.fields:
        read["pitch"] = parse_rational(required(row, "pitch", f"{where}."), f"{where}.pitch")
    if found.axes == 1:
        read["axes"] = (parse_vector(required(row, "axis", f"{where}."), f"{where}.axis"),)
    elif found.axes:
        rows = required(row, "axes", f"{where}.")
        if not isinstance(rows, list) or len(rows) != found.axes:
            raise InputError(f"{where}.axes: {shown(rows)} is not a list of {found.axes} axes; give that many")
        read["axes"] = tuple(parse_vector(axis, f"{where}.axes[{k}]") for k, axis in enumerate(rows, 1))
    if "screws" in found.fields:
        read["screws"] = _screws(row, where)
    for axis in read.get("axes", ()):
        if not any(axis):
            raise InputError(f"{where}: an axis is 0; give a direction that is not")
    return JointGeometry(**read)


def _screws(row: dict[str, Any], where: str) -> tuple[SixCoordinates, ...]:
    rows = required(row, "screws", f"{where}.")
    if not isinstance(rows, list) or not 1 <= len(rows) <= 6:
        raise InputError(
            f"{where}.screws: {shown(rows)} is not a list of 1 to 6 screws; give six numbers, (w; v), each"
        )
    found = []
    for k, values in enumerate(rows, 1):
        if not isinstance(values, list) or len(values) != 6:
            raise InputError(f"{where}.screws[{k}]: {shown(values)} is not a list of six numbers; give (w; v)")
        numbers = tuple(parse_rational(value, f"{where}.screws[{k}][{i}]") for i, value in enumerate(values, 1))
        if not any(numbers):
            raise InputError(f"{where}.screws[{k}]: all six numbers are 0; give a screw that is not")
        found.append(numbers)
    return tuple(found)


def _actuated(row: dict[str, Any], where: str, count: int) -> tuple[int, ...]:
    value = row.get("actuated", False)
    if isinstance(value, bool):
        return tuple(range(1, count + 1)) if value else ()
    fits = isinstance(value, list) and all(isinstance(k, int) and not isinstance(k, bool) for k in value)
    if not fits or len(set(value)) != len(value) or not all(1 <= k <= count for k in value):
        raise InputError(
            f"{where}.actuated: {shown(value)} does not say which of its freedoms are actuated; write true, false or a "
            f"list of different numbers from 1 to {count}"
        )
    return tuple(sorted(value))
