"""Values of quadratic polynomials with large integer coefficients, at points in doubles, with twice as many bits.

A residual is the small difference of large terms: in doubles alone it tells a solution to far fewer digits than a
double has. Here its error is bounded by about 2^-90 of the largest term.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pkm_exact.numeric.double_rounding import OUTWARD, U, two_product, twofold_sums
from pkm_exact.numeric.study_system import Complex, Real


@dataclass(frozen=True, eq=False)
class DoubleForms:
    """Polynomials sum a_ij x_i x_j, i <= j, in x_0, .., x_n-1 and x_n = 1, each scaled by a power of 2.

    Attributes
    ----------
    first, second : (t,) arrays of int
        i and j of the monomials that occur.
    head, tail : (q, t) arrays
        Coefficients: those of the polynomials are head + tail to a part u^2.
    powers : (q,) array of int
        Exponents of 2 of what the polynomials are divided by.
    """

    first: NDArray[np.intp]
    second: NDArray[np.intp]
    head: Real
    tail: Real
    powers: NDArray[np.intp]

    @classmethod
    def of(cls, polynomials: Sequence[Mapping[tuple[int, int], int]]) -> DoubleForms:
        """Polynomials with integer coefficients; each is divided by the power of 2 next to its largest.

        Raises
        ------
        OverflowError
            If a coefficient is too large for a double.
        """
        places = sorted({place for polynomial in polynomials for place in polynomial})
        powers = [max(abs(value).bit_length() for value in polynomial.values()) for polynomial in polynomials]
        values = [polynomial.get(place, 0) for polynomial in polynomials for place in places]
        heads = [float(value) for value in values]
        tails = [float(value - int(head)) if head else 0.0 for value, head in zip(values, heads, strict=True)]
        first, second = np.array(places, dtype=np.intp).reshape(-1, 2).T
        table = np.array([heads, tails]).reshape(2, len(polynomials), len(places))
        table = np.ldexp(table, -np.array(powers)[:, None])
        return cls(first, second, table[0], table[1], np.array(powers))

    def at(self, points: Real | Complex) -> tuple[Real | Complex, Real]:
        """(p, q) values at (p, n) points, rounded to double, and how far they are off at most, this rounding included.

        Notes
        -----
        With products x_i x_j = h + l and a h = p + e exactly, a term is p + (e + a l + a' h) with a' the tail of a. The
        rest is at most 3.1 u |p|; its four roundings, a' l and what head and tail lack are below 12 u^2 |p| in all. Of
        t terms that is less than 12 u^2 sigma, as t |p| < sigma (``twofold_sums``).
        """
        if not np.iscomplexobj(points):
            return _rounded(*self.in_two(points.real))
        a, b = _extended(points.real, 1.0), _extended(points.imag, 0.0)
        real, off = _rounded(*self._sums([(a, a), (-b, b)]))
        imaginary, also_off = _rounded(*self._sums([(a, b), (b, a)]))
        return real + 1j * imaginary, off + also_off

    def in_two(self, points: Real) -> tuple[Real, Real, Real]:
        """The same at real points as sums of two doubles, the second not rounded away: heads, tails, and bounds."""
        x = _extended(points, 1.0)
        return self._sums([(x, x)])

    def _sums(self, factors: Sequence[tuple[Real, Real]]) -> tuple[Real, Real, Real]:
        """The values with x_i x_j replaced by the sum of y_i z_j over the given (y, z)."""
        products = [two_product(left[:, self.first], right[:, self.second]) for left, right in factors]
        high = np.concatenate([h for h, _ in products], axis=1)[:, None]
        low = np.concatenate([rest for _, rest in products], axis=1)[:, None]
        head, tail = (np.tile(part, len(factors)) for part in (self.head, self.tail))
        terms, rest = two_product(head, high)
        first, second, bound = twofold_sums(terms, rest + head * low + tail * high)
        return first, second, 3 * bound * OUTWARD


def _rounded(first: Real, second: Real, bound: Real) -> tuple[Real, Real]:
    """The sums as doubles, and how far they are off at most."""
    value: Real = first + second
    return value, (bound + U * np.abs(value)) * OUTWARD


def _extended(points: Real, last: float) -> Real:
    """With one more coordinate."""
    return np.concatenate([points, np.full((len(points), 1), last)], axis=1)
