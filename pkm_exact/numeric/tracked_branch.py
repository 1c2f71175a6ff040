"""A branch of poses along a path: sizes of steps, where it is at a row, and how it ends. Data only."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.errors import PkmExactError
from pkm_exact.numeric.centred import Chart
from pkm_exact.poses.pose import Pose


@dataclass(frozen=True)
class TrackPolicy:
    """Sizes of steps, in times the distance of two rows.

    Attributes
    ----------
    smallest_step : int
        Steps are not made shorter than 2^-smallest_step.
    easy : float
        A step whose operator leaves less than this share of its box is followed by one of twice the length.
    """

    smallest_step: int = 40
    easy: float = 0.4


@dataclass(frozen=True)
class BranchPoint:
    """Where the branch is at a row: all that is needed to go on from there.

    Attributes
    ----------
    row : int
        From 0.
    chart : Chart
        w in w.e = 1, in the path's centred frames.
    exponent : int
    centre : tuple of int
        Of a real box with exactly one solution, in units of 2^-exponent; its half width is 2^-(exponent // 2).
    halvings : int
        The next step is 2^-halvings long at most.
    det_sign : int
        Sign of the determinant of the leg Jacobian, the same all along the branch.
    """

    row: int
    chart: Chart
    exponent: int
    centre: tuple[int, ...]
    halvings: int
    det_sign: int


@dataclass(frozen=True)
class TrackedSample:
    """The branch at a row of the path.

    Attributes
    ----------
    pose : Pose
        Its box; the quaternion's sign is continuous along the path. No Jacobian is enclosed.
    steps : int
        Certified steps from the row before.
    point : BranchPoint
    """

    pose: Pose
    steps: int
    point: BranchPoint

    @property
    def row(self) -> int:
        """Number of the row, from 0."""
        return self.point.row

    @property
    def det_sign(self) -> int:
        """Sign of the determinant of the leg Jacobian."""
        return self.point.det_sign


class TrackingStopped(PkmExactError):  # noqa: N818 - it ends a path
    """The branch cannot be followed farther.

    Attributes
    ----------
    row : int
        Row, from 0, after which it ends.
    reached, tried : Fraction
        It is proved up to ``reached`` of the way to the next row, and not up to ``tried``.
    """

    def __init__(self, row: int, reached: Fraction, tried: Fraction) -> None:
        super().__init__(
            f"the branch ends between rows {row + 1} and {row + 2}: it is certified up to {float(reached):.12g} of the "
            f"way, and from there to {float(tried):.12g} the determinant of the Jacobian cannot be bounded away from "
            "zero; a singularity is there, or too near to be excluded"
        )
        self.row, self.reached, self.tried = row, reached, tried
