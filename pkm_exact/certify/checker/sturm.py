"""The number of real roots of an integer polynomial, by Sturm's chain in ball arithmetic; not always found.

The chain begins with h and h', h of degree D; each further polynomial is minus the remainder of the one before the last
by the last. If h is squarefree and the degrees of the chain are D, D - 1, .., 0, then h has as many real roots as pairs
of neighbours whose leading coefficients have the same sign, less pairs with unlike signs: the changes of sign at minus
infinity less those at infinity (Sturm 1835). The changes of the values at 0, less those at infinity, are the positive
roots, if no value is 0. Degrees and signs are proved by balls without 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Final

from flint import arb, arb_poly, ctx, fmpz_poly

from pkm_exact.certify.checker.budget import ball_cost, charge, limbs
from pkm_exact.certify.checker.descartes import in_powers

MOST: Final = 100
"""Polynomials of a higher degree are not tried: precision and number of operations grow with the degree."""
FIRST_BITS: Final = 64
BITS_PER_DEGREE: Final = 12
"""The precision of the first attempt; remainders lose less than that where no roots are very close to each other."""
FINER: Final = 4
"""How many times finer the second attempt is, the last one."""


def sturm_count(h: fmpz_poly) -> int | None:
    """The number of real roots of a squarefree polynomial of positive degree, or None.

    One in T^m, m > 1, does not have the root 0: its roots are the m-th roots of those of one of smaller degree.
    """
    m, powers = in_powers(h)
    size = int(powers.degree())
    if size > MOST:
        return None
    chain = _chain(powers, FIRST_BITS + BITS_PER_DEGREE * size)
    chain = chain or _chain(powers, FINER * (FIRST_BITS + BITS_PER_DEGREE * size))
    if chain is None:
        return None
    at_infinity = _changes([polynomial[size - place] for place, polynomial in enumerate(chain)])
    if m % 2:
        return size - 2 * at_infinity
    values = [polynomial[0] for polynomial in chain]
    return None if any(value.contains(0) for value in values) else 2 * (_changes(values) - at_infinity)


def _chain(h: fmpz_poly, bits: int) -> list[arb_poly] | None:
    """Enclosures of the chain, of degrees D, D - 1, .., 0; None if they are not proved to be its degrees."""
    size = int(h.degree())
    charge(20000 + 2 * size * (100 + 3 * limbs(int(h.height_bits()))))
    with ctx.workprec(bits):
        chain = [arb_poly(h), arb_poly(h.derivative())]
        for degree in range(size - 2, -1, -1):
            charge(10000 + 3 * (degree + 2) * ball_cost(limbs(bits)))
            rest = -(chain[-2] % chain[-1])
            if rest[degree].contains(0):
                return None
            chain.append(rest)
    return chain


def _changes(values: Sequence[arb]) -> int:
    """The changes of sign of values that are not 0."""
    return sum(bool(one > 0) != bool(other > 0) for one, other in pairwise(values))
