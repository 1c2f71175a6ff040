"""The legs and Study's condition as seven equations in the seven free coordinates of a chart, for Newton lifting."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from random import Random

from flint import fmpz, fmpz_mat, fmpz_mod_poly, fmpz_poly

from pkm_exact.algebra.residue_ring import ResidueRing, combination, integer_polynomial
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import Quadric, pose_quadrics, support
from pkm_exact.poses.translation import LinearTranslation, linear_translation

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
    def _forms(self) -> list[Quadric]:
        return pose_quadrics(self.problem)

    @cached_property
    def products(self) -> tuple[tuple[int, int], ...]:
        """Pairs of coordinates whose products occur in the equations."""
        return tuple(sorted({pair for form in self._forms for pair in form}))

    @cached_property
    def _weights(self) -> fmpz_mat:
        """Those of the forms in the combinations, one a row."""
        random = Random(self.seed)
        return fmpz_mat([[random.randrange(1, 1 << 16) for _ in self._forms] for _ in self.free])

    @cached_property
    def _given(self) -> fmpz_mat:
        """The quadratic forms, one a row, by their coefficients on the products."""
        return fmpz_mat([[form.get(pair, 0) for pair in self.products] for form in self._forms])

    @cached_property
    def coefficients(self) -> fmpz_mat:
        """The combined quadratic forms."""
        return self._weights * self._given

    @property
    def _combines_late(self) -> bool:
        """Whether there are so few forms that it is less to combine what is left of their values."""
        return len(self._forms) <= len(self.free)

    @cached_property
    def gradients(self) -> fmpz_mat:
        """Partial derivatives of the forms by the free coordinates, one a row, as linear forms in the coordinates."""
        dependent = dependent_coordinate(self.chart)
        rows = []
        for equation in range(len(self.free)):
            symmetric = [[0] * 8 for _ in range(8)]
            for (k, m), coefficient in zip(self.products, self.coefficients.table()[equation], strict=True):
                symmetric[k][m] += int(coefficient)
                symmetric[m][k] += int(coefficient)
            for k in self.free:
                slope = self.chart[k] if k < 4 else 0
                rows.append([a - slope * b for a, b in zip(symmetric[k], symmetric[dependent], strict=True)])
        return fmpz_mat(rows)

    def values(self, ring: ResidueRing, point: Sequence[fmpz_poly]) -> list[fmpz_poly]:  # noqa: ARG002  # exact
        """Left-hand sides at the free coordinates."""
        x = self._coordinates(point)
        forms = self._given if self._combines_late else self.coefficients
        return _combined(forms.tolist(), [x[k] * x[m] for k, m in self.products])

    def combined(self, values: list[fmpz_mod_poly]) -> list[fmpz_mod_poly]:
        """The combinations of the forms' values, if these are not combined yet."""
        return [combination(row, values) for row in self._weights.tolist()] if self._combines_late else values

    def jacobian(self, ring: ResidueRing, point: Sequence[fmpz_mod_poly]) -> list[list[fmpz_mod_poly]]:
        """Partial derivatives by the free coordinates; linear in the coordinates."""
        values = _combined(self.gradients.tolist(), self._coordinates([integer_polynomial(value) for value in point]))
        size = len(self.free)
        return [[ring.polynomials(value) for value in values[size * i : size * (i + 1)]] for i in range(size)]

    def completion(self, form: Sequence[int]) -> LinearTranslation | None:
        """The linear equations of the translation, if the separating form on the free coordinates leaves it out."""
        rotation = [k for k in self.free if k < 4]
        if any(form[len(rotation) :]):
            return None
        return linear_translation(self.problem, self.chart, dependent_coordinate(self.chart), self.seed)

    def _coordinates(self, point: Sequence[fmpz_poly]) -> list[fmpz_poly]:
        """All eight coordinates, with integer coefficients."""
        coordinates = [fmpz_poly()] * 8
        for k, value in zip(self.free, point, strict=True):
            coordinates[k] = value
        last = fmpz_poly([1])
        for k in self.free:
            if k < 4:
                last -= self.chart[k] * coordinates[k]
        coordinates[dependent_coordinate(self.chart)] = last
        return coordinates


def _combined(rows: Sequence[Sequence[fmpz]], values: Sequence[fmpz_poly]) -> list[fmpz_poly]:
    """The combinations of polynomials that the rows stand for."""
    combinations = []
    for row in rows:
        total = fmpz_poly()
        for coefficient, value in zip(row, values, strict=True):
            if coefficient and value:
                total += value * coefficient
        combinations.append(total)
    return combinations
