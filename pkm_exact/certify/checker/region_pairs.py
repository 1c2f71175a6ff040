"""That legs keep their least distance, as signs of polynomials (``docs/certificates-regions.md``)."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from pkm_exact.certify.checker.region_document import LegEntry, RegionDocument
from pkm_exact.certify.checker.region_document_2 import compared_pairs
from pkm_exact.certify.checker.region_ring import Condition, Deferred, PlacedLeg, RegionRing, Signed


def legs_apart(document: RegionDocument, ring: RegionRing, norm: Any, legs: Sequence[PlacedLeg]) -> list[Condition]:
    """One condition for every two legs that must be apart; the costly part of it is made when it is needed."""
    segments = [_Segment(entry, leg, ring, document.metric) for entry, leg in zip(document.legs, legs, strict=True)]
    found: list[Condition] = []
    for (i, j), direction in zip(compared_pairs(document), document.directions, strict=True):
        way = [b - a for a, b in zip(legs[i].arm, legs[j].arm, strict=True)]
        pair = _Pair(ring, norm, segments[i], segments[j], way, document.leg_distance or Fraction(0))
        separated = [] if direction is None else [pair.beyond_each_other(direction)]
        found.append(("or", [*separated, Deferred(pair.apart)]))
    return found


class _Segment:
    """A leg: m, U from the upper end to the lower one, and N^2 times its squared length."""

    def __init__(self, entry: LegEntry, leg: PlacedLeg, ring: RegionRing, metric: Sequence[int]) -> None:
        self.leg, self.square = leg, leg.square
        self.scale = ring.number(1) if leg.scale is None else leg.scale
        size = Fraction(1)
        if len(entry.axes) == 1:
            size = sum((g * d * d for g, d in zip(metric, entry.axes[0], strict=True)), Fraction(0))
        self.way = [-ring.number(1 / size) * x for x in leg.rod]


class _Pair:
    """Two legs and the way W between their upper ends; letters are those of the specification."""

    def __init__(
        self, ring: RegionRing, norm: Any, one: _Segment, other: _Segment, way: Sequence[Any], least: Fraction
    ) -> None:
        self._ring, self._norm, self._one, self._other, self._way, self._least = ring, norm, one, other, way, least

    def _times(self, *factors: Any) -> Any:
        found = factors[0]
        for factor in factors[1:]:
            found = self._plain(self._ring.times(found, factor))
        return found

    def _plain(self, polynomial: Any) -> Any:
        for segment in (self._one, self._other):
            polynomial = self._ring.reduced(polynomial, segment.leg)
        return polynomial

    def _dot(self, left: Sequence[Any], right: Sequence[Any]) -> Any:
        return self._plain(self._ring.dot(left, right))

    def _turned(self) -> list[Condition]:
        """That no crank turns freely."""
        return [Signed(x.scale, "+") for x in (self._one, self._other) if x.leg.scale is not None]

    def beyond_each_other(self, direction: Sequence[Fraction]) -> Condition:
        """All ends of one leg are beyond those of the other along a direction."""
        ring, (m, n) = self._ring, (self._one.scale, self._other.scale)
        covector = [ring.number(c) for c in direction[:3]]
        w, u, v = (
            ring.times(covector[0], way[0]) + ring.times(covector[1], way[1]) + ring.times(covector[2], way[2])
            for way in (self._way, self._one.way, self._other.way)
        )
        h = w - ring.number(self._least * direction[3]) * self._norm
        last = self._times(m, n, h) - self._times(n, u) + self._times(m, v)
        parts = (h, self._times(m, h) - u, self._times(n, h) + v, last)
        return ("and", [*self._turned(), *(Signed(part, "0+") for part in parts)])

    def apart(self) -> Condition:
        """Ends from ends, ends from what is between, and lines from each other."""
        ring, times = self._ring, self._times
        m, n, a, b = self._one.scale, self._other.scale, self._one.square, self._other.square
        c, x, y = (self._dot(one, self._way) for one in (self._way, self._one.way, self._other.way))
        z = self._dot(self._one.way, self._other.way)
        f = ring.number(self._least**2) * ring.times(self._norm, self._norm)
        p = c - f
        q, s = times(m, p + a) - 2 * x, times(n, p + b) + 2 * y
        mn = times(m, n)
        parts: list[Condition] = [Signed(part, "0+") for part in (p, q, s)]
        parts.append(Signed(times(mn, p + a + b) + 2 * (times(m, y) - times(n, x) - z), "0+"))
        for along, whole, square in (
            (-y, times(n, b), times(n, n, p, b)),
            (z - times(m, y), times(mn, b), times(m, n, n, b, q)),
            (x, times(m, a), times(m, m, p, a)),
            (z + times(n, x), times(mn, a), times(n, m, m, a, s)),
        ):
            either = (-along, along - whole, square - times(along, along))
            parts.append(("or", [Signed(part, "0+") for part in either]))
        gram = times(m, m, n, n, a, b) - times(z, z)
        first, second = times(n, n, b, x) - times(z, y), times(z, x) - times(m, m, a, y)
        line = times(p, gram) - times(first, x) + times(second, y)
        nearest = (-first, times(m, first) - gram, -second, times(n, second) - gram, line)
        parts.append(("or", [Signed(part, "0+") for part in nearest]))
        return ("and", [*self._turned(), *parts])
