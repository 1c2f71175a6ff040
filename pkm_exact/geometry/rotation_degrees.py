"""Rotations by angles in degrees: exact rational rotations, near the ones meant where these are not rational.

A turn by an angle is rational if the tangent of its half is: of the angles that are rational multiples of a right one
only the right ones themselves (Niven). Others become the turn whose half tangent, or cotangent, is the nearest multiple
of a power of two. What is off is bounded; it is never silently rounded.

Roll, pitch and yaw are turns about the fixed axes x, y, z, in this order: R = Rz(yaw) Ry(pitch) Rx(roll).
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Quaternion
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from flint import arb

NEAREST_TURN: Final = Fraction(1, 10**12)
"""How near a rotation in degrees is taken where nothing else is said: the greatest error of an entry of its matrix."""

MOST_DEGREES: Final = 10**6
_GUARD_BITS: Final = 32


def half_turn_pair(degrees: Fraction, nearest: Fraction = NEAREST_TURN) -> tuple[Fraction, Fraction]:
    """Cosine and sine of half an angle up to a common factor, rational.

    Parameters
    ----------
    degrees : Fraction
    nearest : Fraction
        Greatest difference, in radians, between the angle of the pair and the one given.

    Examples
    --------
    >>> half_turn_pair(Fraction(90)), half_turn_pair(Fraction(180))
    ((Fraction(1, 1), Fraction(1, 1)), (Fraction(0, 1), Fraction(1, 1)))
    >>> cos, sin = half_turn_pair(Fraction(60))
    >>> cos == 1, abs(float(sin) - 3**-0.5) < 1e-12
    (True, True)
    """
    angle = degrees % 720
    if angle % 180 == 0:
        cos, sin = ((1, 0), (0, 1), (-1, 0), (0, -1))[int(angle // 180)]
        return Fraction(cos), Fraction(sin)
    if angle % 90 == 0:
        cos, sin = ((1, 1), (-1, 1), (-1, -1), (1, -1))[int(angle // 180)]
        return Fraction(cos), Fraction(sin)
    return _near_pair(angle, nearest)


def _near_pair(angle: Fraction, nearest: Fraction) -> tuple[Fraction, Fraction]:
    from pkm_exact.precision import working_precision

    # The angle is twice the arc tangent: off by at most twice what the tangent is, half a unit of this grid at most.
    grid = 1
    while grid * nearest < 2:
        grid *= 2
    with working_precision(grid.bit_length() + _GUARD_BITS):
        sin, cos = sine_and_cosine(angle / 2)
        small_sine = bool(abs(sin) < abs(cos))
        ratio = (sin / cos if small_sine else cos / sin) * grid
        middle = ratio.mid().fmpq()
        number = Fraction(round(Fraction(int(middle.p), int(middle.q))), grid)
        sign = 1 if bool((cos if small_sine else sin) > 0) else -1
    return (Fraction(sign), sign * number) if small_sine else (sign * number, Fraction(sign))


def sine_and_cosine(degrees: Fraction) -> tuple[arb, arb]:
    """Sine and cosine of an angle as balls, at the precision in force.

    >>> sine_and_cosine(Fraction(30))[0]
    0.500000000000000
    """
    from flint import arb, fmpq

    return arb.sin_cos_pi_fmpq(fmpq(degrees.numerator, 180 * degrees.denominator))


def quaternion_of_angles(
    roll: Fraction, pitch: Fraction, yaw: Fraction, nearest: Fraction = NEAREST_TURN
) -> Quaternion:
    """A quaternion of any norm, scalar first, of the rotation R = Rz(yaw) Ry(pitch) Rx(roll), in degrees.

    Parameters
    ----------
    roll, pitch, yaw : Fraction
    nearest : Fraction
        Greatest error of an entry of the rotation matrix; 0 where all three are multiples of 90 degrees.

    Examples
    --------
    >>> [str(q) for q in quaternion_of_angles(Fraction(0), Fraction(0), Fraction(90))]
    ['1', '0', '0', '1']
    """
    (cx, sx), (cy, sy), (cz, sz) = (half_turn_pair(angle, nearest / 3) for angle in (roll, pitch, yaw))
    return (
        cz * cy * cx + sz * sy * sx,
        cz * cy * sx - sz * sy * cx,
        cz * sy * cx + sz * cy * sx,
        sz * cy * cx - cz * sy * sx,
    )


def is_exact_turn(degrees: Fraction) -> bool:
    """Whether a turn by this angle is rational.

    >>> is_exact_turn(Fraction(-90)), is_exact_turn(Fraction(45))
    (True, False)
    """
    return degrees % 90 == 0


def checked_degrees(angle: Fraction, where: str) -> Fraction:
    """The angle itself, refused if it is of no use.

    Raises
    ------
    InputError
        If it is beyond a million degrees.
    """
    if abs(angle) > MOST_DEGREES:
        raise InputError(
            f"{where}: {shown(angle)} is out of range; give degrees from -{MOST_DEGREES} to {MOST_DEGREES}"
        )
    return angle
