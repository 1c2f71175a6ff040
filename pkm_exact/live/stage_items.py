"""What is drawn of an answer: surfaces and lines in floating point, each with a colour that says something.

A pose has the colour of its nearness to a singularity, by the condition number of J. The solid one has its legs in it
too, the others are ghosts: thin and translucent. Legs of a pose that breaks a limit of the model are red.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pkm_exact.pictures.hull import faces

if TYPE_CHECKING:
    from pkm_exact.live.live_answer import LiveAnswer
    from pkm_exact.pictures.drawn_robot import Point, PoseView, Scene

Colour: TypeAlias = tuple[int, int, int]
BANDS: Final[tuple[tuple[float, str, Colour], ...]] = (
    (10.0, "green: condition number of J up to 10", (0, 158, 115)),
    (100.0, "orange: up to 100", (230, 159, 0)),
    (float("inf"), "vermilion: above 100", (213, 94, 0)),
)
"""Condition numbers up to which a colour reaches, in increasing order."""
UNDECIDED: Final[tuple[str, Colour]] = ("black: singular, or not decided", (32, 32, 32))
BROKEN: Final[tuple[str, Colour]] = ("red legs: a limit of the model is broken, or not decided", (220, 0, 0))
BASE: Final[Colour] = (150, 150, 150)
LEG: Final[Colour] = (70, 70, 70)
GHOST: Final = 0.18
"""Opacity of ghosts."""
THICK, THIN = 0.008, 0.002
"""Of lines, by the size of the robot."""


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles: n x 3 vertices and m x 3 indices; and the place of the pose in the list that they are of, if any."""

    name: str
    vertices: NDArray[np.float32]
    triangles: NDArray[np.uint32]
    colour: Colour
    opacity: float
    place: int | None = None


@dataclass(frozen=True, eq=False)
class Lines:
    """Segments, n x 2 x 3, of a width."""

    name: str
    segments: NDArray[np.float32]
    colour: Colour
    width: float


def pose_colour(view: PoseView) -> Colour:
    """By the condition number.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> pose_colour(SimpleNamespace(condition=2.5)) == BANDS[0][2]
    True
    >>> pose_colour(SimpleNamespace(condition=None)) == UNDECIDED[1]
    True
    """
    if view.condition is None:
        return UNDECIDED[1]
    return next(colour for most, _, colour in BANDS if view.condition <= most)


def legend(*, with_limits: bool) -> list[str]:
    """What the colours say."""
    return [*(words for _, words, _ in BANDS), UNDECIDED[0], *([BROKEN[0]] if with_limits else [])]


def stage_items(answer: LiveAnswer) -> list[Surface | Lines]:
    """Base, ghosts and the solid pose.

    Examples
    --------
    >>> from pkm_exact import read_robot
    >>> from pkm_exact.live.live_answer import first_answer
    >>> [item.name for item in stage_items(first_answer(read_robot("models/3-rpr-merlet-p.toml")))]
    ['base', 'pose 1', 'pose 1 legs', 'pose 1 edge', 'pose 2', 'pose 2 legs', 'pose 2 edge']
    """
    scene = answer.scene
    found: list[Surface | Lines] = list(_body("base", scene.base, BASE, 0.6))
    for place, view in enumerate(scene.poses):
        found += _pose(scene, view, is_solid=place == answer.place)
    return found


def _pose(scene: Scene, view: PoseView, *, is_solid: bool) -> Iterator[Surface | Lines]:
    name, colour = f"pose {view.number}", pose_colour(view)
    width = scene.size * (THICK if is_solid else THIN)
    kept = view.limits is None or view.limits.startswith("yes")
    yield from _body(name, view.platform, colour, 1.0 if is_solid else GHOST, view.number - 1)
    feet = scene.feet(view)
    segments = [(feet[a], view.platform[b]) for a, b in scene.legs]
    segments += [(joint, knee) for joint, knee in zip(scene.base, view.knees, strict=False)]
    if segments:
        yield Lines(f"{name} legs", _array(segments), (LEG if is_solid else colour) if kept else BROKEN[1], width)
    edges = [*_edges(view.platform)]
    for shape in scene.shapes:
        for line in shape.lines(view.position, view.rotation, scene.size):
            edges += pairwise(line)
    if edges:
        yield Lines(f"{name} edge", _array(edges), colour, width)


def _edges(joints: Sequence[Point]) -> Iterator[tuple[Point, Point]]:
    for face in faces(joints):
        for one, other in zip(face, (*face[1:], face[0]), strict=True):
            yield joints[one], joints[other]


def _body(
    name: str, joints: Sequence[Point], colour: Colour, opacity: float, place: int | None = None
) -> Iterator[Surface]:
    """The body that joints span, as triangles; nothing if they lie on a line."""
    triangles = [(face[0], *pair) for face in faces(joints) for pair in pairwise(face[1:])]
    if triangles:
        yield Surface(name, _array(joints), np.array(triangles, dtype=np.uint32), colour, opacity, place)


def _array(points: Sequence[object]) -> NDArray[np.float32]:
    return np.array(points, dtype=np.float32)
