"""The words of a picture: headline, titles of panels, legend, and the key with axes and scale."""

from __future__ import annotations

from collections.abc import Sequence
from math import floor, log10
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.claim_wording import INCONSISTENT_NOTE, subject
from pkm_exact.geometry.kind_names import CONSTRAINTS_KIND, LINKS_KIND
from pkm_exact.geometry.machine import locked_at
from pkm_exact.pictures import style
from pkm_exact.pictures.camera import Camera
from pkm_exact.pictures.drawn_robot import BODY, PoseView, Scene
from pkm_exact.pictures.shapes import Shape
from pkm_exact.wording import counted

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.figure import Figure

KEY_WIDTH, KEY_HEIGHT = 1.75, 0.76
"""Inches that the key takes."""
LONG_ENTRY_WIDTH: Final = 1.9
"""The same where constraints have names."""
ENTRY_WIDTH: Final = 0.74
"""Inches that an entry of the legend takes."""
NEAREST: Final = "nearest to the pose that is meant"
_SIZE: Final = 8.5
_AXES: Final = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_SIGNS: Final = {1: "det J > 0", -1: "det J < 0", 0: "det J = 0", None: "det J not decided"}


def headline(name: str, kind: str, configuration: str | None) -> str:
    """Robot and configuration.

    Examples
    --------
    >>> headline("Rolland 6-6", "6-UPS", "home")
    'Rolland 6-6 (6-UPS), configuration home'
    """
    known = "" if kind in name else f" ({kind})"
    return f"{style.drawable(name)}{known}, {style.drawable(locked_at(kind, configuration))}"


def statement(scene: Scene) -> str:
    """How many poses there are, what is proved of their list, no more, and which is marked.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> pose = SimpleNamespace(number=1, is_nearest=True)
    >>> statement(SimpleNamespace(poses=(pose,), claim="complete", complex_solutions=6))
    '1 real pose of 6 complex solutions; complete; 1*: nearest to the pose that is meant'
    """
    marked = "".join(f"; {pose.number}*: {NEAREST}" for pose in scene.poses if pose.is_nearest)
    return f"{_of_the_list(scene)}{marked}"


def _of_the_list(scene: Scene) -> str:
    poses = counted(len(scene.poses), "real pose")
    if scene.claim == "complete":
        return f"{poses} of {counted(scene.complex_solutions, 'complex solution')}; complete"
    if scene.claim == "inconsistent":
        of = subject(of_legs=scene.kind not in (CONSTRAINTS_KIND, LINKS_KIND))
        return f"proved: {of.says(INCONSISTENT_NOTE)}"
    if scene.claim.startswith("positive-dimensional"):
        proved = "proved" if scene.claim.endswith("proved") else "detected, not proved"
        shown = f"{counted(len(scene.poses), 'isolated real pose')} listed"
        return f"complex poses on curves or surfaces ({proved}); {shown}"
    return f"{poses} listed; not proven complete"


def title(pose: PoseView, *, of: int | None = None) -> str:
    """Number, or which of how many, multiplicity, sign of the determinant of the leg Jacobian and its condition number.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> known = {"has_jacobian": True, "is_nearest": False}
    >>> title(SimpleNamespace(number=3, multiplicity=1, det_sign=-1, condition=12345.6, limits=None, **known))
    '3: det J < 0, cond 12300'
    >>> title(SimpleNamespace(number=1, multiplicity=2, det_sign=0, condition=None, limits="yes", **known))
    '1 (double): det J = 0, limits: yes'
    """
    star = "*" if pose.is_nearest else ""
    number = f"{pose.number}{star}" if of is None else f"pose {pose.number} of {of}"
    names = {1: "", 2: " (double)", 3: " (triple)", None: " (multiplicity not proved)"}
    multiple = names.get(pose.multiplicity, f" ({pose.multiplicity}-fold)")
    condition = "" if pose.condition is None else f", cond {rounded(pose.condition)}"
    kept = "" if pose.limits is None else f", limits: {pose.limits}"
    sign = f": {_SIGNS[pose.det_sign]}" if pose.has_jacobian else ""
    near = f", {NEAREST}" if star and of is not None else ""
    return f"{number}{multiple}{sign}{condition}{kept}{near}"


def rounded(value: float) -> str:
    """Three digits.

    >>> [rounded(x) for x in (14.8123, 3.0, 45392.4, 1.23456e9)]
    ['14.8', '3', '45400', '1.23e+09']
    """
    short = float(f"{value:.3g}")
    return f"{short:.0f}" if 100 <= short < 1e6 else f"{short:.3g}"


def leg_word(scene: Scene) -> str:
    """What a leg is called."""
    return "cable" if scene.cables else "leg"


def axis_names(scene: Scene) -> tuple[str, ...]:
    """The coordinates with their unit."""
    unit = "" if scene.unit in ("", "1") else f" [{style.drawable(scene.unit, 12)}]"
    return tuple(f"{name}{unit}" for name in ("xy" if scene.motion.is_planar else "xyz"))


