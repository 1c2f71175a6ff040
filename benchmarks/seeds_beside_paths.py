"""The numeric engine with an elimination template for its first guesses, and along paths: in turn, in one process.

Both certify everything; only what proposes the solutions differs. Processor time, which a loaded machine changes
little; threads of numpy's linear algebra are one.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from statistics import median
from time import process_time
from unittest.mock import patch

MODELS = Path(__file__).parent.parent / "models"
ROBOTS = (
    *("rolland-6-6", "dietmaier", "mourrain-l", "6-6p", "6-6pp", "hexa", "linapod-n"),
    *("hexaglide", "ssm-exact", "mssm", "tssm", "linuxcnc-hexapod", "rcid", "3-rps"),
)


def main() -> int:
    """Run, and print a Markdown table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=11, help="runs of each, after one to warm up (default 11)")
    arguments = parser.parse_args()
    for library in ("OPENBLAS", "MKL", "OMP"):
        os.environ[f"{library}_NUM_THREADS"] = "1"
    print("| robot | template, ms | paths, ms | ratio |\n| --- | --- | --- | --- |")
    for name in ROBOTS:
        times = _measured(name, arguments.runs)
        cells = [f"{1000 * median(values):.1f}" for values in times]
        print(f"| {name} | {' | '.join(cells)} | {median(times[0]) / median(times[1]):.2f} |", flush=True)
    return 0


def _measured(name: str, runs: int) -> tuple[list[float], list[float]]:
    """Processor seconds with the template, and along paths."""
    # Numpy reads the number of threads when it is loaded.
    from pkm_exact import read_robot
    from pkm_exact.numeric.seeds import has_seeds
    from pkm_exact.numeric_engine import solve_krawczyk

    robot = read_robot(MODELS / f"{name}.toml")
    problem = robot.problem(robot.configuration())
    times: tuple[list[float], list[float]] = ([], [])
    for number in range(runs + 1):
        for chosen, values in zip((has_seeds, lambda _: False), times, strict=True):
            with patch("pkm_exact.numeric_engine.has_seeds", chosen):
                begun = process_time()
                solution = solve_krawczyk(problem)
                taken = process_time() - begun
            if solution.method != "krawczyk":
                raise SystemExit(f"{name}: the numeric engine did not answer: {solution.notes}")
            if number:
                values.append(taken)
    return times


if __name__ == "__main__":
    sys.exit(main())
