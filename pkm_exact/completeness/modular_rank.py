"""A bound for the number of poses, with multiplicity, from ranks modulo a prime, where none is at infinity.

The terms of degree 2 of the closed section's quadrics generate, modulo a prime, an ideal with the quotient A. If A has
finite dimension, so it has over Q, and no greater one: ranks of integer matrices do not grow modulo a prime. Every
polynomial is, modulo the quadrics, a combination of as many as A has dimensions, reduced degree by degree from above.
"""

from __future__ import annotations

from pkm_exact.algebra.graded_quotient import hilbert_function, pairs
from pkm_exact.completeness.closed_section import ClosedSection

LAST_DEGREE = 9


def modular_rank(section: ClosedSection, prime: int, most: int) -> int | None:
    """An upper bound for the number of solutions of a closed section, multiplicities counted; None if above ``most``.

    Examples
    --------
    >>> from pkm_exact.completeness.conditions import Conditions
    >>> from pkm_exact.completeness.closed_section import closed_section
    >>> from pkm_exact.motions.motion_groups import TRANSLATION
    >>> forms = [[1, *[0] * 15, -3], [*[0] * 4, 1, *[0] * 12], [*[0] * 5, 1, *[0] * 11]]
    >>> modular_rank(closed_section(Conditions(tuple(map(tuple, forms)), (), (1, 1, 1), TRANSLATION)), 101, 40)
    2
    """
    if section.is_empty:
        return 0
    size = len(section.unknowns)
    place = {pair: number for number, pair in enumerate(pairs(size))}
    equations = []
    for polynomial in section.system.polynomials:
        row = [0] * len(place)
        for exponents, value in polynomial.to_dict().items():
            factors = [unknown for unknown, exponent in enumerate(exponents) for _ in range(int(exponent))]
            if len(factors) == 2:
                row[place[factors[0], factors[1]]] = int(value) % prime
        equations.append(row)
    dimensions = hilbert_function(size, equations, prime, LAST_DEGREE, most)
    return None if dimensions is None else sum(dimensions)
