"""Proofs that a system has infinitely many complex solutions.

Fewer polynomials than unknowns, and a solution: every component of their zeros has a dimension of at least the
difference. Or more
solutions than isolated ones can be: they come in slices, at which a linear form has one value after another.
"""

from __future__ import annotations

from collections.abc import Sequence
from random import Random
from typing import Final

from pkm_exact.algebra.exact_reduction import echelon_form
from pkm_exact.algebra.groebner import OutOfReachError
from pkm_exact.algebra.representation import UnivariateRepresentation
from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring
from pkm_exact.errors import ReconstructionError
from pkm_exact.policy import Policy
from pkm_exact.stages import Amount, Stages
from pkm_exact.systems.bezout import product_of_degrees, total_degrees
from pkm_exact.systems.solution_search import SolutionSearch
from pkm_exact.systems.system_solution import Slice, Witness
from pkm_exact.systems.top_forms import terms_of

MOST_SLICES: Final = 40
"""Slices that are tried: more of them would be a long proof."""
_LARGEST: Final = 9

LinearForm = tuple[int, ...]
"""Coefficients of the unknowns, then the constant."""


def prove_infinite(system: PolynomialSystem, policy: Policy, stages: Stages) -> Witness | None:
    """A proof that there are infinitely many solutions, or None if there is none of those known here."""
    size = len(system.unknowns)
    random = Random(policy.seed_for(system.digest, "slices"))
    forms = [tuple(random.randrange(-_LARGEST, _LARGEST + 1) for _ in range(size + 1)) for _ in range(size)]
    rank = _rank(system)
    try:
        for count in range(max(1, size - rank), size + 1):
            found = SolutionSearch(joined(system, forms[:count]), policy, stages).found()
            if found.representation is None:
                if found.dimension == 0:
                    return None
                continue
            if rank < size:
                return Witness("fewer-polynomials", found.representation)
            return _by_slices(system, forms[:count], found.representation, policy, stages)
    except (OutOfReachError, ReconstructionError):
        return None
    return None


def _rank(system: PolynomialSystem) -> int:
    """The dimension of the span of the polynomials."""
    ring = system.monomials
    packed = (tuple((ring.pack(key), value) for key, value in terms_of(f)) for f in system.polynomials)
    return len(echelon_form(list(packed)))


def joined(system: PolynomialSystem, forms: Sequence[LinearForm]) -> PolynomialSystem:
    """The system with linear forms as further polynomials; those that are 0 are left out."""
    ring = polynomial_ring(system.unknowns)
    further = []
    for *coefficients, constant in forms:
        total = ring.constant(constant)
        for value, unknown in zip(coefficients, ring.gens(), strict=True):
            total += value * unknown
        further.append(total)
    return PolynomialSystem(system.unknowns, (*system.polynomials, *(form for form in further if not form.is_zero())))


def _by_slices(
    system: PolynomialSystem,
    forms: Sequence[LinearForm],
    first: UnivariateRepresentation,
    policy: Policy,
    stages: Stages,
) -> Witness | None:
    """More solutions than the system with all forms but the last can have isolated ones, or None."""
    *fixed, last = forms
    bound = product_of_degrees([*total_degrees(system), *(1 for _ in fixed)], len(system.unknowns))
    if bound is None or bound >= MOST_SLICES * first.degree:
        return None
    slices = [Slice(0, first)]
    while (total := sum(part.representation.degree for part in slices)) <= bound:
        stages.amount(Amount(total, bound + 1, "solutions"))
        constant = slices[-1].constant + 1
        shifted = (*last[:-1], last[-1] - constant)
        found = SolutionSearch(joined(system, [*fixed, shifted]), policy).found()
        if found.representation is None or len(slices) > 2 * MOST_SLICES:
            return None
        slices.append(Slice(constant, found.representation))
    return Witness("more-solutions-than-bound", None, tuple(map(tuple, forms)), tuple(slices))
