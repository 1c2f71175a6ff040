"""That a section of the variety of rigid motions consists of finitely many points, those at infinity included.

If the quadrics on the forms and one further form contain all monomials of some degree modulo a prime, a matrix of
integers has full rank there and over Q: the section does not meet the hyperplane of the further form. A projective set
of positive dimension meets every hyperplane. So "yes" is a proof; "no" may be the fault of the prime or the form.
"""

from __future__ import annotations

from random import Random

from pkm_exact.algebra.graded_quotient import hilbert_function
from pkm_exact.completeness.conditions import Conditions
from pkm_exact.completeness.rigid_motions import restricted, variety_quadrics
from pkm_exact.constraints.form import SIZE
from pkm_exact.digests import digest

FEW = 3
"""Unknowns whose relations the quick way takes."""
LAST_DEGREE = 6
"""Tried, besides one for each further quadric; on rigid motions 5 suffices whenever the section is finite."""


def is_finite(conditions: Conditions, prime: int, *, is_quick: bool = False) -> bool:
    """Whether it is proved that all rigid motions on the conditions, finite or at infinity, are finitely many points.

    The quick way takes few relations, which nearly always suffice.

    Examples
    --------
    >>> from pkm_exact.motions.motion_groups import SPATIAL
    >>> at_infinity = tuple(tuple(int(i == j) for i in range(17)) for j in (0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 16))
    >>> is_finite(Conditions(at_infinity, (), (1, 1, 1), SPATIAL), 101)
    False
    >>> is_finite(Conditions((*at_infinity, (*[0] * 10, 1, 2, *[0] * 5)), (), (1, 1, 1), SPATIAL), 101)
    True
    """
    random = Random(digest(conditions.digest, prime))
    further = [random.randrange(prime) for _ in range(SIZE)]
    quadrics = [*variety_quadrics(conditions.metric), *conditions.quadrics]
    size, equations = restricted(quadrics, [*conditions.forms, further], prime)
    further_degree = len(conditions.quadrics)
    most = conditions.motion.degree << further_degree
    limit = LAST_DEGREE + further_degree
    return hilbert_function(size, equations, prime, limit, most, FEW if is_quick else None) is not None
