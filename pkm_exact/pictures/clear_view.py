"""From where one pose is seen best: legs should neither hide each other nor point at the viewer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.pictures.camera import DEFAULT_VIEW, View, camera

if TYPE_CHECKING:
    from pkm_exact.pictures.drawn_robot import PoseView, Scene

AZIMUTHS: Final = range(-180, 180, 10)
ELEVATIONS: Final = (10, 20, 30, 40, 50)
_SAMPLES: Final = 24
"""Points on each leg."""
_NEAR: Final = 0.02
"""How near to another leg a point counts as hidden, in parts of the picture's size."""
_AS_CLEAR: Final = 0.98
"""The default view is kept if it shows at least that much of what the best one does."""


def clear_view(scene: Scene, pose: PoseView) -> View:
    """The view of a grid that shows most of that leg of which it shows least; the default one if that is as good.

    Examples
    --------
    >>> import json
    >>> from pathlib import Path
    >>> from pkm_exact.pictures.scene import scene_of
    >>> scene = scene_of(json.loads(Path("certs/rolland-6-6.json").read_text()), None)
    >>> view = clear_view(scene, scene.poses[2])
    >>> clearness(scene, scene.poses[2], view) > clearness(scene, scene.poses[2], DEFAULT_VIEW)
    True
    """
    if scene.motion.is_planar or not scene.legs:
        return DEFAULT_VIEW
    views = [View(float(azimuth), float(elevation)) for elevation in ELEVATIONS for azimuth in AZIMUTHS]
    values = [clearness(scene, pose, view) for view in views]
    best = max(values)
    if clearness(scene, pose, DEFAULT_VIEW) >= _AS_CLEAR * best:
        return DEFAULT_VIEW
    return views[values.index(best)]


def clearness(scene: Scene, pose: PoseView, view: View) -> float:
    """Of the leg that shows least: which part of its length is seen on the paper, away from all other legs. 0 to 1."""
    shot = camera(scene, view)
    space = np.array(scene.ends(pose), dtype=float)
    flat = space @ np.array([shot.right, shot.up]).T
    steps = np.linspace(0, 1, _SAMPLES)[None, :, None]
    points = flat[:, None, 0] + steps * (flat[:, None, 1] - flat[:, None, 0])
    clear = _distances(points, flat) > _NEAR * max(np.ptp(flat[..., 0]), np.ptp(flat[..., 1]))
    clear[np.arange(len(flat)), :, np.arange(len(flat))] = True
    lengths, shown = (np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) for ends in (space, flat))
    parts = np.divide(shown, lengths, out=np.ones_like(shown), where=lengths > 0)
    return float((clear.all(axis=2).mean(axis=1) * parts).min())


def _distances(points: NDArray[Any], segments: NDArray[Any]) -> NDArray[Any]:
    """The distance of each point of each leg from each segment: legs x points x segments."""
    starts, along = segments[:, 0], segments[:, 1] - segments[:, 0]
    squares = np.maximum((along**2).sum(axis=1), np.finfo(float).tiny)
    offsets = points[:, :, None] - starts
    shares = np.clip((offsets * along).sum(axis=3) / squares, 0, 1)
    found: NDArray[Any] = np.linalg.norm(offsets - shares[..., None] * along, axis=3)
    return found
