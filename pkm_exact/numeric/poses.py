"""All isolated solutions of a robot by path tracking and Krawczyk's operator, and the boxes of the real ones."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Final

import numpy as np
from flint import arb, arb_mat

from pkm_exact.balls import Balls
from pkm_exact.errors import InternalContradictionError
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import support
from pkm_exact.numeric.certification import isolated_solutions
from pkm_exact.numeric.certified_boxes import GUARD_BITS, centre, enclosing_balls
from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.double_boxes import DoubleBoxes
from pkm_exact.numeric.krawczyk_operator import around_zero, is_inside, krawczyk
from pkm_exact.numeric.poses_in_doubles import PosesInDoubles
from pkm_exact.numeric.start import StartSection, generic_start, start_quadrics
from pkm_exact.numeric.study_system import Complex, Section, numeric_section, rational_coordinates
from pkm_exact.numeric.tracker import polished, track
from pkm_exact.poses.boxes import (
    Enclosures,
    disjoint_cells,
    exponent_for_width,
    order_of,
    ordinary_coordinates,
    pose_in_cells,
)
from pkm_exact.poses.isolated_solutions import RADIUS, Box, IsolatedSolutions
from pkm_exact.poses.jacobian import LEAST_PRECISION, pose_jacobians
from pkm_exact.poses.leg_jacobian import LegJacobian
from pkm_exact.poses.pose import Interval, Pose
from pkm_exact.precision import working_precision
from pkm_exact.solution import Solution
from pkm_exact.stages import Watch

CHARTS: Final = ((3, -1, 2, 1), (1, 2, -1, 3), (2, 3, 1, -1), (-1, 1, 3, 2), (5, -3, 1, 4), (1, 4, -5, -2))
"""Charts w.e = 1, of which the first is taken that comes close to none of the solutions."""
CLEARANCES: Final = (0.03, 0.01, 0.001, 0.0)
"""How far, relative to |w| |e|, solutions should stay away from w.e = 0; the next smaller one if no chart does."""
GREATEST_CHANGE: Final = 1e-3
"""An end point that Newton's method still moves by more than this is not taken for a solution."""
LOST_BITS: Final = 12
"""Bits by which the limit of Newton's method may be less exact than if every step doubled their number."""
COORDINATES: Final = 16
"""Of a pose: position, rotation matrix, quaternion."""
BOX_COORDINATES: Final = 12
"""Those of its box: position and rotation matrix."""
NARROWINGS: Final = 64
"""Times that an enclosure is narrowed; its width is about squared each time."""


@dataclass(frozen=True)
class Approximations:
    """Approximate solutions of a robot, real and complex.

    Attributes
    ----------
    section : Section
    points : (p, n) complex array
        Study coordinates of the normalised robot, of norm 1.
    """

    section: Section
    points: Complex


@dataclass(frozen=True, eq=False)
class Charted:
    """Approximate solutions in a chart, none of them the conjugate of another one, and what doubles prove of them.

    Attributes
    ----------
    system : ChartSystem
    points : (p, n) complex array
    boxes : DoubleBoxes
    isolated : IsolatedSolutions, optional
        What is certified of them.
    poses : PosesInDoubles, optional
        Of the real ones.
    answer : Solution, optional
        What becomes of them.
    """

    system: ChartSystem
    points: Complex
    boxes: DoubleBoxes
    isolated: IsolatedSolutions | None = None
    poses: PosesInDoubles | None = None
    answer: Solution | None = None

    @property
    def problem(self) -> ForwardProblem:
        """Whose solutions they are."""
        return self.system.problem


def is_tracked(problem: ForwardProblem) -> bool:
    """Whether paths lead to its solutions: it has as many linear forms as freedoms, and no quadrics.

    Examples
    --------
    >>> is_tracked(ForwardProblem(()))
    False
    """
    return len(problem.forms) == problem.motion.dimension and not problem.squares


def approximations(
    problem: ForwardProblem, start: StartSection | None = None, seed: int = 0, watch: Watch | None = None
) -> Approximations:
    """The ends of all paths from a start section to the robot.

    Parameters
    ----------
    problem : ForwardProblem
    start : StartSection, optional
        By default the generic one; see ``start``.
    seed : int
        Other seeds take other paths; see ``start_quadrics``.
    watch : callable, optional
        Gets how many paths have ended.

    Raises
    ------
    OverflowError
        If a number of the robot is too large for floating point.
    """
    start = start or generic_start(problem.motion)
    section = numeric_section(problem, start.frames)
    with np.errstate(all="ignore"):
        quadrics = start_quadrics(start, seed, problem.motion)
        ends, arrived = track(start.solutions, quadrics, section.quadrics, watch=watch)
        ends, change = polished(ends[arrived], section.quadrics)
    return Approximations(section, ends[change < GREATEST_CHANGE])


