"""Model files: robots as TOML, read exactly. Every defect gives one sentence that names file, field, value and remedy.

Numbers are TOML integers, TOML decimals (kept as written, never as binary floats) or strings ``"p"``, ``"p/q"`` and
``"1.25"``. Nothing in a file is evaluated, and sizes are bounded before anything is parsed.
"""

from __future__ import annotations

import os
import re
import tomllib
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import distance_squared, rotation_of
from pkm_exact.geometry.kinds import Joints
from pkm_exact.geometry.rational import (
    MAX_COMPUTED_DIGITS,
    MAX_DIGITS,
    NumberText,
    bounded,
    parse_positive,
    parse_rational,
    parse_vector,
)
from pkm_exact.geometry.robot import LEGS, Configuration, Robot, parse_joints, parse_metric
from pkm_exact.wording import printable, shown

__all__ = ["parse_rational", "read_robot", "robot_from_toml"]

SCHEMA: Final = 1
MAX_BYTES: Final = 1 << 16
"""Largest model file: a few hundred numbers of the largest size."""

_MAX_RUN: Final = 640  # digits in a row; below every limit that Python can be set to
_MAX_DOTS: Final = 200  # dots in a line; the parser's time grows steeply with the parts of a dotted key
_MAX_TEXT: Final = 2000
_TOP: Final = ("schema", "name", "kind", "unit", "source", "metric", "base", "platform", "configurations")
_CONFIGURATION: Final = ("name", "lengths", "lengths_squared", "pose")


def read_robot(path: str | os.PathLike[str]) -> Robot:
    """The robot that a model file describes.

    Raises
    ------
    InputError
        If the file cannot be read or does not describe a robot; the message is one sentence that starts with the path.
    """
    name = os.fspath(path)
    try:
        return robot_from_toml(_text(_bytes(name)))
    except InputError as error:
        raise InputError(f"{printable(name)}: {error}") from None


def robot_from_toml(text: str) -> Robot:
    """The robot that the text of a model file describes."""
    table = _parse(text)
    _known_keys(table, _TOP, "")
    schema = _required(table, "schema", "")
    if isinstance(schema, bool) or schema != SCHEMA:
        raise InputError(f"schema: {shown(schema)} is unknown; write schema = {SCHEMA}")
    geometry: dict[str, Any] = {
        "name": _label(table, "name", ""),
        "kind": _label(table, "kind", ""),
        "unit": _label(table, "unit", ""),
        "source": _label(table, "source", "", limit=_MAX_TEXT),
        "base_joints": _joint_table(table, "base"),
        "platform_joints": _joint_table(table, "platform"),
    }
    if "metric" in table:
        geometry["metric"] = parse_metric(table["metric"])
    rows = table.get("configurations", [])
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise InputError(f"configurations: {shown(rows)} is not a list of tables; write [[configurations]] above each")
    robot = Robot(**geometry)
    configurations = tuple(_configuration(row, f"configurations[{i}]", robot) for i, row in enumerate(rows, 1))
    return replace(robot, configurations=configurations)


def _bytes(name: str) -> bytes:
    try:
        with Path(name).open("rb") as stream:
            data = stream.read(16 * MAX_BYTES)
    except FileNotFoundError:
        raise InputError("no such file; give the path of a model file") from None
    except IsADirectoryError:
        raise InputError("is a directory; give the path of a model file") from None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise InputError(f"cannot be read ({reason}); give the path of a readable model file") from None
    return data


def _text(data: bytes) -> str:
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise InputError(f"byte {error.start + 1} is not UTF-8 text; save the model file as UTF-8") from None
    return text.replace("\r\n", "\n")


def _parse(text: str) -> dict[str, Any]:
    """The TOML tables of a text whose size, digits and nesting are bounded first."""
    for number, line in enumerate(text.split("\n"), 1):
        if run := re.search(rf"[0-9_]{{{_MAX_RUN},}}", line):
            key = re.match(r"\s*([A-Za-z0-9_-]{1,40})\s*=", line)
            field = f"line {number} ({key[1]})" if key else f"line {number}"
            value = f"{run[0][:20]}... ({len(run[0])} digits)"
            raise InputError(f"{field}: {value} is too long a number; use at most {MAX_DIGITS} digits")
        if line.count(".") > _MAX_DOTS:
            raise InputError(f"line {number}: more than {_MAX_DOTS} dots in one line; use one line per joint")
    if len(text) > MAX_BYTES:
        raise InputError(f"the file has more than {MAX_BYTES} characters; a model file must be smaller")
    try:
        return tomllib.loads(text, parse_float=NumberText)
    except RecursionError:
        raise InputError("brackets are nested too deeply; a model file needs at most three levels") from None
    except ValueError as error:
        raise InputError(f"not valid TOML: {printable(str(error))[:200]}; correct the file") from None


