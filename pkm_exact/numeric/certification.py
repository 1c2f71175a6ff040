"""From approximate solutions to boxes, each of which provably holds exactly one, real or not by proof.

An approximation is refined by Newton's method in ball arithmetic and rounded to a grid; its box is tested by the
Krawczyk operator. What fails on one grid is tried on a finer one, so that precision rises only where it is needed.
A real box is mapped into itself by conjugation: its only solution is real. A box that is disjoint from its conjugate
holds no real solution, and the conjugate box holds another one. What is neither stays undecided.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import isfinite

import numpy as np
from flint import acb, acb_mat, arb

from pkm_exact.balls import Balls, unit_matrix_for
from pkm_exact.numeric.box_order import in_order, meeting
from pkm_exact.numeric.certified_boxes import GUARD_BITS, certified
from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.double_boxes import CLEARLY_COMPLEX, DoubleBoxes, Limit, double_boxes
from pkm_exact.numeric.far_solutions import far_solutions
from pkm_exact.numeric.grids import GRIDS, dyadic, first_grid, grid_exponents, nearest_box, size_exponent
from pkm_exact.numeric.study_system import Complex
from pkm_exact.poses.isolated_solutions import RADIUS, Box, IsolatedSolutions
from pkm_exact.precision import working_precision
from pkm_exact.stages import Amount, Watch

FIRST_REFINED = 72
"""Of these grids, the one for which solutions are refined first."""
NEWTON_STEPS = 60
"""Steps after which an approximation that still moves is given up; Newton's method needs half a dozen."""
SETTLED_BITS = 30
"""The last step is this many bits smaller than a unit of the grid: which grid point is nearest is then certain."""
SETTLING_STEPS = 6
"""Steps near the limit after which a last one that is still too large shows that more bits are needed."""
SURELY_CONVERGING = arb(2) ** -20
"""Relative steps as small as this are not damped any more."""
GREATEST_DAMPING = 1 << 10
"""Steps are not made shorter than by this factor."""
SAME = 1e-10
"""Points this close to each other, relative to their size, are taken for the same."""


def isolated_solutions(
    system: ChartSystem, points: Complex, watch: Watch | None = None, known: DoubleBoxes | None = None
) -> IsolatedSolutions:
    """The solutions near the given points, each once; points at which nothing can be proved are left out.

    Parameters
    ----------
    system : ChartSystem
    points : (p, n) complex array
        Approximate solutions in the system's chart; only the coordinates of its support.
    watch : callable, optional
        Gets how many solutions are certified, after each grid.
    known : DoubleBoxes, optional
        Of these points, none of which is the conjugate of another one; far ones included (``add_far_solutions``).
    """
    known = _in_doubles(system, points if known else without_conjugates(points), known)
    boxes, points = known.boxes, known.points
    found: dict[Box, acb_mat | Complex] = {box: point for box, point in zip(boxes, points, strict=True) if box}
    rest = [place for place, box in enumerate(boxes) if box is None]
    rest = [rest[k] for k in _first_of_pairs(points[rest])] if rest else rest
    left = [_start(system, points[place], known.limits[place]) for place in rest]
    for exponent in GRIDS:
        now = [start for start in left if start.exponent <= exponent]
        left = [start for start in left if start.exponent > exponent]
        limits = [limit for start in now if (limit := _limit(system, start, exponent)) is not None]
        candidates = {nearest_box(system, limit.point, exponent): limit for limit in limits if limit.known >= exponent}
        good = certified(system, list(candidates))
        proved = {box for box, is_good in zip(candidates, good, strict=True) if is_good and _is_decided(box)}
        left += [limit for limit in limits if limit.known < exponent]
        left += [limit for box, limit in candidates.items() if box not in proved]
        found |= {box: candidates[box].point for box in candidates if box in proved}
        # Boxes that meet hold one solution or two; a finer grid tells.
        doubtful = meeting(list(found))
        left += [_Start(_column(found.pop(box))) for box in doubtful]
        if watch is not None:
            count = sum(1 if box.is_real else 2 for box in found)
            watch(Amount(count, len(points), "paths certified", detail=f"grid 2^-{exponent}"))
        if not left:
            break
    listed = in_order(found)
    return IsolatedSolutions(
        system.chart,
        tuple(box for box in listed if box.is_real),
        tuple(box for box in listed if not box.is_real),
    )


