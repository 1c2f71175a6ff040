"""Rows of a sweep by the exact engine beside solves of their own, in turn, in one process; processor time.

Lengths squared differ from those of the model by 0.4 percent at most. Each comes first every
other time. That certificates are the same is checked. The ratio is the median of those of each row.
"""

from __future__ import annotations

import argparse
import os
import sys
from dataclasses import replace
from fractions import Fraction
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
    print("| robot | solve, ms | row, ms | ratio |\n| --- | --- | --- | --- |")
    for name in arguments.robots:
        own, rows = zip(*_measured(name, arguments.rows + 1), strict=True)
        times = [1000 * median(values[1:]) for values in (own, rows)]
        ratio = median(b / a for a, b in list(zip(own, rows, strict=True))[1:])
        print(f"| {name} | {times[0]:.0f} | {times[1]:.0f} | {ratio:.2f} |", flush=True)
    return 0


def _measured(name: str, count: int) -> list[tuple[float, float]]:
    """Processor seconds of a solve and of a row."""
    robot, random = read_robot(MODELS / f"{name}.toml"), Random(5)
    base = robot.problem(robot.configuration())
    rows = RowSolver.of([base], DEFAULT_WIDTH, Policy(), "exact")
    found = []
    for number in range(count):
        legs: list[Any] = [
            replace(leg, length_squared=leg.length_squared * (1 + Fraction(random.randint(-20, 20), 5000)))
            for leg in base.distances
        ]
        taken, answers = {}, {}
        for solver in (solve, rows.solution)[:: 1 if number % 2 else -1]:
            problem = replace(base, constraints=tuple(legs))
            begun = process_time()
            answers[solver] = solver(problem)
            taken[solver] = process_time() - begun
        found.append((taken[solve], taken[rows.solution]))
        if certificate_bytes(robot, None, answers[rows.solution]) != certificate_bytes(robot, None, answers[solve]):
            raise SystemExit(f"{name}: a row has another certificate than a solve")
    return found


if __name__ == "__main__":
    if os.environ.get("OMP_NUM_THREADS") != "1":  # threads of linear algebra wait in a circle: that counts as work
        os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | dict.fromkeys(THREADS, "1"))
    sys.exit(main())
