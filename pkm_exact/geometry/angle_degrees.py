"""Angles in degrees as exact points of a circle: a rational half tangent near them, and by how much it is off.

Of rational numbers of degrees, the squared half tangent is rational at 0, 60, 90, 120 and 180 degrees only, where it
is 0, 1/3, 1, 3 and infinite (Niven's theorem: 4 / (1 + t^2) is twice 1 + cos, and an algebraic integer). Every other
angle has a stand-in: with exact (C, S) on the circle and (c, s) the cosine and sine of the angle, known to 10^-40,

    |difference| <= pi/2 |S c - C s|,    so that 90 |S c - C s| degrees bound it where C c + S s > 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, isqrt
from typing import Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import CosSin, cosine_and_sine
from pkm_exact.geometry.rational import NumberText, finite_decimal, parse_rational, rational_root
from pkm_exact.geometry.rotation_degrees import sine_and_cosine
from pkm_exact.wording import shown

_GRID: Final = 10**45
_SLACK: Final = Fraction(1, 10**39)
"""More than the errors of cosine and sine, which are below 10^-40 each."""
_BITS: Final = 160
_DENOMINATOR: Final = 10**9
"""Of a half tangent that stands in for another: it is off by less than 10^-18 then."""
_ONE_BY_ONE: Final = 3
_SQUARES: Final = {0: Fraction(0), 60: Fraction(1, 3), 90: Fraction(1), 120: Fraction(3)}


@dataclass(frozen=True)
class StandIn:
    """An angle that was given in degrees, and the exact one that took its place.

    Attributes
    ----------
    name : str
        Of the actuator, or the place in the file.
    degrees : Fraction
        As given.
    half_tangent : Fraction
        As taken, divided by the square root of the weight.
    off : Fraction
        Greatest difference, in degrees.
    """

    name: str
    degrees: Fraction
    half_tangent: Fraction
    off: Fraction

    def __str__(self) -> str:
        given = finite_decimal(self.degrees) or str(self.degrees)
        return (
            f"{self.name} was given as {given} degrees, whose cosine and sine are not both rational here; the half "
            f"tangent {self.half_tangent} stands in for it, off by at most {float(self.off):.0e} degrees, and what is "
            "proved is proved for that angle"
        )


def stand_in_sentences(found: Sequence[StandIn | str]) -> tuple[str, ...]:
    """What stands in for what, in words: one by one, or in one sentence if there are more than three angles.

    Examples
    --------
    >>> angles = [StandIn(f"arm {k}", Fraction(k), Fraction(1), Fraction(1, 10**16)) for k in range(1, 6)]
    >>> print(*stand_in_sentences(angles))
    5 angles were given in degrees whose cosines and sines are not all rational here (arm 1, arm 2, .., arm 5); \
rational half tangents stand in for them, each off by at most 1e-16 degrees, and what is proved is proved for those
    """
    angles = [entry for entry in found if isinstance(entry, StandIn)]
    if len(angles) <= _ONE_BY_ONE:
        return tuple(map(str, found))
    most = max(angle.off for angle in angles)
    sentence = (
        f"{len(angles)} angles were given in degrees whose cosines and sines are not all rational here "
        f"({angles[0].name}, {angles[1].name}, .., {angles[-1].name}); rational half tangents stand in for them, each "
        f"off by at most {float(most):.0e} degrees, and what is proved is proved for those"
    )
    return (*(entry for entry in found if isinstance(entry, str)), sentence)


def angle_in_degrees(
    value: object, where: str, weight: int = 1, *, exact: bool = False
) -> tuple[CosSin, StandIn | None]:
    """The point (c, s) of the circle c^2 + w s^2 = 1 at an angle, and what stands in for the angle if that is not
    exact.

    Parameters
    ----------
    value : object
        A number of degrees, from -360 to 360.
    where : str
        Name of the actuator or field.
    weight : int
        w.
    exact : bool
        Whether an angle without exact cosine and sine is refused.

    Examples
    --------
    >>> point, stand_in = angle_in_degrees("60", "arm 1", 3)
    >>> [str(x) for x in point], stand_in is None
    (['1/2', '1/2'], True)
    >>> point, stand_in = angle_in_degrees("37", "arm 1")
    >>> point[0] ** 2 + point[1] ** 2 == 1, stand_in.off < Fraction(1, 10**15)
    (True, True)
    """
    degrees = parse_rational(NumberText(value) if isinstance(value, str) and "/" not in value else value, where)
    if abs(degrees) > 360:
        raise InputError(f"{where}: {shown(value)} is out of range; give an angle from -360 to 360 degrees")
    angle = degrees - 360 if degrees > 180 else degrees + 360 if degrees <= -180 else degrees
    if angle == 180:
        return (Fraction(-1), Fraction(0)), None
    square = _SQUARES.get(int(abs(angle))) if angle.denominator == 1 else None
    root = None if square is None else rational_root(square / weight)
    if root is not None:
        return cosine_and_sine(root if angle > 0 else -root, weight), None
    if exact:
        raise InputError(
            f"{where}: cosine and sine of {shown(value)} degrees are not both rational here, and exact = true; give a "
            "half tangent or cosine and sine that are, or take exact out"
        )
    half_sine, half_cosine = _sine_and_cosine(angle / 2)
    scale = Fraction(isqrt(weight * _GRID**2), _GRID)
    tangent = (half_sine / (half_cosine * scale)).limit_denominator(_DENOMINATOR)
    point = cosine_and_sine(tangent, weight)
    return point, StandIn(where, degrees, tangent, _difference(point, weight, angle))


def _difference(point: CosSin, weight: int, angle: Fraction) -> Fraction:
    """A bound on how many degrees lie between a point of the circle and an angle."""
    sine, cosine = _sine_and_cosine(angle)
    root = Fraction(isqrt(weight * _GRID**2), _GRID)
    across = abs(point[1] * root * cosine - point[0] * sine) + _SLACK
    along = point[0] * cosine + point[1] * root * sine
    return _rounded_up(90 * across) if along > _SLACK else Fraction(180)


def _rounded_up(number: Fraction) -> Fraction:
    """The next number with one significant digit, for a positive one."""
    unit = Fraction(1)
    while unit > number:
        unit /= 10
    return ceil(number / unit) * unit


def _sine_and_cosine(degrees: Fraction) -> tuple[Fraction, Fraction]:
    """Both, to 10^-40, of an angle."""
    from pkm_exact.precision import working_precision

    with working_precision(_BITS):
        sine, cosine = (value.mid().fmpq() for value in sine_and_cosine(degrees))
    return Fraction(int(sine.p), int(sine.q)), Fraction(int(cosine.p), int(cosine.q))
