"""Charts w.e = 1 of Study coordinates, in ball arithmetic: the last of the n equations in n unknowns."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from flint import arb

from pkm_exact.balls import Balls
from pkm_exact.motions.motion import Motion


def chart_row(weights: Sequence[Any], motion: Motion) -> list[Any]:
    """The derivative of w.e by the coordinates of a group of motions.

    Parameters
    ----------
    weights : sequence
        w, on those of the coordinates (e0, .., e3) that are not 0 for every motion.
    motion : Motion

    Examples
    --------
    >>> from pkm_exact.motions.motion_groups import PLANAR
    >>> chart_row([3, -1], PLANAR)
    [3, -1, 0, 0]
    """
    return [*weights, *[0] * (len(motion.support) - len(weights))]


def chart_values(jacobian: Balls, point: Balls) -> Balls:
    """F(x) from F'(x): q(x) = q'(x) x / 2 for the quadrics, and w.e - 1."""
    *doubled, last = (jacobian * point).entries()
    return type(point)(len(doubled) + 1, 1, [*(value / 2 for value in doubled), last - 1])


def in_chart(point: Balls, weights: Sequence[Any]) -> Balls:
    """The same projective point with w.e = 1."""
    product = sum((w * point[k, 0] for k, w in enumerate(weights)), arb(0))
    return type(point)(point.nrows(), 1, [value / product for value in point.entries()])
