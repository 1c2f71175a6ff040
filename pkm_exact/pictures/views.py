"""Figures of certified poses: all of them side by side, one, or all at once.

Each function returns a matplotlib ``Figure`` that no window or global state knows; ``output.figure_bytes`` turns it
into a file.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from pkm_exact.errors import InputError
from pkm_exact.pictures import captions, style
from pkm_exact.pictures.camera import DEFAULT_VIEW, Camera, View, camera, window
from pkm_exact.pictures.capability_picture import Capability, draw_capabilities, points_of
from pkm_exact.pictures.drawing import (
    FAR,
    LABELS,
    NEAR,
    Pen,
    draw_base,
    draw_chains,
    draw_legs,
    draw_parts,
    draw_platform,
    draw_robot,
    label,
    middle,
)
from pkm_exact.pictures.drawn_robot import Point, PoseView, Scene
from pkm_exact.pictures.panels import (
    HEADER,
    TITLE,
    Rectangle,
    footer,
    grid,
    large_axes,
    large_size,
    padded_bounds,
    panel,
    seen_along,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def poses_figure(scene: Scene, *, view: View = DEFAULT_VIEW, size: tuple[float, float] | None = None) -> Figure:
    """All poses side by side, from the same side and to the same scale.

    Parameters
    ----------
    scene : Scene
    view : View
        Ignored if the robot is planar.
    size : pair of float, optional
        Width and height in inches; by default each panel is about two inches wide.
    """
    with style.plain_style():
        from matplotlib.figure import Figure

        shot, points = camera(scene, view), _points(scene, scene.poses)
        frame = window([shot.flat(point) for point in points])
        plan = grid(scene, frame, size)
        figure = Figure(figsize=plan.size)
        pen = Pen(width=min(1.6, max(0.8, plan.panel[0] / 1.3)))
        titles = [captions.title(pose) for pose in scene.poses] or ["no pose to draw"]
        bold = [pose.is_nearest for pose in scene.poses] or [False]
        fitting = [captions.fitting(t, plan.panel[0] - 0.04, bold=b) for t, b in zip(titles, bold, strict=True)]
        letters = min(9.0, *fitting)
        for place, pose in enumerate(scene.poses or (None,)):
            cell = plan.cell(place)
            axes = panel(figure, scene, view, shot, cell, frame.centre, plan.scale, points)
            axes.set_label("no pose" if pose is None else f"pose {pose.number}")
            if pose is None:
                draw_base(axes, scene, shot, pen, FAR)
            else:
                draw_robot(axes, scene, pose, shot, pen)
            _title(figure, titles[place], cell, letters, bold=bold[place])
        _headline(figure, scene, captions.statement(scene))
        captions.add_legend(figure, scene)
        captions.add_key(figure, scene, shot, plan.scale)
        return figure


def pose_figure(
    scene: Scene,
    number: int,
    *,
    view: View = DEFAULT_VIEW,
    size: tuple[float, float] | None = None,
    ghosts: bool = False,
    capabilities: Sequence[Capability] = (),
) -> Figure:
    """One pose, with its coordinates on the axes; the others behind it as ghosts if these are wanted.

    Parameters
    ----------
    number : int
        Of the pose, from 1.
    capabilities : sequence of Capability
        Polytopes drawn about the platform's origin.
    """
    if not 1 <= number <= len(scene.poses):
        known = f"from 1 to {len(scene.poses)}" if scene.poses else "of another certificate, this one lists none"
        raise InputError(f"pose: there is no pose {number}; give a number {known}")
    with style.plain_style():
        pose = scene.poses[number - 1]
        others = tuple(other for other in scene.poses if ghosts and other != pose)
        figure, axes, shot = _large(
            scene, (pose, *others), view, size, points_of(capabilities, pose), len(capabilities)
        )
        for other in others:
            _ghost(axes, scene, other, shot, style.GHOST_INK, FAR)
        draw_robot(axes, scene, pose, shot, Pen(width=2.4))
        _number_legs(axes, scene, pose)
        draw_capabilities(axes, scene, pose, shot, capabilities)
        _headline(figure, scene, captions.title(pose, of=len(scene.poses)))
        captions.add_scales(figure, [found.statement(scene.unit) for found in capabilities])
        captions.add_legend(figure, scene, key=False)
        return figure


def overlay_figure(scene: Scene, *, view: View = DEFAULT_VIEW, size: tuple[float, float] | None = None) -> Figure:
    """All poses at once, as ghosts with their numbers, coloured by the sign of det J."""
    with style.plain_style():
        figure, axes, shot = _large(scene, scene.poses, view, size)
        draw_base(axes, scene, shot, Pen(width=2.0), FAR)
        for pose in scene.poses[:1]:  # cranks and slides are locked: the same in all poses
            draw_chains(axes, scene, pose, Pen(width=2.0), style.BASE_INK)
        for pose in sorted(scene.poses, key=lambda pose: shot.depth(middle(pose.platform))):
            colour = style.SIGN_COLOURS[pose.det_sign]
            draw_legs(axes, scene, pose, shot, Pen(width=0.8, opacity=0.3), colour)
            _ghost(axes, scene, pose, shot, colour, NEAR)
        _headline(figure, scene, captions.statement(scene))
        captions.add_legend(figure, scene, ghosts=True, key=False)
        return figure


def _large(
    scene: Scene,
    poses: Sequence[PoseView],
    view: View,
    size: tuple[float, float] | None,
    others: Sequence[Point] = (),
    lines: int = 0,
) -> tuple[Figure, Axes, Camera]:
    """A figure with one drawing, large enough for these poses and other points, coordinates on its axes.

    ``lines`` of small text have room below the headline.
    """
    from matplotlib.figure import Figure

    shot, points = camera(scene, view), [*_points(scene, poses), *others]
    limits = padded_bounds(points)
    header = HEADER + captions.LINE * lines
    across, upward = large_size(scene, shot, limits)
    figure = Figure(figsize=size or (across, upward + header - HEADER))
    width, height = figure.get_size_inches()
    below = footer(scene, width, key=False)
    area = Rectangle(0.1, below, width - 0.2, height - header - below)
    axes = large_axes(figure, scene, view, shot, area, limits)
    for axis, (letter, name) in enumerate(zip("xyz", captions.axis_names(scene), strict=False)):
        if seen_along(shot, axis):
            axes.set(**{f"{letter}label": name})
    return figure, axes, shot


def _ghost(axes: Axes, scene: Scene, pose: PoseView, shot: Camera, colour: str, layer: float) -> None:
    """A platform with its passive bodies, pale, with its number."""
    draw_parts(axes, scene, pose, shot, Pen(width=0.8, opacity=0.3))
    draw_platform(axes, scene, pose, shot, Pen(width=1.1, opacity=0.7, fill=0.12), colour, colour, layer)
    number = f"{pose.number}*" if pose.is_nearest else str(pose.number)
    label(axes, scene, middle(pose.platform), number, colour, layer + 0.9)


def _number_legs(axes: Axes, scene: Scene, pose: PoseView) -> None:
    """The numbers of the legs, near the middle of each, for those who do not tell the colours."""
    for leg, (foot, joint) in enumerate(scene.ends(pose)):
        colour = style.leg_colour(leg + 1)
        ends = (foot, foot, joint) if leg % 2 else (foot, joint, joint)  # neighbours at different heights
        label(axes, scene, middle(ends), str(leg + 1), colour, LABELS)


def _headline(figure: Figure, scene: Scene, second: str) -> None:
    captions.add_headline(figure, captions.headline(scene.name, scene.kind, scene.configuration), second)


def _title(figure: Figure, text: str, cell: Rectangle, size: float, *, bold: bool) -> None:
    """A line above a panel."""
    width, height = figure.get_size_inches()
    figure.text(
        (cell.left + cell.width / 2) / width,
        (cell.bottom + cell.height + TITLE / 4) / height,
        text,
        ha="center",
        va="bottom",
        fontsize=size,
        weight="bold" if bold else "normal",
    )


def _points(scene: Scene, poses: Sequence[PoseView]) -> list[Point]:
    """All joints that are drawn, and the corners of planes and ends of lines."""
    ends = [end for pose in poses for leg in scene.ends(pose) for end in leg]
    held = [
        point
        for pose in poses
        for shape in scene.shapes
        for line in shape.lines(pose.position, pose.rotation, scene.size)
        for point in line
    ]
    return [*scene.base, *(joint for pose in poses for joint in pose.joints), *ends, *held]
