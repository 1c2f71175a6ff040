"""Public polynomial systems: certify-roots and msolve, as whole processes, in turn, so that both meet the same load.

Both read the same file, on one thread. msolve writes its real solutions and the parametrisation, unproved;
certify-roots its answer and a certificate, with the internal engine and with msolve as its oracle. Times are processor
time, medians; the checker's is that of ``certify-roots check``. The start of Python is part of what is compared.
"""

from __future__ import annotations

import argparse
import json
import sys
import tomllib
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

from measure import run

from pkm_exact.backends.msolve_program import find_msolve, msolve_command

FOLDER = Path(__file__).parent.parent / "tests" / "systems"
CERTIFY = [sys.executable, "-c", "import sys; from pkm_exact.cli.main import roots_main; sys.exit(roots_main())"]
METHODS = ("msolve", "internal", "oracle", "check")

QUICK = (
    "caprasse",
    "cassou",
    "chandra-5",
    "cyclic-5",
    "eco-7",
    "game4two",
    "katsura-5",
    "katsura-6",
    "kinema",
    "kss-5",
    "noon-3",
    "puma",
    "redeco-8",
    "reimer-4",
    "s9_1",
    "sendra",
    "tangents0",
    "trinks",
    "utbikker",
    "wright",
)
"""At most a second or two each."""


@dataclass(frozen=True)
class Row:
    """A system: sizes, what is claimed, and medians of processor seconds; None where a program did not end in time."""

    name: str
    unknowns: int
    degree: int | None
    claim: str
    route: str
    bytes: int
    seconds: dict[str, float | None]


def main() -> int:
    """Run, and print a Markdown table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*", help="systems (default: those that take seconds)")
    parser.add_argument("--runs", type=int, default=3, help="runs of each (default 3)")
    parser.add_argument("--limit", type=float, default=120, help="seconds for one run (default 120)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the times to FILE as well")
    arguments = parser.parse_args()
    if find_msolve() is None:
        print("msolve is not installed: nothing to compare with", file=sys.stderr)
        return 0
    about = tomllib.loads((FOLDER / "systems.toml").read_text(encoding="utf-8"))
    unknown = [name for name in arguments.names if name not in about]
    if unknown:
        print(f"no system {unknown[0]} in {FOLDER}", file=sys.stderr)
        return 2
    print(HEADING)
    rows = []
    for name in arguments.names or QUICK:
        rows.append(measured(name, about[name].get("degree"), arguments.runs, arguments.limit))
        print(line_of(rows[-1]), flush=True)
    if arguments.json is not None:
        arguments.json.parent.mkdir(parents=True, exist_ok=True)
        arguments.json.write_text(json.dumps([asdict(row) for row in rows], indent=1) + "\n", encoding="utf-8")
    return 0


def measured(name: str, degree: int | None, runs: int, limit: float) -> Row:
    """The medians for a system."""
    source = FOLDER / f"{name}.ms"
    program = find_msolve()
    assert program is not None
    times: dict[str, list[float]] = {method: [] for method in METHODS}
    found = {"claim": "-", "completeness_route": "-"}
    size = 0
    with TemporaryDirectory() as text:
        folder = Path(text)
        certificate = folder / "c.json"
        solve = [*CERTIFY, "solve", str(source), "-o", str(certificate), "--format", "json"]
        commands: dict[str, Sequence[str]] = {
            "msolve": msolve_command(program, source, folder / "out"),
            "internal": solve,
            "oracle": [*solve, "--oracle", "msolve"],
            "check": [*CERTIFY, "check", str(certificate)],
        }
        for _ in range(runs):
            for method, command in commands.items():
                if method == "check" and not certificate.is_file():
                    continue
                done = run(command, limit, folder, family=True)
                if done.code in (0, 3):
                    times[method].append(done.processor)
                if method == "internal" and done.code in (0, 3):
                    found = json.loads(done.output)
                    size = certificate.stat().st_size
    names = source.read_text(encoding="ascii").split("\n", 1)[0]
    seconds = {method: median(values) if len(values) == runs else None for method, values in times.items()}
    route = str(found["completeness_route"] or "-")
    return Row(name, names.count(",") + 1, degree, str(found["claim"]), route, size, seconds)


HEADING = (
    "| system | unknowns | solutions | claim | route | msolve, s | certify-roots, s | ratio | "
    "with msolve as oracle, s | ratio | check, s | certificate, kB |\n|---|---|---|---|---|---|---|---|---|---|---|---|"
)


def line_of(row: Row) -> str:
    """A row of the table."""
    theirs, ours, oracle, check = (row.seconds[method] for method in METHODS)

    def shown(value: float | None) -> str:
        return "-" if value is None else f"{value:.2f}"

    def ratio(value: float | None) -> str:
        return "-" if value is None or theirs is None else f"{value / max(theirs, 0.001):.2g}"

    cells = (
        row.name,
        str(row.unknowns),
        "infinitely many" if row.degree is None else str(row.degree),
        row.claim,
        row.route,
        shown(theirs),
        shown(ours),
        ratio(ours),
        shown(oracle),
        ratio(oracle),
        shown(check),
        str(round(row.bytes / 1000)),
    )
    return f"| {' | '.join(cells)} |"


if __name__ == "__main__":
    sys.exit(main())
