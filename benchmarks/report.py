"""The results as Markdown, and as pictures of the time by stage and of growth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

from growth import exponent

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MEGABYTE = 1e6
COLOURS, HATCHES = 10, ("", "//", "..")
"""Stages beyond the colours of a cycle are told apart by hatching."""


def markdown(results: Mapping[str, Any]) -> str:
    """All tables; parts that were not run are left out."""
    parts = [_machine(results["machine"])]
    writers = {
        "limits": _limits,
        "whole processes": _whole_processes,
        "engines": _engines,
        "formulations": _formulations,
        "digits": _digits,
        "batches": _batches,
        "symmetric": _symmetric,
        "proofs": _proofs,
    }
    parts += [write(results[key]) for key, write in writers.items() if results.get(key)]
    return "\n\n".join(parts) + "\n"


def _table(head: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(map(str, line))} |" for line in lines)


def _machine(machine: Mapping[str, Any]) -> str:
    words = ", ".join(f"{name} {version}" for name, version in machine["versions"].items())
    return (
        f"# Benchmarks of {machine['date']}\n\n{machine['processor']}, {machine['cores']} cores, {machine['memory']}; "
        f"{machine['system']}; load at the start {machine['load at start']}.\n\n{words}.\n\n"
        "Times are wall clock: the median of all runs, and in brackets the least and the greatest; the programs ran "
        "in turn."
    )


def _limits(limits: Sequence[Mapping[str, Any]]) -> str:
    rows = [
        [each["what"], f"{each['value']:.2f}", each["limit"], "yes" if each["kept"] else "**no**"] for each in limits
    ]
    return "## Limits\n\n" + _table(["", "measured", "at most", "kept"], rows)


def _spread(values: Sequence[float]) -> str:
    if not values:
        return ""
    low, middle, high = (_seconds(value) for value in (min(values), median(values), max(values)))
    return middle if len(values) == 1 else f"{middle} ({low} to {high})"


def _seconds(value: float) -> str:
    return f"{value:.3f}" if value < 1 else f"{value:.2f}" if value < 100 else f"{value:.0f}"


def share_of(entry: Mapping[str, Any]) -> float:
    """The median share of the proof in a solve."""
    return median(proof / whole for proof, whole in zip(entry["proof"], entry["processor"], strict=True))


def _symmetric(part: Mapping[str, Any]) -> str:
    rows = []
    for robot, entry in part.items():
        ours, theirs = entry["processor"], entry["msolve processor"]
        ratio = f"{median(ours) / median(theirs):.2f}" if theirs else ""
        rows.append([robot, _spread(ours), _spread(theirs), ratio, _spread(entry["seconds"]), _spread(entry["msolve"])])
    text = (
        "## Robots with much symmetry\n\nThe exact engine in this process, msolve as a whole process on its quickest "
        "system, in turn. Processor time, then wall clock.\n\n"
    )
    head = ["robot", "exact, processor", "msolve, processor", "ratio", "exact, seconds", "msolve, seconds"]
    return text + _table(head, rows)


def _proofs(part: Mapping[str, Any]) -> str:
    rows = [
        [robot, entry["route"] or "none", _spread(entry["processor"]), f"{share_of(entry):.2f}"]
        for robot, entry in part.items()
    ]
    text = "## Proofs of completeness\n\nProcessor time of the exact engine, and the share of the proof in it.\n\n"
    return text + _table(["robot", "route", "processor seconds", "share of the proof"], rows)


def _whole_processes(part: Mapping[str, Any]) -> str:
    titles = part["titles"]
    text = "## Whole processes\n\nFrom file to file, start of the program included.\n\n"
    text += _table(["program", "what it does"], list(part["titles"].values()))
    for robot, entries in part["robots"].items():
        rows = []
        for key, entry in entries.items():
            seconds = [each["seconds"] for each in entry["runs"]] if entry.get("is_answered") else []
            processor = [each["processor"] for each in entry["runs"]] if seconds else []
            memory = max((each["memory"] for each in entry["runs"]), default=0)
            rows.append(
                [
                    titles[key][0],
                    _spread(seconds),
                    _seconds(median(processor)) if processor else "",
                    f"{memory / MEGABYTE:.0f}" if memory else "",
                    entry["answer"],
                ]
            )
        text += f"\n\n### {robot}\n\n" + _table(["program", "seconds", "processor", "peak memory, MB", "answer"], rows)
    return text


def _engines(part: Mapping[str, Any]) -> str:
    rows = [
        [robot, *(f"{_spread(entry['seconds'])}{_by(key, entry)}" for key, entry in entries.items())]
        for robot, entries in part.items()
    ]
    keys = list(next(iter(part.values())))
    return "## In process\n\nThe engines inside a running Python, seconds.\n\n" + _table(["robot", *keys], rows)


def _by(key: str, entry: Mapping[str, Any]) -> str:
    return "" if entry["method"] == key else f", answered by {entry['method']}"


def _formulations(part: Mapping[str, Any]) -> str:
    text = "## Formulations"
    for robot, entries in part.items():
        rows = []
        for code, entry in entries.items():
            both = entry["engine"] and entry["msolve"]
            ratio = median(entry["engine"]) / median(entry["msolve"]) if both else None
            times = _spread(entry["engine"]), _spread(entry["msolve"])
            rows.append([code, *times, entry["answer"], "" if ratio is None else f"{ratio:.2f}"])
        head = ["formulation", "exact engine, in process", "msolve on the same system", "its answer", "ratio"]
        text += f"\n\n### {robot}\n\n" + _table(head, rows)
    return text


def _digits(part: Mapping[str, Any]) -> str:
    sizes = sorted({point["digits"] for points in part.values() for point in points})
    rows = []
    for key, points in part.items():
        found = {point["digits"]: point for point in points}
        cells = [
            f"{_seconds(found[size]['seconds'])} s, {found[size]['memory'] / MEGABYTE:.0f} MB" if size in found else ""
            for size in sizes
        ]
        slope = exponent(points)
        rows.append([key, *cells, "" if slope is None else f"{slope:.2f}"])
    head = ["whole process", *(f"{size} digits" for size in sizes), "exponent at the end"]
    return "## Growth with the digits of the data\n\nA 6-6 with random joints and lengths.\n\n" + _table(head, rows)


def _batches(part: Sequence[Mapping[str, Any]]) -> str:
    rows = []
    for each in part:
        row = [each["method"], each["rows"], each["workers"]]
        if "seconds" in each:
            row += [_seconds(each["seconds"]), f"{1000 * each['per_row']:.0f}", f"{each['memory'] / MEGABYTE:.0f}"]
            rows.append([*row, each["poses"]])
        else:
            rows.append([*row, "no answer", "", "", ""])
    head = ["method", "rows", "workers", "seconds", "milliseconds a row", "peak memory of all, MB", "real poses"]
    text = "## Batches\n\n`certify-poses sweep`, whole command, lengths around those of the model.\n\n"
    return text + _table(head, rows)


def draw(results: Mapping[str, Any], folder: Path) -> list[Path]:
    """The pictures for the parts that were run."""
    import matplotlib as mpl

    mpl.use("Agg")
    mpl.rcParams["svg.hashsalt"] = "benchmarks"
    drawn = []
    for key, picture in {"engines": _draw_stages, "digits": _draw_digits, "batches": _draw_batches}.items():
        if results.get(key):
            target = folder / f"{key}.svg"
            figure = picture(results[key])
            figure.savefig(target, metadata={"Date": None}, bbox_inches="tight")
            drawn.append(target)
    return drawn


def _draw_stages(part: Mapping[str, Any]) -> Figure:
    keys, robots = list(next(iter(part.values()))), list(part)[::-1]
    figure = _figure((9, (1.6 + 0.3 * len(robots)) * len(keys)))
    for axis, key in zip(figure.subplots(len(keys), 1, squeeze=False)[:, 0], keys, strict=True):
        stages = list(dict.fromkeys(stage for robot in part for stage in part[robot][key]["stages"]))
        left = [0.0] * len(robots)
        for index, stage in enumerate(stages):
            values = [median(part[robot][key]["stages"].get(stage, [0.0])) for robot in robots]
            hatch = HATCHES[index // COLOURS]
            axis.barh(robots, values, left=left, label=stage, color=f"C{index % COLOURS}", hatch=hatch)
            left = [one + other for one, other in zip(left, values, strict=True)]
        axis.set_title(f"{key} engine: time by stage")
        axis.set_xlabel("seconds")
        axis.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize="small")
    return figure


def _draw_digits(part: Mapping[str, Any]) -> Figure:
    figure = _figure((9, 3.5))
    left, right = figure.subplots(1, 2)
    for axis, key, unit, scale in ((left, "seconds", "seconds", 1.0), (right, "memory", "MB", MEGABYTE)):
        for name, points in part.items():
            sizes, values = [point["digits"] for point in points], [point[key] / scale for point in points]
            axis.loglog(sizes, values, "o-", label=name)
        axis.set_xlabel("digits of the data")
        axis.set_ylabel(unit)
        axis.legend()
    return figure


def _draw_batches(part: Sequence[Mapping[str, Any]]) -> Figure:
    figure = _figure((9, 3.5))
    left, right = figure.subplots(1, 2)
    lines = dict.fromkeys((each["method"], each["workers"]) for each in part)
    for axis, key, label, scale in (
        (left, "per_row", "milliseconds a row", 1e-3),
        (right, "memory", "MB, all processes", MEGABYTE),
    ):
        for method, workers in lines:
            points = [each for each in part if (each["method"], each["workers"]) == (method, workers) and key in each]
            sizes, values = [each["rows"] for each in points], [each[key] / scale for each in points]
            axis.loglog(sizes, values, "o-", label=f"{method}, workers: {workers}")
        axis.set_xlabel("rows")
        axis.set_ylabel(label)
        axis.legend(fontsize="small")
    return figure


def _figure(size: tuple[float, float]) -> Figure:
    from matplotlib.figure import Figure

    return Figure(figsize=size, layout="constrained")
