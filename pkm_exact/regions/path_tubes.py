"""Tubes about paths: all positions at most a radius from a path of straight pieces.

A position is in the tube of a piece from A to A + v if it is in the ball about an end, or its foot on the line of the
piece lies between the ends and is near: with w = C - A,

    0 <= w.v <= |v|^2,   (r^2 - |w|^2) |v|^2 + (w.v)^2 >= 0

A tube is connected, as its path is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import isqrt

from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.limits import Pair
from pkm_exact.regions.chart import PosePolynomials, rational
from pkm_exact.regions.formula import All, Atom, Formula, Some
from pkm_exact.regions.region_legs import product
from pkm_exact.regions.region_shapes import in_model, side

_NAME = "in the tube"


@dataclass(frozen=True)
class Tube:
    """All positions at most a radius from a path.

    Attributes
    ----------
    corners : tuple of vectors of 3 Fraction
        Of the path, in coordinates of the model.
    radius : Fraction
        In ordinary units.
    """

    corners: tuple[Vector, ...]
    radius: Fraction


def tube_about(
    corners: Sequence[Sequence[Fraction]], radius: Fraction, metric: Metric
) -> tuple[Tube, list[Pair], bool]:
    """A tube about a path in ordinary coordinates, the sides of its box, and whether it is a little wider than asked.

    Examples
    --------
    >>> ends = [(Fraction(0), Fraction(0)), (Fraction(3), Fraction(0))]
    >>> tube, sides, is_wider = tube_about(ends, Fraction(1), (1, 1, 1))
    >>> [str(x) for pair in sides for x in pair], is_wider
    (['-1', '4', '-1', '1'], False)
    """
    count = len(corners[0])
    is_wider = any(x and isqrt(g) ** 2 != g for corner in corners for x, g in zip(corner, metric, strict=False))
    size = max(abs(x) for corner in corners for x in corner) + radius
    wide = radius + size / 2**50 if is_wider else radius
    placed = []
    for corner in corners:
        x, y, z = [in_model(c, g, 1) for c, g in zip(corner, metric, strict=False)] + [Fraction(0)] * (3 - count)
        placed.append((x, y, z))
    sides = []
    for k, g in enumerate(metric[:count]):
        along = [corner[k] for corner in corners]
        sides.append(side((min(along) - wide, max(along) + wide), g))
    return Tube(tuple(placed), wide), sides, is_wider


def inside_tube(tube: Tube, pose: PosePolynomials, metric: Metric) -> Formula:
    """That a position is in a tube."""
    n, square = pose.norm, rational(tube.radius**2)
    offsets = [[c - n * rational(a) for c, a in zip(pose.position, corner, strict=True)] for corner in tube.corners]
    near = [square * n * n - product(metric, w, w) for w in offsets]
    parts: list[Formula] = [Atom(_NAME, ball) for ball in near]
    for (one, other), w, ball in zip(pairwise(tube.corners), offsets, near, strict=False):
        way = [b - a for a, b in zip(one, other, strict=True)]
        length = rational(product(metric, way, way))
        along = product(metric, [rational(x) for x in way], w)
        parts.append(
            All((Atom(_NAME, along), Atom(_NAME, length * n - along), Atom(_NAME, ball * length + along * along)))
        )
    return Some(tuple(parts))
