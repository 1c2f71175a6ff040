"""That a section of the variety of rigid motions consists of finitely many points, those at infinity included.

If the quadrics on the forms and one further form contain all monomials of some degree modulo a prime, a matrix of
integers has full rank there and over Q: the section does not meet the hyperplane of the further form. A projective set
of positive dimension meets every hyperplane. So "yes" is a proof; "no" may be the fault of the prime or the form.
"""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

from pkm_exact.algebra.graded_quotient import hilbert_function
from pkm_exact.completeness.conditions import Conditions
from pkm_exact.completeness.rigid_motions import (
    HORIZON,
    IntegerForm,
    Quadric,
    boundary_quadrics,
    restricted,
    variety_quadrics,
)
from pkm_exact.constraints.form import SIZE
from pkm_exact.digests import digest

FEW = 3
"""Unknowns whose relations the quick way takes."""
TERMS = 5
"""Of the further form at infinity: the fewer, the sparser are all matrices."""
LAST_DEGREE = 6
"""Tried, besides one for each further quadric; on rigid motions 5 suffices whenever the section is finite."""
LAST_AT_INFINITY = 5


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
    quadrics = variety_quadrics(conditions.metric)
    return _cut(conditions, quadrics, (), prime, LAST_DEGREE, FEW if is_quick else None) is not None


def most_at_infinity(conditions: Conditions, prime: int, *, is_quick: bool = False) -> int | None:
    """An upper bound for the number of points at infinity on the conditions; None if it is not proved that any exists.

    Finitely many points do not lie on a further form if it leaves, with the quadrics of the boundary, an algebra of
    finite dimension; and that is at least their number.

    Examples
    --------
    >>> from pkm_exact.motions.motion_groups import SPATIAL
    >>> square = tuple(int(i == 0) for i in range(17))
    >>> most_at_infinity(Conditions((square,), (), (1, 1, 1), SPATIAL), 101) is None
    True
    """
    quadrics = boundary_quadrics(conditions.metric)
    dimensions = _cut(conditions, quadrics, (HORIZON,), prime, LAST_AT_INFINITY, FEW if is_quick else None, TERMS)
    return None if dimensions is None else sum(dimensions)


def _cut(
    conditions: Conditions,
    quadrics: Sequence[Quadric],
    forms: Sequence[IntegerForm],
    prime: int,
    last: int,
    first: int | None,
    terms: int = SIZE,
) -> tuple[int, ...] | None:
    """What quadrics, forms, conditions and a further form leave in each degree; None if it does not end."""
    random = Random(digest(conditions.digest, prime))
    further = [random.randrange(prime) for _ in range(SIZE)]
    for place in random.sample(range(SIZE), SIZE - terms):
        further[place] = 0
    size, equations = restricted([*quadrics, *conditions.quadrics], [*conditions.forms, *forms, further], prime)
    further_degree = len(conditions.quadrics)
    most = conditions.motion.degree << further_degree
    return hilbert_function(size, equations, prime, last + further_degree, most, first)
