"""The equations of a robot's poses in a chart, exactly: what is asked of a pose, as quadrics in Study coordinates.

In the chart w.e = 1 the poses are the zeros of n functions of n Study coordinates x: the quadrics q_k(x) = x^T Q_k x of
the constraints, Study's condition where it is one, and w.e - 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from flint import acb_mat, arb, arb_mat, fmpz_mat

from pkm_exact.balls import Balls, unit_matrix_for
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import Quadric, motion_quadrics, pose_quadrics, support
from pkm_exact.numeric.chart_mixture import MixedEquations
from pkm_exact.numeric.charts import chart_values
from pkm_exact.numeric.double_forms import DoubleForms
from pkm_exact.numeric.double_krawczyk import DoubleEquations, DoubleSolution
from pkm_exact.poses.isolated_solutions import Box


class ChartSystem:
    """The equations of a robot's poses in a chart, in ball arithmetic.

    Parameters
    ----------
    problem : ForwardProblem
    chart : sequence of 4 int
        w in w.e = 1.
    """

    def __init__(self, problem: ForwardProblem, chart: Sequence[int]) -> None:
        self.problem = problem
        self.chart = tuple(chart)
        self.support = support(problem)
        self.quadrics = pose_quadrics(problem)
        """Over Z; n - 1 of them."""
        self.double_solutions: dict[Box, DoubleSolution] = {}
        """Where the solutions in real boxes are, as far as doubles have told."""

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return len(self.support)

    @cached_property
    def _gradients(self) -> fmpz_mat:
        """((n - 1) n) x n: all 2 Q_k, one below the other."""
        return fmpz_mat([row for quadric in self.quadrics for row in self._twice(quadric)])

    @cached_property
    def _balls(self) -> tuple[arb_mat, acb_mat]:
        """The same, exactly, to multiply real and complex points with.

        Each equation is divided by the power of 2 next to its largest coefficient: elimination takes the largest pivot,
        and among equations of very different sizes that is a bad one.
        """
        rows = iter(self._gradients.tolist())
        scaled: list[list[arb]] = []
        for quadric in self.quadrics:
            power = -max(abs(value).bit_length() for value in quadric.values())
            scaled += [[arb((value, power)) for value in next(rows)] for _ in range(self.size)]
        balls = arb_mat(scaled)
        return balls, acb_mat(balls)

    def _twice(self, quadric: Quadric) -> list[list[int]]:
        place = {index: position for position, index in enumerate(self.support)}
        rows = [[0] * self.size for _ in range(self.size)]
        for (k, m), value in quadric.items():
            rows[place[k]][place[m]] += value
            rows[place[m]][place[k]] += value
        return rows

    @cached_property
    def _last(self) -> list[int]:
        """The derivative of w.e."""
        return [self.chart[index] if index < 4 else 0 for index in self.support]

    @cached_property
    def _placed(self) -> list[Quadric]:
        """The quadrics by places in the support."""
        if self.support == tuple(range(self.size)):
            return self.quadrics
        place = {index: position for position, index in enumerate(self.support)}
        return [{(place[k], place[m]): value for (k, m), value in quadric.items()} for quadric in self.quadrics]

    @cached_property
    def in_doubles(self) -> DoubleEquations | None:
        """The same equations for points in doubles; None if the numbers are too large for that."""
        last = {(place, self.size): weight for place, weight in enumerate(self._last) if weight}
        last[self.size, self.size] = -1
        norm = motion_quadrics(self.problem.metric)[-1]
        try:
            weights = np.array([float(norm.get((k, k), 0)) for k in self.support])
            forms = DoubleForms.of([*self._placed, last])
            return DoubleEquations(self.support, forms, weights)
        except OverflowError:
            return None

    @cached_property
    def mixed(self) -> MixedEquations | None:
        """And with |C|^2 in one of them only; None if numbers are too large, or two equations are alike."""
        original = self.in_doubles
        try:
            kinds = [index // 4 for index in self.support]
            return None if original is None else MixedEquations.of(original, self._placed, self._last, kinds)
        except (OverflowError, ValueError):
            return None

    def jacobian(self, point: Balls) -> Balls:
        """F' at a point or in a box, a column."""
        kind = type(point)
        gradients = self._balls[kind is acb_mat] * point
        return kind(self.size, self.size, gradients.entries() + self._last)

    def values(self, jacobian: Balls, point: Balls) -> Balls:
        """F at a point, from F' there."""
        return chart_values(jacobian, point)

    def around(self, point: Balls) -> ChartEquations | None:
        """The equations near an exact point; None if no matrix Y is found."""
        jacobian = self.jacobian(point)
        try:
            inverse = jacobian.solve(unit_matrix_for(point), algorithm="approx")
        except ZeroDivisionError:
            return None
        return ChartEquations(self, point, inverse, inverse * self.values(jacobian, point))


@dataclass(frozen=True, eq=False)
class ChartEquations:
    """The equations near a point (``krawczyk_operator.Equations``).

    Attributes
    ----------
    system : ChartSystem
    point : n x 1 matrix
        m, exact.
    inverse : n x n matrix
        Y, exact.
    residual : n x 1 matrix
        Y F(m).
    """

    system: ChartSystem
    point: Balls
    inverse: Balls
    residual: Balls

    @property
    def is_real(self) -> bool:
        """Whether the point is real, and so are those of its boxes."""
        return isinstance(self.point, arb_mat)

    def jacobian(self, box: Balls) -> Balls:
        """Y F'(X), with X given moved to 0."""
        return self.inverse * self.system.jacobian(self.point + box)
