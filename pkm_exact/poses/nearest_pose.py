"""Which pose of a list is the nearest to one that is meant, by certified comparison.

The distance of two poses is sqrt(|C - C'|^2 + s^2 |R - R'|^2 / 2), s the robot's size and |.| of a matrix the root of
the sum of the squares of its entries: where the angle between them is small, s times that angle takes the second place.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import acos, degrees, dist, sqrt
from typing import TYPE_CHECKING

from pkm_exact.geometry.nominal_pose import NominalPose

if TYPE_CHECKING:
    from pkm_exact.poses.pose import Pose
    from pkm_exact.roots.interval import Interval


@dataclass(frozen=True)
class Nearest:
    """The poses that may be the nearest.

    Attributes
    ----------
    numbers : tuple of int
        From 1, in the order of the list: one, or several if their boxes do not tell which is nearer.
    position_off : float
        Distance of the first one's position from the one that is meant, about.
    degrees_off : float
        The angle between both rotations, about.
    distance : float
        That of the first one and the one that is meant, about.
    """

    numbers: tuple[int, ...]
    position_off: float
    degrees_off: float
    distance: float


def nearest_pose(poses: Sequence[Pose], nominal: NominalPose) -> Nearest | None:
    """The pose nearest to the nominal one; None if there is no pose.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> from pkm_exact.geometry.nominal_pose import nominal_from_numbers
    >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
    >>> meant = nominal_from_numbers([Fraction(n) for n in (5, 5, 1)], "meant", robot.motion)
    >>> nearest_pose(robot.solve().poses, meant).numbers
    (2,)
    """
    if not poses:
        return None
    size = next((pose.jacobian.length for pose in poses if pose.jacobian is not None), Fraction(1))
    bounds = [_square_of_distance(pose, nominal, size) for pose in poses]
    least = min(high for _, high in bounds)
    numbers = tuple(number for number, (low, _) in enumerate(bounds, 1) if low <= least)
    first = min(numbers, key=lambda number: bounds[number - 1][1])
    away = sqrt(float(bounds[first - 1][1]))
    return Nearest((first, *(n for n in numbers if n != first)), *_off(poses[first - 1], nominal), away)


def _square_of_distance(pose: Pose, nominal: NominalPose, size: Fraction) -> tuple[Fraction, Fraction]:
    low = high = Fraction(0)
    entries = [(x, y, Fraction(1)) for x, y in zip(pose.position, nominal.position, strict=True)]
    for row, other in zip(pose.rotation, nominal.rotation, strict=True):
        entries += [(x, y, size * size / 2) for x, y in zip(row, other, strict=True)]
    for value, meant, weight in entries:
        least, most = _square(value, meant)
        low, high = low + weight * least, high + weight * most
    return low, high


def _square(value: Interval, meant: Fraction) -> tuple[Fraction, Fraction]:
    ends = sorted((abs(value.lo - meant), abs(value.hi - meant)))
    least = Fraction(0) if value.lo <= meant <= value.hi else ends[0]
    return least * least, ends[1] * ends[1]


def _off(pose: Pose, nominal: NominalPose) -> tuple[float, float]:
    away = dist([float(x) for x in pose.position], [float(x) for x in nominal.position])
    pairs = zip((x for row in pose.rotation for x in row), (x for row in nominal.rotation for x in row), strict=True)
    trace = sum(float(x) * float(y) for x, y in pairs)
    return away, degrees(acos(max(-1.0, min(1.0, (trace - 1) / 2))))
