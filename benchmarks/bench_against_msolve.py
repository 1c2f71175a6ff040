"""Side by side with msolve: whole commands on one thread, in turn, so that both meet the same load.

msolve solves the AFD4 system of the same robot: `-t 1`, real solutions and their parametrisation, from file to file.
Ours is `certify-poses solve` as a user calls it, start of Python included; then the engine inside a running process;
then `certify-poses check` on the certificate. Times are wall clock.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter

from pkm_exact import read_robot, solve
from pkm_exact.backends.msolve import find_msolve, msolve_command, msolve_input
from pkm_exact.formulations.registry import formulation

MODEL = Path(__file__).parent.parent / "models" / "rolland-6-6.toml"
LIMIT = 5
"""Most that the whole command may take, in times of msolve."""
GOOD_EXITS = {0, 3}
"""Exit codes of an answer: complete, or weaker than complete."""


def main() -> int:
    """Run, print a Markdown table, and tell by the exit code whether the limits are kept."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=5, help="runs of each, after one to warm up (default 5)")
    parser.add_argument("--model", type=Path, default=MODEL, help="model file (default Rolland's 6-6)")
    parser.add_argument("--formulation", default="SE3", help="formulation that our engine uses (default SE3)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the times to FILE as well")
    arguments = parser.parse_args()
    program = find_msolve()
    if program is None:
        print("msolve is not installed: nothing to compare with", file=sys.stderr)
        return 0
    with TemporaryDirectory() as name:
        times = _measured(arguments, program, Path(name))
    ratios = _ratios(times)
    print(_table(arguments.model.stem, arguments.formulation, times, ratios))
    if arguments.json is not None:
        report = {
            "model": arguments.model.stem,
            "formulation": arguments.formulation,
            "seconds": times,
            "ratios": ratios,
        }
        arguments.json.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
    return int(ratios["command / msolve"] > LIMIT or ratios["check / solve command"] > 1)


def _measured(arguments: argparse.Namespace, program: Path, folder: Path) -> dict[str, list[float]]:
    """Seconds of every run of every contender, in turn."""
    robot = read_robot(arguments.model)
    problem = robot.problem(robot.configuration())
    system = formulation("AFD4").formulate(problem).system
    source, certificate = folder / "system.ms", folder / "certificate.json"
    source.write_text(msolve_input(system), encoding="ascii")
    ours = [sys.executable, "-m", "pkm_exact.cli.main"]
    command = [*ours, "solve", str(arguments.model), "--formulation", arguments.formulation, "-o", str(certificate)]
    contenders: dict[str, Callable[[], object]] = {
        "msolve": lambda: _run(msolve_command(program, source, folder / "solutions.txt")),
        "command": lambda: _run(command),
        "engine": lambda: solve(problem, formulation=arguments.formulation),
        "check": lambda: _run([*ours, "check", str(certificate)]),
    }
    times: dict[str, list[float]] = {name: [] for name in contenders}
    for number in range(arguments.runs + 1):
        for name, contender in contenders.items():
            start = perf_counter()
            contender()
            if number:
                times[name].append(perf_counter() - start)
    return times


def _run(command: list[str]) -> None:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in GOOD_EXITS:
        raise SystemExit(f"{' '.join(command)} ended with exit code {done.returncode}:\n{done.stderr}")


def _ratios(times: dict[str, list[float]]) -> dict[str, float]:
    """Ratios of the medians."""
    middle = {name: median(values) for name, values in times.items()}
    return {
        "command / msolve": middle["command"] / middle["msolve"],
        "engine / msolve": middle["engine"] / middle["msolve"],
        "check / solve command": middle["check"] / middle["command"],
    }


def _table(model: str, code: str, times: dict[str, list[float]], ratios: dict[str, float]) -> str:
    titles = {
        "msolve": "msolve on AFD4, 1 thread, whole process",
        "command": f"`certify-poses solve`, {code}, whole process",
        "engine": f"engine, {code}, in process",
        "check": "`certify-poses check`, whole process",
    }
    lines = [f"{model}, {len(times['msolve'])} runs, seconds", ""]
    lines += ["| | median | min | max |", "|---|---|---|---|"]
    for name, values in times.items():
        lines.append(f"| {titles[name]} | {median(values):.2f} | {min(values):.2f} | {max(values):.2f} |")
    lines += ["", "| ratio of medians | |", "|---|---|"]
    lines += [f"| {name} | {value:.2f} |" for name, value in ratios.items()]
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())