def certified_solutions(
    problem: ForwardProblem, found: Approximations | Charted, watch: Watch | None = None
) -> tuple[ChartSystem, IsolatedSolutions]:
    """The chart's equations, and what can be certified of approximate solutions."""
    if isinstance(found, Charted):
        isolated = found.isolated or isolated_solutions(found.system, found.points, watch, found.boxes)
        return found.system, isolated
    system, points = in_chart(problem, rational_coordinates(found.points, found.section))
    return system, isolated_solutions(system, points, watch)


def in_chart(problem: ForwardProblem, points: Complex) -> tuple[ChartSystem, Complex]:
    """The equations in a chart for solutions near points given by all eight coordinates, and these points in it.

    Points that are at infinity in the chart are left out.
    """
    system = ChartSystem(problem, chart_near(points, problem))
    values = points[:, :4] @ np.array(system.chart, dtype=float)
    good = values != 0
    return system, (points[good] / values[good, None])[:, list(system.support)]


def chart_near(points: Complex, problem: ForwardProblem) -> tuple[int, int, int, int]:
    """The chart for solutions near these points."""
    used = support(problem)
    return _chart(points[:, :4], [int(k in used) for k in range(4)])


def _chart(e: Complex, used: Sequence[int]) -> tuple[int, int, int, int]:
    """A chart on the coordinates that are used."""
    charts = [(w[0] * used[0], w[1] * used[1], w[2] * used[2], w[3] * used[3]) for w in CHARTS]
    if not len(e):
        return charts[0]
    weights = np.array(charts, dtype=float)
    sizes = np.linalg.norm(e, axis=1)[:, None] * np.linalg.norm(weights, axis=1)
    closest = np.min(np.abs(e @ weights.T) / np.maximum(sizes, 1e-300), axis=0)
    return next(chart for least in CLEARANCES for chart, value in zip(charts, closest, strict=True) if value >= least)


def real_poses(
    system: ChartSystem, isolated: IsolatedSolutions, width: Fraction, found: PosesInDoubles | None = None
) -> tuple[IsolatedSolutions, int, tuple[Pose, ...]]:
    """The poses in the real boxes, certified and in order; the list of solutions with its real boxes in the same order.

    Parameters
    ----------
    system : ChartSystem
    isolated : IsolatedSolutions
        In the chart of the system.
    width : Fraction
        Largest width of a pose's box, in any coordinate.
    found : PosesInDoubles, optional
        What doubles tell of them, if it is known already (``poses_in_doubles``).

    Returns
    -------
    IsolatedSolutions, int, tuple of Pose
        The second is the exponent of the boxes' grid.
    """
    enclosures, count = box_enclosures(system, isolated.real), len(isolated.real)
    solutions = [system.double_solutions.get(box) for box in isolated.real]
    known = [row for row, solution in enumerate(solutions) if solution is not None]
    in_doubles = found or poses_in_doubles([(system, isolated)], width)[0]

    def cells_in_doubles(exponent: int) -> list[list[Interval | None]]:
        rows: list[list[Interval | None]] = [[None] * COORDINATES for _ in range(count)]
        for row, cells in zip(known, in_doubles.cells_on(exponent), strict=True):
            rows[row] = cells
        return rows

    jacobians_in_doubles: list[LegJacobian | None] = [None] * count
    for row, jacobian in zip(known, in_doubles.jacobians, strict=True):
        jacobians_in_doubles[row] = jacobian
    exponent, cells = disjoint_cells(enclosures, count, width, known=cells_in_doubles)
    jacobians = pose_jacobians(enclosures, system.problem, [None] * count, jacobians_in_doubles)
    order = order_of([row[:BOX_COORDINATES] for row in cells])
    poses = tuple(pose_in_cells(cells[k], None, jacobians[k]) for k in order)
    return replace(isolated, real=tuple(isolated.real[k] for k in order)), exponent, poses


def poses_in_doubles(rows: Sequence[tuple[ChartSystem, IsolatedSolutions]], width: Fraction) -> list[PosesInDoubles]:
    """What doubles tell of the poses in real boxes, of robots that differ in lengths only, all at once."""
    known = [
        [solution for box in isolated.real if (solution := system.double_solutions.get(box)) is not None]
        for system, isolated in rows
    ]
    problems = [system.problem for system, _ in rows]
    found = PosesInDoubles.of(problems, rows[0][0].support, known, exponent_for_width(width))
    return found.parts([len(solutions) for solutions in known])


