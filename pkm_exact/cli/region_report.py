"""Answers about regions, as text, as JSON and as pictures."""

from __future__ import annotations

import json
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from math import isqrt
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.regions.arc_area import arc_area
from pkm_exact.regions.chart import POSITIONS, label_of
from pkm_exact.regions.largest_region import LargestAnswer
from pkm_exact.regions.region_components import components
from pkm_exact.regions.region_solver import RegionAnswer
from pkm_exact.roots.interval import Interval

if TYPE_CHECKING:
    from pathlib import Path

    from pkm_exact.regions.region_legs import RegionMachine
    from pkm_exact.regions.singularity_locus import Locus

ENLARGED: Final = "note: the region is enlarged by less than 2^-40 of its size, so that its numbers are rational"
_DIGITS: Final = 9
_MANY: Final = 24
_MEASURES: Final = {1: "length", 2: "area", 3: "volume"}


def is_undecided(answer: RegionAnswer | LargestAnswer) -> bool:
    """Whether the work allowed did not suffice for an answer."""
    if isinstance(answer, LargestAnswer):
        return answer.proved is None
    return answer.question.answer.kind == "all" and not answer.is_proved and answer.counterexample is None


def verdict(answer: RegionAnswer) -> str:
    """One word: proved, refuted, undecided or map."""
    if answer.question.answer.kind == "map":
        return "map"
    return "proved" if answer.is_proved else "undecided" if answer.counterexample is None else "refuted"


def as_text(answer: RegionAnswer | LargestAnswer) -> str:
    """A few lines."""
    if isinstance(answer, LargestAnswer):
        return _largest_text(answer)
    asked = ", ".join(answer.question.conditions.names)
    lines = [f"{answer.machine.name}: {asked} in a region of {', '.join(answer.question.chart.variables)}"]
    word = verdict(answer)
    counts = ", ".join(f"{number} {name}" for name, number in answer.counts.items())
    if word == "proved":
        lines.append("proved: all poses of the region are good")
    elif answer.counterexample is not None:
        lines.append(f"no: this does not hold: {answer.counterexample.reason}")
        lines += [f"  at {_point(answer, point)}" for point in answer.counterexample.points]
    elif word == "undecided":
        lines.append("undecided: neither proved nor refuted with the work allowed; raise answer.steps or answer.boxes")
    lines.append(f"parts: {counts}")
    if word == "undecided":
        lines.append(f"undecided share of the region's box: {float(answer.shares['undecided']):.3g}")
    if (bounds := measure(answer)) is not None:
        name = _MEASURES[len(answer.question.chart.variables)]
        lines.append(f"{name} of what is good: between {rounded_down(bounds.lo)} and {rounded_up(bounds.hi)}")
    arcs = None if word != "map" else arc_area(answer.machine, answer.question)
    if arcs is not None:
        low, high = _ends(arcs.area)
        lines.append(f"area by arcs and segments: between {low} and {high}, in {arcs.pieces} pieces")
    if word == "map":
        found = components(answer)
        lines.append(
            f"separate pieces: at least {found.separated}; the parts inside are {found.connected} connected pieces"
        )
    if answer.question.enlarged:
        lines.append(ENLARGED)
    return "\n".join(lines) + "\n"


def _largest_text(answer: LargestAnswer) -> str:
    if answer.proved is None:
        return "no size is proved with the work allowed\n"
    wanted = answer.proved.question.answer
    what = "edge" if wanted.shape == "cube" else "radius"
    lines = [f"{answer.proved.machine.name}: {', '.join(answer.proved.question.conditions.names)}"]
    lines.append(f"proved: all poses of the {wanted.shape} with {what} {rounded_down(answer.size)} are good")
    if answer.refused is None or answer.refused_size is None:
        lines.append("larger sizes were not tried")
    else:
        word = "refuted" if answer.refused.counterexample is not None else "not proved"
        lines.append(f"{word}: {what} {rounded_up(answer.refused_size)}")
    if (distance := answer.distance) is not None:
        low, high = rounded_down(distance.lo), rounded_up(distance.hi)
        lines.append(f"distance of the nearest singular pose of this orientation: between {low} and {high}")
    if answer.proved.question.enlarged:
        lines.append(ENLARGED)
    return "\n".join(lines) + "\n"


def measure(answer: RegionAnswer) -> Interval | None:
    """Bounds of the ordinary length, area or volume of what is good; None where there is none."""
    if answer.measures is None:
        return None
    scale = 2**64
    root = isqrt(answer.measure_square * scale * scale)
    exact = root * root == answer.measure_square * scale * scale
    low, high = Fraction(root, scale), Fraction(root + (not exact), scale)
    return Interval(answer.measures[0] * low, answer.measures[1] * high)


def _ends(interval: Interval) -> tuple[str, str]:
    """Decimals with many digits, below and above."""
    return _rounded(interval.lo, ROUND_FLOOR, _MANY), _rounded(interval.hi, ROUND_CEILING, _MANY)


def rounded_down(value: Fraction) -> str:
    """Nine digits, rounded down.

    >>> rounded_down(Fraction(2, 3)), rounded_up(Fraction(2, 3)), rounded_down(Fraction(0))
    ('0.666666666', '0.666666667', '0')
    """
    return _rounded(value, ROUND_FLOOR)


