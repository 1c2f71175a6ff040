"""Poses of planar robots as (x, y, theta): the coordinates of a pose's box that say something."""

from __future__ import annotations

from fractions import Fraction

from flint import arb

from pkm_exact.balls import hull
from pkm_exact.poses.pose import Pose
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval

GUARD_BITS = 64
"""Bits beyond the size of a box in which its angle is computed."""


def planar_coordinates(pose: Pose) -> dict[str, Interval]:
    """Bounds for x, y, cos(theta) and sin(theta), in ordinary coordinates."""
    return {
        "x": pose.position[0],
        "y": pose.position[1],
        "cos": pose.rotation[0][0],
        "sin": pose.rotation[1][0],
    }


def angle_in_degrees(cos: Interval, sin: Interval) -> Interval | None:
    """Bounds for the angle with these bounds for cosine and sine; None if both may be 0.

    The angle lies between -180 and 180 degrees; an interval around 180 reaches beyond, it is not cut in two.

    Examples
    --------
    >>> near = Fraction(1, 1 << 40)
    >>> angle = angle_in_degrees(Interval(-1 - near, -1 + near), Interval(-near, near))
    >>> angle.contains(Fraction(180)), angle.width < Fraction(1, 10**9)
    (True, True)
    >>> angle_in_degrees(Interval(-near, near), Interval(-near, near)) is None
    True
    """
    if cos.contains(Fraction(0)) and sin.contains(Fraction(0)):
        return None
    longest = max(end.denominator.bit_length() for end in (cos.lo, cos.hi, sin.lo, sin.hi))
    with working_precision(longest + GUARD_BITS):
        c, s = hull(cos.lo, cos.hi), hull(sin.lo, sin.hi)
        if cos.hi < 0:  # away from the cut of the arctangent
            turns = -1 if sin.hi < 0 else 1
            angle = arb.atan2(-s, -c) + turns * arb.pi()
        else:
            angle = arb.atan2(s, c)
        angle = 180 * angle / arb.pi()
        return Interval(_exact(angle.lower()), _exact(angle.upper()))


def _exact(value: arb) -> Fraction:
    mantissa, power = value.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(power)
