"""The certified numeric engine beside fkSGP, an uncertified solver of the 6-6 by elimination templates, in one process.

fkSGP (https://github.com/martyushev/fkSGP, MIT) is not part of this: say where a copy of it is. Both solve the same
robots in turn, one thread each. Times are of the processor, which a loaded machine changes less than those of the
clock. Of fkSGP's solutions those are counted whose error it gives as below 1e-6.

    OPENBLAS_NUM_THREADS=1 python benchmarks/beside_template.py FOLDER
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from statistics import median
from time import process_time
from types import ModuleType
from typing import Any

import numpy as np
from agreement import random_robot

from pkm_exact import read_robot
from pkm_exact.constraints.distance import _form_of_joints
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import _pose_quadrics
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.poses.jacobian import _spread

MODELS = Path(__file__).parent.parent / "models"
ROBOTS = ("rolland-6-6", "dietmaier", "mourrain-l")
GOOD = 1e-6


def main() -> int:
    """Run, and print a Markdown table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("fksgp", type=Path, help="folder of fkSGP, with the folder python in it")
    parser.add_argument("--runs", type=int, default=11, help="runs of each, after one to warm up (default 11)")
    parser.add_argument("--random", type=int, default=50, help="so many random robots (default 50)")
    arguments = parser.parse_args()
    if os.environ.get("OPENBLAS_NUM_THREADS") != "1":
        parser.error("set OPENBLAS_NUM_THREADS=1: one thread each")
    solver66 = _fksgp(arguments.fksgp)
    print(f"load {os.getloadavg()[0]:.1f}\n")
    print(
        "| robot | ours, ms | fkSGP, ms | ratio | certified | found by fkSGP |\n| --- | --- | --- | --- | --- | --- |"
    )
    for name in ROBOTS:
        robot = read_robot(MODELS / f"{name}.toml")
        problem = robot.problem(robot.configuration())
        runs = [_both(problem, solver66) for _ in range(arguments.runs + 1)][1:]
        _show(name, runs)
    _show(
        f"{arguments.random} random robots", [_both(random_robot(k).problem, solver66) for k in range(arguments.random)]
    )
    return 0


def _fksgp(folder: Path) -> Callable[..., Any]:
    """Its solver; the rest of the package is not loaded."""
    package = ModuleType("fksgp")
    package.__path__ = [str(folder / "python")]
    sys.modules["fksgp"] = package
    solver: Callable[..., Any] = import_module("fksgp.solver66").solver66
    return solver


def _both(problem: ForwardProblem, solver: Callable[..., Any]) -> tuple[float, float, int, int]:
    """Processor seconds, and numbers of solutions, of both."""
    # Nothing is known of the robot from an earlier run.
    problem = ForwardProblem(problem.constraints, problem.metric, problem.motion)
    for known in (_pose_quadrics, _form_of_joints, _spread):
        known.cache_clear()
    scales = np.sqrt(np.array(problem.metric, dtype=float))
    base, platform = (
        np.array([[float(value) for value in getattr(leg, side)] for leg in problem.distances]) * scales
        for side in ("base", "platform")
    )
    squares = np.array([float(leg.length_squared) for leg in problem.distances])
    begun = process_time()
    solution = solve_krawczyk(problem)
    between = process_time()
    errors = solver(base - base[0], platform - platform[0], squares, 0)[1]
    ended = process_time()
    if solution.method != "krawczyk":
        print("answered by the exact engine:", solution, file=sys.stderr)
    return between - begun, ended - between, solution.complex_solutions, int(np.count_nonzero(errors < GOOD))


def _show(name: str, runs: list[tuple[float, float, int, int]]) -> None:
    ours, theirs, certified, found = zip(*runs, strict=True)
    times = [f"{1000 * median(t):.1f} ({1000 * min(t):.1f} to {1000 * max(t):.1f})" for t in (ours, theirs)]
    counts = [f"{min(values)} to {max(values)}" for values in (certified, found)]
    print(f"| {name} | {' | '.join(times)} | {median(ours) / median(theirs):.2f} | {' | '.join(counts)} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
