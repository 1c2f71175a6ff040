"""How far certified poses are from intended ones: between which bounds, and whether that is within what is allowed.

The angle w of the turn between two rotations has |R - S| = 2 sqrt(2) sin(w / 2), norm of Frobenius: well enclosed also
where it is small.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Final

from flint import arb

from pkm_exact.balls import ball, hull
from pkm_exact.poses.limit_checks import LimitVerdict, together
from pkm_exact.precision import working_precision
from pkm_exact.regions.jets import constant, parameter
from pkm_exact.regions.machine_on_path import rotation_on_path
from pkm_exact.roots.interval import Interval

if TYPE_CHECKING:
    from pkm_exact.poses.pose import Pose

_PRECISION: Final = 192


@dataclass(frozen=True)
class Deviation:
    """Between which bounds a certified pose is off.

    Attributes
    ----------
    distance : Interval
        Of the platform's origin, in ordinary coordinates.
    degrees : Interval
        Of the turn from one orientation to the other.
    """

    distance: Interval
    degrees: Interval

    def within(self, distance: Fraction, degrees: Fraction) -> LimitVerdict:
        """Whether it is no more than that.

        Examples
        --------
        >>> ends = Interval(Fraction(1), Fraction(2))
        >>> off = Deviation(ends, ends)
        >>> print(off.within(Fraction(2), Fraction(2)), off.within(Fraction(9), Fraction(1, 2)))
        yes no
        """
        return together(
            LimitVerdict.YES if found.hi <= most else LimitVerdict.NO if found.lo > most else LimitVerdict.UNDECIDED
            for found, most in ((self.distance, distance), (self.degrees, degrees))
        )


def deviation(pose: Pose, columns: Sequence[str], row: Sequence[Fraction]) -> Deviation:
    """How far a certified pose is from an intended one.

    Parameters
    ----------
    pose : Pose
        Its box.
    columns, row : sequences
        The intended pose, as in ``geometry.pose_path_reader``.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> pose = Robot.load("models/3-rpr-merlet-p.toml").solve().poses[0]
    >>> place = [c.midpoint for c in pose.position[:2]]
    >>> off = deviation(pose, ("x", "y", "theta"), (place[0] + 3, place[1] + 4, Fraction(0)))
    >>> print(off.distance)
    5.000000000
    """
    with working_precision(_PRECISION):
        s = parameter(Fraction(0), Fraction(0))
        moving = {name: constant(ball(value), s) for name, value in zip(columns, row, strict=True)}
        zero = arb(0)
        square = sum(
            (
                _squared(hull(c.lo, c.hi) - (moving[name].middle if name in moving else zero))
                for c, name in zip(pose.position, ("x", "y", "z"), strict=True)
            ),
            zero,
        )
        turned = rotation_on_path(moving, s)
        chord = sum(
            (
                _squared(hull(mine.lo, mine.hi) - entry.middle)
                for own, line in zip(pose.rotation, turned, strict=True)
                for mine, entry in zip(own, line, strict=True)
            ),
            zero,
        )
        return Deviation(_grown(square, _root), _grown(chord, _angle))


def _squared(value: arb) -> arb:
    return value * value  # a power of a ball about 0 is no number


def _root(square: arb) -> arb:
    return square.sqrt()


def _angle(chord: arb) -> arb:
    """In degrees, from the square of a chord."""
    return 360 * (chord / 8).sqrt().min(arb(1)).asin() / arb.pi()


def _grown(value: arb, growing: Callable[[arb], arb]) -> Interval:
    """The values of a growing function over what is not negative of a ball: from those at its ends."""
    low, high = (growing(end.max(arb(0))) for end in (value.lower(), value.upper()))
    return Interval(max(_exact(low.lower()), Fraction(0)), max(_exact(high.upper()), Fraction(0)))


def _exact(value: arb) -> Fraction:
    mantissa, exponent = value.mid().man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)
