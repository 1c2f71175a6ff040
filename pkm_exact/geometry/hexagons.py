"""Semi-regular hexagons and equilateral triangles by their side lengths, exact in the metric (1, 3, 1).

A semi-regular hexagon has equal angles and two side lengths p, q in turn: an equilateral triangle of side p + 2q with
its corners cut off at the distance q (or one of side q + 2p, cut at p). Cutting off nothing (q = 0 or p = 0) gives a
triangle whose joints are merged in pairs. In ordinary coordinates sqrt(3) appears in every y; in coordinates y' with
y = sqrt(3) y' all corners are rational.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.kinds import Joints
from pkm_exact.geometry.rational import parse_rational
from pkm_exact.wording import shown

HEXAGON_METRIC: Final[Metric] = (1, 3, 1)
"""The metric in which these hexagons have rational coordinates."""


def semi_regular_hexagon(first_side: object, second_side: object, height: object = 0) -> Joints:
    """Six joints at the corners of a semi-regular hexagon, coordinates with respect to the metric (1, 3, 1).

    The centre is (0, 0, height). Joints are numbered counterclockwise; joints 1 and 2 stand at the bottom, on a
    parallel to the x-axis. One of the sides may be 0: joints then coincide in pairs (see ``triangle``).

    Parameters
    ----------
    first_side : str, int, Decimal or Fraction
        Length of the sides 1-2, 3-4 and 5-6.
    second_side : str, int, Decimal or Fraction
        Length of the sides 2-3, 4-5 and 6-1.
    height : str, int, Decimal or Fraction
        The z-coordinate of all joints.

    Raises
    ------
    InputError
        If a side is negative or not an exact number, or both sides are 0.

    Examples
    --------
    >>> [tuple(map(str, joint)) for joint in semi_regular_hexagon(4, 1)][:3]
    [('-2', '-1', '0'), ('2', '-1', '0'), ('5/2', '-1/2', '0')]
    """
    p, q = _side(first_side, "sides[1]"), _side(second_side, "sides[2]")
    z = parse_rational(height, "height")
    if p == q == 0:
        raise InputError("sides: both are 0; give at least one that is positive")
    bottom, middle, top = -(p + 2 * q) / 6, (q - p) / 6, (2 * p + q) / 6
    return (
        (-p / 2, bottom, z),
        (p / 2, bottom, z),
        ((p + q) / 2, middle, z),
        (q / 2, top, z),
        (-q / 2, top, z),
        (-(p + q) / 2, middle, z),
    )


def _side(value: object, where: str) -> Fraction:
    length = parse_rational(value, where)
    if length < 0:
        raise InputError(f"{where}: {shown(value)} is negative; give a length")
    return length
