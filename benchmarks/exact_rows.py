"""Rows of a sweep by the exact engine beside solves of their own, in turn, in one process; processor time.

Lengths squared differ from those of the model by 0.4 percent at most. Each comes first every
other time. That certificates are the same is checked. Ratios are medians of those of each row, to a solve, and to one
that counts the poses by an elimination, which most solves of general robots do without.

With ``--sweeps``, elapsed time instead: of a row of the command ``certify-poses sweep`` with as many workers as there
are cores, its certificate and its line among it, by sweeps of few and of many rows; beside solves in one process, right
before and after. The last ratio is that of the whole command with many rows, the start of its processes among it.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from random import Random
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter, process_time
from typing import Any

from pkm_exact import read_robot
from pkm_exact.batch.row_solver import RowSolver
from pkm_exact.certify.build import certificate_bytes
from pkm_exact.engine import solve
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.policy import Policy
from pkm_exact.poses.boxes import DEFAULT_WIDTH

COMMAND = Path(sys.executable).parent / "certify-poses"
FEW, MANY = 20, 100
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")
MODELS = Path(__file__).parent.parent / "models"
GENERAL = ("rolland-6-6", "dietmaier", "mourrain-l", "hexa", "6-6p", "6-6pp")
ROBOTS = (*GENERAL, "hexaglide", "ssm-exact", "mssm", "tssm", "linuxcnc-hexapod")
SWEPT = tuple(name for name in ROBOTS if name != "hexa")  # the rows of a robot with cranks are their angles


def main() -> int:
    """Run, and print a Markdown table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("robots", nargs="*", help="names of models")
    parser.add_argument("--rows", type=int, default=11, help="rows of each, after one to warm up (default 11)")
    parser.add_argument("--sweeps", type=int, default=0, metavar="RUNS", help="so many sweeps of each, elapsed time")
    arguments = parser.parse_args()
    print(f"load {os.getloadavg()[0]:.1f}\n")
    if arguments.sweeps:
        _print_sweeps(arguments.robots or SWEPT, arguments.sweeps)
        return 0
    print("| robot | solve with an elimination, ms | solve, ms | row, ms | row / with an elimination | row / solve |")
    print("| --- | --- | --- | --- | --- | --- |")
    for name in arguments.robots or ROBOTS:
        measured = _measured(name, arguments.rows + 1)[1:]
        times = [f"{1000 * median(values):.0f}" for values in zip(*measured, strict=True)]
        ratios = [f"{median(taken[2] / taken[k] for taken in measured):.2f}" for k in (0, 1)]
        print(f"| {name} | {' | '.join([*times, *ratios])} |", flush=True)
    return 0


def _print_sweeps(names: Sequence[str], runs: int) -> None:
    print(f"| robot | solve, ms | row of a sweep, {os.cpu_count()} workers, ms | row / solve | whole sweep / solves |")
    print("| --- | --- | --- | --- | --- |")
    for name in names:
        measured = [_swept(name, Random(run)) for run in range(runs)]
        solved, row = (1000 * median(taken[k] for taken in measured) for k in (0, 1))
        ratios = [f"{median(taken[k] / taken[0] for taken in measured):.2f}" for k in (1, 2)]
        print(f"| {name} | {solved:.0f} | {row:.0f} | {' | '.join(ratios)} |", flush=True)


def _swept(name: str, random: Random) -> tuple[float, float, float]:
    """Elapsed seconds of a solve, of one more row of a sweep, and of a sweep of many rows for each."""
    base = _problem(name)
    solve(_neighbour(base, random))
    before = _elapsed(lambda: [solve(_neighbour(base, random)) for _ in range(FEW // 2)])
    few, many = (_elapsed(partial(_sweep, name, [_neighbour(base, random) for _ in range(n)])) for n in (FEW, MANY))
    after = _elapsed(lambda: [solve(_neighbour(base, random)) for _ in range(FEW // 2)])
    return (before + after) / FEW, (many - few) / (MANY - FEW), many / MANY


def _sweep(name: str, problems: list[ForwardProblem]) -> None:
    """The command, with as many workers as there are cores."""
    rows = [",".join(str(leg.length_squared) for leg in problem.distances) for problem in problems]
    with TemporaryDirectory() as folder:
        lengths, out = Path(folder, "lengths.csv"), Path(folder, "poses.jsonl")
        lengths.write_text("\n".join(rows) + "\n", encoding="utf-8")
        words = ["sweep", MODELS / f"{name}.toml", lengths, "-o", out, "--squared", "--method", "exact"]
        subprocess.run([COMMAND, *map(str, words)], check=True, capture_output=True)
        if len(out.read_text(encoding="utf-8").splitlines()) != len(rows):
            raise SystemExit(f"{name}: a sweep has not a line for each row")


def _elapsed(action: Callable[[], object]) -> float:
    begun = perf_counter()
    action()
    return perf_counter() - begun


def _problem(name: str) -> ForwardProblem:
    robot = read_robot(MODELS / f"{name}.toml")
    return robot.problem(robot.configuration())


def _neighbour(base: ForwardProblem, random: Random) -> ForwardProblem:
    """The problem with squared lengths that differ by 0.4 percent at most."""
    legs: list[Any] = [
        replace(leg, length_squared=leg.length_squared * (1 + Fraction(random.randint(-20, 20), 5000)))
        for leg in base.distances
    ]
    return replace(base, constraints=tuple(legs))


def _measured(name: str, count: int) -> list[tuple[float, ...]]:
    """Processor seconds of a solve with an elimination, of a solve, and of a row."""
    robot, base, random = read_robot(MODELS / f"{name}.toml"), _problem(name), Random(5)
    rows = RowSolver.of([base], DEFAULT_WIDTH, Policy(), "exact")
    ways = partial(solve, policy=Policy(eliminate=True)), solve, rows.solution
    found = []
    for number in range(count):
        neighbour = _neighbour(base, random)
        taken, answers = {}, {}
        for solver in ways[:: 1 if number % 2 else -1]:
            problem = replace(neighbour)  # one that was solved knows its equations
            begun = process_time()
            answers[solver] = solver(problem)
            taken[solver] = process_time() - begun
        found.append(tuple(taken[way] for way in ways))
        if len({certificate_bytes(robot, None, answers[way]) for way in ways}) > 1:
            raise SystemExit(f"{name}: a row has another certificate than a solve")
    return found


if __name__ == "__main__":
    if os.environ.get("OMP_NUM_THREADS") != "1":  # threads of linear algebra wait in a circle: that counts as work
        os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | dict.fromkeys(THREADS, "1"))
    sys.exit(main())
