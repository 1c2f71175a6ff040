"""What an iteration in floating point returns: points, not boxes, and no claim about any of them.

A small residual does not prove that a pose is near, and a list of poses found by iterations does not say that there is
no other. The claim of such a result is "uncertified"; it is no member of ``verdict.Claim`` and has no certificate.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Final, TypeAlias

from pkm_exact.geometry.problem import ForwardProblem

Point: TypeAlias = tuple[float, float, float]
Quaternion: TypeAlias = tuple[float, float, float, float]

UNCERTIFIED: Final = "uncertified"


class Ending(StrEnum):
    """Why an iteration ended.

    ``CONVERGED``: the constraints hold, up to the tolerance on the residual. ``SINGULAR``: the Jacobian
    cannot be inverted in floating point. ``STAGNATED``: no step makes the residual smaller; often a place where it is
    least without being zero. Only the first gives a pose.
    """

    CONVERGED = "converged"
    SINGULAR = "singular Jacobian"
    TOO_MANY_ITERATIONS = "too many iterations"
    STAGNATED = "stagnated"


@dataclass(frozen=True)
class NumericPose:
    """Where an iteration ended.

    Attributes
    ----------
    ending : Ending
    position : tuple of 3 float
        The mobile frame's origin C in the fixed frame, in the robot's unit of length.
    rotation : 3 x 3 tuple of float
        Rotation matrix R: a platform point B stands at C + R B.
    quaternion : tuple of 4 float
        Unit quaternion of R, scalar first; q0 is not negative.
    iterations : int
        Steps taken.
    residual : float
        Greatest error of a constraint at this place, in the robot's unit: of a leg the difference between its length
        and the one given; of others to first order, products of directions times the size of the platform.
    """

    ending: Ending
    position: Point
    rotation: tuple[Point, Point, Point]
    quaternion: Quaternion
    iterations: int
    residual: float

    @property
    def converged(self) -> bool:
        """Whether the iteration converged; that it converged to a pose is not proved."""
        return self.ending is Ending.CONVERGED


@dataclass(frozen=True)
class UncertifiedSolution:
    """Poses found by iterations: some may be missing, and some may be none.

    Attributes
    ----------
    problem : ForwardProblem
    method : str
        "newton" or "levenberg-marquardt".
    poses : tuple of NumericPose
        Distinct, all converged.
    notes : tuple of str
        What else the user should know.
    """

    problem: ForwardProblem
    method: str
    poses: tuple[NumericPose, ...]
    notes: tuple[str, ...] = ()

    @property
    def claim(self) -> str:
        """What is claimed: "uncertified"."""
        return UNCERTIFIED

    def __str__(self) -> str:
        count = f"{len(self.poses)} pose{'' if len(self.poses) == 1 else 's'}"
        return f"{count} found by {self.method}; uncertified"
