"""Inverse kinematics over the rationals: squared distances between joints at a pose given by a quaternion."""

from __future__ import annotations

from fractions import Fraction
from typing import Final, TypeAlias

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.rotation import quaternion_norm, scaled_rotation

Quaternion: TypeAlias = tuple[Fraction, Fraction, Fraction, Fraction]
Metric: TypeAlias = tuple[int, int, int]
Matrix: TypeAlias = tuple[Vector, Vector, Vector]

UNIT_METRIC: Final[Metric] = (1, 1, 1)


def rotation_of(quaternion: Quaternion, metric: Metric = UNIT_METRIC) -> Matrix:
    """The rotation matrix R of a quaternion of any scale, both in rational coordinates with respect to ``metric``.

    Raises
    ------
    InputError
        If the quaternion is zero.

    Examples
    --------
    >>> rotation_of((Fraction(2), Fraction(0), Fraction(0), Fraction(2)))[0]
    (Fraction(0, 1), Fraction(-1, 1), Fraction(0, 1))
    """
    products = [[a * b for b in quaternion] for a in quaternion]
    norm = quaternion_norm(products, metric)
    if norm == 0:
        raise InputError("quaternion: all four numbers are 0; give one that is not")
    first, second, third = ((x / norm, y / norm, z / norm) for x, y, z in scaled_rotation(products, metric))
    return first, second, third


def cross(left: Vector, right: Vector) -> Vector:
    """The vector product, in the metric (1, 1, 1).

    Examples
    --------
    >>> x, y = (tuple(map(Fraction, axis)) for axis in ((1, 0, 0), (0, 1, 0)))
    >>> [str(value) for value in cross(x, y)]
    ['0', '0', '1']
    """
    (a, b, c), (u, v, w) = left, right
    return b * w - c * v, c * u - a * w, a * v - b * u


def dot(left: Vector, right: Vector, metric: Metric = UNIT_METRIC) -> Fraction:
    """The product of two vectors in the metric: the sum of metric[i] left[i] right[i].

    Examples
    --------
    >>> one = (Fraction(1),) * 3
    >>> dot(one, one, (1, 3, 1))
    Fraction(5, 1)
    """
    return sum((g * x * y for g, x, y in zip(metric, left, right, strict=True)), Fraction(0))


def distance_squared(
    base_joint: Vector, platform_joint: Vector, position: Vector, rotation: Matrix, metric: Metric = UNIT_METRIC
) -> Fraction:
    """The squared distance |C + R B - A|^2 between a base joint A and a platform joint B at the pose (C, R).

    Examples
    --------
    >>> joint, origin, height = (Fraction(1),) * 3, (Fraction(0),) * 3, (Fraction(0), Fraction(0), Fraction(5))
    >>> distance_squared(joint, joint, height, rotation_of((Fraction(1), *origin)))
    Fraction(25, 1)
    """
    total = Fraction(0)
    for g, c, row, a in zip(metric, position, rotation, base_joint, strict=True):
        difference = c - a + sum(r * b for r, b in zip(row, platform_joint, strict=True))
        total += g * difference * difference
    return total
