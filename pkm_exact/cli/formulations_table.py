"""The comparison of the formulations as tables: the systems, their solutions, the time."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Sequence

from rich.console import Console
from rich.table import Table

from pkm_exact.claim import Claim
from pkm_exact.comparison.row import Row
from pkm_exact.wording import printable

_SYSTEM = ("", "unknowns", "equations", "degrees", "terms", "bytes", "digits")
_SOLUTIONS = ("", "basis", "primes", "RUR bytes", "RUR bits", "complex", "real", "real poses", "agrees")


def print_tables(title: str, rows: Sequence[Row]) -> None:
    """Print the tables and, below them, a sentence for every row that needs one, to stdout."""
    console = Console(file=sys.stdout, highlight=False, markup=False)
    sys.stdout.write(f"{title}\n")
    _print(console, "systems: total degrees with how many equations have them, length of the text, largest coefficient")
    _print_table(console, _SYSTEM, [_system_cells(row) for row in rows])
    _print(
        console, "solutions: of the Groebner basis and of the representation of the poses; complex with multiplicity"
    )
    _print_table(console, _SOLUTIONS, [_result_cells(row) for row in rows])
    stages = list(dict.fromkeys(stage for row in rows if row.result for stage in row.result.stages))
    _print(console, "seconds: in all, of the processor alone, and at each stage")
    _print_table(console, ("", "all", "processor", *stages), [_time_cells(row, stages) for row in rows])
    for row in rows:
        notes = row.result.notes if row.result else ()
        for sentence in (*([row.reason] if row.reason else []), *notes):
            sys.stdout.write(f"{row.code}: {printable(sentence)}\n")


def _print(console: Console, caption: str) -> None:
    console.file.write(f"\n{caption}\n")


def _print_table(console: Console, header: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    table = Table(box=None, pad_edge=False, header_style="bold")
    for name in header:
        table.add_column(name, justify="right" if name else "left", no_wrap=True)
    for row in rows:
        table.add_row(*row)
    widths = [max(len(line[i]) for line in (header, *rows)) + 2 for i in range(len(header))]
    console.width = max(console.width, sum(widths))
    console.print(table)


def degrees_text(degrees: Sequence[int]) -> str:
    """Degrees, the largest first, and how often each occurs.

    Examples
    --------
    >>> degrees_text([2, 4, 4, 2, 2])
    '4 (2), 2 (3)'
    """
    return ", ".join(f"{degree} ({count})" for degree, count in sorted(Counter(degrees).items(), reverse=True))


def _system_cells(row: Row) -> tuple[str, ...]:
    system = row.system
    if system is None:
        return row.code, *("-" for _ in _SYSTEM[1:])
    numbers = (system.unknowns, system.equations, degrees_text(system.degrees))
    return row.code, *map(str, (*numbers, system.terms, system.bytes, system.coefficient_digits))


def _result_cells(row: Row) -> tuple[str, ...]:
    result = row.result
    if result is None:
        return row.code, *("-" for _ in _SOLUTIONS[1:-1]), row.status.value
    numbers = (result.basis_elements, result.primes, result.rur_bytes, result.rur_bits)
    infinite = "infinite" if result.claim is Claim.POSITIVE_DIMENSIONAL_PROVED else "infinite?"
    counts = (
        infinite if result.complex_solutions is None else str(result.complex_solutions),
        *("-" if count is None else str(count) for count in (result.real_solutions, result.real_poses)),
    )
    agrees = {True: "yes", False: "NO", None: "?"}[row.agrees]
    return row.code, *("-" if x is None else str(x) for x in numbers), *counts, agrees


def _time_cells(row: Row, stages: Sequence[str]) -> tuple[str, ...]:
    result = row.result
    if result is None:
        return row.code, *("-" for _ in range(len(stages) + 2))
    times = [result.seconds, result.processor_seconds, *(result.stages.get(stage, 0.0) for stage in stages)]
    return row.code, *(f"{time:.2f}" for time in times)
