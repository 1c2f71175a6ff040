"""The words for what is proved of a system's solutions. Claims are those of robots (``claim.Claim``)."""

from __future__ import annotations

from enum import StrEnum
from typing import Final

from pkm_exact.claim import Claim


class SystemRoute(StrEnum):
    """The argument that proves a list of solutions complete, or that there is none (``docs/certificates-systems.md``).

    ``REFINED_BEZOUT``: as many isolated solutions are listed as the product of the degrees admits.

    ``MULTIHOMOGENEOUS_BEZOUT``: as many as the degrees in groups of variables admit.

    ``MIXED_VOLUME``: as many as the terms that occur admit.

    ``MODULAR_RANK``: ranks of integer matrices modulo a prime, no greater than over Q, leave room for no other.

    ``COUNTING_AT_INFINITY``: finite solutions and points at infinity, with multiplicity, are the product of the
    degrees.

    ``EXACT_ELIMINATION``: the same as ``MODULAR_RANK`` with further polynomials that follow over Q; or their quotient
    algebra tells the number of solutions and their multiplicities.
    """

    REFINED_BEZOUT = "refined-bezout"
    MULTIHOMOGENEOUS_BEZOUT = "multihomogeneous-bezout"
    MIXED_VOLUME = "mixed-volume"
    MODULAR_RANK = "modular-rank"
    COUNTING_AT_INFINITY = "counting-at-infinity"
    EXACT_ELIMINATION = "exact-elimination"


_MEANINGS: Final = {
    Claim.COMPLETE: "complete: it is proved that there is no other",
    Claim.NOT_PROVEN_COMPLETE: "not proven complete: each solution is certified, but others are not excluded",
    Claim.POSITIVE_DIMENSIONAL_DETECTED: "infinitely many solutions detected, not proved",
    Claim.POSITIVE_DIMENSIONAL_PROVED: (
        "infinitely many complex solutions, proved; real ones are neither proved nor excluded"
    ),
    Claim.INCONSISTENT: "inconsistent: there is no solution, not even a complex one",
}
DETECTED_NOTE: Final = (
    "the solutions are infinitely many at two primes, which is evidence and no proof: there may be a curve of "
    "solutions, real or complex, or solutions run together at infinity"
)
MISSING_NOTE: Final = (
    "the oracle's list is not all: the system has more solutions, modulo a prime or provably; solve without the oracle"
)
BEYOND_CHECKERS_NOTE: Final = (
    "that there is no other solution could be seen from the quotient algebra only, which takes more work than checkers "
    "allow; it is not claimed"
)
NO_SOLUTION_NOTE: Final = (
    "there is no solution, real or complex, modulo two primes; that there is none over Q is not proved"
)


def meaning_of(claim: Claim) -> str:
    """The sentence for a claim.

    Examples
    --------
    >>> meaning_of(Claim.INCONSISTENT)
    'inconsistent: there is no solution, not even a complex one'
    """
    return _MEANINGS[claim]
