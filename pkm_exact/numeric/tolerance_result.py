"""What is proved of a robot's poses over all robots within tolerance."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.numeric.centred import CentredFrames, Chart
from pkm_exact.numeric.deviations import Influence, PoseBounds
from pkm_exact.wording import counted


@dataclass(frozen=True)
class ProvedBox:
    """A box in the centred coordinates that holds exactly one solution of every robot within tolerance.

    Attributes
    ----------
    chart : Chart
    centre : tuple of pairs of int
        Real and imaginary parts, in units of the grid 2^-exponent.
    outer, inner : tuple of int
        Half the widths of a box in which there is no other, and of a smaller one that holds it; the same units.
    """

    chart: Chart
    centre: tuple[tuple[int, int], ...]
    outer: tuple[int, ...]
    inner: tuple[int, ...]


@dataclass(frozen=True)
class FollowedPose:
    """What is proved of a pose that has no box: it is followed over robots within tolerance, without a singularity.

    Attributes
    ----------
    fraction : Fraction
        Of all tolerances, for which this is proved; 1 if for all of them.
    cells : int
        How many sets of robots were looked at.
    bounds : PoseBounds
        Of the pose that the nominal one becomes when the data change to those of any robot within that fraction of
        the tolerances. Other poses of the robot may have such coordinates too.
    """

    fraction: Fraction
    cells: int
    bounds: PoseBounds

    @property
    def is_whole(self) -> bool:
        """Whether all robots within tolerance are covered."""
        return self.fraction == 1


@dataclass(frozen=True)
class ToleranceBox:
    """What is proved of one pose over all robots within tolerance.

    Attributes
    ----------
    pose : int
        Its number in the nominal solution, from 1.
    fraction : Fraction
        1 if the box is proved. Else a singularity within tolerance cannot be excluded, and a box is proved for this
        fraction of all tolerances; 0 if for none, the nominal pose being singular or too close to it.
    bounds : PoseBounds or None
        If it is proved: position (unit of length) and quaternion bound a box that holds exactly one pose of every
        robot within tolerance.
    dominant : Influence or None
        The datum whose tolerance moves the platform most, to first order.
    proof : ProvedBox or None
    followed : FollowedPose or None
        What is proved beyond ``fraction`` without a box; certificates do not have it.
    """

    pose: int
    fraction: Fraction
    bounds: PoseBounds | None
    dominant: Influence | None
    proof: ProvedBox | None
    followed: FollowedPose | None = None

    @property
    def is_proved(self) -> bool:
        """Whether there is a box for the whole tolerance."""
        return self.bounds is not None


@dataclass(frozen=True, repr=False)
class ToleranceResult:
    """Boxes of the poses of all robots within tolerance.

    Attributes
    ----------
    problem : ForwardProblem
        The nominal robot.
    tolerances : Tolerances
    frames : CentredFrames
        Of the centred coordinates.
    exponent : int
        Centres and radii lie on the grid 2^-exponent.
    boxes : tuple of ToleranceBox
        In the order of the poses, of those that were asked about.
    pairs : tuple of ProvedBox
        For pairs of conjugate solutions that are not real; only if the list is complete.
    proved_solutions : int
        Number of complex solutions, real ones included, that are proved for every robot within tolerance.
    is_complete : bool
        Whether it is proved that no robot within tolerance has another pose. "No" does not mean that there is one.
    unasked : tuple of int
        Numbers of the poses that were not asked about; if there are any, nor was completeness.

    Examples
    --------
    >>> from pkm_exact import Robot, Tolerances, tolerance_boxes
    >>> nominal = Robot.load("models/3-rpr-merlet-p.toml").solve()
    >>> found = tolerance_boxes(nominal.problem, Tolerances.uniform("1/1000"), nominal)
    >>> len(found.boxes), found.is_complete
    (2, True)
    """

    problem: ForwardProblem
    tolerances: Tolerances
    frames: CentredFrames
    exponent: int
    boxes: tuple[ToleranceBox, ...]
    pairs: tuple[ProvedBox, ...]
    proved_solutions: int
    is_complete: bool
    unasked: tuple[int, ...] = ()

    @property
    def is_proved(self) -> bool:
        """Whether every pose that was asked about has a box."""
        return all(box.is_proved for box in self.boxes)

    def __repr__(self) -> str:
        return f"<ToleranceResult: {self}>"

    def __str__(self) -> str:
        count, proved = len(self.boxes), sum(box.is_proved for box in self.boxes)
        if self.unasked:
            poses = "pose was" if len(self.unasked) == 1 else "poses were"
            claim = f"{len(self.unasked)} other {poses} not asked about, nor whether there are more"
        elif not self.is_complete:
            claim = (
                "that there are no others is not proved for every robot within tolerance, as "
                f"{self.proved_solutions} of {self.problem.solution_bound} complex solutions are proved"
            )
        elif count:
            claim = f"complete: every robot within tolerance has exactly {count} poses, one in each box"
        else:
            claim = "complete: no robot within tolerance has a pose"
        followed = sum(box.followed is not None and box.followed.is_whole for box in self.boxes)
        if followed:
            verb = "is" if followed == 1 else "are"
            claim = f"{followed} more without a box {verb} followed over all of them; {claim}"
        if not count:
            return f"no pose of the nominal robot is listed; {claim}"
        have = "has" if proved == 1 else "have"
        return f"{proved} of {counted(count, 'pose')} {have} a box for every robot within tolerance; {claim}"
