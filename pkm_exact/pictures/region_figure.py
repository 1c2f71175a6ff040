"""Pictures of pavings: what is good, what is not, and what is undecided; of three variables three sections."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations
from math import sqrt
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.errors import InputError
from pkm_exact.pictures import style
from pkm_exact.regions.chart import POSITIONS
from pkm_exact.regions.paving import INSIDE, OUTSIDE, UNDECIDED, Part, depths_at, leaves

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pkm_exact.regions.region_solver import RegionAnswer

COLOURS: Final = {INSIDE: "#0072B2", OUTSIDE: "#E8E8E8", UNDECIDED: "#E69F00"}
_NAMES: Final = {INSIDE: "inside", OUTSIDE: "outside", UNDECIDED: "undecided"}


def region_figure(answer: RegionAnswer) -> Figure:
    """The paving of a region, in ordinary coordinates; angles as tangents of their halves.

    Raises
    ------
    InputError
        If there are more than three variables.
    """
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    count = len(answer.question.chart.variables)
    if count > len(POSITIONS):
        raise InputError("--picture: regions of more than three variables are not drawn; leave it out")
    pairs = list(combinations(range(count), 2)) or [(0, 0)]
    with style.plain_style():
        figure = Figure(figsize=(4.6 * len(pairs), 4.8), layout="constrained")
        for place, (first, second) in enumerate(pairs, 1):
            axes = figure.add_subplot(1, len(pairs), place)
            _panel(axes, answer, first, second)
        handles = [Patch(color=colour, label=_NAMES[letter]) for letter, colour in COLOURS.items()]
        figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), frameon=False)
        figure.suptitle(style.drawable(answer.machine.name))
    return figure


def _panel(axes: Any, answer: RegionAnswer, first: int, second: int) -> None:
    from matplotlib.collections import PolyCollection

    chart = answer.question.chart
    others = [k for k in range(len(chart.variables)) if k not in (first, second)]
    shapes: dict[str, list[Any]] = {letter: [] for letter in COLOURS}
    for letter, part in leaves(answer.word, answer.axes, len(chart.variables)):
        ends = _ends(answer, part)
        if all(ends[k][0] <= Fraction(1, 2) < ends[k][1] for k in others):
            (a, b), (c, d) = _drawn(answer, first, ends), _drawn(answer, second, ends)
            if first == second:
                c, d = 0.0, 1.0
            shapes[letter].append([(a, c), (b, c), (b, d), (a, d)])
    for letter, found in shapes.items():
        axes.add_collection(PolyCollection(found, facecolors=COLOURS[letter], edgecolors="white", linewidths=0.15))
    axes.autoscale_view()
    axes.set_aspect("equal" if chart.has_fixed_orientation and first != second else "auto")
    axes.set_xlabel(_label(answer, first))
    axes.set_ylabel("" if first == second else _label(answer, second))
    if others:
        middle = sum(_scaled(answer, others[0], end) for end in (Fraction(0), Fraction(1))) / 2
        axes.set_title(f"{chart.variables[others[0]]} = {middle:.5g}", fontsize="medium")


def _ends(answer: RegionAnswer, part: Part) -> list[tuple[Fraction, Fraction]]:
    """The part's sides as shares of those of the box."""
    depths = depths_at(answer.axes, part.depth, len(part.places))
    return [
        (Fraction(place, 1 << depth), Fraction(place + 1, 1 << depth))
        for place, depth in zip(part.places, depths, strict=True)
    ]


def _scaled(answer: RegionAnswer, k: int, share: Fraction) -> float:
    chart = answer.question.chart
    low, high = chart.box[k]
    name = chart.variables[k]
    root = sqrt(answer.machine.metric[POSITIONS.index(name)]) if name in POSITIONS else 1.0
    return float(low + (high - low) * share) * root


def _drawn(answer: RegionAnswer, k: int, ends: list[tuple[Fraction, Fraction]]) -> tuple[float, float]:
    return _scaled(answer, k, ends[k][0]), _scaled(answer, k, ends[k][1])


def _label(answer: RegionAnswer, k: int) -> str:
    name = answer.question.chart.variables[k]
    if name not in POSITIONS:
        return f"tan({name}/2)"
    unit = "" if answer.machine.unit in ("", "1") else f" [{style.drawable(answer.machine.unit, 12)}]"
    return f"{name}{unit}"
