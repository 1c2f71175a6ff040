"""Certified poses: rational boxes, each around exactly one solution of the problem."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True)
class Interval:
    """A closed interval with rational ends; ``lo == hi`` means that the value is known exactly."""

    lo: Fraction
    hi: Fraction

    def __post_init__(self) -> None:
        if self.lo > self.hi:
            raise ValueError(f"interval ends out of order: {self.lo} > {self.hi}")

    @property
    def width(self) -> Fraction:
        """Difference of the ends."""
        return self.hi - self.lo

    @property
    def midpoint(self) -> Fraction:
        """Mean of the ends."""
        return (self.lo + self.hi) / 2

    def contains(self, value: Fraction) -> bool:
        """Whether ``value`` lies in the closed interval."""
        return self.lo <= value <= self.hi

    def overlaps(self, other: Interval) -> bool:
        """Whether the two closed intervals have a point in common."""
        return self.lo <= other.hi and other.lo <= self.hi


@dataclass(frozen=True)
class Pose:
    """A real pose: a box in ordinary coordinates that holds exactly one of the solutions listed with it.

    Attributes
    ----------
    parameter : Interval
        Isolating interval of the eliminant's real root that parametrises the pose; alone in it.
    position : tuple of 3 Interval
        The mobile frame's origin C in the fixed frame, in the robot's unit of length.
    rotation : 3 x 3 tuple of Interval
        Rotation matrix R: a platform point B stands at C + R B.
    quaternion : tuple of 4 Interval
        Unit quaternion (q0, q1, q2, q3) of R, scalar first; the sign is that of the chart (w . q > 0).
    multiplicity : int
        Multiplicity of the solution; 1 for a simple one.
    """

    parameter: Interval
    position: tuple[Interval, Interval, Interval]
    rotation: tuple[tuple[Interval, ...], ...]
    quaternion: tuple[Interval, Interval, Interval, Interval]
    multiplicity: int = 1
