"""Joint paths: CSV files with one row of joint values per sample, read exactly.

One column per leg: lengths (``l1``, ``l2``, ..), slide positions (``q1``, ..) or half tangents of crank angles
(``h1``, ..; angles as ``30deg``), of a mechanism values of the actuated constraints under their names; and before
them, if there is one more, ``time``. A first line with these names may be left out. Blank lines and lines that begin
with # are skipped.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.angle_degrees import StandIn
from pkm_exact.geometry.chains import Crank
from pkm_exact.geometry.csv_fields import exact_number, header_names, is_header, numbered_rows, require_length
from pkm_exact.geometry.given_joints import crank_weights, half_tangent_on_path, joint_word
from pkm_exact.geometry.kinds import KINDS
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.robot import Robot
from pkm_exact.wording import printable, shown

MAX_BYTES: Final = 64 << 20
TIME: Final = "time"


@dataclass(frozen=True)
class JointPath:
    """A path in the joint values, straight between its rows.

    Attributes
    ----------
    rows : tuple of tuples of Fraction
        One value per leg.
    times : tuple of Fraction, or None
        Increasing; None if the file has no time.
    lines : tuple of int
        Where the rows stand in the file.
    stand_ins : tuple of StandIn or str
        Angles that were given in degrees and are taken as others, by how much; or sentences.
    """

    rows: tuple[tuple[Fraction, ...], ...]
    times: tuple[Fraction, ...] | None
    lines: tuple[int, ...]
    stand_ins: tuple[StandIn | str, ...] = field(default=(), repr=False, compare=False)


def joint_names(robot: Machine) -> tuple[str, ...]:
    """Names of the columns of joint values: of a mechanism those of its actuated constraints, in small letters."""
    if not isinstance(robot, Robot):
        names = tuple(name.lower() for name in robot.actuated)
        return names if len(set(names)) == len(names) else tuple(f"v{k}" for k in range(1, len(names) + 1))
    letter = "l" if not robot.chains else "h" if isinstance(robot.chains[0], Crank) else "q"
    return tuple(f"{letter}{leg}" for leg in range(1, KINDS[robot.kind].legs + 1))


def read_path(path: str | os.PathLike[str], robot: Machine) -> JointPath:
    """The path in a file, for a robot.

    Raises
    ------
    InputError
        With file, line, column, value and remedy.
    """
    name = os.fspath(path)
    try:
        return path_from_csv(path_text(name), robot)
    except InputError as error:
        raise InputError(f"{printable(name)}: {error}") from None


def path_text(name: str) -> str:
    """The text of a file of a path."""
    try:
        with Path(name).open("rb") as stream:
            data = stream.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise InputError(f"cannot be read ({reason}); give the path of a CSV file") from None
    if len(data) > MAX_BYTES:
        raise InputError(f"has more than {MAX_BYTES} bytes; cut the path in pieces")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"byte {error.start + 1} is not UTF-8 text; save the path as UTF-8") from None


def path_from_csv(text: str, robot: Machine) -> JointPath:
    """The path that the text of a CSV file describes.

    Examples
    --------
    >>> from pkm_exact.geometry.robot import Robot
    >>> corners = tuple(tuple(map(Fraction, joint)) for joint in ((0, 0), (4, 0), (2, 3)))
    >>> robot = Robot("example", "3-RPR", "m", "made up", corners, corners)
    >>> path_from_csv("time,l1,l2,l3\\n0,1,2,3\\n0.5,1,2,3.25\\n", robot).rows[1][2]
    Fraction(13, 4)
    """
    names = _path_names(robot)
    columns: tuple[str, ...] | None = None
    rows: list[tuple[Fraction, ...]] = []
    times: list[Fraction] = []
    lines: list[int] = []
    stand_ins: list[StandIn | str] = []
    weights = crank_weights(robot)
    for number, fields in numbered_rows(text):
        line = f"line {number}"
        if columns is None:
            columns = _columns(fields, names, line)
            if is_header(fields):
                continue
        if len(fields) != len(columns):
            raise InputError(f"{line}: {len(fields)} values; give {len(columns)}: {', '.join(columns)}")
        if columns[0] == TIME:
            times.append(_increasing(exact_number(fields.pop(0), f"{line}, {TIME}"), times, line))
        values = [
            (exact_number(cell, f"{line}, {name}"), None)
            if weight is None
            else half_tangent_on_path(joint_word(cell, f"{line}, {name}"), f"{line}, {name}", weight)
            for cell, name, weight in zip(fields, names, weights, strict=True)
        ]
        row = [value for value, _ in values]
        stand_ins += [note for _, note in values if note is not None]
        _require_lengths(row, names, line, robot)
        rows.append(tuple(row))
        lines.append(number)
    if columns is None or not rows:
        raise InputError(f"has no rows; give one row of {len(names)} values ({', '.join(names)}) per sample")
    return JointPath(tuple(rows), tuple(times) if columns[0] == TIME else None, tuple(lines), tuple(stand_ins))


def _path_names(robot: Machine) -> tuple[str, ...]:
    """Those of the joint values, of which the time can be told apart."""
    names = joint_names(robot)
    if not names:
        raise InputError(f"{shown(robot.name)} has no actuated constraints, so that nothing moves it; solve it instead")
    if TIME in names:
        raise InputError(f"a column {TIME} is that of the time; give the actuated constraint {TIME} another name")
    return names


def _columns(fields: list[str], names: tuple[str, ...], line: str) -> tuple[str, ...]:
    """The names of the columns, from a header or from their number."""
    with_time = (TIME, *names)
    if is_header(fields):
        return header_names(fields, (names, with_time), f"[{TIME},]{','.join(names)}", line)
    if len(fields) not in (len(names), len(with_time)):
        raise InputError(f"{line}: {len(fields)} values; give {len(names)} ({', '.join(names)}), or {TIME} before them")
    return names if len(fields) == len(names) else with_time


def _increasing(time: Fraction, before: list[Fraction], line: str) -> Fraction:
    if before and time <= before[-1]:
        raise InputError(f"{line}, {TIME}: {shown(time)} is not after {shown(before[-1])}; let time increase")
    return time


def _require_lengths(values: list[Fraction], names: tuple[str, ...], line: str, robot: Machine) -> None:
    for value, name, is_length in zip(values, names, robot.are_lengths, strict=True):
        if is_length:
            require_length(value, f"{line}, {name}")
