"""The solutions of a system as a person or a program wants them: a headline and a table, or one JSON object."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any

from pkm_exact.cli.table import print_rows
from pkm_exact.roots.interval import decimal
from pkm_exact.systems.system_claims import meaning_of
from pkm_exact.wording import counted, printable

if TYPE_CHECKING:
    from pkm_exact.systems.system_solution import SystemSolution


def report_roots(name: str, solution: SystemSolution, layout: str, *, only_real: bool, verbose: bool) -> None:
    """Print the solutions to stdout as ``table`` or ``json``."""
    if layout == "json":
        sys.stdout.write(json.dumps(solution.to_dict(), indent=1) + "\n")
        return
    size, number = len(solution.variables), len(solution.system.polynomials)
    lines = [
        f"{printable(name)}: {counted(number, 'polynomial')} in {counted(size, 'variable')}",
        headline(solution, only_real=only_real),
    ]
    if verbose:
        lines += [f"{stage}: {seconds:.2f} s" for stage, seconds in solution.seconds.items()]
    lines += [f"note: {note}" for note in solution.notes]
    sys.stdout.write("\n".join(lines) + "\n")
    if solution.solutions:
        sys.stdout.write("\nright to one unit of the last digit\n")
        several = any(entry.multiplicity != 1 for entry in solution.solutions)
        header = ("", *solution.variables, *(("multiplicity",) if several else ()))
        print_rows([_row(k, entry, several=several) for k, entry in enumerate(solution.solutions, 1)], header)


def headline(solution: SystemSolution, *, only_real: bool) -> str:
    """One sentence that says how many solutions were found and what is claimed of them."""
    words = meaning_of(solution.claim)
    route = f" ({solution.completeness_route})" if solution.completeness_route else ""
    if solution.representation is None:
        return f"{words}{route}"
    real = counted(solution.real_solutions, "real solution")
    if only_real:
        return f"{real}; {words}{route}"
    distinct, total = solution.distinct_solutions, solution.complex_solutions
    if total is None:
        return f"{distinct} distinct complex solutions found, {real}; {words}"
    several = "" if distinct == total else f" ({distinct} distinct)"
    return f"{counted(total, 'complex solution')}{several}, {real}; {words}{route}"


def _row(number: int, entry: Any, *, several: bool) -> tuple[str, ...]:
    cells = (str(number), *map(decimal, entry.values))
    return (*cells, "?" if entry.multiplicity is None else str(entry.multiplicity)) if several else cells
