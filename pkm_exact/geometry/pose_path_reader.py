"""Paths of poses: CSV files with one pose a row, read exactly.

Columns x, y, z and roll, pitch, yaw in degrees, R = Rz(yaw) Ry(pitch) Rx(roll); or q0, q1, q2, q3 instead of the
angles, of any norm; x, y, theta if the robot is planar; and before them, if wanted, time. The first line names them.
All are ordinary coordinates. Between rows every column runs linearly (a quaternion is then normalised).
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.csv_fields import exact_number, is_header, numbered_rows
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.path_reader import TIME, path_text
from pkm_exact.wording import printable, shown

PLANAR: Final = ("x", "y", "theta")
ANGLES: Final = ("x", "y", "z", "roll", "pitch", "yaw")
QUATERNIONS: Final = ("x", "y", "z", "q0", "q1", "q2", "q3")


@dataclass(frozen=True)
class PosePath:
    """A path of poses.

    Attributes
    ----------
    columns : tuple of str
        Without the time.
    rows : tuple of tuples of Fraction
    times : tuple of Fraction, or None
    lines : tuple of int
        Where the rows stand in the file.
    """

    columns: tuple[str, ...]
    rows: tuple[tuple[Fraction, ...], ...]
    times: tuple[Fraction, ...] | None
    lines: tuple[int, ...]


def read_pose_path(path: str | os.PathLike[str], robot: Machine) -> PosePath | None:
    """The path of poses in a file; None if its first line does not name the columns of poses.

    Raises
    ------
    InputError
        With file, line, column, value and remedy.
    """
    name = os.fspath(path)
    try:
        return pose_path_from_csv(path_text(name), robot)
    except InputError as error:
        raise InputError(f"{printable(name)}: {error}") from None


def pose_path_from_csv(text: str, robot: Machine) -> PosePath | None:
    """The path of poses that a text describes, if it is one.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_robot
    >>> robot = read_robot("models/3-rpr-merlet-p.toml")
    >>> pose_path_from_csv("time,x,y,theta\\n0,5,5,0\\n1,5,5.5,10\\n", robot).rows[1]
    (Fraction(5, 1), Fraction(11, 2), Fraction(10, 1))
    >>> pose_path_from_csv("l1,l2,l3\\n7,5,5\\n", robot) is None
    True
    """
    found = list(numbered_rows(text))
    columns = _columns(found[0][1], robot, f"line {found[0][0]}") if found else None
    if columns is None:
        return None
    if len(found) < 3:
        raise InputError(f"has {len(found) - 1} rows; give two poses at least")
    rows = [_row(fields, columns, f"line {number}") for number, fields in found[1:]]
    lines = tuple(number for number, _ in found[1:])
    if columns[0] != TIME:
        return PosePath(columns, tuple(rows), None, lines)
    times = tuple(row[0] for row in rows)
    for number, (before, after) in zip(lines[1:], pairwise(times), strict=True):
        if after <= before:
            raise InputError(f"line {number}, {TIME}: {shown(after)} is not after {shown(before)}; let time increase")
    return PosePath(columns[1:], tuple(row[1:] for row in rows), times, lines)


def _row(fields: list[str], columns: tuple[str, ...], line: str) -> tuple[Fraction, ...]:
    if len(fields) != len(columns):
        raise InputError(f"{line}: {len(fields)} values; give {len(columns)}: {', '.join(columns)}")
    values = tuple(exact_number(field, f"{line}, {column}") for field, column in zip(fields, columns, strict=True))
    if "q0" in columns and not any(values[-4:]):
        raise InputError(f"{line}, q0: all four numbers are 0; give a quaternion")
    return values


def _columns(fields: list[str], robot: Machine, line: str) -> tuple[str, ...] | None:
    if not is_header(fields):
        return None
    names = tuple(field.lower() for field in fields)
    bare = names[1:] if names[:1] == (TIME,) else names
    choices = (PLANAR,) if robot.motion.is_planar else (ANGLES, QUATERNIONS, ANGLES[:3])
    if bare in choices and (bare != ANGLES[:3] or not set(robot.motion.twist) & {3, 4, 5}):
        return names
    if bare[:2] == ("x", "y") and not set(bare) & set(map(str.lower, robot.actuated)):
        wanted = " or ".join(f"[{TIME},]{','.join(choice)}" for choice in choices[:2])
        raise InputError(f"{line}: the columns are {shown(','.join(fields))}; name them {wanted}")
    return None
