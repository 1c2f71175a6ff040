"""Many rows near one start section at once: Newton's method from the solutions at home, boxes and poses in doubles.

Every step is one on arrays that have the solutions of all rows, one row after another, with the equations of each. What
is found of a row is what would be found of it alone, as far as answers go: boxes are proved, and those around the
nearest grid points. Where home does not lead, guesses are the template's. Rows that are not as usual are left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.certification import add_far_solutions, isolated_solutions, without_conjugates
from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.double_boxes import DoubleBoxes, double_boxes
from pkm_exact.numeric.double_krawczyk import DoubleEquations
from pkm_exact.numeric.double_rounding import rounded
from pkm_exact.numeric.grids import GRIDS
from pkm_exact.numeric.nearby import ENOUGH, GREATEST_CHANGE, HOME_STEPS
from pkm_exact.numeric.poses import Charted, in_chart, is_tracked, poses_in_doubles
from pkm_exact.numeric.seeds import has_seeds, seeds_of_each
from pkm_exact.numeric.start import SAME, StartSection
from pkm_exact.numeric.study_system import Complex, Section, numeric_section, rational_coordinates, section_quadrics
from pkm_exact.numeric.tracker import polished

SEEDED: Final = 8
"""Rows that go through the template together at most: they stay in the cache."""


def rows_together(problems: Sequence[ForwardProblem], start: StartSection, width: Fraction) -> list[Charted | None]:
    """What is found of each row from the start's home, or by the template; None of those to be solved by themselves.

    Parameters
    ----------
    problems : sequence of ForwardProblem
        Of one robot, which differ in lengths.
    start : StartSection
    width : Fraction
        Largest width of a pose's box, in any coordinate.
    """
    found: list[Charted | None] = [None] * len(problems)
    if not all(map(is_tracked, problems)):
        return found
    try:
        systems = {row: in_chart(problems[row], points) for row, points in _guesses(problems, start).items()}
    except OverflowError:
        return found
    for row, boxes in _boxes(systems).items():
        system, points = systems[row]
        isolated = isolated_solutions(system, points, None, boxes)
        if isolated.count == problems[row].solution_bound:
            found[row] = Charted(system, points, boxes, isolated)
    return _with_poses(found, width)


def _guesses(problems: Sequence[ForwardProblem], start: StartSection) -> dict[int, Complex]:
    """All eight coordinates of approximate solutions of rows, with one of each conjugate pair."""
    found: dict[int, Complex] = {}
    section, legs = _sections(problems, start)
    if start.home is not None and len(start.home):
        points, rows = _solutions(section, legs, start.home, problems[0].solution_bound)
        found = dict(zip(rows, _rational(list(points[rows]), section), strict=True))
    rest = [row for row in range(len(problems)) if row not in found]
    if rest and start.has_long_paths and has_seeds(problems[0]):
        few = [rest[first : first + SEEDED] for first in range(0, len(rest), SEEDED)]
        seeded = [points for rows in few for points in seeds_of_each(legs[rows])]
        for row, points, rational in zip(rest, seeded, _rational(seeded, section), strict=True):
            are_all = _count(points) == problems[0].solution_bound
            found[row] = rational if are_all else without_conjugates(rational)
    return found


def _count(points: Complex) -> int:
    """How many projective points, of norm 1, there are with the conjugates of those that are not real."""
    return 2 * len(points) - int(np.count_nonzero(np.abs((points * points).sum(axis=1)) > 1 - SAME))


def _rational(rows: Sequence[Complex], section: Section) -> list[Complex]:
    """Rational coordinates of points of each row."""
    if not rows:
        return []
    return np.split(rational_coordinates(np.concatenate(rows), section), np.cumsum([len(row) for row in rows])[:-1])


def _with_poses(rows: Sequence[Charted | None], width: Fraction) -> list[Charted | None]:
    """With what doubles tell of the poses of rows that have the same joints."""
    found = list(rows)
    chosen = [(row, entry, entry.isolated) for row, entry in enumerate(rows) if entry and entry.isolated]
    chosen = [triple for triple in chosen if _have_same_joints(triple[1].problem, chosen[0][1].problem)]
    if chosen:
        poses = poses_in_doubles([(entry.system, isolated) for _, entry, isolated in chosen], width)
        for (row, entry, _), part in zip(chosen, poses, strict=True):
            found[row] = replace(entry, poses=part)
    return found


def _sections(problems: Sequence[ForwardProblem], start: StartSection) -> tuple[Section, Complex]:
    """The section of the first row, and the forms of all, (k, m, 17)."""
    first = numeric_section(problems[0], start.frames)
    unit = first.frames.unit
    if not all(_have_same_joints(problem, problems[0]) for problem in problems):
        return first, np.stack([numeric_section(problem, start.frames).legs for problem in problems])
    squares = np.array([rounded(leg.length_squared for leg in problem.distances) for problem in problems])
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
    for row, (system, points) in systems.items():
        if system.in_doubles is not None and len(points):
            by_chart.setdefault(system.chart, []).append(row)
    found: dict[int, DoubleBoxes] = {}
    for rows in by_chart.values():
        known = [system.in_doubles for system, _ in map(systems.__getitem__, rows)]
        equations = DoubleEquations.stacked([entry for entry in known if entry is not None])
        if equations is not None:
            counts = [len(systems[row][1]) for row in rows]
            together: NDArray[Any] = np.concatenate([_padded(systems[row][1], max(counts)) for row in rows])
            boxes = double_boxes(equations, together, GRIDS[0]).parts(counts)
            add_far_solutions([systems[row][0] for row in rows], boxes)
            found |= dict(zip(rows, boxes, strict=True))
    return found


def _padded(points: Complex, count: int) -> Complex:
    """So many points: the last one again."""
    found: Complex = np.concatenate([points, np.repeat(points[-1:], count - len(points), axis=0)])
    return found
