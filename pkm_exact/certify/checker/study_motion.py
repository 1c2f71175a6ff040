"""Rigid motions and legs, as the checker knows them: formulas that hold in any commutative ring.

Vectors u, v in rational coordinates have the scalar product u.v = g1 u1 v1 + g2 u2 v2 + g3 u3 v3 with positive integers
g (the metric); ordinary coordinates are sqrt(g_i) u_i. A pose, C and R with R^T G R = G and det R = 1, is given by
e = (e0, .., e3) and f = (f0, .., f3), both up to one common factor, with e0 f0 + e1 f1 + e2 f2 + e3 f3 = 0 and

    N(e) = g1 g2 g3 e0^2 + g1 e1^2 + g2 e2^2 + g3 e3^2 not 0.

Then N R, N C, N R^-1 C and N |C|^2 are quadratic forms in (e, f) (``Motion``), and the leg from A to C + R B has the
squared length l^2 iff

    N |C|^2 + 2 N B.(R^-1 C) - 2 N A.C - 2 N A.(R B) + N (|A|^2 + |B|^2 - l^2) = 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm
from operator import mul
from typing import Any, TypeAlias

Point: TypeAlias = tuple[Fraction, Fraction, Fraction]
Metric: TypeAlias = tuple[int, int, int]

PLANAR_LEGS = 3
"""A robot of three legs moves in the plane of the first two axes: C3 = 0, and R turns about the third axis."""

CYCLIC = ((0, 1, 2), (1, 2, 0), (2, 0, 1))


@dataclass(frozen=True)
class Leg:
    """A leg between base joint A and platform joint B, with its squared length."""

    base: Point
    platform: Point
    length_squared: Fraction


@dataclass(frozen=True)
class Motion:
    """N(e) times (1, R, C, R^-1 C, |C|^2), in the ring of the coordinates; ``study`` is e.f, which must vanish."""

    norm: Any
    rotation: tuple[tuple[Any, Any, Any], ...]
    position: tuple[Any, Any, Any]
    turned: tuple[Any, Any, Any]
    square: Any
    study: Any

    def coordinates(self) -> list[Any]:
        """All 17 quantities in the order of ``leg_form``."""
        return [
            self.norm,
            *(entry for row in self.rotation for entry in row),
            *self.position,
            *self.turned,
            self.square,
        ]


def motion(e: Sequence[Any], f: Sequence[Any], metric: Metric) -> Motion:
    """The quantities of the pose (e, f), in the ring of its coordinates.

    Examples
    --------
    >>> half_turn = motion((0, 0, 0, 1), (-7, 6, -5, 0), (1, 1, 1))
    >>> half_turn.rotation, half_turn.position, half_turn.square
    (((-1, 0, 0), (0, -1, 0), (0, 0, 1)), (5, 6, 7), 110)
    """
    volume = metric[0] * metric[1] * metric[2]
    real = times(volume, e[0] * e[0])
    squares = [times(metric[i], e[i + 1] * e[i + 1]) for i in range(3)]
    norm = real + squares[0] + squares[1] + squares[2]
    rotation = [[norm] * 3 for _ in range(3)]
    position, turned = [norm] * 3, [norm] * 3
    for i, j, k in CYCLIC:
        rotation[i][i] = real + squares[i] - squares[j] - squares[k]
        mixed, turn = e[i + 1] * e[j + 1], times(metric[k], e[0] * e[k + 1])
        rotation[i][j] = 2 * metric[j] * (mixed - turn)
        rotation[j][i] = 2 * metric[i] * (mixed + turn)
        even = times(metric[j] * metric[k], e[0] * f[i + 1]) - e[i + 1] * f[0]
        odd = times(metric[j], e[j + 1] * f[k + 1]) - times(metric[k], e[k + 1] * f[j + 1])
        position[i], turned[i] = even + odd, even - odd
    square = f[0] * f[0]
    for i, j, k in CYCLIC:
        square = square + times(metric[j] * metric[k], f[i + 1] * f[i + 1])
    study = e[0] * f[0] + e[1] * f[1] + e[2] * f[2] + e[3] * f[3]
    return Motion(
        norm,
        tuple((row[0], row[1], row[2]) for row in rotation),
        (position[0], position[1], position[2]),
        (turned[0], turned[1], turned[2]),
        square,
        study,
    )


def leg_form(leg: Leg, metric: Metric) -> list[int]:
    """Integer coefficients of the leg equation on ``Motion.coordinates``, a positive multiple of those above.

    Examples
    --------
    >>> origin = (Fraction(0), Fraction(0), Fraction(0))
    >>> leg_form(Leg(origin, origin, Fraction(1, 4)), (1, 1, 1))
    [-1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4]
    """
    scale = lcm(*(value.denominator for value in (*leg.base, *leg.platform)))
    base, platform = (
        [value.numerator * (scale // value.denominator) for value in point] for point in (leg.base, leg.platform)
    )
    a, b = ([g * x for g, x in zip(metric, point, strict=True)] for point in (base, platform))
    square, part = leg.length_squared.numerator * scale**2, leg.length_squared.denominator
    row = [
        part * (sum(map(mul, a, base)) + sum(map(mul, b, platform))) - square,
        *(-2 * part * x * y for x in a for y in platform),
        *(-2 * part * scale * x for x in a),
        *(2 * part * scale * x for x in b),
        part * scale**2,
    ]
    common = gcd(*row)
    return [value // common for value in row]


def combination(scalars: Sequence[int], values: Sequence[Any]) -> Any:
    """The sum of the products, in any ring."""
    total = times(scalars[0], values[0])
    for scalar, value in zip(scalars[1:], values[1:], strict=True):
        if scalar:
            total = total + times(scalar, value)
    return total


def times(scalar: int, value: Any) -> Any:
    """A multiple, in any ring; most metrics are 1."""
    return value if scalar == 1 else scalar * value


def leg_lines(legs: Sequence[Leg], placed: Motion) -> list[list[Any]]:
    """A 6 x 6 matrix that is regular iff the lines of the six legs are independent (Pluecker coordinates).

    For a planar robot it is 3 x 3: the third line coordinate and the first two moments are 0.

    Row i is (q q d, q b x q d) with d = N (C + R B - A) the leg, b = N R B its arm and q a common denominator of all
    joints. In a metric G both halves are the ordinary coordinates up to a factor for each column.
    """
    joints = [value for leg in legs for value in (*leg.base, *leg.platform)]
    scale = lcm(*(value.denominator for value in joints))
    rows = []
    for leg in legs:
        base, platform = (
            [value.numerator * (scale // value.denominator) for value in joint] for joint in (leg.base, leg.platform)
        )
        arm = [combination(platform, row) for row in placed.rotation]
        line = [scale * placed.position[i] + arm[i] - base[i] * placed.norm for i in range(3)]
        moment = [arm[j] * line[k] - arm[k] * line[j] for _, j, k in CYCLIC]
        if len(legs) == PLANAR_LEGS:
            rows.append([scale * line[0], scale * line[1], moment[2]])
        else:
            rows.append([scale * value for value in line] + moment)
    return rows
