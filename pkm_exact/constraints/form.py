"""Linear forms on rigid motions: the 17 coordinates in which constraints are linear, and the derivative along a twist.

A form has rational coefficients on (|C|^2; u1, u2, u3; C1, C2, C3; r11, r12, .., r33; 1), u = R^-1 C, in rational
coordinates with Gram diagonal g. Along a velocity v of the platform's origin and an angular velocity w its derivative
is force.v + moment.w for the wrench

    (2 c_s C + a + c_C;  a x C + sum_j R_j x c_Rj),   a = R c_u

in ordinary coordinates, R_j and c_Rj the columns of R and of its coefficients. Reference: Gallet, Nawratil and Schicho,
"Bond theory for pentapods and hexapods", J. Geometry 106 (2015), for the coordinates.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import lcm
from typing import Any, Final, TypeAlias

from pkm_exact.errors import InputError

Vector: TypeAlias = tuple[Fraction, Fraction, Fraction]
Form: TypeAlias = tuple[Fraction, ...]
"""Coefficients on (|C|^2; u; C; R; 1)."""

SIZE: Final = 17
"""Number of coordinates."""
_CYCLIC: Final = ((0, 1, 2), (1, 2, 0), (2, 0, 1))
_ZERO: Final = Fraction(0)


def form(
    square: Fraction = _ZERO,
    turned: Sequence[Fraction] = (_ZERO,) * 3,
    position: Sequence[Fraction] = (_ZERO,) * 3,
    rotation: Sequence[Fraction] = (_ZERO,) * 9,
    constant: Fraction = _ZERO,
) -> Form:
    """The form with the given coefficients of |C|^2, u, C, R (by rows) and 1."""
    return (square, *turned, *position, *rotation, constant)


def scaled(metric: Sequence[int], vector: Sequence[Fraction], factor: int = 1) -> list[Fraction]:
    """The coefficients of factor times the product with a vector: factor g_i v_i."""
    return [factor * g * value for g, value in zip(metric, vector, strict=True)]


def outer(
    metric: Sequence[int], left: Sequence[Fraction], right: Sequence[Fraction], factor: int = 1
) -> list[Fraction]:
    """The coefficients of factor times left.(R right), on R by rows."""
    return [factor * metric[i] * left[i] * right[j] for i in range(3) for j in range(3)]


def integral(values: Form) -> tuple[int, ...]:
    """The least multiple with integer coefficients.

    Examples
    --------
    >>> integral((Fraction(1, 2), Fraction(1, 3)))
    (3, 2)
    """
    denominator = lcm(*(value.denominator for value in values))
    return tuple(value.numerator * (denominator // value.denominator) for value in values)


def ordinary(values: Sequence[Any], roots: Sequence[Any]) -> list[Any]:
    """The coefficients in ordinary coordinates, in any field that has ``roots``, the square roots of the metric."""
    return [
        values[0],
        *(values[1 + i] / roots[i] for i in range(3)),
        *(values[4 + i] / roots[i] for i in range(3)),
        *(values[7 + 3 * i + j] * roots[j] / roots[i] for i in range(3) for j in range(3)),
        values[16],
    ]


def in_frames(
    values: Form, base: Sequence[Fraction], platform: Sequence[Fraction], unit: Fraction, metric: Sequence[int]
) -> Form:
    """The form in other frames and another unit of length: a point x of the base becomes (x - base) / unit.

    With b and a the new origins, C = b + unit C' - R a and u = unit u' + R^-1 b - a.

    Examples
    --------
    >>> height = form(position=(_ZERO, _ZERO, Fraction(1)), constant=Fraction(-5))
    >>> moved = in_frames(height, (0, 0, Fraction(3)), (0, 0, 0), Fraction(2), (1, 1, 1))
    >>> str(moved[6]), str(moved[16])
    ('2', '-2')
    """
    g, b, a, c = metric, base, platform, values
    turned = [unit * (c[1 + j] - 2 * c[0] * g[j] * a[j]) for j in range(3)]
    position = [unit * (c[4 + i] + 2 * c[0] * g[i] * b[i]) for i in range(3)]
    rotation = [
        c[7 + 3 * i + j] + g[i] * b[i] * (c[1 + j] / g[j] - 2 * c[0] * a[j]) - c[4 + i] * a[j]
        for i in range(3)
        for j in range(3)
    ]
    constant = c[16] + sum(
        (c[0] * g[k] * (a[k] ** 2 + b[k] ** 2) - c[1 + k] * a[k] + c[4 + k] * b[k] for k in range(3)), _ZERO
    )
    return (unit**2 * c[0], *turned, *position, *rotation, constant)


def scale(values: Form, metric: Sequence[int], length: Fraction) -> Fraction:
    """The square of the size of the force in a form's wrench, as far as its coefficients tell; else of the moment.

    Examples
    --------
    >>> plane = form(position=(Fraction(3), Fraction(4), Fraction(0)))
    >>> str(scale(plane, (1, 1, 1), Fraction(1)))
    '25'
    """
    square = (2 * values[0] * length) ** 2
    for first in (1, 4):
        square += _sum_of_squares((values[first + i], Fraction(1, metric[i])) for i in range(3))
    if square:
        return square
    entries = ((values[7 + 3 * i + j], Fraction(metric[j], metric[i])) for i in range(3) for j in range(3))
    return _sum_of_squares(entries) / length**2 or Fraction(1)


def _sum_of_squares(weighted: Iterable[tuple[Any, Fraction]]) -> Fraction:
    """Rational, of a direction in square roots too where it has been turned from a rational one."""
    total = sum((value * value * weight for value, weight in weighted), _ZERO)
    if isinstance(total, Fraction):
        return total
    from pkm_exact.radicals import RootSum

    found = RootSum.of(total).rational
    if found is None:
        raise InputError("a direction's length squared is not rational; give joint values that leave it rational")
    return found


def value_at(
    values: Sequence[Any], position: Sequence[Any], rotation: Sequence[Sequence[Any]], metric: Sequence[int]
) -> Any:
    """The value of a form at a pose (C, R), over any ring that contains the inverses of the metric.

    Examples
    --------
    >>> unit = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    >>> value_at([1, 2, 0, 0, *[0] * 12, 5], (Fraction(3), 0, 0), unit, (1, 1, 1))
    Fraction(20, 1)
    """
    g = metric
    weighted = [g[i] * position[i] for i in range(3)]
    total = values[0] * (weighted[0] * position[0] + weighted[1] * position[1] + weighted[2] * position[2]) + values[16]
    for j in range(3):
        column = rotation[0][j] * weighted[0] + rotation[1][j] * weighted[1] + rotation[2][j] * weighted[2]
        total = total + values[1 + j] * column / g[j] + values[4 + j] * position[j]
        for i in range(3):
            total = total + values[7 + 3 * i + j] * rotation[i][j]
    return total


def wrench(values: Sequence[Any], position: Sequence[Any], rotation: Sequence[Sequence[Any]]) -> list[Any]:
    """The derivative of a form along a twist (v, w), v the velocity of the platform's origin, in ordinary coordinates.

    Examples
    --------
    >>> unit = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    >>> wrench([1, *[0] * 16], (3, 4, 5), unit)
    [6, 8, 10, 0, 0, 0]
    """
    moved = [sum((rotation[i][j] * values[1 + j] for j in range(1, 3)), rotation[i][0] * values[1]) for i in range(3)]
    force = [2 * (values[0] * position[i]) + moved[i] + values[4 + i] for i in range(3)]
    moment = []
    for _, j, k in _CYCLIC:
        total = moved[j] * position[k] - moved[k] * position[j]
        for column in range(3):
            total = total + rotation[j][column] * values[7 + 3 * k + column]
            total = total - rotation[k][column] * values[7 + 3 * j + column]
        moment.append(total)
    return [*force, *moment]


def rational_wrench(
    values: Sequence[Any], position: Sequence[Any], rotation: Sequence[Sequence[Any]], metric: Sequence[int]
) -> list[Any]:
    """The wrench in rational coordinates: its six entries times non-zero numbers that depend on the metric alone.

    Ranks are those of the wrenches in ordinary coordinates, over any field. The first three entries are derivatives by
    the rational coordinates of C, the others along turns W with G W antisymmetric.

    Examples
    --------
    >>> unit = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    >>> rational_wrench([1, *[Fraction(0)] * 16], (3, 4, 5), unit, (1, 3, 1))[:3]
    [Fraction(6, 1), Fraction(24, 1), Fraction(10, 1)]
    """
    g = metric
    moved = [
        g[i] * sum((rotation[i][j] * (values[1 + j] / g[j]) for j in range(1, 3)), rotation[i][0] * (values[1] / g[0]))
        for i in range(3)
    ]
    force = [2 * g[i] * (values[0] * position[i]) + moved[i] + values[4 + i] for i in range(3)]
    moment = []
    for _, j, k in _CYCLIC:
        total = g[k] * (moved[j] * position[k]) - g[j] * (moved[k] * position[j])
        for column in range(3):
            total = total + g[j] * (rotation[j][column] * values[7 + 3 * k + column])
            total = total - g[k] * (rotation[k][column] * values[7 + 3 * j + column])
        moment.append(total)
    return [*force, *moment]