def rounded_up(value: Fraction) -> str:
    """The same, rounded up."""
    return _rounded(value, ROUND_CEILING)


def _rounded(value: Fraction, way: str, digits: int = _DIGITS) -> str:
    context = Context(prec=digits, rounding=way)
    return f"{context.divide(Decimal(value.numerator), Decimal(value.denominator)).normalize(context):f}"


def _point(answer: RegionAnswer, point: tuple[Fraction, ...]) -> str:
    chart = answer.question.chart
    texts = []
    for name, value in zip(chart.variables, point, strict=True):
        metric = answer.machine.metric[POSITIONS.index(name)] if name in POSITIONS else 1
        label = label_of(name)
        texts.append(f"{label} = {value}" if metric == 1 else f"{label} = {value} (in the model's metric)")
    return ", ".join(texts)


def as_json(answer: RegionAnswer | LargestAnswer) -> str:
    """The answer as a JSON object; bounds are exact rationals as strings."""
    if isinstance(answer, LargestAnswer):
        content: dict[str, Any] = {
            "answer": "largest",
            "size": str(answer.size),
            "next_size": None if answer.refused_size is None else str(answer.refused_size),
            "next_verdict": None if answer.refused is None else verdict(answer.refused),
            "distance": None if answer.distance is None else [str(answer.distance.lo), str(answer.distance.hi)],
            "proved": None if answer.proved is None else as_object(answer.proved),
        }
    else:
        content = as_object(answer)
    return json.dumps(content, indent=1) + "\n"


def as_object(answer: RegionAnswer) -> dict[str, Any]:
    """One answer."""
    chart, bounds = answer.question.chart, measure(answer)
    is_map = answer.question.answer.kind == "map"
    found = components(answer) if is_map else None
    arcs = arc_area(answer.machine, answer.question) if is_map else None
    return {
        "robot": answer.machine.name,
        "answer": answer.question.answer.kind,
        "verdict": verdict(answer),
        "conditions": list(answer.question.conditions.names),
        "variables": list(chart.variables),
        "box": [[str(low), str(high)] for low, high in chart.box],
        "counterexample": None
        if answer.counterexample is None
        else {
            "reason": answer.counterexample.reason,
            "points": [[str(x) for x in point] for point in answer.counterexample.points],
        },
        "parts": answer.counts,
        "shares": {name: str(share) for name, share in answer.shares.items()},
        "measure": None if bounds is None else [str(bounds.lo), str(bounds.hi)],
        "components": None if found is None else {"at_least": found.separated, "inside_pieces": found.connected},
        "arcs": None if arcs is None else {"area": list(_ends(arcs.area)), "pieces": arcs.pieces},
        "enlarged": answer.question.enlarged,
    }


def locus_text(machine: RegionMachine, found: Locus) -> str:
    """Where a machine is singular, in a few lines."""
    lines = [f"{machine.name}: singular poses, by {', '.join(found.variables)}"]
    if found.is_identical:
        lines.append("everywhere: the determinant is identically 0")
    elif not found.factors:
        lines.append("no factor is common" if found.is_redundant else "nowhere: the determinant is never 0")
    lines += [f"{factor} = 0" + (f", {power} times" if power > 1 else "") for factor, power in found.factors]
    if found.points is not None:
        name = found.variables[0]
        lines += [f"in the region: {name} = {point}" for point in found.points]
        lines += [
            f"not decided: {name} from {rounded_down(part.lo)} to {rounded_up(part.hi)}, where a rod only just reaches "
            "or singular poses are too near each other"
            for part in found.undecided
        ]
        if not found.points and not found.undecided:
            lines.append("none in the region")
    if set(machine.metric) != {1}:
        lines.append(f"note: coordinates are those of the model, in the metric {', '.join(map(str, machine.metric))}")
    if found.is_redundant:
        lines.append("note: common to all determinants; more equations than freedoms may fail in smaller sets besides")
    return "\n".join(lines) + "\n"


def locus_json(machine: RegionMachine, found: Locus) -> str:
    """The same as a JSON object."""
    points = None if found.points is None else [[str(point.lo), str(point.hi)] for point in found.points]
    undecided = [[str(part.lo), str(part.hi)] for part in found.undecided]
    content = {
        "robot": machine.name,
        "answer": "locus",
        "variables": list(found.variables),
        "factors": [{"polynomial": factor, "power": power} for factor, power in found.factors],
        "identical": found.is_identical,
        "points": points,
        "undecided": undecided,
        "redundant": found.is_redundant,
        "metric": list(machine.metric),
    }
    return json.dumps(content, indent=1) + "\n"


def draw(answer: RegionAnswer | LargestAnswer, path: Path) -> None:
    """Write a picture of the paving."""
    from pkm_exact.cli import arguments
    from pkm_exact.errors import InputError
    from pkm_exact.pictures.output import figure_bytes, picture_format
    from pkm_exact.pictures.region_figure import region_figure
    from pkm_exact.pictures.style import require_matplotlib

    suffix = picture_format(path)
    require_matplotlib()
    shown = answer.proved if isinstance(answer, LargestAnswer) else answer
    if shown is None:
        raise InputError("--picture: there is nothing to draw; leave it out")
    arguments.write_output(str(path), figure_bytes(region_figure(shown), suffix, dpi=150))
