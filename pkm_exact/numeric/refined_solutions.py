"""All solutions of a robot to thousands of bits, by Newton's method from where doubles lead; nothing is proved.

Solutions are Study coordinates in a chart w.e = 1. Real ones are kept real, and of two conjugate ones one is kept. A
step doubles the bits but for some; so many are lost that the last steps at few bits have shown.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final, TypeAlias

import numpy as np
from flint import acb, acb_mat, arb, arb_mat

from pkm_exact.balls import Balls, unit_matrix_for
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import Quadric, pose_quadrics
from pkm_exact.numeric.study_system import Complex
from pkm_exact.poses.study_equations import Chart, dependent_coordinate, free_coordinates
from pkm_exact.precision import working_precision

Point: TypeAlias = list[Any]
"""The free coordinates, ``arb`` or ``acb``, exact."""
FIRST_BITS: Final = 192
"""Newton's method begins with so many."""
SETTLED: Final = 48
"""Relative bits of a step from which on the next ones double them."""
STEPS: Final = 8
"""In so many steps it comes so far, or is given up."""
GUARD_BITS: Final = 48
"""For rounding; and so many are taken for lost in a step beyond those that were."""
SLACK: Final = 6
PARTS, LEAST_DOUBLED = 3, 600
"""Newton's method doubles the bits up to this part of those wanted, or so many; inverses serve from there on."""
NEARLY: Final = 0.8
"""Of the bits up to which steps double them: more are not doubled for the rest."""
NOTHING: Final = -(1 << 40)
"""The exponent of 0."""


