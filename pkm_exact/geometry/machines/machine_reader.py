"""Machines in model files: ``kind = "delta"``, their dimensions, and configurations with lists of joint values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Final, TypeAlias

from pkm_exact.errors import InputError
from pkm_exact.geometry.angle_degrees import StandIn, angle_in_degrees
from pkm_exact.geometry.chains import JointValue
from pkm_exact.geometry.fields import known_keys, label, list_field, table_field, truth
from pkm_exact.geometry.joints import parse_metric
from pkm_exact.geometry.limits_reader import read_limits
from pkm_exact.geometry.machines.machine_kind import Assembly, Group, Joint, MachineKind
from pkm_exact.geometry.mechanism import LockedValues, Mechanism
from pkm_exact.geometry.mechanism_reader import limited_parts
from pkm_exact.geometry.pose_reader import read_pose
from pkm_exact.geometry.rational import parse_positive, parse_rational
from pkm_exact.wording import shown

_HEAD: Final = ("schema", "name", "kind", "unit", "source")


def read_machine(table: dict[str, Any], head: Mapping[str, str], kind: MachineKind) -> Mechanism:
    """The machine that the tables of a model file describe.

    Parameters
    ----------
    table : dict
        The whole file.
    head : mapping
        Name, unit and source, read already.
    kind : MachineKind
    """
    metric_key = ("metric",) if kind.own_metric else ()
    known_keys(table, (*_HEAD, *metric_key, *kind.tables, "limits", "configurations"), "")
    metric = parse_metric(table["metric"], kind.motion) if "metric" in table else kind.metric
    given: dict[str, Any] = {}
    for name in kind.tables:
        own = [dimension for dimension in kind.dimensions if dimension.table == name]
        needed = next((dimension for dimension in own if not dimension.is_optional), None)
        example = f"{own[0].key} = {own[0].example}"
        found = table_field(table, name, example) if needed is not None or name in table else {}
        known_keys(found, tuple(key for dimension in own for key in (dimension.key, *dimension.also)), name)
        given |= {dimension.name or dimension.key: dimension.read(found, name) for dimension in own}
    assembly = kind.build(given, metric)
    mechanism = assembled(head, kind, assembly, metric)
    if "limits" in table:
        mechanism = replace(mechanism, limits=read_limits(table["limits"], limited_parts(mechanism)))
    rows = table.get("configurations", [])
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise InputError(f"configurations: {shown(rows)} is not a list of tables; write [[configurations]] above each")
    locked = tuple(
        _configuration(row, f"configurations[{i}]", mechanism, assembly.groups) for i, row in enumerate(rows, 1)
    )
    return replace(mechanism, configurations=locked) if locked else mechanism


def assembled(
    head: Mapping[str, str], kind: MachineKind, assembly: Assembly, metric: tuple[int, int, int]
) -> Mechanism:
    """The mechanism of an assembly, without configurations."""
    return Mechanism(
        head["name"],
        head["unit"],
        head["source"],
        assembly.constraints,
        tuple(name for group in assembly.groups for name in group.names),
        kind.motion,
        metric,
        kind=kind.name,
        drives=assembly.drives,
        bars=assembly.bars,
        feet=assembly.feet,
    )


def _configuration(row: dict[str, Any], where: str, mechanism: Mechanism, groups: tuple[Group, ...]) -> LockedValues:
    keys = [key for group in groups for key in group.keys]
    poses = () if mechanism.drives else ("pose",)
    known_keys(row, ("name", "exact", *keys, *poses), where)
    name = label(row, "name", f"{where}.")
    where = f"{where} ({shown(name)})"
    if "pose" in row:
        if len(row) > 2:
            raise InputError(
                f"{where}: pose and {', '.join(sorted(set(row) - {'name', 'pose'}))} given; give one of them"
            )
        found = mechanism.values_at(*read_pose(row["pose"], f"{where}.pose", mechanism.motion, mechanism.metric))
        return LockedValues(name, tuple(found[constraint] for constraint in mechanism.actuated))
    exact = truth(row, "exact", where)
    found_values = [value for group in groups for value in _group_values(row, where, mechanism, group, exact=exact)]
    values = tuple(value for value, _ in found_values)
    try:
        mechanism.locked(values, "values")
    except InputError as error:
        raise InputError(f"{where}: {error}") from None
    return LockedValues(name, values, tuple(stand_in for _, stand_in in found_values if stand_in is not None))


_Value: TypeAlias = tuple[JointValue, StandIn | None]


def _group_values(row: dict[str, Any], where: str, mechanism: Mechanism, group: Group, *, exact: bool) -> list[_Value]:
    given = [key for key in group.keys if key in row]
    if len(given) != 1:
        found = " and ".join(given) or "none of them"
        wanted = f"exactly one of {', '.join(group.keys)}" if len(group.keys) > 1 else group.keys[0]
        raise InputError(f"{where}: {found} given; give {wanted}")
    key = given[0]
    rows = list_field(row[key], f"{where}.{key}", len(group.names))
    if len(rows) != len(group.names):
        raise InputError(f"{where}.{key}: {len(rows)} values; give {len(group.names)}: {', '.join(group.names)}")
    return [
        _value(value, key.removeprefix(group.prefix), f"{where}.{key}[{i}]", mechanism, name, exact=exact)
        for i, (value, name) in enumerate(zip(rows, group.names, strict=True), 1)
    ]


def _value(value: object, key: str, where: str, mechanism: Mechanism, name: str, *, exact: bool) -> _Value:
    drive = mechanism.drive(name)
    if key in (Joint.LENGTH, "lengths_squared"):
        number = parse_positive(value, where)
        return (number * number if key == Joint.LENGTH else number), None
    if drive is None:
        return parse_rational(value, where), None
    if key == "cos_sin":
        return drive.parsed(value, where), None
    if key == "degrees":
        point, stand_in = angle_in_degrees(value, where, drive.weight, exact=exact)
        return point, None if stand_in is None else replace(stand_in, name=name)
    return drive.from_number(parse_rational(value, where)), None
