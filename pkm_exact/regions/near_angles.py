"""Rational numbers beside the cosines of angles in degrees: on the tight and on the loose side of a limit."""

from __future__ import annotations

from fractions import Fraction
from math import floor
from typing import Final

from flint import arb, fmpq

from pkm_exact.geometry.rotation_degrees import half_turn_pair
from pkm_exact.precision import working_precision

_BITS: Final = 64
_RATIONAL: Final = {0: Fraction(1), 30: Fraction(3, 4), 45: Fraction(1, 2), 60: Fraction(1, 4), 90: Fraction(0)}
BESIDE: Final = Fraction(1, 10**10)
"""By how many degrees the rational directions beside an angle are off, at most."""


def squared_cosines(angle: Fraction) -> tuple[Fraction, Fraction]:
    """Two rationals, the second below the square of the cosine for a cone up to 90 degrees, the first above.

    Beyond 90 degrees the cone is tight where the square is small: then the first is below. Equal where it is rational.

    Examples
    --------
    >>> squared_cosines(Fraction(60)), squared_cosines(Fraction(150))
    ((Fraction(1, 4), Fraction(1, 4)), (Fraction(3, 4), Fraction(3, 4)))
    >>> tight, loose = squared_cosines(Fraction(20))
    >>> tight - loose == Fraction(1, 2**64), abs(float(loose) - 0.883022221559489) < 1e-14
    (True, True)
    """
    acute = min(angle, 180 - angle)
    if acute in _RATIONAL:
        return (_RATIONAL[int(acute)],) * 2
    with working_precision(4 * _BITS):
        cosine = arb.cos_pi_fmpq(fmpq(angle.numerator, 180 * angle.denominator))
        middle = (cosine * cosine).mid().fmpq()
    low = Fraction(floor(Fraction(int(middle.p), int(middle.q)) * 2**_BITS), 2**_BITS)
    high = low + Fraction(1, 2**_BITS)
    return (high, low) if angle <= 90 else (low, high)


def turn_directions(angle: Fraction, side: int) -> tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]:
    """Two rational directions (cos, sin): one beyond the angle, towards what is allowed, and one before it.

    Equal where they are rational.

    Parameters
    ----------
    angle : Fraction
        In degrees.
    side : int
        1 if greater angles are allowed, -1 if smaller ones are.

    Examples
    --------
    >>> turn_directions(Fraction(90), 1)
    ((Fraction(0, 1), Fraction(1, 1)), (Fraction(0, 1), Fraction(1, 1)))
    """
    if angle % 90 == 0:
        return (_direction(angle),) * 2
    return _direction(angle + side * BESIDE / 2), _direction(angle - side * BESIDE / 2)


def _direction(angle: Fraction) -> tuple[Fraction, Fraction]:
    c, s = half_turn_pair(angle, Fraction(1, 10**13))
    norm = c * c + s * s
    return (c * c - s * s) / norm, 2 * c * s / norm
