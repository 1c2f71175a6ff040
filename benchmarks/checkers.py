"""Both checkers on the certificate of every shipped robot, beside the exact engine's solve of it, in one process.

Processor time, in turn: medians, and of the plain checker one run; the load is said first. Ratios are medians of those
of times that follow each other, as the clock of a machine changes. The engine may know of a robot what an earlier run
has found, such as its equations; the checkers begin anew each time. The second ratio is that to a solve that counts the
poses by an elimination, which most solves of general robots do without.
"""

from __future__ import annotations

import argparse
import os
import sys
from functools import partial
from pathlib import Path
from statistics import median
from time import process_time
from typing import Any

from pkm_exact import Policy, read_robot, solve
from pkm_exact.certify import check, pure
from pkm_exact.cli.main import prefer_one_thread

ROOT = Path(__file__).parent.parent


def main() -> int:
    """Run, and print a Markdown table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("robots", nargs="*", help="names of models (default: all that have a certificate)")
    parser.add_argument("--runs", type=int, default=11, help="runs of each, after one to warm up (default 11)")
    arguments = parser.parse_args()
    prefer_one_thread()  # before numpy is loaded
    names = arguments.robots or sorted(path.stem for path in (ROOT / "certs").glob("*.json"))
    print(f"load {os.getloadavg()[0]:.1f}\n")
    print("| robot | solve, ms | by elimination, ms | check, ms | check / solve | / by elimination | plain, ms |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name in names:
        data = (ROOT / "certs" / f"{name}.json").read_bytes()
        measured = [_once(name, data) for _ in range(arguments.runs + 1)][1:]
        shown = [f"{1000 * median(values):.1f}" for values in zip(*measured, strict=True)]
        shown += [f"{median(times[2] / times[k] for times in measured):.2f}" for k in (0, 1)]
        print(f"| {name} | {' | '.join(shown)} | {1000 * _seconds(_accepted, pure, data):.0f} |", flush=True)
    return 0


def _once(name: str, data: bytes) -> tuple[float, float, float]:
    """Processor seconds of a solve, of one with an elimination, and of a check."""
    by_elimination = partial(solve, policy=Policy(eliminate=True))
    eliminated, alone, checked = (
        _seconds(by_elimination, _problem(name)),
        _seconds(solve, _problem(name)),
        _seconds(_accepted, check, data),
    )
    return alone, eliminated, checked


def _problem(name: str) -> Any:
    """The problem, read anew: one that was solved before knows what it was asked for then, such as its equations."""
    robot = read_robot(ROOT / "models" / f"{name}.toml")
    return robot.problem(robot.configuration())


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
