"""Pictures of pavings: what is good, what is not, and what is undecided.

Of three variables the surface of what is proved to be good is drawn, and three sections through the middle.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations
from math import sqrt
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.errors import InputError
from pkm_exact.pictures import style
from pkm_exact.pictures.region_surface import MOST_FACES, part_ends, surface
from pkm_exact.regions.chart import POSITIONS, label_of
from pkm_exact.regions.paving import INSIDE, OUTSIDE, UNDECIDED, leaves

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pkm_exact.regions.chart import Chart
    from pkm_exact.regions.region_solver import RegionAnswer

COLOURS: Final = {INSIDE: "#0072B2", OUTSIDE: "#E8E8E8", UNDECIDED: "#E69F00"}
_SHADES: Final = ("#00598E", "#3392C8", "#7FBDE0")
_NAMES: Final = {INSIDE: "inside", OUTSIDE: "outside", UNDECIDED: "undecided"}


def require_drawable(chart: Chart) -> None:
    """Refuse to draw a region of more than three variables, or without matplotlib."""
    style.require_matplotlib()
    if len(chart.variables) > len(POSITIONS):
        raise InputError("--picture: regions of more than three variables are not drawn; leave it out")


def region_figure(answer: RegionAnswer) -> Figure:
    """The paving of a region, in ordinary coordinates; angles as tangents of their halves.

    Raises
    ------
    InputError
        If there are more than three variables.
    """
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    require_drawable(answer.question.chart)
    count = len(answer.question.chart.variables)
    pairs = list(combinations(range(count), 2)) or [(0, 0)]
    rows = columns = 2 if count == len(POSITIONS) else 1
    with style.plain_style():
        figure = Figure(figsize=(4.6 * columns, 4.8 * rows), layout="constrained")
        for place, (first, second) in enumerate(pairs, 1):
            axes = figure.add_subplot(rows, columns, place)
            _panel(axes, answer, first, second)
        if count == len(POSITIONS):
            _solid(figure.add_subplot(rows, columns, rows * columns, projection="3d"), answer)
        handles = [Patch(color=colour, label=_NAMES[letter]) for letter, colour in COLOURS.items()]
        figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), frameon=False)
        figure.suptitle(style.drawable(answer.machine.name))
    return figure


def _solid(axes: Any, answer: RegionAnswer) -> None:
    """The surface of the parts inside, each face in the shade of its direction."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    faces = surface(answer)
    if len(faces) > MOST_FACES:
        raise InputError(
            f"--picture: the surface has {len(faces)} faces, more than {MOST_FACES}; lower answer.steps or leave it out"
        )
    corners, shades = [], []
    for axis, _, box in faces:
        first, second = (k for k in range(3) if k != axis)
        ends = [_drawn(answer, k, pair) for k, pair in enumerate(box)]
        face = []
        for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)):
            corner = [ends[axis][0]] * 3
            corner[first], corner[second] = ends[first][i], ends[second][j]
            face.append(corner)
        corners.append(face)
        shades.append(_SHADES[axis])
    axes.add_collection3d(Poly3DCollection(corners, facecolors=shades, edgecolors="white", linewidths=0.1))
    whole = [_drawn(answer, k, (Fraction(0), Fraction(1))) for k in range(3)]
    axes.set(xlim=whole[0], ylim=whole[1], zlim=whole[2])
    if answer.question.chart.has_fixed_orientation:
        axes.set_box_aspect([high - low for low, high in whole])
    axes.set_xlabel(_label(answer, 0))
    axes.set_ylabel(_label(answer, 1))
    axes.set_zlabel(_label(answer, 2))
    axes.set_title("inside" if faces else "nothing is inside", fontsize="medium")


def _panel(axes: Any, answer: RegionAnswer, first: int, second: int) -> None:
    from matplotlib.collections import PolyCollection

    chart = answer.question.chart
    others = [k for k in range(len(chart.variables)) if k not in (first, second)]
    shapes: dict[str, list[Any]] = {letter: [] for letter in COLOURS}
    for letter, part in leaves(answer.word, answer.axes, len(chart.variables)):
        ends = part_ends(answer, part)
        if all(ends[k][0] <= Fraction(1, 2) < ends[k][1] for k in others):
            (a, b), (c, d) = _drawn(answer, first, ends[first]), _drawn(answer, second, ends[second])
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


def _scaled(answer: RegionAnswer, k: int, share: Fraction) -> float:
    chart = answer.question.chart
    low, high = chart.box[k]
    name = chart.variables[k]
    root = sqrt(answer.machine.metric[POSITIONS.index(name)]) if name in POSITIONS else 1.0
    return float(low + (high - low) * share) * root


def _drawn(answer: RegionAnswer, k: int, ends: tuple[Fraction, Fraction]) -> tuple[float, float]:
    return _scaled(answer, k, ends[0]), _scaled(answer, k, ends[1])


def _label(answer: RegionAnswer, k: int) -> str:
    name = answer.question.chart.variables[k]
    if name not in POSITIONS:
        return label_of(name)
    unit = "" if answer.machine.unit in ("", "1") else f" [{style.drawable(answer.machine.unit, 12)}]"
    return f"{name}{unit}"
