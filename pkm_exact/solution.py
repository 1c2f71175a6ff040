"""What a solve returns: all real poses in boxes, and what is proved about them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from pkm_exact.claim import Claim, CompletenessRoute, RealMotion
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.poses.pose import Pose

if TYPE_CHECKING:
    from pandas import DataFrame
    from scipy.spatial.transform import Rotation

    from pkm_exact.completeness.completeness_proof import CompletenessProof
    from pkm_exact.completeness.pose_slices import MorePoses
    from pkm_exact.poses.arrays import PoseArrays
    from pkm_exact.poses.isolated_solutions import IsolatedSolutions
    from pkm_exact.poses.pose_representation import PoseRepresentation
    from pkm_exact.poses.self_motion import SelfMotion, TranslationalMotion


@dataclass(frozen=True)
class Statistics:
    """How a solve went; nothing here enters a certificate.

    Attributes
    ----------
    primes : tuple of int
        Primes at which the system was eliminated.
    unlucky_primes : tuple of int
        Primes at which the elimination took another course and that were dropped.
    retries : int
        Random choices that failed and were made again.
    basis_size : int
        Elements of the Groebner basis.
    quotient_dimension : int or None
        Solutions of the formulation with multiplicity, modulo the first prime; None if infinite.
    seconds : dict of str to float
        Time of each stage.
    """

    primes: tuple[int, ...] = ()
    unlucky_primes: tuple[int, ...] = ()
    retries: int = 0
    basis_size: int = 0
    quotient_dimension: int | None = None
    seconds: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True, repr=False)
class Solution:
    """All poses of a robot with given leg lengths, as far as proved.

    It can be iterated, and its ``len`` is the number of real poses. A solution without any is true all the same: that
    there is no pose is an answer. Pose number k, as tables and certificates count, is ``solution.poses[k - 1]``.

    Attributes
    ----------
    problem : ForwardProblem
    formulation : str
        Code of the formulation whose Groebner basis was used.
    method : str
        "exact" or "krawczyk".
    claim : Claim
        What is proved about the list of poses.
    completeness : CompletenessProof or None
        The proof, if the claim is completeness or that there is no pose.
    complex_solutions : int
        Finite complex poses with multiplicity. A count modulo a prime unless the claim is completeness.
    distinct_solutions : int
        Distinct complex poses in the representation, each verified over Q.
    representation : PoseRepresentation or None
        The univariate representation of all of them, if the method is exact.
    box_exponent : int
        Boxes lie on the grid of spacing 2^-box_exponent.
    poses : tuple of Pose
        The real poses, by their boxes from left to right (``poses.boxes.in_order``).
    notes : tuple of str
        What else the user should know.
    self_motion : SelfMotion or TranslationalMotion or MorePoses or None
        The proof, if the claim is that the poses form a set of positive dimension.
    isolated : IsolatedSolutions or None
        Boxes around solutions, each with exactly one, if the method is Krawczyk's: the real ones in the order of the
        poses. Beside a self-motion, those of isolated poses.
    statistics : Statistics

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> solution = Robot.load("models/3-rpr-merlet-p.toml").solve()
    >>> print(solution)
    6 complex solutions, 2 real poses; complete
    >>> [pose.det_sign for pose in solution]
    [-1, 1]
    >>> solution.to_numpy().position.shape
    (2, 3)
    """

    problem: ForwardProblem
    formulation: str
    method: str
    claim: Claim
    completeness: CompletenessProof | None
    complex_solutions: int
    distinct_solutions: int
    representation: PoseRepresentation | None
    box_exponent: int
    poses: tuple[Pose, ...]
    notes: tuple[str, ...] = ()
    self_motion: SelfMotion | TranslationalMotion | MorePoses | None = None
    isolated: IsolatedSolutions | None = None
    statistics: Statistics = field(default_factory=Statistics, repr=False, compare=False)

    @property
    def is_complete(self) -> bool:
        """Whether it is proved that there is no other pose. "No" does not mean that there is one."""
        return self.claim in (Claim.COMPLETE, Claim.INCONSISTENT)

    @property
    def real_motion(self) -> RealMotion | None:
        """What is proved of real motions, if the claim is one of positive dimension; otherwise None."""
        if self.claim is Claim.POSITIVE_DIMENSIONAL_DETECTED:
            return RealMotion.OPEN
        return None if self.self_motion is None else self.self_motion.real

    @property
    def completeness_route(self) -> CompletenessRoute | None:
        """The argument by which the list was proved complete, if it was."""
        return None if self.completeness is None else self.completeness.route

    def __str__(self) -> str:
        return (
            f"{self.complex_solutions} complex solutions, {len(self.poses)} real poses; "
            f"{self.claim.value.replace('-', ' ')}"
        )

    def __repr__(self) -> str:
        return f"<Solution: {self}>"

    def __len__(self) -> int:
        return len(self.poses)

    def __iter__(self) -> Iterator[Pose]:
        return iter(self.poses)

    def __bool__(self) -> bool:
        return True

    def to_numpy(self) -> PoseArrays:
        """All real poses in doubles, ``position`` (n, 3), ``rotation`` (n, 3, 3), .., with half-widths.

        Raises
        ------
        PkmExactError
            If a coordinate is too large for floating point.
        """
        from pkm_exact.poses.arrays import arrays_of

        return arrays_of(self.poses)

    def to_scipy(self) -> Rotation:
        """The n rotations for scipy, nearest to the midpoints; planar robots turn about the third axis.

        Raises
        ------
        PkmExactError
            If scipy is not installed; the message says how to get it.
        """
        from pkm_exact.poses.arrays import rotations_of

        return rotations_of(self.to_numpy().quaternion, "to_scipy")

    def to_frame(self) -> DataFrame:
        """A pandas table with one row per real pose, numbered from 1.

        Columns x, y, z (unit of length), qw, qx, qy, qz, det_sign, condition, multiplicity, and half_width: the exact
        coordinates lie within it of those in the row.

        Raises
        ------
        PkmExactError
            If pandas is not installed; the message says how to get it.
        """
        from pkm_exact.poses.arrays import frame_of

        return frame_of(self.to_numpy())
