"""From boxes of unknowns to poses of bodies: known entries exactly, quaternions enclosed.

Unknowns are in the coordinates of the metric; poses are in ordinary ones, sqrt(g_i) times the position and
sqrt(g_i / g_j) times the entries of the rotation matrix, rounded outwards where that is irrational.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import ceil, floor, isqrt
from typing import Final

from flint import arb

from pkm_exact.balls import hull
from pkm_exact.geometry.inverse import UNIT_METRIC, Metric
from pkm_exact.links.link_equations import AXES, BodyUnknowns
from pkm_exact.poses.pose import Pose
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval

GUARD_BITS: Final = 64
_FINER: Final = 16
_ZERO: Final = Interval(Fraction(0), Fraction(0))
_ONE: Final = Interval(Fraction(1), Fraction(1))
_UNIT: Final = tuple(tuple(_ONE if i == j else _ZERO for j in AXES) for i in AXES)


def body_pose(
    body: BodyUnknowns,
    values: Mapping[str, Interval],
    multiplicity: int | None,
    exponent: int,
    metric: Metric = UNIT_METRIC,
) -> Pose:
    """The pose of a body where its unknowns have these bounds; its quaternion on the grid 2^-exponent."""
    g = list(map(Fraction, metric))
    position = (_ZERO if name is None else values[name] for name in body.position)
    x, y, z = (_times_root(value, square, exponent) for value, square in zip(position, g, strict=True))
    rotation = _UNIT
    if body.turn is not None:
        c, s = (values[name] for name in body.turn)
        s = _times_root(s, g[0] * g[1], exponent)
        rotation = ((c, Interval(-s.hi, -s.lo), _ZERO), (s, c, _ZERO), (_ZERO, _ZERO, _ONE))
    elif body.rotation is not None:
        rotation = tuple(
            tuple(_times_root(values[body.rotation[i][j]], g[i] / g[j], exponent) for j in AXES) for i in AXES
        )
    return Pose(None, (x, y, z), rotation, unit_quaternion(rotation, exponent), multiplicity)


def unknowns_width(width: Fraction, metric: Metric) -> Fraction:
    """How wide boxes of unknowns may be, for coordinates and entries of matrices no wider than ``width``.

    Examples
    --------
    >>> str(unknowns_width(Fraction(1), (1, 3, 1))), str(unknowns_width(Fraction(1, 10), (1, 1, 1)))
    ('1/2', '1/10')
    """
    largest = metric[0] * metric[1] * metric[2]
    return width if largest == 1 else width / (isqrt(largest) + 1)


def _times_root(value: Interval, square: Fraction, exponent: int) -> Interval:
    """Bounds times the square root of a positive rational number, outwards on a finer grid."""
    if square == 1 or value.lo == value.hi == 0:
        return value
    with working_precision(2 * exponent + GUARD_BITS):
        product = hull(value.lo, value.hi) * (arb(square.numerator) / square.denominator).sqrt()
        return _on_grid(product, exponent + _FINER)


def unit_quaternion(
    rotation: Sequence[Sequence[Interval]], exponent: int
) -> tuple[Interval, Interval, Interval, Interval]:
    """Bounds for the unit quaternion of a rotation matrix, the component positive that is largest at its middle.

    With 4 q_k^2 = 1 +- r11 +- r22 +- r33 and 4 q_k q_m the sums and differences of the other entries.

    Examples
    --------
    >>> quarter = ((_ZERO, Interval(Fraction(-1), Fraction(-1)), _ZERO), (_ONE, _ZERO, _ZERO), (_ZERO, _ZERO, _ONE))
    >>> [round(float(value.midpoint), 6) for value in unit_quaternion(quarter, 20)]
    [0.707107, 0.0, 0.0, 0.707107]
    """
    with working_precision(2 * exponent + GUARD_BITS):
        r = [[hull(value.lo, value.hi) for value in row] for row in rotation]
        products = [[arb(0)] * 4 for _ in range(4)]
        for k in range(4):
            signs = [1 if k in (0, axis + 1) else -1 for axis in AXES]
            products[k][k] = 1 + sum((sign * r[axis][axis] for sign, axis in zip(signs, AXES, strict=True)), arb(0))
        for i, a, b in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            products[0][i + 1] = products[i + 1][0] = r[b][a] - r[a][b]
            products[a + 1][b + 1] = products[b + 1][a + 1] = r[a][b] + r[b][a]
        largest = max(range(4), key=lambda k: float(products[k][k].mid()))
        length = products[largest][largest].sqrt()
        q0, q1, q2, q3 = (_on_grid(product / length / 2, exponent) for product in products[largest])
        return q0, q1, q2, q3


def _on_grid(value: arb, exponent: int) -> Interval:
    low, high = (_fraction(end) * (1 << exponent) for end in (value.lower(), value.upper()))
    return Interval(Fraction(floor(low), 1 << exponent), Fraction(ceil(high), 1 << exponent))


def _fraction(value: arb) -> Fraction:
    exact = value.fmpq()
    return Fraction(int(exact.p), int(exact.q))
