"""All benchmarks in one run: programs side by side, engines by stage, formulations, growth, batches.

Writes report.md, report.json and pictures. The programs run in turn, so that all meet the same load; read the ratios.
The exit code is 1 if a limit is not kept.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import Any

from growth import batches, digits, exponent
from machine import machine
from programs import programs
from report import draw, markdown, share_of
from side_by_side import formulations, warm_engines, whole_processes
from symmetric import beside_msolve, proof_shares

MODELS = Path(__file__).parent.parent / "models"
GENERAL = ("rolland-6-6", "dietmaier", "mourrain-l", "similar-planar-s", "3-rpr-merlet-p")
FAMILY = ("6-6p", "6-6pp", "ssm-exact", "ssm-rounded", "tssm", "mssm", "hexa", "hexaglide")
"""The other robots of the reference chapter's Table 5, each on our two engines and msolve only."""
SIDE = ("exact", "krawczyk", "msolve", "msolve-2")
PARTS = ("programs", "engines", "formulations", "digits", "batches", "symmetric", "proofs")
SYMMETRIC = ("ssm-rounded", "hexaglide", "ssm-exact", "mssm", "tssm", "linuxcnc-hexapod")
"""Robots with much symmetry, on which the modular elimination of msolve costs little."""
DIGITS = (3, 6, 12, 24, 48)
BATCHES = (1, 10, 100, 1000)
MOST_EXACT = 100
"""Rows of the largest batch for the exact engine, which a row costs the same however many there are."""
QUICK_RATIO, SLOW_RATIO, SECONDS = 1.0, 2.0, 10.0
"""Limits: of the exact engine to msolve, of a formulation to msolve on the same system, or in seconds."""
SYMMETRIC_RATIO, SYMMETRIC_SECONDS, SHIPPED_SECONDS, SHARE = 2.0, 0.5, 1.5, 0.5
"""Limits: of a solve to msolve on symmetric robots, or in seconds; of any shipped robot; of a proof in its solve."""
STEEPEST, ROW_RATIO, MEGABYTES = 2.0, 0.5, 500
"""Limits: of the growth with digits (2: quadratic), of a row in a large batch to a single solve, of memory."""


def main() -> int:
    """Run what is asked for and write the report."""
    arguments = _arguments()
    start = perf_counter()

    def log(line: str) -> None:
        print(f"{perf_counter() - start:7.1f} s  {line}", file=sys.stderr, flush=True)

    arguments.output.mkdir(parents=True, exist_ok=True)
    contenders = {key: each for key, each in programs().items() if each.version is not None}
    results = _begun(arguments.output / "report.json", machine(programs().values()))
    robots = [MODELS / f"{name}.toml" for name in arguments.robots]
    family = [MODELS / f"{name}.toml" for name in arguments.family]
    if "programs" in arguments.parts:
        some = {key: each for key, each in contenders.items() if key in SIDE}
        measured = whole_processes(robots, contenders, arguments.runs, arguments.limit, log)
        measured |= whole_processes(family, some, arguments.runs, arguments.limit, log)
        titles = {key: (each.title, each.job) for key, each in contenders.items()}
        results["whole processes"] = {"titles": titles, "robots": measured}
    if "engines" in arguments.parts:
        results["engines"] = warm_engines(robots + family, arguments.runs, log)
    if "formulations" in arguments.parts:
        runs = min(arguments.runs, 3)
        results["formulations"] = {path.stem: formulations(path, runs, arguments.limit, log) for path in robots[:1]}
    if "digits" in arguments.parts:
        results["digits"] = digits(arguments.digits, min(arguments.runs, 3), arguments.limit, log)
    if "batches" in arguments.parts:
        limit = 100 * arguments.limit
        sizes = {"krawczyk": arguments.batches, "exact": [size for size in arguments.batches if size <= MOST_EXACT]}
        results["batches"] = batches(robots[0], sizes, (1, 2), limit, log)
    if "symmetric" in arguments.parts:
        some = [MODELS / f"{name}.toml" for name in arguments.symmetric]
        results["symmetric"] = beside_msolve(some, arguments.runs, arguments.limit, log)
    if "proofs" in arguments.parts:
        shipped = [path for path in sorted(MODELS.glob("*.toml")) if path.stem in (arguments.shipped or [path.stem])]
        results["proofs"] = proof_shares(shipped, arguments.runs, log)
    results["limits"] = _limits(results)
    (arguments.output / "report.json").write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
    text = markdown(results)
    (arguments.output / "report.md").write_text(text, encoding="utf-8")
    draw(results, arguments.output)
    print(text)
    return int(not all(each["kept"] for each in results["limits"]))


