"""Values of quadratic polynomials with large integer coefficients: at points in doubles with more bits, or exactly.

A residual is the small difference of large terms: in doubles alone it tells a solution to far fewer digits than a
double has. Sums of products that are known as two doubles each are off by about 2^-85 of the largest term: that is
quick for polynomials that are met once. For those that are the same for all robots coefficients and products of
coordinates are split into slices of ``BITS`` bits: products of slices, and sums of these, are exact in doubles, in
whatever order they are added, and so one product of matrices has most of the work (Ozaki, Ogita, Oishi and Rump,
"Error-free transformations of matrix multiplication by using fast routines of matrix multiplication", Numerical
Algorithms 59, 2012). At points in integers values are exact.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import groupby
from math import inf
from operator import itemgetter
from typing import Any, Final, TypeAlias

import numpy as np
from flint import fmpz, fmpz_mat
from numpy.typing import NDArray

from pkm_exact.numeric.double_rounding import OUTWARD, SMALL, U, are_moderate, two_product, twofold_sums
from pkm_exact.numeric.study_system import Complex, Real

BITS: Final = 22
LEVELS: Final = 5
"""Of a number of size 1 at most, slice k is a multiple of 2^-(22 k + 22); what five slices lack is below 2^-110."""
EXACT: Final = 2.0**53
"""Integers below are doubles."""
MOST_TERMS: Final = 100
"""Sums of 5 x 100 products of two slices, of 23 and 22 bits with their signs, are below 2^53 units."""
FEW: Final = 24
"""Values at so many real points are quicker without slices, for polynomials that are met once."""
BLOCK: Final = 32
"""Points whose terms stay in the cache."""
Integers: TypeAlias = list[list[list[int]]]
"""For each point the numerators of its real parts, and those of its imaginary parts if it is complex."""
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
    polynomials : sequence of mappings
        Over the integers, not scaled; none if several lists are stacked.
    several : sequence of DoubleForms
        What is stacked.
    """

    first: NDArray[np.intp]
    second: NDArray[np.intp]
    head: Real
    tail: Real
    powers: NDArray[np.intp]
    kinds: NDArray[np.intp]
    polynomials: Sequence[Mapping[tuple[int, int], int]] = ()
    several: Sequence[DoubleForms] = ()

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
        return cls(first, second, table[0], table[1], np.array(powers), np.array(sorts, dtype=np.intp), polynomials)

    @classmethod
    def stacked(cls, several: Sequence[DoubleForms]) -> DoubleForms | None:
        """Lists of polynomials as one; None if they have different monomials."""
        first = several[0]
        if not all(np.array_equal(_places_of(first), _places_of(other)) for other in several):
            return None
        head, tail, powers = (
            np.stack([getattr(forms, name) for forms in several]) for name in ("head", "tail", "powers")
        )
        return cls(first.first, first.second, head, tail, powers, first.kinds, several=tuple(several))

    @cached_property
    def _table(self) -> _Table:
        begins, counts, kinds = _classes(self.first.tobytes(), self.second.tobytes(), self.kinds.tobytes())
        exponents = np.frexp(np.maximum.reduceat(np.abs(self.head), begins, axis=1))[1].astype(np.intp)
        scaled = -exponents.repeat(counts, axis=1)
        slices = _slices(np.ldexp(self.head, scaled), np.ldexp(self.tail, scaled)).transpose(2, 0, 1)  # (t, l, q)
        size, count = self.head.shape
        matrix = np.zeros((LEVELS, count, len(counts), LEVELS, size))
        for place, (begin, number) in enumerate(zip(begins.tolist(), counts.tolist(), strict=True)):
            rows = slice(begin, begin + number)
            for level in range(LEVELS):
                matrix[level, rows, place, level:] = slices[rows, : LEVELS - level]
        return _Table(kinds, exponents.T.copy(), counts, matrix.reshape(LEVELS * count, -1))

    @cached_property
    def _members(self) -> list[NDArray[np.intp]]:
        """The coordinates of each kind."""
        return [np.flatnonzero(self.kinds == kind) for kind in range(self.kinds.max() + 1)]

    @cached_property
    def _integers(self) -> list[fmpz_mat]:
        """(t, q): coefficients of each list of polynomials."""
        if self.several:
            return [table for forms in self.several for table in forms._integers]
        places = zip(self.first.tolist(), self.second.tolist(), strict=True)
        return [fmpz_mat([[polynomial.get(place, 0) for polynomial in self.polynomials] for place in places])]

    def at(self, points: Real | Complex, chosen: NDArray[np.intp] | None = None) -> tuple[Real | Complex, Real]:
        """(p, q) values at (p, n) points, rounded to double, and how far they are off at most, this rounding included.

        Of complex values, how far off real and imaginary part are together. Where points are not finite, or too large,
        values are nan. If places are chosen, it is of points there.
        """
        rows = np.arange(len(points)) if chosen is None else chosen
        here: NDArray[Any] = points[rows]
        if np.iscomplexobj(here) and not here.imag.any():
            here = here.real.copy()
        are_wrong = ~are_moderate(here)
        here[are_wrong] = 0
        if len(rows) > FEW and not (self.several or np.iscomplexobj(here)):
            first, second, bound = self.in_two(here)
            first[are_wrong] = np.nan
            return first + second, (bound + U * np.abs(first + second)) * OUTWARD
        values: NDArray[Any] = np.empty((len(rows), self.head.shape[-2]), dtype=here.dtype)
        bounds = np.empty(values.shape)
        owners = rows * len(self.several) // max(1, len(points))
        for start in range(0, len(rows), BLOCK):
            block = slice(start, start + BLOCK)
            tables = [table[owners[block]] if self.several else table for table in (self.head, self.tail)]
            values[block], bounds[block] = _values(tables[0], tables[1], *self._products(here[block]))
        values[are_wrong] = np.nan
        return values, bounds

    def _products(self, points: Real | Complex) -> tuple[Real, Real]:
        """(r, p, t) twice: real and imaginary parts of products of coordinates are those, or sums of two of those."""
        i, j, ones = self.first, self.second, np.ones((len(points), 1))
        a = np.concatenate([points.real, ones], axis=1)
        if not np.iscomplexobj(points):
            return a[None, :, i], a[None, :, j]
        b = np.concatenate([points.imag, 0 * ones], axis=1)
        left = np.concatenate([[a[:, i], a[:, i]], [-b[:, i], b[:, i]]], axis=2)
        return left, np.concatenate([[a[:, j], b[:, j]], [b[:, j], a[:, j]]], axis=2)

    def at_integers(self, points: Integers, bits: int, owners: Sequence[int] | NDArray[np.intp]) -> Real:
        """(p, r, q) values at points in units of 2^-bits, rounded once; infinite where they are too large for doubles.

        Parameters
        ----------
        points : list of p lists of r lists of n int
            Real parts, and imaginary ones if r is 2.
        bits : int
        owners : sequence of p int
            Which of the stacked lists of polynomials each point is for; in order.
        """
        pairs, one = list(zip(self.first.tolist(), self.second.tolist(), strict=True)), fmpz(1 << bits)
        numbers: list[float] = []
        several = zip(owners, points, strict=True)
        for owner, group in groupby(several, key=itemgetter(0)):
            rows: list[list[fmpz]] = []
            for _, (real, *imaginary) in group:
                a = [*map(fmpz, real), one]
                if imaginary and any(imaginary[0]):
                    b = [*map(fmpz, imaginary[0]), fmpz(0)]
                    rows.append([a[i] * a[j] - b[i] * b[j] for i, j in pairs])
                    rows.append([a[i] * b[j] + b[i] * a[j] for i, j in pairs])
                else:
                    rows.append([a[i] * a[j] for i, j in pairs])
                    rows += [[fmpz(0)] * len(pairs)] * len(imaginary)
            numbers += map(_double, (fmpz_mat(rows) * self._integers[owner]).entries())
        values = np.array(numbers).reshape(len(points), len(points[0]) if points else 1, self.head.shape[-2])
        powers = self.powers.reshape(-1, 1, self.powers.shape[-1])[np.asarray(owners, dtype=np.intp)]
        found: Real = np.ldexp(values, -2 * bits - powers)
        return found

    def in_two(self, points: Real) -> tuple[Real, Real, Real]:
        """The same at real points as sums of two doubles, the second not rounded away: heads, tails, and bounds.

        Not of lists that are stacked.
        """
        x, exponents = self._scaled(np.concatenate([points, np.ones((len(points), 1))], axis=1))
        return self._sums(_slices(*two_product(x[:, self.first], x[:, self.second])), exponents)

    def _scaled(self, x: Real) -> tuple[Real, NDArray[np.intp]]:
        """Points (p, n + 1) with coordinates below 1, by a power of 2 for each kind; its exponents, (p, kinds)."""
        sizes = np.abs(x)
        exponents = np.frexp(np.stack([sizes[:, members].max(axis=1) for members in self._members], axis=1))[1]
        return np.ldexp(x, -exponents[:, self.kinds]), exponents

    def _sums(self, parts: Real, exponents: NDArray[np.intp]) -> tuple[Real, Real, Real]:
        """Values (p, q) from slices (l, p, t) of the products of coordinates.

        Notes
        -----
        Products are exact as two doubles; adding the second after two slices is off by 2^-97 at most, likewise of the
        coefficients. Products of slices that are left out, i + j >= 5, are below 2^-108 each.
        """
        points, table, size = parts.shape[1], self._table, len(self.head)
        slices = parts.transpose(1, 0, 2).reshape(points, -1)
        shifts = exponents[:, table.kinds].sum(axis=2)[:, :, None] + table.exponents  # (p, classes, q)
        sums = (slices @ table.matrix).reshape(points, len(table.counts), LEVELS, -1)
        terms = np.ldexp(sums, shifts[:, :, None]).reshape(points, -1, size).transpose(0, 2, 1)
        lost = np.ldexp((LACKING * table.counts)[:, None], shifts).sum(axis=1)
        first, second, bound = twofold_sums(terms, np.zeros(1))
        return first, second, (bound + lost) * OUTWARD + SMALL


