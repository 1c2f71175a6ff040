"""What a figure really draws: rendered pixels, texts and lines with their places."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from pkm_exact.pictures.style import plain_style


@dataclass
class Drawn:
    """A rendered figure: its pixels, and every text that was drawn with its extent."""

    pixels: Any
    width: float
    height: float
    texts: list[tuple[str, Bbox]] = field(default_factory=list)

    def edge_is_white(self) -> bool:
        """Whether nothing touches the edge of the picture: what is cut off would."""
        frame = (self.pixels[0], self.pixels[-1], self.pixels[:, 0], self.pixels[:, -1])
        return all((part == 255).all() for part in frame)

    def texts_inside(self) -> bool:
        """Whether every text lies in the picture."""
        return all(
            box.x0 >= 0 and box.y0 >= 0 and box.x1 <= self.width and box.y1 <= self.height for _, box in self.texts
        )


def render(figure: Figure) -> Drawn:
    """The figure drawn with Agg at its own resolution."""
    texts: list[tuple[str, Bbox]] = []
    drawn = Text.draw

    def record(self: Text, renderer: Any, *args: Any, **options: Any) -> None:
        if self.get_visible() and self.get_text():
            texts.append((self.get_text(), Text.get_window_extent(self, renderer)))
        drawn(self, renderer, *args, **options)

    canvas = FigureCanvasAgg(figure)
    with pytest.MonkeyPatch.context() as patch, plain_style():
        patch.setattr(Text, "draw", record)
        canvas.draw()
    pixels = np.asarray(canvas.buffer_rgba())
    return Drawn(pixels, pixels.shape[1], pixels.shape[0], texts)


def panels(figure: Figure) -> list[Axes]:
    """The axes that show the robot in a pose, in their order."""
    return [axes for axes in figure.axes if str(axes.get_label()).startswith("pose")]


def line(axes: Axes, name: str) -> list[tuple[float, ...]]:
    """The two ends of a leg or chain, in the robot's coordinates."""
    found = next(entry for entry in axes.lines if entry.get_gid() == name)
    data = found.get_data_3d() if hasattr(found, "get_data_3d") else found.get_data()
    return [tuple(map(float, end)) for end in zip(*data, strict=True)]


def on_paper(axes: Axes, point: Sequence[float]) -> tuple[float, float]:
    """Where a point of space, or of the plane, appears: in dots from the lower left corner."""
    if hasattr(axes, "get_proj"):
        x, y, _, w = axes.get_proj() @ [*point, 1.0]
        point = (x / w, y / w)
    across, upward = axes.transData.transform(point[:2])
    return float(across), float(upward)


def length(ends: Sequence[Sequence[float]]) -> float:
    """The distance of two points."""
    return math.dist(*ends)
