"""Areas that are bounded by arcs and segments, enclosed by Green's theorem, and their pieces.

With a fixed orientation a leg of limited length keeps the platform's origin of a planar machine between two circles
about A - R B, a rod on a slide in a strip, between half circles about the ends of the slide. So what is good within a
box is bounded by arcs and segments; its area is half the integral of x dy - y dx along them: r^2 (t2 - t1) +
a (y2 - y1) - b (x2 - x1) for an arc about (a, b), and x1 y2 - x2 y1 for a segment. Every order and side is decided by
balls; where curves touch or coincide nothing is said.
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
from pkm_exact.geometry.limits import Pair
from pkm_exact.precision import working_precision
from pkm_exact.regions.boundary_curves import Circle, Curve, Edge, Point, UndecidedError, decided, meetings
from pkm_exact.regions.region_legs import OnSlide, OwnLength, RegionMachine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.roots.interval import Interval

PRECISION: Final = 256


@dataclass(frozen=True)
class ArcArea:
    """An area, enclosed, and of how many pieces it is: exactly."""

    area: Interval
    pieces: int


def arc_area(machine: RegionMachine, question: RegionQuestion) -> ArcArea | None:
    """The area of a map that is bounded by arcs and segments; None if it is another, or curves touch.

    Parameters
    ----------
    machine : RegionMachine
    question : RegionQuestion
        A map over x and y, of limits of lengths, slides and position only.
    """
    chart, conditions = question.chart, question.conditions
    own = all(isinstance(leg.actuator, OwnLength | OnSlide) and leg.axis is None for leg in machine.legs)
    plain = machine.base_cones is None and machine.platform_cones is None and not question.shape
    plain = plain and machine.leg_distance is None and question.tube is None and not question.joints
    lengths = "limits" in conditions.names and not set(conditions.names) - {"limits", "reachable"}
    if chart.variables != ("x", "y") or not (own and plain and lengths):
        return None
    with working_precision(PRECISION):
        try:
            return _Arrangement(_curves(machine, question)).measured()
        except UndecidedError:
            return None


def _curves(machine: RegionMachine, question: RegionQuestion) -> list[Curve]:
    chart, roots = question.chart, [arb(g).sqrt() for g in machine.metric]
    height = Fraction(chart.position[2]) if not isinstance(chart.position[2], str) else Fraction(0)
    if not all(low <= height <= high for low, high in machine.position[2:]):
        raise UndecidedError
    sides = []
    for k, (low, high) in enumerate(chart.box):
        limited = machine.position[k : k + 1]
        least, greatest = max([low, *(pair[0] for pair in limited)]), min([high, *(pair[1] for pair in limited)])
        if least >= greatest:
            raise UndecidedError
        sides.append((least, greatest))
    (x1, x2), (y1, y2) = ([ball(end) * root for end in pair] for pair, root in zip(sides, roots, strict=False))
    corners = [(x1, y1), (x2, y1), (x2, y2), (x1, y2)]
    curves: list[Curve] = [Edge(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    far = sum((abs(end) for end in (x1, x2, y1, y2)), arb(1))
    rotation = _fixed_rotation(question, machine)
    for k, leg in enumerate(machine.legs):
        arm = [sum((r * b for r, b in zip(row, leg.platform, strict=True)), Fraction(0)) for row in rotation]
        away = leg.base[2] - arm[2] - height
        center = tuple(ball(a - b) * root for a, b, root in zip(leg.base, arm, roots, strict=True))
        if isinstance(leg.actuator, OnSlide):
            square = leg.actuator.rod_squared - machine.metric[2] * away * away
            mode = question.conditions.modes[k]
            curves += _strip(k, leg.actuator, leg.reach, mode, (center[0], center[1]), square, roots, far)
            continue
        if leg.reach is None:
            continue
        for length, inside in zip(leg.reach, (False, True), strict=True):
            square = length * length - machine.metric[2] * away * away
            if square > 0:
                curves.append(Circle((center[0], center[1]), ball(square).sqrt(), inside))
            elif inside:
                raise UndecidedError
    return curves


def _strip(
    k: int,
    slide: OnSlide,
    reach: Pair | None,
    mode: int,
    start: Point,
    square: Fraction,
    roots: Sequence[arb],
    far: arb,
) -> list[Curve]:
    """Where a rod on a slide reaches, and where the slide is within its limits: a strip, cut by two half circles."""
    if slide.direction[2] or square <= 0:
        raise UndecidedError
    d = tuple(ball(x) * root for x, root in zip(slide.direction[:2], roots, strict=False))
    size = (d[0] * d[0] + d[1] * d[1]).sqrt()
    u, v, radius = d[0] / size, d[1] / size, ball(square).sqrt()
    reachable = far + abs(start[0]) + abs(start[1]) + radius
    found: list[Curve] = []
    for side in (1, -1):
        foot = (-side * v * radius, side * u * radius)
        middle = (start[0] + foot[0], start[1] + foot[1])
        ends = [(middle[0] + way * u * reachable, middle[1] + way * v * reachable) for way in (side, -side)]
        found.append(Edge(ends[0], ends[1], foot, k))
    for place, end in enumerate(reach or ()):
        center = (start[0] + ball(end) * d[0], start[1] + ball(end) * d[1])
        # q <= end below the half circle that the rod points to, q >= end beyond it; the mode says which half it is.
        found.append(Circle(center, radius, (place == 1) is (mode < 0), (-mode * u, -mode * v), k))
    return found


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


class _Arrangement:
    """Curves that bound an area: what is good lies on one side of each."""

    def __init__(self, curves: Sequence[Curve]) -> None:
        self._curves = curves

    def measured(self) -> ArcArea:
        """The sum over all boundary arcs, and the number of loops that go round counterclockwise."""
        pieces: list[tuple[Any, Any, arb]] = []
        loops: list[arb] = []
        for place, curve in enumerate(self._curves):
            marks = self._marks(place)
            if isinstance(curve, Edge):
                pieces += self._segments(place, curve, marks)
            elif marks:
                pieces += self._arcs(place, curve, marks)
            elif curve.middle is None and self._is_boundary(place, curve.at(arb(0))):
                whole = 2 * arb.pi() * curve.radius * curve.radius
                loops.append(whole if curve.inside else -whole)
        loops += _joined(pieces)
        total = arb(0)
        for value in loops:
            total += value / 2
        outer = sum(decided(value) for value in loops)
        low, high = (_exact(end) for end in (total.lower(), total.upper()))
        return ArcArea(Interval(max(low, Fraction(0)), max(high, Fraction(0))), outer)

    def _is_boundary(self, place: int, point: Point) -> bool:
        # Half circles say something of points in their strip only: the strips are asked first.
        others = [curve for k, curve in enumerate(self._curves) if k != place]
        return all(other.holds(point) for kind in (Edge, Circle) for other in others if isinstance(other, kind))

    def _marks(self, place: int) -> list[tuple[arb, Any]]:
        """Where other curves meet a curve: parameter, and the name of the point."""
        found = []
        curve = self._curves[place]
        for k, other in enumerate(self._curves):
            if k == place:
                continue
            pair = (curve, other) if place < k else (other, curve)
            for number, point in enumerate(meetings(*pair)):
                mark = curve.share_of(point) if isinstance(curve, Edge) else curve.angle_of(point)
                found.append((mark, (min(place, k), max(place, k), number)))
        if isinstance(curve, Edge):
            found = [mark for mark in found if decided(mark[0] + _TINY) and decided(1 + _TINY - mark[0])]
        found.sort(key=lambda mark: float(mark[0].mid()))
        for (a, _), (b, _) in pairwise(found):
            if not a < b:
                raise UndecidedError
        return found

    def _segments(self, place: int, edge: Edge, marks: list[tuple[arb, Any]]) -> list[tuple[Any, Any, arb]]:
        found = []
        for (a, first), (b, last) in pairwise(marks):
            p, q = edge.at(a), edge.at(b)
            if self._is_boundary(place, edge.at((a + b) / 2)):
                found.append((first, last, p[0] * q[1] - q[0] * p[1]))
        return found

    def _arcs(self, place: int, circle: Circle, marks: list[tuple[arb, Any]]) -> list[tuple[Any, Any, arb]]:
        found = []
        turn = 2 * arb.pi()
        for (a, first), (b, last) in zip(marks, [*marks[1:], (marks[0][0] + turn, marks[0][1])], strict=True):
            middle = circle.at((a + b) / 2)
            if not (circle.is_on(middle) and self._is_boundary(place, middle)):
                continue
            (x, y), (p, q) = circle.center, (circle.at(angle) for angle in (a, b))
            value = circle.radius * circle.radius * (b - a) + x * (q[1] - p[1]) - y * (q[0] - p[0])
            found.append((first, last, value) if circle.inside else (last, first, -value))
        return found


_TINY: Final = arb(2) ** -100


def _joined(pieces: list[tuple[Any, Any, arb]]) -> list[arb]:
    """The loops that pieces form, each with the sum of its integrals."""
    following = {first: (last, value) for first, last, value in pieces}
    if len(following) != len(pieces):
        raise UndecidedError
    loops = []
    while following:
        start, (here, total) = following.popitem()
        while here != start:
            if here not in following:
                raise UndecidedError
            here, value = following.pop(here)
            total = total + value
        loops.append(total)
    return loops


def _exact(value: arb) -> Fraction:
    mantissa, exponent = value.mid().man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)
