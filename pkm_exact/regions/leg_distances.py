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

F and E are the upper ends, N times which has no root in it, u and v lead to the lower ones: U = m N u has rational
polynomials of the roots, m that of a crank, and 1 for others. So the products are

    A = N^2 |u|^2,  B = N^2 |v|^2,  C = N^2 |w|^2,  X = U.(N w) = m N^2 u.w,  Y = V.(N w),  Z = U.V

with |u|^2 the square of the rod, where there is one. The crank turns freely where m is 0: m > 0 is asked for.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from typing import Any

from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Metric
from pkm_exact.poses.limit_checks import nearest_shares
from pkm_exact.regions.chart import Pair, Polynomial, PosePolynomials, moved, rational
from pkm_exact.regions.formula import All, Atom, Formula, Sign, Some
from pkm_exact.regions.joint_quotients import rational_root
from pkm_exact.regions.placed_legs import PlacedLeg, without_squares
from pkm_exact.regions.region_legs import OnCrank, OnSlide, OwnLength, RegionMachine
from pkm_exact.regions.region_legs import product as dot

_GRID = 10**6


@dataclass(frozen=True)
class Direction:
    """A covector, and a number that is not less than its length.

    Attributes
    ----------
    covector : tuple of 3 Fraction
    size : Fraction
    """

    covector: tuple[Fraction, ...]
    size: Fraction


def share_a_joint(leg: Any, other: Any) -> bool:
    """Whether two legs end at one joint, so that their distance is 0 and does not count."""
    fixed = all(isinstance(each.actuator, OwnLength) for each in (leg, other))
    return bool(leg.platform == other.platform or (fixed and leg.base == other.base))


def compared_pairs(machine: RegionMachine, placed: Sequence[PlacedLeg]) -> list[tuple[int, int]]:
    """The pairs of legs that must be apart: those that share no joint; none without that limit.

    Raises
    ------
    InputError
        If a rod slides along an axis, or a hinge is driven.
    """
    if machine.leg_distance is None:
        return []
    for leg in machine.legs:
        if not isinstance(leg.actuator, OwnLength | OnSlide | OnCrank) or leg.axis is not None:
            raise InputError(
                f"limits.leg_distance: {leg.name}: regions know this limit of legs between two joints; remove it from "
                "the model, or leave limits out"
            )
    pairs = combinations(range(len(placed)), 2)
    return [(i, j) for i, j in pairs if not share_a_joint(placed[i].leg, placed[j].leg)]


def legs_apart(
    machine: RegionMachine, pose: PosePolynomials, placed: Sequence[PlacedLeg], box: Sequence[Pair]
) -> list[Formula]:
    """That all legs that share no joint are as far apart as the limits say, as segments; nothing without that limit.

    Raises
    ------
    InputError
        As ``compared_pairs``.
    """
    found: list[Formula] = []
    ways = directions(machine, pose, placed, box)
    for (i, j), direction in zip(compared_pairs(machine, placed), ways, strict=True):
        pair = _Two(machine, pose, placed[i], placed[j], machine.leg_distance or Fraction(0))
        exactly = pair.are_apart()
        found.append(exactly if direction is None else Some((exactly, pair.are_separated(direction))))
    return found


def directions(
    machine: RegionMachine, pose: PosePolynomials, placed: Sequence[PlacedLeg], box: Sequence[Pair]
) -> list[Direction | None]:
    """For each pair of ``compared_pairs`` a direction in which they are apart in the middle of a chart.

    None if they meet there, or a rod does not reach.
    """
    pairs = compared_pairs(machine, placed)
    middle = _Middle(machine.metric, pose, placed, box) if pairs else None
    return [None if middle is None else middle.direction(placed[i], placed[j]) for i, j in pairs]


def _way(leg: PlacedLeg, metric: Metric) -> list[Any]:
    """U, from the upper end of a leg to the lower one."""
    slide = leg.leg.actuator
    size = dot(metric, slide.direction, slide.direction) if isinstance(slide, OnSlide) else 1
    return [-x * rational(1 / Fraction(size)) for x in leg.rod]


class _Middle:
    """The middle of a chart, in floating point: where legs are there."""

    def __init__(self, metric: Metric, pose: PosePolynomials, placed: Sequence[PlacedLeg], box: Sequence[Pair]) -> None:
        at = [rational((low + high) / 2) for low, high in box]
        roots = [leg.root for leg in placed if leg.root is not None]
        squares = [root(*at, *[rational(0)] * len(roots)) for root in roots]
        self._metric, self._pose = metric, pose
        self._is_reached = all(square >= 0 for square in squares)
        exact = [Fraction(int(square.p), int(square.q)) for square in squares]
        self._at = [*at, *(rational(rational_root(max(value, Fraction(0)), 1)) for value in exact)]

    def _value(self, polynomial: Polynomial) -> Fraction:
        value = polynomial(*self._at)
        return Fraction(int(value.p), int(value.q))

    def _ends(self, leg: PlacedLeg) -> tuple[list[float], list[float]] | None:
        """The upper and the lower end in ordinary coordinates; None if a crank turns freely."""
        norm = self._value(self._pose.norm)
        scale = norm if leg.scale is None else norm * self._value(leg.scale)
        if not scale:
            return None
        tip = [self._value(x) / norm for x in moved(self._pose, leg.leg.platform)]
        low = [a + self._value(x) / scale for a, x in zip(tip, _way(leg, self._metric), strict=True)]
        roots = [float(g) ** 0.5 for g in self._metric]
        first, second = ([float(x) * root for x, root in zip(end, roots, strict=True)] for end in (tip, low))
        return first, second

    def direction(self, one: PlacedLeg, other: PlacedLeg) -> Direction | None:
        """A covector from one leg to the other; None if there is none."""
        first, second = (self._ends(leg) if self._is_reached else None for leg in (one, other))
        shares = None if first is None or second is None else nearest_shares(first, second)
        if first is None or second is None or shares is None:
            return None
        near = [
            [a + share * (b - a) for a, b in zip(*ends, strict=True)]
            for share, ends in zip(shares, (first, second), strict=True)
        ]
        between = [b - a for a, b in zip(*near, strict=True)]
        size = max(map(abs, between))
        if not size > 0:
            return None
        roots = [float(g) ** 0.5 for g in self._metric]
        found = tuple(Fraction(round(_GRID * x * root / size), _GRID) for x, root in zip(between, roots, strict=True))
        square = sum((c * c / g for c, g in zip(found, self._metric, strict=True)), Fraction(0))
        return Direction(found, rational_root(square, 1))


