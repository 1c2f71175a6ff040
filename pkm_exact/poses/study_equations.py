"""The legs and Study's condition as seven equations in the seven free coordinates of a chart, for Newton lifting."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from random import Random

from flint import fmpz_mod_poly

from pkm_exact.algebra.residue_ring import ResidueRing, combination
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import Quadric, evaluate, pose_quadrics, support

Chart = tuple[int, int, int, int]
"""Weights w: coordinates are scaled so that w.e = 1. The last non-zero weight is 1; its coordinate is not free."""


def dependent_coordinate(chart: Chart) -> int:
    """Index of the quaternion coordinate that the chart determines from the others.

    Examples
    --------
    >>> dependent_coordinate((3, 1, 0, 0))
    1
    """
    return max(k for k in range(4) if chart[k])


def free_coordinates(chart: Chart, problem: ForwardProblem) -> tuple[int, ...]:
    """Indices of the other coordinates (e, f) that are not 0 for every pose: seven, or three for a planar robot."""
    return tuple(k for k in support(problem) if k != dependent_coordinate(chart))


@dataclass(frozen=True)
class StudyEquations:
    """Random combinations of the leg quadrics and Study's condition, as many as there are free coordinates.

    Attributes
    ----------
    problem : ForwardProblem
    chart : tuple of 4 int
        Its dependent coordinate must not be 0 for every pose.
    seed : int
        Seed of the combinations, which make all leading minors of the Jacobian units.
    """

    problem: ForwardProblem
    chart: Chart
    seed: int

    @property
    def free(self) -> tuple[int, ...]:
        """Indices of the free coordinates."""
        return free_coordinates(self.chart, self.problem)

    @cached_property
    def quadrics(self) -> tuple[Quadric, ...]:
        """The combined quadratic forms."""
        forms = pose_quadrics(self.problem)
        random = Random(self.seed)
        combined = []
        for _ in self.free:
            weights = [random.randrange(1, 1 << 16) for _ in forms]
            total: Quadric = {}
            for weight, form in zip(weights, forms, strict=True):
                for key, value in form.items():
                    total[key] = total.get(key, 0) + weight * value
            combined.append(total)
        return tuple(combined)

    def values(self, ring: ResidueRing, point: Sequence[fmpz_mod_poly]) -> list[fmpz_mod_poly]:
        """Left-hand sides at the free coordinates."""
        x = self._coordinates(ring, point)
        products = [[left * right if m >= k else left for m, right in enumerate(x)] for k, left in enumerate(x)]
        return [ring.reduce(evaluate(quadric, products)) for quadric in self.quadrics]

    def jacobian(self, ring: ResidueRing, point: Sequence[fmpz_mod_poly]) -> list[list[fmpz_mod_poly]]:
        """Partial derivatives by the free coordinates; linear in the coordinates."""
        x = self._coordinates(ring, point)
        dependent = dependent_coordinate(self.chart)
        rows = []
        for quadric in self.quadrics:
            gradient = [_derivative(quadric, k, x) for k in range(8)]
            rows.append(
                [gradient[k] - gradient[dependent] * self.chart[k] if k < 4 else gradient[k] for k in self.free]
            )
        return rows

    def _coordinates(self, ring: ResidueRing, point: Sequence[fmpz_mod_poly]) -> list[fmpz_mod_poly]:
        coordinates = [ring.one * 0] * 8
        for k, value in zip(self.free, point, strict=True):
            coordinates[k] = value
        weights = [0 if k == dependent_coordinate(self.chart) else self.chart[k] for k in range(4)]
        coordinates[dependent_coordinate(self.chart)] = ring.one - combination(weights, coordinates[:4])
        return coordinates


def _derivative(quadric: Quadric, index: int, x: Sequence[fmpz_mod_poly]) -> fmpz_mod_poly:
    total = x[0] * 0
    for (k, m), coefficient in quadric.items():
        if k == index:
            total += x[m] * coefficient
        if m == index:
            total += x[k] * coefficient
    return total
