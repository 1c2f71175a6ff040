"""Values of quadratic polynomials with large integer coefficients, at points in doubles, with twice as many bits.

A residual is the small difference of large terms: in doubles alone it tells a solution to far fewer digits than a
double has. Here its error is bounded by about 2^-85 of the largest term. Coefficients and products of coordinates are
split into slices of ``BITS`` bits: products of slices, and sums of these, are exact in doubles, in whatever order they
are added, and so one product of matrices has most of the work (Ozaki, Ogita, Oishi and Rump, "Error-free
transformations of matrix multiplication by using fast routines of matrix multiplication", Numerical Algorithms 59,
2012).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.numeric.double_rounding import OUTWARD, SMALL, U, two_product, twofold_sums
from pkm_exact.numeric.study_system import Complex, Real

BITS: Final = 22
LEVELS: Final = 5
"""Of a number of size 1 at most, slice k is a multiple of 2^-(22 k + 22); what five slices lack is below 2^-110."""
EXACT: Final = 2.0**53
"""Integers below are doubles."""
MOST_TERMS: Final = 100
"""Sums of 5 x 100 products of two slices, of 23 and 22 bits with their signs, are below 2^53 units."""
LACKING: Final = 2.0**-95
"""What the slices of a product and of its coefficient miss, of size 1 and complex, together."""


@dataclass(frozen=True, eq=False)
class DoubleForms:
    """Polynomials sum a_ij x_i x_j, i <= j, in x_0, .., x_n-1 and x_n = 1, each scaled by a power of 2.

    Several lists of polynomials with the same monomials may be stacked: then as many points, one after another, are for
    each of them.

    Attributes
    ----------
    first, second : (t,) arrays of int
        i and j of the monomials that occur.
    head, tail : (.., q, t) arrays
        Coefficients: those of the polynomials are head + tail to a part u^2.
    powers : (.., q) array of int
        Exponents of 2 of what the polynomials are divided by.
    kinds : (n + 1,) array of int
        Which coordinates are of about one size.
    """

    first: NDArray[np.intp]
    second: NDArray[np.intp]
    head: Real
    tail: Real
    powers: NDArray[np.intp]
    kinds: NDArray[np.intp]

    @classmethod
    def of(
        cls, polynomials: Sequence[Mapping[tuple[int, int], int]], kinds: Sequence[int] | None = None
    ) -> DoubleForms:
        """Polynomials with integer coefficients; each is divided by the power of 2 next to its largest.

        Raises
        ------
        OverflowError
            If a coefficient is too large for a double, or there are too many monomials.
        """
        found = {place for polynomial in polynomials for place in polynomial}
        last = max(max(place) for place in found)
        sorts = [0] * (last + 1) if kinds is None else kinds
        places = sorted(found, key=lambda place: (*sorted((sorts[place[0]], sorts[place[1]])), place))
        if len(places) > MOST_TERMS:
            raise OverflowError("too many monomials")
        powers = [max(abs(value).bit_length() for value in polynomial.values()) for polynomial in polynomials]
        values = [polynomial.get(place, 0) for polynomial in polynomials for place in places]
        heads = [float(value) for value in values]
        tails = [
            float(value - int(head)) if abs(head) >= EXACT else 0.0 for value, head in zip(values, heads, strict=True)
        ]
        first, second = np.array(places, dtype=np.intp).reshape(-1, 2).T
        table = np.array([heads, tails]).reshape(2, len(polynomials), len(places))
        table = np.ldexp(table, -np.array(powers)[:, None])
        return cls(first, second, table[0], table[1], np.array(powers), np.array(sorts, dtype=np.intp))

    @classmethod
    def stacked(cls, several: Sequence[DoubleForms]) -> DoubleForms | None:
        """Lists of polynomials as one; None if they have different monomials."""
        first = several[0]
        if not all(np.array_equal(_places_of(first), _places_of(other)) for other in several):
            return None
        head, tail, powers = (
            np.stack([getattr(forms, name) for forms in several]) for name in ("head", "tail", "powers")
        )
        return cls(first.first, first.second, head, tail, powers, first.kinds)

    @cached_property
    def _table(self) -> _Table:
        begins, counts, kinds = _classes(self.first.tobytes(), self.second.tobytes(), self.kinds.tobytes())
        sizes = np.maximum.reduceat(np.abs(self.head), begins, axis=-1)
        exponents = np.frexp(sizes)[1].astype(np.intp)
        scaled = -exponents.repeat(counts, axis=-1)
        slices = _slices(np.ldexp(self.head, scaled), np.ldexp(self.tail, scaled))
        slices = np.moveaxis(np.moveaxis(slices, 0, -3), -1, -3)  # (.., t, l, q)
        lead, (size, count) = self.head.shape[:-2], self.head.shape[-2:]
        matrix = np.zeros((*lead, LEVELS, count, len(counts), LEVELS, size))
        for place, (begin, number) in enumerate(zip(begins.tolist(), counts.tolist(), strict=True)):
            for level in range(LEVELS):
                rows = matrix[..., level, begin : begin + number, place, level:, :]
                rows[...] = slices[..., begin : begin + number, : LEVELS - level, :]
        exponents = np.moveaxis(exponents, -1, -2).copy()
        return _Table(kinds, exponents, counts, matrix.reshape(*lead, LEVELS * count, -1))

    @cached_property
    def _members(self) -> list[NDArray[np.intp]]:
        """The coordinates of each kind."""
        return [np.flatnonzero(self.kinds == kind) for kind in range(self.kinds.max() + 1)]

    def at(self, points: Real | Complex) -> tuple[Real | Complex, Real]:
        """(p, q) values at (p, n) points, rounded to double, and how far they are off at most, this rounding included.

        Of complex values, how far off real and imaginary part are together.
        """
        if not np.iscomplexobj(points):
            return _rounded(*self.in_two(points.real))
        x = np.stack([_extended(points.real, 1.0), _extended(points.imag, 0.0)])
        x, exponents = self._scaled(x)
        left, right = x[[0, 1, 0, 1]], x[[0, 1, 1, 0]]
        parts = _slices(*two_product(left[..., self.first], right[..., self.second]))
        both = np.stack([parts[:, 0] - parts[:, 1], parts[:, 2] + parts[:, 3]], axis=1)
        (real, imaginary), (off, also_off) = _rounded(*self._sums(both, exponents))
        return real + 1j * imaginary, off + also_off

    def in_two(self, points: Real) -> tuple[Real, Real, Real]:
        """The same at real points as sums of two doubles, the second not rounded away: heads, tails, and bounds."""
        x, exponents = self._scaled(_extended(points, 1.0)[None])
        parts = _slices(*two_product(x[..., self.first], x[..., self.second]))
        first, second, bound = self._sums(parts, exponents)
        return first[0], second[0], bound[0]

    def _scaled(self, x: Real) -> tuple[Real, NDArray[np.intp]]:
        """Points (r, p, n + 1) with coordinates below 1, by a power of 2 for each kind; its exponents, (p, kinds)."""
        sizes = np.abs(x).max(axis=0)
        exponents = np.frexp(np.stack([sizes[:, members].max(axis=1) for members in self._members], axis=1))[1]
        return np.ldexp(x, -exponents[:, self.kinds]), exponents

    def _sums(self, parts: Real, exponents: NDArray[np.intp]) -> tuple[Real, Real, Real]:
        """Values (r, p, q) from slices (l, r, p, t) of the products of coordinates.

        Notes
        -----
        Products are exact as two doubles; adding the second after two slices is off by 2^-97 at most, likewise of the
        coefficients. Products of slices that are left out, i + j >= 5, are below 2^-108 each.
        """
        rows, points = parts.shape[1:3]
        table, size = self._table, self.head.shape[-2]
        lead = self.head.shape[:-2]
        slices = parts.transpose(1, 2, 0, 3).reshape(rows, *lead, -1, table.matrix.shape[-2])
        each = table.exponents.repeat(points // lead[0], axis=0) if lead else table.exponents
        shifts = exponents[:, table.kinds].sum(axis=2)[:, :, None] + each  # (p, classes, q)
        sums = (slices @ table.matrix).reshape(rows, points, len(table.counts), LEVELS, -1)
        terms = np.ldexp(sums, shifts[:, :, None]).reshape(rows, points, -1, size).transpose(0, 1, 3, 2)
        lost = np.ldexp((LACKING * table.counts)[:, None], shifts).sum(axis=1)
        first, second, bound = twofold_sums(terms, np.zeros(1))
        return first, second, (bound + lost) * OUTWARD + SMALL


@dataclass(frozen=True, eq=False)
class _Table:
    """Coefficients in slices, by classes: monomials of coordinates of the same two kinds, which are neighbours.

    Attributes
    ----------
    kinds : (c, 2) array of int
    exponents : (.., c, q) array of int
        Of the largest coefficients.
    counts : (c,) array of int
        Numbers of monomials.
    matrix : (.., l t, c l q) array
        With slices of products, level after level, it gives the sums of all products of levels i + j = s, for each s.
    """

    kinds: NDArray[np.intp]
    exponents: NDArray[np.intp]
    counts: NDArray[np.intp]
    matrix: Real


def _places_of(forms: DoubleForms) -> NDArray[np.intp]:
    return np.stack([forms.first, forms.second])


@lru_cache(maxsize=32)
def _classes(first: bytes, second: bytes, kinds: bytes) -> tuple[NDArray[np.intp], ...]:
    """Where classes of monomials begin, how many there are in each, and of which kinds, (c, 2)."""
    i, j, sorts = (np.frombuffer(part, dtype=np.intp) for part in (first, second, kinds))
    pairs = np.sort(np.stack([sorts[i], sorts[j]], axis=1), axis=1)
    begins = np.concatenate([[0], 1 + np.flatnonzero((pairs[1:] != pairs[:-1]).any(axis=1))])
    return begins, np.diff([*begins, len(pairs)]), pairs[begins]


def _slices(high: Real, low: Real) -> Real:
    """(l, ..): numbers of size 1 at most as sums of slices; |low| <= u |high|.

    Adding sigma, and taking it off again, rounds to multiples of its last bit; what is left is exact.
    """
    slices = np.empty((LEVELS, *high.shape))
    rest = high
    for level in range(LEVELS):
        sigma = 1.5 * 2.0 ** (52 - BITS * (level + 1))
        slices[level] = (rest + sigma) - sigma
        rest = rest - slices[level]
        if level == 1:
            rest = rest + low
    return slices


def _rounded(first: Real, second: Real, bound: Real) -> tuple[Real, Real]:
    """The sums as doubles, and how far they are off at most."""
    value: Real = first + second
    return value, (bound + U * np.abs(value)) * OUTWARD


def _extended(points: Real, last: float) -> Real:
    """With one more coordinate."""
    return np.concatenate([points, np.full((len(points), 1), last)], axis=1)
