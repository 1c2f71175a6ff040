"""Rotations of the plane in a Gram metric: the third axis fixed, everything rational.

With w = g1 g2, the product of the metric's first two numbers, a rotation by an angle theta is rational if

    cos(theta) = c,   sin(theta) = sqrt(w) s,   tan(theta / 2) = sqrt(w) t

with rational c, s, t; then c^2 + w s^2 = 1, and on rational coordinates R = ((c, -g2 s), (g1 s, c)). For w = 1 these
are cosine, sine and half tangent themselves; for the metric (1, 3), whose ordinary y is sqrt(3) times the rational
one, c = s = 1/2 is a turn by 60 degrees. A crank needs two perpendicular vectors of equal length: w must be a square.
"""

from __future__ import annotations

from fractions import Fraction
from math import isqrt

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import CosSin, cosine_and_sine, parse_cosine_and_sine
from pkm_exact.geometry.inverse import Matrix, Metric
from pkm_exact.geometry.rational import parse_rational


def weight(metric: Metric) -> int:
    """The number w whose square root is the unit of sines and half tangents."""
    return metric[0] * metric[1]


def turn_of(cos_sin: CosSin, metric: Metric) -> Matrix:
    """The rotation matrix R of a turn in the plane of the first two axes.

    Examples
    --------
    >>> half = Fraction(1, 2)
    >>> [[str(entry) for entry in row] for row in turn_of((half, half), (1, 3, 1))]
    [['1/2', '-3/2', '0'], ['1/2', '1/2', '0'], ['0', '0', '1']]
    """
    c, s = cos_sin
    zero = Fraction(0)
    return (c, -metric[1] * s, zero), (metric[0] * s, c, zero), (zero, zero, Fraction(1))


def parse_half_tangent(value: object, where: str, metric: Metric) -> Matrix:
    """The rotation matrix of the turn whose half has the tangent sqrt(w) t, for one rational number t."""
    return turn_of(cosine_and_sine(parse_rational(value, where), weight(metric)), metric)


def parse_turn(value: object, where: str, metric: Metric) -> Matrix:
    """The rotation matrix of the turn with cosine c and sine sqrt(w) s, for a pair (c, s)."""
    return turn_of(parse_cosine_and_sine(value, where, weight(metric)), metric)


def quarter_turn(vector: Vector, metric: Metric, where: str) -> Vector:
    """A vector of the plane, turned by 90 degrees from the first axis to the second.

    Raises
    ------
    InputError
        If w is not a square: the turned vector is not rational then.

    Examples
    --------
    >>> [str(x) for x in quarter_turn((Fraction(2), Fraction(1), Fraction(0)), (1, 4, 1), "crank")]
    ['-2', '1', '0']
    """
    root = isqrt(weight(metric))
    if root * root != weight(metric):
        raise InputError(
            f"{where}: a crank turned by 90 degrees is not rational in this metric; choose one whose first two numbers "
            "have a square as their product"
        )
    x, y, _ = vector
    return -metric[1] * y / root, metric[0] * x / root, Fraction(0)
