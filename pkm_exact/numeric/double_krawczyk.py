"""Krawczyk's operator for many boxes at once, in doubles, with proved bounds for every rounding.

For a box X of radii r around its centre m, any point x in X, any matrix Y, and quadratic F,

    K(X) - m = (x - m) - Y F(x) + (1 - Y F'((m + x) / 2)) (m - x) + (1 - Y F'(X)) (X - m).

With C >= |1 - Y F'(X)| entry by entry, it lies within (x - m) - Y F(x) +- C (|x - m| + r), and if that is inside the
box, the box holds exactly one solution x* (``krawczyk_operator``). Where it is comes with it: as x* - x = -Y F(x) +
(1 - Y F'((x + x*) / 2)) (x* - x), with q the greatest (C r)_i / r_i and t the greatest |Y F(x)|_i / r_i,

    |x* - (x - Y F(x))| <= t / (1 - q) C r.

F(x) is computed with twice as many bits (``double_forms``), so that x* is known to about a unit in the last place.
Complex boxes are rectangles, and bounds are those of the larger of real and imaginary part: that of a product c z is at
most (|Re c| + |Im c|) times that of z. So entries of Y and C are measured by |Re| + |Im|, and an entry of F' that
varies by v in both parts does so by 2 v. Where Y, m, x and F(x) are real, the box is one of real points. Roundings are
those of ``double_rounding``; what needs more than doubles have is left to others.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.numeric.double_forms import DoubleForms
from pkm_exact.numeric.double_rounding import OUTWARD, SMALL, U, are_moderate, gamma
from pkm_exact.numeric.study_system import Complex, Real

TERMS: Final = 12
"""Sums here have at most eight products, a constant, data and points that are rounded: not more roundings in a row."""
SLACK: Final = 1.01
"""Contractions are counted this many times: what is proved here is then proved by ball arithmetic too."""


@dataclass(frozen=True, eq=False)
class DoubleEquations:
    """F in doubles.

    Attributes
    ----------
    support : sequence of n int
        Which of the eight Study coordinates the unknowns are.
    forms : DoubleForms
        F: quadrics, and w.e - 1.
    norm : (n,) array
        Coefficients of N(e), a sum of squares; at most u off, relatively.
    """

    support: Sequence[int]
    forms: DoubleForms
    norm: Real

    @classmethod
    def stacked(cls, several: Sequence[DoubleEquations]) -> DoubleEquations | None:
        """Those of several problems, each for as many points one after another; None if they differ too much."""
        forms = DoubleForms.stacked([equations.forms for equations in several])
        return None if forms is None else cls(several[0].support, forms, several[0].norm)

    @property
    def are_stacked(self) -> bool:
        """Whether they are those of several problems."""
        return self.forms.head.ndim > 2

    def places(self, chosen: NDArray[np.intp], count: int) -> NDArray[np.intp]:
        """Those of so many points that have these among them: of each problem as many, if there are several.

        Parameters
        ----------
        chosen : (k,) array of int
            In order, at least one.
        """
        if not self.are_stacked:
            return chosen
        several = len(self.forms.head)
        is_left: NDArray[Any] = np.ones(count, dtype=np.bool_)
        is_left[chosen] = False
        table = is_left.reshape(several, -1)
        most = table.shape[1] - int(table.sum(axis=1).min())
        # Stable: the chosen ones come first.
        order: NDArray[Any] = np.argsort(table, axis=1, kind="stable")[:, :most]
        found: NDArray[np.intp] = (order + np.arange(several)[:, None] * table.shape[1]).ravel()
        return found

    @cached_property
    def _slopes(self) -> tuple[Real, Real, Real]:
        """F and F' at 0, (.., n) and (.., n, n), and the derivative of F', (.., n, n, n); all at most u off."""
        size = len(self.norm)
        full = np.zeros((*self.forms.head.shape[:-1], size + 1, size + 1))
        full[..., self.forms.first, self.forms.second] = self.forms.head
        constants = full[..., size, size].copy()
        full = full + np.swapaxes(full, -1, -2)  # diagonal entries doubled, exactly
        return constants, full[..., :size, size].copy(), full[..., :size, :size].copy()

    @cached_property
    def _tables(self) -> tuple[Real, Real]:
        slopes = self._slopes[2]
        table = np.swapaxes(slopes.reshape(*slopes.shape[:-3], -1, len(self.norm)), -1, -2)
        return table.copy(), np.abs(table)

    def at_zero(self, count: int) -> tuple[Real, Real]:
        """F and F' at 0, at most u off, relatively: for all points, or for each of so many."""
        constants, slopes, _ = self._slopes
        if not self.are_stacked:
            return constants, slopes
        each = count // len(constants)
        return constants.repeat(each, axis=0), slopes.repeat(each, axis=0)

    def jacobians(self, points: Real | Complex) -> NDArray[Any]:
        """F' at (p, n) points, rounded."""
        found: NDArray[Any] = self._times(points, self._tables[0]) + self.at_zero(len(points))[1]
        return found

    def variations(self, radii: Real) -> Real:
        """(p, n, n) bounds of how much entries of F' change within radii; the absolute values of what adds up to F'."""
        return self._times(radii, self._tables[1])

    def values_at(self, points: NDArray[Any]) -> tuple[NDArray[Any], Real]:
        """(p, n) values of F at points, from F' in doubles, and how far both parts are off at most.

        Notes
        -----
        F(x) = F(0) + (F'(x) + F'(0)) x / 2. Entries of F' have less than ``TERMS`` roundings in a row, sums of eight
        complex products 16 more.
        """
        (constants, slopes), sizes = self.at_zero(len(points)), _sums(points)
        found: NDArray[Any] = products(self._times(points, self._tables[0]) / 2 + slopes, points) + constants
        around = products(self._times(sizes, self._tables[1]) + np.abs(slopes), sizes) + np.abs(constants)
        return found, gamma(4 * TERMS) * around * OUTWARD + SMALL

    def values_beside(
        self, points: NDArray[Any], moves: NDArray[Any], known: tuple[NDArray[Any], Real]
    ) -> tuple[NDArray[Any], Real]:
        """(p, n) values of F at points + moves, from those at points, and how far both parts are off at most.

        Of the values that are known it is told likewise how far they are off. Points are given up to two roundings.

        Notes
        -----
        F(x + s) = F(x) + (F'(x) + F''(s) / 2) s. Entries of F' have less than ``TERMS`` roundings in a row, and some
        more with those of the points and of F''(s); sums of eight complex products have 16.
        """
        steps, sizes = self._times(moves, self._tables[0]) / 2, _sums(moves)
        found: NDArray[Any] = known[0] + products(self.jacobians(points) + steps, moves)
        around = self.variations(_sums(points) + sizes) + np.abs(self.at_zero(len(points))[1])
        off = known[1] + gamma(4 * TERMS) * products(around, sizes) + 2 * U * _largest(found)
        return found, off * OUTWARD + SMALL

    def _times(self, rows: NDArray[Any], table: Real) -> NDArray[Any]:
        size = len(self.norm)
        found: NDArray[Any] = rows.reshape(*table.shape[:-2], -1, size) @ table
        return found.reshape(len(rows), -1, size)


