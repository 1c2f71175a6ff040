"""Robots with much symmetry beside msolve, and how much of every shipped robot's solve is the proof of completeness.

Our engine runs in this process, msolve as a whole process on the system that it is quickest on, in turn. Shares are of
processor time, which a loaded machine changes little.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, process_time
from typing import Any

from measure import run
from programs import GOOD_EXITS, PLANAR, SPATIAL, msolve_on

from pkm_exact import read_robot, solve

Log = Callable[[str], None]
PROOF = "completeness"
"""The stage in which the list of poses is proved complete."""


def beside_msolve(models: Sequence[Path], runs: int, limit: float, log: Log) -> dict[str, dict[str, Any]]:
    """Of each robot: seconds and processor time of our solves, and of msolve's processes; empty where it has none."""
    results: dict[str, dict[str, Any]] = {}
    for model in models:
        robot = read_robot(model)
        problem = robot.problem(robot.configuration())
        entry: dict[str, Any] = {name: [] for name in ("seconds", "processor", "msolve", "msolve processor")}
        with TemporaryDirectory() as name:
            command = msolve_on(PLANAR if problem.motion.is_planar else SPATIAL, problem, Path(name))
            for number in range(runs + 1):
                before, processor = perf_counter(), process_time()
                solve(problem)
                taken = perf_counter() - before, process_time() - processor
                done = None if command is None else run(command.words, limit, Path(name))
                if not number:
                    continue
                entry["seconds"].append(taken[0])
                entry["processor"].append(taken[1])
                if done is not None and done.code in GOOD_EXITS:
                    entry["msolve"].append(done.seconds)
                    entry["msolve processor"].append(done.processor)
        log(f"{model.stem}: beside msolve")
        results[model.stem] = entry
    return results


def proof_shares(models: Sequence[Path], runs: int, log: Log) -> dict[str, dict[str, Any]]:
    """Of each robot: processor seconds of our solves, and of the proofs of completeness in them."""
    results: dict[str, dict[str, Any]] = {}
    for model in models:
        robot = read_robot(model)
        problem = robot.problem(robot.configuration())
        entry: dict[str, Any] = {"processor": [], "proof": [], "route": None}
        for number in range(runs + 1):
            stages: list[tuple[str, float]] = []
            begun = process_time()
            solution = solve(problem, progress=lambda stage, seen=stages: seen.append((stage, process_time())))
            ended = process_time()
            if number:
                entry["processor"].append(ended - begun)
                entry["proof"].append(_spent(stages, ended))
                entry["route"] = solution.completeness_route and str(solution.completeness_route)
        log(f"{model.stem}: share of the proof")
        results[model.stem] = entry
    return results


def _spent(stages: Sequence[tuple[str, float]], ended: float) -> float:
    """Processor time between the beginnings of the proof's stage and those of the next ones."""
    following = [begun for _, begun in stages[1:]] + [ended]
    return sum(end - begun for (stage, begun), end in zip(stages, following, strict=True) if stage == PROOF)
