"""Rows of a sweep beside solves of their own, by the numeric engine: in turn, in one process.

Rows share what is found once for all of them (``batch.row_solver``), and go through arrays together, of whose time each
has an equal share; that their boxes are those of solves of their own is checked. What a sweep makes of a row beside its
solution, its certificate with the digest and its line, is the third time. Lengths differ from those of the model by 0.4
percent at most. Processor time; threads of numpy's linear algebra are one. Ratios are medians of those of rows that go
together, beside solves of their own right before or after: a machine's clock changes from one second to the next.
"""

from __future__ import annotations

import argparse
import os
import sys
from fractions import Fraction
from pathlib import Path
from random import Random
from statistics import median
from time import process_time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.solution import Solution

MODELS = Path(__file__).parent.parent / "models"
ROBOTS = ("rolland-6-6", "dietmaier", "mourrain-l", "6-6p", "6-6pp", "3-rpr-merlet-p")
REACH = Fraction(4, 1000)


def main() -> int:
    """Run, and print a Markdown table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rows", type=int, default=64, help="rows (default 64)")
    parser.add_argument("--runs", type=int, default=8, help="times that all rows are solved (default 8)")
    arguments = parser.parse_args()
    for library in ("OPENBLAS", "MKL", "OMP"):
        os.environ[f"{library}_NUM_THREADS"] = "1"
    print(f"load {os.getloadavg()[0]:.1f}\n")
    print("| robot | solve of its own, ms | row, ms | ratio | with certificate and line, ms | ratio |")
    print("| --- | --- | --- | --- | --- | --- |")
    for name in ROBOTS:
        measured = _measured(name, arguments.rows, arguments.runs)
        own, rows, whole = zip(*measured, strict=True)
        cells = [f"{1000 * median(t):.1f} ({1000 * min(t):.1f} to {1000 * max(t):.1f})" for t in (own, rows, whole)]
        ratios = [f"{median(taken[k] / taken[0] for taken in measured):.2f}" for k in (1, 2)]
        print(f"| {name} | {cells[0]} | {cells[1]} | {ratios[0]} | {cells[2]} | {ratios[1]} |", flush=True)
    return 0


def _measured(name: str, count: int, runs: int) -> list[tuple[float, float, float]]:
    """Processor seconds of a solve of its own, a row, and one with certificate and line, each time of rows together."""
    # Numpy reads the number of threads when it is loaded.
    from pkm_exact import read_robot
    from pkm_exact.batch.row_solver import TOGETHER, RowSolver
    from pkm_exact.certify.build import certificate_bytes
    from pkm_exact.numeric_engine import solve_krawczyk
    from pkm_exact.policy import Policy
    from pkm_exact.poses.boxes import DEFAULT_WIDTH
    from pkm_exact.sweep.lengths import LengthRow
    from pkm_exact.sweep.record import solution_line

    robot = read_robot(MODELS / f"{name}.toml")
    problems = _problems(name, count)
    solver = RowSolver.of(problems, DEFAULT_WIDTH, Policy())

    def alone(rows: list[ForwardProblem]) -> None:
        for problem in rows:
            solve_krawczyk(problem)

    def together(rows: list[ForwardProblem]) -> list[Solution]:
        return [solver.solution(problem, near=known) for problem, known in zip(rows, solver.near(rows), strict=True)]

    batches = [problems[first : first + TOGETHER] for first in range(0, count, TOGETHER)]
    for problem, row in ((one, other) for batch in batches for one, other in zip(batch, together(batch), strict=True)):
        own = solve_krawczyk(problem)
        if own.poses != row.poses or own.isolated != row.isolated:
            raise SystemExit(f"{name}: the boxes of a row are not those of a solve of its own")
    measured = []
    for number, batch in enumerate(batches * runs):
        taken, found = {}, None
        for solve in (alone, together)[:: 1 if number % 2 else -1]:
            fresh = [type(problem)(problem.constraints, problem.metric, problem.motion) for problem in batch]
            begun = process_time()
            found = solve(fresh) or found
            taken[solve] = (process_time() - begun) / len(batch)
        begun = process_time()
        for place, solution in enumerate(found or []):
            content = certificate_bytes(robot, None, solution)
            solution_line(LengthRow(place, place, ()), robot, None, solution, content, None)
        rest = (process_time() - begun) / len(batch)
        measured.append((taken[alone], taken[together], taken[together] + rest))
    return measured


def _problems(name: str, count: int) -> list[ForwardProblem]:
    """The robot at so many lengths near those of its model."""
    from pkm_exact import read_robot

    robot, random = read_robot(MODELS / f"{name}.toml"), Random(1)
    squares = [leg.length_squared for leg in robot.problem(robot.configuration()).distances]
    factors = [[1 + REACH * random.randint(-1000, 1000) / 1000 for _ in squares] for _ in range(count)]
    return [robot.problem([s * f * f for s, f in zip(squares, row, strict=True)]) for row in factors]


if __name__ == "__main__":
    sys.exit(main())
