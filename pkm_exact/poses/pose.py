"""Certified poses: rational boxes, each around exactly one solution of the problem."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from pkm_exact.roots.interval import Interval

if TYPE_CHECKING:
    from pkm_exact.poses.jacobian import LegJacobian

__all__ = ["Interval", "Pose"]


@dataclass(frozen=True)
class Pose:
    """A real pose: a box in ordinary coordinates that holds exactly one of the solutions listed with it.

    Attributes
    ----------
    parameter : Interval or None
        Isolating interval of the eliminant's real root that parametrises the pose; alone in it. None if the pose was
        found without an eliminant.
    position : tuple of 3 Interval
        The mobile frame's origin C in the fixed frame, in the robot's unit of length.
    rotation : 3 x 3 tuple of Interval
        Rotation matrix R: a platform point B stands at C + R B.
    quaternion : tuple of 4 Interval
        Unit quaternion (q0, q1, q2, q3) of R, scalar first; the sign is that of the chart (w . q > 0).
    multiplicity : int or None
        Multiplicity of the solution: 1 for a simple one; above 1 the legs' Jacobian is singular there. None where it is
        not proved.
    jacobian : LegJacobian or None
        What is certified of the leg Jacobian there.
    """

    parameter: Interval | None
    position: tuple[Interval, Interval, Interval]
    rotation: tuple[tuple[Interval, ...], ...]
    quaternion: tuple[Interval, Interval, Interval, Interval]
    multiplicity: int | None = 1
    jacobian: LegJacobian | None = None
