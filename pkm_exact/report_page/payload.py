"""What the script of the page works with, as JSON: numbers to draw, and texts to show and to copy."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.wording import with_unit

if TYPE_CHECKING:
    from pkm_exact.pictures.drawn_robot import PoseView, Scene
    from pkm_exact.report_page.rows import PoseRows, Row

DIGITS: Final = 10
"""Significant digits of coordinates to draw: fewer than a double has, so that every machine writes the same."""


def payload(scene: Scene, poses: PoseRows) -> dict[str, Any]:
    """All data of the page's script."""
    return {
        "unit": with_unit("", scene.unit),
        "planar": scene.motion.is_planar,
        "base": _points(scene.base),
        "legs": [list(pair) for pair in scene.legs],
        "chains": list(scene.chains),
        "cables": scene.cables,
        "bars": _points(scene.bars),
        "columns": poses.plain,
        "exact_first": poses.first,
        "first_shown": next((view.number for view in scene.poses if view.is_nearest), None),
        "poses": [_pose(row, view, scene) for row, view in zip(poses.rows, scene.poses, strict=True)],
    }


def _pose(row: Row, view: PoseView, scene: Scene) -> dict[str, Any]:
    return {
        "number": row.number,
        "origin": _point(view.position),
        "axes": _points(view.rotation),
        "platform": _points(view.platform),
        "knees": _points(view.knees),
        "shapes": [
            {"number": shape.number, "kind": shape.kind, "points": _points(line)}
            for shape in scene.shapes
            for line in shape.lines(view.position, view.rotation, scene.size)
        ],
        "lines": row.lines,
        "summary": row.summary,
        "position": row.position,
        "quaternion": row.quaternion,
        "rotation": row.rotation,
        "bounds": row.bounds,
        "cells": row.plain,
        "exact_first": row.first,
    }


def _points(points: Sequence[Sequence[float]]) -> list[list[float]]:
    return [_point(point) for point in points]


def _point(point: Sequence[float]) -> list[float]:
    """Rounded; a zero has no sign.

    >>> _point([1 / 3, -1e-300, -0.0])
    [0.3333333333, -1e-300, 0.0]
    """
    return [float(f"{x:.{DIGITS}g}") + 0.0 for x in point]
