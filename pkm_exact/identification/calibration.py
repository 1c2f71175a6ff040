"""Calibration of a robot with legs: which errors of joints and lengths measured poses show.

At a measured pose leg i says |C + R B - A|^2 = (l + o)^2, o the offset of its length. The derivative by A is -2 (C + R
B - A), by B it is 2 R^T (C + R B - A), by o it is -2 l: seven parameters a leg, and one measurement of each leg at each
pose.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import isqrt

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Matrix, distance_squared
from pkm_exact.geometry.robot import Robot
from pkm_exact.screws.exact_matrix import Row

Pose = tuple[Vector, Matrix]


def calibration_parameters(robot: Robot, *, offsets: bool) -> tuple[str, ...]:
    """Names: A1x, A1y, .. of base joints, B1x, .. of platform joints, offset 1, .. of lengths; leg by leg.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_robot
    >>> calibration_parameters(read_robot("models/3-rpr-merlet-p.toml"), offsets=True)[:5]
    ('A1x', 'A1y', 'B1x', 'B1y', 'offset 1')
    """
    axes = "xy" if robot.motion.is_planar else "xyz"
    return tuple(
        name
        for leg in range(1, len(robot.base_joints) + 1)
        for name in (
            *(f"{side}{leg}{axis}" for side in "AB" for axis in axes),
            *([f"offset {leg}"] if offsets else []),
        )
    )


def calibration_rows(robot: Robot, pose: Pose, *, offsets: bool) -> tuple[Row, ...]:
    """The derivatives of the legs at a pose by the parameters, a row for each leg.

    Parameters
    ----------
    robot : Robot
        With legs that are actuated themselves, in the metric (1, 1, 1).
    pose : tuple
        Position and rotation matrix.
    offsets : bool
        Whether lengths have offsets; then all legs must have rational lengths at the pose.

    Raises
    ------
    InputError
        If the robot is another, or a length is not rational.

    Examples
    --------
    >>> from pkm_exact.geometry.inverse import rotation_of
    >>> from pkm_exact.geometry.reader import read_robot
    >>> one, zero = Fraction(1), Fraction(0)
    >>> pose = (Fraction(5), Fraction(9, 2), zero), rotation_of((one, zero, zero, zero))
    >>> rows = calibration_rows(read_robot("models/3-rpr-merlet-p.toml"), pose, offsets=False)
    >>> [str(x) for x in rows[0][:4]]
    ['-10', '-9', '10', '9']
    """
    if robot.chains or set(robot.metric) != {1}:
        raise InputError("robot: calibration is of robots with actuated legs in the metric (1, 1, 1); give one")
    size = 2 if robot.motion.is_planar else 3
    width = 2 * size + int(offsets)
    rows = []
    for leg, (a, b) in enumerate(zip(robot.base_joints, robot.platform_joints, strict=True)):
        length = _length(distance_squared(a, b, *pose), leg + 1) if offsets else None
        row = [Fraction(0)] * (width * len(robot.base_joints))
        row[width * leg : width * (leg + 1)] = leg_row(robot, pose, leg, length)
        rows.append(tuple(row))
    return tuple(rows)


def leg_row(robot: Robot, pose: Pose, leg: int, length: Fraction | None) -> Row:
    """The derivatives of one leg at a pose by its own parameters, the offset among them if a length is given.

    Examples
    --------
    >>> from pkm_exact.geometry.inverse import rotation_of
    >>> from pkm_exact.geometry.reader import read_robot
    >>> one, zero = Fraction(1), Fraction(0)
    >>> pose = (Fraction(5), Fraction(9, 2), zero), rotation_of((one, zero, zero, zero))
    >>> [str(x) for x in leg_row(read_robot("models/3-rpr-merlet-p.toml"), pose, 0, Fraction(7))]
    ['-10', '-9', '10', '9', '-14']
    """
    position, rotation = pose
    a, b = robot.base_joints[leg], robot.platform_joints[leg]
    size = 2 if robot.motion.is_planar else 3
    arm = [
        c + sum((r * x for r, x in zip(row, b, strict=True)), Fraction(0)) - y
        for c, row, y in zip(position, rotation, a, strict=True)
    ]
    turned = [sum((rotation[i][j] * arm[i] for i in range(3)), Fraction(0)) for j in range(3)]
    return (*(-2 * x for x in arm[:size]), *(2 * x for x in turned[:size]), *([] if length is None else [-2 * length]))


def _length(square: Fraction, leg: int) -> Fraction:
    root = Fraction(isqrt(square.numerator), isqrt(square.denominator))
    if root * root != square:
        raise InputError(f"pose: leg {leg} has the length sqrt({square}), not rational; take another, or offsets=False")
    return root


def observation(robot: Robot, poses: Sequence[Pose], *, offsets: bool) -> list[tuple[Row, ...]]:
    """The rows of each pose of a measurement plan, for ``identify`` and ``minimal_plan``."""
    return [calibration_rows(robot, pose, offsets=offsets) for pose in poses]
