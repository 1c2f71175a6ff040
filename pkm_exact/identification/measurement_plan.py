"""Measurement plans: CSV files with one pose a row, and joint values where the pose does not tell them. Read exactly.

The first line names the columns: x, y, z and q0, q1, q2, q3, or roll, pitch, yaw in degrees; x, y and half_tangent or
degrees if the machine is planar; what its motions have in common may be left out. Then the slides by their names, and
of cranks the half tangents. Poses are in the coordinates of the model file.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.csv_fields import exact_number, is_header, numbered_rows
from pkm_exact.geometry.pose_reader import read_pose
from pkm_exact.identification.constraint_calibration import Pose, as_mechanism
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from pkm_exact.geometry.chains import JointValue
    from pkm_exact.geometry.mechanism import Mechanism
    from pkm_exact.geometry.robot import Robot

MOST_POSES: Final = 200
_POSITION: Final = ("x", "y", "z")
_TURNS: Final[Mapping[str, tuple[str, ...]]] = {
    "quaternion": ("q0", "q1", "q2", "q3"),
    "rpy_degrees": ("roll", "pitch", "yaw"),
}
_PLANAR_TURNS: Final = ("half_tangent", "degrees")


@dataclass(frozen=True)
class Measured:
    """A pose at which the machine is measured.

    Attributes
    ----------
    pose : tuple
        Position and rotation matrix.
    values : mapping
        Of drives, by their names.
    """

    pose: Pose
    values: Mapping[str, JointValue]


def plan_from_csv(text: str, machine: Robot | Mechanism) -> tuple[Measured, ...]:
    """The poses of a plan.

    Raises
    ------
    InputError
        With line, column, value and remedy.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_robot
    >>> plan = plan_from_csv("x,y,half_tangent,crank 1\\n5,4,1/3,1/2\\n", read_robot("models/3-rrr.toml"))
    >>> [str(x) for x in plan[0].pose[0]], [str(x) for x in plan[0].values["crank 1"]]
    (['5', '4', '0'], ['3/5', '4/5'])
    """
    mechanism = as_mechanism(machine)
    found = list(numbered_rows(text))
    if len(found) < 2 or not is_header(found[0][1]):
        raise InputError("has no poses; give a line that names the columns, and one line for each pose")
    if len(found) > MOST_POSES + 1:
        raise InputError(f"has {len(found) - 1} poses; give at most {MOST_POSES}")
    columns = _columns(found[0][1], mechanism, f"line {found[0][0]}")
    return tuple(_measured(fields, columns, mechanism, f"line {number}") for number, fields in found[1:])


def _columns(fields: list[str], mechanism: Mechanism, line: str) -> tuple[str, ...]:
    turns = _PLANAR_TURNS if mechanism.motion.is_planar else tuple(name for names in _TURNS.values() for name in names)
    position = _POSITION[:2] if mechanism.motion.is_planar else _POSITION
    known = (*position, *turns, *(drive.name for drive in mechanism.drives))
    for place, field in enumerate(fields):
        if field not in known:
            raise InputError(f"{line}: column {shown(field)} is unknown; the columns are: {', '.join(known)}")
        if field in fields[:place]:
            raise InputError(f"{line}: two columns are called {shown(field)}; name each once")
    return tuple(fields)


def _measured(fields: list[str], columns: tuple[str, ...], mechanism: Mechanism, line: str) -> Measured:
    if len(fields) != len(columns):
        raise InputError(f"{line}: {len(fields)} values; give {len(columns)}: {', '.join(columns)}")
    found = {c: exact_number(field, f"{line}, {c}") for c, field in zip(columns, fields, strict=True)}
    values: dict[str, JointValue] = {}
    for drive in mechanism.drives:
        if drive.name in found:
            values[drive.name] = drive.from_number(found[drive.name])
    return Measured(read_pose(_pose_table(found, mechanism, line), line, mechanism.motion, mechanism.metric), values)


def _pose_table(found: Mapping[str, Fraction], mechanism: Mechanism, line: str) -> dict[str, Any]:
    """The pose as a model file has it."""
    table: dict[str, Any] = {}
    groups: dict[str, tuple[str, ...]] = {"position": _POSITION[:2] if mechanism.motion.is_planar else _POSITION}
    if mechanism.motion.is_planar:
        table |= {key: found[key] for key in _PLANAR_TURNS if key in found}
    else:
        groups |= _TURNS
    for key, names in groups.items():
        given = [name for name in names if name in found]
        if given and len(given) < len(names):
            raise InputError(f"{line}: only {', '.join(given)} given; give {', '.join(names)}")
        if given:
            table[key] = [found[name] for name in names]
    return table
