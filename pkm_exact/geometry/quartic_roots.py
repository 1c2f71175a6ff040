"""Real roots of polynomials of degree four, as exact as they can be told: rationals, sums of roots, or enclosures.

FLINT factors over the rationals. A root of an irreducible factor of degree 1 or 2 is rational or p + q sqrt(n); so are
sums of up to three roots those of a quartic whose resolvent cubic has rational roots z_1, z_2 and z_3 (Euler):

    x^4 + p x^2 + q x + r = 0,  z^3 + 2 p z^2 + (p^2 - 4 r) z - q^2 = 0,
    2 x = +-sqrt(z_1) +- sqrt(z_2) +- sqrt(z_3)  with the product of these three summands -q

Other roots have their polynomial and two rational bounds, between which it changes its sign.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any, Final, TypeAlias

from pkm_exact.precision import working_precision
from pkm_exact.radicals import RootSum

Bounds: TypeAlias = tuple[Fraction, Fraction]
_BITS: Final = 64


@dataclass(frozen=True)
class PolynomialRoot:
    """A real root of an irreducible polynomial.

    Attributes
    ----------
    polynomial : tuple of int
        Its coefficients, the constant one first.
    bounds : tuple of Fraction
        Two numbers between which it is the only root; equal if they are the root.
    radicals : RootSum or None
        The root as a sum of square roots, if it is one.
    """

    polynomial: tuple[int, ...]
    bounds: Bounds
    radicals: RootSum | None = None

    def enclosure(self, width: Fraction) -> Bounds:
        """Two rationals, at most ``width`` apart, between which it lies."""
        low, high = self.bounds
        above = self._at(high) > 0
        while high - low > width:
            middle = (low + high) / 2
            if (self._at(middle) > 0) == above:
                high = middle
            else:
                low = middle
        return low, high

    def _at(self, x: Fraction) -> Fraction:
        total = Fraction(0)
        for coefficient in reversed(self.polynomial):
            total = total * x + coefficient
        return total


@dataclass(frozen=True)
class ValueAtRoot:
    """The value of a polynomial with rational coefficients, the constant one first, at a root of another.

    Examples
    --------
    >>> (_, root) = real_roots([-2, 0, -4, 0, 1])
    >>> low, high = ValueAtRoot((Fraction(1), Fraction(2)), root).enclosure(Fraction(1, 10**9))
    >>> root.radicals is None, round(float(low), 6), float(high - low) < 1e-9
    (True, 5.218763, True)
    """

    coefficients: tuple[Fraction, ...]
    root: PolynomialRoot

    @property
    def radicals(self) -> RootSum | None:
        """The value as a sum of square roots, if the root is one."""
        if self.root.radicals is None:
            return None
        total = RootSum()
        for coefficient in reversed(self.coefficients):
            total = total * self.root.radicals + coefficient
        return total

    def enclosure(self, width: Fraction) -> Bounds:
        """Two rationals, at most ``width`` apart, between which it lies."""
        finer = width
        while True:
            low, high = self._over(self.root.enclosure(finer))
            if high - low <= width:
                return low, high
            finer /= 16

    def _over(self, bounds: Bounds) -> Bounds:
        low = high = Fraction(0)
        for coefficient in reversed(self.coefficients):
            products = [x * y for x in (low, high) for y in bounds]
            low, high = min(products) + coefficient, max(products) + coefficient
        return low, high


def real_roots(polynomial: Sequence[int]) -> tuple[PolynomialRoot, ...]:
    """The distinct real roots of a polynomial of degree 4 at most, not 0, in increasing order.

    Parameters
    ----------
    polynomial : sequence of int
        Coefficients, the constant one first.

    Examples
    --------
    >>> [str(root.radicals) for root in real_roots([1, 0, -10, 0, 1])]
    ['-sqrt(2) - sqrt(3)', 'sqrt(2) - sqrt(3)', '-sqrt(2) + sqrt(3)', 'sqrt(2) + sqrt(3)']
    >>> [str(root.radicals) for root in real_roots([0, 0, -2, 2, 1])]
    ['-1 - sqrt(3)', '0', '-1 + sqrt(3)']
    >>> [root.radicals for root in real_roots([-1, -1, 0, 0, 1])]
    [None, None]
    """
    from flint import fmpz_poly

    _, factors = fmpz_poly(list(polynomial)).factor()
    found = [root for factor, _ in factors for root in _of_factor(factor)]
    return tuple(_in_order(found))


def quotient_at(numerator: Sequence[Fraction], divisor: Sequence[Fraction], root: PolynomialRoot) -> ValueAtRoot:
    """The quotient of two polynomials at a root, as a polynomial; the divisor is not 0 there.

    Examples
    --------
    >>> root = real_roots([-2, 0, 1])[1]
    >>> print(quotient_at([Fraction(1)], [Fraction(1), Fraction(1)], root).radicals)
    -1 + sqrt(2)
    """
    from flint import fmpq, fmpq_poly

    def flat(values: Sequence[Any]) -> Any:
        return fmpq_poly([fmpq(Fraction(x).numerator, Fraction(x).denominator) for x in values])

    modulus = flat(root.polynomial)
    unit, inverse, _ = flat(divisor).xgcd(modulus)
    found = (flat(numerator) * inverse / unit[0]) % modulus
    return ValueAtRoot(tuple(Fraction(int(c.p), int(c.q)) for c in found.coeffs()), root)


def _of_factor(factor: Any) -> list[PolynomialRoot]:
    """The real roots of an irreducible polynomial."""
    coefficients = tuple(int(c) for c in factor.coeffs())
    if len(coefficients) == 2:
        value = Fraction(-coefficients[0], coefficients[1])
        return [PolynomialRoot(coefficients, (value, value), RootSum.of(value))]
    bits = _BITS
    while True:
        with working_precision(bits):
            balls = [root.real for root, _ in factor.complex_roots() if root.imag == 0]
            found = [PolynomialRoot(coefficients, _ends(ball)) for ball in balls]
        found.sort(key=lambda root: root.bounds)
        if all(one.bounds[1] < other.bounds[0] for one, other in pairwise(found)):
            break
        bits *= 2
    sums = _quadratic(coefficients) if len(coefficients) == 3 else _euler(coefficients)
    return [_told(root, sums) for root in found]


def _ends(ball: Any) -> Bounds:
    def exactly(end: Any) -> Fraction:
        value = end.fmpq()
        return Fraction(int(value.p), int(value.q))

    middle, radius = exactly(ball.mid()), exactly(ball.rad())
    return middle - radius, middle + radius


def _told(root: PolynomialRoot, sums: Sequence[RootSum]) -> PolynomialRoot:
    """With the one of the sums that it is: a root, as an exact zero test shows, and the only one between the bounds."""
    low, high = root.bounds
    for candidate in sums:
        if (candidate - low).sign() < 0 or (candidate - high).sign() > 0:
            continue
        value = RootSum()
        for coefficient in reversed(root.polynomial):
            value = value * candidate + coefficient
        if value.sign() == 0:
            return replace(root, radicals=candidate)
    return root


def _quadratic(coefficients: Sequence[int]) -> list[RootSum]:
    c, b, a = coefficients
    step = RootSum.root(Fraction(b * b - 4 * a * c, 4 * a * a)) if b * b >= 4 * a * c else None
    return [] if step is None else [step * sign - Fraction(b, 2 * a) for sign in (-1, 1)]


def _euler(coefficients: Sequence[int]) -> list[RootSum]:
    """All roots, if they are half sums of three square roots of rational numbers."""
    if len(coefficients) < 5:
        return []
    e, d, c, b, a = (Fraction(value) for value in coefficients)
    shift = b / (4 * a)
    p = c / a - 6 * shift**2
    q = d / a - 2 * shift * c / a + 8 * shift**3
    r = e / a - shift * d / a + shift**2 * c / a - 3 * shift**4
    squares = _rational_roots([-q * q, p * p - 4 * r, 2 * p, Fraction(1)])
    if squares is None or min(squares) < 0:
        return []
    one, two, three = (RootSum.root(square) for square in squares)
    found = []
    for first in (1, -1):
        for second in (1, -1):
            for third in (1, -1):
                parts = one * first, two * second, three * third
                if (parts[0] * parts[1] * parts[2] + q).sign() == 0:
                    found.append((parts[0] + parts[1] + parts[2]) / 2 - shift)
    return found


def _rational_roots(coefficients: Sequence[Fraction]) -> list[Fraction] | None:
    """All roots of a polynomial as often as they are roots, or None if one is not rational."""
    from math import lcm

    from flint import fmpz_poly

    scale = lcm(*(c.denominator for c in coefficients))
    _, factors = fmpz_poly([int(c * scale) for c in coefficients]).factor()
    if any(factor.degree() > 1 for factor, _ in factors):
        return None
    return [Fraction(-int(factor[0]), int(factor[1])) for factor, power in factors for _ in range(power)]


def _in_order(roots: Sequence[PolynomialRoot]) -> list[PolynomialRoot]:
    """By size: roots of different factors differ, so that bounds that are close enough tell them apart."""
    width = Fraction(1)
    while True:
        placed = sorted(((root.enclosure(width), root) for root in roots), key=lambda pair: pair[0])
        if all(one[1] < other[0] for (one, _), (other, _) in pairwise(placed)):
            return [root for _, root in placed]
        width /= 16
