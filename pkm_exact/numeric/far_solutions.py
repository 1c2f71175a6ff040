"""Complex solutions for whose boxes doubles do not suffice, as where the platform is far off: the usual ones at once.

From where doubles lead, one Newton step with 128 bits and one with more than twice the bits of the grid lead to the
limit; its box there is tested with the same matrix Y, the inverse of F' at the last point y but one. For a box X of
radii r around m, and y in it, the image of X under Krawczyk's operator (``krawczyk_operator``) lies within

    (y - m) - Y F(y) + (1 - Y F'(X)) ((X - m) + (m - y)),

for F(y) - F(m) = F'((m + y) / 2) (y - m). What is not as usual is left to ``certification``, which would find the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Final

import numpy as np
from flint import acb, acb_mat, arb

from pkm_exact.balls import box_around_zero, unit_matrix_for
from pkm_exact.numeric.certified_boxes import GUARD_BITS, centre, is_motion, reaches
from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.double_krawczyk import inverses_of
from pkm_exact.numeric.grids import GRIDS, first_grid, nearest_box
from pkm_exact.numeric.study_system import Complex, Real
from pkm_exact.poses.isolated_solutions import RADIUS, ROOM, Box
from pkm_exact.precision import working_precision

BITS: Final = 128
"""FLINT is much quicker up to so many bits."""
TRIED: Final = (44, 72)
"""Grids that are tried here."""
FINE_BITS: Final = 2 * max(TRIED) + GUARD_BITS
SLACK: Final = 1.01
"""Boxes must be mapped into what is so many times smaller than need be: the proof holds with another Y as well then."""
CLOSE: Final = 2.0**-32
"""The next step, by radii, as far as the last one tells: which grid point is nearest is then certain."""


@dataclass(frozen=True, eq=False)
class FarSolution:
    """A limit of Newton's method, and the box around it.

    Attributes
    ----------
    point : acb_mat
        Far more exact than the grid.
    known : int
        Exponent of this grid.
    grid : int
        That of the first grid that is to be tried.
    box : Box or None
        Proved, on that grid.
    """

    point: acb_mat
    known: int
    grid: int
    box: Box | None


def far_solutions(system: ChartSystem, points: Complex) -> list[FarSolution | None]:
    """The solutions near points that are not real; None where Newton's method is not as quick as it is mostly.

    Parameters
    ----------
    system : ChartSystem
    points : (p, n) complex array
    """
    found: list[FarSolution | None] = []
    for point, width in zip(points, _widths(system, points).tolist(), strict=True):
        grid = first_grid(width, GRIDS[0]) if isfinite(width) else GRIDS[0]
        limit = _limit(system, point) if grid in TRIED else None
        far = None if limit is None else _far_solution(system, limit, grid)
        if limit is not None and far is not None and far.box is None and far.grid != grid and far.grid in TRIED:
            far = _far_solution(system, limit, far.grid, far.grid)
        found.append(far)
    return found


@dataclass(frozen=True, eq=False)
class _Limit:
    """The last point y of Newton's method but one, the matrix Y there, Y F(y), and the last point."""

    near: acb_mat
    inverse: acb_mat
    step: acb_mat
    point: acb_mat


def _widths(system: ChartSystem, points: Complex) -> Real:
    """About how wide Y F'(X) is for boxes X on the first grid, by their radii."""
    equations = system.in_doubles
    if equations is None or not len(points):
        return np.full(len(points), np.nan)
    with np.errstate(all="ignore"):
        inverses = inverses_of(equations.jacobians(points))
        sizes = np.abs(points)
        halves = np.array(system.support) // 4
        shift = [sizes[:, halves == half].max(axis=1, initial=0) for half in (0, 1)]
        radii = np.where(halves, np.maximum(shift[1] / shift[0], 1)[:, None], 1.0) * (RADIUS * 2.0 ** -GRIDS[0])
        around = 2 * (np.abs(inverses.real) + np.abs(inverses.imag)) @ equations.variations(radii)
        width: Real = ((around @ radii[:, :, None])[:, :, 0] / radii).max(axis=1)
    return width


def _limit(system: ChartSystem, point: Complex) -> _Limit | None:
    start = acb_mat(len(point), 1, [acb(float(value.real), float(value.imag)) for value in point])
    try:
        with working_precision(BITS):
            jacobian = system.jacobian(start)
            near = (start - jacobian.solve(system.values(jacobian, start), algorithm="approx")).mid()
        with working_precision(FINE_BITS):
            jacobian = system.jacobian(near)
            values = system.values(jacobian, near)
        with working_precision(BITS):
            inverse = jacobian.solve(unit_matrix_for(near), algorithm="approx").mid()
    except ZeroDivisionError:
        return None
    with working_precision(FINE_BITS):
        step = inverse * values
        return _Limit(near, inverse, step, (near - step).mid())


def _far_solution(system: ChartSystem, limit: _Limit, exponent: int, least: int = GRIDS[0]) -> FarSolution | None:
    """One of them, on this grid if it is the first one from the least one on."""
    near, inverse, step = limit.near, limit.inverse, limit.step
    with working_precision(FINE_BITS):
        box = nearest_box(system, limit.point, exponent)
        middle = _on_the_side_of(limit.point, centre(system, box))
        offset = near - middle
        image = offset - step
    radii = reaches(system, box)
    away = _relative(offset, radii).max()
    if box.is_real or not away < 1:
        return None
    with working_precision(BITS):
        around = box_around_zero(radii, acb_mat, real=False)
        contracted = (unit_matrix_for(near) - inverse * system.jacobian(middle + around)) * around
        widths, moved, steps = (_relative(column, radii) for column in (contracted, image, step))
        width = widths.max()
        if not width * steps.max() ** 2 < CLOSE:
            return None
        grid = first_grid(width, exponent) if min(box.exponents) >= exponent - GRIDS[0] else GRIDS[0]
        grid = max(grid, least)
        if grid == exponent and (moved * (1 - width / 8) + widths / (1 + width / 8)).max() * ROOM > SLACK:
            grid = GRIDS[GRIDS.index(grid) + 1]  # with any matrix Y it would be too wide
        is_inside = SLACK * ROOM * (moved + (1 + away) * widths).max() < 1
        is_proved = grid == exponent and is_inside and is_motion(system, middle + ROOM * around)
    return FarSolution(limit.point, exponent, grid, box if is_proved else None)


def _on_the_side_of(point: acb_mat, middle: acb_mat) -> acb_mat:
    """The middle of the box, or of its conjugate: a box stands for both."""
    pairs = zip(point.entries(), middle.entries(), strict=True)
    is_other = any(b.imag != 0 and (a.imag < 0) != (b.imag < 0) for a, b in pairs)
    return middle.conjugate() if is_other else middle


def _relative(column: acb_mat, radii: Sequence[arb]) -> Real:
    """How large entries are at most, the larger of real and imaginary part, beside the radii; rounded up."""
    sizes = [
        float(part.upper() / radius)
        for entry, radius in zip(column.entries(), radii, strict=True)
        for part in (abs(entry.real), abs(entry.imag))
    ]
    found: Real = np.array(sizes).reshape(-1, 2).max(axis=1) * (1 + 2.0**-40)
    return found