def _in_doubles(system: ChartSystem, points: Complex, known: DoubleBoxes | None) -> DoubleBoxes:
    """What doubles suffice to prove of the points, but for boxes that do not tell whether a solution is real."""
    if system.in_doubles is None:
        return DoubleBoxes.none(points)
    found = double_boxes(system.in_doubles, points, GRIDS[0]) if known is None else known
    if known is None:
        add_far_solutions([system], [found])
    pairs = zip(found.boxes, found.solutions, strict=True)
    system.double_solutions.update({box: solution for box, solution in pairs if box and solution})
    return replace(found, boxes=[box if box is not None and _is_decided(box) else None for box in found.boxes])


def add_far_solutions(systems: Sequence[ChartSystem], found: Sequence[DoubleBoxes]) -> None:
    """The boxes of those solutions of each system that doubles alone did not suffice for."""
    rest = [[place for place, box in enumerate(boxes.boxes) if box is None] for boxes in found]
    if any(rest):
        points = [boxes.points[places] for boxes, places in zip(found, rest, strict=True)]
        for boxes, places, far in zip(found, rest, far_solutions(systems, points), strict=True):
            for place, box, solution, limit in zip(places, far.boxes, far.solutions, far.limits, strict=True):
                boxes.boxes[place], boxes.solutions[place], boxes.limits[place] = box, solution, limit


@dataclass(frozen=True, eq=False)
class _Start:
    """What is left of an approximate solution.

    Attributes
    ----------
    point : acb_mat
    known : int
        It is known far better than this grid tells; 0 if nothing is known.
    exponent : int
        Of the first grid that is to be tried.
    """

    point: acb_mat
    known: int = 0
    exponent: int = 0


def _start(system: ChartSystem, point: Complex, known: Limit | None = None) -> _Start:
    """An approximation, refined at once as far as is mostly needed: grids that are too coarse are not tried then."""
    column = _column(point) if known is None else _exactly(known)
    if known is not None and known.known:
        return _Start(column, known.known, known.exponent)
    limit = refined(system, column, FIRST_REFINED)
    if limit is None or not limit[1]:
        return _Start(column)
    return _Start(limit[0], FIRST_REFINED, _first_grid(system, limit[0]))