@dataclass(frozen=True, eq=False)
class _Table:
    """Coefficients in slices, by classes: monomials of coordinates of the same two kinds, which are neighbours.

    Attributes
    ----------
    kinds : (c, 2) array of int
    exponents : (c, q) array of int
        Of the largest coefficients.
    counts : (c,) array of int
        Numbers of monomials.
    matrix : (l t, c l q) array
        With slices of products, level after level, it gives the sums of all products of levels i + j = s, for each s.
    """

    kinds: NDArray[np.intp]
    exponents: NDArray[np.intp]
    counts: NDArray[np.intp]
    matrix: Real


def _values(head: Real, tail: Real, left: Real, right: Real) -> tuple[Real | Complex, Real]:
    """(p, q) sums of coefficients, (q, t) or (p, q, t), times products of coordinates, (r, p, t) each; their bounds.

    Notes
    -----
    With a, a' a coefficient, x y = m + e and a m = w + w' exactly, a term is w + (w' + a e + a' m): what is left out or
    rounded is below 12 u^2 |w|, of all terms below 12 u^2 sigma, twice the bound of their sum (``twofold_sums``).
    """
    if len(left) > 1:
        head, tail = (np.concatenate([table, table], axis=-1) for table in (head, tail))
    products, lacking = (part[:, :, None] for part in two_product(left, right))
    terms, rest = two_product(head, products)
    first, second, bound = twofold_sums(terms, rest + head * lacking + tail * products)
    sums = first + second
    bounds = ((3 * bound + U * np.abs(sums)) * OUTWARD).sum(axis=0)
    return sums[0] + 1j * sums[1] if len(sums) > 1 else sums[0], bounds * OUTWARD


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


def _double(value: fmpz) -> float:
    try:
        return float(value)
    except OverflowError:
        return inf
