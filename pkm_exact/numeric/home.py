"""Poses from which iterations start: one that needs no knowledge of the robot, and random ones.

A sum over the legs connects the two parts of a pose. With joints A_i and B_i relative to their centroids, and c the
vector between the centroids,

    mean l_i^2 = |c|^2 + mean |R B_i - A_i|^2                                                                     (1)

so that the rotation gives the distance of the centroids. All starts satisfy (1) if they can.
"""

from __future__ import annotations

from math import acos, atan2, copysign, cos, hypot, sin, sqrt
from typing import Final

import numpy as np

from pkm_exact.numeric.numeric_machine import NumericMachine, Real, StartPose, placed
from pkm_exact.numeric.numeric_mechanism import NumericMechanism
from pkm_exact.numeric.numeric_robot import NumericRobot
from pkm_exact.numeric.quaternions import rotation_matrix
from pkm_exact.numeric.uncertified import Quaternion

NOTHING: Final = 1e-9
"""What is smaller, on a robot of size 1, is taken for 0 when a start is chosen."""


def random_states(machine: NumericMachine, count: int, seed: int) -> tuple[Real, Real]:
    """``count`` poses (c, q) as arrays (m, 3) and (4, m): rotations uniform, directions of c too, |c| by (1).

    Where (1) has no solution for a rotation, or no constraint is a leg, c is 0 or of about the size of the machine. The
    same seed gives the same poses, the first ones whatever the count.
    """
    c, quaternions = np.zeros((count, 3)), np.zeros((4, count))
    generator = np.random.default_rng(seed)
    twist = machine.motion.twist
    moving = (0, *(axis - 2 for axis in twist if axis > 2)), tuple(axis for axis in twist if axis < 3)
    for index in range(count):
        for target, axes in zip((quaternions[:, index], c[index]), moving, strict=True):
            if axes:
                values = generator.standard_normal(len(axes))
                target[list(axes)] = values / np.linalg.norm(values)
    rotations = rotation_matrix(tuple(quaternions))
    if isinstance(machine, NumericRobot):
        c *= np.sqrt(np.maximum(distance_squared(machine, rotations), 0))[:, None]
    elif isinstance(machine, NumericMechanism):
        c *= np.array([_reach(machine, *state) for state in zip(rotations, c, strict=True)])[:, None]
    return c, quaternions


def _reach(machine: NumericMechanism, rotation: Real, direction: Real) -> float:
    """How far the platform is in a direction if (1) holds for those constraints that are legs; 1 if there are none.

    Where it cannot hold, half a mean length of the legs.
    """
    if not len(machine.lengths):
        return 1.0
    base, platform = machine.legs
    apart = rotation @ platform - base
    along = float(direction @ apart.mean(axis=1))
    square, legs = float((apart * apart).sum(axis=0).mean()), float(np.mean(machine.lengths**2))
    root = along * along - square + legs
    return sqrt(root) - along if root >= NOTHING else sqrt(legs) / 2


def distance_squared(robot: NumericRobot, rotation: Real) -> Real:
    """|c|^2 by equation (1), negative where there is none, for rotations (.., 3, 3)."""
    apart = rotation @ robot.platform - robot.base
    return np.asarray(np.mean(robot.lengths**2) - (apart * apart).sum(axis=-2).mean(axis=-1))