def _first_grid(system: ChartSystem, point: acb_mat) -> int:
    """The first grid that is tried for the box around a solution (``grids.first_grid``)."""
    equations = system.in_doubles
    with working_precision(FIRST_REFINED + GUARD_BITS):
        inverse = _inverse(system, point)
        values = [dyadic(value) for value in point.entries()]
    exponents = grid_exponents(system, values, FIRST_REFINED)
    if equations is None or inverse is None or min(exponents) < FIRST_REFINED - GRIDS[0]:
        return GRIDS[0]
    radii = np.array([RADIUS * 2.0 ** -exponents[index // 4] for index in system.support])
    is_real = max(abs(float(value.imag)) for value in point.entries()) < 2.0 ** -GRIDS[0]
    sizes = np.abs(inverse.real) if is_real else 2 * (np.abs(inverse.real) + np.abs(inverse.imag))
    width = float(np.max(sizes @ (equations.variations(radii[None])[0] @ radii) / radii))
    return first_grid(width, FIRST_REFINED) if isfinite(width) else GRIDS[0]


def _inverse(system: ChartSystem, point: acb_mat) -> Complex | None:
    """The inverse of F', rounded to double."""
    try:
        found = system.jacobian(point).solve(unit_matrix_for(point), algorithm="approx")
    except ZeroDivisionError:
        return None
    return np.array([complex(value) for value in found.entries()]).reshape(system.size, system.size)


def _limit(system: ChartSystem, start: _Start, exponent: int) -> _Start | None:
    """The start refined for a grid; None without convergence."""
    if start.known >= exponent:
        return start
    limit = refined(system, start.point, exponent)
    return None if limit is None else _Start(limit[0], exponent * limit[1])


def without_conjugates(points: Complex) -> Complex:
    """The points without those that are clearly complex and the conjugate of an earlier one: a box stands for both."""
    rest: Complex = points[_first_of_pairs(points)]
    return rest


def _first_of_pairs(points: Complex) -> list[int]:
    """The places of these points."""
    sizes = np.abs(points).max(axis=1, initial=0)
    complex_ones = np.flatnonzero(np.abs(points.imag).max(axis=1, initial=0) > CLEARLY_COMPLEX * sizes)
    first = points[complex_ones, 0]
    # Few pairs have the first coordinate in common.
    i, j = np.nonzero(np.abs(first[:, None] - first[None].conj()) <= SAME * sizes[complex_ones])
    i, j = complex_ones[i[i < j]], complex_ones[j[i < j]]
    paired = np.abs(points[i] - points[j].conj()).max(axis=1, initial=0) <= SAME * sizes[j]
    second = set(j[paired].tolist())
    return [place for place in range(len(points)) if place not in second]


def _is_decided(box: Box) -> bool:
    """Whether the solution in the box is real, or provably not."""
    return box.is_real or any(abs(imaginary) > RADIUS for _, imaginary in box.centre)


def _column(point: Complex | acb_mat) -> acb_mat:
    if isinstance(point, acb_mat):
        return point
    return acb_mat(len(point), 1, [acb(float(value.real), float(value.imag)) for value in point])


def _exactly(known: Limit) -> acb_mat:
    values = [acb(arb((real, -known.bits)), arb((imaginary, -known.bits))) for real, imaginary in known.point]
    return acb_mat(len(values), 1, values)


def refined(system: ChartSystem, point: Balls, exponent: int) -> tuple[Balls, bool] | None:
    """The limit of Newton's method, and whether it is known far better than the grid tells; None without convergence.

    Steps are halved until the next one, with the same matrix, is smaller (Deuflhard's natural monotonicity test): the
    iteration then follows the path from the point to its solution, however small the basin of the full method is.
    """
    large = max(size_exponent(dyadic(value)) for value in point.entries())
    with working_precision(2 * exponent + GUARD_BITS + max(0, large - exponent)):
        jacobian = system.jacobian(point)
        values = system.values(jacobian, point)
        near = 0
        for _ in range(NEWTON_STEPS):
            step = _approximate(jacobian, values)
            if step is None:
                return None
            length, damping = _size(step), 1
            while True:
                moved = (point - step / damping).mid()
                relative = length / (damping * _size(moved))
                if damping == 1 and relative < arb(2) ** -(exponent + 8):
                    near += 1
                    if (is_settled := _is_settled(system, step, moved, exponent)) or near == SETTLING_STEPS:
                        return moved, is_settled
                matrix = system.jacobian(moved)
                values = system.values(matrix, moved)
                if relative < SURELY_CONVERGING:
                    break
                following = _approximate(jacobian, values)
                if following is not None and _size(following) * 4 * damping < length * (4 * damping - 1):
                    break
                damping *= 2
                if damping > GREATEST_DAMPING:
                    return None
            point, jacobian = moved, matrix
    return None


def _is_settled(system: ChartSystem, step: Balls, point: Balls, exponent: int) -> bool:
    """Whether a step is far smaller than the units of the grids that the point will be rounded to."""
    exponents = grid_exponents(system, [dyadic(value) for value in point.entries()], exponent)
    return all(
        abs(value).mid() < arb(2) ** -(exponents[index // 4] + SETTLED_BITS)
        for index, value in zip(system.support, step.entries(), strict=True)
    )


def _approximate(jacobian: Balls, values: Balls) -> Balls | None:
    try:
        return jacobian.solve(values, algorithm="approx").mid()
    except ZeroDivisionError:
        return None


def _size(column: acb_mat) -> arb:
    """The largest entry in absolute value, roughly."""
    return max((abs(entry).mid() for entry in column.entries()), default=arb(0))
