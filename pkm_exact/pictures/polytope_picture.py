"""Pictures of polytopes in two or three dimensions, and of the ellipses and ellipsoids in them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pkm_exact.errors import InputError
from pkm_exact.pictures import style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pkm_exact.polytopes.polytope import Polytope
    from pkm_exact.statics.largest_ellipsoid import LargestEllipsoid


def polytope_figure(
    polytope: Polytope, names: tuple[str, ...] = ("x", "y", "z"), ellipsoid: LargestEllipsoid | None = None
) -> Figure:
    """A polytope of two or three dimensions in ordinary coordinates, with an ellipsoid in it if there is one.

    Parameters
    ----------
    polytope : Polytope
    names : tuple of str
        Of the axes.
    ellipsoid : LargestEllipsoid, optional
        About the origin, in the same coordinates.

    Raises
    ------
    InputError
        If it has another dimension, or matplotlib is not installed.
    """
    _require_drawable(polytope)
    with style.plain_style():
        from matplotlib.figure import Figure

        figure = Figure(figsize=(5, 5), layout="constrained")
        draw_polytope(figure, (1, 1, 1), polytope, names, None if ellipsoid is None else ellipsoid.matrix.to_numpy())
    return figure


def _require_drawable(polytope: Polytope) -> None:
    if polytope.dimension not in (2, 3):
        raise InputError(f"picture: {polytope.dimension} dimensions cannot be drawn; take a section with 2 or 3")


def draw_polytope(
    figure: Figure, place: tuple[int, int, int], polytope: Polytope, names: tuple[str, ...], ellipsoid: Any = None
) -> Any:
    """Draw a polytope at a place of a figure, and in it the ellipsoid x^T S^-1 x <= 1 of a matrix S; the axes."""
    _require_drawable(polytope)
    points = plain_vertices(polytope)
    if polytope.dimension == 2:
        axes: Any = figure.add_subplot(*place)
        order = np.argsort(np.arctan2(*(points - points.mean(axis=0)).T[::-1]))
        axes.fill(*points[order].T, facecolor="tab:blue", alpha=0.3, edgecolor="tab:blue")
        axes.set_aspect("equal")
    else:
        from mpl_toolkits.mplot3d.art3d import Poly3DCollection

        axes = figure.add_subplot(*place, projection="3d")
        faces = [ordered_corners(points[list(facet.vertices)]) for facet in polytope.facets]
        axes.add_collection3d(Poly3DCollection(faces, alpha=0.3, edgecolor="tab:blue", facecolor="tab:blue"))
        axes.set_box_aspect(None, zoom=0.85)  # or the label of z is cut off
        axes.set_zlabel(names[2])
        for set_limits, values in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), points.T, strict=True):
            set_limits(values.min(), values.max())
    if ellipsoid is not None:
        _draw_ellipsoid(axes, np.linalg.cholesky(ellipsoid))
    axes.set_xlabel(names[0])
    axes.set_ylabel(names[1])
    return axes


def plain_vertices(polytope: Polytope) -> Any:
    """The vertices in ordinary coordinates, as the nearest doubles: an array of shape (vertices, dimension)."""
    scale = np.sqrt([float(square) for square in polytope.squares])
    rows = [[float(value.mid() if hasattr(value, "mid") else value) for value in v] for v in polytope.vertices]
    return np.array(rows) * scale


def ordered_corners(points: Any) -> Any:
    """The corners of a face, one after another around it."""
    offsets = points - points.mean(axis=0)
    first, second = np.linalg.svd(offsets)[2][:2]
    return points[np.argsort(np.arctan2(offsets @ second, offsets @ first))]


def _draw_ellipsoid(axes: Any, root: Any) -> None:
    turn = np.linspace(0, 2 * np.pi, 61)
    if root.shape[0] == 2:
        axes.plot(*(root @ [np.cos(turn), np.sin(turn)]), color="tab:orange")
        return
    height = np.linspace(0, np.pi, 31)
    sphere = np.array(
        [
            np.outer(np.cos(turn), np.sin(height)),
            np.outer(np.sin(turn), np.sin(height)),
            np.outer(np.ones(61), np.cos(height)),
        ]
    )
    axes.plot_wireframe(*np.tensordot(root, sphere, axes=1), color="tab:orange", linewidth=0.5)
