"""A pose without a box, followed over the robots within tolerance as far as that is proved."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import islice
from typing import Final, TypeAlias

from flint import arb

from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.numeric.branch_bounds import branch_bounds
from pkm_exact.numeric.branch_robot import BranchRobot
from pkm_exact.numeric.branch_search import BranchSearch
from pkm_exact.numeric.branch_tree import BranchTree
from pkm_exact.numeric.data_errors import data_errors
from pkm_exact.numeric.linearisation import Linearisation
from pkm_exact.numeric.tolerance_result import FollowedPose

Found: TypeAlias = tuple[BranchRobot, BranchTree]

STEPS: Final = 36
"""Tolerances that are tried beyond that of the box: they are on a grid of the robot's, eight to a factor of 2."""
EIGHTHS: Final = (1000, 1091, 1189, 1297, 1414, 1542, 1682, 1834)
"""1000 times the powers of 2^(1/8)."""
TRIES: Final = 3
"""Tolerances whose proof is tried, from the greatest that doubles promise."""


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
    core = arb(2) ** -(exponent // 2)
    greatest = max(tolerances.base, tolerances.platform, tolerances.lengths)
    found: list[tuple[Fraction, BranchSearch, Found]] = []

    def is_found(part: Fraction) -> bool:
        errors = data_errors(near.robot, tolerances.scaled(part))
        search = BranchSearch(near, errors, core)
        tree = search.found(errors)
        if tree is not None:
            found.append((part, search, tree))
        return tree is not None

    for part in grid_beyond(fraction, near.robot.frames.unit / greatest):
        if not is_found(part):
            break
        if part > 1:
            is_found(Fraction(1))
        if part >= 1:
            break
    for part, search, tree in found[: -TRIES - 1 : -1]:
        cells = search.proved(tree)
        bounds = None if cells is None else branch_bounds(near, cells, core, attained)
        if cells is not None and bounds is not None:
            return FollowedPose(min(part, Fraction(1)), len(cells), bounds)
    return None


def grid_beyond(fraction: Fraction, unit: Fraction) -> list[Fraction]:
    """The points of the grid beyond a fraction: ``unit`` times powers of 2 and their ``EIGHTHS``.

    As the grid is the same for all tolerances of the same ratios, and each of its points is tried before greater ones,
    what is found for some tolerances is found for less.

    Examples
    --------
    >>> [float(part) for part in grid_beyond(Fraction(1, 2), Fraction(1))[:3]]
    [0.5455, 0.5945, 0.6485]
    """
    exponent = (fraction / unit).numerator.bit_length() - (fraction / unit).denominator.bit_length() - 1
    points = (
        unit * Fraction(2) ** (exponent + octave) * Fraction(eighth, 1000)
        for octave in range(STEPS)
        for eighth in EIGHTHS
    )
    return list(islice((point for point in points if point > fraction), STEPS))
