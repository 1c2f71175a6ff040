"""Whether legs keep their distance all over a chart, as signs of polynomials.

Two segments, from F to F + u and from E to E + v, w = E - F, are at least d apart exactly if

- every end is at least d from the other segment: from its ends, and where its foot on the line of the segment lies
  between these, |w'|^2 |v|^2 - (w'.v)^2 >= d^2 |v|^2 too;
- and where the lines come nearest to each other between the ends of both, their distance is at least d:

      G3 >= d^2 G2,   G2 = |u|^2 |v|^2 - (u.v)^2,   G3 the determinant of the products of u, v and w,

  nearest at the shares ((w.u) |v|^2 - (u.v)(w.v)) / G2 and ((u.v)(w.u) - |u|^2 (w.v)) / G2

(a convex function of the two shares is least inside or on an edge of the square). All are 0 where the legs are
parallel. So what also suffices is asked: that all ends of one leg lie d beyond those of the other along a direction,
which is the one between their nearest points in the middle of the chart.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, product
from typing import Any, TypeAlias

from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Metric
from pkm_exact.poses.limit_checks import nearest_shares
from pkm_exact.regions.chart import Pair, Polynomial, PosePolynomials, moved, rational
from pkm_exact.regions.formula import All, Atom, Formula, Some
from pkm_exact.regions.joint_quotients import rational_root
from pkm_exact.regions.placed_legs import PlacedLeg, exact_vector, without_squares
from pkm_exact.regions.region_legs import OnSlide, OwnLength, RegionLeg, RegionMachine
from pkm_exact.regions.region_legs import product as dot

Point: TypeAlias = list[Any]
_GRID = 10**6


def share_a_joint(leg: RegionLeg, other: RegionLeg) -> bool:
    """Whether two legs end at one joint, so that their distance is 0 and does not count."""
    fixed = all(isinstance(each.actuator, OwnLength) for each in (leg, other))
    return leg.platform == other.platform or (fixed and leg.base == other.base)


def legs_apart(
    machine: RegionMachine, pose: PosePolynomials, placed: Sequence[PlacedLeg], box: Sequence[Pair]
) -> list[Formula]:
    """That all legs that share no joint are as far apart as the limits say, as segments; nothing without that limit.

    Raises
    ------
    InputError
        If they are neither legs of actuated length nor rods on slides.
    """
    if machine.leg_distance is None:
        return []
    for leg in machine.legs:
        if not isinstance(leg.actuator, OwnLength | OnSlide) or leg.axis is not None:
            raise InputError(
                f"limits.leg_distance: {leg.name}: regions know this limit of legs of actuated length and of rods on "
                "slides; remove it from the model, or leave limits out"
            )
    ends = [_ends(leg, pose, machine.metric) for leg in placed]
    middle = _Middle(pose, placed, box)
    found: list[Formula] = []
    for i, j in combinations(range(len(placed)), 2):
        if share_a_joint(machine.legs[i], machine.legs[j]):
            continue
        pair = _Two(machine, pose, (placed[i], placed[j]), (ends[i], ends[j]), machine.leg_distance)
        direction = middle.direction(machine, ends[i], ends[j])
        exactly = pair.are_apart()
        found.append(exactly if direction is None else Some((exactly, pair.are_separated(direction))))
    return found


def _ends(leg: PlacedLeg, pose: PosePolynomials, metric: Metric) -> tuple[Point, Point]:
    """N times the lower and the upper end of a leg."""
    foot = [pose.norm * rational(a) for a in leg.leg.base]
    actuator = leg.leg.actuator
    if isinstance(actuator, OnSlide):
        along = leg.value[0] * rational(1 / dot(metric, actuator.direction, actuator.direction))  # N q
        foot = [a + along * d for a, d in zip(foot, exact_vector(actuator.direction), strict=True)]
    return foot, moved(pose, leg.leg.platform)


class _Middle:
    """The middle of a chart, in floating point: where legs are there."""

    def __init__(self, pose: PosePolynomials, placed: Sequence[PlacedLeg], box: Sequence[Pair]) -> None:
        at = [rational((low + high) / 2) for low, high in box]
        roots = [leg.root for leg in placed if leg.root is not None]
        squares = [root(*at, *[rational(0)] * len(roots)) for root in roots]
        self._is_reached = all(square >= 0 for square in squares)
        exact = [Fraction(int(square.p), int(square.q)) for square in squares]
        self._at = [*at, *(rational(rational_root(max(value, Fraction(0)), 1)) for value in exact)]
        self._norm = pose.norm(*self._at)

    def _place(self, point: Point) -> list[Fraction]:
        values = [entry(*self._at) / self._norm for entry in point]
        return [Fraction(int(value.p), int(value.q)) for value in values]

    def direction(
        self, machine: RegionMachine, one: tuple[Point, Point], other: tuple[Point, Point]
    ) -> list[Fraction] | None:
        """A covector from one leg to the other; None if they meet there, or a rod does not reach."""
        if not self._is_reached:
            return None
        roots = [float(g) ** 0.5 for g in machine.metric]
        first, second = (
            [[float(x) * root for x, root in zip(self._place(end), roots, strict=True)] for end in ends]
            for ends in (one, other)
        )
        shares = nearest_shares((first[0], first[1]), (second[0], second[1]))
        if shares is None:
            return None
        near = [
            [a + share * (b - a) for a, b in zip(*ends, strict=True)]
            for share, ends in zip(shares, (first, second), strict=True)
        ]
        between = [b - a for a, b in zip(*near, strict=True)]
        size = max(map(abs, between))
        if not size > 0:
            return None
        return [Fraction(round(_GRID * x * root / size), _GRID) for x, root in zip(between, roots, strict=True)]


@dataclass(frozen=True, eq=False)
class _Two:
    """Two legs: their ends times N, and how far apart they must be."""

    machine: RegionMachine
    pose: PosePolynomials
    placed: tuple[PlacedLeg, PlacedLeg]
    ends: tuple[tuple[Point, Point], tuple[Point, Point]]
    least: Fraction

    @property
    def _name(self) -> str:
        return f"{self.placed[0].leg.name} apart from {self.placed[1].leg.name}"

    def _plain(self, polynomial: Polynomial) -> Polynomial:
        for leg in self.placed:
            polynomial = without_squares(polynomial, leg, self.pose)
        return polynomial

    def _dot(self, a: Point, b: Point) -> Polynomial:
        return self._plain(dot(self.machine.metric, a, b))

    def _times(self, a: Polynomial, b: Polynomial) -> Polynomial:
        return self._plain(a * b)

    def _atom(self, polynomial: Polynomial) -> Atom:
        return Atom(self._name, polynomial)

    def are_apart(self) -> Formula:
        """Whether they are, exactly."""
        square = rational(self.least**2)
        far = square * self.pose.norm * self.pose.norm
        parts: list[Formula] = []
        for p, q in product(*self.ends):
            way = _minus(q, p)
            parts.append(self._atom(self._dot(way, way) - far))
        for one, other in (self.ends, self.ends[::-1]):
            v = _minus(other[1], other[0])
            vv = self._dot(v, v)
            for end in one:
                w = _minus(end, other[0])
                along = self._dot(w, v)
                rest = self._times(self._dot(w, w) - far, vv) - self._times(along, along)
                parts.append(Some((self._atom(-along), self._atom(along - vv), self._atom(rest))))
        return All((*parts, self._lines(far)))

    def _lines(self, far: Polynomial) -> Formula:
        (a, b), (c, d) = self.ends
        u, v, w = _minus(b, a), _minus(d, c), _minus(c, a)
        uu, uv, vv = self._dot(u, u), self._dot(u, v), self._dot(v, v)
        uw, vw, ww = self._dot(u, w), self._dot(v, w), self._dot(w, w)
        gram = self._times(uu, vv) - self._times(uv, uv)
        s = self._times(uw, vv) - self._times(uv, vw)
        t = self._times(uv, uw) - self._times(uu, vw)
        # The determinant of all products, by its last row: nearest points are s u and t v away.
        whole = self._times(gram, ww) - self._times(s, uw) + self._times(t, vw)
        line = whole - self._times(far, gram)
        return Some(tuple(self._atom(part) for part in (-s, s - gram, -t, t - gram, line)))

    def are_separated(self, covector: Sequence[Fraction]) -> Formula:
        """Whether all ends of one lie beyond those of the other: then they are apart; if not, this fails too."""
        square = sum((c * c / g for c, g in zip(covector, self.machine.metric, strict=True)), Fraction(0))
        room = rational(self.least * rational_root(square, 1)) * self.pose.norm
        exact = exact_vector((covector[0], covector[1], covector[2]))
        parts = []
        for p, q in product(*self.ends):
            way = sum((c * x for c, x in zip(exact, _minus(q, p), strict=True)), self.pose.constant(0))
            parts.append(self._atom(way - room))
        return All(tuple(parts))


def _minus(a: Point, b: Point) -> Point:
    return [x - y for x, y in zip(a, b, strict=True)]
