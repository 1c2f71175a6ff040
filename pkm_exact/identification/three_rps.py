"""The dynamics of a 3-RPS robot as measurements of its inertial parameters, at exact states.

Three legs in vertical planes through the centre of the base, 120 degrees apart: a hinge R at the radius of the base,
along the tangent; a slide P; a ball S at a corner of the equilateral platform. Lengths are such that the platform's
corners are at the distance 1 from its centre, and coordinates x are the ordinary ones divided by sqrt(3): in the metric
(3, 1, 1) all is rational, the platform's side sqrt(3) included. Bodies are numbered as in Mata et al.: 1 and 2 the
lower and the upper part of leg 1, 3 the platform, 4 and 5, 6 and 7 the other legs. The frame of 3 is at the corner of
leg 1, x towards that of leg 2; the frame of an upper part is at the ball, y along the hinge's axis, z along the leg;
that of a lower part is at the hinge, z along its axis. Reference: Mata, Farhat, Díaz-Rodríguez, Valera and Page,
"Dynamic parameter identification of parallel robots" (2008), Table 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Final

from pkm_exact.errors import InputError
from pkm_exact.identification.inertia import INERTIAL, Field, power_row
from pkm_exact.screws.exact_matrix import Row

METRIC: Final = (3, 1, 1)
BODIES: Final = 7
PARAMETERS: Final = tuple(f"{name}{body}" for body in range(1, BODIES + 1) for name in INERTIAL)
"""Names of all 70 parameters."""

_HALF: Final = Fraction(1, 2)
_CORNERS: Final = (
    (-_HALF, -_HALF, Fraction(0)),
    (_HALF, -_HALF, Fraction(0)),
    (Fraction(0), Fraction(1), Fraction(0)),
)


@dataclass(frozen=True)
class Jet:
    """A number with its first and second derivative along a motion."""

    value: Fraction
    first: Fraction = Fraction(0)
    second: Fraction = Fraction(0)

    def __add__(self, other: Jet) -> Jet:
        return Jet(self.value + other.value, self.first + other.first, self.second + other.second)

    def __sub__(self, other: Jet) -> Jet:
        return Jet(self.value - other.value, self.first - other.first, self.second - other.second)

    def __mul__(self, other: Jet) -> Jet:
        return Jet(
            self.value * other.value,
            self.first * other.value + self.value * other.first,
            self.second * other.value + 2 * self.first * other.first + self.value * other.second,
        )

    def inverse(self) -> Jet:
        """1 / x."""
        one = 1 / self.value
        first = -self.first * one * one
        return Jet(one, first, -self.second * one * one - 2 * self.first * one * first)

    def root(self) -> Jet:
        """The positive square root, of a number that has a rational one."""
        top, bottom = isqrt(self.value.numerator), isqrt(self.value.denominator)
        root = Fraction(top, bottom)
        if root * root != self.value:
            raise InputError(f"state: a leg has the length sqrt({self.value}); take a state with rational legs")
        first = self.first / (2 * root)
        return Jet(root, first, (self.second - 2 * first * first) / (2 * root))


@dataclass(frozen=True)
class State:
    """A state of motion: tilts a and b, and the height z of the platform's centre, with velocities and accelerations.

    The rotation is that of the quaternion (1, a, b, 0) in the metric; a turn about the vertical axis is not possible.

    Attributes
    ----------
    pose, velocity, acceleration : tuple of 3 Fraction
    """

    pose: tuple[Fraction, Fraction, Fraction]
    velocity: tuple[Fraction, Fraction, Fraction]
    acceleration: tuple[Fraction, Fraction, Fraction]

    def jets(self) -> tuple[Jet, Jet, Jet]:
        """The three coordinates along the motion."""
        a, b, z = (Jet(*x) for x in zip(self.pose, self.velocity, self.acceleration, strict=True))
        return a, b, z

    def towards(self, place: int) -> tuple[Jet, Jet, Jet]:
        """The three coordinates along the virtual motion of one of them."""
        a, b, z = (Jet(x, Fraction(int(k == place))) for k, x in enumerate(self.pose))
        return a, b, z


def measurements(state: State, base_radius: Fraction, gravity: Fraction) -> tuple[Row, ...]:
    """The three generalised forces of the inertia of all bodies, as rows in ``PARAMETERS``.

    The actuators' forces are combinations of them, and the other way round wherever the robot is not singular.

    Examples
    --------
    >>> zero, pose = (Fraction(0),) * 3, (Fraction(0), Fraction(0), Fraction(4, 3))
    >>> rows = measurements(State(pose, zero, zero), Fraction(2), Fraction(10))
    >>> [str(rows[2][PARAMETERS.index(name)]) for name in ("m1", "m2", "m3", "m5")]
    ['0', '10', '10', '10']
    """
    moving = _fields(state.jets(), base_radius, gravity, order=2)
    rows = []
    for place in range(3):
        virtual = _fields(state.towards(place), base_radius, Fraction(0), order=1)
        pairs = zip(virtual, moving, strict=True)
        metrics = [METRIC if body == 3 else (1, 1, 1) for body in range(1, BODIES + 1)]
        parts = (power_row(one, two, metric) for (one, two), metric in zip(pairs, metrics, strict=True))
        rows.append(tuple(value for part in parts for value in part))
    return tuple(rows)


def coefficient_in_side(value: Fraction, leading: str, other: str) -> tuple[Fraction, int, int]:
    """The coefficient of a parameter in a base parameter for a platform of the side L, in ordinary coordinates.

    Parameters
    ----------
    value : Fraction
        The coefficient for the platform above.
    leading, other : str
        Names of the leading parameter of the combination and of the parameter that has the coefficient.

    Returns
    -------
    tuple
        (q, j, k) for q sqrt(3)^j L^k, with j 0 or 1. Moments of first and second order are masses times L and L^2.

    Examples
    --------
    >>> coefficient_in_side(Fraction(-3, 2), "Ixx3", "my3")  # -sqrt(3)/2 L
    (Fraction(-1, 2), 1, 1)
    >>> coefficient_in_side(Fraction(-2, 3), "m5", "my3")  # -2/3 sqrt(3) / L
    (Fraction(-2, 3), 1, -1)
    """
    power = _order(leading) - _order(other)
    roots = _roots(leading) - _roots(other) - power
    return value * Fraction(3) ** (roots // 2), roots % 2, power


def _order(name: str) -> int:
    """The power of length in a parameter."""
    return 2 if name.startswith("I") else len(name.rstrip("0123456789")) - 1


def _roots(name: str) -> int:
    """By which power of sqrt(3) the parameter in ordinary coordinates is larger."""
    return int(name.rstrip("0123456789") in ("mx", "Ixy", "Ixz") and name.endswith("3"))


def _fields(coordinates: Sequence[Jet], base_radius: Fraction, gravity: Fraction, *, order: int) -> list[Field]:
    """First or second derivatives of the positions of the points of all bodies, less gravity, in their order."""
    turn, centre = _platform(coordinates)
    arms = [[_sum([row[k] * _jet(corner[k]) for k in range(3)]) for row in turn] for corner in _CORNERS]
    balls = [[c + arm for c, arm in zip(centre, arms_of, strict=True)] for arms_of in arms]
    radii = [_jet(-2) * balls[0][1], _jet(-2) * balls[1][1], balls[2][1]]

    def derived(x: Jet) -> Fraction:
        return x.first if order == 1 else x.second

    down = [Fraction(0), Fraction(0), gravity]
    platform = (
        [derived(x) + g for x, g in zip(balls[0], down, strict=True)],
        [[derived(x) for x in row] for row in turn],
    )
    legs: list[Field] = []
    for radius, ball in zip(radii, balls, strict=True):
        arm = (radius - _jet(base_radius), ball[2])
        length = _sum([x * x for x in arm]).root().inverse()
        u, v = (derived(x * length) for x in arm)
        zero = Fraction(0)
        # In the leg's plane: radius, tangent, height. Lower part: x along the leg, y up, z along the tangent.
        lower = [[u, -v, zero], [zero, zero, zero], [v, u, zero]]
        upper = [[v, zero, u], [zero, zero, zero], [-u, zero, v]]
        legs.append((down, lower))
        legs.append(([derived(radius), zero, derived(ball[2]) + gravity], upper))
    return [legs[0], legs[1], platform, *legs[2:]]


def _platform(coordinates: Sequence[Jet]) -> tuple[list[list[Jet]], list[Jet]]:
    """Rotation and centre of the platform, for which the three corners are in the planes of their legs."""
    a, b, z = coordinates
    two, three = _jet(2), _jet(3)
    # The rotation of the quaternion (1, a, b, 0) in the metric (3, 1, 1).
    square = three + three * a * a + b * b
    scale = square.inverse()
    diagonal = (three + three * a * a - b * b, three - three * a * a + b * b, three - three * a * a - b * b)
    turn = [
        [diagonal[0], two * a * b, two * b],
        [_jet(6) * a * b, diagonal[1], _jet(-6) * a],
        [_jet(-6) * b, _jet(6) * a, diagonal[2]],
    ]
    turn = [[entry * scale for entry in row] for row in turn]
    x = _sum([turn[0][k] * _jet(_CORNERS[2][k]) for k in range(3)])
    p, q = (_sum([row[k] * _jet(_CORNERS[0][k]) for k in range(3)]) for row in turn[:2])
    return turn, [_jet(0) - x, p - x - q, z]


def _jet(value: Fraction | int) -> Jet:
    return Jet(Fraction(value))


def _sum(jets: Sequence[Jet]) -> Jet:
    total = jets[0]
    for jet in jets[1:]:
        total = total + jet
    return total
