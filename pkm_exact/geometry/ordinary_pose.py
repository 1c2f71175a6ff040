"""Poses in ordinary coordinates, and the same in the rational ones of a metric.

The ordinary coordinate is sqrt(g_i) times the rational one. So a rational ordinary number x is sqrt(g) times a rational
one only if x is 0 or g is a square: in a metric with sqrt(3) most rational poses are not rational poses of the model.
With s = (1, g2 g3, g3 g1, g1 g2) the quaternion of the model is (sqrt(s_0) q_0, .., sqrt(s_3) q_3), up to scale, for
the ordinary quaternion q: rational if s_i s_j is a square for all i, j at which q is not 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import isqrt
from typing import TypeAlias

from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.inverse import Matrix, Metric, Quaternion
from pkm_exact.geometry.surds import Surd

OrdinaryMatrix: TypeAlias = tuple[tuple[Surd, ...], ...]

_ROOT_BITS = 64
"""Of a root beyond those that a wanted width asks for."""


def model_position(position: Vector, metric: Metric, nearest: Fraction | None = None) -> Vector | None:
    """The position in the coordinates of the model, exactly; or one that is off by at most ``nearest`` in each.

    None if it is not rational there, and nothing else is asked for.

    Examples
    --------
    >>> half, zero = Fraction(1, 2), Fraction(0)
    >>> model_position((half, half, zero), (1, 4, 1)), model_position((half, half, zero), (1, 3, 1))
    ((Fraction(1, 2), Fraction(1, 4), Fraction(0, 1)), None)
    >>> found = model_position((half, half, zero), (1, 3, 1), Fraction(1, 1000))
    >>> abs(found[1] * 3**0.5 - 0.5) < 1e-3
    True
    """
    numbers = [_quotient(x, g, nearest) for x, g in zip(position, metric, strict=True)]
    if None in numbers:
        return None
    x, y, z = (number for number in numbers if number is not None)
    return x, y, z


def _quotient(x: Fraction, g: int, nearest: Fraction | None) -> Fraction | None:
    """x / sqrt(g), exactly or nearly."""
    root = isqrt(g)
    if x == 0 or root * root == g:
        return x / root
    if nearest is None:
        return None
    grid = 1
    while grid * nearest < root + 1:  # half a unit of this grid is less than nearest in ordinary coordinates
        grid *= 2
    return Fraction(_nearest(x * _root(g, abs(x) * grid) / g * grid), grid)


def model_quaternion(quaternion: Quaternion, metric: Metric, nearest: Fraction | None = None) -> Quaternion | None:
    """The quaternion of the model, of any scale; or one whose rotation matrix is off by at most ``nearest`` anywhere.

    None if it is not rational there, and nothing else is asked for.

    Examples
    --------
    >>> zero, one = Fraction(0), Fraction(1)
    >>> model_quaternion((zero, one, zero, one), (1, 3, 1)), model_quaternion((one, zero, zero, one), (1, 3, 1))
    ((Fraction(0, 1), Fraction(1, 1), Fraction(0, 1), Fraction(1, 1)), None)
    """
    g1, g2, g3 = metric
    squares = (1, g2 * g3, g3 * g1, g1 * g2)
    first = next(s for s, q in zip(squares, quaternion, strict=True) if q)
    products = [s * first for s in squares]
    roots = [isqrt(product) for product in products]
    if all(not q or root * root == p for q, root, p in zip(quaternion, roots, products, strict=True)):
        e0, e1, e2, e3 = (q * root / first if q else q for q, root in zip(quaternion, roots, strict=True))
        return e0, e1, e2, e3
    if nearest is None:
        return None
    # A number off by 1 / grid moves the unit quaternion by 4 / (grid |q|) and the matrix by four times that at most.
    grid, largest = 1, max(map(abs, quaternion))
    while grid * largest * nearest < 64:
        grid *= 2
    numbers = [q * _root(s, abs(q) * grid) for q, s in zip(quaternion, squares, strict=True)]
    e0, e1, e2, e3 = (Fraction(_nearest(number * grid), grid) for number in numbers)
    return e0, e1, e2, e3


def _root(number: int, size: Fraction) -> Fraction:
    """A rational so near to the square root that a product with ``size`` is off by far less than 1."""
    scale = 1 << (_ROOT_BITS + (size.__ceil__() * number).bit_length())
    return Fraction(isqrt(number * scale * scale), scale)


def _nearest(value: Fraction) -> int:
    return (2 * value.numerator + value.denominator) // (2 * value.denominator)


def quaternion_of(matrix: Sequence[Sequence[Fraction]]) -> Quaternion:
    """A quaternion of an ordinary rotation matrix, rational as it is.

    Examples
    --------
    >>> turn = ((0, -1, 0), (1, 0, 0), (0, 0, 1))
    >>> [str(q) for q in quaternion_of([[Fraction(x) for x in row] for row in turn])]
    ['1', '0', '0', '1']
    """
    (a, b, c), (d, e, f), (g, h, i) = matrix
    one = Fraction(1)
    rows = (
        (one + a + e + i, h - f, c - g, d - b),
        (h - f, one + a - e - i, b + d, c + g),
        (c - g, b + d, one - a + e - i, f + h),
        (d - b, c + g, f + h, one - a - e + i),
    )
    # Each row is a multiple of the quaternion, by 4 times the number on the diagonal; one of these is not 0.
    q0, q1, q2, q3 = next(row for k, row in enumerate(rows) if row[k])
    scale = next(abs(q) for q in (q0, q1, q2, q3) if q)
    return q0 / scale, q1 / scale, q2 / scale, q3 / scale


def ordinary_position(position: Vector, metric: Metric) -> tuple[Surd, ...]:
    """A position of the model in ordinary coordinates, exactly.

    >>> print(*ordinary_position((Fraction(1), Fraction(1, 2), Fraction(0)), (1, 3, 1)))
    1 1/2*sqrt(3) 0
    """
    return tuple(_times_root(x, Fraction(g)) for x, g in zip(position, metric, strict=True))


def ordinary_rotation(rotation: Matrix, metric: Metric) -> OrdinaryMatrix:
    """A rotation of the model as an ordinary matrix, exactly: the entry i, j times sqrt(g_i / g_j)."""
    return tuple(
        tuple(_times_root(x, Fraction(metric[i], metric[j])) for j, x in enumerate(row))
        for i, row in enumerate(rotation)
    )


def _times_root(x: Fraction, square: Fraction) -> Surd:
    return Surd.root_of(square).scaled(x)
