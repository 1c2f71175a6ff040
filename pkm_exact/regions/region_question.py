"""Questions about regions: which poses, what is asked of them, and which answer is wanted."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Final

from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.limits import Pair
from pkm_exact.regions.chart import Chart
from pkm_exact.regions.formula import All, Atom, Formula
from pkm_exact.regions.index_quotients import INDEX_NAMES
from pkm_exact.regions.path_tubes import Tube, inside_tube
from pkm_exact.regions.region_conditions import Asked, Conditions, within_reach
from pkm_exact.regions.region_shapes import Quadratic, inside_atom

ANSWERS: Final = ("all", "map", "largest", "locus", "extremes", "threshold", "designs")
EXTREMES: Final = ("joint_values", *INDEX_NAMES)
"""Of what the least and the greatest value may be asked."""
DEFAULT_STEPS: Final = 30
DEFAULT_BOXES: Final = 200_000


@dataclass(frozen=True)
class WantedAnswer:
    """Which answer, and how much work may be done for it.

    Attributes
    ----------
    kind : str
        One of ``ANSWERS``.
    steps : int
        How often the region is halved at most.
    boxes : int
        How many undecided parts there may be at a time, in all.
    shape : str
        Of the answer "largest": "cube" or "ball".
    about : tuple of Fraction
        The middle of it, in ordinary coordinates.
    precision : Fraction
        Relative.
    of : str
        Of the answer "extremes": one of ``EXTREMES``.
    parameter : str
        Of the answer "threshold": which number of the model varies.
    between : tuple of 2 Fraction
        From one value to another.
    parameters : tuple of pairs of str and Pair
        Of the answer "designs": which numbers of the robot vary (``design_parameters``), and between what.
    """

    kind: str
    steps: int = DEFAULT_STEPS
    boxes: int = DEFAULT_BOXES
    shape: str = "cube"
    about: tuple[Fraction, ...] = ()
    precision: Fraction = Fraction(1, 100)
    of: str = ""
    parameter: str = ""
    between: tuple[Fraction, ...] = ()
    parameters: tuple[tuple[str, Pair], ...] = ()


@dataclass(frozen=True)
class RegionQuestion:
    """A question.

    Attributes
    ----------
    chart : Chart
    shape : tuple of Quadratic
        All of them are not negative in the region; none if it is the whole box of the chart.
    conditions : Conditions
    answer : WantedAnswer
    enlarged : bool
        Whether the region is a little larger than asked, as its numbers are not rational in the model.
    any_axis : Fraction or None
        All turns about any axis, of which the square of the tangent of half the angle is at most so much.
    tube : Tube or None
        That the region is, besides.
    joints : tuple of pairs of Fraction
        For each leg between which values of its joint the region lies, besides; none if that does not matter.
    """

    chart: Chart
    shape: tuple[Quadratic, ...]
    conditions: Conditions
    answer: WantedAnswer
    enlarged: bool = field(default=False)
    any_axis: Fraction | None = None
    tube: Tube | None = None
    joints: tuple[Pair, ...] = ()

    @property
    def is_connected(self) -> bool:
        """Whether any two poses of the region are joined by a path in it; of joint values that is not known."""
        return not self.joints

    def region(self, asked: Asked, metric: Metric) -> All:
        """That a pose of the chart is in the region."""
        parts: list[Formula] = [inside_atom(part, asked.pose) for part in self.shape]
        if self.tube is not None:
            parts.append(inside_tube(self.tube, asked.pose, metric))
        for leg, pair in zip(asked.placed, self.joints, strict=False):
            if leg.root is not None:
                parts.append(Atom(f"{leg.leg.name} reaches", leg.root))
            parts += within_reach(replace(leg, leg=replace(leg.leg, reach=pair)))
        return All(tuple(parts))
