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
from math import lcm
from operator import add, le
from typing import TypeAlias

from flint import fmpq

from pkm_exact.certify.checker.budget import charge, limbs
from pkm_exact.certify.checker.echelon import reduced_rows
from pkm_exact.certify.checker.section import section
from pkm_exact.certify.checker.study_motion import Leg, Metric
from pkm_exact.certify.checker.verdict import MAX_ELIMINATION_ENTRIES, MAX_ELIMINATION_TERMS, rejected, too_large

Monomial: TypeAlias = tuple[int, ...]
Polynomial: TypeAlias = dict[Monomial, int]
Row: TypeAlias = tuple[int, tuple[int, ...]]
"""A product: index of an element, from 0, and the indices of the unknowns that multiply it."""

_TERM = 3000
"""Operations charged for a term that is multiplied or put into a matrix."""
_DIVISION = 2000
"""Operations charged for asking whether one monomial divides another."""


@dataclass(frozen=True)
class Elimination:
    """Polynomials that vanish at all poses: ``elements``, terms in decreasing order, in ``size`` unknowns."""

    size: int
    elements: tuple[Polynomial, ...]

    def standard(self, most: int) -> list[Monomial]:
        """The monomials that no leading monomial of an element divides; rejects if there are more than ``most``."""
        charge(_DIVISION * (most + 1) * (self.size + 1) * len(self.elements))
        return _standard([_leading(element) for element in self.elements], self.size, most)


def eliminate(legs: Sequence[Leg], metric: Metric, steps: Sequence[Sequence[Row]]) -> Elimination:
    """The elements that the steps yield for a robot with legs."""
    size, quadrics = section(legs, metric)
    return follow(size, echelon([integers(quadric) for quadric in quadrics]), steps)


def follow(size: int, first: Sequence[Polynomial], steps: Sequence[Sequence[Row]]) -> Elimination:
    """The elements that the steps yield, beginning with the first ones, in so many unknowns."""
    elements = list(first)
    for number, step in enumerate(steps, 1):
        if any(index >= len(elements) or max(factors, default=0) >= size for index, factors in step):
            raise rejected(f"elimination: step {number} names an element or an unknown that there is not")
        leading = [_leading(element) for element in elements]
        _limit_terms(sum(len(elements[index]) for index, _ in step))
        elements += echelon([_multiple(elements[index], factors) for index, factors in step], leading)
        _limit_terms(sum(map(len, elements)))
    return Elimination(size, tuple(elements))


def _limit_terms(number: int) -> None:
    """Refuse more terms than there may be in all elements, or in the products of a step; charge for going over them."""
    if number > MAX_ELIMINATION_TERMS:
        raise too_large(f"elimination: more than {MAX_ELIMINATION_TERMS} terms")
    charge(_TERM * number)


def integers(terms: Mapping[Monomial, fmpq]) -> Polynomial:
    """A multiple with integer coefficients."""
    words = limbs(max(int(value.height_bits()) for value in terms.values()))
    charge(len(terms) * (2000 + 4 * words * words))
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
    return {tuple(map(add, monomial, shift)): value for monomial, value in polynomial.items()}


def echelon(polynomials: Sequence[Polynomial], leading: Sequence[Monomial] = ()) -> list[Polynomial]:
    """The rows of the reduced echelon form over Q, as primitive integer polynomials, terms in decreasing order.

    Without those whose leading monomial one of ``leading`` divides.
    """
    charge(_TERM * sum(map(len, polynomials)))
    columns = sorted({monomial for polynomial in polynomials for monomial in polynomial}, key=_order, reverse=True)
    if len(polynomials) * len(columns) > MAX_ELIMINATION_ENTRIES:
        raise too_large(f"elimination: a matrix of more than {MAX_ELIMINATION_ENTRIES} entries")
    charge((100 + _DIVISION * len(leading)) * len(columns))
    place = {monomial: column for column, monomial in enumerate(columns)}
    known = {column for monomial, column in place.items() if _is_divisible(monomial, leading)}
    found = reduced_rows([{place[monomial]: value for monomial, value in row.items()} for row in polynomials], known)
    rows = [found[pivot] for pivot in sorted(found) if pivot not in known]
    return [{columns[column]: row[column] for column in sorted(row)} for row in rows]


def _is_divisible(monomial: Monomial, divisors: Sequence[Monomial]) -> bool:
    return any(all(map(le, divisor, monomial)) for divisor in divisors)


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
