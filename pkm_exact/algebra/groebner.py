"""Groebner bases modulo a prime by matrix reduction (F4), with a trace that is learned once and applied again.

Critical pairs of least degree are reduced together: their halves and all the reducers that they need are the rows
of one matrix, whose reduced row echelon form yields the new basis elements (Faugere, "A new efficient algorithm for
computing Groebner bases (F4)", J. Pure Appl. Algebra 139, 1999). Pairs are pruned by the criteria of Gebauer and
Moeller. The rows that mattered are recorded (Traverso, "Groebner trace algorithms", ISSAC 1988): at another prime
only those are built again, and a prime at which a recorded pivot moves is reported as unlucky.

A Groebner basis modulo one prime is a guide, not a proof: what it suggests over Q is verified elsewhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from pkm_exact.algebra.elimination_trace import Course, Step, Trace
from pkm_exact.algebra.monomials import MonomialRing, divides, exponent_fields
from pkm_exact.algebra.reduction import Row, new_rows, read_row, row_echelon, row_matrix
from pkm_exact.algebra.system import ModularPolynomial
from pkm_exact.errors import PkmExactError
from pkm_exact.stages import Amount, Watch


class OutOfReachError(PkmExactError):
    """The elimination met a degree beyond the limit of the policy."""


class UnluckyPrimeError(PkmExactError):
    """At this prime the elimination takes another course than at the prime where it was learned."""


@dataclass(frozen=True)
class GroebnerBasis:
    """A minimal Groebner basis modulo a prime, degree reverse lexicographic; each element is monic.

    Attributes
    ----------
    prime : int
    ring : MonomialRing
    elements : tuple of (packed monomials, coefficients)
        Sorted by leading monomial.
    trace : Trace or None
        How it was found, if that was recorded.
    course : Course or None
        From which the trace can be found later; None where a trace was followed.
    """

    prime: int
    ring: MonomialRing
    elements: tuple[ModularPolynomial, ...]
    trace: Trace | None = field(repr=False)
    course: Course | None = field(default=None, repr=False, compare=False)

    def recorded(self) -> GroebnerBasis:
        """The same with its trace."""
        if self.trace is not None or self.course is None:
            return self
        place = {element[0][0]: index for index, element in enumerate(self.course.known)}
        return replace(self, trace=self.course.trace([place[lead] for lead in self.leading_monomials], self.prime))

    @property
    def leading_monomials(self) -> tuple[int, ...]:
        """Leading monomials, increasing."""
        return tuple(element[0][0] for element in self.elements)

    @property
    def is_unit_ideal(self) -> bool:
        """Whether 1 lies in the ideal modulo the prime."""
        return self.leading_monomials[:1] == (0,)

    @property
    def is_zero_dimensional(self) -> bool:
        """Whether the staircase is finite: some power of every unknown is a leading monomial."""
        if self.is_unit_ideal:
            return True
        pure = set()
        for monomial in self.leading_monomials:
            exponents = self.ring.unpack(monomial)
            support = [index for index, exponent in enumerate(exponents) if exponent]
            if len(support) == 1:
                pure.add(support[0])
        return len(pure) == self.ring.size


def learn(
    polynomials: list[ModularPolynomial],
    ring: MonomialRing,
    prime: int,
    *,
    degree_limit: int,
    record: bool = True,
    watch: Watch | None = None,
) -> GroebnerBasis:
    """Groebner basis of the ideal that ``polynomials`` generate modulo ``prime``.

    Parameters
    ----------
    polynomials : list of (packed monomials, coefficients)
    ring : MonomialRing
    prime : int
    degree_limit : int
        Largest degree of a critical pair that is treated.
    record : bool
        Whether to find the rows that mattered, so that ``apply`` can repeat the run; ``recorded`` does so later.
    watch : callable, optional
        Gets how many critical pairs are done before each matrix.

    Raises
    ------
    OutOfReachError
        If a critical pair exceeds the degree limit.
    """
    basis = _Elimination(polynomials, ring, prime).run(degree_limit, watch)
    return basis.recorded() if record else basis


def apply(trace: Trace, polynomials: list[ModularPolynomial], ring: MonomialRing, prime: int) -> GroebnerBasis:
    """The same elimination at another prime, along a learned trace.

    Raises
    ------
    UnluckyPrimeError
        If a recorded pivot is not a pivot at this prime.
    """
    known: list[ModularPolynomial] = _interreduced(polynomials, prime)
    if tuple(polynomial[0][0] for polynomial in known) != trace.start:
        raise UnluckyPrimeError(f"the generators have other leading monomials modulo {prime}")
    for step in trace.steps:
        found = new_rows(step.rows, known, prime)
        if _leading(step.rows, known) | {polynomial[0][0] for polynomial in found} != step.leading:
            raise UnluckyPrimeError(f"a pivot is lost modulo {prime}")
        known.extend(polynomial for polynomial in found if polynomial[0][0] in step.new)
    elements = tuple(known[index] for index in trace.basis)
    return GroebnerBasis(prime, ring, elements, trace)


def _leading(rows: Sequence[Row], known: list[ModularPolynomial]) -> frozenset[int]:
    return frozenset(known[index][0][0] + multiplier for index, multiplier in rows)


def _interreduced(polynomials: list[ModularPolynomial], prime: int) -> list[ModularPolynomial]:
    """Row echelon form of the generators, smallest leading monomial last."""
    columns = sorted({monomial for polynomial in polynomials for monomial in polynomial[0]}, reverse=True)
    if not columns:
        return []
    rows = [(index, 0) for index in range(len(polynomials))]
    reduced, pivots = row_echelon(row_matrix(rows, polynomials, columns, prime))
    return [read_row(reduced, row, columns, pivot) for row, pivot in enumerate(pivots)]


@dataclass(frozen=True)
class _Pair:
    degree: int
    lcm: tuple[int, ...]
    fields: int
    first: int
    second: int


class _Elimination:
    """The state of one run: basis elements, which of them still lead, and the pairs that wait."""

    def __init__(self, polynomials: list[ModularPolynomial], ring: MonomialRing, prime: int) -> None:
        self.ring = ring
        self.prime = prime
        self.known: list[ModularPolynomial] = []
        self.exponents: list[tuple[int, ...]] = []
        self.fields: list[int] = []
        self.active: list[int] = []
        self.pairs: list[_Pair] = []
        self._divisor_cache: dict[int, tuple[int, int]] = {}
        self.generators = _interreduced(polynomials, prime)

    def run(self, degree_limit: int, watch: Watch | None) -> GroebnerBasis:
        for generator in self.generators:
            self._append(generator)
        for index in range(len(self.known) - 1, -1, -1):
            self._update(index)
        steps, done = [], 0
        while self.pairs:
            degree = min(pair.degree for pair in self.pairs)
            if degree > degree_limit:
                raise OutOfReachError(f"a critical pair of degree {degree} exceeds the limit {degree_limit}")
            selected = [pair for pair in self.pairs if pair.degree == degree]
            if watch is not None:
                watch(Amount(done, done + len(self.pairs), "critical pairs", "at least", f"degree {degree}"))
            done += len(selected)
            steps.append(self._reduce(selected))
        basis = sorted(self._minimal(), key=lambda index: self.known[index][0][0])
        course = Course(tuple(steps), tuple(self.known), len(self.generators))
        return GroebnerBasis(self.prime, self.ring, tuple(self.known[index] for index in basis), None, course)

    def _minimal(self) -> list[int]:
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

    def _reduce(self, selected: list[_Pair]) -> Step:
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
        leading = _leading(rows, self.known).union(new)
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
            self.pairs.append(_Pair(sum(lcm), lcm, multiple, classes[lcm][0], index))
        self.active = [other for other in self.active if not divides(fields, self.fields[other])]
        self.active.append(index)

    def _superseded(self, pair: _Pair, new: tuple[int, ...]) -> bool:
        """Whether the pairs of a new element that divides the pair's multiple with both members replace the pair."""
        return (
            tuple(map(max, self.exponents[pair.first], new)) != pair.lcm
            and tuple(map(max, self.exponents[pair.second], new)) != pair.lcm
        )