@dataclass(frozen=True, eq=False)
class RefinedSolutions:
    """Solutions with so many relative bits.

    Attributes
    ----------
    equations : _Equations
    points : list of points
        The real ones, then one of each conjugate pair of the others.
    count : int
        Number of real ones.
    accuracy : int
        Bits that all have, probably.
    loss : int
        A step has so many bits less than twice those before.
    inverses : list of matrices
        Of the Jacobians where the points had ``gain`` bits; none as long as each step takes the matrices anew.
    gain : int
    """

    equations: _Equations
    points: list[Point]
    count: int
    accuracy: int = 0
    loss: int = 0
    inverses: Sequence[Balls] = ()
    gain: int = 0

    def refined(self, bits: int) -> RefinedSolutions:
        """The same with more bits: each step doubles them up to about a third, then adds as many as that is."""
        current, doubling = self, max(bits // PARTS, LEAST_DOUBLED) + self.loss
        while current.accuracy < min(bits, NEARLY * doubling):
            target = min(2 * current.accuracy - self.loss, bits, doubling)
            current = current._doubled(target, target - current.accuracy + self.loss + GUARD_BITS)
        if bits > current.accuracy and not current.inverses:
            current = current._with_inverses()
        steps = -(-(bits - current.accuracy) // max(current.gain - self.loss, 1))
        for left in range(steps, 0, -1):
            current = current._lengthened(current.accuracy + (bits - current.accuracy) // left)
        return current

    def settled(self) -> RefinedSolutions | None:
        """The same after steps with few bits, which show how many are lost; None if they do not double them."""
        current, last = self, 0
        for _ in range(STEPS):
            moved = current._doubled(0, FIRST_BITS)
            size = self.equations.difference(moved.points, current.points)
            loss = max(size - 2 * last, 0) + SLACK
            accuracy = min(-2 * size, FIRST_BITS) - loss
            current = replace(moved, accuracy=accuracy, loss=loss)
            if last < 0 and -size > SETTLED:
                return current if accuracy > SETTLED + loss else None
            last = size
        return None

    def _doubled(self, target: int, narrow: int) -> RefinedSolutions:
        """After a step to so many bits, with the bits of the corrections."""
        wide = max(target + GUARD_BITS, narrow)
        values = self.equations.values(self.points, self.count, wide)
        with working_precision(narrow):
            matrices = self.equations.jacobians(self.points, self.count)
            changes = [m.solve(value, algorithm="approx") for m, value in zip(matrices, values, strict=True)]
        return replace(self, points=_moved(self.points, changes, wide), accuracy=target)

    def _lengthened(self, target: int) -> RefinedSolutions:
        """After a step to so many bits with the inverses."""
        wide = target + GUARD_BITS
        values = self.equations.values(self.points, self.count, wide)
        with working_precision(self.gain + GUARD_BITS):
            changes = [inverse * value for inverse, value in zip(self.inverses, values, strict=True)]
        return replace(self, points=_moved(self.points, changes, wide), accuracy=target)

    def _with_inverses(self) -> RefinedSolutions:
        with working_precision(self.accuracy + GUARD_BITS):
            matrices = self.equations.jacobians(self.points, self.count)
            inverses = [m.solve(unit_matrix_for(m), algorithm="approx").mid() for m in matrices]
        return replace(self, inverses=inverses, gain=self.accuracy)


def _moved(points: Sequence[Point], changes: Sequence[Balls], bits: int) -> list[Point]:
    with working_precision(bits):
        pairs = zip(points, changes, strict=True)
        return [[(a - b).mid() for a, b in zip(point, change.entries(), strict=True)] for point, change in pairs]


def refined_solutions(problem: ForwardProblem, chart: Chart, points: Complex) -> RefinedSolutions | None:
    """The solutions near points given by all eight coordinates in the chart; None if Newton's method does not settle.

    Parameters
    ----------
    problem : ForwardProblem
        With as many quadrics as free coordinates.
    chart : tuple of 4 int
    points : (p, 8) complex array
        All, conjugates included.
    """
    paired = _conjugates(points)
    if paired is None:
        return None
    equations = _Equations(problem, chart)
    real, others = (points[places][:, list(equations.free)].tolist() for places in paired)
    begun: list[Point] = [[arb(value.real) for value in point] for point in real]
    begun += [[acb(value.real, value.imag) for value in point] for point in others]
    try:
        return RefinedSolutions(equations, begun, len(real)).settled()
    except ZeroDivisionError:
        return None


def _conjugates(points: Complex) -> tuple[list[int], list[int]] | None:
    """Which points are real, and one of each conjugate pair of the others; None if they are not paired."""
    halves = [np.abs(points[:, part]).max(axis=1) for part in (slice(0, 4), slice(4, 8))]
    scaled = points / np.maximum(np.repeat(np.stack(halves, axis=1), 4, axis=1), 1e-300)
    distances = np.abs(scaled.conj()[:, None] - scaled[None]).max(axis=2)
    nearest = np.argmin(distances, axis=1)
    if not np.array_equal(nearest[nearest], np.arange(len(points))):
        return None
    return (
        [k for k, other in enumerate(nearest.tolist()) if k == other],
        [k for k, other in enumerate(nearest.tolist()) if k < other],
    )


class _Equations:
    """The legs and Study's condition in a chart, as forms in products of coordinates, and their gradients."""

    def __init__(self, problem: ForwardProblem, chart: Chart) -> None:
        self.chart = chart
        self.dependent, self.free = dependent_coordinate(chart), free_coordinates(chart, problem)
        quadrics = pose_quadrics(problem)
        self.products = sorted({pair for form in quadrics for pair in form})
        # Elimination takes the largest pivots: equations are brought to the same size.
        rows = [(form, -max(abs(value).bit_length() for value in form.values())) for form in quadrics]
        forms = [[arb((form.get(pair, 0), power)) for pair in self.products] for form, power in rows]
        gradients = [[arb((value, power)) for value in row] for form, power in rows for row in self._gradient(form)]
        self.forms, self.gradients = arb_mat(forms).transpose(), arb_mat(gradients).transpose()

    def _gradient(self, form: Quadric) -> list[list[int]]:
        """Partial derivatives by the free coordinates, as linear forms in all."""
        symmetric = [[0] * 8 for _ in range(8)]
        for (k, m), value in form.items():
            symmetric[k][m] += value
            symmetric[m][k] += value
        rows = []
        for k in self.free:
            slope = self.chart[k] if k < 4 else 0
            rows.append([a - slope * b for a, b in zip(symmetric[k], symmetric[self.dependent], strict=True)])
        return rows

    def coordinates(self, point: Point) -> Point:
        """All eight."""
        values: Point = [arb(0)] * 8
        last = arb(1)
        for k, value in zip(self.free, point, strict=True):
            values[k] = value
            if k < 4 and self.chart[k]:
                last = last - self.chart[k] * value
        values[self.dependent] = last
        return values

    def values(self, points: Sequence[Point], count: int, bits: int) -> list[Balls]:
        """The left-hand sides at each point, of which the first ``count`` are real."""
        with working_precision(bits):
            columns = []
            for point in points:
                x = self.coordinates(point)
                columns.append([x[k] * x[m] for k, m in self.products])
            return _applied(self.forms, columns, count, (len(self.free), 1))

    def jacobians(self, points: Sequence[Point], count: int) -> list[Balls]:
        """The matrices of derivatives at each point."""
        columns = [[+value for value in self.coordinates(point)] for point in points]
        return _applied(self.gradients, columns, count, (len(self.free), len(self.free)))

    def difference(self, points: Sequence[Point], others: Sequence[Point]) -> int:
        """The exponent of the largest difference of a coordinate, beside the largest of the same half, e or f."""
        found = NOTHING
        for a, b in zip(points, others, strict=True):
            for half in (0, 1):
                places = [place for place, k in enumerate(self.free) if k // 4 == half]
                size = max(1 - half, *(_exponent(a[place]) for place in places))
                found = max(found, *(_exponent(a[place] - b[place]) - size for place in places))
        return found


def _applied(matrix: arb_mat, columns: Sequence[Point], count: int, shape: tuple[int, int]) -> list[Balls]:
    """A real matrix times columns, of which the first ``count`` are real: complex ones in two halves; reshaped."""
    real, others = columns[:count], columns[count:]
    halves = [[value.real for value in c] for c in others], [[value.imag for value in c] for c in others]
    entries = (arb_mat([*real, *halves[0], *halves[1]]) * matrix).entries()
    size = matrix.ncols()
    rows = [entries[start : start + size] for start in range(0, len(entries), size)]
    found: list[Balls] = [arb_mat(*shape, row) for row in rows[:count]]
    for a, b in zip(rows[count : count + len(others)], rows[count + len(others) :], strict=True):
        found.append(acb_mat(*shape, list(map(acb, a, b))))
    return found


def _exponent(value: arb | acb) -> int:
    """About the binary logarithm of the size of the middle."""
    if isinstance(value, acb):
        return max(_exponent(value.real), _exponent(value.imag))
    mantissa, exponent = value.mid().man_exp()
    return int(mantissa.bit_length() + exponent) if mantissa else NOTHING
