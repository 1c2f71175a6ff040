"""Axes of the right scale at the right place, and where the panels of a grid stand. Measures on paper are in inches."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from math import ceil, hypot
from typing import TYPE_CHECKING, Final

from pkm_exact.errors import InputError
from pkm_exact.pictures.camera import Camera, View, Window
from pkm_exact.pictures.captions import KEY_HEIGHT, legend_rows
from pkm_exact.pictures.drawn_robot import Point, Scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

HEADER: Final = 0.62
TITLE: Final = 0.24
GAP: Final = 0.12
NARROWEST: Final = 5.2
"""Figures are at least this wide unless a size is given."""
SMALLEST_PANEL: Final = 0.7
END_ON: Final = 0.2
"""Axes that appear shorter than this, for length 1, have no numbers."""
LARGE_WIDTH: Final = 7.5
_BESIDE: Final = {True: (0.95, 0.6), False: (1.5, 1.1)}
"""Room for numbers beside the axes, across and upwards (key: planar)."""


@dataclass(frozen=True)
class Rectangle:
    """A part of the figure."""

    left: float
    bottom: float
    width: float
    height: float


def footer(scene: Scene, width: float, *, key: bool = True) -> float:
    """The height of key and legend."""
    return max(KEY_HEIGHT + 0.02 if key else 0.0, 0.1 + 0.19 * legend_rows(scene, width, key=key))


@dataclass(frozen=True)
class Grid:
    """Panels row by row.

    Attributes
    ----------
    size : tuple of 2 float
        Width and height of the figure.
    columns, rows : int
    panel : tuple of 2 float
        Width and height of the drawing in a panel, below its title.
    scale : float
        Inches per unit of length.
    below : float
        Height of the footer.
    """

    size: tuple[float, float]
    columns: int
    rows: int
    panel: tuple[float, float]
    scale: float
    below: float

    def cell(self, place: int) -> Rectangle:
        """The drawing of the panel at this place, from 0."""
        row, column = divmod(place, self.columns)
        across = (self.size[0] - self.columns * (self.panel[0] + GAP) + GAP) / 2
        bottom = self.below + (self.rows - 1 - row) * (self.panel[1] + TITLE + GAP)
        return Rectangle(across + column * (self.panel[0] + GAP), bottom, *self.panel)


def grid(scene: Scene, frame: Window, size: tuple[float, float] | None) -> Grid:
    """The arrangement of the panels of all poses, as large as fits on a size, or on one of a convenient shape."""
    count = max(1, len(scene.poses))
    if size is None:
        return min((_free_grid(scene, frame, count, columns) for columns in range(1, count + 1)), key=_strangeness)
    grids = [_fitted_grid(scene, frame, count, columns, size) for columns in range(1, count + 1)]
    best = max(grids, key=lambda grid: min(grid.panel[0] / frame.width, grid.panel[1] / frame.height))
    if min(best.panel) < SMALLEST_PANEL:
        raise InputError(
            f"size: {size[0]:g},{size[1]:g} inches are too small for {count} poses; give more, or one pose"
        )
    return best


def _free_grid(scene: Scene, frame: Window, count: int, columns: int) -> Grid:
    across = 2.6 if count <= 4 else 1.75 if count <= 20 else 1.5
    scale = across / max(frame.width, 0.8 * frame.height)
    panel = (max(scale * frame.width, 0.75 * across), scale * frame.height)
    rows = ceil(count / columns)
    width = max(NARROWEST, columns * (panel[0] + GAP) + GAP)
    below = footer(scene, width)
    height = HEADER + rows * (panel[1] + TITLE + GAP) + below
    return Grid((width, height), columns, rows, panel, 0.97 * scale, below)


def _strangeness(grid: Grid) -> tuple[float, float]:
    """How far from a sheet of 4 to 3 a figure is, by its sides; empty panels count too."""
    ratio = grid.size[0] / grid.size[1] / (4 / 3)
    return max(ratio, 1 / ratio) * grid.columns * grid.rows, grid.size[0]


def _fitted_grid(scene: Scene, frame: Window, count: int, columns: int, size: tuple[float, float]) -> Grid:
    rows, below = ceil(count / columns), footer(scene, size[0])
    across = (size[0] - GAP) / columns - GAP
    upward = (size[1] - HEADER - below) / rows - TITLE - GAP
    scale = 0.97 * min(across / frame.width, upward / frame.height)
    return Grid(size, columns, rows, (across, upward), scale, below)


def panel(
    figure: Figure,
    scene: Scene,
    view: View,
    shot: Camera,
    where: Rectangle,
    middle: tuple[float, float],
    scale: float,
    points: Sequence[Point],
) -> Axes:
    """Axes without frame on which one unit of length is ``scale`` inches long and ``middle`` is in the middle."""
    if scene.motion.is_planar:
        axes = figure.add_axes(_fractions(figure, where))
        axes.set_xlim(middle[0] - where.width / scale / 2, middle[0] + where.width / scale / 2)
        axes.set_ylim(middle[1] - where.height / scale / 2, middle[1] + where.height / scale / 2)
    else:
        axes = _spatial_panel(figure, view, shot, where, middle, scale, points)
    axes.set_axis_off()
    return axes


def _spatial_panel(
    figure: Figure,
    view: View,
    shot: Camera,
    where: Rectangle,
    middle: tuple[float, float],
    scale: float,
    points: Sequence[Point],
) -> Axes:
    """Matplotlib's axes in space are square on the paper, around the middle of the bounding box."""
    lows, highs = bounds(points)
    centre = tuple((low + high) / 2 for low, high in zip(lows, highs, strict=True))
    reach = max(high - low for low, high in zip(lows, highs, strict=True)) / 2 or 1.0
    across, upward = shot.flat(centre)
    side = max(where.width, where.height)
    square = Rectangle(
        where.left + where.width / 2 + scale * (across - middle[0]) - side / 2,
        where.bottom + where.height / 2 + scale * (upward - middle[1]) - side / 2,
        side,
        side,
    )
    limits = [(x - reach, x + reach) for x in centre]
    return spatial_axes(figure, square, view, shot, limits, scale)


