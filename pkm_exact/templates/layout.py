"""Where the joints of a first model stand: hexagons and triangles by their sides, exact in a metric or rounded.

Spatial robots have semi-regular hexagons (``geometry.hexagons``): equal angles, side lengths p and q in turn. Their
corners are on a circle of radius r, where two neighbours are an angle a apart, the next two 120 degrees - a, and so on:

    p = 2 r sin(a / 2),    q = 2 r sin(60 degrees - a / 2).

Planar robots have triangles. The third corner's y is a square root; triangles whose roots are rational multiples of one
sqrt(n) are exact in the metric (1, n).
"""

from __future__ import annotations

from fractions import Fraction
from math import isqrt
from typing import Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.hexagons import HEXAGON_METRIC, semi_regular_hexagon
from pkm_exact.geometry.inverse import UNIT_METRIC, Metric
from pkm_exact.geometry.kinds import Joints
from pkm_exact.geometry.surds import Surd
from pkm_exact.templates import DEFAULT_DECIMALS

_PI: Final = Fraction(31415926535897932384626433832795028841971693993751, 10**49)
_TERMS: Final = 20  # of the sine's series, up to 60 degrees: the rest is below 10^-48
CIRCLE_DIGITS: Final = 6
"""Sides that come from a circle are kept to this many digits of its radius."""


def joints_and_metric(sides: tuple[tuple[Fraction, ...], ...], digits: int | None) -> tuple[list[Joints], Metric]:
    """The joints of base and platform, hexagons by two sides or triangles by three, and the metric they stand in.

    Parameters
    ----------
    sides : tuple of tuple of Fraction
        Those of the base, and those of the platform.
    digits : int or None
        None for exact joints, in a metric that makes them rational; else the number of decimals to round them to.

    Raises
    ------
    InputError
        If the joints are to be exact, and no metric makes those of both triangles rational.

    Examples
    --------
    >>> joints, metric = joints_and_metric(((Fraction(2), Fraction(0)), (Fraction(0), Fraction(1))), None)
    >>> metric, [str(x) for x in joints[0][1]]
    ((1, 3, 1), ['1', '-1/3', '0'])
    >>> [float(x) for x in joints_and_metric(((Fraction(2), Fraction(0)),), 3)[0][0][1]]
    [1.0, -0.577, 0.0]
    """
    if all(len(given) == 2 for given in sides):
        places, metric = [semi_regular_hexagon(*given) for given in sides], HEXAGON_METRIC
    else:
        n = 1 if digits is not None else _common_radicand(sides)
        places, metric = [_triangle(given, n, digits) for given in sides], (1, n, 1)
    if digits is None:
        return places, metric
    rounded = [tuple(_rounded_joint(joint, metric, digits) for joint in joints) for joints in places]
    return rounded, UNIT_METRIC


def default_decimals(sides: tuple[tuple[Fraction, ...], ...]) -> int | None:
    """To how many decimals joints are rounded if nothing is asked for: none are where ordinary coordinates are exact.

    Examples
    --------
    >>> triangles = tuple(map(Fraction, (6, 5, 5))), tuple(map(Fraction, (3, 4, 5)))
    >>> default_decimals(triangles), default_decimals(((Fraction(2), Fraction(0)),) * 2)
    (None, 6)
    """
    try:
        _, metric = joints_and_metric(sides, None)
    except InputError:
        return DEFAULT_DECIMALS
    return None if metric == UNIT_METRIC else DEFAULT_DECIMALS


def sides_on_circle(radius: Fraction, degrees: Fraction) -> tuple[Fraction, Fraction]:
    """The sides of the semi-regular hexagon on a circle whose joints 1 and 2 are an angle apart, rounded.

    Examples
    --------
    >>> [str(side) for side in sides_on_circle(Fraction(500), Fraction(60))]
    ['500', '500']
    >>> [float(side) for side in sides_on_circle(Fraction(500), Fraction(20))]
    [173.648, 766.044]
    """
    whole = len(str(radius.numerator // radius.denominator)) if radius >= 1 else 0
    digits = CIRCLE_DIGITS - whole
    if radius < 1:
        digits += len(str(radius.denominator // radius.numerator))
    p, q = (2 * radius * _sine(angle) for angle in (degrees / 2, 60 - degrees / 2))
    return rounded(p, digits), rounded(q, digits)


def rounded(number: Fraction, digits: int) -> Fraction:
    """The nearest number with so many decimals; tens, hundreds, .. if ``digits`` is negative."""
    unit = Fraction(10) ** -digits
    return round(number / unit) * unit


def rounded_root(square: Fraction, digits: int) -> Fraction:
    """The square root of a number that is not negative, rounded to so many decimals.

    Examples
    --------
    >>> float(rounded_root(Fraction(3), 3))
    1.732
    """
    scale = 10**digits
    return Fraction((isqrt(int(4 * square * scale * scale)) + 1) // 2, scale)


def _sine(degrees: Fraction) -> Fraction:
    """The sine of an angle from 0 to 60 degrees, to at least 45 decimals."""
    angle = _PI * degrees / 180
    angle = Fraction(round(angle * 10**50), 10**50)
    term, total = angle, angle
    for k in range(1, _TERMS):
        term *= -angle * angle / (2 * k * (2 * k + 1))
        total += term
    return total


def _rounded_joint(joint: tuple[Fraction, ...], metric: Metric, digits: int) -> tuple[Fraction, Fraction, Fraction]:
    x, y, z = (
        rounded(coordinate, digits) if g == 1 else _signed_root(coordinate, g, digits)
        for coordinate, g in zip(joint, metric, strict=True)
    )
    return x, y, z


def _signed_root(coordinate: Fraction, g: int, digits: int) -> Fraction:
    root = rounded_root(g * coordinate * coordinate, digits)
    return root if coordinate >= 0 else -root


def _corner(sides: tuple[Fraction, ...]) -> tuple[Fraction, Fraction]:
    """The third corner's x, and the square of its y; corners 1 and 2 are at (0, 0) and (first side, 0)."""
    first, second, third = sides
    x = (first * first + third * third - second * second) / (2 * first)
    return x, third * third - x * x


def _triangle(sides: tuple[Fraction, ...], n: int, digits: int | None) -> Joints:
    x, square = _corner(sides)
    y = Surd.root_of(square / n).p if digits is None else rounded_root(square, digits)
    zero = Fraction(0)
    return (zero, zero, zero), (sides[0], zero, zero), (x, y, zero)


def _common_radicand(sides: tuple[tuple[Fraction, ...], ...]) -> int:
    """The n for which the y of both third corners are rational multiples of sqrt(n)."""
    n = Surd.root_of(_corner(sides[0])[1]).n or 1
    if not all(Surd.root_of(_corner(given)[1] / n).is_rational for given in sides):
        raise InputError(
            "--base-sides and --platform-sides: no exact coordinates suit both triangles; round the joints with "
            "--digits 3, or choose sides such as 13,14,15 and 3,4,5, whose areas are rational"
        )
    return n
