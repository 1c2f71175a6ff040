"""What is certified of the Jacobian at a pose: data only."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.roots.interval import Interval


@dataclass(frozen=True)
class LegJacobian:
    """What is certified of the Jacobian at a pose.

    Attributes
    ----------
    det_sign : int or None
        Sign of the determinant, 0 if the rank is not full: assembly modes of different sign are separated by
        singularities. None of a regular pose if there are more equations than freedoms: then there is no determinant.
    rank : int
        Exact rank; less than the number of freedoms at a singular pose.
    sigma_min : Interval
        Smallest singular value, exactly 0 at a singular pose.
    condition : Interval or None
        Largest singular value by the smallest; None at a singular pose.
    length : Fraction
        The scaling length L, in the robot's unit.
    """

    det_sign: int | None
    rank: int
    sigma_min: Interval
    condition: Interval | None
    length: Fraction
