"""A locked robot in floating point: a pose (c, q), and by how much the robot's constraints fail there.

Frames are moved and scaled: with a and b the centres of base and platform, c is the vector from a to the place of b, in
units of ``unit``, and q a unit quaternion of R. Errors have the unit of length: of a leg the difference of lengths, of
a plane the distance from it. Robots with legs are in ``numeric.numeric_robot``, all others in
``numeric.numeric_mechanism``.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, fields
from math import isfinite, sqrt
from typing import Any, Final, Self, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pkm_exact.errors import InputError
from pkm_exact.motions.motion import Motion
from pkm_exact.numeric.quaternions import rotation_matrix
from pkm_exact.numeric.uncertified import Ending, NumericPose, Point, Quaternion

Real: TypeAlias = NDArray[np.float64]

FARTHEST: Final = 1e6
"""Distance of a start from the base, in times the size of the robot, beyond which it is a mistake."""
OUT_OF_REACH: Final = (
    "coordinates or lengths are out of reach of floating point (10^-100 to 10^100); leave them to the method exact, "
    "without a time limit"
)
_NAMES: Final = ("x", "y", "z", "q1", "q2", "q3")


@dataclass(frozen=True, eq=False)
class Place(ABC):
    """What the constraints say at one pose, or at each of k poses.

    Attributes
    ----------
    errors : (.., m) array
        By how much each constraint fails, in units of ``unit``.
    """

    errors: Real

    @property
    def worst(self) -> Real:
        """(..): the greatest error, where it matters relative to what rounding alone leaves of a constraint."""
        return np.asarray(np.abs(self.errors).max(axis=-1, initial=0.0))

    @abstractmethod
    def transposed_jacobian(self) -> Real:
        """(.., 6, m): derivatives of the errors along velocity v and angular velocity w, in columns."""

    def at(self, which: Any) -> Self:
        """The same of some of the poses."""
        return type(self)(*(getattr(self, entry.name)[which] for entry in fields(self)))

    def changed(self, which: NDArray[np.bool_], other: Self) -> Self:
        """The same, with some of the poses replaced by others."""
        pairs = ((getattr(self, entry.name), getattr(other, entry.name)) for entry in fields(self))
        return type(self)(*(np.where(which.reshape(-1, *[1] * (old.ndim - 1)), new, old) for old, new in pairs))


@dataclass(frozen=True, eq=False)
class NumericMachine(ABC):
    """A locked robot in floating point, made once for any number of starts.

    Attributes
    ----------
    base_centre, platform_centre : (3,) array
        a and b, in the robot's unit of length.
    unit : float
        A power of two, about the size of the robot.
    motion : Motion
    """

    base_centre: Real
    platform_centre: Real
    unit: float
    motion: Motion

    @property
    @abstractmethod
    def markers(self) -> Real:
        """(3, k): points of the platform whose displacements tell poses apart, from b and in units of ``unit``."""

    @abstractmethod
    def at(self, c: Real, quaternion: Sequence[Any]) -> Place:
        """The constraints at a pose (c, q), or at the poses of arrays (k, 3) and four of (k,)."""


@dataclass(frozen=True)
class StartPose:
    """Where an iteration starts: position in the robot's unit of length, and a quaternion of any norm but 0."""

    position: Point
    quaternion: Quaternion


def centred(machine: NumericMachine, start: StartPose) -> tuple[Real, Quaternion]:
    """The start as (c, q), q of norm 1.

    Raises
    ------
    InputError
        If the start is no pose, far off, or none of the robot's motions.
    """
    if not all(map(isfinite, (*start.position, *start.quaternion))):
        raise InputError("start: a number is not finite; give seven numbers")
    largest = max(map(abs, start.quaternion))
    if largest == 0:
        raise InputError("start: all four numbers of the quaternion are 0; give one that is not")
    _require_in_motion(machine.motion, start)
    far = max(abs(x - m) for x, m in zip(start.position, machine.base_centre, strict=True))
    if far > FARTHEST * (machine.unit + float(abs(machine.platform_centre).max())):
        raise InputError("start: the position is over a million times the robot's size away; give one nearby")
    q0, q1, q2, q3 = (value / largest for value in start.quaternion)
    norm = sqrt(q0 * q0 + q1 * q1 + q2 * q2 + q3 * q3)
    quaternion = q0 / norm, q1 / norm, q2 / norm, q3 / norm
    moved = np.array(start.position) + rotation_matrix(quaternion) @ machine.platform_centre - machine.base_centre
    return moved / machine.unit, quaternion


def _require_in_motion(motion: Motion, start: StartPose) -> None:
    numbers = (*start.position, *start.quaternion[1:])
    fixed = [axis for axis in range(6) if axis not in motion.twist]
    if any(numbers[axis] for axis in fixed):
        names = [_NAMES[axis] for axis in fixed]
        listed = f"{', '.join(names[:-1])} and {names[-1]}"
        where = "the plane of a planar robot" if motion.is_planar else f"the motions of the robot ({motion.title})"
        raise InputError(f"start: leaves {where}; give {listed} as 0")


def placed(machine: NumericMachine, c: Real, quaternion: Quaternion) -> tuple[Point, Real]:
    """Position, in the robot's unit of length, and rotation matrix of the pose (c, q)."""
    rotation = rotation_matrix(quaternion)
    x, y, z = (machine.base_centre + machine.unit * c - rotation @ machine.platform_centre + 0.0).tolist()
    return (x, y, z), rotation


def numeric_pose(
    machine: NumericMachine, c: Real, quaternion: Quaternion, ending: Ending, iterations: int
) -> NumericPose:
    """The place (c, q) as it is returned; the residual is computed from it."""
    position, rotation = placed(machine, c, quaternion)
    residual = float(np.abs(machine.at(c, quaternion).errors).max(initial=0.0))
    rows: list[Point] = [(x, y, z) for x, y, z in (rotation + 0.0).tolist()]  # no negative zeros
    sign = -1.0 if quaternion[0] < 0 else 1.0
    q0, q1, q2, q3 = (sign * float(value) + 0.0 for value in quaternion)
    return NumericPose(
        ending, position, (rows[0], rows[1], rows[2]), (q0, q1, q2, q3), iterations, residual * machine.unit
    )
