"""A pose without a box, followed over the robots within tolerance as far as that is proved."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from typing import Final

from flint import arb

from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.numeric.branch_bounds import branch_bounds
from pkm_exact.numeric.branch_robot import BranchRobot
from pkm_exact.numeric.branch_search import BranchSearch
from pkm_exact.numeric.branch_tree import BranchTree
from pkm_exact.numeric.data_errors import DataErrors, data_errors
from pkm_exact.numeric.linearisation import Linearisation
from pkm_exact.numeric.tolerance_result import FollowedPose

STEPS: Final = 16
"""Fractions that are tried beyond that of the box: each greater by ``RATIO``."""
RATIO: Final = Fraction(6, 5)
TRIES: Final = 3
"""Fractions whose proof is tried, from the greatest that doubles promise."""


def followed_pose(
    near: Linearisation, tolerances: Tolerances, fraction: Fraction, attained: Sequence[Fraction], exponent: int
) -> FollowedPose | None:
    """What is proved beyond a fraction of the tolerances that has a box; None if nothing is.

    Parameters
    ----------
    near : Linearisation
        Around a real pose.
    tolerances : Tolerances
    fraction : Fraction
        Below 1; nothing is tried if it is 0.
    attained : two Fraction
        Errors of position and rotation that some robot has, within any fraction of the tolerances that is tried.
    exponent : int
        Of the grid of nominal centres.
    """
    if not fraction:
        return None
    ladder = [*(step for step in _ladder(fraction) if step < 1), Fraction(1)]

    def errors(step: int) -> DataErrors:
        return data_errors(near.robot, tolerances.scaled(ladder[step]))

    core = arb(2) ** -(exponent // 2)
    search = BranchSearch(near, errors(0), core)

    @cache
    def found(step: int) -> tuple[BranchRobot, BranchTree] | None:
        return search.found(errors(step))

    low, high = -1, len(ladder)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if found(middle) else (low, middle)
    for step in range(low, max(low - TRIES, -1), -1):
        cells = search.proved(found(step))
        bounds = None if cells is None else branch_bounds(near, cells, core, attained)
        if cells is not None and bounds is not None:
            return FollowedPose(ladder[step], len(cells), bounds)
    return None


def _ladder(fraction: Fraction) -> list[Fraction]:
    """Fractions beyond one, to a few digits."""
    found = []
    for _ in range(STEPS):
        fraction = (fraction * RATIO).limit_denominator(10000) or fraction
        found.append(fraction)
    return found
