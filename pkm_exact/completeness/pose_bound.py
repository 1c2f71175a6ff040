"""How many isolated poses a robot can have, from the degrees of varieties on which its constraints have low degree.

On rigid motions every constraint but the cylinder is linear: degree 40. On (h : R : C), a cone of degree 8, conditions
on C and R are linear, those with |C|^2 or u quadrics; on (h : R : u) it is those with |C|^2 or C. Without |C|^2 the
degree is 20. The other groups of motions have such numbers too. Proofs: ``docs/completeness.md``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from pkm_exact.completeness.closed_section import ORDER, motion_forms, ordered, rank_of
from pkm_exact.completeness.conditions import Conditions

_LOWER_DEGREES: Final[Mapping[str, tuple[int, int]]] = MappingProxyType(
    {"spatial": (8, 20), "planar": (2, 4), "schoenflies": (2, 4), "translation": (1, 1), "spherical": (8, 8)}
)
"""Degrees of the motions on (h : R : C), and on all coordinates but |C|^2."""
_SQUARE, _TURNED, _POSITION = (0,), (1, 2, 3), (4, 5, 6)


@dataclass(frozen=True)
class PoseBound:
    """The most isolated poses, real or complex, that constraints can leave.

    Attributes
    ----------
    degree : int
        By the degree of the motions, doubled for every quadric.
    least : int
        The least of all bounds known.
    """

    degree: int
    least: int


def pose_bound(conditions: Conditions) -> PoseBound:
    """The bounds for a robot.

    Examples
    --------
    >>> from pkm_exact.motions.motion_groups import SPATIAL
    >>> plane = (*[0] * 4, 1, 2, 3, *[1] * 10)
    >>> pose_bound(Conditions((plane,) * 6, (), (1, 1, 1), SPATIAL))
    PoseBound(degree=40, least=8)
    """
    cone, flat = _LOWER_DEGREES[conditions.motion.name]
    quadrics = len(conditions.quadrics)
    degree = conditions.motion.degree << quadrics
    found = [degree, cone << (quadrics + _rank_on(conditions, _SQUARE + _TURNED))]
    if not quadrics:
        found.append(cone << _rank_on(conditions, _SQUARE + _POSITION))
    if not any(form[0] for form in conditions.forms):
        found.append(flat << quadrics)
    return PoseBound(degree, min(found))


def form_rank(conditions: Conditions) -> int:
    """Rank of the linear forms on the motions: modulo the forms that vanish on all of them."""
    known = motion_forms(conditions.motion, conditions.metric)
    return rank_of([*map(ordered, conditions.forms), *known]) - len(known)


def _rank_on(conditions: Conditions, coordinates: Sequence[int]) -> int:
    """How many of the forms, chosen well, involve the coordinates, beyond those that vanish on the motions."""
    columns = [ORDER.index(coordinate) for coordinate in coordinates]
    known = [[row[column] for column in columns] for row in motion_forms(conditions.motion, conditions.metric)]
    rows = [[row[column] for column in columns] for row in map(ordered, conditions.forms)]
    return rank_of([*rows, *known]) - rank_of(known)
