"""Certified poses: rational boxes, each around exactly one solution of the problem."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from pkm_exact.roots.interval import Interval

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation

    from pkm_exact.poses.arrays import PoseArrays
    from pkm_exact.poses.leg_jacobian import LegJacobian

__all__ = ["Interval", "Pose"]


@dataclass(frozen=True, repr=False)
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

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> pose = Robot.load("models/3-rpr-merlet-p.toml").solve().poses[0]
    >>> pose.position[0]
    [3.369707131 +/- 6.4e-10]
    >>> print(*pose.position)
    3.369707131 6.216516215 0.000000000
    >>> pose.det_sign, pose.half_width < 10**-9
    (-1, True)
    """

    parameter: Interval | None
    position: tuple[Interval, Interval, Interval]
    rotation: tuple[tuple[Interval, ...], ...]
    quaternion: tuple[Interval, Interval, Interval, Interval]
    multiplicity: int | None = 1
    jacobian: LegJacobian | None = None

    @property
    def det_sign(self) -> int | None:
        """Sign of the determinant of the leg Jacobian, 0 at a singular pose; None where it is not certified."""
        return None if self.jacobian is None else self.jacobian.det_sign

    @property
    def condition(self) -> Interval | None:
        """Condition number of the leg Jacobian; None at a singular pose or where it is not certified."""
        return None if self.jacobian is None else self.jacobian.condition

    @property
    def box(self) -> tuple[Interval, ...]:
        """Position and rotation matrix, by rows: in one of these the boxes of two poses differ."""
        return (*self.position, *self.rotation[0], *self.rotation[1], *self.rotation[2])

    @property
    def half_width(self) -> Fraction:
        """Half the greatest width of the box, over all coordinates of position, rotation and quaternion."""
        return max(interval.width for interval in (*self.box, *self.quaternion)) / 2

    def to_numpy(self) -> PoseArrays:
        """The pose in doubles: midpoints, and half-widths that cover the exact values, rounding included.

        Returns
        -------
        PoseArrays
            ``position`` (3,), ``rotation`` (3, 3), ``quaternion`` (4,), each with its ``.._half_width``, and more.

        Raises
        ------
        PkmExactError
            If a coordinate is too large for floating point.

        Examples
        --------
        >>> from pkm_exact import Robot
        >>> pose = Robot.load("models/3-rpr-merlet-p.toml").solve().poses[0]
        >>> pose.to_numpy().rotation.shape
        (3, 3)
        """
        from pkm_exact.poses.arrays import arrays_of_pose

        return arrays_of_pose(self)

    def to_scipy(self) -> Rotation:
        """The rotation for scipy, nearest to the midpoint of the box; a planar robot turns about the third axis.

        Raises
        ------
        PkmExactError
            If scipy is not installed; the message says how to get it.

        Examples
        --------
        >>> from pkm_exact import Robot
        >>> pose = Robot.load("models/3-rpr-merlet-p.toml").solve().poses[0]
        >>> pose.to_scipy().as_quat().shape  # doctest: +SKIP
        (4,)
        """
        from pkm_exact.poses.arrays import rotations_of

        return rotations_of(self.to_numpy().quaternion, "to_scipy")

    def __str__(self) -> str:
        position, quaternion = (", ".join(map(str, part)) for part in (self.position, self.quaternion))
        return f"position ({position}), quaternion ({quaternion})"

    def __repr__(self) -> str:
        return f"<Pose: {self}>"
