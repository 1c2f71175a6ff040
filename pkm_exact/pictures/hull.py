"""The body that joints span: a polygon if they are nearly coplanar, otherwise the faces of their convex hull."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations
from math import atan2
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.pictures.drawn_robot import Point

THIN: Final = 0.08
"""A body this much thinner than wide is drawn as a polygon."""
NEARLY: Final = 1e-9
"""Relative distance up to which a point lies in a face."""

Indices = tuple[int, ...]


def faces(points: Sequence[Point]) -> tuple[Indices, ...]:
    """The faces of the body, each as indices of points in cyclic order; merged joints count once.

    A face of two points is an edge: the joints lie on a line. No face: they lie in one point. The polygon of coplanar
    joints goes through all of them, in the order of their directions from the middle.

    Examples
    --------
    >>> faces([(0.0, 0.0, 0.0), (1.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 0.0)])
    ((0, 2, 1, 3),)
    >>> len(faces([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]))
    4
    """
    different = [i for i, point in enumerate(points) if point not in points[:i]]
    if len(different) < 2:
        return ()
    x = np.array([points[i] for i in different])
    x = x - x.mean(axis=0)
    x /= abs(x).max()
    _, widths, axes = np.linalg.svd(x)
    if widths[1] <= NEARLY * widths[0]:
        along = x @ axes[0]
        return ((different[int(along.argmin())], different[int(along.argmax())]),)
    if len(different) == 3 or widths[2] <= THIN * widths[0]:
        return (tuple(different[i] for i in _around(x, range(len(different)), axes[0], axes[1])),)
    return tuple(tuple(different[i] for i in face) for face in _hull(x))


def _around(
    x: NDArray[np.float64], indices: Iterable[int], first: NDArray[np.float64], second: NDArray[np.float64]
) -> Indices:
    """The points ordered by their direction from their middle in a plane, from the smallest index on."""
    order = list(indices)
    middle = x[order].mean(axis=0)
    order.sort(key=lambda i: atan2(float((x[i] - middle) @ second), float((x[i] - middle) @ first)))
    start = order.index(min(order))
    order = order[start:] + order[:start]
    return tuple(order if order[1] < order[-1] else [order[0], *reversed(order[1:])])


def _hull(x: NDArray[np.float64]) -> list[Indices]:
    """Faces of the convex hull of a few points: every plane through three of them that has all on one side."""
    found: dict[Indices, Indices] = {}
    for i, j, k in combinations(range(len(x)), 3):
        normal = np.cross(x[j] - x[i], x[k] - x[i])
        size = np.linalg.norm(normal)
        if size <= NEARLY:
            continue
        heights = (x - x[i]) @ (normal / size)
        if (heights <= NEARLY).all() or (heights >= -NEARLY).all():
            inside = tuple(int(m) for m in np.flatnonzero(abs(heights) <= NEARLY))
            first = (x[j] - x[i]) / np.linalg.norm(x[j] - x[i])
            found.setdefault(inside, _around(x, inside, first, np.cross(normal / size, first)))
    return [found[inside] for inside in sorted(found)]
