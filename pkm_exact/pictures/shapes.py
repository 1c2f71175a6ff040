"""What constraints that are no legs look like: planes, lines, points and axes, at the joints that they hold.

A plane is drawn as a square around its joint, a line and an axis as a segment along it; those of the platform move
with it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot
from typing import Final, TypeAlias

Point: TypeAlias = tuple[float, float, float]
Turn: TypeAlias = tuple[Point, Point, Point]

PLANE, LINE, POINT, AXIS = "plane", "line", "point", "axis"
SIZE: Final = 0.16
"""Half the side of a square, or half the length of a segment, by the size of the robot."""


@dataclass(frozen=True)
class Shape:
    """A constraint that is no leg.

    Attributes
    ----------
    kind : {"plane", "line", "point", "axis"}
    number : int
        Of the constraint, from 1.
    name : str
    place : point
        A point on it, in the frame that it belongs to.
    direction : point
        Along a line or an axis, or normal to a plane; unit length, or 0 for a point.
    joint : point
        The point that it holds, in the other frame.
    moves : bool
        Whether it belongs to the platform; then its joint is one of the base.
    """

    kind: str
    number: int
    name: str
    place: Point
    direction: Point
    joint: Point
    moves: bool = False

    def lines(self, position: Point, rotation: Turn, size: float) -> tuple[tuple[Point, ...], ...]:
        """Open or closed lines that show it in a pose, in the fixed frame, for a robot of this size."""
        place = _moved(position, rotation, self.place) if self.moves else self.place
        held = self.joint if self.moves else _moved(position, rotation, self.joint)
        direction = _turned(rotation, self.direction) if self.moves else self.direction
        if self.kind == POINT:
            return ()
        if self.kind == PLANE:
            foot = _along(held, direction, -_dot(_minus(held, place), direction))
            return (_square(foot, direction, SIZE * size),)
        foot = _along(place, direction, _dot(_minus(held, place), direction))
        segment = (_along(foot, direction, -SIZE * size), _along(foot, direction, SIZE * size))
        return (segment,) if self.kind == LINE else (segment, (foot, held))


def unit(vector: Sequence[float]) -> Point:
    """The direction of a vector."""
    length = hypot(*vector)
    x, y, z = (value / length for value in vector)
    return x, y, z


def _square(centre: Point, normal: Point, half: float) -> tuple[Point, ...]:
    """The corners of a square in a plane, the first one again at the end."""
    least = min(range(3), key=lambda k: abs(normal[k]))
    axis = tuple(float(k == least) for k in range(3))
    u = unit(_cross(normal, axis))
    v = _cross(normal, u)
    corners = [_along(_along(centre, u, a * half), v, b * half) for a, b in ((1, 1), (1, -1), (-1, -1), (-1, 1))]
    return (*corners, corners[0])


def _moved(position: Point, rotation: Turn, point: Point) -> Point:
    x, y, z = (c + value for c, value in zip(position, _turned(rotation, point), strict=True))
    return x, y, z


def _turned(rotation: Turn, vector: Point) -> Point:
    x, y, z = (_dot(row, vector) for row in rotation)
    return x, y, z


def _along(point: Point, direction: Sequence[float], length: float) -> Point:
    x, y, z = (p + length * d for p, d in zip(point, direction, strict=True))
    return x, y, z


def _minus(left: Point, right: Point) -> Point:
    return left[0] - right[0], left[1] - right[1], left[2] - right[2]


def _dot(left: Sequence[float], right: Sequence[float]) -> float:
    return sum(a * b for a, b in zip(left, right, strict=True))


def _cross(left: Sequence[float], right: Sequence[float]) -> Point:
    x, y, z = (left[j] * right[k] - left[k] * right[j] for j, k in ((1, 2), (2, 0), (0, 1)))
    return x, y, z
