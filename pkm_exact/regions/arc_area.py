"""Areas that are bounded by arcs and segments, enclosed by Green's theorem, and their pieces.

With a fixed orientation a leg of limited length keeps the platform's origin of a planar machine between two circles
about A - R B. So what is good within a box is bounded by arcs and segments; its area is half the integral of
x dy - y dx along them: r^2 (t2 - t1) + r (a (sin t2 - sin t1) - b (cos t2 - cos t1)) for an arc about (a, b), and
x1 y2 - x2 y1 for a segment. Every order and side is decided by balls; where curves touch or coincide nothing is said.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any, Final

from flint import arb

from pkm_exact.balls import ball
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.precision import working_precision
from pkm_exact.regions.region_legs import OwnLength, RegionMachine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.roots.interval import Interval

PRECISION: Final = 256

Point = tuple[arb, arb]


@dataclass(frozen=True)
class ArcArea:
    """An area, enclosed, and of how many pieces it is: exactly."""

    area: Interval
    pieces: int


class _UndecidedError(Exception):
    """Two curves touch, coincide or come too near."""


@dataclass(frozen=True, eq=False)
class _Circle:
    center: Point
    radius: arb
    inside: bool

    def holds(self, point: Point) -> bool:
        x, y = point[0] - self.center[0], point[1] - self.center[1]
        difference = self.radius * self.radius - x * x - y * y
        return _decided(difference if self.inside else -difference)


@dataclass(frozen=True, eq=False)
class _Edge:
    """The points start + t (end - start); what is good lies to the left."""

    start: Point
    end: Point

    def holds(self, point: Point) -> bool:
        (x1, y1), (x2, y2) = self.start, self.end
        return _decided((x2 - x1) * (point[1] - y1) - (y2 - y1) * (point[0] - x1))


def arc_area(machine: RegionMachine, question: RegionQuestion) -> ArcArea | None:
    """The area of a map that is bounded by arcs and segments; None if it is another, or curves touch.

    Parameters
    ----------
    machine : RegionMachine
    question : RegionQuestion
        A map over x and y, of limits of lengths and position only.
    """
    chart = question.chart
    own = all(isinstance(leg.actuator, OwnLength) for leg in machine.legs)
    plain = machine.base_cones is None and machine.platform_cones is None and not question.shape
    lengths = "limits" in question.conditions.asked and not {"no_type_1", "no_type_2"} & set(question.conditions.asked)
    if chart.variables != ("x", "y") or not (own and plain and lengths):
        return None
    with working_precision(PRECISION):
        try:
            return _Arrangement(_curves(machine, question)).measured()
        except _UndecidedError:
            return None


def _curves(machine: RegionMachine, question: RegionQuestion) -> list[Any]:
    chart, roots = question.chart, [arb(g).sqrt() for g in machine.metric]
    height = Fraction(chart.position[2]) if not isinstance(chart.position[2], str) else Fraction(0)
    sides = []
    for k, (low, high) in enumerate(chart.box):
        limited = machine.position[k : k + 1]
        least, greatest = max([low, *(pair[0] for pair in limited)]), min([high, *(pair[1] for pair in limited)])
        if least >= greatest:
            raise _UndecidedError
        sides.append((least, greatest))
    (x1, x2), (y1, y2) = ([ball(end) * root for end in pair] for pair, root in zip(sides, roots, strict=False))
    corners = [(x1, y1), (x2, y1), (x2, y2), (x1, y2)]
    curves: list[Any] = [_Edge(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    rotation = _fixed_rotation(question, machine)
    for leg in machine.legs:
        if leg.reach is None:
            continue
        arm = [sum((r * b for r, b in zip(row, leg.platform, strict=True)), Fraction(0)) for row in rotation]
        away = leg.base[2] - arm[2] - height
        center = tuple(ball(a - b) * root for a, b, root in zip(leg.base, arm, roots, strict=True))
        for length, inside in zip(leg.reach, (False, True), strict=True):
            square = length * length - machine.metric[2] * away * away
            if square > 0:
                curves.append(_Circle((center[0], center[1]), ball(square).sqrt(), inside))
            elif inside:
                raise _UndecidedError
    return curves


def _fixed_rotation(question: RegionQuestion, machine: RegionMachine) -> Any:
    from pkm_exact.regions.chart import pose_polynomials

    chart = question.chart
    if chart.quaternion is not None:
        return rotation_of(chart.quaternion, machine.metric)
    pose = pose_polynomials(chart, machine.metric)
    at = [0] * len(chart.variables)

    def number(polynomial: Any) -> Fraction:
        value = polynomial(*at)
        return Fraction(int(value.p), int(value.q))

    norm = number(pose.norm)
    return [[number(entry) / norm for entry in row] for row in pose.rotation]


def _decided(value: arb) -> bool:
    if value > 0:
        return True
    if value < 0:
        return False
    raise _UndecidedError


class _Arrangement:
    """Curves that bound an area: what is good lies on one side of each."""

    def __init__(self, curves: Sequence[Any]) -> None:
        self._curves = curves

    def measured(self) -> ArcArea:
        """The sum over all boundary arcs, and the number of loops that go round counterclockwise."""
        pieces: list[tuple[Any, Any, arb]] = []
        loops: list[arb] = []
        for place, curve in enumerate(self._curves):
            marks = self._marks(place)
            if isinstance(curve, _Edge):
                pieces += self._segments(place, curve, marks)
            elif marks:
                pieces += self._arcs(place, curve, marks)
            elif self._is_boundary(place, (curve.center[0] + curve.radius, curve.center[1])):
                whole = 2 * arb.pi() * curve.radius * curve.radius
                loops.append(whole if curve.inside else -whole)
        loops += _joined(pieces)
        total = arb(0)
        for value in loops:
            total += value / 2
        outer = sum(_decided(value) for value in loops)
        low, high = (_exact(end) for end in (total.lower(), total.upper()))
        return ArcArea(Interval(max(low, Fraction(0)), max(high, Fraction(0))), outer)

    def _is_boundary(self, place: int, point: Point) -> bool:
        return all(other.holds(point) for k, other in enumerate(self._curves) if k != place)

    def _marks(self, place: int) -> list[tuple[arb, Any]]:
        """Where other curves meet a curve: parameter, and the name of the point."""
        found = []
        curve = self._curves[place]
        for k, other in enumerate(self._curves):
            if k == place:
                continue
            for number, point in enumerate(_meetings(*sorted(((place, curve), (k, other)), key=lambda pair: pair[0]))):
                found.append((_parameter(curve, point), (min(place, k), max(place, k), number)))
        if isinstance(curve, _Edge):
            found = [mark for mark in found if _decided(mark[0] + _TINY) and _decided(1 + _TINY - mark[0])]
        found.sort(key=lambda mark: float(mark[0].mid()))
        for (a, _), (b, _) in pairwise(found):
            if not a < b:
                raise _UndecidedError
        return found

    def _segments(self, place: int, edge: _Edge, marks: list[tuple[arb, Any]]) -> list[tuple[Any, Any, arb]]:
        found = []
        for (a, first), (b, last) in pairwise(marks):
            p, q = _on(edge, a), _on(edge, b)
            if self._is_boundary(place, _on(edge, (a + b) / 2)):
                found.append((first, last, p[0] * q[1] - q[0] * p[1]))
        return found

    def _arcs(self, place: int, circle: _Circle, marks: list[tuple[arb, Any]]) -> list[tuple[Any, Any, arb]]:
        found = []
        turn = 2 * arb.pi()
        for (a, first), (b, last) in zip(marks, [*marks[1:], (marks[0][0] + turn, marks[0][1])], strict=True):
            if not self._is_boundary(place, _at_angle(circle, (a + b) / 2)):
                continue
            r, (x, y) = circle.radius, circle.center
            value = r * r * (b - a) + r * (x * (b.sin() - a.sin()) - y * (b.cos() - a.cos()))
            found.append((first, last, value) if circle.inside else (last, first, -value))
        return found


_TINY: Final = arb(2) ** -100


def _joined(pieces: list[tuple[Any, Any, arb]]) -> list[arb]:
    """The loops that pieces form, each with the sum of its integrals."""
    following = {first: (last, value) for first, last, value in pieces}
    if len(following) != len(pieces):
        raise _UndecidedError
    loops = []
    while following:
        start, (here, total) = following.popitem()
        while here != start:
            if here not in following:
                raise _UndecidedError
            here, value = following.pop(here)
            total = total + value
        loops.append(total)
    return loops


def _meetings(one: tuple[int, Any], other: tuple[int, Any]) -> list[Point]:
    first, second = one[1], other[1]
    if isinstance(first, _Edge) and isinstance(second, _Edge):
        # Neighbours of the box meet in a corner, opposite ones nowhere.
        if other[0] - one[0] == 1:
            return [first.end]
        return [first.start] if (one[0], other[0]) == (0, 3) else []
    if isinstance(first, _Edge):
        return _line_and_circle(first, second)
    return _two_circles(first, second)


def _line_and_circle(edge: _Edge, circle: _Circle) -> list[Point]:
    dx, dy = edge.end[0] - edge.start[0], edge.end[1] - edge.start[1]
    ex, ey = edge.start[0] - circle.center[0], edge.start[1] - circle.center[1]
    a, b, c = dx * dx + dy * dy, dx * ex + dy * ey, ex * ex + ey * ey - circle.radius * circle.radius
    square = b * b - a * c
    if not _decided(square):
        return []
    return [_on(edge, (sign * square.sqrt() - b) / a) for sign in (-1, 1)]


def _two_circles(one: _Circle, other: _Circle) -> list[Point]:
    dx, dy = other.center[0] - one.center[0], other.center[1] - one.center[1]
    square = dx * dx + dy * dy
    if not square > 0 and _decided(abs(one.radius - other.radius)):  # concentric
        return []
    along = (square + one.radius * one.radius - other.radius * other.radius) / 2
    height = square * one.radius * one.radius - along * along
    if not _decided(height):
        return []
    root = height.sqrt()
    x, y = one.center
    return [(x + (along * dx - s * root * dy) / square, y + (along * dy + s * root * dx) / square) for s in (-1, 1)]


def _parameter(curve: Any, point: Point) -> arb:
    if isinstance(curve, _Circle):
        angle: arb = arb.atan2(point[1] - curve.center[1], point[0] - curve.center[0])
        return angle
    dx, dy = curve.end[0] - curve.start[0], curve.end[1] - curve.start[1]
    share: arb = ((point[0] - curve.start[0]) * dx + (point[1] - curve.start[1]) * dy) / (dx * dx + dy * dy)
    return share


def _on(edge: _Edge, t: arb) -> Point:
    return edge.start[0] + t * (edge.end[0] - edge.start[0]), edge.start[1] + t * (edge.end[1] - edge.start[1])


def _at_angle(circle: _Circle, angle: arb) -> Point:
    return circle.center[0] + circle.radius * angle.cos(), circle.center[1] + circle.radius * angle.sin()


def _exact(value: arb) -> Fraction:
    mantissa, exponent = value.mid().man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)
