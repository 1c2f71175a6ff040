"""The short ways to prove that a list of isolated poses is complete: no elimination over Q.

In this order: as many simple poses as some bound admits (``pose_bound``), all that ranks modulo a prime leave where
nothing is at infinity (``modular_rank``), and, on all rigid motions, poses and points at infinity that fill the degree
together, the section being finite (``finite_section``, ``infinity``).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from pkm_exact.algebra.primes import primes_from
from pkm_exact.claim import CompletenessRoute
from pkm_exact.completeness.closed_section import ClosedSection, closed_section
from pkm_exact.completeness.conditions import Conditions
from pkm_exact.completeness.finite_section import is_finite, most_at_infinity
from pkm_exact.completeness.infinity import PointsAtInfinity, points_at_infinity
from pkm_exact.completeness.modular_rank import modular_rank
from pkm_exact.completeness.pose_bound import form_rank, pose_bound
from pkm_exact.completeness.shared_boundary import SharedBoundary
from pkm_exact.failures.contradiction import require
from pkm_exact.motions.motion_groups import SPATIAL
from pkm_exact.policy import Policy

LIFTING_BITS: Final = 1 << 15
"""Of points at infinity at most: with longer numbers the way is no short one."""


@dataclass(frozen=True)
class ShortProof:
    """That there is no pose beside those listed.

    Attributes
    ----------
    route : CompletenessRoute
    infinity : PointsAtInfinity or None
        For counting at infinity.
    """

    route: CompletenessRoute
    infinity: PointsAtInfinity | None = None


def short_proof(
    conditions: Conditions,
    distinct: int,
    total: int,
    policy: Policy,
    section: ClosedSection | None = None,
    shared: SharedBoundary | None = None,
) -> ShortProof | None:
    """A proof that the poses listed are all, or None if no short way closes.

    Parameters
    ----------
    conditions : Conditions
    distinct : int
        Number of poses listed, proved to be distinct; where nothing is at infinity or the section is finite, each is
        isolated.
    total : int
        The sum of numbers that are at most their multiplicities, 1 only at poses proved to be simple.
    policy : Policy
        For primes, and how far points at infinity are lifted.
    section : ClosedSection, optional
        That of the conditions, if it is known.
    shared : SharedBoundary, optional
        Of robots with the same conditions at infinity.
    """
    primes = primes_from(policy.seed_for(conditions.digest), policy.prime_bits)
    bound = pose_bound(conditions)
    if distinct == total == bound.least:
        is_lower = bound.least < bound.degree
        return ShortProof(CompletenessRoute.PRODUCT_BOUND if is_lower else CompletenessRoute.REFINED_BEZOUT)
    if modular_rank(section or closed_section(conditions), next(primes), total) == total:
        return ShortProof(CompletenessRoute.MODULAR_RANK)
    if conditions.motion != SPATIAL or conditions.quadrics:
        return None
    if not _has_room(conditions, bound.degree - total, primes, shared):
        return None
    # "No" may be the fault of primes or of too few relations: it is asked twice.
    bits = min(policy.lifting_bits, LIFTING_BITS)
    tried = (points_at_infinity(conditions, primes, bits, is_quick=each, shared=shared) for each in (True, False))
    found = next(filter(None, tried), None)
    if found is None or total + found.multiplicity < bound.degree:
        return None
    if not any(is_finite(conditions, next(primes), is_quick=is_quick) for is_quick in (True, False)):
        return None
    counts = {"listed": total, "infinity": found.multiplicity}
    require(total + found.multiplicity <= bound.degree, "more solutions than the degree of the motions", **counts)
    return ShortProof(CompletenessRoute.COUNTING_AT_INFINITY, found)


def can_close(conditions: Conditions, policy: Policy) -> bool:
    """Whether the degree of the motions, or another bound, can be filled at all: not where curves are at infinity.

    "No" says only that nothing is known that would do.
    """
    bound = pose_bound(conditions)
    if bound.least < bound.degree or conditions.motion != SPATIAL or not _is_square(conditions):
        return True
    primes = primes_from(policy.seed_for(conditions.digest, "room"), policy.prime_bits)
    return _has_room(conditions, 0, primes)


def _has_room(conditions: Conditions, wanted: int, primes: Iterator[int], shared: SharedBoundary | None = None) -> bool:
    """Whether points at infinity may make up a number: no curves, nor too few points, are there.

    Both are seen soonest in a bound for the number of points. "No" may be the fault of primes or of too few relations:
    it is asked twice.
    """
    known = [] if shared is None else shared.of(conditions).bounds
    for attempt, is_quick in enumerate((False, True)):
        if attempt == len(known):
            known.append(most_at_infinity(conditions, next(primes), is_quick=is_quick))
        most = known[attempt]
        if most is not None and 2 * most >= wanted:
            return True
    return False


def _is_square(conditions: Conditions) -> bool:
    """Whether the forms alone, or as many forms as the quadrics leave freedoms, cut the motions: then counts add up."""
    return not conditions.quadrics or form_rank(conditions) + len(conditions.quadrics) == conditions.motion.dimension
