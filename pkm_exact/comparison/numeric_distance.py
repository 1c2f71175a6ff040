"""How far a pose in floating point is from certified ones: certified bounds, and which of them it belongs to.

The distance between two poses is the greatest displacement of a platform joint, in the robot's unit of length, of a
mechanism that of a point of the platform that its constraints name, or of three along its axes:

    d = max_i |C + R B_i - C' - R' B_i|

A pose in floating point is taken as the rational numbers that its doubles are; a certified one is anywhere in its box.
Ball arithmetic gives an interval that contains d.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from typing import Final

from flint import arb, arb_mat

from pkm_exact.balls import ball, hull
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.numeric_mechanism import platform_markers
from pkm_exact.numeric.uncertified import NumericPose
from pkm_exact.poses.pose import Pose
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval

REACH: Final = Fraction(1, 1000)
"""A pose farther than this from a certified one, in times the platform's size, has nothing to do with it."""
CLEARANCE: Final = 10
"""Of the certified poses the nearest is meant if every other is this many times as far."""
GUARD_BITS: Final = 64
OUTPUT_BITS: Final = 24
"""Significant bits of the bounds returned."""


class Landing(StrEnum):
    """Where an iteration ended, seen from the certified poses.

    ``MODE``: at an assembly mode, the nearest certified pose; it is within reach and ``CLEARANCE`` times nearer than
    any other. ``BETWEEN``: within reach of a certified pose, but of which is not clear. ``SPURIOUS``: it claims to have
    converged, and no certified pose is within reach. ``NONE``: it does not claim to have converged.
    """

    MODE = "mode"
    BETWEEN = "between"
    SPURIOUS = "spurious"
    NONE = "none"


@dataclass(frozen=True)
class Judged:
    """What the certified poses say of one pose in floating point.

    Attributes
    ----------
    landing : Landing
    mode : int or None
        Number of the assembly mode, from 1, if it is at one.
    error : Interval or None
        Bounds for the distance to the nearest certified pose; None if there is none, or nothing has converged.
    """

    landing: Landing
    mode: int | None = None
    error: Interval | None = None


def platform_points(problem: ForwardProblem) -> list[Vector]:
    """Whose displacement is the distance: the platform joints; of a mechanism also three points along its axes."""
    return [leg.platform for leg in problem.gough_legs] if problem.is_gough else platform_markers(problem)


class Judge:
    """The certified poses of a robot, ready to be compared with.

    Parameters
    ----------
    problem : ForwardProblem
    poses : sequence of Pose
    size : Fraction
        The size of the platform, the unit of ``REACH``.
    """

    def __init__(self, problem: ForwardProblem, poses: Sequence[Pose], size: Fraction) -> None:
        self._reach = REACH * size
        ends = [end.denominator.bit_length() for pose in poses for end in (pose.position[0].lo, pose.rotation[0][0].lo)]
        self._precision = 64 + max(ends, default=0) + GUARD_BITS
        with working_precision(self._precision):
            scales = [arb(g).sqrt() for g in problem.metric]
            joints = platform_points(problem)
            rows = [[scale * ball(joint[i]) for joint in joints] for i, scale in enumerate(scales)]
            self._joints = arb_mat([*rows, [arb(1)] * len(joints)])
            self._places = [
                self._placed(
                    [
                        [*(hull(r.lo, r.hi) for r in row), hull(c.lo, c.hi)]
                        for row, c in zip(pose.rotation, pose.position, strict=True)
                    ]
                )
                for pose in poses
            ]

    def _placed(self, motion: list[list[arb]]) -> list[arb]:
        """C + R B_i for all joints, from the 3 x 4 matrix (R, C): all x, all y, all z."""
        return list((arb_mat(motion) * self._joints).entries())

    def distances(self, pose: NumericPose) -> list[Interval]:
        """Bounds for the distance to each certified pose."""
        with working_precision(self._precision):
            rows = zip(pose.rotation, pose.position, strict=True)
            place = self._placed([[*map(arb, row), arb(c)] for row, c in rows])
            return [_distance(place, other) for other in self._places]

    def judge(self, pose: NumericPose) -> Judged:
        """Where the pose is among the certified ones."""
        if not pose.converged:
            return Judged(Landing.NONE)
        distances = self.distances(pose)
        if not distances:
            return Judged(Landing.SPURIOUS)
        nearest = min(range(len(distances)), key=lambda k: distances[k].hi)
        error = Interval(min(distance.lo for distance in distances), distances[nearest].hi)
        if error.lo > self._reach:
            return Judged(Landing.SPURIOUS, None, _rounded(error))
        others = [distance.lo for k, distance in enumerate(distances) if k != nearest]
        if error.hi > self._reach or any(CLEARANCE * error.hi > other for other in others):
            return Judged(Landing.BETWEEN, None, _rounded(error))
        return Judged(Landing.MODE, nearest + 1, _rounded(error))


def _distance(left: Sequence[arb], right: Sequence[arb]) -> Interval:
    count = len(left) // 3
    differences = [a - b for a, b in zip(left, right, strict=True)]
    squares = [value * value for value in differences]  # a power of a ball around 0 has no bounds
    sums = [squares[i] + squares[count + i] + squares[2 * count + i] for i in range(count)]
    low = max(value.lower() for value in sums)
    high = max(value.upper() for value in sums)
    return Interval(_end(low.sqrt().lower()) if low > 0 else Fraction(0), _end(high.sqrt().upper()))


def _end(value: arb) -> Fraction:
    mantissa, power = value.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(power)


def _rounded(interval: Interval) -> Interval:
    """The interval with ends of few bits, rounded outward."""
    if interval.hi == 0:
        return interval
    scale = Fraction(2) ** (OUTPUT_BITS - interval.hi.numerator.bit_length() + interval.hi.denominator.bit_length())
    low, high = (interval.lo * scale).__floor__() / scale, -((-interval.hi * scale).__floor__() / scale)
    return Interval(max(low, Fraction(0)), high)
