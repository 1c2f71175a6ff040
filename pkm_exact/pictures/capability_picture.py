"""Polytopes of velocities and forces, with the ellipsoid in the first, at the platform in the picture of a pose.

Those without turning, and without moment, are drawn about the platform's origin, at a scale that is said: what lies on
paper as long as ``length`` is as great as ``value``. Drawing takes doubles nearest to enclosed values.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import floor, log10
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from pkm_exact.errors import InputError
from pkm_exact.pictures.camera import Camera
from pkm_exact.pictures.drawn_robot import Point, PoseView, Scene
from pkm_exact.pictures.polytope_picture import ordered_corners, plain_vertices
from pkm_exact.pictures.statics_picture import ellipsoid_matrix
from pkm_exact.polytopes.polytope import Polytope
from pkm_exact.polytopes.slabs import Slabs
from pkm_exact.polytopes.zonotope import Zonotope
from pkm_exact.statics.freedom import Freedom
from pkm_exact.statics.largest_ellipsoid import LargestEllipsoid
from pkm_exact.statics.measures import Measures

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_PART: Final = 0.35
"""How far a polytope reaches, as part of the size of the robot, at most."""
_LAYER: Final = 9.5
_GRID: Final = 1 << 50
_COLOURS: Final = {"velocity": "tab:blue", "wrench": "tab:green"}
_MEANINGS: Final = {"velocity": "velocities without turning", "wrench": "forces without moment"}


@dataclass(frozen=True, eq=False)
class Capability:
    """A polytope in ordinary coordinates of the picture.

    Attributes
    ----------
    kind : str
        "velocity" or "wrench".
    faces : list of arrays of shape (corners, 2 or 3)
        About the platform's origin, to scale: lengths of the picture.
    ellipsoid : array or None
        A root A of the matrix of the largest ellipsoid without turning, to scale: A u with |u| <= 1.
    length, value : float
        What is as great as the value is drawn with this length.
    """

    kind: str
    faces: list[Any]
    ellipsoid: Any
    length: float
    value: float

    def statement(self, unit: str) -> str:
        """The scale in words.

        >>> Capability("wrench", [], None, 0.1, 20.0).statement("m")
        'forces without moment (green): 20 drawn as long as 0.1 m'
        """
        colour = _COLOURS[self.kind].removeprefix("tab:")
        if self.ellipsoid is not None:
            colour += ", of the largest ellipsoid orange"
        length = f"{self.length:g}" if unit == "1" else f"{self.length:g} {unit}"
        return f"{_MEANINGS[self.kind]} ({colour}): {self.value:g} drawn as long as {length}"


def capabilities(measures: Measures, ellipsoid: LargestEllipsoid | None, size: float) -> list[Capability]:
    """What the limits say of velocities and forces, to the scale of a robot of some size.

    Raises
    ------
    InputError
        If there are no limits, or the platform does not translate freely in two or three directions.
    """
    limits, freedom = measures.limits, measures.freedom
    if freedom.forward is not None:
        raise InputError(
            "picture: there is no J at this pose, by which velocities and forces are drawn; `statics --plot` draws the "
            "polytopes that there are"
        )
    twist = freedom.at.motion.twist
    kept = [k for k, place in enumerate(freedom.free.places) if twist[place] < 3]
    moving = sum(place < 3 for place in twist)
    if len(kept) < 2 or len(kept) < moving or (freedom.at.held.structural and len(kept) < len(freedom.free.places)):
        raise InputError(
            "picture: velocities without turning are drawn of platforms that translate freely in the plane or in "
            "space, and this one does not; `statics --plot` draws its polytopes beside each other"
        )
    rows, found = _middle_rows(freedom), list[Capability]()
    others = {j: Fraction(0) for j in range(len(rows[0])) if j not in kept}
    one = (Fraction(1),) * len(rows[0])
    if limits.speeds is not None:
        cut = tuple(tuple(Fraction(row[j], _GRID) for j in kept) for row in rows)
        slabs = Slabs(cut, tuple(-x for x in limits.speeds), limits.speeds)
        matrix = None if ellipsoid is None else ellipsoid_matrix(measures, ellipsoid, kept)
        found.append(_scaled("velocity", slabs.polytope(), matrix, size))
    if limits.forces is not None:
        low, high = limits.force_ends or ((), ())
        pushing = [k for k, row in enumerate(rows) if any(row)]
        least, most = (tuple(bounds[k] for k in pushing) for bounds in (low, high))
        weights = (Fraction(1, _GRID),) * len(pushing)
        section = Zonotope(tuple(rows[k] for k in pushing), weights, least, most, one).section(others)
        plain = Slabs(section.rows, *(tuple(x.rational for x in bounds) for bounds in (section.low, section.high)))
        found.append(_scaled("wrench", plain.polytope(), None, size))
    if not found:
        raise InputError("picture: no limits are known; give greatest speeds, or forces")
    return found


def _middle_rows(freedom: Freedom) -> list[tuple[int, ...]]:
    """Rows of J in the middle of the box, times a power of 2 and rounded: faces need not be told apart by proof."""
    rows = freedom.free_jacobian
    return [tuple(round(float(rows[i, j].mid()) * _GRID) for j in range(rows.ncols())) for i in range(rows.nrows())]


def _scaled(kind: str, polytope: Polytope, matrix: Any, size: float) -> Capability:
    corners = plain_vertices(polytope)
    reach = _PART * size
    length = 10.0 ** floor(log10(reach))
    value = _rounded_up(float(np.linalg.norm(corners, axis=1).max()) * length / reach)
    scale = length / value
    if polytope.dimension == 2:
        order = np.argsort(np.arctan2(*(corners - corners.mean(axis=0)).T[::-1]))
        faces = [corners[order] * scale]
    else:
        faces = [ordered_corners(corners[list(facet.vertices)]) * scale for facet in polytope.facets]
    root = None if matrix is None else np.linalg.cholesky(matrix) * scale
    return Capability(kind, faces, root, length, value)


def _rounded_up(value: float) -> float:
    """1, 2 or 5 times a power of ten, not below.

    >>> _rounded_up(0.03), _rounded_up(20.0)
    (0.05, 20.0)
    """
    power = 10.0 ** floor(log10(value))
    return float(f"{next(step for step in (1, 2, 5, 10) if step * power >= value * (1 - 1e-9)) * power:.1g}")


def points_of(found: Sequence[Capability], pose: PoseView) -> list[Point]:
    """Corners in the coordinates of the scene, which must be in sight."""
    return [_placed(corner, pose) for each in found for face in each.faces for corner in face]


def draw_capabilities(axes: Axes, scene: Scene, pose: PoseView, shot: Camera, found: Sequence[Capability]) -> None:
    """Draw them about the platform's origin."""
    drawn: Any = axes
    for each in found:
        colour = _COLOURS[each.kind]
        options = {"facecolor": colour, "edgecolor": colour, "alpha": 0.25, "zorder": _LAYER, "clip_on": False}
        corners = [[_placed(corner, pose) for corner in face] for face in each.faces]
        if scene.motion.is_planar:
            from matplotlib.patches import Polygon

            for face in corners:
                drawn.add_patch(Polygon([x[:2] for x in face], closed=True, gid=f"{each.kind}-polytope", **options))
        else:
            from mpl_toolkits.mplot3d.art3d import Poly3DCollection

            drawn.add_collection(Poly3DCollection(corners, gid=f"{each.kind}-polytope", **options))
        if each.ellipsoid is not None:
            _draw_ellipsoid(drawn, pose, shot, each.ellipsoid)


