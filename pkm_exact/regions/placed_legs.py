"""A leg all over a chart: what its joint value is, when it has one, and its rod, as polynomials.

With N the norm of the chart and e = N (C + R B - A), products in the metric, s the sign of the working mode:

    own length   N^2 l^2 = |e|^2,                                        rod e
    hinge        p = N (u.(C + R B) - o_1), q = N (v.(C + R B) - o_2),   p v - q u instead of a rod
    slide        a = |d|^2, b = d.e, D = b^2 - a (|e|^2 - r^2 N^2),      rod a e - (b + s y) d
                 a N q = b + s y, y = sqrt(D)
    crank        a = 2 N u.e, b = 2 N v.e, h = |e|^2 + (|u|^2 - r^2) N^2, m = a^2 + b^2 / w, D = (m - h^2) / w,
                 m cos = a h - s b y, m sin = b h / w + s a y, y = sqrt(D)
                                                                         rod m e - N (m cos) u - N (m sin) v

The rod is a positive multiple of C + R B - K, K its lower end. Of a rod that slides along an axis, e is what is
perpendicular to it.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.inverse import Metric
from pkm_exact.regions.chart import Polynomial, PosePolynomials, moved, rational
from pkm_exact.regions.region_legs import OnCrank, OnHinge, OnSlide, RegionLeg, product


@dataclass(frozen=True, eq=False)
class PlacedLeg:
    """A leg at the poses of a chart.

    Attributes
    ----------
    leg : RegionLeg
    arm : list of 3 polynomials
        N R B.
    rod : list of 3 polynomials
        A positive multiple of the rod.
    value : tuple of polynomials
        Of a leg (|e|^2, N^2): l^2 is their quotient. Of a slide (b + s y, a N): q is. Of a crank (m cos, m sin).
    root : polynomial or None
        D, if there is a y.
    place : int
        That of y among the generators of the ring.
    scale : polynomial or None
        Of a crank m, of which the value is a multiple.
    """

    leg: RegionLeg
    arm: list[Any]
    rod: list[Any]
    value: tuple[Any, ...]
    root: Polynomial | None = None
    place: int = field(default=-1)
    scale: Polynomial | None = None


def exact_vector(values: Vector) -> list[Any]:
    """Its entries as FLINT has them."""
    return [rational(value) for value in values]


def placed_leg(leg: RegionLeg, pose: PosePolynomials, metric: Metric, mode: int, place: int) -> PlacedLeg:
    """A leg at the poses of a chart, in a working mode.

    Parameters
    ----------
    leg : RegionLeg
    pose : PosePolynomials
    metric : tuple of 3 int
    mode : int
        1 or -1; of a leg of own length anything.
    place : int
        That of its y among the generators; -1 if it has none.
    """
    tip = moved(pose, leg.platform)
    arm = [p - c for p, c in zip(tip, pose.position, strict=True)]
    offset = [p - pose.norm * rational(a) for p, a in zip(tip, leg.base, strict=True)]
    if leg.axis is not None:
        along = product(metric, leg.axis, leg.axis)
        axis = exact_vector(leg.axis)
        share = product(metric, axis, offset) * rational(1 / along)
        offset = [x - share * a for x, a in zip(offset, axis, strict=True)]
    if isinstance(leg.actuator, OnSlide):
        return _on_slide(leg, leg.actuator, pose, metric, arm, offset, mode, place)
    if isinstance(leg.actuator, OnCrank):
        return _on_crank(leg, leg.actuator, pose, metric, arm, offset, mode, place)
    if isinstance(leg.actuator, OnHinge):
        # n.(C + R B) = o for (c, s) = (-q, p), so that n is a multiple of p v - q u.
        (u, v), (first, second) = map(exact_vector, leg.actuator.normals), map(rational, leg.actuator.offsets)
        p, q = (product(metric, w, tip) - o * pose.norm for w, o in ((u, first), (v, second)))
        return PlacedLeg(leg, arm, [p * b - q * a for a, b in zip(u, v, strict=True)], (p * p + q * q, pose.norm))
    return PlacedLeg(leg, arm, offset, (product(metric, offset, offset), pose.norm * pose.norm))


def _on_slide(
    leg: RegionLeg,
    slide: OnSlide,
    pose: PosePolynomials,
    metric: Metric,
    arm: list[Any],
    offset: list[Any],
    mode: int,
    place: int,
) -> PlacedLeg:
    d, y = exact_vector(slide.direction), pose.ring.gens()[place]
    a, b = product(metric, d, d), product(metric, d, offset)
    square = product(metric, offset, offset) - rational(slide.rod_squared) * pose.norm * pose.norm
    way = b + mode * y
    rod = [a * x - way * direction for x, direction in zip(offset, d, strict=True)]
    return PlacedLeg(leg, arm, rod, (way, a * pose.norm), b * b - a * square, place)


def _on_crank(
    leg: RegionLeg,
    crank: OnCrank,
    pose: PosePolynomials,
    metric: Metric,
    arm: list[Any],
    offset: list[Any],
    mode: int,
    place: int,
) -> PlacedLeg:
    u, v, n = exact_vector(crank.at_0), exact_vector(crank.at_90), pose.norm
    y, share = pose.ring.gens()[place], rational(Fraction(1, crank.weight))
    a, b = 2 * n * product(metric, u, offset), 2 * n * product(metric, v, offset)
    h = product(metric, offset, offset) + (product(metric, u, u) - rational(crank.rod_squared)) * n * n
    m = a * a + share * b * b
    cosine, sine = a * h - mode * b * y, share * b * h + mode * a * y
    rod = [m * x - n * (cosine * p + sine * q) for x, p, q in zip(offset, u, v, strict=True)]
    return PlacedLeg(leg, arm, rod, (cosine, sine), share * (m - h * h), place, m)


def without_squares(polynomial: Polynomial, leg: PlacedLeg, pose: PosePolynomials) -> Polynomial:
    """The polynomial with y^2 replaced by D for the y of a leg."""
    if leg.root is None:
        return polynomial
    parts: dict[int, dict[tuple[int, ...], Any]] = {}
    for exponents, coefficient in polynomial.to_dict().items():
        rest = tuple(e % 2 if k == leg.place else e for k, e in enumerate(map(int, exponents)))
        parts.setdefault(int(exponents[leg.place]) // 2, {})[rest] = coefficient
    total = pose.constant(0)
    for power, terms in parts.items():
        total += pose.ring.from_dict(terms) * leg.root**power
    return total
