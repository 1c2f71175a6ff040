"""Rows of a sweep by the exact engine beside solves of their own, in turn, in one process; processor time.

Lengths squared differ from those of the model by 0.4 percent at most. Each comes first every
other time. That certificates are the same is checked. Ratios are medians of those of each row, to a solve, and to one
that counts the poses by an elimination, which most solves of general robots do without.
"""

from __future__ import annotations

import argparse
import os
import sys
from dataclasses import replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from random import Random
from statistics import median
from time import process_time
from typing import Any

from pkm_exact import read_robot
from pkm_exact.batch.row_solver import RowSolver
from pkm_exact.certify.build import certificate_bytes
from pkm_exact.engine import solve
from pkm_exact.policy import Policy
from pkm_exact.poses.boxes import DEFAULT_WIDTH

THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")
MODELS = Path(__file__).parent.parent / "models"
GENERAL = ("rolland-6-6", "dietmaier", "mourrain-l", "hexa", "6-6p", "6-6pp")
ROBOTS = (*GENERAL, "hexaglide", "ssm-exact", "mssm", "tssm", "linuxcnc-hexapod")


def main() -> int:
    """Run, and print a Markdown table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("robots", nargs="*", default=ROBOTS, help="names of models")
    parser.add_argument("--rows", type=int, default=11, help="rows of each, after one to warm up (default 11)")
    arguments = parser.parse_args()
    print(f"load {os.getloadavg()[0]:.1f}\n")
    print("| robot | solve with an elimination, ms | solve, ms | row, ms | row / with an elimination | row / solve |")
    print("| --- | --- | --- | --- | --- | --- |")
    for name in arguments.robots:
        measured = _measured(name, arguments.rows + 1)[1:]
        times = [f"{1000 * median(values):.0f}" for values in zip(*measured, strict=True)]
        ratios = [f"{median(taken[2] / taken[k] for taken in measured):.2f}" for k in (0, 1)]
        print(f"| {name} | {' | '.join([*times, *ratios])} |", flush=True)
    return 0


def _measured(name: str, count: int) -> list[tuple[float, ...]]:
    """Processor seconds of a solve with an elimination, of a solve, and of a row."""
    robot, random = read_robot(MODELS / f"{name}.toml"), Random(5)
    base = robot.problem(robot.configuration())
    rows = RowSolver.of([base], DEFAULT_WIDTH, Policy(), "exact")
    ways = partial(solve, policy=Policy(eliminate=True)), solve, rows.solution
    found = []
    for number in range(count):
        legs: list[Any] = [
            replace(leg, length_squared=leg.length_squared * (1 + Fraction(random.randint(-20, 20), 5000)))
            for leg in base.distances
        ]
        taken, answers = {}, {}
        for solver in ways[:: 1 if number % 2 else -1]:
            problem = replace(base, constraints=tuple(legs))
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
