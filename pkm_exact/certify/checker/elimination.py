"""Exact elimination: an upper bound for the number of poses, from polynomials over Q that vanish at all of them.

Elements. The first ones are the rows of the reduced echelon form of the quadrics of the section (``section``), largest
leading monomial first. Each step of an elimination names products of known elements and monomials; of the reduced
echelon form of these products, the rows whose leading monomial no earlier element's divides become elements. Monomials
are ordered by degree, then reverse lexicographically (``packed_monomials``). Whatever is combined, every element
vanishes at every pose.

Bound. Every polynomial is, modulo the elements, a combination of the monomials that no leading monomial divides. If
these are n, then the unknowns take at most n different values at poses, and a pose is determined by them. For the last
step, which nothing is multiplied after, leading monomials modulo a prime say as much, if a power of each unknown is
among those that are as high over Q.
"""

from __future__ import annotations

from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from itertools import count
from typing import TypeAlias

from flint import fmpz, nmod_mat

from pkm_exact.certify.checker.budget import charge, limbs
from pkm_exact.certify.checker.echelon import pivots_of, reduced_rows
from pkm_exact.certify.checker.packed_monomials import Code, Monomial, Packed, Packing, Polynomial, packing_for
from pkm_exact.certify.checker.section import section
from pkm_exact.certify.checker.study_motion import Leg, Metric
from pkm_exact.certify.checker.verdict import MAX_ELIMINATION_ENTRIES, MAX_ELIMINATION_TERMS, rejected, too_large

Row: TypeAlias = tuple[int, tuple[int, ...]]
"""A product: index of an element, from 0, and the indices of the unknowns that multiply it."""
_TERM = 3000
"""Operations charged for a term that is multiplied or put into a matrix."""
_DIVISION = 2000
"""Operations charged for asking whether one monomial divides another."""