def home_pose(machine: NumericMachine) -> StartPose:
    """A start that needs no knowledge of the robot: the platform over the base.

    Spatial: the rotation brings the platform's joints nearest to the base joints of their legs, and the centroid stands
    on the normal of the base through its centroid, on the side of the third axis, as high as (1) says; half a mean leg
    length high if (1) cannot hold.

    Planar: the centroids coincide, and the platform is turned counterclockwise from where its joints are nearest to the
    base joints until (1) holds. If it cannot hold so, the platform is not turned, and is moved as above, along the
    second axis.

    Mechanisms declared by constraints: the platform is not turned, and moved from where the centres coincide along the
    last axis along which it can move, as far as (1) says for those constraints that are legs, or by about its size.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from pkm_exact.constraints.distance import Distance
    >>> from pkm_exact.geometry.problem import ForwardProblem
    >>> from pkm_exact.numeric.numeric_robot import numeric_robot
    >>> corners = [tuple(map(Fraction, joint)) for joint in ((0, 0, 0), (4, 0, 0), (2, 3, 0))] * 2
    >>> robot = numeric_robot(ForwardProblem(tuple(Distance(joint, joint, Fraction(25)) for joint in corners)))
    >>> [round(x, 9) for x in home_pose(robot).position], home_pose(robot).quaternion
    ([0.0, 0.0, 5.0], (1.0, 0.0, 0.0, 0.0))
    """
    if not isinstance(machine, NumericRobot):
        return _mechanism_home(machine)
    robot = machine
    if robot.motion.is_planar:
        quaternion, over = _planar_home(robot)
        direction = np.array([0.0, 1.0, 0.0])
    else:
        quaternion, over = _nearest_rotation(robot), False
        direction = _base_normal(robot)
    square = 0.0 if over else float(distance_squared(robot, rotation_matrix(quaternion)))
    if not over and square < NOTHING:
        square = float(np.mean(robot.lengths**2)) / 4
    return StartPose(placed(robot, sqrt(square) * direction, quaternion)[0], quaternion)


def _mechanism_home(machine: NumericMachine) -> StartPose:
    identity = (1.0, 0.0, 0.0, 0.0)
    axis = max((axis for axis in machine.motion.twist if axis < 3), default=None)
    c = np.zeros(3)
    if axis is not None and isinstance(machine, NumericMechanism):
        c[axis] = 1.0
        c *= _reach(machine, np.eye(3), c)
    return StartPose(placed(machine, c, identity)[0], identity)


def _planar_home(robot: NumericRobot) -> tuple[Quaternion, bool]:
    """The turn of a planar home pose, and whether (1) holds with the centroids together."""
    overlap = robot.base @ robot.platform.T
    along, across = float(overlap[0, 0] + overlap[1, 1]), float(overlap[1, 0] - overlap[0, 1])
    spread = float((robot.base**2).sum() + (robot.platform**2).sum() - (robot.lengths**2).sum()) / 2
    amplitude = hypot(along, across)
    over = abs(spread) <= amplitude and amplitude > 0
    angle = atan2(across, along) + (acos(spread / amplitude) if over else 0.0)
    return (cos(angle / 2), 0.0, 0.0, sin(angle / 2)), over


def _nearest_rotation(robot: NumericRobot) -> Quaternion:
    """The rotation that makes the sum of |R B_i - A_i|^2 least: the greatest eigenvector of Horn's 4 x 4 matrix.

    Reference: B. K. P. Horn, "Closed-form solution of absolute orientation using unit quaternions" (1987).
    """
    s = robot.platform @ robot.base.T
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = s.tolist()
    matrix = np.array(
        [
            [xx + yy + zz, yz - zy, zx - xz, xy - yx],
            [yz - zy, xx - yy - zz, xy + yx, zx + xz],
            [zx - xz, xy + yx, yy - xx - zz, yz + zy],
            [xy - yx, zx + xz, yz + zy, zz - xx - yy],
        ]
    )
    greatest = np.linalg.eigh(matrix)[1][:, -1]
    q0, q1, q2, q3 = (greatest if greatest[0] >= 0 else -greatest).tolist()
    return q0, q1, q2, q3


def _base_normal(robot: NumericRobot) -> Real:
    """The direction in which the base joints spread least; upward, the third coordinate counting first."""
    normal = np.linalg.eigh(robot.base @ robot.base.T)[1][:, 0]
    leading = next(float(value) for value in normal[::-1] if abs(value) > NOTHING)
    return np.asarray(normal * copysign(1.0, leading))
