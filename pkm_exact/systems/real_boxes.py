"""The real solutions of a representation in boxes, pairwise disjoint."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cached_property

from flint import arb, arb_poly, fmpq, fmpz, fmpz_poly

from pkm_exact.algebra.representation import UnivariateRepresentation
from pkm_exact.failures.contradiction import require
from pkm_exact.poses.boxes import disjoint_cells
from pkm_exact.precision import working_precision
from pkm_exact.roots.counting import roots_in_gaps
from pkm_exact.roots.interval import Interval
from pkm_exact.roots.isolation import RealRoot, has_root, is_counted_once, isolated_and_enclosed
from pkm_exact.systems.regularity import Weights
from pkm_exact.systems.system_solution import RealSolution

_NEWTON_GUARD = 64


def real_solutions(
    representation: UnivariateRepresentation, multiplicities: Weights | None, width: Fraction
) -> tuple[int, tuple[RealSolution, ...]]:
    """The grid exponent and the real solutions, by their boxes from left to right.

    Parameters
    ----------
    representation : UnivariateRepresentation
        Verified.
    multiplicities : Weights or None
        Of the solutions at the roots of factors of the eliminant; empty if all are simple, None if they are not known.
    width : Fraction
        Greatest width of a box.
    """
    h = representation.primitive_polynomial
    found = isolated_and_enclosed(h)
    intervals = [Interval(root.lo, root.hi) for root, _ in found]
    if not is_counted_once(h):
        require(True not in roots_in_gaps(h, intervals), "a second count finds further real roots", real=len(found))
    refined = [_Refined(h, root, enclosure) for root, enclosure in found]

    def enclose(precision: int, indices: Sequence[int]) -> Iterator[list[arb]]:
        for index in indices:
            root = refined[index].ball(precision)
            with working_precision(precision):
                slope = arb_poly(representation.polynomial.derivative())(root)
                values = [arb_poly(numerator)(root) / slope for numerator in representation.numerator_polynomials]
            yield values

    count = len(representation.numerators)
    exponent, cells = disjoint_cells(enclose, len(found), width, size=count, apart=count)
    listed = [
        RealSolution(interval, tuple(row), _multiplicity(interval, multiplicities))
        for interval, row in zip(intervals, cells, strict=True)
    ]
    return exponent, tuple(sorted(listed, key=lambda solution: [(value.lo, value.hi) for value in solution.values]))


def _multiplicity(parameter: Interval, multiplicities: Weights | None) -> int | None:
    if multiplicities is None:
        return None
    if not multiplicities:
        return 1
    return next(number for factor, number in multiplicities if has_root(fmpz_poly(list(factor)), parameter))


class _Refined:
    """A real root, enclosed as narrowly as asked for: by Newton's operator on intervals, or by halving."""

    def __init__(self, h: fmpz_poly, root: RealRoot, enclosure: arb) -> None:
        self.h, self.slope = h, h.derivative()
        self.start, end = (fmpq(end.numerator, end.denominator) for end in (root.lo, root.hi))
        self.low, self.high = self.start, end
        if not root.is_exact:
            low, high = _ends(enclosure)
            self.low, self.high = max(self.start, low), min(end, high)

    @cached_property
    def starts_positive(self) -> bool:
        """Whether h is positive left of the root."""
        return bool(self.h(self.start) > 0)

    def ball(self, precision: int) -> arb:
        """The root to about so many bits after the point."""
        if self.low == self.high:
            with working_precision(precision):
                return arb(self.low)
        target = fmpq(1, fmpz(1) << precision)
        bits = precision + _NEWTON_GUARD
        while self.high - self.low > target:
            if not self._narrowed(bits):
                bits = min(2 * bits, 2 * precision + _NEWTON_GUARD + 2 * int(self.h.height_bits()))
                self._halve(bits)
        with working_precision(2 * precision + _NEWTON_GUARD):
            return arb(self.low).union(arb(self.high))

    def _narrowed(self, bits: int) -> bool:
        with working_precision(bits):
            place = arb(self.low).union(arb(self.high))
            middle, slope = place.mid(), arb_poly(self.slope)(place)
            if slope.contains(0):
                return False
            image = middle - arb_poly(self.h)(middle) / slope
        low, high = _ends(image)
        low, high = max(low, self.low), min(high, self.high)
        if 2 * (high - low) > self.high - self.low:
            return False
        self.low, self.high = low, high
        return True

    def _halve(self, bits: int) -> None:
        middle = (self.low + self.high) / 2
        with working_precision(bits):
            ball = arb_poly(self.h)(arb(middle))
            sign = 0 if ball.contains(0) else 1 if ball > 0 else -1
        if not sign:
            value = self.h(middle)
            sign = (value > 0) - (value < 0)
        if not sign:
            self.low = self.high = middle
        elif (sign > 0) == self.starts_positive:
            self.low = middle
        else:
            self.high = middle


def _ends(ball: arb) -> tuple[fmpq, fmpq]:
    middle, radius = (_exact(part) for part in (ball.mid(), ball.rad()))
    return middle - radius, middle + radius


def _exact(value: arb) -> fmpq:
    mantissa, power = value.man_exp()
    return fmpq(mantissa) * fmpq(2) ** int(power)
