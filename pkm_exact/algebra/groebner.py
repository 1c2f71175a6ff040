"""Groebner bases modulo a prime by matrix reduction (F4), with a trace that is learned once and applied again.

Critical pairs of least degree are reduced together: their halves and all the reducers that they need are the rows
of one matrix, whose reduced row echelon form yields the new basis elements (Faugere, "A new efficient algorithm for
computing Groebner bases (F4)", J. Pure Appl. Algebra 139, 1999). Pairs are pruned by the criteria of Gebauer and
Moeller. The rows that mattered are recorded (Traverso, "Groebner trace algorithms", ISSAC 1988): at another prime
only those are built again, and a prime at which a recorded pivot moves is reported as unlucky.

A Groebner basis modulo one prime is a guide, not a proof: what it suggests over Q is verified elsewhere.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from pkm_exact.algebra.critical_pairs import CriticalPairs, interreduced, leading_of
from pkm_exact.algebra.elimination_trace import Course, Trace
from pkm_exact.algebra.monomials import MonomialRing
from pkm_exact.algebra.reduction import new_rows
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
        return replace(self, trace=self.course.trace(self._places(self.course), self.prime))

    def way(self) -> Trace | None:
        """What ``apply`` needs to find it at another prime, quicker than along the trace."""
        return self.trace if self.course is None else self.course.way(self._places(self.course), self.prime)

    def _places(self, course: Course) -> list[int]:
        """Indices of the elements."""
        place = {element[0][0]: index for index, element in enumerate(course.known)}
        return [place[lead] for lead in self.leading_monomials]

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
    generators = interreduced(polynomials, prime)
    pairs = CriticalPairs(generators, ring, prime)
    steps, done = [], 0
    while pairs.pairs:
        if pairs.degree > degree_limit:
            raise OutOfReachError(f"a critical pair of degree {pairs.degree} exceeds the limit {degree_limit}")
        selected = pairs.least()
        if watch is not None:
            watch(Amount(done, done + len(pairs.pairs), "critical pairs", "at least", f"degree {pairs.degree}"))
        done += len(selected)
        steps.append(pairs.reduce(selected))
    indices = sorted(pairs.minimal(), key=lambda index: pairs.known[index][0][0])
    course = Course(tuple(steps), tuple(pairs.known), len(generators))
    basis = GroebnerBasis(prime, ring, tuple(pairs.known[index] for index in indices), None, course)
    return basis.recorded() if record else basis


def apply(trace: Trace, polynomials: list[ModularPolynomial], ring: MonomialRing, prime: int) -> GroebnerBasis:
    """The same elimination at another prime, along a learned trace.

    Raises
    ------
    UnluckyPrimeError
        If a recorded pivot is not a pivot at this prime.
    """
    known: list[ModularPolynomial] = interreduced(polynomials, prime)
    if tuple(polynomial[0][0] for polynomial in known) != trace.start:
        raise UnluckyPrimeError(f"the generators have other leading monomials modulo {prime}")
    for step in trace.steps:
        found = new_rows(step.rows, known, prime)
        if leading_of(step.rows, known) | {polynomial[0][0] for polynomial in found} != step.leading:
            raise UnluckyPrimeError(f"a pivot is lost modulo {prime}")
        known.extend(polynomial for polynomial in found if polynomial[0][0] in step.new)
    elements = tuple(known[index] for index in trace.basis)
    return GroebnerBasis(prime, ring, elements, trace)
