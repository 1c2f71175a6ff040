"""Poses of legged robots in 200 bits, by Newton's iteration on the legs' own equations, to hold others against."""

from collections.abc import Sequence
from fractions import Fraction
from math import cos, sin

import numpy as np
from flint import arb, arb_mat
from numpy.typing import NDArray

from pkm_exact.geometry.chains import Crank
from pkm_exact.geometry.robot import Robot
from pkm_exact.precision import working_precision

Array = NDArray[np.float64]
BITS = 200


def _arb(value: Fraction | float) -> arb:
    exact = Fraction(value)
    return arb(exact.numerator) / exact.denominator


class PreciseLegs:
    """The legs of a robot in ordinary coordinates, at joint values that are doubles."""

    def __init__(self, robot: Robot, values: Sequence[float]) -> None:
        self.planar = robot.motion.is_planar
        roots = [arb(g).sqrt() for g in robot.metric]
        self.platform = [[_arb(x) * r for x, r in zip(joint, roots, strict=True)] for joint in robot.platform_joints]
        self.base, self.squares = [], []
        for leg, joint in enumerate(robot.base_joints):
            place = [_arb(x) for x in joint]
            square = _arb(values[leg]) ** 2
            if robot.chains:
                chain, value = robot.chains[leg], _arb(values[leg])
                square = _arb(chain.rod_squared)
                first, second = (value.cos(), value.sin()) if isinstance(chain, Crank) else (value, arb(0))
                arms = (chain.at_0, chain.at_90) if isinstance(chain, Crank) else (chain.direction, (0, 0, 0))
                place = [a + first * _arb(u) + second * _arb(v) for a, u, v in zip(place, *arms, strict=True)]
            self.base.append([x * r for x, r in zip(place, roots, strict=True)])
            self.squares.append(square)

    def rows(self, place: list[arb], turn: list[list[arb]]) -> tuple[list[list[arb]], list[arb]]:
        """Half the derivatives of squared lengths along twists about the platform's origin, and half what is off."""
        rows, values = [], []
        for a, b, square in zip(self.base, self.platform, self.squares, strict=True):
            arm = [sum((turn[i][j] * b[j] for j in range(3)), arb(0)) for i in range(3)]
            d = [place[i] + arm[i] - a[i] for i in range(3)]
            moment = [arm[1] * d[2] - arm[2] * d[1], arm[2] * d[0] - arm[0] * d[2], arm[0] * d[1] - arm[1] * d[0]]
            rows.append([d[0], d[1], moment[2]] if self.planar else [*d, *moment])
            values.append((sum((x * x for x in d), arb(0)) - square) / 2)
        return rows, values


def precise_pose(
    robot: Robot, values: Sequence[float], position: Array, quaternion: Array
) -> tuple[Array, Array, int, float]:
    """Position, rotation matrix, and the sign of det J of the pose next to a guess, and how far the last step went."""
    with working_precision(BITS):
        legs = PreciseLegs(robot, values)
        place = [_arb(float(x)) for x in position]
        e = [_arb(float(x)) for x in quaternion]
        length = arb(1)
        for _ in range(7):
            turn = _rotation(e)
            rows, off = legs.rows(place, turn)
            step = arb_mat(rows).mid().solve(arb_mat([[x] for x in off]).mid(), algorithm="approx")
            moved = [x.mid() for x in step.entries()]
            twist = [moved[0], moved[1], arb(0), arb(0), arb(0), moved[2]] if legs.planar else moved
            place = [(x - t).mid() for x, t in zip(place, twist[:3], strict=True)]
            e = _turned(e, [-t / 2 for t in twist[3:]])
            length = max((abs(x) for x in moved), key=float)
        turn = _rotation(e)
        rows, _ = legs.rows(place, turn)
        determinant = arb_mat(rows).det()
        sign = 1 if determinant > 0 else -1 if determinant < 0 else 0
        rotation = np.array([[float(x) for x in row] for row in turn])
        return np.array([float(x) for x in place]), rotation, sign, float(length)


def _rotation(e: list[arb]) -> list[list[arb]]:
    a, b, c, d = e
    n = a * a + b * b + c * c + d * d
    return [
        [(a * a + b * b - c * c - d * d) / n, 2 * (b * c - a * d) / n, 2 * (b * d + a * c) / n],
        [2 * (b * c + a * d) / n, (a * a - b * b + c * c - d * d) / n, 2 * (c * d - a * b) / n],
        [2 * (b * d - a * c) / n, 2 * (c * d + a * b) / n, (a * a - b * b - c * c + d * d) / n],
    ]


def _turned(e: list[arb], w: list[arb]) -> list[arb]:
    """(1, w) e as quaternions."""
    a, b, c, d = e
    x, y, z = w
    return [
        (a - x * b - y * c - z * d).mid(),
        (b + x * a + y * d - z * c).mid(),
        (c - x * d + y * a + z * b).mid(),
        (d + x * c - y * b + z * a).mid(),
    ]


def values_at(robot: Robot, position: Array, rotation: Array) -> Array:
    """Lengths of actuated legs at a pose, in doubles."""
    roots = np.sqrt(np.array(robot.metric, dtype=float))
    base = np.array(robot.base_joints, dtype=object).astype(float) * roots
    platform = np.array(robot.platform_joints, dtype=object).astype(float) * roots
    lengths: Array = np.linalg.norm(position + platform @ rotation.T - base, axis=1)
    return lengths


def planar_turn(angle: float) -> Array:
    """A rotation about the third axis."""
    return np.array([[cos(angle), -sin(angle), 0], [sin(angle), cos(angle), 0], [0, 0, 1.0]])
