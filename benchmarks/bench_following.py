"""Following a pose in a control loop: processor time a step, in Python and in the C code that ``codegen`` writes.

Every step is proved; steps are small random changes of all joint values, about a home pose. The C code's own test has
10,000 poses and counts wrong ones. Beside the times stands that of numpy's solution of an 8 x 8 system, as a measure of
the machine.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

import numpy as np

from pkm_exact import Robot
from pkm_exact.following.c_files import c_files
from pkm_exact.following.follower import Followed, next_pose
from pkm_exact.following.following_start import joint_values

MODELS = Path(__file__).parent.parent / "models"
NAMES = ("rolland-6-6", "hexa", "hexaglide", "3-rpr-merlet-p", "3-rrr")
MOST = {"Python": 500.0, "C": 20.0}
"""Microseconds that a step may take."""
STEPS = 200


def main() -> int:
    """Measure, print a Markdown table, and tell by the exit code whether the limits are kept."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=11, help="runs of each (default 11)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the times to FILE as well")
    arguments = parser.parse_args()
    rows = [_row(name, arguments.runs) for name in NAMES]
    print(f"an 8 x 8 system by numpy: {_of_numpy(arguments.runs):.1f} us\n")
    print("| robot | Python, us a step | C, us a step | C: proved, same mode, wrong of 10,000 |\n|---|---|---|---|")
    for row in rows:
        counts = f"{row['proved']}, {row['same']}, {row['wrong']}"
        print(f"| {row['robot']} | {row['Python']:.0f} | {row['C']:.2f} | {counts} |")
    if arguments.json is not None:
        arguments.json.write_text(json.dumps(rows, indent=1) + "\n")
    slow = [row["robot"] for row in rows if any(row[kind] > most for kind, most in MOST.items()) or row["wrong"]]
    if slow:
        print(f"limits not kept: {', '.join(slow)}", file=sys.stderr)
    return 1 if slow else 0


def _row(name: str, runs: int) -> dict[str, Any]:
    robot = Robot.load(MODELS / f"{name}.toml")
    poses = robot.solve().poses
    values = joint_values(robot, robot.configuration())
    starts = [robot.follow(values, pose) for pose in poses]
    best = min(starts, key=lambda start: start.position_bound)
    return {"robot": name, "Python": _in_python(best, runs)} | _in_c(name, best, runs)


def _in_python(start: Followed, runs: int) -> float:
    rng = np.random.default_rng(1)
    unit = 1.0 if start.tables.is_cranked else start.tables.unit
    goals = [start.values + 1e-5 * unit * rng.uniform(-1, 1, len(start.values)) for _ in range(STEPS)]
    times = []
    for _ in range(runs):
        begin = process_time()
        for goal in goals:
            next_pose(start.tables, goal, start)
        times.append((process_time() - begin) / STEPS)
    return 1e6 * median(times)


def _in_c(name: str, start: Followed, runs: int) -> dict[str, Any]:
    compiler = shutil.which("cc")
    if compiler is None:
        return {"C": 0.0, "proved": "no compiler", "same": "", "wrong": 0}
    with TemporaryDirectory() as folder:
        for file_name, text in c_files("r", start.tables, start, name).items():
            (Path(folder) / file_name).write_text(text)
        command = [compiler, "-std=c99", "-O2", "r_test.c", "r.c", "-lm", "-o", "r_test"]
        subprocess.run(command, cwd=folder, check=True)
        outputs = [
            subprocess.run([Path(folder) / "r_test"], check=False, capture_output=True, text=True).stdout
            for _ in range(runs)
        ]
    times = [float(re.search(r"([0-9.]+) microseconds", output)[1]) for output in outputs]  # type: ignore[index]
    found = re.match(r"\d+ poses: (\d+) proved, (\d+) of .* (\d+) wrong", outputs[0])
    proved, same, wrong = map(int, found.groups()) if found else (0, 0, 1)
    return {"C": median(times), "proved": proved, "same": same, "wrong": wrong}


def _of_numpy(runs: int) -> float:
    matrix, right = np.random.default_rng(2).normal(size=(8, 8)), np.ones(8)
    times = []
    for _ in range(runs):
        begin = process_time()
        for _ in range(STEPS):
            np.linalg.solve(matrix, right)
        times.append((process_time() - begin) / STEPS)
    return 1e6 * median(times)


if __name__ == "__main__":
    sys.exit(main())
