"""Statics of many poses: six certified indices of a planar 4-RRR in one call, and columns of indices in a sweep.

Times are of the processor. The indices are those of chapter 6 of Parallel Manipulators (2008), of the machine and the
grid of its table 4, between bounds that outward rounding proves: the widest of the intervals is printed.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
from collections.abc import Callable
from dataclasses import fields
from fractions import Fraction
from pathlib import Path
from random import Random
from statistics import median
from time import process_time
from typing import Any

import numpy as np

from pkm_exact import Policy, read_robot, solve
from pkm_exact.statics.interval_arrays import Intervals
from pkm_exact.statics.planar_leg_wrenches import PlanarLeg, rrr, stacked
from pkm_exact.statics.planar_wrenches import wrench_indices
from pkm_exact.sweep.asked_indices import AskedIndices
from pkm_exact.sweep.job import sweep_job
from pkm_exact.sweep.lengths import read_lengths

LEAST = 1000
"""Poses of a 4-RRR with all six indices that a second of one core must do."""
MODEL = Path(__file__).parent.parent / "models" / "3-rpr-merlet-p.toml"
LIMITS = {"speeds": ["1/5"], "forces": ["5"], "length": ["3"], "speed": ["1/10"], "force": ["1"]}
COLUMNS = ("condition", "ms", "manipulability", "v_iso", "f_iso", "fvi_p")


def main() -> int:
    """Measure, print a Markdown table, and tell by the exit code whether the limit is kept."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=7, help="runs of each (default 7)")
    parser.add_argument("--poses", type=int, default=20_000, help="poses of the 4-RRR at once (default 20000)")
    parser.add_argument("--rows", type=int, default=20, help="rows of the sweep (default 20)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures to FILE as well")
    arguments = parser.parse_args()
    found = {"load": os.getloadavg()[0], **of_indices(arguments.poses, arguments.runs)}
    found |= of_sweep(arguments.rows, arguments.runs)
    print("| what | figure |\n|---|---|")
    print(f"| poses of a 4-RRR with six indices, a second | {found['poses_a_second']:.0f} |")
    print(f"| widest interval of an index, of its value | {found['widest']:.1e} |")
    print(f"| a row of a sweep, ms | {1000 * found['row']:.2f} |")
    print(f"| {len(COLUMNS)} columns of indices of a pose, ms more | {1000 * found['columns_of_a_pose']:.2f} |")
    print(f"| load | {found['load']:.1f} |")
    if arguments.json is not None:
        arguments.json.write_text(json.dumps(found, indent=1) + "\n")
    if found["poses_a_second"] < LEAST:
        print(f"fewer than {LEAST} poses a second", file=sys.stderr)
        return 1
    return 0


def of_indices(count: int, runs: int) -> dict[str, float]:
    """Poses a second, wrenches from the position to the six indices, and how wide these are."""
    random = np.random.default_rng(17)
    places = [random.integers(-60, 61, count).astype(float) for _ in range(2)]
    seconds, indices = timed(lambda: wrench_indices(four_rrr(*places)), runs)
    widest = 0.0
    for entry in fields(indices):
        value = getattr(indices, entry.name)
        if not (np.isfinite(value.lo) & np.isfinite(value.hi) & (value.lo <= value.hi)).all():
            raise SystemExit(f"{entry.name}: has no bounds")
        widest = max(widest, float(((value.hi - value.lo) / value.hi).max()))
    return {"poses_a_second": count / seconds, "widest": widest}


def four_rrr(x: Any, y: Any) -> Intervals:
    """Wrenches with square base and platform of edges 0.5 and 0.2 m, links of 0.2 m and 4.2 Nm, x and y in mm."""
    position = tuple(Intervals.exactly(values) / number(1000) for values in (x, y))
    found = []
    for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        base, platform = ((number(sx * half, 20), number(sy * half, 20)) for half in (5, 2))
        found += rrr(PlanarLeg(base, platform), position, (0.2, 0.2))
    return stacked(found, [4.2] * 4)


def number(numerator: float, denominator: float = 1.0) -> Intervals:
    """A rational number, enclosed."""
    return Intervals.exactly(np.float64(numerator)) / Intervals.exactly(np.float64(denominator))


def of_sweep(count: int, runs: int) -> dict[str, float]:
    """Seconds of a row of a sweep without columns of indices, and of the columns of a pose."""
    random, robot = Random(17), read_robot(MODEL)
    # Lengths near those of the model: every row has poses.
    lines = [",".join(f"{base + random.randint(-20, 20) / 100:g}" for base in (7.1, 5.1, 5.0)) for _ in range(count)]
    asked = AskedIndices.of(COLUMNS, LIMITS, 3)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "rows.csv"
        file.write_text("\n".join(lines) + "\n")
        lengths = read_lengths(str(file), robot)
        rows = list(lengths.rows())
        options: dict[str, Any] = {"squared": False, "certificates": False, "indices": None}
        job = sweep_job(robot, lengths, method="exact", width=Fraction(1, 10**9), policy=Policy(), **options)
        plain, _ = timed(lambda: [job.answer(row) for row in rows], runs)
    problems = [robot.problem_at([Fraction(word) for word in line.split(",")]) for line in lines]
    solved = [(problem, solve(problem).poses) for problem in problems]
    columns, found = timed(lambda: [asked.at_poses(robot, problem, poses)[0] for problem, poses in solved], runs)
    poses = sum(map(len, found))
    if not poses or any(value is None for row in found for pose in row for value in pose.values()):
        raise SystemExit("sweep: an index has no value")
    return {"row": plain / count, "columns_of_a_pose": columns / poses}


def timed(work: Callable[[], Any], runs: int) -> tuple[float, Any]:
    """The median of the processor's seconds, and the answer."""
    times, answer = [], None
    for _ in range(runs):
        begin = process_time()
        answer = work()
        times.append(process_time() - begin)
    return median(times), answer


if __name__ == "__main__":
    sys.exit(main())