def spatial_axes(
    figure: Figure, square: Rectangle, view: View, shot: Camera, limits: Sequence[tuple[float, float]], scale: float
) -> Axes:
    """Axes in space in a square, with these limits and this scale, seen without perspective."""
    from mpl_toolkits.mplot3d import Axes3D, proj3d

    axes = Axes3D(figure, _fractions(figure, square), computed_zorder=False, proj_type="ortho")
    added: Axes = figure.add_axes(axes)
    axes.patch.set_visible(False)
    axes.set(xlim=limits[0], ylim=limits[1], zlim=limits[2])
    axes.view_init(elev=view.tilt, azim=view.azimuth)
    spans = [high - low for low, high in limits]
    axes.set_box_aspect(spans)
    # Without perspective the picture grows with the zoom: measure it once at zoom 1, and ask for the rest.
    centre = [(low + high) / 2 for low, high in limits]
    aside = [c + max(spans) * r for c, r in zip(centre, shot.right, strict=True)]
    matrix = axes.get_proj()
    start, end = (proj3d.proj_transform(*point, matrix)[0] for point in (centre, aside))
    measured = (end - start) / axes.viewLim.width * square.width / max(spans)
    axes.set_box_aspect(spans, zoom=scale / measured)
    return added


def padded_bounds(points: Sequence[Point]) -> list[tuple[float, float]]:
    """Limits of the axes with some room around the points, never a very flat box."""
    lows, highs = bounds(points)
    widest = max(high - low for low, high in zip(lows, highs, strict=True)) or 1.0
    pads = [max(0.04 * widest, (0.2 * widest - (high - low)) / 2) for low, high in zip(lows, highs, strict=True)]
    return [(low - pad, high + pad) for low, high, pad in zip(lows, highs, pads, strict=True)]


def large_size(scene: Scene, shot: Camera, limits: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """A convenient size of a figure with one drawing."""
    across, upward = _extent(shot, limits)
    width, beside = LARGE_WIDTH, _BESIDE[scene.motion.is_planar]
    wanted = upward * (width - 0.2 - beside[0]) / across + beside[1]
    return width, min(max(wanted, 3.0), 8.0) + HEADER + footer(scene, width, key=False)


def large_axes(
    figure: Figure, scene: Scene, view: View, shot: Camera, area: Rectangle, limits: Sequence[tuple[float, float]]
) -> Axes:
    """Axes with these limits, as large as fits into an area with the numbers beside them."""
    # In space, numbers stand farther away from larger axes.
    planar = scene.motion.is_planar
    beside = [max(least, 0 if planar else 0.14 * max(area.width, area.height)) for least in _BESIDE[planar]]
    if min(area.width, area.height) < SMALLEST_PANEL + max(beside):
        raise InputError("size: too small for a drawing with its axes; give more inches")
    across, upward = _extent(shot, limits)
    scale = min((area.width - beside[0]) / across, (area.height - beside[1]) / upward)
    if scene.motion.is_planar:
        return _planar_axes(figure, area, limits, scale)
    side = max(area.width, area.height)
    left, bottom = area.left + (area.width - side) / 2, area.bottom + (area.height - side) / 2
    axes = spatial_axes(figure, Rectangle(left, bottom, side, side), view, shot, limits, scale)
    axes.tick_params(labelsize=8)
    for axis, name in enumerate("xyz"):
        if not seen_along(shot, axis):
            axes.set(**{f"{name}ticks": []})
    return axes


def seen_along(shot: Camera, axis: int) -> bool:
    """Whether numbers on an axis do not fall on each other: it does not point at the viewer."""
    return hypot(shot.right[axis], shot.up[axis]) > END_ON


def _extent(shot: Camera, limits: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """Width and height of a box on the paper, in the robot's unit."""
    corners = [shot.flat(corner) for corner in product(*limits)]
    across, upward = (max(x) - min(x) for x in zip(*corners, strict=True))
    return across, upward


def _planar_axes(figure: Figure, area: Rectangle, limits: Sequence[tuple[float, float]], scale: float) -> Axes:
    width, height = area.width - _BESIDE[True][0], area.height - _BESIDE[True][1]
    inner = Rectangle(area.left + 0.75, area.bottom + 0.5, width, height)
    axes = figure.add_axes(_fractions(figure, inner))
    (x, y), (u, v) = limits[:2]
    axes.set_xlim((x + y - width / scale) / 2, (x + y + width / scale) / 2)
    axes.set_ylim((u + v - height / scale) / 2, (u + v + height / scale) / 2)
    axes.tick_params(labelsize=8)
    return axes


def bounds(points: Sequence[Point]) -> tuple[Point, Point]:
    """The least and the greatest coordinates."""
    x, y, z = zip(*points, strict=True)
    return (min(x), min(y), min(z)), (max(x), max(y), max(z))


def _fractions(figure: Figure, where: Rectangle) -> tuple[float, float, float, float]:
    width, height = figure.get_size_inches()
    return where.left / width, where.bottom / height, where.width / width, where.height / height
