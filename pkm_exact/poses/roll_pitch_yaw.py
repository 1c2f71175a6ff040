"""Roll, pitch and yaw of a pose: R = Rz(yaw) Ry(pitch) Rx(roll), in degrees, enclosed."""

from __future__ import annotations

from fractions import Fraction

from flint import arb

from pkm_exact.balls import ball
from pkm_exact.poses.planar_coordinates import GUARD_BITS, angle_in_degrees
from pkm_exact.poses.pose import Pose
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval

_ONE = Fraction(1)


def roll_pitch_yaw(pose: Pose) -> tuple[Interval | None, Interval, Interval | None]:
    """Bounds for the three angles; None for roll and yaw where the box does not tell them apart, at a pitch near 90.

    The pitch is from -90 to 90 degrees, the others from -180 to 180.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> pose = Robot.load("models/3-rpr-merlet-p.toml").solve().poses[1]
    >>> roll, pitch, yaw = roll_pitch_yaw(pose)
    >>> 0 in roll, 0 in pitch, abs(float(yaw)) < 1e-6
    (True, True, True)
    """
    (first, _, _), (second, _, _), (down, side, up) = pose.rotation
    return angle_in_degrees(up, side), _pitch(down), angle_in_degrees(first, second)


def _pitch(down: Interval) -> Interval:
    """-asin of the entry r31."""
    longest = max(end.denominator.bit_length() for end in (down.lo, down.hi))
    with working_precision(longest + GUARD_BITS):
        low, high = (-180 * ball(max(-_ONE, min(_ONE, end))).asin() / arb.pi() for end in (down.hi, down.lo))
        return Interval(_fraction(low.lower()), _fraction(high.upper()))


def _fraction(value: arb) -> Fraction:
    exact = value.fmpq()
    return Fraction(int(exact.p), int(exact.q))
