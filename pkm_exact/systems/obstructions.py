"""Points of supports that are not lowest together: why a choice of edges is no mixed cell.

Lift each point a of the supports A_1, .., A_n by a number w(a). At a point x, those of A_i are lowest at which x.a +
w(a) is least. An obstruction is integers v(a), with the sum 0 on each A_i, such that the v(a) a sum to 0 and the
v(a) w(a) to less: the points at which v is negative are lowest together at no x. By Farkas' lemma there is one wherever
points are not.

They are looked for in floating point (the nonnegative least squares of Lawson and Hanson 1974, chapter 23) and found,
or not, over the integers.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import gcd
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import fmpz_mat

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]

Point: TypeAlias = tuple[int, ...]
Place: TypeAlias = tuple[int, int]
"""A support, and one of its points, by their numbers."""
Obstruction: TypeAlias = tuple[tuple[Place, int], ...]
Edge: TypeAlias = tuple[int, int, int]
"""A support and two of its points."""

_ROUNDING = 1e-9
_RESIDUAL = 1e-6
_STEPS = 200


def obstruction(
    supports: Sequence[Sequence[Point]], lifting: Sequence[Sequence[int]], edges: Sequence[Edge]
) -> Obstruction | None:
    """Why the points of some edges are not lowest together; None if they are, or no reason is found.

    Examples
    --------
    >>> supports = [[(1, 0), (0, 1), (0, 0)]] * 2
    >>> obstruction(supports, [[0, 0, 5], [0, 0, 3]], [(0, 0, 2), (1, 0, 1)])
    (((0, 0), 1), ((0, 2), -1), ((1, 0), -1), ((1, 2), 1))
    """
    import numpy as np

    rows: list[list[int]] = []
    places: list[tuple[Place, Place]] = []
    for i, first, second in edges:
        others = [k for k in range(len(supports[i])) if k not in (first, second)]
        for k in (second, *others):
            rows.append([*_minus(supports[i][k], supports[i][first]), lifting[i][k] - lifting[i][first]])
            places.append(((i, first), (i, k)))
    free = [number for number, (_, (i, k)) in enumerate(places) if (i, k) in {(e[0], e[2]) for e in edges}]
    table = np.array(rows, dtype=float)
    table[:, -1] /= 1 + max(abs(row[-1]) for row in rows)
    target = np.zeros(table.shape[1])
    target[-1] = -1
    chosen = _cone(np.concatenate([table, -table[free]]).T, target)
    if chosen is None:
        return None
    used = sorted({place if place < len(rows) else free[place - len(rows)] for place in chosen})
    return _integers([rows[place] for place in used], [places[place] for place in used], set(free), used)


def _minus(one: Point, other: Point) -> list[int]:
    return [a - b for a, b in zip(one, other, strict=True)]


def _cone(columns: Array, target: Array) -> list[int] | None:
    """Independent columns whose cone has the target in it, nearly; None if none are found."""
    import numpy as np

    chosen: list[int] = []
    weights: Any = np.zeros(0)
    residual = target
    for _ in range(_STEPS):
        gain = columns.T @ residual
        gain[chosen] = -1
        best = int(gain.argmax())
        if gain[best] <= _ROUNDING:
            return chosen if abs(residual).max() < _RESIDUAL else None
        chosen, weights = [*chosen, best], np.append(weights, 0)
        while chosen:
            wanted = np.linalg.lstsq(columns[:, chosen], target, rcond=None)[0]
            low = wanted <= _ROUNDING
            if not low.any():
                weights = wanted
                break
            step = (weights[low] / np.maximum(weights[low] - wanted[low], _ROUNDING)).min()
            weights = weights + step * (wanted - weights)
            kept = weights > _ROUNDING
            chosen, weights = [place for place, keep in zip(chosen, kept, strict=True) if keep], weights[kept]
        residual = target - columns[:, chosen] @ weights
    return None


def _integers(
    rows: Sequence[Sequence[int]], places: Sequence[tuple[Place, Place]], free: set[int], used: Sequence[int]
) -> Obstruction | None:
    """The obstruction by these differences of points, if their directions have one relation with the right signs."""
    relations, number = fmpz_mat([list(row[:-1]) for row in rows]).transpose().nullspace()
    if number != 1:
        return None
    weights = [int(relations[k, 0]) for k in range(len(rows))]
    total = sum(weight * row[-1] for weight, row in zip(weights, rows, strict=True))
    weights = [-weight for weight in weights] if total > 0 else weights
    if not total or any(weight < 0 and place not in free for weight, place in zip(weights, used, strict=True)):
        return None
    common = gcd(*weights)
    found: dict[Place, int] = {}
    for weight, (first, other) in zip(weights, places, strict=True):
        found[other] = found.get(other, 0) + weight // common
        found[first] = found.get(first, 0) - weight // common
    return tuple((place, value) for place, value in sorted(found.items()) if value)
