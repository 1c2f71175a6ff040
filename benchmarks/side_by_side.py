"""Whole processes of all programs on all robots, in turn; then our engines in this process, with their stages."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, process_time
from typing import Any

from measure import Run, run
from programs import GOOD_EXITS, Command, Program, msolve_on

from pkm_exact import Solution, read_robot, solve, solve_krawczyk
from pkm_exact.formulations.registry import formulation_codes
from pkm_exact.geometry.problem import ForwardProblem

Log = Callable[[str], None]
ENGINES: Mapping[str, Callable[[ForwardProblem], Solution]] = {"exact": solve, "krawczyk": solve_krawczyk}


def whole_processes(
    models: Sequence[Path], contenders: Mapping[str, Program], runs: int, limit: float, log: Log
) -> dict[str, dict[str, Any]]:
    """Of each robot and program: seconds, processor time and memory of every run, and its answer."""
    return {model.stem: _robot(model, contenders, runs, limit, log) for model in models}


def _robot(model: Path, contenders: Mapping[str, Program], runs: int, limit: float, log: Log) -> dict[str, Any]:
    robot = read_robot(model)
    problem = robot.problem(robot.configuration())
    with TemporaryDirectory() as name:
        commands = {}
        for key, program in contenders.items():
            folder = Path(name) / key
            folder.mkdir()
            commands[key] = (program.command(model.absolute(), problem, folder), folder)
        results: dict[str, dict[str, Any]] = {}
        for number in range(runs + 1):
            for key, (command, folder) in commands.items():
                if command is None:
                    results[key] = {"answer": "not a system that it takes", "runs": []}
                elif number == 0 or results[key]["is_answered"]:
                    done = run(command.words, limit, folder, source=command.source)
                    log(f"{model.stem}: {contenders[key].title}, run {number}: {done.seconds:.2f} s")
                    _note(results.setdefault(key, {"runs": []}), command, done, number, limit)
    return results


def _note(result: dict[str, Any], command: Command, done: Run, number: int, limit: float) -> None:
    """The first run warms up the files; it counts only if it is the last, for want of an answer."""
    result["is_answered"] = done.code in GOOD_EXITS
    if done.code is None:
        result["answer"] = f"none in {limit:g} s"
    elif done.code not in GOOD_EXITS:
        result["answer"] = f"failed, exit code {done.code}"
    else:
        result["answer"] = command.answer(done)
    if number or not result["is_answered"]:
        taken = {"seconds": done.seconds, "processor": done.processor, "memory": done.memory}
        result["runs"].append(taken)


def warm_engines(models: Sequence[Path], runs: int, log: Log) -> dict[str, dict[str, Any]]:
    """Of each robot and engine: seconds of each run in this process, after one to warm up, and those of its stages."""
    results: dict[str, dict[str, Any]] = {}
    for model in models:
        robot = read_robot(model)
        problem = robot.problem(robot.configuration())
        results[model.stem] = {key: {"seconds": [], "stages": {}, "method": ""} for key in ENGINES}
        for number in range(runs + 1):
            for key, engine in ENGINES.items():
                before = perf_counter()
                solution = engine(problem)
                if number:
                    entry = results[model.stem][key]
                    entry["seconds"].append(perf_counter() - before)
                    entry["method"] = solution.method
                    for stage, seconds in solution.statistics.seconds.items():
                        entry["stages"].setdefault(stage, []).append(seconds)
        log(f"{model.stem}: engines in process")
    return results


def formulations(model: Path, runs: int, limit: float, log: Log) -> dict[str, dict[str, Any]]:
    """Processor time of our engine in this process and of msolve on the same system, in turn, for each formulation."""
    robot = read_robot(model)
    problem = robot.problem(robot.configuration())
    results: dict[str, dict[str, Any]] = {}
    for code in formulation_codes():
        entry: dict[str, Any] = {"engine": [], "msolve": [], "ended": True, "answer": ""}
        with TemporaryDirectory() as name:
            command = msolve_on(code, problem, Path(name))
            for number in range(runs + 1):
                before = process_time()
                solve(problem, formulation=code)
                if number:
                    entry["engine"].append(process_time() - before)
                if command is not None and entry["ended"]:
                    done = run(command.words, limit, Path(name))
                    entry["ended"] = done.code in GOOD_EXITS
                    entry["answer"] = command.answer(done) if entry["ended"] else f"none in {limit:g} s"
                    if number or not entry["ended"]:
                        entry["msolve"].append(done.processor)
                log(f"{model.stem}: {code}, run {number}")
        results[code] = entry
    return results
