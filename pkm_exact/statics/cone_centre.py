"""Points in the inside of second-order cones that satisfy linear equations, in floating point: proposals, no proofs.

Of x in a product of cones x_0 >= |(x_1, ..)| with A x = 0 and the x_0 adding up to 1, that with the greatest product of
x_0^2 - |(x_1, ..)|^2 (of x_0 for cones of one dimension) is found by Newton's method from the axes of the cones, which
need not satisfy the equations. If no point in the inside does, the steps become short, and the last point is near none.

References: Boyd and Vandenberghe, Convex Optimization (2004), sections 9.6 and 10.3; Alizadeh and
Goldfarb, Mathematical Programming 95 (2003), 3-51, section 4.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

_STEPS: Final = 200
_SMALL: Final = 1e-12
_NEARLY: Final = 1e-4
_AWAY: Final = 1e-8
_LEAST: Final = 1e-14

Array = np.ndarray[Any, np.dtype[np.float64]]


def cone_centre(sizes: Sequence[int], equations: Array) -> Array:
    """A point in the inside of all cones that satisfies the equations, or comes as near as Newton's method did.

    Parameters
    ----------
    sizes : sequence of int
        Dimensions of the cones.
    equations : array of shape (.., sum of sizes)

    Examples
    --------
    >>> print(cone_centre([1, 1], np.array([[1.0, -2.0]])).round(6))
    [0.666667 0.333333]
    """
    starts = np.cumsum([0, *sizes])[:-1]
    axes = np.zeros(sum(sizes))
    axes[starts] = 1.0
    matrix = np.vstack([equations, axes])
    matrix = matrix / np.maximum(np.linalg.norm(matrix, axis=1), 1e-300)[:, None]
    wanted = np.zeros(len(matrix))
    wanted[-1] = 1 / np.linalg.norm(axes)
    point = axes / axes.sum()
    for _ in range(_STEPS):
        slope, scale = _barrier(point, starts, sizes)
        away = wanted - matrix @ point
        # In coordinates in which the second derivatives are the unit matrix.
        across, right = np.linalg.qr(scale @ matrix.T)
        down = -scale @ slope
        down = down - across @ (across.T @ down)
        step = scale @ (down + across @ np.linalg.lstsq(right.T, away, rcond=None)[0])
        size, decrement = _longest(point, step, starts, sizes), float(np.linalg.norm(down))
        if np.abs(away).max() < _AWAY:
            if decrement < _NEARLY:
                break
            # Where the equations hold, such steps decrease a self-concordant function.
            size = min(size, 1 / (1 + decrement))
        if not size > _SMALL:
            break
        point = point + size * step
    return np.asarray(point)


def _barrier(point: Array, starts: Array, sizes: Sequence[int]) -> tuple[Array, Array]:
    """Gradient of -sum log(x_0^2 - |(x_1, ..)|^2), and the inverse square root of its second derivatives.

    With d = x_0^2 - |(x_1, ..)|^2, y the square root of x in the algebra of the cone and R = diag(1, -1, ..) this is
    (2 y y^T - d^(1/2) R) / 2^(1/2).
    """
    slope, scale = np.zeros(len(point)), np.zeros((len(point), len(point)))
    for start, size in zip(starts, sizes, strict=True):
        part = slice(start, start + size)
        x = point[part]
        if size == 1:
            slope[part], scale[part, part] = -1 / x, x
            continue
        sides = np.concatenate([[1.0], -np.ones(size - 1)])
        room = _room(x) * (x[0] + np.linalg.norm(x[1:]))
        first = np.sqrt((x[0] + np.sqrt(room)) / 2)
        root = np.concatenate([[first], x[1:] / (2 * first)])
        slope[part] = -2 * sides * x / room
        scale[part, part] = (2 * np.outer(root, root) - np.sqrt(room) * np.diag(sides)) / np.sqrt(2)
    return slope, scale


def _longest(point: Array, change: Array, starts: Array, sizes: Sequence[int]) -> float:
    """1, or nine tenths of the way to the nearest boundary of a cone."""
    size = 1.0
    while size > _SMALL:
        if all(
            _room((point + size / 0.9 * change)[start : start + k]) > _LEAST
            for start, k in zip(starts, sizes, strict=True)
        ):
            return size
        size *= 0.7
    return 0.0


def _room(x: Array) -> float:
    return float(x[0] - np.linalg.norm(x[1:]))
