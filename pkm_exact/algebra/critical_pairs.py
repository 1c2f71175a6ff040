"""Critical pairs of an elimination modulo a prime: which of them wait, and what a matrix of some of them yields.

Pairs are pruned by the criteria of Gebauer and Moeller ("On an installation of Buchberger's algorithm", J. Symb. Comp.
6, 1988).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from pkm_exact.algebra.elimination_trace import Step
from pkm_exact.algebra.monomials import MonomialRing, divides, exponent_fields
from pkm_exact.algebra.reduction import Row, new_rows, read_row, row_echelon, row_matrix
from pkm_exact.algebra.system import ModularPolynomial


def leading_of(rows: Sequence[Row], known: list[ModularPolynomial]) -> frozenset[int]:
    """The leading monomials of rows."""
    return frozenset(known[index][0][0] + multiplier for index, multiplier in rows)


def interreduced(polynomials: list[ModularPolynomial], prime: int) -> list[ModularPolynomial]:
    """Row echelon form of the generators, smallest leading monomial last."""
    columns = sorted({monomial for polynomial in polynomials for monomial in polynomial[0]}, reverse=True)
    if not columns:
        return []
    rows = [(index, 0) for index in range(len(polynomials))]
    reduced, pivots = row_echelon(row_matrix(rows, polynomials, columns, prime))
    return [read_row(reduced, row, columns, pivot) for row, pivot in enumerate(pivots)]


@dataclass(frozen=True)
class Pair:
    """Two elements by their numbers, the least common multiple of their leading monomials, and its degree."""

    degree: int
    lcm: tuple[int, ...]
    fields: int
    first: int
    second: int


class CriticalPairs:
    """The state of one run: basis elements, which of them still lead, and the pairs that wait."""

    def __init__(self, generators: Sequence[ModularPolynomial], ring: MonomialRing, prime: int) -> None:
        self.ring = ring
        self.prime = prime
        self.known: list[ModularPolynomial] = []
        self.exponents: list[tuple[int, ...]] = []
        self.fields: list[int] = []
        self.active: list[int] = []
        self.pairs: list[Pair] = []
        self._divisor_cache: dict[int, tuple[int, int]] = {}
        for generator in generators:
            self._append(generator)
        for index in range(len(self.known) - 1, -1, -1):
            self._update(index)

    @property
    def degree(self) -> int:
        """The least degree of a pair that waits."""
        return min(pair.degree for pair in self.pairs)

    def least(self) -> list[Pair]:
        """The pairs of least degree."""
        degree = self.degree
        return [pair for pair in self.pairs if pair.degree == degree]

    def minimal(self) -> list[int]:
        """Indices of the basis elements whose leading monomial no other one divides."""
        return [
            index
            for index in self.active
            if not any(other != index and divides(self.fields[other], self.fields[index]) for other in self.active)
        ]

    def _append(self, polynomial: ModularPolynomial) -> None:
        self.known.append(polynomial)
        self.exponents.append(self.ring.unpack(polynomial[0][0]))
        self.fields.append(exponent_fields(self.exponents[-1]))

    def reduce(self, selected: Sequence[Pair]) -> Step:
        """Reduce pairs together; the new elements are appended, with their pairs."""
        chosen = set(selected)
        self.pairs = [pair for pair in self.pairs if pair not in chosen]
        halves: dict[Row, None] = {}
        for pair in selected:
            top = self.ring.pack(pair.lcm)
            for index in (pair.first, pair.second):
                halves[(index, top - self.known[index][0][0])] = None
        rows = self._with_reducers(list(halves))
        found = new_rows(rows, self.known, self.prime)
        new = tuple(polynomial[0][0] for polynomial in found)
        leading = leading_of(rows, self.known).union(new)
        first = len(self.known)
        for polynomial in found:
            self._append(polynomial)
        for index in range(len(self.known) - 1, first - 1, -1):
            self._update(index)
        return Step(tuple(rows), leading, new)

    def _with_reducers(self, rows: list[Row]) -> list[Row]:
        """Symbolic preprocessing: a reducer for every monomial that some leading monomial divides."""
        seen: set[int] = set()
        led = {self.known[index][0][0] + multiplier for index, multiplier in rows}
        rows = list(rows)
        done = 0
        while done < len(rows):
            index, multiplier = rows[done]
            done += 1
            for monomial in self.known[index][0]:
                product = monomial + multiplier
                if product in seen:
                    continue
                seen.add(product)
                if product in led:
                    continue
                divisor = self._divisor(product)
                if divisor >= 0:
                    led.add(product)
                    rows.append((divisor, product - self.known[divisor][0][0]))
        return rows

    def _divisor(self, monomial: int) -> int:
        """Index of a basis element whose leading monomial divides ``monomial``, or -1."""
        found, checked = self._divisor_cache.get(monomial, (-1, 0))
        if found >= 0 or checked == len(self.known):
            return found
        fields = exponent_fields(self.ring.unpack(monomial))
        divisors = (index for index in range(checked, len(self.known)) if divides(self.fields[index], fields))
        found = next(divisors, -1)
        self._divisor_cache[monomial] = (found, len(self.known))
        return found

    def _update(self, index: int) -> None:
        """Add a basis element: form its pairs, prune by the criteria of Gebauer and Moeller."""
        new, fields = self.exponents[index], self.fields[index]
        self.pairs = [pair for pair in self.pairs if not (divides(fields, pair.fields) and self._superseded(pair, new))]
        classes: dict[tuple[int, ...], list[int]] = {}
        for other in self.active:
            classes.setdefault(tuple(map(max, self.exponents[other], new)), []).append(other)
        kept: list[int] = []
        for lcm in sorted(classes, key=sum):
            multiple = exponent_fields(lcm)
            if any(divides(smaller, multiple) for smaller in kept):
                continue
            kept.append(multiple)
            if any(sum(lcm) == sum(new) + sum(self.exponents[other]) for other in classes[lcm]):
                continue
            self.pairs.append(Pair(sum(lcm), lcm, multiple, classes[lcm][0], index))
        self.active = [other for other in self.active if not divides(fields, self.fields[other])]
        self.active.append(index)

    def _superseded(self, pair: Pair, new: tuple[int, ...]) -> bool:
        """Whether the pairs of a new element that divides the pair's multiple with both members replace the pair."""
        return (
            tuple(map(max, self.exponents[pair.first], new)) != pair.lcm
            and tuple(map(max, self.exponents[pair.second], new)) != pair.lcm
        )
