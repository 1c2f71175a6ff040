"""Many rows near one start section at once: Newton's method from the solutions at home, and boxes in doubles.

Every step is one on arrays that have the solutions of all rows, one row after another, with the equations of each. What
is found of a row is what would be found of it alone, as far as answers go: boxes are proved, and those around the
nearest grid points. Rows that are not as usual are left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.double_boxes import DoubleBoxes, double_boxes
from pkm_exact.numeric.double_krawczyk import DoubleEquations
from pkm_exact.numeric.grids import GRIDS
from pkm_exact.numeric.nearby import ENOUGH, GREATEST_CHANGE, HOME_STEPS
from pkm_exact.numeric.poses import Charted, chart_near, is_tracked
from pkm_exact.numeric.start import SAME, StartSection
from pkm_exact.numeric.study_system import Complex, Section, numeric_section, rational_coordinates, section_quadrics
from pkm_exact.numeric.tracker import polished


def near_home(problems: Sequence[ForwardProblem], start: StartSection) -> list[Charted | None]:
    """What is found of each row from the start's home; None of those that are to be solved by themselves.

    Parameters
    ----------
    problems : sequence of ForwardProblem
        Of one robot, which differ in lengths.
    start : StartSection
    """
    found: list[Charted | None] = [None] * len(problems)
    if start.home is None or not len(start.home) or not all(map(is_tracked, problems)):
        return found
    try:
        section, legs = _sections(problems, start)
    except OverflowError:
        return found
    points, rows = _solutions(section, legs, start.home, problems[0].solution_bound)
    systems: dict[int, tuple[ChartSystem, Complex]] = {}
    for row in rows:
        there = rational_coordinates(points[row], section)
        chart = chart_near(there, problems[row])
        values = there[:, :4] @ np.array(chart, dtype=float)
        if values.all():
            system = ChartSystem(problems[row], chart)
            systems[row] = system, (there / values[:, None])[:, list(system.support)]
    for row, boxes in _boxes(systems).items():
        system, there = systems[row]
        found[row] = Charted(system, there, boxes)
    return found


def _sections(problems: Sequence[ForwardProblem], start: StartSection) -> tuple[Section, Complex]:
    """The section of the first row, and the forms of all, (k, m, 17)."""
    first = numeric_section(problems[0], start.frames)
    unit = first.frames.unit
    if not all(_have_same_joints(problem, problems[0]) for problem in problems):
        return first, np.stack([numeric_section(problem, start.frames).legs for problem in problems])
    squares = np.array([[float(leg.length_squared) for leg in problem.distances] for problem in problems])
    legs = np.repeat(first.legs[None], len(problems), axis=0)
    legs[..., -1] += (squares[0] - squares) / unit**2
    return first, legs


def _have_same_joints(problem: ForwardProblem, other: ForwardProblem) -> bool:
    return (
        problem.has_only_distances
        and other.has_only_distances
        and problem.metric == other.metric
        and all(
            (one.base, one.platform) == (two.base, two.platform)
            for one, two in zip(problem.distances, other.distances, strict=True)
        )
    )


def _solutions(section: Section, legs: Complex, home: Complex, bound: int) -> tuple[Complex, list[int]]:
    """(k, p, n): where Newton's method leads from home; the rows of which these are all solutions, with conjugates."""
    count = len(legs)
    with np.errstate(all="ignore"):
        quadrics = section_quadrics(legs, section.motion)
        points, change = polished(np.tile(home, (count, 1)), quadrics, HOME_STEPS, ENOUGH)
        points = points.reshape(count, *home.shape)
        overlaps = np.abs(points.conj() @ points.transpose(0, 2, 1))
        mirrored = np.abs(points @ points.transpose(0, 2, 1)) > 1 - SAME
    overlaps[:, range(len(home)), range(len(home))] = 0
    real = np.count_nonzero(mirrored.diagonal(axis1=1, axis2=2), axis=1)
    are_all = (change.reshape(count, -1) < GREATEST_CHANGE).all(axis=1) & (overlaps < 1 - SAME).all(axis=(1, 2))
    are_all &= (np.count_nonzero(mirrored, axis=(1, 2)) == real) & (2 * len(home) - real >= bound)
    return points, np.flatnonzero(are_all).tolist()


def _boxes(systems: dict[int, tuple[ChartSystem, Complex]]) -> dict[int, DoubleBoxes]:
    """Those of the rows whose equations go together: with one chart, and the same monomials."""
    by_chart: dict[tuple[int, ...], list[int]] = {}
    for row, (system, _) in systems.items():
        if system.in_doubles is not None:
            by_chart.setdefault(system.chart, []).append(row)
    found: dict[int, DoubleBoxes] = {}
    for rows in by_chart.values():
        known = [system.in_doubles for system, _ in map(systems.__getitem__, rows)]
        equations = DoubleEquations.stacked([entry for entry in known if entry is not None])
        if equations is not None:
            points: NDArray[Any] = np.concatenate([systems[row][1] for row in rows])
            found |= dict(zip(rows, double_boxes(equations, points, GRIDS[0]).parts(len(rows)), strict=True))
    return found