def legend_rows(scene: Scene, width: float, *, key: bool = True) -> int:
    """How many rows the legend has, at most, on a figure of this width, with or without a key beside it."""
    entries = len(scene.legs) + 3 + len(scene.sorts) + bool(scene.sorts) + len(scene.shapes) + len(scene.parts)
    return -(-entries // _columns(scene, width, key))


def _columns(scene: Scene, width: float, key: bool) -> int:
    entry = LONG_ENTRY_WIDTH if scene.shapes or scene.parts else ENTRY_WIDTH
    return max(1, floor((width - KEY_WIDTH * key - 0.1) / entry))


def add_legend(figure: Figure, scene: Scene, *, ghosts: bool = False, key: bool = True) -> None:
    """The shared legend, at the bottom on the right; of ghosts the colours are those of signs and not of legs."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles: list[Artist] = []
    if not ghosts:
        width = 2.2 * (style.CABLE if scene.cables else 1)
        handles += [
            Line2D([], [], color=style.leg_colour(leg + 1), linewidth=width, label=f"{leg_word(scene)} {leg + 1}")
            for leg in range(len(scene.legs))
        ]
        for shape in scene.shapes:
            dashes: Any = style.SHAPE_DASHES[shape.kind]
            colour = style.leg_colour(shape.number)
            handles.append(Line2D([], [], color=colour, linestyle=dashes, label=_named(shape)))
        for part in scene.parts:
            colour, dashes = style.part_colour(part), style.SHAPE_DASHES[part.kind]
            if part.kind == BODY:
                label = style.drawable(part.name, 20)
                handles.append(Patch(facecolor=colour, edgecolor=colour, alpha=0.5, label=label))
            else:
                handles.append(Line2D([], [], color=colour, linestyle=dashes, label=part.kind))
    for sort in scene.sorts:
        handles.append(Line2D([], [], color=style.INK, linewidth=3.2, linestyle=style.DASHES[sort], label=sort))
    if scene.sorts:
        handles.append(Line2D([], [], color=style.INK, linewidth=0, marker="D", markersize=4, label="knee"))
    handles.append(Patch(facecolor=style.BASE_FILL, edgecolor=style.BASE_INK, label="base"))
    if ghosts:
        used = [sign for sign in (1, -1, 0, None) if any(pose.det_sign == sign for pose in scene.poses)]
        handles += [
            Patch(facecolor=style.SIGN_COLOURS[sign], alpha=0.6, label=_SIGNS[sign])
            for sign in used
            if scene.has_jacobians
        ]
    else:
        handles.append(Patch(facecolor=style.PLATFORM_FILL, edgecolor=style.INK, label="platform"))
    width, height = figure.get_size_inches()
    columns = min(_columns(scene, width, key), len(handles))
    figure.legend(
        # Matplotlib fills columns; read row by row they are in order.
        handles=[handle for column in range(columns) for handle in handles[column::columns]],
        loc="lower right",
        bbox_to_anchor=(1 - 0.08 / width, 0.04 / height),
        ncols=columns,
        frameon=False,
        fontsize=_SIZE,
        handlelength=1.3,
        handletextpad=0.4,
        columnspacing=1.0,
        borderaxespad=0,
        borderpad=0.2,
    )


def add_headline(figure: Figure, first: str, second: str) -> None:
    """Two lines at the top, as large as fits."""
    width, height = figure.get_size_inches()
    lines = (first, second)
    for line, drop, largest, weight in zip(lines, (0.1, 0.34), (12, 10), ("bold", "normal"), strict=True):
        size = min(largest, fitting(line, width - 0.2, bold=weight == "bold"))
        figure.text(0.5, 1 - drop / height, line, ha="center", va="top", fontsize=size, weight=weight)


LINE: Final = 0.16
"""Height of a line below the headline, in inches."""


def add_scales(figure: Figure, lines: Sequence[str]) -> None:
    """Lines below the headline that say what is drawn to which scale."""
    width, height = figure.get_size_inches()
    for place, line in enumerate(lines):
        size = min(8, fitting(line, width - 0.2))
        figure.text(0.5, 1 - (0.58 + LINE * place) / height, line, ha="center", va="top", fontsize=size)


def fitting(text: str, inches: float, *, bold: bool = False) -> float:
    """The greatest font size, in points, at which a line is not wider than this."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import TextPath

    extents = TextPath((0, 0), text, size=100, prop=FontProperties(weight="bold" if bold else "normal")).get_extents()
    return inches * 72 * 100 / max(float(extents.x1), 1.0)


def add_key(figure: Figure, scene: Scene, shot: Camera, scale: float) -> None:
    """The directions of the axes and a bar of known length, at the bottom on the left; scale in inches per unit."""
    width, height = figure.get_size_inches()
    key = figure.add_axes((0.05 / width, 0, KEY_WIDTH / width, KEY_HEIGHT / height), label="key")
    key.set_xlim(0, KEY_WIDTH)
    key.set_ylim(0, KEY_HEIGHT)
    key.set_axis_off()
    for name, axis in zip("xy" if scene.motion.is_planar else "xyz", _AXES, strict=False):
        x, y = shot.flat(axis)
        start = (0.36, KEY_HEIGHT / 2)
        if x * x + y * y > 0.01:
            arrow = {"arrowstyle": "->", "color": style.INK, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0}
            key.annotate("", (start[0] + 0.22 * x, start[1] + 0.22 * y), start, arrowprops=arrow)
        key.text(start[0] + 0.29 * x, start[1] + 0.29 * y, name, ha="center", va="center", fontsize=7)
    length = round_length(0.9 / scale)
    key.plot([0.76, 0.76 + length * scale], [0.25, 0.25], color=style.INK, linewidth=2, solid_capstyle="butt")
    text = f"length {length:g}" if scene.unit in ("", "1") else f"{length:g} {style.drawable(scene.unit, 8)}"
    key.text(0.76, 0.32, text, fontsize=_SIZE, va="bottom", ha="left")


def round_length(longest: float) -> float:
    """The longest of 1, 2, 5, 10, .. (times a power of ten) that is not longer.

    >>> [round_length(x) for x in (0.7, 19, 5000)]
    [0.5, 10.0, 5000.0]
    """
    power = 10.0 ** floor(log10(longest))
    return power * max(step for step in (1, 2, 5) if step * power <= longest * (1 + 1e-9))


def _named(shape: Shape) -> str:
    """The name of a constraint, short, and what it is."""
    return f"{style.drawable(shape.name, 12)} ({shape.kind})"
