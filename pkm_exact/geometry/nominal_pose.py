"""The pose in which a robot is meant to be: a table ``[nominal]`` of a model file, or words of the command line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Matrix, Metric, rotation_of
from pkm_exact.geometry.ordinary_pose import ordinary_position, ordinary_rotation
from pkm_exact.geometry.pose_reader import read_pose
from pkm_exact.geometry.rotation_degrees import checked_degrees, quaternion_of_angles
from pkm_exact.motions.motion import Motion

_WIDTH = Fraction(1, 1 << 80)
_ZERO = Fraction(0)


@dataclass(frozen=True)
class NominalPose:
    """Position and rotation matrix in ordinary coordinates, each number off by at most 2^-80.

    It only serves to say which of a robot's poses is the nearest.

    Attributes
    ----------
    position : tuple of 3 Fraction
    rotation : 3 x 3 of Fraction
    """

    position: Vector
    rotation: Matrix


def read_nominal(table: object, motion: Motion, metric: Metric) -> NominalPose:
    """The pose of the table ``[nominal]``, in the coordinates of the file.

    Raises
    ------
    InputError
        If it is no pose of the motion.

    Examples
    --------
    >>> from pkm_exact.motions.motion_groups import SPATIAL
    >>> found = read_nominal({"position": [0, 1, 0], "rpy_degrees": [0, 0, 90]}, SPATIAL, (1, 1, 1))
    >>> [str(x) for x in found.rotation[0]]
    ['0', '-1', '0']
    """
    position, rotation = read_pose(table, "nominal", motion, metric)
    x, y, z = (surd.enclosure(_WIDTH)[0] for surd in ordinary_position(position, metric))
    rows = [[surd.enclosure(_WIDTH)[0] for surd in row] for row in ordinary_rotation(rotation, metric)]
    return NominalPose((x, y, z), _matrix(rows))


def nominal_from_numbers(numbers: Sequence[Fraction], where: str, motion: Motion) -> NominalPose:
    """The pose of numbers in ordinary coordinates.

    Parameters
    ----------
    numbers : sequence of Fraction
        Position with roll, pitch and yaw in degrees (6), with a quaternion of any norm (7), or with a matrix
        that is nearly a rotation (12); in the plane x, y and degrees.
    where : str
        How messages call them.

    Raises
    ------
    InputError
        If there are not as many as that, or the quaternion is 0.

    Examples
    --------
    >>> from pkm_exact.motions.motion_groups import PLANAR
    >>> [str(x) for x in nominal_from_numbers([Fraction(n) for n in (1, 2, 90)], "--near", PLANAR).rotation[0]]
    ['0', '-1', '0']
    """
    if motion.is_planar and len(numbers) == 3:
        angle = checked_degrees(numbers[2], where)
        return NominalPose((numbers[0], numbers[1], _ZERO), rotation_of(quaternion_of_angles(_ZERO, _ZERO, angle)))
    if motion.is_planar or len(numbers) not in (6, 7, 12):
        turns = "ROLL,PITCH,YAW in degrees, or X,Y,Z and a quaternion or a matrix row by row"
        wanted = "X,Y,DEGREES" if motion.is_planar else f"X,Y,Z and {turns}"
        raise InputError(f"{where}: {len(numbers)} numbers; give {wanted}")
    x, y, z, *turn = numbers
    if len(turn) == 3:
        roll, pitch, yaw = (checked_degrees(angle, where) for angle in turn)
        return NominalPose((x, y, z), rotation_of(quaternion_of_angles(roll, pitch, yaw)))
    if len(turn) == 9:
        from pkm_exact.geometry.nearest_rotation import nearest_rotation

        return NominalPose((x, y, z), rotation_of(nearest_rotation((turn[:3], turn[3:6], turn[6:]), where)[0]))
    e0, e1, e2, e3 = turn
    if not any(turn):
        raise InputError(f"{where}: all four numbers of the quaternion are 0; give one that is not")
    return NominalPose((x, y, z), rotation_of((e0, e1, e2, e3)))


def _matrix(rows: Sequence[Sequence[Fraction]]) -> Matrix:
    first, second, third = ((row[0], row[1], row[2]) for row in rows)
    return first, second, third
