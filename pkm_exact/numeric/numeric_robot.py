"""A robot in floating point, and its poses in the coordinates in which iterations run.

All in ordinary coordinates. Joints are taken relative to the centroids of base and platform and divided by a unit, a
power of two, both exactly and before anything is rounded: numbers of any size become numbers of size 1, and a robot far
from its origin loses no digits. In these coordinates a pose is (c, q), with c the vector between the centroids and q
the unit quaternion of the platform's rotation.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import copysign, isfinite, sqrt
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion import Motion
from pkm_exact.numeric.quaternions import rotation_matrix
from pkm_exact.numeric.uncertified import Ending, NumericPose, Point, Quaternion

Real: TypeAlias = NDArray[np.float64]

GREATEST: Final = 10**100
"""Coordinates and lengths beyond it, and robots smaller than its inverse, are left to the exact engine."""
FARTHEST: Final = 1e6
"""Distance of a start from the base, in times the size of the robot, beyond which it is a mistake."""


@dataclass(frozen=True, eq=False)
class NumericRobot:
    """A locked robot in floating point, made once for any number of starts.

    Attributes
    ----------
    base, platform : (3, n) array
        Joints in the columns, relative to their centroids, in units of ``unit``.
    lengths : (n,) array
        Leg lengths, in units of ``unit``.
    base_centre, platform_centre : (3,) array
        The centroids, in the robot's unit of length.
    unit : float
        A power of two; no coordinate or length is greater than it.
    motion : Motion
    """

    base: Real
    platform: Real
    lengths: Real
    base_centre: Real
    platform_centre: Real
    unit: float
    motion: Motion


@dataclass(frozen=True)
class StartPose:
    """Where an iteration starts: position in the robot's unit of length, and a quaternion of any norm but 0."""

    position: Point
    quaternion: Quaternion


def numeric_robot(problem: ForwardProblem) -> NumericRobot:
    """The robot of an exact problem, every number rounded once.

    Raises
    ------
    InputError
        If a number is out of reach of floating point.

    Examples
    --------
    >>> from pkm_exact.constraints.distance import Distance
    >>> from pkm_exact.motions.motion_groups import PLANAR
    >>> corners = [(Fraction(x), Fraction(y), Fraction(0)) for x, y in ((0, 0), (4, 0), (2, 3))]
    >>> robot = numeric_robot(ForwardProblem(tuple(Distance(a, a, Fraction(9)) for a in corners), motion=PLANAR))
    >>> robot.unit, robot.lengths.tolist(), robot.base_centre.tolist()
    (4.0, [0.75, 0.75, 0.75], [2.0, 1.0, 0.0])
    """
    base = [leg.base for leg in problem.gough_legs]
    _require_moderate(problem)
    platform = [leg.platform for leg in problem.distances]
    centres = _centroid(base), _centroid(platform)
    squares = [leg.length_squared for leg in problem.distances]
    for joints, centre in zip((base, platform), centres, strict=True):
        squares += [g * (x - m) ** 2 for joint in joints for g, x, m in zip(problem.metric, joint, centre, strict=True)]
    unit = _unit(max(squares))
    scales = np.sqrt(np.array(problem.metric, dtype=float))
    return NumericRobot(
        base=_columns(base, centres[0], problem.metric, unit),
        platform=_columns(platform, centres[1], problem.metric, unit),
        lengths=np.array([sqrt(leg.length_squared / unit**2) for leg in problem.distances]),
        base_centre=scales * [float(x) for x in centres[0]],
        platform_centre=scales * [float(x) for x in centres[1]],
        unit=float(unit),
        motion=problem.motion,
    )


def _require_moderate(problem: ForwardProblem) -> None:
    numbers = [abs(x) for leg in problem.distances for x in (*leg.base, *leg.platform)]
    numbers += [Fraction(g) for g in problem.metric]
    longest = max(leg.length_squared for leg in problem.distances)
    if max(numbers) > GREATEST or not Fraction(1, GREATEST**2) < longest < GREATEST**2:
        raise InputError(
            "coordinates or lengths are out of reach of floating point (10^-100 to 10^100); leave them to the method "
            "exact, without a time limit"
        )


def _centroid(joints: Sequence[Vector]) -> Vector:
    x, y, z = (sum(axis, Fraction(0)) / len(joints) for axis in zip(*joints, strict=True))
    return x, y, z


def _unit(square: Fraction) -> Fraction:
    """A power of two that is no less than the square root."""
    half, odd = divmod(square.numerator.bit_length() - square.denominator.bit_length() + 1, 2)
    unit = Fraction(2) ** (half + odd)
    return unit / 2 if unit * unit >= 4 * square else unit


def _columns(joints: Sequence[Vector], centre: Vector, metric: Sequence[int], unit: Fraction) -> Real:
    rows = [
        [copysign(sqrt(g * ((x - m) / unit) ** 2), x - m) for x, m, g in zip(joint, centre, metric, strict=True)]
        for joint in joints
    ]
    return np.array(rows).T.copy()


def centred(robot: NumericRobot, start: StartPose) -> tuple[Real, Quaternion]:
    """The start as (c, q), q of norm 1.

    Raises
    ------
    InputError
        If the start is no pose, far off, or out of the plane of a planar robot.
    """
    if not all(map(isfinite, (*start.position, *start.quaternion))):
        raise InputError("start: a number is not finite; give seven numbers")
    largest = max(map(abs, start.quaternion))
    if largest == 0:
        raise InputError("start: all four numbers of the quaternion are 0; give one that is not")
    if robot.motion.is_planar and (start.position[2], *start.quaternion[1:3]) != (0, 0, 0):
        raise InputError("start: leaves the plane of a planar robot; give z, q1 and q2 as 0")
    far = max(abs(x - m) for x, m in zip(start.position, robot.base_centre, strict=True))
    if far > FARTHEST * (robot.unit + float(abs(robot.platform_centre).max())):
        raise InputError("start: the position is over a million times the robot's size away; give one nearby")
    q0, q1, q2, q3 = (value / largest for value in start.quaternion)
    norm = sqrt(q0 * q0 + q1 * q1 + q2 * q2 + q3 * q3)
    quaternion = q0 / norm, q1 / norm, q2 / norm, q3 / norm
    moved = np.array(start.position) + rotation_matrix(quaternion) @ robot.platform_centre - robot.base_centre
    return moved / robot.unit, quaternion


def placed(robot: NumericRobot, c: Real, quaternion: Quaternion) -> tuple[Point, Real]:
    """Position, in the robot's unit of length, and rotation matrix of the pose (c, q)."""
    rotation = rotation_matrix(quaternion)
    x, y, z = (robot.base_centre + robot.unit * c - rotation @ robot.platform_centre + 0.0).tolist()
    return (x, y, z), rotation


def numeric_pose(robot: NumericRobot, c: Real, quaternion: Quaternion, ending: Ending, iterations: int) -> NumericPose:
    """The place (c, q) as it is returned; the residual is computed from it."""
    position, rotation = placed(robot, c, quaternion)
    lines = rotation @ robot.platform + c[:, None] - robot.base
    residual = float(abs(np.sqrt((lines * lines).sum(axis=0)) - robot.lengths).max())
    rows: list[Point] = [(x, y, z) for x, y, z in (rotation + 0.0).tolist()]  # no negative zeros
    sign = -1.0 if quaternion[0] < 0 else 1.0
    q0, q1, q2, q3 = (sign * float(value) + 0.0 for value in quaternion)
    return NumericPose(
        ending, position, (rows[0], rows[1], rows[2]), (q0, q1, q2, q3), iterations, residual * robot.unit
    )