def isolated_poses(problem: ForwardProblem, width: Fraction) -> tuple[IsolatedSolutions, int, tuple[Pose, ...]] | None:
    """The isolated solutions that path tracking finds and Krawczyk's operator proves, as ``real_poses`` gives them.

    None if there is none, or paths do not lead to such a problem, or its numbers are too large for floating point.
    Every isolated simple solution is the end of a path, but that all paths arrive is not proved.
    """
    if not is_tracked(problem):
        return None
    try:
        system, isolated = certified_solutions(problem, approximations(problem))
    except OverflowError:
        return None
    return real_poses(system, isolated, width) if isolated.count else None


def box_enclosures(system: ChartSystem, boxes: Sequence[Box]) -> Enclosures:
    """Enclosures of the real poses in boxes that are certified."""

    known: dict[int, tuple[int, list[arb]]] = {}

    def enclose(precision: int, indices: Sequence[int]) -> Iterator[list[arb]]:
        bits = max(precision, LEAST_PRECISION)
        coarse = [index for index in indices if index not in known or known[index][0] < bits]
        for index in coarse:
            point = _narrowed(system, boxes[index], bits)
            values = [arb(0)] * 8
            for place, coordinate in enumerate(system.support):
                values[coordinate] = point[place, 0]
            with working_precision(bits + GUARD_BITS):
                known[index] = bits, ordinary_coordinates(values, system.problem.metric)
        return (known[index][1] for index in indices)

    return enclose


def _narrowed(system: ChartSystem, box: Box, exponent: int) -> Balls:
    """An enclosure, 2^-exponent wide, of the solution in a certified box: its Krawczyk image, again and again.

    Coordinates of f are enclosed as coarser as the box's own grid is.
    """
    wanted = [arb(2) ** (box.exponents[0] - box.exponents[index // 4] - exponent) for index in system.support]
    precision, most = 2 * box.exponents[0] + GUARD_BITS, exponent + box.exponents[0] + GUARD_BITS
    enclosure = _known(system, box, most)
    if enclosure is None:
        enclosure = _near_limit(system, box, exponent, most)
    if enclosure is None:
        with working_precision(precision):
            enclosure = enclosing_balls(system, box)
    else:
        precision = most
    for _ in range(NARROWINGS):
        if all(entry.rad() <= width for entry, width in zip(enclosure.entries(), wanted, strict=True)):
            return enclosure
        with working_precision(precision):
            near = system.around(enclosure.mid())
            if near is None:
                break
            enclosure = near.point + krawczyk(near, enclosure - near.point).moved
        precision = min(2 * precision, most)
    raise InternalContradictionError("a certified box cannot be narrowed")


def _known(system: ChartSystem, box: Box, precision: int) -> Balls | None:
    """Where doubles have proved that the solution is, if they have."""
    known = system.double_solutions.get(box)
    if known is None:
        return None
    with working_precision(precision):
        rows = zip(known.point.tolist(), known.step.tolist(), known.error.tolist(), strict=True)
        return arb_mat(system.size, 1, [arb(point, error) - arb(step) for point, step, error in rows])


def _near_limit(system: ChartSystem, box: Box, exponent: int, most: int) -> Balls | None:
    """An enclosure that is proved from the limit of Newton's method, if it converges as fast as it mostly does.

    Newton's method takes half the time of Krawczyk's operator and proves nothing. But a ball around its limit that the
    operator maps into itself holds exactly one solution, and if the ball lies in the box, it is the solution there.
    """
    reached, precision = box.exponents[0], 2 * box.exponents[0] + GUARD_BITS
    with working_precision(precision):
        start = point = centre(system, box)
    while 2 * (reached - LOST_BITS) < exponent:
        with working_precision(precision):
            jacobian = system.jacobian(point)
            try:
                point = (point - jacobian.solve(system.values(jacobian, point), algorithm="approx")).mid()
            except ZeroDivisionError:
                return None
        reached, precision = 2 * reached, min(2 * precision, most)
    with working_precision(most):
        widths = [arb(2) ** (LOST_BITS - reached + box.exponents[0] - box.exponent(index)) for index in system.support]
        near = system.around(point)
        if near is None:
            return None
        image = krawczyk(near, around_zero(near, widths))
        if not is_inside(near, image, widths):
            return None
        for index, offset, width in zip(system.support, (point - start).entries(), widths, strict=True):
            if not abs(offset) + width < RADIUS * arb(2) ** -box.exponent(index):
                return None
        return point + image.moved