class _Two:
    """Two legs and how far apart they must be; names are those of the module's text."""

    def __init__(
        self, machine: RegionMachine, pose: PosePolynomials, one: PlacedLeg, other: PlacedLeg, least: Fraction
    ) -> None:
        self._metric, self._pose, self._placed, self._least = machine.metric, pose, (one, other), least
        self._name = f"{one.leg.name} apart from {other.leg.name}"
        self._scales = [pose.constant(1) if leg.scale is None else leg.scale for leg in self._placed]
        self._ways = [_way(leg, machine.metric) for leg in self._placed]
        first, second = (moved(pose, leg.leg.platform) for leg in self._placed)
        self._between = [q - p for p, q in zip(first, second, strict=True)]

    def _plain(self, polynomial: Any) -> Polynomial:
        found: Polynomial = polynomial
        for leg in self._placed:
            found = without_squares(found, leg, self._pose)
        return found

    def _times(self, *factors: Polynomial) -> Polynomial:
        found: Polynomial = factors[0]
        for factor in factors[1:]:
            found = self._plain(found * factor)
        return found

    def _dot(self, a: Sequence[Any], b: Sequence[Any]) -> Polynomial:
        found: Polynomial = dot(self._metric, a, b)
        return self._plain(found)

    def _square(self, leg: PlacedLeg) -> Polynomial:
        """A, or B."""
        actuator, norm = leg.leg.actuator, self._pose.norm
        if isinstance(actuator, OnSlide | OnCrank):
            square: Polynomial = norm * norm * rational(actuator.rod_squared)
            return square
        found: Polynomial = leg.value[0]
        return found

    def _atom(self, polynomial: Polynomial) -> Atom:
        return Atom(self._name, polynomial)

    def _turned(self) -> list[Formula]:
        """That no crank turns freely."""
        return [
            Atom(f"the crank of {leg.leg.name} has an angle", leg.scale, Sign.POSITIVE)
            for leg in self._placed
            if leg.scale is not None
        ]

    def are_apart(self) -> Formula:
        """Whether they are, exactly."""
        (m, n), (u, v), w = self._scales, self._ways, self._between
        a, b, c = (*(self._square(leg) for leg in self._placed), self._dot(w, w))
        x, y, z = self._dot(u, w), self._dot(v, w), self._dot(u, v)
        far = rational(self._least**2) * self._pose.norm * self._pose.norm
        both = self._times(m, n)
        low = self._times(m, c + a - far) - 2 * x  # of the lower end of the first and the upper of the second
        high = self._times(n, c + b - far) + 2 * y
        ends = (
            c - far,
            low,
            high,
            self._times(both, c + a + b - far) + 2 * (self._times(m, y) - self._times(n, x) - z),
        )
        feet = (
            (-y, self._times(n, b), self._times(n, n, c - far, b)),
            (z - self._times(m, y), self._times(both, b), self._times(m, n, n, b, low)),
            (x, self._times(m, a), self._times(m, m, c - far, a)),
            (z + self._times(n, x), self._times(both, a), self._times(n, m, m, a, high)),
        )
        parts: list[Formula] = [*self._turned(), *map(self._atom, ends)]
        for along, whole, square in feet:
            rest = square - self._times(along, along)
            parts.append(Some((self._atom(-along), self._atom(along - whole), self._atom(rest))))
        gram = self._times(m, m, a, n, n, b) - self._times(z, z)
        s = self._times(n, n, b, x) - self._times(z, y)
        t = self._times(z, x) - self._times(m, m, a, y)
        # The determinant of all products, by its last row: nearest points are s u and t v away.
        line = self._times(gram, c - far) - self._times(s, x) + self._times(t, y)
        inside = (-s, self._times(m, s) - gram, -t, self._times(n, t) - gram, line)
        return All((*parts, Some(tuple(map(self._atom, inside)))))

    def are_separated(self, direction: Direction) -> Formula:
        """Whether all ends of one lie beyond those of the other: then they are apart; if not, this fails too."""
        (m, n), covector = self._scales, [rational(c) for c in direction.covector]
        u, v, w = (
            sum((c * x for c, x in zip(covector, way, strict=True)), self._pose.constant(0))
            for way in (*self._ways, self._between)
        )
        gap = w - rational(self._least * direction.size) * self._pose.norm
        both = self._times(m, n, gap) - self._times(n, u) + self._times(m, v)
        parts = (gap, self._times(m, gap) - u, self._times(n, gap) + v, both)
        return All((*self._turned(), *map(self._atom, parts)))
