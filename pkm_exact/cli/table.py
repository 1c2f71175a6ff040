"""Poses as a table of decimals, with as many digits as the boxes guarantee."""

from __future__ import annotations

import sys
from decimal import Decimal
from typing import TYPE_CHECKING

from pkm_exact.cli.modes import assembly_modes, summary
from pkm_exact.geometry.machine import Machine, locked_at
from pkm_exact.interactive.answer_notes import answer_notes
from pkm_exact.interactive.display import pose_cells, pose_header
from pkm_exact.roots.interval import decimal as decimal

if TYPE_CHECKING:
    from pkm_exact.cli.feasible_poses import ShownPoses
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.solution import Solution


def print_table(
    robot: Machine,
    configuration: str | None,
    solution: Solution,
    headline: str,
    shown: ShownPoses,
    *,
    verbose: bool,
) -> None:
    """Print robot, headline, poses and notes to stdout."""
    actuators = locked_at(robot.kind, configuration)
    lines = [f"{robot.name} ({robot.kind}), {actuators}, formulation {solution.formulation}", headline]
    if verbose:
        lines += list(_details(robot, solution))
    lines += [f"note: {note}" for note in (*answer_notes(robot, configuration, solution), *shown.notes)]
    sys.stdout.write("\n".join(lines) + "\n")
    if not shown.poses:
        return
    planar = solution.problem.motion.is_planar
    rows = [
        (shown.label(place), *pose_cells(0, pose, solution.problem.motion)[1:], *shown.cells(place))
        for place, pose in enumerate(shown.poses)
    ]
    rotation = "angle [degrees]" if planar else "unit quaternion (scalar first)"
    # A redundant mechanism has no determinant: its Jacobian has more rows than columns.
    has_signs = solution.problem.equation_count == solution.problem.motion.dimension
    modes = summary(assembly_modes(shown.poses), shown.numbers)
    sys.stdout.write(f"\nassembly modes: {modes}\n" if has_signs else "\n")
    sys.stdout.write(f"position [{robot.unit}], {rotation}, right to one unit of the last digit\n")
    print_rows(rows, (*pose_header(solution.problem.motion), *shown.headings))


def _details(robot: Machine, solution: Solution) -> list[str]:
    widths = [c.width for pose in solution.poses for c in (*pose.position, *pose.quaternion)]
    details = [
        f"source: {robot.source}",
        locked_values(solution.problem),
        f"method: {solution.method}; claim: {solution.claim}; route: {solution.completeness_route or 'none'}",
    ]
    if widths:
        widest = max(widths)
        details.append(f"widest box: {Decimal(widest.numerator) / Decimal(widest.denominator):.2e}")
    facts = solution.statistics
    if facts.primes:
        details.append(
            f"Groebner basis: {facts.basis_size} elements, quotient of dimension {facts.quotient_dimension}; "
            f"primes: {len(facts.primes)}, unlucky: {len(facts.unlucky_primes)}; choices made again: {facts.retries}"
        )
    elif solution.method == "exact" and solution.representation is not None:
        details.append("Groebner basis: none, as the number of verified solutions proves that there are no others")
    return details


def locked_values(problem: ForwardProblem) -> str:
    """The squared leg lengths, or what the constraints of a mechanism are locked at."""
    if problem.has_only_distances:
        return f"squared leg lengths: {', '.join(str(leg.length_squared) for leg in problem.distances)}"
    values = (
        f"{constraint.name}: {getattr(constraint, constraint.value_field)}"
        for constraint in problem.constraints
        if constraint.value_field is not None
    )
    return f"values of the constraints, lengths squared: {', '.join(values)}"


def print_rows(rows: list[tuple[str, ...]], header: tuple[str, ...]) -> None:
    """Print the rows under the header to stdout, in colours on a terminal."""
    if sys.stdout.isatty():
        _print_rich(rows, header)
    else:
        sys.stdout.write(plain(rows, header))


def plain(rows: list[tuple[str, ...]], header: tuple[str, ...]) -> str:
    """The rows under the header, right-aligned.

    >>> print(plain([("1", "0.5", "-12")], ("", "x", "y")), end="")
         x    y
    1  0.5  -12
    """
    table = [header, *rows]
    widths = [max(len(row[i]) for row in table) for i in range(len(header))]
    lines = ("  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)) for row in table)
    return "".join(f"{line.rstrip()}\n" for line in lines)


def _print_rich(rows: list[tuple[str, ...]], header: tuple[str, ...]) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(box=None, pad_edge=False, header_style="bold")
    for name in header:
        table.add_column(name, justify="right", no_wrap=True, style="dim" if not name else None)
    for row in rows:
        table.add_row(*row)
    needed = max(len(line) for line in plain(rows, header).splitlines())
    console = Console(file=sys.stdout, highlight=False)
    console.width = max(console.width, needed)
    console.print(table)
