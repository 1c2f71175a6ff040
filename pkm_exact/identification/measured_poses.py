"""Measured poses with the leg lengths that were read there: CSV files, and what they say of joints and lengths."""

from __future__ import annotations

import os
from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.csv_fields import exact_number, header_names, numbered_rows, require_length
from pkm_exact.geometry.inverse import Matrix
from pkm_exact.geometry.nominal_pose import nominal_from_numbers
from pkm_exact.geometry.path_reader import path_text
from pkm_exact.geometry.pose_path_reader import ANGLES, PLANAR, QUATERNIONS
from pkm_exact.geometry.robot import Robot
from pkm_exact.identification.calibration import calibration_parameters, leg_row
from pkm_exact.identification.observation import Identification, identify
from pkm_exact.wording import printable

MOST_POSES = 2000


@dataclass(frozen=True)
class MeasuredPose:
    """A pose, and the lengths that the legs had by their own sensors.

    Attributes
    ----------
    position : vector of 3 Fraction
    rotation : 3 x 3 of Fraction
    lengths : tuple of Fraction
    line : int
        Of the file.
    """

    position: Vector
    rotation: Matrix
    lengths: tuple[Fraction, ...]
    line: int


def read_measured_poses(path: str | os.PathLike[str], robot: Robot) -> tuple[MeasuredPose, ...]:
    """The rows of a CSV file: x, y, z, roll, pitch, yaw (degrees) or q0, .., q3, and l1, l2, ..; x, y, theta if planar.

    Raises
    ------
    InputError
        With file, line, column, value and remedy.
    """
    name = os.fspath(path)
    try:
        return measured_poses_from_csv(path_text(name), robot)
    except InputError as error:
        raise InputError(f"{printable(name)}: {error}") from None


def measured_poses_from_csv(text: str, robot: Robot) -> tuple[MeasuredPose, ...]:
    """The measured poses that a text describes.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_robot
    >>> robot = read_robot("models/3-rpr-merlet-p.toml")
    >>> found = measured_poses_from_csv("x,y,theta,l1,l2,l3\\n5,4.5,0,6.7,5,5\\n", robot)
    >>> [str(x) for x in (*found[0].position, *found[0].lengths)]
    ['5', '9/2', '0', '67/10', '5', '5']
    """
    found = list(numbered_rows(text))
    legs = tuple(f"l{leg}" for leg in range(1, len(robot.base_joints) + 1))
    poses = (PLANAR,) if robot.motion.is_planar else (ANGLES, QUATERNIONS)
    wanted = " or ".join(",".join((*pose, *legs)) for pose in poses)
    if len(found) < 2:
        raise InputError(f"has no row of numbers; give a header {wanted}, and a row for each measured pose")
    if len(found) - 1 > MOST_POSES:
        raise InputError(f"has {len(found) - 1} rows; give {MOST_POSES} at most")
    choices = [(*pose, *legs) for pose in poses]
    columns = header_names(found[0][1], choices, wanted, f"line {found[0][0]}")
    return tuple(_measured(fields, columns, line, robot) for line, fields in found[1:])


def _measured(fields: list[str], columns: tuple[str, ...], line: int, robot: Robot) -> MeasuredPose:
    where = f"line {line}"
    if len(fields) != len(columns):
        raise InputError(f"{where}: {len(fields)} values; give {len(columns)}: {', '.join(columns)}")
    values = [exact_number(field, f"{where}, {name}") for field, name in zip(fields, columns, strict=True)]
    count = len(robot.base_joints)
    for value, name in zip(values[-count:], columns[-count:], strict=True):
        require_length(value, f"{where}, {name}")
    pose = nominal_from_numbers(values[:-count], where, robot.motion)
    return MeasuredPose(pose.position, pose.rotation, tuple(values[-count:]), line)


def identifiable(robot: Robot, measured: tuple[MeasuredPose, ...], *, offsets: bool) -> tuple[Identification, ...]:
    """For each leg, which of its parameters these measurements determine, to first order at the model: exact ranks.

    The rows are those of the model at the poses as written, and of the lengths as written: an angle in degrees stands
    for a rational rotation next to it.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_robot
    >>> robot = read_robot("models/3-rpr-merlet-p.toml")
    >>> found = measured_poses_from_csv("x,y,theta,l1,l2,l3\\n5,4.5,0,6.7,5,5\\n5,5,0,7,5,5\\n", robot)
    >>> leg = identifiable(robot, found, offsets=False)[0]
    >>> leg.rank, leg.confused()[0]
    (2, 'nothing shows a change of A1x by 1, B1x by 1')
    """
    names = calibration_parameters(robot, offsets=offsets)
    size = len(names) // len(robot.base_joints)
    legs = []
    for leg in range(len(robot.base_joints)):
        rows = [leg_row(robot, (m.position, m.rotation), leg, m.lengths[leg] if offsets else None) for m in measured]
        legs.append(identify(rows, names[size * leg : size * (leg + 1)]))
    return tuple(legs)
