"""Where a picture is taken from: an orthographic view, so that one scale holds all over it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import cos, radians, sin
from typing import Final

from pkm_exact.pictures.drawn_robot import Point, Scene

STEEPEST: Final = 89.9


@dataclass(frozen=True)
class View:
    """The direction from which a spatial robot is seen, in degrees; planar ones are seen from above.

    Attributes
    ----------
    azimuth : float
        Of the viewer about the z axis, from the x axis.
    elevation : float
        Of the viewer above the xy plane.
    """

    azimuth: float = -60.0
    elevation: float = 20.0

    @property
    def tilt(self) -> float:
        """The elevation that is drawn: from straight above or below, axes in space would not know what is right."""
        return min(max(self.elevation, -STEEPEST), STEEPEST)


DEFAULT_VIEW = View()


@dataclass(frozen=True)
class Camera:
    """An orthonormal frame: to the right and upwards on the paper, and towards the viewer."""

    right: Point
    up: Point
    toward: Point

    def flat(self, point: Sequence[float]) -> tuple[float, float]:
        """Where a point appears on the paper, in the robot's unit of length."""
        return _dot(self.right, point), _dot(self.up, point)

    def depth(self, point: Sequence[float]) -> float:
        """How near to the viewer a point is."""
        return _dot(self.toward, point)


def camera(scene: Scene, view: View) -> Camera:
    """The camera of a view on a scene.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> from pkm_exact.motions.motion_groups import SPATIAL
    >>> front = camera(SimpleNamespace(motion=SPATIAL), View(-90, 0))
    >>> [round(x, 9) + 0.0 for x in front.flat((1, 2, 3))]
    [1.0, 3.0]
    """
    if scene.motion.is_planar:
        return Camera((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    a, e = radians(view.azimuth), radians(view.tilt)
    return Camera(
        (-sin(a), cos(a), 0.0),
        (-sin(e) * cos(a), -sin(e) * sin(a), cos(e)),
        (cos(e) * cos(a), cos(e) * sin(a), sin(e)),
    )


@dataclass(frozen=True)
class Window:
    """A rectangle on the paper, in the robot's unit of length."""

    centre: tuple[float, float]
    width: float
    height: float


def window(points: Iterable[tuple[float, float]]) -> Window:
    """The smallest rectangle around points, never flatter than a quarter of its length."""
    across, upward = zip(*points, strict=True)
    width, height = max(across) - min(across), max(upward) - min(upward)
    least = max(width, height) / 4 or 1.0
    centre = (max(across) + min(across)) / 2, (max(upward) + min(upward)) / 2
    return Window(centre, max(width, least), max(height, least))


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))