@dataclass(frozen=True, eq=False)
class Proofs:
    """What is proved of boxes.

    Attributes
    ----------
    proved : (p,) array of bool
        Whether the box is proved to hold exactly one solution, and N(e) not to be 0 there.
    steps : (p, n) array
        Y F(x).
    errors : (p, n) array
        How far x - Y F(x) is off at most, with the steps as they are rounded: in every coordinate, real and imaginary
        part each.
    moved : (p, n) array
        Where the solutions are from the centres: x - m - Y F(x), rounded.
    """

    proved: NDArray[np.bool_]
    steps: NDArray[Any]
    errors: Real
    moved: NDArray[Any]


@dataclass(frozen=True, eq=False)
class DoubleSolution:
    """Where the solution in a real box is: within the error of point - step, in every coordinate.

    Attributes
    ----------
    point, step, error : (n,) arrays
    """

    point: Real
    step: Real
    error: Real


def newton_step(equations: DoubleEquations, points: NDArray[Any], inverses: NDArray[Any]) -> NDArray[Any]:
    """The points moved by Newton's method, with the inverses of F' there."""
    constants, slopes = equations.at_zero(len(points))
    values = products(equations.jacobians(points) + slopes, points) / 2 + constants
    found: NDArray[Any] = points - products(inverses, values)
    return found


def inverses_of(matrices: NDArray[Any]) -> NDArray[Any]:
    """The inverses, roughly; infinite where there is none."""
    try:
        found: NDArray[Any] = np.linalg.inv(matrices)
        return found
    except np.linalg.LinAlgError:
        if len(matrices) == 1:
            return np.full_like(matrices, np.inf)
        middle = len(matrices) // 2
        return np.concatenate([inverses_of(matrices[:middle]), inverses_of(matrices[middle:])])