def _draw_ellipsoid(axes: Any, pose: PoseView, shot: Camera, root: Any) -> None:
    """An ellipse, or the outline of an ellipsoid and the ellipses in its planes of coordinates."""
    turn = np.linspace(0, 2 * np.pi, 73)
    circle = np.array([np.cos(turn), np.sin(turn)])
    options = {"color": "tab:orange", "zorder": _LAYER + 0.2, "clip_on": False}
    if root.shape[0] == 2:
        points = np.array([_placed(x, pose) for x in (root @ circle).T])
        axes.plot(*points[:, :2].T, gid="ellipsoid", linewidth=1.6, **options)
        return
    for number in range(3):
        line = np.insert(circle, number, 0.0, axis=0)
        points = np.array([_placed(x, pose) for x in (root @ line).T])
        axes.plot(*points.T, gid="ellipsoid", linewidth=0.8, **options)
    # The outline: where the direction of view touches it.
    view = root.T @ np.array([shot.depth((float(k == 0), float(k == 1), float(k == 2))) for k in range(3)])
    first, second = np.linalg.svd(view[None, :])[2][1:]
    points = np.array([_placed(x, pose) for x in (root @ (np.outer(first, circle[0]) + np.outer(second, circle[1]))).T])
    axes.plot(*points.T, gid="ellipsoid", linewidth=1.6, **options)


def _placed(corner: Any, pose: PoseView) -> Point:
    x, y, z = (float(a) + b for a, b in zip([*corner, 0.0][:3], pose.position, strict=True))
    return x, y, z
