"""How time and memory grow: with the digits of the data, with the number of length vectors, and with workers."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from math import log
from pathlib import Path
from random import Random
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any

from measure import run
from programs import GOOD_EXITS, OURS, msolve_on

from pkm_exact import read_robot

Log = Callable[[str], None]
METHODS = ("exact", "krawczyk")


def digits(sizes: Sequence[int], runs: int, limit: float, log_line: Log) -> dict[str, list[dict[str, Any]]]:
    """Of our engines and msolve, whole processes in turn: median seconds and memory for data of so many digits.

    The robot is a 6-6 with joints of three coordinates of so many digits each, at lengths of as many digits near those
    of a pose.
    """
    results: dict[str, list[dict[str, Any]]] = {name: [] for name in (*METHODS, "msolve")}
    for size in sizes:
        with TemporaryDirectory() as name:
            folder = Path(name)
            model = folder / "random.toml"
            model.write_text(random_model(size), encoding="utf-8")
            robot = read_robot(model)
            commands = {method: _solving(model, method, folder) for method in METHODS}
            msolve = msolve_on("AFD4", robot.problem(robot.configuration()), folder)
            if msolve is not None:
                commands["msolve"] = msolve.words
            taken: dict[str, list[Any]] = {key: [] for key in commands}
            for number in range(runs + 1):
                for key, words in commands.items():
                    done = run(words, limit, folder)
                    if number and done.code in GOOD_EXITS:
                        taken[key].append(done)
            for key, every in taken.items():
                if every:
                    seconds, memory = median(each.seconds for each in every), max(each.memory for each in every)
                    results[key].append({"digits": size, "seconds": seconds, "memory": memory})
        log_line(f"{size} digits")
    return results


def _solving(model: Path, method: str, folder: Path) -> list[str]:
    return [*OURS, "solve", str(model), "--method", method, "-o", str(folder / f"{method}.json")]


def random_model(size: int) -> str:
    """A 6-6 robot whose coordinates and lengths have so many significant digits, the same at every call."""
    random = Random(size)

    def number(low: int, high: int) -> str:
        unit = 10 ** (size - 1)
        return f"{random.randrange(low * unit, high * unit)}e-{size - 1}"

    def rows(reach: int) -> str:
        return ", ".join(f"[{', '.join(number(-reach, reach) for _ in range(3))}]" for _ in range(6))

    lengths = ", ".join(number(9, 13) for _ in range(6))
    return (
        f'schema = 1\nname = "random, {size} digits"\nkind = "6-UPS"\nunit = "m"\nsource = "made up"\n'
        f"[base]\njoints = [{rows(6)}]\n[platform]\njoints = [{rows(5)}]\n"
        f'[[configurations]]\nname = "home"\nlengths = [{lengths}]\n'
    )


def exponent(points: Sequence[dict[str, Any]], key: str = "seconds") -> float | None:
    """Slope of the logarithm between the last two points: 2 for quadratic growth."""
    if len(points) < 2:
        return None
    one, two = points[-2:]
    return log(two[key] / one[key]) / log(two["digits"] / one["digits"])


def batches(
    model: Path, sizes: Mapping[str, Sequence[int]], workers: Sequence[int], limit: float, log_line: Log
) -> list[dict[str, Any]]:
    """`certify-poses sweep` over random lengths near the model's own: seconds in all and of a row, memory of all."""
    results = []
    with TemporaryDirectory() as name:
        folder = Path(name)
        for method in sizes:
            for size in sizes[method]:
                rows = folder / f"{size}.csv"
                _write_lengths(model, rows, size)
                for count in workers:
                    target = folder / f"{method}-{size}-{count}.jsonl"
                    words = [*OURS, "sweep", str(model), str(rows), "-o", str(target), "--workers", str(count)]
                    done = run([*words, "--method", method], limit, folder, family=True)
                    entry: dict[str, Any] = {"method": method, "rows": size, "workers": count, "code": done.code}
                    if done.code in GOOD_EXITS:
                        entry |= {"seconds": done.seconds, "per_row": done.seconds / size, "memory": done.memory}
                        entry["poses"] = _poses(target)
                    results.append(entry)
                    log_line(f"{method}, {size} rows, {count} workers: {done.seconds:.1f} s")
    return results


def _write_lengths(model: Path, target: Path, size: int) -> None:
    """Lengths that differ from those of the model by up to a hundredth of them."""
    robot = read_robot(model)
    legs = robot.problem(robot.configuration()).distances
    home = [Fraction(round(float(leg.length_squared) ** 0.5 * 1000), 1000) for leg in legs]
    random = Random(1)
    with target.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream)
        for _ in range(size):
            writer.writerow([f"{float(length + length * random.randint(-1000, 1000) / 100000):.4f}" for length in home])


def _poses(target: Path) -> int:
    """How many real poses the output lists in all."""
    with target.open(encoding="utf-8") as stream:
        return sum(json.loads(line).get("real_poses", 0) for line in stream)
