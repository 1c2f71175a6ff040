"""Joints in three pairs on a circle, by radius and angles in degrees: how drawings give most hexapods.

The pairs stand 120 degrees apart, the first at any azimuth. The platform's are usually turned against the base's by 60
degrees: the two joints of a base pair are then joined to two neighbouring platform pairs. Joint i of the platform is
the one that is nearest in azimuth to joint i of the base.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import CosSin
from pkm_exact.geometry.kinds import Joints
from pkm_exact.geometry.rotation_degrees import checked_degrees, half_turn_pair
from pkm_exact.wording import shown

BOTTOM: Final = Fraction(-90)
"""Where the first pair is if nothing is said: joints 1 and 2 are on a parallel to the x-axis, at the bottom."""

_NEAREST: Final = Fraction(1, 10**40)


@dataclass(frozen=True)
class Ring:
    """Six joints on a circle around the origin.

    Attributes
    ----------
    radius : Fraction
    degrees : Fraction
        Angle between the two joints of a pair, from 0 to 120.
    azimuth : Fraction
        Of the middle of the first pair, in degrees from the x-axis to the y-axis.
    """

    radius: Fraction
    degrees: Fraction
    azimuth: Fraction = BOTTOM

    def __post_init__(self) -> None:
        if self.radius <= 0 or not 0 <= self.degrees <= 120:
            raise InputError(
                f"radius {shown(self.radius)}, angle {shown(self.degrees)}: out of range; give a radius, and an angle "
                "from 0 to 120 degrees"
            )
        checked_degrees(self.azimuth, "azimuth")

    @property
    def azimuths(self) -> tuple[Fraction, ...]:
        """Of the six joints, in degrees, pair by pair.

        >>> [str(azimuth) for azimuth in Ring(Fraction(1), Fraction(20)).azimuths]
        ['-100', '-80', '20', '40', '140', '160']
        """
        pairs = (self.azimuth, self.azimuth + 120, self.azimuth + 240)
        return tuple(middle + half for middle in pairs for half in (-self.degrees / 2, self.degrees / 2))


def ring_joints(ring: Ring, azimuths: tuple[Fraction, ...], digits: int) -> Joints:
    """Joints of a ring at the given azimuths, rounded to so many decimals.

    Examples
    --------
    >>> ring = Ring(Fraction(100), Fraction(60), Fraction(30))
    >>> [float(x) for x in ring_joints(ring, ring.azimuths, 3)[1]]
    [50.0, 86.603, 0.0]
    """
    unit = Fraction(10) ** -digits
    places = [direction(azimuth, _NEAREST) for azimuth in azimuths]
    return tuple(
        (round(ring.radius * c / unit) * unit, round(ring.radius * s / unit) * unit, Fraction(0)) for c, s in places
    )


def facing(base: Ring, platform: Ring) -> tuple[Fraction, ...]:
    """The platform's azimuths in such an order that its joint i is nearest to joint i of the base.

    Of the orders around the circle the one whose greatest difference is least; the first of them if they are equal.

    Examples
    --------
    >>> base, platform = Ring(Fraction(3), Fraction(20)), Ring(Fraction(2), Fraction(30), Fraction(-30))
    >>> [str(azimuth) for azimuth in facing(base, platform)]
    ['-135', '-45', '-15', '75', '105', '195']
    """
    around = sorted(platform.azimuths, key=lambda azimuth: azimuth % 360)
    orders = [tuple(around[first:] + around[:first]) for first in range(6)]
    best = min(orders, key=lambda order: max(map(_apart, order, base.azimuths)))
    return tuple(there + 360 * round((here - there) / 360) for here, there in zip(base.azimuths, best, strict=True))


def _apart(one: Fraction, other: Fraction) -> Fraction:
    difference = (one - other) % 360
    return min(difference, 360 - difference)


def direction(azimuth: Fraction, nearest: Fraction) -> CosSin:
    """Cosine and sine of an angle in degrees: rational, of a direction that differs by at most ``nearest``.

    Examples
    --------
    >>> [str(x) for x in direction(Fraction(-90), Fraction(1, 10))]
    ['0', '-1']
    """
    c, s = half_turn_pair(azimuth, nearest)
    norm = c * c + s * s
    return (c * c - s * s) / norm, 2 * c * s / norm


def motor_directions(base: Ring, outward: Fraction = Fraction(0)) -> tuple[Vector, ...]:
    """Unit vectors along the cranks at 0 degrees: tangent to the circle, away from the other joint of the pair.

    ``outward`` turns them, in degrees: 90 is away from the centre, 180 towards the other joint; mirrored in each pair.

    Examples
    --------
    >>> [[str(x) for x in motor_directions(Ring(Fraction(3), Fraction(0)), turn)[1]] for turn in (0, Fraction(90))]
    [['1', '0', '0'], ['0', '-1', '0']]
    """
    pairs = (base.azimuth, base.azimuth + 120, base.azimuth + 240)
    quarters = (outward - 90, 90 - outward)
    turned = [direction(middle + quarter, Fraction(1, 10**4)) for middle in pairs for quarter in quarters]
    return tuple((c, s, Fraction(0)) for c, s in turned)