@dataclass(frozen=True)
class Elimination:
    """Polynomials that vanish at all poses: ``packed``, terms in decreasing order, in the unknowns of ``packing``."""

    packing: Packing
    packed: tuple[Packed, ...]

    @classmethod
    def begun(cls, size: int, polynomials: Sequence[Polynomial]) -> Elimination:
        """The rows of the reduced echelon form of polynomials in so many unknowns."""
        degree = max((sum(monomial) for one in polynomials for monomial in one), default=0)
        packing = packing_for(size, degree, sum(map(len, polynomials)))
        return cls.reduced(packing, _packed(polynomials, packing))

    @classmethod
    def reduced(cls, packing: Packing, polynomials: Sequence[Packed]) -> Elimination:
        """The rows of the reduced echelon form of polynomials, terms in any order."""
        return cls(packing, tuple(_echelon(polynomials, packing, set())))

    @property
    def size(self) -> int:
        """The number of unknowns."""
        return self.packing.size

    @cached_property
    def elements(self) -> tuple[Polynomial, ...]:
        """The polynomials, terms in decreasing order."""
        unpacked = self.packing.unpacked
        return tuple({unpacked(code): value for code, value in element.items()} for element in self.packed)

    @property
    def lowest_degree(self) -> int | None:
        """The lowest degree of an element; None if there is none."""
        return min(map(self.packing.degree, self._leading()), default=None)

    def standard(self, most: int) -> list[Monomial]:
        """The monomials that no leading monomial of an element divides; rejects if there are more than ``most``."""
        found = _standard(set(map(self.packing.unpacked, self._leading())), self.size, most)
        if found is None:
            raise rejected(f"elimination: it leaves more than {most} monomials")
        return found

    def products(self, step: Sequence[Row]) -> list[Packed]:
        """The products of a step that this is ``prepared`` for."""
        return [self.packing.multiple(self.packed[index], factors) for index, factors in step]

    def prepared(self, step: Sequence[Row], number: int) -> Elimination:
        """The same, so that degrees may be as high, and terms as many, as after a step, which has this number.

        Rejects a step of what there is not; refuses one that is too long.
        """
        if any(index >= len(self.packed) or max(factors, default=0) >= self.size for index, factors in step):
            raise rejected(f"elimination: step {number} names an element or an unknown that there is not")
        terms = sum(len(self.packed[index]) for index, _ in step)
        _limit_terms(terms)
        degrees = [self.packing.degree(_leading(element)) for element in self.packed]
        degree = max([0, *degrees, *(degrees[index] + len(factors) for index, factors in step)])
        packing = packing_for(self.size, degree, max(terms, sum(map(len, self.packed))))
        return self if packing == self.packing else Elimination(packing, tuple(_packed(self.elements, packing)))

    def followed(self, products: Sequence[Packed]) -> Elimination:
        """With the further elements that the products of a step yield."""
        found = _echelon(products, self.packing, self._leading())
        _limit_terms(sum(map(len, (*self.packed, *found))))
        return Elimination(self.packing, (*self.packed, *found))

    def at_most(self, step: Sequence[Row], most: int) -> int | None:
        """How many poses there are at most, by the products of a further step modulo a prime, with multiplicity.

        None if these do not tell, or if it is more than ``most``. Any prime serves; one that follows from the elements
        nearly always tells what the step tells over Q, as no element can be built on it.
        """
        prime, degree_of = _prime(self.packed), self.packing.degree
        elements = [{code: value % prime for code, value in element.items()} for element in self.packed]
        leading = {_leading(element) for element in elements if element[_leading(element)]}
        products = [self.packing.multiple(elements[index], factors) for index, factors in step]
        columns = _columns(products)
        charge(len(products) * len(columns) * (50 + min(len(products), len(columns)) // 3))
        place = {code: column for column, code in enumerate(columns)}
        table = nmod_mat(len(products), len(columns), prime)
        for row, polynomial in enumerate(products):
            for code, value in polynomial.items():
                table[row, place[code]] = value
        pivots = {columns[place] for place in pivots_of(*table.rref())}
        # Over Q a row may begin on the left of its pivot, in a column that has none: powers of this degree last.
        degree = max((degree_of(code) for code in columns if code not in pivots), default=0)
        lasting = leading.union(code for code in pivots if degree_of(code) >= degree)
        powers = set(map(self.packing.unknown_of_power, lasting)) - {None}
        if len(powers) < self.size:
            return None
        left = _standard(set(map(self.packing.unpacked, leading | pivots)), self.size, most)
        return None if left is None else len(left)

    def _leading(self) -> set[Code]:
        return set(map(_leading, self.packed))


def follow(begun: Elimination, steps: Sequence[Sequence[Row]]) -> Elimination:
    """The elements that the steps yield, beginning with the first ones."""
    elimination = begun
    for number, step in enumerate(steps, 1):
        elimination = elimination.prepared(step, number)
        elimination = elimination.followed(elimination.products(step))
    return elimination


class Steps:
    """Steps of an elimination; the last one is not followed over Q if enough is proved modulo a prime."""

    def __init__(self, begun: Elimination, steps: Sequence[Sequence[Row]]) -> None:
        self._before = follow(begun, steps[:-1])
        self._last = steps[-1:]
        for step in self._last:
            self._before = self._before.prepared(step, len(steps))

    def room(self, few: int, most: int) -> int:
        """For how many poses there is room at most, with multiplicity; rejects if for more than ``most``.

        A prime tells it, if it tells that these are few, or else the monomials that are left over Q.
        """
        found = next((self._before.at_most(step, few) for step in self._last), None)
        return len(self.elimination.standard(most)) if found is None else found

    @cached_property
    def elimination(self) -> Elimination:
        """All elements."""
        elimination = self._before
        for step in self._last:
            elimination = elimination.followed(elimination.products(step))
        return elimination


def eliminate(legs: Sequence[Leg], metric: Metric, steps: Sequence[Sequence[Row]]) -> Steps:
    """The steps, for a robot with legs."""
    return Steps(Elimination.reduced(*section(legs, metric)), steps)


def _limit_terms(number: int) -> None:
    """Refuse more terms than there may be in all elements, or in the products of a step; charge for going over them."""
    if number > MAX_ELIMINATION_TERMS:
        raise too_large(f"elimination: more than {MAX_ELIMINATION_TERMS} terms")
    charge(_TERM * number)


def _packed(polynomials: Sequence[Polynomial], packing: Packing) -> list[Packed]:
    codes = {monomial: packing.packed(monomial) for monomial in {m for one in polynomials for m in one}}
    return [{codes[monomial]: value for monomial, value in one.items()} for one in polynomials]


def _leading(polynomial: Packed) -> Code:
    return next(iter(polynomial))


def _echelon(polynomials: Sequence[Packed], packing: Packing, leading: AbstractSet[Code]) -> list[Packed]:
    """The rows of the reduced echelon form over Q, as primitive integer polynomials, terms in decreasing order.

    Without those whose leading monomial one of ``leading`` divides.
    """
    charge(_TERM * sum(map(len, polynomials)))
    columns = _columns(polynomials)
    charge((100 + _DIVISION * len(leading)) * len(columns))
    place = {code: column for column, code in enumerate(columns)}
    known = packing.multiples(columns, leading)
    found = reduced_rows([{place[code]: value for code, value in row.items()} for row in polynomials], known)
    rows = [found[pivot] for pivot in sorted(found) if pivot not in known]
    return [{columns[column]: row[column] for column in sorted(row)} for row in rows]


def _columns(polynomials: Sequence[Packed]) -> list[Code]:
    """All monomials of some polynomials, decreasing."""
    columns = sorted({code for polynomial in polynomials for code in polynomial}, reverse=True)
    if len(polynomials) * len(columns) > MAX_ELIMINATION_ENTRIES:
        raise too_large(f"elimination: a matrix of more than {MAX_ELIMINATION_ENTRIES} entries")
    return columns


def _standard(leading: AbstractSet[Monomial], size: int, most: int) -> list[Monomial] | None:
    """The monomials that none of the leading ones divides, by degree; None if there are more than ``most``."""
    found: list[Monomial] = []
    layer = {(0,) * size} - leading
    while layer:
        found += sorted(layer)
        if len(found) > most:
            return None
        charge(_DIVISION * len(layer) * size * (1 + sum(found[-1])))
        larger = {shifted(monomial, axis, 1) for monomial in layer for axis in range(size)} - leading
        layer = {
            monomial
            for monomial in larger
            if all(shifted(monomial, axis, -1) in layer for axis, exponent in enumerate(monomial) if exponent)
        }
    return found


def _prime(elements: Sequence[Packed]) -> int:
    """A prime of 63 bits that follows from a digest of the coefficients; their residues are charged for, too."""
    charge(sum(500 + 100 * limbs(value.bit_length()) for element in elements for value in element.values()))
    text = ";".join(",".join(map(hex, element.values())) for element in elements)
    first = int.from_bytes(sha256(text.encode("ascii")).digest()[:8], "big") >> 2 | 1 << 62
    return next(number for number in count(first) if fmpz(number).is_prime())


def shifted(monomial: Monomial, axis: int, step: int) -> Monomial:
    """The monomial with another exponent of one unknown."""
    return (*monomial[:axis], monomial[axis] + step, *monomial[axis + 1 :])
