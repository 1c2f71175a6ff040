"""Both checkers on the certificate of every shipped robot, beside the exact engine's solve of it, in one process.

Processor time, in turn: medians, and of the plain checker one run; the load is said first. The engine may know of a
robot what an earlier run has found, such as its equations; the checkers begin anew each time.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from statistics import median
from time import process_time
from typing import Any

from pkm_exact import read_robot, solve
from pkm_exact.certify import check, pure

ROOT = Path(__file__).parent.parent


def main() -> int:
    """Run, and print a Markdown table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("robots", nargs="*", help="names of models (default: all that have a certificate)")
    parser.add_argument("--runs", type=int, default=11, help="runs of each, after one to warm up (default 11)")
    arguments = parser.parse_args()
    names = arguments.robots or sorted(path.stem for path in (ROOT / "certs").glob("*.json"))
    print(f"load {os.getloadavg()[0]:.1f}\n")
    print("| robot | solve, ms | check, ms | ratio | plain check, ms |\n| --- | --- | --- | --- | --- |")
    for name in names:
        data = (ROOT / "certs" / f"{name}.json").read_bytes()
        solves, checks = zip(*(_once(name, data) for _ in range(arguments.runs + 1)), strict=True)
        times = [1000 * median(values[1:]) for values in (solves, checks)]
        plain = 1000 * _seconds(_accepted, pure, data)
        print(f"| {name} | {times[0]:.1f} | {times[1]:.1f} | {times[1] / times[0]:.2f} | {plain:.0f} |", flush=True)
    return 0


def _once(name: str, data: bytes) -> tuple[float, float]:
    """Processor seconds of a solve and a check."""
    robot = read_robot(ROOT / "models" / f"{name}.toml")
    problem = robot.problem(robot.configuration())
    return _seconds(solve, problem), _seconds(_accepted, check, data)


def _seconds(action: Any, *arguments: Any) -> float:
    begun = process_time()
    action(*arguments)
    return process_time() - begun


def _accepted(checker: Any, data: bytes) -> None:
    verdict, _ = checker.check_counted(data)
    if verdict.status != "accepted":
        raise SystemExit(f"not accepted: {verdict}")


if __name__ == "__main__":
    sys.exit(main())
