"""Rows of a sweep beside solves of their own, by the numeric engine: in turn, in one process.

Rows share what is found once for all of them (``batch.row_solver``), and go through arrays together, of whose time each
has an equal share; that their boxes are those of solves of their own is checked. What a sweep makes of a row beside its
solution, its certificate with the digest and its line, is the third time. Lengths differ from those of the model by 0.4
percent at most. Processor time, which a loaded machine changes little; threads of numpy's linear algebra are one.
"""

from __future__ import annotations

import argparse
import os
import sys
from fractions import Fraction
from functools import partial
from pathlib import Path
from random import Random
from statistics import median
from time import process_time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pkm_exact.geometry.problem import ForwardProblem

MODELS = Path(__file__).parent.parent / "models"
ROBOTS = ("rolland-6-6", "dietmaier", "mourrain-l", "6-6p", "6-6pp", "3-rpr-merlet-p")
REACH = Fraction(4, 1000)


def main() -> int:
    """Run, and print a Markdown table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rows", type=int, default=64, help="rows (default 64)")
    arguments = parser.parse_args()
    for library in ("OPENBLAS", "MKL", "OMP"):
        os.environ[f"{library}_NUM_THREADS"] = "1"
    print(f"load {os.getloadavg()[0]:.1f}\n")
    print("| robot | solve of its own, ms | row, ms | ratio | with certificate and line, ms | ratio |")
    print("| --- | --- | --- | --- | --- | --- |")
    for name in ROBOTS:
        own, rows, rest = _measured(name, arguments.rows)
        whole = [a + b for a, b in zip(rows, rest, strict=True)]
        cells = [f"{1000 * median(t):.1f} ({1000 * min(t):.1f} to {1000 * max(t):.1f})" for t in (own, rows, whole)]
        ratios = [f"{median(t) / median(own):.2f}" for t in (rows, whole)]
        print(f"| {name} | {cells[0]} | {cells[1]} | {ratios[0]} | {cells[2]} | {ratios[1]} |", flush=True)
    return 0


def _measured(name: str, count: int) -> tuple[list[float], list[float], list[float]]:
    """Processor seconds of solves of their own, of rows, and of their certificates and lines."""
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
    times: tuple[list[float], list[float], list[float]] = ([], [], [])

    def fresh(problem: ForwardProblem) -> ForwardProblem:
        return type(problem)(problem.constraints, problem.metric, problem.motion)

    solve_krawczyk(problems[0])
    for first in range(0, count, TOGETHER):
        rows = [fresh(problem) for problem in problems[first : first + TOGETHER]]
        begun = process_time()
        near = solver.near(rows)
        shared = (process_time() - begun) / len(rows)
        for number, (problem, known) in enumerate(zip(rows, near, strict=True), first):
            found = []
            for solve, values, before in (
                (solve_krawczyk, times[0], 0.0),
                (partial(solver.solution, near=known), times[1], shared),
            ):
                asked = problem if before else fresh(problem)
                begun = process_time()
                found.append(solve(asked))
                values.append(process_time() - begun + before)
            if found[0].poses != found[1].poses or found[0].isolated != found[1].isolated:
                raise SystemExit(f"{name}, row {number}: the boxes are not those of a solve of its own")
            begun = process_time()
            content = certificate_bytes(robot, None, found[1])
            solution_line(LengthRow(number, number, ()), robot, None, found[1], content, None)
            times[2].append(process_time() - begun)
    return times


def _problems(name: str, count: int) -> list[ForwardProblem]:
    """The robot at so many lengths near those of its model."""
    from pkm_exact import read_robot

    robot, random = read_robot(MODELS / f"{name}.toml"), Random(1)
    squares = [leg.length_squared for leg in robot.problem(robot.configuration()).distances]
    factors = [[1 + REACH * random.randint(-1000, 1000) / 1000 for _ in squares] for _ in range(count)]
    return [robot.problem([s * f * f for s, f in zip(squares, row, strict=True)]) for row in factors]


if __name__ == "__main__":
    sys.exit(main())
