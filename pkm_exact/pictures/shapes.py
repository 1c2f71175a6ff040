"""What constraints that are no legs look like: planes, lines, points and axes, at the joints that they hold.

A plane is drawn as a square around its joint, a line and an axis as a segment along it; those of the platform move
with it. An angle is two axes that cross in the platform's origin, like those of a universal joint; or, on a machine
whose axes all meet in one point, an arc of the sphere about it, from one axis to the other: that is the link. An arm is
what drives put between base and constraint. A strut is a plane that a rod stands upright on: the rail or crank up to
it, and the rod.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2, cos, hypot, sin
from typing import Final, TypeAlias

Point: TypeAlias = tuple[float, float, float]
Turn: TypeAlias = tuple[Point, Point, Point]

PLANE, LINE, POINT, AXIS, ARM, ARC, AXES = "plane", "line", "point", "axis", "arm", "arc", "axes"
STRUT = "strut"
_PIECES: Final = 12
_FLAT: Final = 1e-9
SIZE: Final = 0.16
"""Half the side of a square, or half the length of a segment, by the size of the robot."""


@dataclass(frozen=True)
class Shape:
    """A constraint that is no leg.

    Attributes
    ----------
    kind : {"plane", "line", "point", "axis", "arm", "arc", "axes", "strut"}
    number : int
        Of the constraint, from 1.
    name : str
    place : point
        A point on it, in the frame that it belongs to.
    direction : point
        Along a line or an axis, or normal to a plane; unit length, or 0 for a point. Of an angle that of the base. Of a
        strut all of it, from the rail on which it stands to its joint.
    joint : point
        The point that it holds, in the other frame; of an angle the direction of the platform.
    moves : bool
        Whether it belongs to the platform; then its joint is one of the base.
    path : tuple of points
        The line of an arm, in the fixed frame; it may be shifted along its direction, if it has one.
    standing : int
        How many points of the line are not shifted: an arm that is an axis begins at its motor.
    """

    kind: str
    number: int
    name: str
    place: Point
    direction: Point
    joint: Point
    moves: bool = False
    path: tuple[Point, ...] = ()
    standing: int = 0

    def lines(self, position: Point, rotation: Turn, size: float) -> tuple[tuple[Point, ...], ...]:
        """Open or closed lines that show it in a pose, in the fixed frame, for a robot of this size."""
        place = _moved(position, rotation, self.place) if self.moves else self.place
        held = self.joint if self.moves else _moved(position, rotation, self.joint)
        direction = _turned(rotation, self.direction) if self.moves else self.direction
        if self.kind == ARM:
            # Along an axis it stands where the joint does.
            shift = _dot(_minus(_moved(position, rotation, self.joint), self.path[-1]), self.direction)
            moved = (_along(point, self.direction, shift) for point in self.path[self.standing :])
            return ((*self.path[: self.standing], *moved),)
        if self.kind == STRUT:
            foot = _along(held, direction, -1)
            return (place, foot), (foot, held)
        if self.kind in (ARC, AXES):
            return self._of_angle(position, _turned(rotation, self.joint), size)
        if self.kind == POINT:
            return ()
        if self.kind == PLANE:
            foot = _along(held, direction, -_dot(_minus(held, place), direction))
            return (_square(foot, direction, SIZE * size),)
        foot = _along(place, direction, _dot(_minus(held, place), direction))
        segment = (_along(foot, direction, -SIZE * size), _along(foot, direction, SIZE * size))
        return (segment,) if self.kind == LINE else (segment, (foot, held))

    def _of_angle(self, centre: Point, other: Point, size: float) -> tuple[tuple[Point, ...], ...]:
        if self.kind == ARC:
            return (tuple(_moved_by(centre, point) for point in arc(self.direction, other)),)
        return tuple(
            (_along(centre, axis, -SIZE * size), _along(centre, axis, SIZE * size)) for axis in (self.direction, other)
        )


def arc(first: Point, second: Point) -> tuple[Point, ...]:
    """Points of the unit sphere along the shortest way from one to another.

    Examples
    --------
    >>> [round(x, 3) for x in arc((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))[6]]
    [0.707, 0.707, 0.0]
    """
    across = _along(second, first, -_dot(first, second))
    if hypot(*across) < _FLAT:
        return first, second
    side, angle = unit(across), atan2(hypot(*across), _dot(first, second))
    turns = [angle * k / _PIECES for k in range(_PIECES + 1)]
    return tuple(_along(_scaled(first, cos(turn)), side, sin(turn)) for turn in turns)


def unit(vector: Sequence[float]) -> Point:
    """The direction of a vector."""
    length = hypot(*vector)
    x, y, z = (value / length for value in vector)
    return x, y, z


def _square(centre: Point, normal: Point, half: float) -> tuple[Point, ...]:
    """The corners of a square in a plane, the first one again at the end."""
    least = min(range(3), key=lambda k: abs(normal[k]))
    axis = tuple(float(k == least) for k in range(3))
    u = unit(cross(normal, axis))
    v = cross(normal, u)
    corners = [_along(_along(centre, u, a * half), v, b * half) for a, b in ((1, 1), (1, -1), (-1, -1), (-1, 1))]
    return (*corners, corners[0])


def _moved(position: Point, rotation: Turn, point: Point) -> Point:
    x, y, z = (c + value for c, value in zip(position, _turned(rotation, point), strict=True))
    return x, y, z


def _turned(rotation: Turn, vector: Point) -> Point:
    x, y, z = (_dot(row, vector) for row in rotation)
    return x, y, z


def _moved_by(centre: Point, point: Point) -> Point:
    return _along(point, centre, 1.0)


def _scaled(point: Point, factor: float) -> Point:
    return point[0] * factor, point[1] * factor, point[2] * factor


def _along(point: Point, direction: Sequence[float], length: float) -> Point:
    x, y, z = (p + length * d for p, d in zip(point, direction, strict=True))
    return x, y, z


def _minus(left: Point, right: Point) -> Point:
    return left[0] - right[0], left[1] - right[1], left[2] - right[2]


def _dot(left: Sequence[float], right: Sequence[float]) -> float:
    return sum(a * b for a, b in zip(left, right, strict=True))


def cross(left: Sequence[float], right: Sequence[float]) -> Point:
    """The vector product."""
    x, y, z = (left[j] * right[k] - left[k] * right[j] for j, k in ((1, 2), (2, 0), (0, 1)))
    return x, y, z
