"""Elimination over Q along a trace learned modulo a prime: polynomials that lie in the ideal, without any doubt.

The rows of each matrix are multiples of polynomials already known to lie in the ideal, and the reduced row echelon form
is computed over Q. Whatever trace is followed, the results are members of the ideal over Q; the trace only makes the
matrices small. Monomials that no leading monomial divides then span the quotient algebra: their number bounds the
number of solutions, multiplicities counted, from above.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from pkm_exact.algebra.elimination_trace import Trace
from pkm_exact.algebra.exact_reduction import ExactPolynomial, echelon_form, exact_new_rows
from pkm_exact.algebra.groebner import UnluckyPrimeError
from pkm_exact.algebra.monomials import MonomialRing, divides, exponent_fields
from pkm_exact.algebra.reduction import Row
from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.stages import Amount, Watch


@dataclass(frozen=True)
class ExactBasis:
    """Members of an ideal over Q.

    Attributes
    ----------
    ring : MonomialRing
    elements : tuple of ExactPolynomial
    steps : tuple of tuple of Row
        The rows of each matrix: index of an element, and the packed monomial that multiplies it. The elements with the
        first indices are the echelon form of the generators; each matrix appends the rows of its echelon form whose
        leading monomial no earlier element's divides.
    """

    ring: MonomialRing
    elements: tuple[ExactPolynomial, ...]
    steps: tuple[tuple[Row, ...], ...]

    @property
    def leading_monomials(self) -> tuple[int, ...]:
        """Leading monomials, in the order of the elements."""
        return tuple(element[0][0] for element in self.elements)


def exact_basis(system: PolynomialSystem, trace: Trace, watch: Watch | None = None) -> ExactBasis:
    """The elimination of ``trace`` over Q; ``watch`` gets how many matrices are done before each.

    Raises
    ------
    UnluckyPrimeError
        If the elimination takes another course over Q than modulo the prime where the trace was learned.
    """
    ring = system.monomials
    generators = [
        tuple((ring.pack(tuple(map(int, exponents))), int(value)) for exponents, value in polynomial.to_dict().items())
        for polynomial in system.polynomials
    ]
    elements = echelon_form(generators)
    _require_leading(elements, trace.start)
    known = [_fields(ring, element) for element in elements]
    steps = []
    for done, step in enumerate(trace.steps):
        if watch is not None:
            watch(Amount(done, len(trace.steps), "exact matrices", detail=f"{len(step.rows)} rows"))
        rows = [multiple(elements[index], monomial) for index, monomial in step.rows]
        found = ((row, _fields(ring, row)) for row in exact_new_rows(rows, step.leading))
        new = [row for row, fields in found if not any(divides(lead, fields) for lead in known)]
        _require_leading(new, step.new)
        elements += new
        known += [_fields(ring, element) for element in new]
        steps.append(step.rows)
    return ExactBasis(ring, tuple(elements), tuple(steps))


def _require_leading(elements: Sequence[ExactPolynomial], expected: Sequence[int]) -> None:
    if [element[0][0] for element in elements] != list(expected):
        raise UnluckyPrimeError("over Q other leading monomials appear than modulo the prime of the trace")


def _fields(ring: MonomialRing, polynomial: ExactPolynomial) -> int:
    """The leading monomial, for ``divides``."""
    return exponent_fields(ring.unpack(polynomial[0][0]))


def multiple(polynomial: ExactPolynomial, monomial: int) -> ExactPolynomial:
    """The polynomial times a packed monomial."""
    return tuple((key + monomial, value) for key, value in polynomial)
