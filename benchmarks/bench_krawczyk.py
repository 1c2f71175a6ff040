"""The numeric engine side by side with msolve: in turn, so that both meet the same load, in one warm process.

msolve solves the AFD4 system of Rolland's robot as a whole process, `-t 1`, from file to file. Ours, all with Krawczyk
boxes, pose boxes and Jacobians: from the generic start; from a start near the robot, at other lengths in every run; at
home as well. Then Newton's method from a pose nearby, and one certified step along a path. Times are wall clock.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from random import Random
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter

from pkm_exact import Robot, read_robot, track_branch
from pkm_exact.backends.msolve_program import find_msolve, msolve_command, msolve_input
from pkm_exact.formulations.registry import formulation
from pkm_exact.numeric.nearby import nearby_start
from pkm_exact.numeric.newton_iteration import newton
from pkm_exact.numeric.numeric_machine import StartPose
from pkm_exact.numeric.numeric_robot import numeric_robot
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.poses.pose import Pose
from pkm_exact.solution import Solution

MODEL = Path(__file__).parent.parent / "models" / "rolland-6-6.toml"
REACH = 20
"""Lengths of neighbours differ from those of the home configuration by so many units at most."""
PATH_REACH = 5
"""And those at the end of a path."""


LIMITS = {"generic": 0.15, "nearby": 0.05, "newton": 0.001, "step": 0.01}
"""Most that each may take, in times of msolve: of the last two 1 ms and 10 ms where msolve takes one second."""
TITLES = {
    "msolve": "msolve on AFD4, 1 thread, whole process",
    "generic": "whole solve from the generic start",
    "nearby": "whole solve of other lengths from a start near the robot",
    "newton": "Newton's method from a pose nearby",
    "step": "one certified step along a path",
}


def main() -> int:
    """Run, print a Markdown table, and tell by the exit code whether the limits are kept."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=20, help="runs of each, after one to warm up (default 20)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the times to FILE as well")
    arguments = parser.parse_args()
    program = find_msolve()
    if program is None:
        print("msolve is not installed: nothing to compare with", file=sys.stderr)
        return 0
    with TemporaryDirectory() as name:
        times = _measured(arguments.runs, program, Path(name))
    ratios = {name: median(times[name]) / median(times["msolve"]) for name in times}
    print(_table(arguments.runs, times, ratios))
    if arguments.json is not None:
        arguments.json.write_text(json.dumps({"seconds": times, "ratios": ratios}, indent=1) + "\n", encoding="utf-8")
    return int(any(ratios[name] > limit for name, limit in LIMITS.items()))


def _measured(runs: int, program: Path, folder: Path) -> dict[str, list[float]]:
    """Seconds of every run of every contender, in turn."""
    robot, random = read_robot(MODEL), Random(1)
    home = robot.problem(robot.configuration())
    source = folder / "system.ms"
    source.write_text(msolve_input(formulation("AFD4").formulate(home).system), encoding="ascii")
    start = nearby_start(home)
    neighbours = [robot.problem(_lengths(robot, random, REACH)) for _ in range(runs + 1)]
    pose = solve_krawczyk(home).poses[0]
    numeric, begin = numeric_robot(home), _beside(pose)
    contenders: dict[str, Callable[[int], object]] = {
        "msolve": lambda _: _run(msolve_command(program, source, folder / "solutions.txt")),
        "generic": lambda number: _numeric(solve_krawczyk(neighbours[number])),
        "nearby": lambda number: _numeric(solve_krawczyk(neighbours[number], start=start)),
        "newton": lambda _: newton(numeric, begin),
    }
    times: dict[str, list[float]] = {name: [] for name in (*contenders, "step")}
    for number in range(runs + 1):
        for name, contender in contenders.items():
            before = perf_counter()
            contender(number)
            if number:
                times[name].append(perf_counter() - before)
        if number:
            times["step"].append(_step_seconds(robot, pose, random))
    return times


def _lengths(robot: Robot, random: Random, reach: int) -> list[Fraction]:
    home = Fraction(1250)
    return [(home + Fraction(random.randint(-100, 100), 100) * reach) ** 2 for _ in robot.base_joints]


def _beside(pose: Pose) -> StartPose:
    """A pose some units and a few degrees off."""
    x, y, z = (float(interval.midpoint) + 5 for interval in pose.position)
    a, b, c, d = (float(interval.midpoint) + 0.02 for interval in pose.quaternion)
    return StartPose((x, y, z), (a, b, c, d))


def _step_seconds(robot: Robot, pose: Pose, random: Random) -> float:
    """Seconds of a certified step, the pose at the row that they lead to shared among them."""
    home = tuple(Fraction(1250) for _ in robot.base_joints)
    rows = [home, tuple(length + Fraction(random.randint(-100, 100), 100) * PATH_REACH for length in home)]
    samples = track_branch(robot, rows, pose)
    next(samples)
    before = perf_counter()
    steps = next(samples).steps
    return (perf_counter() - before) / steps


def _numeric(solution: Solution) -> None:
    if solution.method != "krawczyk":
        raise SystemExit(f"the numeric engine did not answer: {solution.notes}")


def _run(command: list[str]) -> None:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)} ended with exit code {done.returncode}:\n{done.stderr}")


def _table(runs: int, times: dict[str, list[float]], ratios: dict[str, float]) -> str:
    lines = [f"rolland-6-6, {runs} runs, milliseconds", ""]
    lines += ["| | median | min | max | median / msolve | limit |", "|---|---|---|---|---|---|"]
    for name, values in times.items():
        figures = " | ".join(f"{1000 * value:.2f}" for value in (median(values), min(values), max(values)))
        lines.append(f"| {TITLES[name]} | {figures} | {ratios[name]:.4f} | {LIMITS.get(name, '')} |")
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())
