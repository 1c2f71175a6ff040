"""Proofs that a verified list of solutions is all there is, or that there is none: the ways in the order of their
costs.

What is proved in each way, and why, is in ``docs/certificates-systems.md``.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Final

from pkm_exact.algebra.elimination_trace import Trace
from pkm_exact.algebra.exact_basis import ExactBasis, exact_basis
from pkm_exact.algebra.exact_quotient import exact_quotient
from pkm_exact.algebra.groebner import GroebnerBasis, OutOfReachError, UnluckyPrimeError
from pkm_exact.algebra.modular_elimination import Elimination
from pkm_exact.algebra.quotient import standard_monomials
from pkm_exact.algebra.representation import UnivariateRepresentation
from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.errors import PkmExactError
from pkm_exact.failures.contradiction import require
from pkm_exact.policy import Policy
from pkm_exact.stages import Watch
from pkm_exact.systems.algebra_multiplicities import algebra_multiplicities
from pkm_exact.systems.bezout import groups_with, product_of_degrees, total_degrees
from pkm_exact.systems.local_multiplicity import exact_weights
from pkm_exact.systems.mixed_volume import subdivision_for
from pkm_exact.systems.points_at_infinity import with_room_left
from pkm_exact.systems.regularity import Weights, derivatives, has_full_rank, total_weight, weights_at
from pkm_exact.systems.shortened_elimination import with_basis_only, with_falls_only
from pkm_exact.systems.system_claims import SystemRoute
from pkm_exact.systems.system_solution import ListProof, Steps
from pkm_exact.systems.top_forms import elements_of, is_empty_in_space, number_of, room_for

MOST_WORK: Final = 10**10
"""Half of what checkers allow for any file (``docs/certificates.md``, "Work")."""


@dataclass(frozen=True)
class ListedSolutions:
    """A verified list, and what is known of its members one by one.

    Attributes
    ----------
    system : PolynomialSystem
    representation : UnivariateRepresentation
    weights : Weights
        Numbers that are at most the multiplicities of isolated solutions; empty if all are regular.
    """

    system: PolynomialSystem = field(repr=False)
    representation: UnivariateRepresentation
    weights: Weights

    @property
    def is_regular(self) -> bool:
        """Whether all solutions are proved isolated and simple."""
        return not self.weights

    @property
    def weight(self) -> int:
        """The sum of the weights."""
        return total_weight(self.weights) if self.weights else self.representation.degree

    def filling(self, room: int | None) -> Weights | None:
        """The multiplicities if they are proved to sum to the greatest number possible, all solutions being isolated.

        The weights, if they do; otherwise the exact ones.
        """
        if room == self.weight:
            return self.weights
        if room is None or self.is_regular or room < self.weight:
            return None
        exact = exact_weights(self.system.polynomials, self.representation, self.weights, room)
        return exact if exact is not None and total_weight(exact) == room else None


def listed(representation: UnivariateRepresentation, system: PolynomialSystem, policy: Policy) -> ListedSolutions:
    """The list with the weights of its members."""
    table = derivatives(system.polynomials, len(system.unknowns))
    if has_full_rank(table, representation, policy):
        return ListedSolutions(system, representation, ())
    square = len(system.polynomials) == len(system.unknowns)
    weights = weights_at(table, representation, policy, square=square)
    return ListedSolutions(system, representation, () if all(weight == 1 for _, weight in weights) else weights)


def prove_complete(
    found: ListedSolutions,
    system: PolynomialSystem,
    policy: Policy,
    watch: Watch | None = None,
    known: Elimination | None = None,
) -> ListProof | None:
    """A proof that the list is complete, or None if none of the ways known here closes.

    Parameters
    ----------
    found : ListedSolutions
    system : PolynomialSystem
    policy : Policy
    watch : callable, optional
        Gets how far an elimination has come.
    known : Elimination, optional
        One of the same system, the bases of which are used again.

    Raises
    ------
    UnluckyPrimeError
        If it is proved that there are more solutions.
    BeyondCheckersError
        If a proof was found that is too much work to check.
    """
    proof = prove_by_bounds(found, system, policy)
    return proof or prove_by_search(found, system, policy, watch, known)


def prove_by_bounds(found: ListedSolutions, system: PolynomialSystem, policy: Policy) -> ListProof | None:
    """A proof for which the system need not be solved modulo a prime.

    By degrees, as a whole or in groups of variables, by ranks where nothing is at infinity, or by the terms that occur.
    """
    degree = found.representation.degree
    if found.is_regular and degree == product_of_degrees(total_degrees(system), len(system.unknowns)):
        return ListProof(SystemRoute.REFINED_BEZOUT, degree)
    room = room_for(system, degree if found.is_regular else policy.dimension_limit, policy)
    weights = found.filling(room)
    if room is not None and weights is not None:
        return ListProof(SystemRoute.MODULAR_RANK, room, weights)
    if not found.is_regular:
        return None
    groups = groups_with(system, degree)
    if groups is not None:
        return ListProof(SystemRoute.MULTIHOMOGENEOUS_BEZOUT, degree, groups=groups)
    subdivision = subdivision_for(system, degree, policy)
    return None if subdivision is None else ListProof(SystemRoute.MIXED_VOLUME, degree, subdivision=subdivision)


def prove_by_search(
    found: ListedSolutions,
    system: PolynomialSystem,
    policy: Policy,
    watch: Watch | None = None,
    known: Elimination | None = None,
) -> ListProof | None:
    """A proof for which something must be solved or eliminated first; parameters and errors as ``prove_complete``."""
    points, room = with_room_left(system, found.weight, policy) or (None, None)
    weights = found.filling(room)
    if room is not None and weights is not None:
        return ListProof(SystemRoute.COUNTING_AT_INFINITY, room, weights, infinity=points)
    proofs = (_by_elimination(basis, found, system, policy, watch) for basis in _eliminations(system, policy, known))
    return next((proof for proof in proofs if proof is not None), None)


def prove_inconsistent(system: PolynomialSystem, policy: Policy, watch: Watch | None = None) -> ListProof | None:
    """A proof that there is no complex solution, or None."""
    if is_empty_in_space(system, policy):
        return ListProof(SystemRoute.MODULAR_RANK, 0)
    for modular in _eliminations(system, policy):
        trace = with_falls_only(modular)
        with suppress(UnluckyPrimeError):
            basis = exact_basis(system, trace, watch)
            if 0 in basis.leading_monomials:
                return ListProof(SystemRoute.EXACT_ELIMINATION, 0, elimination=_steps(basis))
    return None


def _eliminations(
    system: PolynomialSystem, policy: Policy, known: Elimination | None = None
) -> Iterator[GroebnerBasis]:
    """Eliminations modulo primes at which the solutions are finitely many, each that differs from those before once."""
    elimination = Elimination(system, policy)
    if known is not None:
        elimination.knowing(known)
    traces: list[Trace | None] = []
    for _ in range(policy.attempts):
        image = elimination.image()
        basis = image.basis if image.algebra is None else image.basis.recorded()
        if basis.trace in traces:
            return
        traces.append(basis.trace)
        if basis.trace is not None:
            yield basis


def _by_elimination(
    modular: GroebnerBasis, found: ListedSolutions, system: PolynomialSystem, policy: Policy, watch: Watch | None
) -> ListProof | None:
    """The proof by polynomials over Q that follow: where degrees fall, or else by the whole algebra."""
    try:
        basis = exact_basis(system, with_falls_only(modular), watch)
        room = number_of(len(system.unknowns), elements_of(basis), policy.dimension_limit, policy, system.digest)
        enough = room is None or room >= found.weight
        require(enough, "there is room for fewer solutions than were verified", room=room or 0)
        weights = found.filling(room)
        if room is not None and weights is not None:
            return ListProof(SystemRoute.EXACT_ELIMINATION, room, weights, elimination=_steps(basis))
        return _by_algebra(exact_basis(system, with_basis_only(modular), watch), found, policy)
    except (UnluckyPrimeError, OutOfReachError) as error:
        if isinstance(error, MoreSolutionsError):
            raise
        return None


class BeyondCheckersError(PkmExactError):
    """The list could be proved complete, but by more work than checkers allow."""


class MoreSolutionsError(UnluckyPrimeError):
    """It is proved that there are more solutions than those that were found."""


def _by_algebra(basis: ExactBasis, found: ListedSolutions, policy: Policy) -> ListProof | None:
    """The proof by the trace form, which counts distinct solutions."""
    representation = found.representation
    left = standard_monomials(basis.ring, basis.leading_monomials, policy.dimension_limit)
    if left is None:
        return None
    _require_affordable(len(left), 1)
    quotient = exact_quotient(basis, policy.dimension_limit)
    if quotient is None:
        return None
    numbers = (value for matrix in quotient.unknowns for value in matrix.numer_denom()[0].entries())
    _require_affordable(len(left), 1 + max((int(abs(value)).bit_length() for value in numbers), default=0) // 64)
    rank = quotient.distinct_solutions
    if rank > representation.degree:
        raise MoreSolutionsError(f"there are {rank} solutions, and {representation.degree} of them were found")
    require(rank == representation.degree, "the trace form counts other solutions than were verified", rank=rank)
    weights = algebra_multiplicities(representation, quotient, policy)
    if weights is None:
        return None
    total = total_weight(weights)
    require(total == len(left), "the multiplicities do not sum to the number of solutions", sum=total, left=len(left))
    return ListProof(SystemRoute.EXACT_ELIMINATION, total, weights, elimination=_steps(basis))


def _require_affordable(size: int, words: int) -> None:
    """An algebra of this dimension, with numbers of so many words, can be checked in half of the work that is allowed.

    Its trace form takes a product of matrices for each element of the basis.
    """
    if size**4 * words * (30 + words // 8) > MOST_WORK:
        raise BeyondCheckersError(f"an algebra of dimension {size} with numbers of {words} words")


def _steps(basis: ExactBasis) -> Steps:
    return tuple(tuple((index, basis.ring.unpack(monomial)) for index, monomial in step) for step in basis.steps)