def _begun(path: Path, here: dict[str, Any]) -> dict[str, Any]:
    """The parts measured earlier on the same day with the same versions, which are kept."""
    if path.is_file():
        earlier: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        if all(earlier["machine"][key] == here[key] for key in ("date", "processor", "versions")):
            return earlier | {"machine": here}
    return {"machine": here}


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--output", type=Path, default=Path("build/bench"), help="folder of the report (build/bench)")
    parser.add_argument("--runs", type=int, default=5, help="runs of each, after one to warm up (default 5)")
    parser.add_argument("--limit", type=float, default=100, help="seconds after which a program is ended (default 100)")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=PARTS, help="what to measure (default all)")
    parser.add_argument("--robots", nargs="+", default=GENERAL, metavar="NAME", help="models for all programs")
    parser.add_argument("--family", nargs="*", default=FAMILY, metavar="NAME", help="models for msolve and us alone")
    parser.add_argument("--symmetric", nargs="*", default=SYMMETRIC, metavar="NAME", help="models with much symmetry")
    parser.add_argument("--shipped", nargs="*", metavar="NAME", help="models whose proofs are timed (default all)")
    parser.add_argument("--digits", nargs="+", type=int, default=DIGITS, metavar="N", help="sizes of the data")
    parser.add_argument("--batches", nargs="+", type=int, default=BATCHES, metavar="N", help="sizes of the sweeps")
    return parser.parse_args()


def _limits(results: Mapping[str, Any]) -> list[dict[str, Any]]:
    """What was promised, against what was measured; only what was measured."""
    named = [*_engine_limits(results), *_formulation_limits(results), *_growth_limits(results), *_proof_limits(results)]
    return [{"what": what, "value": value, "limit": limit, "kept": value <= limit} for what, value, limit in named]


def _engine_limits(results: Mapping[str, Any]) -> Iterator[tuple[str, float, float]]:
    robots = results.get("whole processes", {}).get("robots", {})
    for robot in ("rolland-6-6", "dietmaier"):
        process, engine = robots.get(robot, {}).get("msolve"), results.get("engines", {}).get(robot)
        if process and process["is_answered"] and engine:
            msolve = median(each["seconds"] for each in process["runs"])
            for key, entry in engine.items():
                yield f"{robot}: {key} engine in process / msolve", median(entry["seconds"]) / msolve, QUICK_RATIO


def _formulation_limits(results: Mapping[str, Any]) -> Iterator[tuple[str, float, float]]:
    for robot, entries in results.get("formulations", {}).items():
        for code, entry in entries.items():
            seconds, msolve = median(entry["engine"]), median(entry["msolve"] or [0.0])
            if SLOW_RATIO * msolve <= SECONDS and "real" in entry["answer"]:
                yield f"{robot}: {code} / msolve on the same system", seconds / msolve, SLOW_RATIO
            else:
                yield f"{robot}: {code}, seconds", seconds, SECONDS


def _growth_limits(results: Mapping[str, Any]) -> Iterator[tuple[str, float, float]]:
    for key, points in results.get("digits", {}).items():
        slope = exponent(points)
        if slope is not None and key != "msolve":
            yield f"{key}: exponent of the growth with digits", slope, STEEPEST
    done = [each for each in results.get("batches", []) if "memory" in each]
    some = [each for each in done if each["method"] == "krawczyk" and each["workers"] == 1]
    if some and some[0]["rows"] == 1 < some[-1]["rows"]:
        yield (
            f"sweep: a row of {some[-1]['rows']} / a single solve",
            some[-1]["per_row"] / some[0]["per_row"],
            ROW_RATIO,
        )
    if done:
        yield "sweep: peak memory of all processes, MB", max(each["memory"] for each in done) / 1e6, MEGABYTES


def _proof_limits(results: Mapping[str, Any]) -> Iterator[tuple[str, float, float]]:
    for robot, entry in results.get("symmetric", {}).items():
        seconds, msolve = median(entry["processor"]), median(entry["msolve processor"] or [0.0])
        if SYMMETRIC_RATIO * msolve <= SYMMETRIC_SECONDS:
            yield f"{robot}: exact engine in process, processor seconds", seconds, SYMMETRIC_SECONDS
        else:
            yield f"{robot}: exact engine in process / msolve, processor time", seconds / msolve, SYMMETRIC_RATIO
    for robot, entry in results.get("proofs", {}).items():
        yield f"{robot}: processor seconds", median(entry["processor"]), SHIPPED_SECONDS
        yield f"{robot}: share of the proof of completeness", share_of(entry), SHARE


if __name__ == "__main__":
    sys.exit(main())