def _known_keys(table: dict[str, Any], known: tuple[str, ...], prefix: str) -> None:
    for key in table:
        if key not in known:
            raise InputError(
                f"{prefix or 'top level'}: unknown key {shown(key)}; the known keys are: {', '.join(known)}"
            )


def _required(table: dict[str, Any], key: str, prefix: str) -> Any:
    if key not in table:
        raise InputError(f"{prefix}{key}: is missing; add it (see the model format in the documentation)")
    return table[key]


def _label(table: dict[str, Any], key: str, prefix: str, *, limit: int = 200) -> str:
    value = _required(table, key, prefix)
    if isinstance(value, NumberText) or not isinstance(value, str):
        raise InputError(f'{prefix}{key}: {shown(value)} is not text; write it in quotes, such as {key} = "..."')
    if not value.strip() or not value.isprintable() or len(value) > limit:
        raise InputError(f"{prefix}{key}: {shown(value)} is not a label; write 1 to {limit} printable characters")
    return value


def _joint_table(table: dict[str, Any], key: str) -> Joints:
    value = _required(table, key, "")
    if not isinstance(value, dict):
        raise InputError(f"{key}: {shown(value)} is not a table; write [{key}] and joints = [...] below it")
    _known_keys(value, ("joints",), key)
    rows = _list(_required(value, "joints", f"{key}."), f"{key}.joints", LEGS)
    return parse_joints(rows, f"{key}.joints")


def _list(value: object, where: str, length: int) -> list[Any]:
    if not isinstance(value, list):
        raise InputError(f"{where}: {shown(value)} is not a list; give a list of {length}")
    return value


def _configuration(row: dict[str, Any], where: str, robot: Robot) -> Configuration:
    _known_keys(row, _CONFIGURATION, where)
    name = _label(row, "name", f"{where}.")
    given = [key for key in _CONFIGURATION[1:] if key in row]
    if len(given) != 1:
        found = " and ".join(given) or "none of them"
        raise InputError(f"{where} ({shown(name)}): {found} given; give exactly one of lengths, lengths_squared, pose")
    key = given[0]
    field = f"{where}.{key}"
    if key == "pose":
        return Configuration(name, _lengths_squared_at(row[key], field, robot))
    values = _list(row[key], field, LEGS)
    if len(values) != LEGS:
        raise InputError(f"{field}: {len(values)} values; give {LEGS}, one per leg")
    numbers = [parse_positive(value, f"{field}[{i}]") for i, value in enumerate(values, 1)]
    return Configuration(name, tuple(n * n if key == "lengths" else n for n in numbers))


def _lengths_squared_at(pose: object, where: str, robot: Robot) -> tuple[Fraction, ...]:
    if not isinstance(pose, dict):
        raise InputError(f"{where}: {shown(pose)} is not a table; write {{ position = [...], quaternion = [...] }}")
    _known_keys(pose, ("position", "quaternion"), where)
    position = parse_vector(_required(pose, "position", f"{where}."), f"{where}.position")
    row = _list(_required(pose, "quaternion", f"{where}."), f"{where}.quaternion", 4)
    if len(row) != 4:
        raise InputError(f"{where}.quaternion: {len(row)} numbers; give 4, scalar first")
    e0, e1, e2, e3 = (parse_rational(e, f"{where}.quaternion[{i}]") for i, e in enumerate(row, 1))
    if not any((e0, e1, e2, e3)):
        raise InputError(f"{where}.quaternion: all four numbers are 0; give one that is not")
    turn = rotation_of((e0, e1, e2, e3), robot.metric)
    squares = []
    for leg, (a, b) in enumerate(zip(robot.base_joints, robot.platform_joints, strict=True), 1):
        square = distance_squared(a, b, position, turn, robot.metric)
        if square == 0:
            raise InputError(f"{where}: leg {leg} has length 0 at this pose; give another pose")
        squares.append(bounded(square, square, f"{where}: the squared length of leg {leg}", MAX_COMPUTED_DIGITS))
    return tuple(squares)
