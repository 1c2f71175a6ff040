"""Exact elimination: an upper bound for the number of poses, from polynomials over Q that vanish at all of them.

Elements. The first ones are the rows of the reduced echelon form of the quadrics of the section (``section``), largest
leading monomial first. Each step of an elimination names products of known elements and monomials; of the reduced
echelon form of these products, the rows whose leading monomial no earlier element's divides become elements. Monomials
are ordered by degree, then reverse lexicographically. Whatever is combined, every element vanishes at every pose.

Bound. Every polynomial is, modulo the elements, a combination of the monomials that no leading monomial divides. If
these are n, then the unknowns take at most n different values at poses, and a pose is determined by them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import gcd, lcm
from typing import TypeAlias

from flint import fmpq, fmpz_mat

from pkm_exact.certify.checker.section import section
from pkm_exact.certify.checker.study_motion import Leg, Metric
from pkm_exact.certify.checker.verdict import MAX_ELIMINATION_BITS, rejected, too_large

Monomial: TypeAlias = tuple[int, ...]
Polynomial: TypeAlias = dict[Monomial, int]
Row: TypeAlias = tuple[int, tuple[int, ...]]
"""A product: index of an element, from 0, and the indices of the unknowns that multiply it."""


@dataclass(frozen=True)
class Elimination:
    """Polynomials that vanish at all poses: ``elements``, terms in decreasing order, in ``size`` unknowns."""

    size: int
    elements: tuple[Polynomial, ...]

    def standard(self, most: int) -> list[Monomial]:
        """The monomials that no leading monomial of an element divides; rejects if there are more than ``most``."""
        return _standard([_leading(element) for element in self.elements], self.size, most)


def eliminate(legs: Sequence[Leg], metric: Metric, steps: Sequence[Sequence[Row]]) -> Elimination:
    """The elements that the steps yield."""
    size, quadrics = section(legs, metric)
    elements = _echelon([_integers(quadric) for quadric in quadrics])
    for number, step in enumerate(steps, 1):
        if any(index >= len(elements) or max(factors, default=0) >= size for index, factors in step):
            raise rejected(f"elimination: step {number} names an element or an unknown that there is not")
        leading = [_leading(element) for element in elements]
        found = _echelon([_multiple(elements[index], factors) for index, factors in step])
        elements += [element for element in found if not _is_divisible(_leading(element), leading)]
    return Elimination(size, tuple(elements))


def _integers(terms: Mapping[Monomial, fmpq]) -> Polynomial:
    """A multiple with integer coefficients."""
    denominator = lcm(*(int(value.q) for value in terms.values()))
    return {monomial: int(value * denominator) for monomial, value in terms.items()}


def _order(monomial: Monomial) -> tuple[int, ...]:
    """Sorting key of the degree reverse lexicographic order."""
    return (sum(monomial), *(-exponent for exponent in reversed(monomial)))


def _leading(polynomial: Polynomial) -> Monomial:
    return next(iter(polynomial))


def _multiple(polynomial: Polynomial, factors: Sequence[int]) -> Polynomial:
    """The polynomial times unknowns, given by their indices."""
    shift = [0] * len(_leading(polynomial))
    for factor in factors:
        shift[factor] += 1
    return {tuple(map(sum, zip(monomial, shift, strict=True))): value for monomial, value in polynomial.items()}


def _echelon(polynomials: Sequence[Polynomial]) -> list[Polynomial]:
    """The rows of the reduced echelon form over Q, as primitive integer polynomials, terms in decreasing order."""
    columns = sorted({monomial for polynomial in polynomials for monomial in polynomial}, key=_order, reverse=True)
    if not columns:
        return []
    bits = max(abs(value).bit_length() for polynomial in polynomials for value in polynomial.values())
    rank = min(len(polynomials), len(columns))
    if rank * rank * (len(columns) - rank + 1) * (bits + len(columns).bit_length()) > MAX_ELIMINATION_BITS:
        raise too_large("elimination: a matrix is too large")
    table = [[polynomial.get(monomial, 0) for monomial in columns] for polynomial in polynomials]
    echelon, _, rank = fmpz_mat(table).rref()
    rows = []
    for entries in echelon.table()[:rank]:
        row = {monomial: int(value) for monomial, value in zip(columns, entries, strict=True) if value}
        content = gcd(*row.values())
        rows.append({monomial: value // content for monomial, value in row.items()})
    return rows


def _is_divisible(monomial: Monomial, divisors: Sequence[Monomial]) -> bool:
    return any(all(a <= b for a, b in zip(divisor, monomial, strict=True)) for divisor in divisors)


def _standard(leading: Sequence[Monomial], size: int, most: int) -> list[Monomial]:
    """The monomials that none of the leading ones divides, by degree."""
    found: list[Monomial] = []
    layer = {(0,) * size} if not _is_divisible((0,) * size, leading) else set()
    while layer:
        found += sorted(layer)
        if len(found) > most:
            raise rejected(f"elimination: it leaves more than {most} monomials")
        larger = {(*m[:i], m[i] + 1, *m[i + 1 :]) for m in layer for i in range(size)}
        layer = {monomial for monomial in larger if not _is_divisible(monomial, leading)}
    return found