def double_proofs(
    equations: DoubleEquations,
    inverses: NDArray[Any],
    centres: NDArray[Any],
    radii: Real,
    room: int,
    near: tuple[NDArray[Any], NDArray[Any], Real],
    wider: Real | float = 0.0,
) -> Proofs:
    """Boxes around the centres of which the proof succeeds.

    Parameters
    ----------
    equations : DoubleEquations
    inverses : (p, n, n) array
        Y.
    centres : (p, n) array
        m, rounded.
    radii : (p, n) array
        r, powers of 2.
    room : int
        Boxes must be mapped into what is so many times smaller; N(e) is not 0 in boxes so many times larger either.
    near : three (p, n) arrays
        x - m and F(x), rounded, and how far F(x) is off at most.
    wider : (p, n, n) array, optional
        How much Y F'(X) is to vary at least, entry by entry, for what is proved.
    """
    size, (shift, values, off) = centres.shape[1], near
    parts = np.where(_are_real(inverses, centres, shift, values), 1.0, 2.0)[:, None]
    off_by = gamma(TERMS) * parts
    jacobians = equations.jacobians(centres)
    moderate = are_moderate(inverses.reshape(len(centres), -1), centres, radii, shift)
    sizes, away = _sums(inverses), _largest(shift)
    about = equations.variations(_sums(centres)) + np.abs(equations.at_zero(len(centres))[1])
    width = np.maximum(parts[:, None] * (sizes @ equations.variations(radii)), wider)
    contraction = _sums(np.eye(size) - inverses @ jacobians) * (1 + gamma(4)) + width
    contraction += off_by[:, None] * (sizes @ (_sums(jacobians) + about))
    contraction = contraction * OUTWARD + SMALL
    step = products(inverses, values)
    step_off = products(sizes, off + off_by * _largest(values)) * OUTWARD + SMALL
    moved = shift - step
    bound = _largest(moved) + gamma(4) * (away + _largest(step)) + step_off
    bound += SLACK * products(contraction, away + radii)
    is_inside = (bound * OUTWARD < radii / room).all(axis=1) & (away * OUTWARD <= radii).all(axis=1)
    narrow = products(contraction, radii)
    ratio = (narrow / radii).max(axis=1) * OUTWARD
    times = ((_largest(step) + step_off) / radii).max(axis=1) / np.maximum(1 - ratio, 0.5)
    return Proofs(
        proved=is_inside & moderate & (ratio < 0.5) & _are_motions(equations.norm, centres, room * parts * radii),
        steps=step,
        errors=(times[:, None] * narrow + step_off) * OUTWARD + SMALL,
        moved=moved,
    )


def _are_real(*tables: NDArray[Any]) -> NDArray[np.bool_]:
    """For each row of tables whether all of its numbers are real."""
    parts = [table.imag.reshape(len(table), -1).any(axis=1) for table in tables if np.iscomplexobj(table)]
    return np.logical_not(np.logical_or.reduce(parts)) if parts else np.ones(len(tables[0]), dtype=np.bool_)


def _sums(values: NDArray[Any]) -> Real:
    """Of complex numbers |Re| + |Im|, at most so many times as large a product with them is by its larger part."""
    found: Real = np.abs(values.real) + np.abs(values.imag)
    return found


def _largest(values: NDArray[Any]) -> Real:
    """Of complex numbers the larger part."""
    found: Real = np.maximum(np.abs(values.real), np.abs(values.imag))
    return found


def products(matrices: NDArray[Any], vectors: NDArray[Any]) -> NDArray[Any]:
    """(p, n): matrices (p, n, n) times vectors (p, n)."""
    found: NDArray[Any] = (matrices @ vectors[:, :, None])[:, :, 0]
    return found


def _are_motions(norm: Real, centres: NDArray[Any], reach: Real) -> NDArray[np.bool_]:
    """Whether N(e) is not 0 anywhere within a distance."""
    value, sizes = np.abs((centres * centres) @ norm), np.abs(centres)
    off = (SLACK * reach * (2 * sizes + SLACK * reach) + gamma(4 * TERMS) * sizes * sizes) @ norm
    found: NDArray[np.bool_] = value > off * OUTWARD + SMALL
    return found
