"""A robot in one of its poses, drawn on the axes of a panel, flat or in space."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from pkm_exact.pictures import style
from pkm_exact.pictures.camera import Camera
from pkm_exact.pictures.drawn_robot import BAR, BODY, Point, PoseView, Scene
from pkm_exact.pictures.hull import faces
from pkm_exact.pictures.shapes import ARM, PLANE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FAR, NEAR = 1.0, 8.0
"""Layers of the body behind the legs, and of the one before them."""
_CHAINS, _LEGS, _JOINTS, LABELS = 2.0, 4.0, 9.0, 10.0


@dataclass(frozen=True)
class Pen:
    """How strongly a pose is drawn: line width in points, and the opacity of lines and of faces."""

    width: float = 1.6
    opacity: float = 1.0
    fill: float = 0.55


def draw_base(axes: Axes, scene: Scene, shot: Camera, pen: Pen, layer: float) -> None:
    """The base: a grey body through the base joints, with square joints."""
    _body(axes, scene, scene.base, shot, style.BASE_FILL, style.BASE_INK, pen, layer)
    _dots(axes, scene, scene.base, "s", style.BASE_INK, pen)


def draw_platform(
    axes: Axes, scene: Scene, pose: PoseView, shot: Camera, pen: Pen, fill: str, ink: str, layer: float
) -> None:
    """The platform of a pose, with round joints."""
    _body(axes, scene, pose.platform, shot, fill, ink, pen, layer)
    _dots(axes, scene, pose.platform, "o", ink, pen)


def draw_robot(axes: Axes, scene: Scene, pose: PoseView, shot: Camera, pen: Pen) -> None:
    """Base, legs and platform of a pose; of base and platform the one that is farther away comes first."""
    above = shot.depth(middle(pose.platform)) >= shot.depth(middle(scene.base))
    draw_base(axes, scene, shot, pen, FAR if above else NEAR)
    draw_chains(axes, scene, pose, pen)
    draw_legs(axes, scene, pose, shot, pen)
    draw_shapes(axes, scene, pose, pen)
    draw_parts(axes, scene, pose, shot, pen)
    draw_platform(axes, scene, pose, shot, pen, style.PLATFORM_FILL, style.INK, NEAR if above else FAR)


def draw_chains(axes: Axes, scene: Scene, pose: PoseView, pen: Pen, colour: str | None = None) -> None:
    """Cranks or slides, from base joints to knees, in the colours of their legs unless a colour is given."""
    for leg, (knee, sort) in enumerate(zip(pose.knees, scene.chains, strict=False)):
        if not sort:
            continue
        options = {"linewidth": 1.9 * pen.width, "linestyle": style.DASHES[sort], "zorder": _CHAINS}
        shade = colour or style.leg_colour(leg + 1)
        _line(axes, scene, (scene.base[leg], knee), color=shade, gid=f"chain-{leg + 1}", **options)
    knees = [knee for knee, sort in zip(pose.knees, scene.chains, strict=False) if sort]
    if knees:
        _dots(axes, scene, knees, "D", style.INK, pen)


def draw_legs(axes: Axes, scene: Scene, pose: PoseView, shot: Camera, pen: Pen, colour: str | None = None) -> None:
    """The legs or rods, the nearest one last, with a pale rim where they cross.

    Each is coloured by its number, unless a colour is given.
    """
    ends = scene.ends(pose)
    order = sorted(range(len(ends)), key=lambda leg: shot.depth(middle(ends[leg])))
    for place, leg in enumerate(order):
        shade, layer = colour or style.leg_colour(leg + 1), _LEGS + place / len(order)
        if pen.opacity == 1:
            _line(axes, scene, ends[leg], color="white", linewidth=2.2 * pen.width, zorder=layer)
        width = style.CABLE * pen.width if scene.cables else pen.width
        options = {"linewidth": width, "alpha": pen.opacity, "zorder": layer}
        _line(axes, scene, ends[leg], color=shade, gid=f"leg-{leg + 1}", **options)
        if scene.bars:
            bar = pose.platform[scene.legs[leg][1]], ends[leg][1]
            _line(axes, scene, bar, color=colour or style.INK, gid=f"bar-{leg + 1}", **options)


def draw_shapes(axes: Axes, scene: Scene, pose: PoseView, pen: Pen) -> None:
    """Planes as squares, lines and axes as segments, at the joints that they hold."""
    for shape in scene.shapes:
        shade = style.leg_colour(shape.number)
        for number, line in enumerate(shape.lines(pose.position, pose.rotation, scene.size), 1):
            width = (1.9 if shape.kind == ARM else 0.8) * pen.width
            options = {"linewidth": width, "linestyle": style.SHAPE_DASHES[shape.kind], "zorder": _CHAINS}
            _line(axes, scene, line, color=shade, gid=f"{shape.kind}-{shape.number}-{number}", **options)
            if shape.kind == PLANE and not scene.motion.is_planar:
                _face(axes, scene, line[:-1], shade, 0.12 * pen.opacity, FAR)


def draw_parts(axes: Axes, scene: Scene, pose: PoseView, shot: Camera, pen: Pen) -> None:
    """Passive bodies with their joints, bars between bodies, and the lines and planes along which joints slide."""
    for part in pose.parts:
        shade = style.part_colour(part)
        if part.kind == BODY:
            _body(axes, scene, part.points, shot, shade, shade, replace(pen, fill=0.4 * pen.fill), _CHAINS)
            _dots(axes, scene, part.points, "o", shade, pen)
            continue
        width = (1.0 if part.kind == BAR else 0.8) * pen.width
        dashes = style.SHAPE_DASHES[part.kind]
        options = {"linewidth": width, "linestyle": dashes, "alpha": pen.opacity, "zorder": _LEGS}
        _line(axes, scene, part.points, color=shade, gid=f"{part.kind}-{part.number}", **options)


def middle(points: Sequence[Point]) -> Point:
    """The mean of points."""
    x, y, z = (sum(values) / len(points) for values in zip(*points, strict=True))
    return x, y, z


def label(axes: Axes, scene: Scene, point: Point, text: str, colour: str, layer: float) -> None:
    """A short text at a point, with a white rim."""
    from matplotlib.patheffects import withStroke

    write: Any = axes.text  # two coordinates or three
    write(
        *(point[:2] if scene.motion.is_planar else point),
        text,
        color=colour,
        zorder=layer,
        clip_on=False,
        path_effects=[withStroke(linewidth=2.5, foreground="white")],
        ha="center",
        va="center",
        weight="bold",
        fontsize=9,
    )


def _body(
    axes: Axes, scene: Scene, points: Sequence[Point], shot: Camera, fill: str, ink: str, pen: Pen, layer: float
) -> None:
    """The faces of the body; of a solid one, those turned away have pale edges and no colour."""
    found = faces(points)
    solid = len(found) > 1
    for face in found:
        corners = [points[i] for i in face]
        hidden = solid and not _is_turned(corners, middle(points), shot)
        if len(corners) > 2 and not hidden:
            _face(axes, scene, corners, fill, pen.fill, layer)
        edges = {"linewidth": pen.width * (0.4 if solid else 0.6), "alpha": pen.opacity * (0.25 if hidden else 1)}
        _line(axes, scene, [*corners, corners[0]], color=ink, zorder=layer + (0.4 if hidden else 0.5), **edges)


def _is_turned(corners: Sequence[Point], inside: Point, shot: Camera) -> bool:
    """Whether a face of a solid body is turned to the viewer."""
    a, b, c = corners[:3]
    u, v = ([q - p for p, q in zip(a, end, strict=True)] for end in (b, c))
    normal = [u[j] * v[k] - u[k] * v[j] for j, k in ((1, 2), (2, 0), (0, 1))]
    outward = sum(n * (p - m) for n, p, m in zip(normal, a, inside, strict=True))
    return (shot.depth(normal) > 0) == (outward > 0)


def _face(axes: Axes, scene: Scene, corners: Sequence[Point], fill: str, opacity: float, layer: float) -> None:
    options = {"facecolor": fill, "edgecolor": "none", "alpha": opacity, "zorder": layer, "clip_on": False}
    if scene.motion.is_planar:
        from matplotlib.patches import Polygon

        axes.add_patch(Polygon([corner[:2] for corner in corners], closed=True, **options))
    else:
        from mpl_toolkits.mplot3d.art3d import Poly3DCollection

        axes.add_collection(Poly3DCollection([list(corners)], **options))


def _line(axes: Axes, scene: Scene, points: Sequence[Point], **options: Any) -> None:
    across = list(zip(*points, strict=True))[: 2 if scene.motion.is_planar else 3]
    axes.plot(*across, solid_capstyle="round", clip_on=False, **options)


def _dots(axes: Axes, scene: Scene, points: Sequence[Point], marker: str, colour: str, pen: Pen) -> None:
    options = {"markersize": 1.6 * pen.width, "alpha": pen.opacity, "zorder": _JOINTS}
    _line(axes, scene, points, linestyle="none", marker=marker, color=colour, **options)
