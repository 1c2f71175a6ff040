"""Joint values all over a region as quotients of polynomials."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import atan2, isqrt, tan
from typing import Any, Final

from flint import arb

from pkm_exact.balls import ball
from pkm_exact.precision import working_precision
from pkm_exact.regions.chart import rational
from pkm_exact.regions.extremes import Quotient
from pkm_exact.regions.placed_legs import PlacedLeg
from pkm_exact.regions.region_legs import OnCrank, OnSlide, RegionLeg
from pkm_exact.roots.interval import Interval

_BITS: Final = 64


@dataclass(frozen=True, eq=False)
class JointQuotient:
    """A joint value as a quotient: square of a length, position, or tangent of half the angle from a direction.

    The tangent is over sqrt(w), as the half tangent of the direction is.
    """

    leg: RegionLeg
    quotient: Quotient
    start: Fraction = Fraction(0)

    def value(self, found: Interval) -> Interval:
        """The joint value that belongs to values of the quotient."""
        if isinstance(self.leg.actuator, OnSlide):
            return found
        with working_precision(128):
            low, high = (self._ball(end) for end in (found.lo, found.hi))
            return Interval(_end(low.lower()), _end(high.upper()))

    def _ball(self, found: Fraction) -> arb:
        if not isinstance(self.leg.actuator, OnCrank):
            return ball(max(found, Fraction(0))).sqrt()
        root = arb(self.leg.actuator.weight).sqrt()
        return 360 / arb.pi() * ((root * ball(self.start)).atan() + (root * ball(found)).atan())


def _end(value: arb) -> Fraction:
    mantissa, exponent = value.mid().man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def joint_quotient(placed: PlacedLeg, roots: Sequence[Any], middle: Sequence[Fraction]) -> JointQuotient:
    """The joint value of a leg; angles from one near that in the middle of the region."""
    leg, m = placed.leg, placed.scale
    if m is None or not isinstance(leg.actuator, OnCrank):
        slide = leg.actuator
        size = (
            float(slide.rod_squared) ** 0.5 / float(max(map(abs, slide.direction))) if isinstance(slide, OnSlide) else 0
        )
        return JointQuotient(leg, Quotient(placed.value[0], placed.value[1], size))
    w, (cosine, sine) = leg.actuator.weight, placed.value
    start = _half_tangent_at(placed, roots, middle, w)
    norm = 1 + w * start * start
    c, s = rational((1 - w * start * start) / norm), rational(2 * start / norm)
    turned = c * cosine + w * s * sine
    return JointQuotient(leg, Quotient(c * sine - s * cosine, m + turned, 0.5), start)


def _half_tangent_at(placed: PlacedLeg, roots: Sequence[Any], middle: Sequence[Fraction], w: int) -> Fraction:
    at = [rational(x) for x in middle]
    squares = [root(*at, *[rational(0)] * len(roots)) for root in roots]
    ys = [rational(rational_root(max(Fraction(int(x.p), int(x.q)), Fraction(0)), 1)) for x in squares]
    cosine, sine = (value(*at, *ys) for value in placed.value)
    angle = atan2(float(Fraction(int(sine.p), int(sine.q))) * w**0.5, float(Fraction(int(cosine.p), int(cosine.q))))
    return Fraction(tan(max(-3.1, min(3.1, angle)) / 2) / w**0.5).limit_denominator(1000)


def rational_root(square: Fraction, way: int) -> Fraction:
    """A root, exactly or rounded to a side.

    Examples
    --------
    >>> rational_root(Fraction(9, 4), 1), 0 < rational_root(Fraction(2), 1) ** 2 - 2 < Fraction(1, 10**18)
    (Fraction(3, 2), True)
    """
    numerator, denominator = isqrt(square.numerator), isqrt(square.denominator)
    if numerator**2 == square.numerator and denominator**2 == square.denominator:
        return Fraction(numerator, denominator)
    scale = 1 << _BITS
    low = isqrt(square.numerator * scale * scale // square.denominator)
    return Fraction(low + (way > 0), scale)
