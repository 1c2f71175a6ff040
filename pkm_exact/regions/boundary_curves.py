"""Arcs and segments that bound what is good, where they meet, and on which side of them it lies.

All is in balls; what they do not decide is refused: curves that touch or coincide.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from flint import arb

Point: TypeAlias = tuple[arb, arb]


class UndecidedError(Exception):
    """Two curves touch, coincide or come too near."""


@dataclass(frozen=True, eq=False)
class Circle:
    """A circle, with what is good inside or outside; or the half of it about a direction, which bounds a strip as wide.

    Attributes
    ----------
    center : Point
    radius : arb
    inside : bool
    middle : Point or None
        The direction, of length 1, of a half circle. What is good lies in the strip: if ``inside`` on the side of the
        center, otherwise beyond the half circle.
    leg : int
        Of a half circle, which leg's strip it bounds.
    """

    center: Point
    radius: arb
    inside: bool
    middle: Point | None = None
    leg: int = -1

    def is_on(self, point: Point) -> bool:
        """Whether a point of the circle is on the half that counts."""
        return self.middle is None or decided(_dot(self.middle, _minus(point, self.center)))

    def holds(self, point: Point) -> bool:
        """Whether a point, of the strip if there is one, is on the good side."""
        way = _minus(point, self.center)
        if self.middle is not None and not decided(_dot(self.middle, way)):
            return self.inside
        return decided(self.radius * self.radius - _dot(way, way)) is self.inside

    def angle_of(self, point: Point) -> arb:
        """From the middle, or from the x axis, between -pi and pi."""
        x, y = _minus(point, self.center)
        if self.middle is not None:
            u, v = self.middle
            x, y = u * x + v * y, u * y - v * x
        angle: arb = arb.atan2(y, x)
        return angle

    def at(self, angle: arb) -> Point:
        """The point at an angle."""
        u, v = self.middle or (arb(1), arb(0))
        c, s = self.radius * angle.cos(), self.radius * angle.sin()
        return self.center[0] + u * c - v * s, self.center[1] + u * s + v * c


@dataclass(frozen=True, eq=False)
class Edge:
    """The points start + t (end - start); what is good lies to the left.

    Attributes
    ----------
    start, end : Point
    foot : Point or None
        Of a side of a leg's strip: from the center of a half circle that bounds it to where it begins.
    leg : int
    """

    start: Point
    end: Point
    foot: Point | None = None
    leg: int = -1

    def holds(self, point: Point) -> bool:
        """Whether a point is on the good side."""
        return decided(_cross(_minus(self.end, self.start), _minus(point, self.start)))

    def share_of(self, point: Point) -> arb:
        """t."""
        way = _minus(self.end, self.start)
        return _dot(_minus(point, self.start), way) / _dot(way, way)

    def at(self, t: arb) -> Point:
        """The point at t."""
        way = _minus(self.end, self.start)
        return self.start[0] + t * way[0], self.start[1] + t * way[1]


Curve: TypeAlias = Circle | Edge


def _minus(a: Point, b: Point) -> Point:
    return a[0] - b[0], a[1] - b[1]


def _dot(a: Point, b: Point) -> arb:
    return a[0] * b[0] + a[1] * b[1]


def _cross(a: Point, b: Point) -> arb:
    return a[0] * b[1] - a[1] * b[0]


def decided(value: arb) -> bool:
    """Whether a number is positive.

    Raises
    ------
    UndecidedError
        If its ball holds 0.
    """
    if value > 0:
        return True
    if value < 0:
        return False
    raise UndecidedError


def meetings(first: Curve, second: Curve) -> list[Point]:
    """Where two curves cross, edges as lines, always in the same order for the same two."""
    if isinstance(first, Edge) and isinstance(second, Edge):
        return _two_lines(first, second)
    if isinstance(first, Circle) and isinstance(second, Circle):
        found = _two_circles(first, second)
        return [point for point in found if first.is_on(point) and second.is_on(point)]
    edge, circle = (first, second) if isinstance(first, Edge) else (second, first)
    assert isinstance(edge, Edge)  # noqa: S101 - for the type checker
    assert isinstance(circle, Circle)  # noqa: S101 - for the type checker
    if edge.foot is not None and edge.leg == circle.leg:
        return [(circle.center[0] + edge.foot[0], circle.center[1] + edge.foot[1])]
    return [point for point in _line_and_circle(edge, circle) if circle.is_on(point)]


def _two_lines(one: Edge, other: Edge) -> list[Point]:
    first, second = _minus(one.end, one.start), _minus(other.end, other.start)
    between, turn = _minus(other.start, one.start), _cross(first, second)
    if not (turn > 0 or turn < 0):
        # Parallel, or nearly: both ends on one side, or refused.
        if decided(_cross(first, between)) is not decided(_cross(first, _minus(other.end, one.start))):
            raise UndecidedError
        return []
    return [one.at(_cross(between, second) / turn)]


def _line_and_circle(edge: Edge, circle: Circle) -> list[Point]:
    way, from_center = _minus(edge.end, edge.start), _minus(edge.start, circle.center)
    a, b = _dot(way, way), _dot(way, from_center)
    square = b * b - a * (_dot(from_center, from_center) - circle.radius * circle.radius)
    if not decided(square):
        return []
    return [edge.at((sign * square.sqrt() - b) / a) for sign in (-1, 1)]


def _two_circles(one: Circle, other: Circle) -> list[Point]:
    dx, dy = _minus(other.center, one.center)
    square = dx * dx + dy * dy
    if not square > 0 and decided(abs(one.radius - other.radius) - square.abs_upper().sqrt()):  # concentric, or nearly
        return []
    along = (square + one.radius * one.radius - other.radius * other.radius) / 2
    height = square * one.radius * one.radius - along * along
    if not decided(height):
        return []
    root = height.sqrt()
    x, y = one.center
    return [(x + (along * dx - s * root * dy) / square, y + (along * dy + s * root * dx) / square) for s in (-1, 1)]
