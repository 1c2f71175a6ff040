"""Exact data of a forward kinematics problem: legs between a base and a platform, in a Gram metric.

A parallel robot with locked actuators is a list of constraints on the pose (C, R) of its platform. Coordinates
are rational with respect to orthogonal axes whose squared lengths are the Gram diagonal ``metric``: the ordinary
coordinate is sqrt(metric[i]) times the rational one. With ``metric = (1, 3, 1)`` equilateral triangles are exact.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import Final, TypeAlias

Vector: TypeAlias = tuple[Fraction, Fraction, Fraction]

MOTION_DEGREES: Final = MappingProxyType({False: 40, True: 6})
"""Degree of the variety of rigid motions, or of planar ones (key: planar); every leg is a hyperplane on it."""


@dataclass(frozen=True)
class Leg:
    """A leg of known length between base joint ``base`` and platform joint ``platform``.

    Attributes
    ----------
    base : tuple of 3 Fraction
        Joint centre A in the fixed frame.
    platform : tuple of 3 Fraction
        Joint centre B in the mobile frame.
    length_squared : Fraction
        Square of the distance between A and C + R B, in squared units of length.
    """

    base: Vector
    platform: Vector
    length_squared: Fraction


@dataclass(frozen=True)
class ForwardProblem:
    """A robot with locked actuators: find every pose (C, R) with |C + R B_i - A_i|^2 = l_i^2.

    Attributes
    ----------
    legs : tuple of Leg
        Six legs; three if the robot is planar.
    metric : tuple of 3 int
        Gram diagonal of both frames, positive integers.
    planar : bool
        Whether the platform moves in the plane of the first two axes only: C3 = 0 and R turns about the third axis.
        All third coordinates of joints are then 0.
    """

    legs: tuple[Leg, ...]
    metric: tuple[int, int, int] = (1, 1, 1)
    planar: bool = False

    @property
    def motion_degree(self) -> int:
        """Degree of the variety of the robot's motions: most solutions that it can have, if they are finitely many."""
        return MOTION_DEGREES[self.planar]
