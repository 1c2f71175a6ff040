"""Least and greatest values over regions, as text and as JSON."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from pkm_exact.cli.region_report import ENLARGED, rounded_down, rounded_up
from pkm_exact.regions.chart import POSITIONS, label_of
from pkm_exact.regions.joint_ranges import common_range
from pkm_exact.roots.interval import Interval

if TYPE_CHECKING:
    from pkm_exact.geometry.limits import Pair
    from pkm_exact.regions.index_extremes import IndexRange
    from pkm_exact.regions.joint_ranges import JointRange
    from pkm_exact.regions.region_legs import RegionMachine
    from pkm_exact.regions.region_question import RegionQuestion
    from pkm_exact.regions.region_threshold import Threshold


def between(value: Interval) -> str:
    """Nine digits of each end, rounded outward."""
    return f"between {rounded_down(value.lo)} and {rounded_up(value.hi)}"


def ranges_text(machine: RegionMachine, asked: RegionQuestion, ranges: Sequence[JointRange]) -> str:
    """A few lines."""
    lines = [f"{machine.name}: joint values of the good poses of the region"]
    for found in ranges:
        lines.append(f"{found.name}: least {between(found.least)} {found.unit}".rstrip())
        lines.append(f"{' ' * len(found.name)}  greatest {between(found.greatest)}")
        lines.append(f"{' ' * len(found.name)}  stroke {between(found.stroke)}")
    if (common := common_range(ranges)) is not None:
        lines.append(f"one range for all: as long as {between(common.stroke)} {common.unit}".rstrip())
    if not all(found.is_precise for found in ranges):
        lines.append("undecided: not as precise as asked for with the work allowed; raise answer.steps or answer.boxes")
    if asked.enlarged:
        lines.append(ENLARGED)
    return "\n".join(lines) + "\n"


def index_text(machine: RegionMachine, asked: RegionQuestion, found: IndexRange) -> str:
    """A few lines."""
    lines = [f"{machine.name}: {found.name} at the good poses of the region"]
    for word, value, box in (("least", found.least, found.least_at), ("greatest", found.greatest, found.greatest_at)):
        lines.append(f"{word} {between(value)}")
        lines.append(f"  where {', '.join(_places(machine, asked, box))}")
    if not found.is_precise:
        lines.append("undecided: not as precise as asked for with the work allowed; raise answer.steps or answer.boxes")
    if asked.enlarged:
        lines.append(ENLARGED)
    return "\n".join(lines) + "\n"


def _places(machine: RegionMachine, asked: RegionQuestion, box: Sequence[Pair]) -> list[str]:
    found = []
    for name, (low, high) in zip(asked.chart.variables, box, strict=True):
        metric = machine.metric[POSITIONS.index(name)] if name in POSITIONS else 1
        label = label_of(name)
        told = f"{label} is between {rounded_down(low)} and {rounded_up(high)}"
        found.append(told if metric == 1 else f"{told} (in the model's metric)")
    return found


def index_json(machine: RegionMachine, asked: RegionQuestion, found: IndexRange) -> str:
    """The same as a JSON object; bounds are exact rationals as strings."""
    content = {
        "robot": machine.name,
        "answer": "extremes",
        "of": found.name,
        "variables": list(asked.chart.variables),
        "least": _ends(found.least),
        "least_at": [[str(low), str(high)] for low, high in found.least_at],
        "greatest": _ends(found.greatest),
        "greatest_at": [[str(low), str(high)] for low, high in found.greatest_at],
        "precise": found.is_precise,
        "enlarged": asked.enlarged,
    }
    return json.dumps(content, indent=1) + "\n"


def threshold_text(asked: RegionQuestion, found: Threshold) -> str:
    """A few lines."""
    names = ", ".join(asked.conditions.names)
    lines = [f"{found.proved.machine.name}: {names} in a region of {', '.join(asked.chart.variables)}"]
    for value, answer in zip((found.low, found.high), found.answers, strict=True):
        word = "proved: all poses of the region are good" if answer.is_proved else "no, with a counterexample"
        lines.append(f"{asked.answer.parameter} = {value}: {word}")
    lines.append("between these the answer changes; nothing is said of other values")
    if not found.is_precise:
        lines.append("undecided: not as precise as asked for with the work allowed; raise answer.steps or answer.boxes")
    return "\n".join(lines) + "\n"


def threshold_json(asked: RegionQuestion, found: Threshold) -> str:
    """The same as a JSON object; numbers are exact rationals as strings."""
    content = {
        "robot": found.proved.machine.name,
        "answer": "threshold",
        "parameter": asked.answer.parameter,
        "between": [str(found.low), str(found.high)],
        "verdicts": ["proved" if answer.is_proved else "refuted" for answer in found.answers],
        "precise": found.is_precise,
    }
    return json.dumps(content, indent=1) + "\n"


def ranges_json(machine: RegionMachine, asked: RegionQuestion, ranges: Sequence[JointRange]) -> str:
    """The same as a JSON object; bounds are exact rationals as strings."""
    common = common_range(ranges)
    content = {
        "robot": machine.name,
        "answer": "extremes",
        "of": asked.answer.of,
        "joint_values": [_object(found) for found in ranges],
        "common": None if common is None else _object(common),
        "precise": all(found.is_precise for found in ranges),
        "enlarged": asked.enlarged,
    }
    return json.dumps(content, indent=1) + "\n"


def _object(found: JointRange) -> dict[str, Any]:
    return {
        "name": found.name,
        "unit": found.unit,
        "least": _ends(found.least),
        "greatest": _ends(found.greatest),
        "stroke": _ends(found.stroke),
    }


def _ends(value: Interval) -> list[str]:
    return [str(value.lo), str(value.hi)]
