"""Exact elimination: an upper bound for the number of poses, from polynomials over Q that vanish at all of them.

Elements. The first ones are the rows of the reduced echelon form of the quadrics of the section (``section``), largest
leading monomial first. Each step of an elimination names products of known elements and monomials; of the reduced
echelon form of these products, the rows whose leading monomial no earlier element's divides become elements. Monomials
are ordered by degree, then reverse lexicographically. Whatever is combined, every element vanishes at every pose.

Bound. Every polynomial is, modulo the elements, a combination of the monomials that no leading monomial divides. If
these are n, then the unknowns take at most n different values at poses, and a pose is determined by them. For the last
step, which nothing is multiplied after, ranks modulo a prime say as much: over Q they are not less.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from math import lcm, prod
from operator import add, le
from typing import Final, TypeAlias

from flint import fmpq, nmod_mat

from pkm_exact.certify.checker.budget import charge, limbs
from pkm_exact.certify.checker.echelon import pivots_of, reduced_rows
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
_PRIME: Final = (1 << 63) - 25
"""The prime of last steps; any serves."""


@dataclass(frozen=True)
class Elimination:
    """Polynomials that vanish at all poses: ``elements``, terms in decreasing order, in ``size`` unknowns."""

    size: int
    elements: tuple[Polynomial, ...]

    def standard(self, most: int) -> list[Monomial]:
        """The monomials that no leading monomial of an element divides; rejects if there are more than ``most``."""
        found = _standard(self._leading(), self.size, most)
        if found is None:
            raise rejected(f"elimination: it leaves more than {most} monomials")
        return found

    def products(self, step: Sequence[Row], number: int) -> list[Polynomial]:
        """The products of a step, which has this number."""
        if any(index >= len(self.elements) or max(factors, default=0) >= self.size for index, factors in step):
            raise rejected(f"elimination: step {number} names an element or an unknown that there is not")
        _limit_terms(sum(len(self.elements[index]) for index, _ in step))
        return [_multiple(self.elements[index], factors) for index, factors in step]

    def followed(self, products: Sequence[Polynomial]) -> Elimination:
        """With the further elements that the products of a step yield."""
        found = echelon(products, self._leading())
        _limit_terms(sum(map(len, (*self.elements, *found))))
        return Elimination(self.size, (*self.elements, *found))

    def at_most(self, products: Sequence[Polynomial], most: int) -> int | None:
        """How many monomials the products of a further step leave, at most: their echelon form modulo a prime tells.

        None if it does not, or if they are more than ``most``.
        """
        heads = (next(iter(element.items())) for element in self.elements)
        leading = {monomial for monomial, value in heads if value % _PRIME}
        columns = _columns(products)
        charge(len(products) * len(columns) * (50 + min(len(products), len(columns)) // 3))
        place = {monomial: column for column, monomial in enumerate(columns)}
        table = nmod_mat(len(products), len(columns), _PRIME)
        for row, polynomial in enumerate(products):
            for monomial, value in polynomial.items():
                table[row, place[monomial]] = value % _PRIME
        pivots = {columns[place] for place in pivots_of(*table.rref())}
        # Over Q a row may begin in another column on the left of its pivot, where there is none.
        degree = max((sum(monomial) for monomial in columns if monomial not in pivots), default=0)
        lasting = leading.union(monomial for monomial in pivots if sum(monomial) >= degree)
        powers = {monomial.index(max(monomial)) for monomial in lasting if max(monomial) == sum(monomial)}
        if len(powers) < self.size:
            return None
        left = _standard(leading | pivots, self.size, most)
        return None if left is None else len(left)

    def _leading(self) -> set[Monomial]:
        return set(map(_leading, self.elements))


def follow(size: int, first: Sequence[Polynomial], steps: Sequence[Sequence[Row]]) -> Elimination:
    """The elements that the steps yield, beginning with the first ones, in so many unknowns."""
    elimination = Elimination(size, tuple(first))
    for number, step in enumerate(steps, 1):
        elimination = elimination.followed(elimination.products(step, number))
    return elimination


class Steps:
    """Steps of an elimination; the last one is not followed over Q if what it leaves is proved modulo a prime."""

    def __init__(self, size: int, first: Sequence[Polynomial], steps: Sequence[Sequence[Row]]) -> None:
        self._before = follow(size, first, steps[:-1])
        self._products = [self._before.products(step, len(steps)) for step in steps[-1:]]

    def left(self, expected: int, most: int) -> int:
        """How many monomials are left, at most if these are as many as expected; rejects if more than ``most``."""
        if any(self._before.at_most(products, expected) == expected for products in self._products):
            return expected
        return len(self.elimination.standard(most))

    @cached_property
    def elimination(self) -> Elimination:
        """All elements."""
        elimination = self._before
        for products in self._products:
            elimination = elimination.followed(products)
        return elimination


def eliminate(legs: Sequence[Leg], metric: Metric, steps: Sequence[Sequence[Row]]) -> Steps:
    """The steps, for a robot with legs."""
    size, quadrics = section(legs, metric)
    return Steps(size, echelon([integers(quadric) for quadric in quadrics]), steps)


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


def echelon(polynomials: Sequence[Polynomial], leading: AbstractSet[Monomial] = frozenset()) -> list[Polynomial]:
    """The rows of the reduced echelon form over Q, as primitive integer polynomials, terms in decreasing order.

    Without those whose leading monomial one of ``leading`` divides.
    """
    charge(_TERM * sum(map(len, polynomials)))
    columns = _columns(polynomials)
    charge((100 + _DIVISION * len(leading)) * len(columns))
    place = {monomial: column for column, monomial in enumerate(columns)}
    known = {column for monomial, column in place.items() if _is_divisible(monomial, leading)}
    found = reduced_rows([{place[monomial]: value for monomial, value in row.items()} for row in polynomials], known)
    rows = [found[pivot] for pivot in sorted(found) if pivot not in known]
    return [{columns[column]: row[column] for column in sorted(row)} for row in rows]


def _columns(polynomials: Sequence[Polynomial]) -> list[Monomial]:
    """All monomials of some polynomials, decreasing."""
    columns = sorted({monomial for polynomial in polynomials for monomial in polynomial}, key=_order, reverse=True)
    if len(polynomials) * len(columns) > MAX_ELIMINATION_ENTRIES:
        raise too_large(f"elimination: a matrix of more than {MAX_ELIMINATION_ENTRIES} entries")
    return columns


def _is_divisible(monomial: Monomial, divisors: AbstractSet[Monomial]) -> bool:
    """Whether one of the divisors divides a monomial: either those of the monomial are looked up, or all are tried."""
    if prod(exponent + 1 for exponent in monomial) < len(divisors):
        return not divisors.isdisjoint(product(*(range(exponent + 1) for exponent in monomial)))
    return any(all(map(le, divisor, monomial)) for divisor in divisors)


def _standard(leading: AbstractSet[Monomial], size: int, most: int) -> list[Monomial] | None:
    """The monomials that none of the leading ones divides, by degree; None if there are more than ``most``."""
    charge(_DIVISION * (most + 1) * (size + 1) * size)
    found: list[Monomial] = []
    layer = {(0,) * size} - leading
    while layer:
        found += sorted(layer)
        if len(found) > most:
            return None
        larger = {shifted(monomial, axis, 1) for monomial in layer for axis in range(size)} - leading
        layer = {
            monomial
            for monomial in larger
            if all(shifted(monomial, axis, -1) in layer for axis, exponent in enumerate(monomial) if exponent)
        }
    return found


def shifted(monomial: Monomial, axis: int, step: int) -> Monomial:
    """The monomial with another exponent of one unknown."""
    return (*monomial[:axis], monomial[axis] + step, *monomial[axis + 1 :])
