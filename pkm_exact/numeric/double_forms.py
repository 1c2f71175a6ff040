"""Values of quadratic polynomials with large integer coefficients: at points in doubles with more bits, or exactly.

A residual is the small difference of large terms: in doubles alone it tells a solution to far fewer digits than a
double has. Sums of products that are known as two doubles each are off by about 2^-85 of the largest term, of few terms
by less. At points in integers values are exact.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import groupby, repeat
from math import inf
from operator import itemgetter
from typing import Any, Final, TypeAlias

import numpy as np
from flint import fmpz, fmpz_mat
from numpy.typing import NDArray

from pkm_exact.numeric.double_rounding import OUTWARD, U, are_moderate, two_product, twofold_sums
from pkm_exact.numeric.study_system import Complex, Real

EXACT: Final = 2.0**53
"""Integers below are doubles."""
BLOCK: Final = 48
"""Points whose terms stay in the cache."""
Integers: TypeAlias = list[list[list[int]]]
"""For each point the numerators of its real parts, and those of its imaginary parts if it is complex."""


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
    polynomials: Sequence[Mapping[tuple[int, int], int]] = ()
    several: Sequence[DoubleForms] = ()

    @classmethod
    def of(cls, polynomials: Sequence[Mapping[tuple[int, int], int]]) -> DoubleForms:
        """Polynomials with integer coefficients; each is divided by the power of 2 next to its largest.

        Raises
        ------
        OverflowError
            If a coefficient is too large for a double.
        """
        places, (first, second) = _in_order(frozenset().union(*polynomials))
        powers = [max(max(values), -min(values)).bit_length() for values in (each.values() for each in polynomials)]
        values = [value for polynomial in polynomials for value in map(polynomial.get, places, repeat(0))]
        heads = np.array(values, dtype=np.float64)
        tails = np.zeros(len(values))
        for place in np.flatnonzero(np.abs(heads) >= EXACT).tolist():
            tails[place] = values[place] - int(heads[place])
        table = np.stack([heads, tails]).reshape(2, len(polynomials), len(places))
        table = np.ldexp(table, -np.array(powers)[:, None])
        return cls(first, second, table[0], table[1], np.array(powers), polynomials)

    @classmethod
    def stacked(cls, several: Sequence[DoubleForms]) -> DoubleForms | None:
        """Lists of polynomials as one; None if they have different monomials."""
        first = several[0]
        if not all(np.array_equal(_places_of(first), _places_of(other)) for other in several):
            return None
        head, tail, powers = (
            np.stack([getattr(forms, name) for forms in several]) for name in ("head", "tail", "powers")
        )
        return cls(first.first, first.second, head, tail, powers, several=tuple(several))

    @cached_property
    def _own(self) -> tuple[NDArray[np.intp], NDArray[np.intp], Real, Real]:
        """(q, m) each: monomials and coefficients of each polynomial, some of the latter 0."""
        are_absent = self.head == 0
        count = int((~are_absent).sum(axis=1).max())
        order = np.argsort(are_absent, axis=1, kind="stable")[:, :count]
        head, tail = (np.take_along_axis(table, order, axis=1) for table in (self.head, self.tail))
        return self.first[order], self.second[order], head, tail

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
        are_wrong = ~are_moderate(here)
        here[are_wrong] = 0
        values: NDArray[Any] = np.empty((len(rows), self.head.shape[-2]), dtype=here.dtype)
        bounds = np.empty(values.shape)
        each = self.several or [self]
        ends = np.searchsorted(rows * len(each), np.arange(1, len(each) + 1) * len(points)).tolist()
        for forms, begin, end in zip(each, [0, *ends], ends, strict=False):
            for start in range(begin, end, BLOCK):
                block = slice(start, min(end, start + BLOCK))
                values[block], bounds[block] = _values(forms.head, forms.tail, *self._products(here[block]))
        values[are_wrong] = np.nan
        return values, bounds

    def _products(self, points: Real | Complex) -> tuple[Real, Real]:
        """(r, p, t) twice: real and imaginary parts of products of coordinates are those, or sums of two of those."""
        i, j, ones = self.first, self.second, np.ones((len(points), 1))
        a = np.concatenate([points.real, ones], axis=1)
        if not points.imag.any():
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

        Not of lists that are stacked. Of polynomials with few monomials each.
        """
        x = np.concatenate([points, np.ones((len(points), 1))], axis=1)
        i, j, head, tail = self._own
        found = np.empty((3, len(x), len(head)))
        for start in range(0, len(x), BLOCK):
            part = x[start : start + BLOCK]
            found[:, start : start + BLOCK] = _twofold(head, tail, part[:, i], part[:, j])
        return found[0], found[1], found[2]


def _values(head: Real, tail: Real, left: Real, right: Real) -> tuple[Real | Complex, Real]:
    """(p, q) sums of coefficients, (q, t) or (p, q, t), times products of coordinates, (r, p, t) each; their bounds."""
    if len(left) > 1:
        head, tail = (np.concatenate([table, table], axis=-1) for table in (head, tail))
    first, second, bound = _twofold(head, tail, left[:, :, None], right[:, :, None])
    sums = first + second
    bounds = ((bound + U * np.abs(sums)) * OUTWARD).sum(axis=0)
    return sums[0] + 1j * sums[1] if len(sums) > 1 else sums[0], bounds * OUTWARD


def _twofold(head: Real, tail: Real, left: Real, right: Real) -> tuple[Real, Real, Real]:
    """Sums, over the last axis, of coefficients times two coordinates, as two doubles, and how far they are off.

    Notes
    -----
    With a, a' a coefficient, x y = m + e and a m = w + w' exactly, a term is w + (w' + a e + a' m): what is left out or
    rounded is below 12 u^2 |w|, of all terms below 12 u^2 sigma, twice the bound of their sum (``twofold_sums``).
    """
    products, lacking = two_product(left, right)
    terms, rest = two_product(head, products)
    rest += head * lacking
    if tail.any():
        rest += tail * products
    first, second, bound = twofold_sums(terms, rest)
    return first, second, 3 * bound


@lru_cache(maxsize=32)
def _in_order(places: frozenset[tuple[int, int]]) -> tuple[tuple[tuple[int, int], ...], NDArray[np.intp]]:
    """Monomials in order, and as an array (2, t)."""
    listed = tuple(sorted(places))
    return listed, np.array(listed, dtype=np.intp).reshape(-1, 2).T


def _places_of(forms: DoubleForms) -> NDArray[np.intp]:
    return np.stack([forms.first, forms.second])


def _double(value: fmpz) -> float:
    try:
        return float(value)
    except OverflowError:
        return inf
