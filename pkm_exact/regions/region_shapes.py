"""Shapes of regions: the box that holds them, and polynomials that are not negative inside.

Numbers are ordinary ones. Where they are not rational in the metric of the model, the shape is a little larger than
asked, by less than 2^-40 of its size: what is proved of it is proved of the one that was asked for.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Final

from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.limits import Pair
from pkm_exact.regions.chart import Polynomial, PosePolynomials
from pkm_exact.regions.formula import Atom

_BITS: Final = 64


@dataclass(frozen=True)
class Quadratic:
    """A condition on the position: constant + linear.p - sum of weights p^2 is not negative.

    Attributes
    ----------
    constant : Fraction
    linear, weights : tuple of 3 Fraction
        In coordinates of the model.
    """

    constant: Fraction
    linear: tuple[Fraction, Fraction, Fraction]
    weights: tuple[Fraction, Fraction, Fraction]


def in_model(value: Fraction, g: int, way: int) -> Fraction:
    """An ordinary coordinate divided by sqrt(g): exactly, or a rational just below (way -1) or above (way 1).

    Examples
    --------
    >>> in_model(Fraction(3), 4, 1), float(in_model(Fraction(1), 3, 1)) - 3**-0.5 < 1e-15
    (Fraction(3, 2), True)
    """
    root = isqrt(g)
    if root * root == g or value == 0:
        return value / root
    scale = 1 << (_BITS + g.bit_length())
    low = Fraction(isqrt(g * scale * scale), scale)
    rounded_down = (way < 0) == (value > 0)
    return value / (low + Fraction(1, scale)) if rounded_down else value / low


def side(pair: Pair, g: int) -> Pair:
    """An interval of ordinary coordinates in those of the model, outward."""
    return in_model(pair[0], g, -1), in_model(pair[1], g, 1)


def round_shape(center: tuple[Fraction, ...], radius: Fraction, metric: Metric) -> tuple[Quadratic, tuple[Pair, ...]]:
    """A ball, or with two coordinates a disc or an upright cylinder, and the sides of its box.

    Examples
    --------
    >>> shape, sides = round_shape((Fraction(1), Fraction(0), Fraction(0)), Fraction(2), (1, 1, 1))
    >>> str(shape.constant), str(shape.linear[0]), [str(end) for end in sides[0]]
    ('3', '2', ['-1', '3'])
    """
    used = metric[: len(center)]
    middle = [in_model(c, g, 1) for c, g in zip(center, used, strict=True)]
    exact = all(c == 0 or isqrt(g) ** 2 == g for c, g in zip(center, used, strict=True))
    size = max(map(abs, center)) + radius
    wide = radius if exact else radius + size / 2**50
    weights = [Fraction(g) for g in used] + [Fraction(0)] * (3 - len(used))
    places = [*middle, *[Fraction(0)] * (3 - len(used))]
    constant = wide * wide - sum((w * m * m for w, m in zip(weights, places, strict=True)), Fraction(0))
    x, y, z = (2 * w * m for w, m in zip(weights, places, strict=True))
    sides = tuple((m - in_model(wide, g, 1), m + in_model(wide, g, 1)) for m, g in zip(middle, used, strict=True))
    return Quadratic(constant, (x, y, z), (weights[0], weights[1], weights[2])), sides


def polygon_shape(corners: tuple[Pair, ...], metric: Metric) -> tuple[tuple[Quadratic, ...], tuple[Pair, ...]]:
    """A convex polygon, corners counterclockwise, and the sides of its box.

    Its edges are moved outward by a little where the corners are not rational in the model.

    Examples
    --------
    >>> square = tuple((Fraction(x), Fraction(y)) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
    >>> edges, sides = polygon_shape(square, (1, 1, 1))
    >>> len(edges), [str(x) for x in edges[0].linear]
    (4, ['0', '1', '0'])
    """
    size = max(abs(x) for corner in corners for x in corner) or Fraction(1)
    exact = all(isqrt(g) ** 2 == g for g in metric[:2])
    room = Fraction(0) if exact else size / 2**50
    points = [tuple(in_model(x, g, 1) for x, g in zip(corner, metric, strict=False)) for corner in corners]
    edges = []
    for (x1, y1), (x2, y2) in zip(points, [*points[1:], points[0]], strict=True):
        a, b = y1 - y2, x2 - x1
        more = room * (abs(a) + abs(b)) * 2
        edges.append(Quadratic(-(a * x1 + b * y1) + more, (a, b, Fraction(0)), (Fraction(0), Fraction(0), Fraction(0))))
    more = room * 2
    sides = tuple((min(p[k] for p in points) - more, max(p[k] for p in points) + more) for k in range(2))
    return tuple(edges), sides


def ball_of(shape: Sequence[Quadratic], metric: Metric) -> tuple[tuple[Fraction, ...], Fraction] | None:
    """Centre, in coordinates of the model, and squared radius if the shape is a ball; None if it is another.

    Examples
    --------
    >>> ball, _ = round_shape((Fraction(1), Fraction(0), Fraction(2)), Fraction(3), (1, 1, 1))
    >>> center, square = ball_of([ball], (1, 1, 1)) or ((), 0)
    >>> [str(x) for x in center], str(square)
    (['1', '0', '2'], '9')
    """
    if len(shape) != 1 or shape[0].weights != tuple(map(Fraction, metric)):
        return None
    center = tuple(slope / (2 * g) for slope, g in zip(shape[0].linear, metric, strict=True))
    return center, shape[0].constant + sum((g * c * c for g, c in zip(metric, center, strict=True)), Fraction(0))


def inside_atom(quadratic: Quadratic, pose: PosePolynomials) -> Atom:
    """That a position is inside: N^2 times the quadratic is not negative."""
    total: Polynomial = pose.constant(quadratic.constant) * pose.norm * pose.norm
    for c, slope, weight in zip(pose.position, quadratic.linear, quadratic.weights, strict=True):
        total += pose.constant(slope) * c * pose.norm - pose.constant(weight) * c * c
    return Atom("in the region", total)
