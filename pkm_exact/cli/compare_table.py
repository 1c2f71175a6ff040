"""Numeric methods held against the certified poses, as two tables: the methods, and the assembly modes."""

from __future__ import annotations

import sys
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from typing import TYPE_CHECKING

from pkm_exact.cli.table import print_rows
from pkm_exact.comparison.numeric_distance import Landing
from pkm_exact.geometry.machine import Machine, locked_at
from pkm_exact.indices.index import Output
from pkm_exact.indices.pose_indices import shown_in
from pkm_exact.interactive.answer_notes import answer_notes
from pkm_exact.interactive.display import headline
from pkm_exact.numeric.poses import is_tracked
from pkm_exact.poses.planar_coordinates import angle_in_degrees, planar_coordinates

if TYPE_CHECKING:
    from pkm_exact.comparison.numeric import EngineResult, NumericComparison
    from pkm_exact.poses.pose import Interval, Pose
    from pkm_exact.solution import Solution

_METHODS = (
    "",
    "starts",
    "converged",
    "found",
    "missed",
    "spurious",
    "undecided",
    "least error",
    "greatest",
    "ms/start",
)
_LISTED = 20


def print_comparison(robot: Machine, configuration: str | None, comparison: NumericComparison) -> None:
    """Print the tables, and below them a sentence for what did not converge, to stdout."""
    print_certified(robot, configuration, comparison.solution, f"; random starts: seed {comparison.seed}")
    sys.stdout.write(
        f"\nmethods: starts, and how many of them converged; certified poses found and missed; starts that ended where "
        f"no certified pose is,\nor at one that is not clear; true errors of what was found, "
        f"in {robot.unit}, rounded outward\n"
    )
    print_rows([_method(result, comparison) for result in comparison.results], _METHODS)
    if comparison.solution.poses:
        angle = ", angle [degrees]" if comparison.solution.problem.motion.is_planar else ""
        sys.stdout.write(
            f"\ncertified poses (assembly modes): position [{robot.unit}]{angle}; "
            "starts of each method that ended there\n"
        )
        names = tuple(result.engine for result in comparison.results)
        rows = [_mode(mode, pose, comparison) for mode, pose in enumerate(comparison.solution.poses, 1)]
        third = "theta" if comparison.solution.problem.motion.is_planar else "z"
        headings = (index.heading for index in shown_in(Output.TABLE))
        print_rows(rows, ("", "x", "y", third, *headings, *names))
    for result in comparison.results:
        sys.stdout.write(_sentence(result, comparison))
    if not is_tracked(comparison.solution.problem):
        sys.stdout.write("path tracking: no paths lead to cylinders, nor to more constraints than freedoms\n")


def print_certified(robot: Machine, configuration: str | None, solution: Solution, starts: str = "") -> None:
    """Print what the methods are held against, to stdout."""
    actuators = locked_at(robot.kind, configuration)
    sys.stdout.write(f"{robot.name} ({robot.kind}), {actuators}{starts}\ncertified: {headline(solution)}\n")
    sys.stdout.write("".join(f"note: {note}\n" for note in answer_notes(robot, configuration, solution)))


def _method(result: EngineResult, comparison: NumericComparison) -> tuple[str, ...]:
    starts = result.starts
    errors = result.errors()
    counts = (
        starts,
        sum(pose.converged for pose in result.poses),
        len(result.hits),
        len(comparison.missed(result)),
        result.count(Landing.SPURIOUS),
        result.count(Landing.BETWEEN),
    )
    bounds = (_rounded(min(e.lo for e in errors), ROUND_FLOOR), _upper(errors)) if errors else ("-", "-")
    return result.engine, *map(str, counts), *bounds, f"{1000 * result.seconds / starts:.2f}"


def _mode(mode: int, pose: Pose, comparison: NumericComparison) -> tuple[str, ...]:
    number = f"{mode}" if pose.multiplicity == 1 else f"{mode} (x{pose.multiplicity or '?'})"
    x, y, z = pose.position
    third = _angle(pose) if comparison.solution.problem.motion.is_planar else z
    position = ("?" if value is None else f"{float(value) + 0.0:.6g}" for value in (x, y, third))
    hits = (str(result.hits.get(mode, 0)) for result in comparison.results)
    quality = (index.text(pose) for index in shown_in(Output.TABLE))
    return number, *position, *quality, *hits


def _angle(pose: Pose) -> Interval | None:
    bounds = planar_coordinates(pose)
    return angle_in_degrees(bounds["cos"], bounds["sin"])


def _sentence(result: EngineResult, comparison: NumericComparison) -> str:
    """What the tables do not say: why starts did not converge, and which poses were missed."""
    missed = comparison.missed(result)
    parts = []
    others = [f"{reason} {count}" for reason, count in result.endings.items() if reason != "converged"]
    if others:
        parts.append(f"not converged: {', '.join(others)}")
    if missed and result.starts > 1:
        more = ", ..." if len(missed) > _LISTED else ""
        parts.append(f"missed: {', '.join(map(str, missed[:_LISTED]))}{more}")
    return f"{result.engine}: {'; '.join(parts)}\n" if parts else ""


def _upper(errors: tuple[Interval, ...]) -> str:
    return _rounded(max(error.hi for error in errors), ROUND_CEILING)


def _rounded(value: Fraction, direction: str) -> str:
    """Two digits of a number, rounded in one direction.

    Examples
    --------
    >>> _rounded(Fraction(1, 3), ROUND_CEILING), _rounded(Fraction(1, 3), ROUND_FLOOR)
    ('3.4e-1', '3.3e-1')
    """
    return f"{Context(prec=2, rounding=direction).divide(Decimal(value.numerator), Decimal(value.denominator)):.1e}"
