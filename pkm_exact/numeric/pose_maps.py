"""Position, rotation and quaternion of a pose as functions of its centred coordinates, with their derivatives.

    C = a + unit C' - R b,   R = (N R) / N,   q = e / sqrt(N),   centroid C + R b

in ordinary coordinates of the model's frames; C' = (N C') / N is the position in the centred frames, a and b their
origins. Derivatives over a box give bounds by the mean value theorem: a component g of the pose satisfies
g(x) - g(m) = g'(xi) (x - m) with xi in the box.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from flint import acb_mat, arb, arb_mat

from pkm_exact.balls import ball
from pkm_exact.numeric.centred import NORM, POSITION, ROTATION, CentredRobot, gradients, origins, quantities
from pkm_exact.roots.interval import Interval

OUTPUT_BITS: Final = 24
"""Bits to which the radius of an interval is rounded up."""


@dataclass(frozen=True, eq=False)
class PoseMap:
    """The components at a real point or all over a real box.

    Attributes
    ----------
    values : list of 19 arb
        Position (3), rotation matrix by rows (9), quaternion (4), centroid (3).
    slopes : 19 x n matrix
        Their derivatives by the coordinates.
    """

    values: list[arb]
    slopes: arb_mat


def pose_map(robot: CentredRobot, x: acb_mat) -> PoseMap:
    """The components and their derivatives at x, where N(e) must not vanish."""
    complex_slopes = gradients(x, robot.problem.motion)[0]
    size = robot.size
    flat = [value.real for value in complex_slopes.entries()]
    slopes = [flat[k * size : (k + 1) * size] for k in range(complex_slopes.nrows())]
    values = [value.real for value in quantities(complex_slopes, x)]
    norm, norm_slopes = values[NORM], slopes[NORM]

    def quotient(index: int) -> tuple[arb, list[arb]]:
        value = values[index] / norm
        return value, [(s - value * t) / norm for s, t in zip(slopes[index], norm_slopes, strict=True)]

    centred = [quotient(POSITION + k) for k in range(3)]
    rotation = [quotient(ROTATION + k) for k in range(9)]
    centroid = _centroid(robot, centred)
    rows = [*_moved(robot, centroid, rotation), *rotation, *_unit_quaternion(robot, x, norm, norm_slopes), *centroid]
    return PoseMap([value for value, _ in rows], arb_mat([row for _, row in rows]))


_Row = tuple[arb, list[arb]]


def _centroid(robot: CentredRobot, centred: Sequence[_Row]) -> list[_Row]:
    """The position of the platform joints' centroid."""
    unit = ball(robot.frames.unit)
    return [(a + unit * v, [unit * s for s in row]) for a, (v, row) in zip(origins(robot)[0], centred, strict=True)]


def _moved(robot: CentredRobot, centroid: Sequence[_Row], rotation: Sequence[_Row]) -> list[_Row]:
    """The position of the model's frame."""
    b = origins(robot)[1]
    rows = []
    for i, (value, row) in enumerate(centroid):
        for j in range(3):
            turned, turned_row = rotation[3 * i + j]
            value -= turned * b[j]
            row = [s - t * b[j] for s, t in zip(row, turned_row, strict=True)]
        rows.append((value, row))
    return rows


def _unit_quaternion(robot: CentredRobot, x: acb_mat, norm: arb, norm_slopes: Sequence[arb]) -> list[_Row]:
    length = norm.sqrt()
    places = {k: place for place, k in enumerate(robot.problem.motion.rotation_support)}
    rows: list[_Row] = []
    for k in range(4):
        if k not in places:
            rows.append((arb(0), [arb(0)] * robot.size))
            continue
        value = x[places[k], 0].real / length
        row = [-value * s / (2 * norm) for s in norm_slopes]
        row[places[k]] += 1 / length
        rows.append((value, row))
    return rows


def interval(value: arb) -> Interval:
    """A dyadic interval around a ball, little wider."""
    middle, radius = value.mid(), value.rad()
    if radius == 0:
        exact = _exact(middle)
        return Interval(exact, exact)
    mantissa, power = radius.man_exp()
    grid = Fraction(2) ** (int(power) + int(mantissa).bit_length() - OUTPUT_BITS)
    low, high = _exact(middle) - _exact(radius), _exact(middle) + _exact(radius)
    return Interval((low / grid).__floor__() * grid, -((-high / grid).__floor__()) * grid)


def _exact(value: arb) -> Fraction:
    mantissa, power = value.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(power)
