"""A robot with legs in floating point: six of known length in space, or three in the plane.

All in ordinary coordinates. Joints are taken relative to the centroids of base and platform and divided by a unit, a
power of two, both exactly and before anything is rounded: numbers of any size become numbers of size 1, and a robot far
from its origin loses no digits.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import copysign, sqrt
from typing import Any, Final

import numpy as np

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.numeric_machine import OUT_OF_REACH, NumericMachine, Place, Real
from pkm_exact.numeric.quaternions import rotation_matrix

GREATEST: Final = 10**100
"""Coordinates and lengths beyond it, and robots smaller than its inverse, are left to the exact engine."""


@dataclass(frozen=True, eq=False)
class LegPlace(Place):
    """What the legs are at a pose, or at many: an error is that of a leg's length.

    Attributes
    ----------
    arms, lines : (.., 3, m) array
        R B_i and c + R B_i - A_i in columns.
    norms : (.., m) array
        Lengths of the legs.
    """

    arms: Real
    lines: Real
    norms: Real

    def transposed_jacobian(self) -> Real:
        """The Pluecker coordinates (n_i, (R B_i) x n_i) of the legs."""
        return transposed_jacobian(self.arms, self.lines, np.maximum(self.norms, np.finfo(float).tiny))


@dataclass(frozen=True, eq=False)
class NumericRobot(NumericMachine):
    """A locked robot with legs in floating point.

    Attributes
    ----------
    base, platform : (3, n) array
        Joints in the columns, relative to their centroids, in units of ``unit``.
    lengths : (n,) array
        Leg lengths, in units of ``unit``; as the coordinates, none is greater than 1.
    """

    base: Real
    platform: Real
    lengths: Real

    @property
    def markers(self) -> Real:
        """The joints of the platform."""
        return self.platform

    def at(self, c: Real, quaternion: Sequence[Any]) -> LegPlace:
        """The legs at a pose, or at many."""
        arms = rotation_matrix(quaternion) @ self.platform
        lines = arms + (c[..., :, None] - self.base)
        norms = np.sqrt((lines * lines).sum(axis=-2))
        return LegPlace(norms - self.lengths, arms, lines, norms)


def transposed_jacobian(arms: Real, lines: Real, norms: Real) -> Real:
    """(.., 6, n): the Pluecker coordinates (n_i, (R B_i) x n_i) of the legs in columns."""
    units = lines / norms[..., None, :]
    ax, ay, az = arms[..., 0, :], arms[..., 1, :], arms[..., 2, :]
    nx, ny, nz = units[..., 0, :], units[..., 1, :], units[..., 2, :]
    jacobian = np.empty((*units.shape[:-2], 6, units.shape[-1]))
    jacobian[..., :3, :] = units
    jacobian[..., 3, :] = ay * nz - az * ny
    jacobian[..., 4, :] = az * nx - ax * nz
    jacobian[..., 5, :] = ax * ny - ay * nx
    return jacobian


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
        raise InputError(OUT_OF_REACH)


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
