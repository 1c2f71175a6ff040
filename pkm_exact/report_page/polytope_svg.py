"""Polytopes of two or three dimensions as SVG, with the ellipse or ellipsoid in them: drawn in doubles, for the eye.

Components of different units, velocities beside turns, are each drawn to their own scale: the greatest value of each
stands at the end of its axis.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.report_page.markup import Markup, element

if TYPE_CHECKING:
    from pkm_exact.pictures.statics_picture import StaticsPanel

Array = NDArray[np.float64]

SIZE: Final = 240
_RADIUS: Final = 0.4 * SIZE
_VIEW: Final = np.array([[-0.8, 0.6, 0.0], [-0.3, -0.4, 0.8660254037844386]])
"""Orthogonal projection of space: to the right, and up."""


def polytope_svg(panel: StaticsPanel) -> Markup:
    """The picture of a panel.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> from pkm_exact.pictures.statics_picture import statics_panels
    >>> at = Robot.load("models/3-rpr-merlet-p.toml").at({"position": [5, "9/2"], "half_tangent": "1/3"})
    >>> print(polytope_svg(statics_panels(at.measures(speeds=1))[0])[:56])
    <svg viewBox="0 0 240 240" class="polytope" role="img" a
    """
    polytope = panel.polytope
    points = np.array([[_double(value) for value in vertex] for vertex in polytope.vertices])
    points = points * np.sqrt([float(square) for square in polytope.squares])
    scales = _scales(points, panel.names)
    view = _VIEW if points.shape[1] == 3 else np.eye(2)
    flat = (points / scales) @ view.T
    fit = _RADIUS / max(float(np.abs(flat).max()), 1e-12)
    faces = [list(facet.vertices) for facet in polytope.facets] if points.shape[1] == 3 else [list(range(len(points)))]
    parts = [_polygon(flat[face] * fit) for face in sorted(faces)]
    if panel.ellipsoid is not None:
        shape = np.asarray(panel.ellipsoid) / np.outer(scales, scales)
        parts.append(_outline(view @ shape @ view.T * fit * fit))
    greatest = np.abs(points).max(axis=0)
    for k, name in enumerate(panel.names):
        end = np.zeros(points.shape[1])
        end[k] = greatest[k] / scales[k]
        parts += _axis((end @ view.T) * fit, f"{name} {greatest[k]:.3g}")
    label = f"{panel.title}: {len(polytope.vertices)} vertices, {len(polytope.facets)} facets"
    return element("svg", *parts, viewBox=f"0 0 {SIZE} {SIZE}", cls="polytope", role="img", aria_label=label)


def _double(value: Any) -> float:
    return float(value.mid() if hasattr(value, "mid") else value)


def _scales(points: Array, names: Sequence[str]) -> Array:
    """By what each component is divided: by one number if all have one unit."""
    greatest = np.maximum(np.abs(points).max(axis=0), 1e-300)
    return np.full(len(names), greatest.max()) if len({name[0] for name in names}) == 1 else greatest


def _place(point: Array) -> str:
    return f"{SIZE / 2 + point[0] + 0.0:.1f},{SIZE / 2 - point[1] + 0.0:.1f}"


def _polygon(points: Array) -> Markup:
    """A face by its corners, one after another around their middle."""
    around = points - points.mean(axis=0)
    order = np.argsort(np.arctan2(around[:, 1], around[:, 0]), kind="stable")
    return element("polygon", points=" ".join(_place(points[k]) for k in order), cls="face")


def _outline(shape: Array) -> Markup:
    """The ellipse x^T S^-1 x = 1: the outline of a projected ellipsoid."""
    turn = np.linspace(0, 2 * np.pi, 73)
    values, vectors = np.linalg.eigh(shape)
    root = (vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T  # does not depend on the signs of the vectors
    points = (root @ np.array([np.cos(turn), np.sin(turn)])).T
    return element("polyline", points=" ".join(map(_place, points)), cls="ellipsoid")


def _axis(end: Array, label: str) -> list[Markup]:
    line = element("polyline", points=f"{_place(np.zeros(2))} {_place(end)}", cls="measure")
    beyond = end * (1 + 14 / max(float(np.hypot(*end)), 1e-12))
    x, y = np.clip([SIZE / 2 + beyond[0], SIZE / 2 - beyond[1]], 30, SIZE - 30)
    y = float(np.clip(SIZE / 2 - beyond[1], 8, SIZE - 8))
    return [line, element("text", label, x=f"{x:.1f}", y=f"{y:.1f}")]
