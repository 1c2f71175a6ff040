"""Components of a twist that determine the others where constraints are not actuated.

Constraints leave the twists t with C t = 0, a space of d dimensions. Of the components of t, d are chosen so that the
others follow from them, t = E s. Power is f.t = (E^T f).s, so every wrench differs by one that the constraints bear
from exactly one wrench whose other components are 0: its components at the chosen places are E^T f. In these
components twists and wrenches of such a machine are as those of a machine of d freedoms.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any, Final

import numpy as np
from flint import arb, arb_mat

from pkm_exact.errors import InputError
from pkm_exact.polytopes.rationals import as_fraction, rational_matrix

_NEARLY: Final = 1e-9


@dataclass(frozen=True)
class FreeComponents:
    """Which components were chosen, and how all follow from them.

    Attributes
    ----------
    places : tuple of int
        Among the components of the twists of the motion.
    expansion : tuple of rows, one for every component of a twist
        E: exact in rational coordinates, or balls in ordinary ones.
    """

    places: tuple[int, ...]
    expansion: tuple[tuple[Any, ...], ...]


def free_components(basis: Sequence[Sequence[Any]], scales: Sequence[float]) -> FreeComponents:
    """The components with the largest minor of a basis of the allowed twists, and E.

    Parameters
    ----------
    basis : sequence of d twists
        Fractions or balls.
    scales : sequence of float
        By what components are multiplied to be compared: any choice is right, this one keeps E small.

    Examples
    --------
    >>> from fractions import Fraction as F
    >>> found = free_components([[F(1), F(0), F(4)]], [1.0, 1.0, 1.0])
    >>> found.places, [str(row[0]) for row in found.expansion]
    ((2,), ['1/4', '0', '1'])
    """
    middle = np.array([[_double(x) * s for x, s in zip(row, scales, strict=True)] for row in basis])
    best, places = 0.0, tuple(range(len(basis)))
    for chosen in combinations(range(middle.shape[1]), len(basis)):
        size = abs(float(np.linalg.det(middle[:, chosen])))
        if size > best * (1 + _NEARLY):
            best, places = size, chosen
    return FreeComponents(places, _expansion(basis, places))


def _double(value: Any) -> float:
    return float(value.mid()) if isinstance(value, arb) else float(value)


def _expansion(basis: Sequence[Sequence[Any]], places: tuple[int, ...]) -> tuple[tuple[Any, ...], ...]:
    """E^T = N_s^-1 N with the twists of the basis as the rows of N."""
    minor = [[row[j] for j in places] for row in basis]
    if not isinstance(basis[0][0], arb):
        exact = (rational_matrix(minor).inv() * rational_matrix(basis)).table()
        return tuple(zip(*([as_fraction(x) for x in row] for row in exact), strict=True))
    try:
        found = arb_mat(minor).inv() * arb_mat([list(row) for row in basis])
    except ZeroDivisionError:
        raise InputError("statics: the pose is not enclosed narrowly enough for a basis of twists") from None
    rows = [[found[i, j] for i in range(found.nrows())] for j in range(found.ncols())]
    for k, place in enumerate(places):
        rows[place] = [arb(int(i == k)) for i in range(len(places))]
    return tuple(map(tuple, rows))
