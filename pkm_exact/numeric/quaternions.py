"""Quaternions, scalar first: four numbers, or four arrays for many at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray


def quaternion_product(p: Sequence[Any], q: Sequence[Any]) -> list[Any]:
    """The product of two quaternions over any ring.

    Examples
    --------
    >>> quaternion_product((0, 1, 0, 0), (0, 0, 1, 0))
    [0, 0, 0, 1]
    """
    return [
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] + p[2] * q[0] + p[3] * q[1] - p[1] * q[3],
        p[0] * q[3] + p[3] * q[0] + p[1] * q[2] - p[2] * q[1],
    ]


def rotation_matrix(quaternion: Sequence[Any]) -> NDArray[np.float64]:
    """The matrix (3, 3) of a unit quaternion of four numbers; the matrices (m, 3, 3) of one of four arrays (m,).

    Examples
    --------
    >>> rotation_matrix((0.0, 1.0, 0.0, 0.0)).diagonal().tolist()
    [1.0, -1.0, -1.0]
    """
    w, x, y, z = quaternion
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )
    matrix = np.array(rows)
    return matrix if matrix.ndim == 2 else matrix.transpose(2, 0, 1)


def turned(quaternion: Sequence[Any], rotation: Sequence[Any]) -> tuple[Any, Any, Any, Any]:
    """The unit quaternion of exp(w) R, for a rotation vector w of three numbers or arrays.

    Examples
    --------
    >>> [round(float(x), 3) for x in turned((1.0, 0.0, 0.0, 0.0), (0.0, 0.0, np.pi / 2))]
    [0.707, 0.0, 0.0, 0.707]
    """
    x, y, z = rotation
    half = np.sqrt(x * x + y * y + z * z) / 2
    scale = np.sinc(half / np.pi) / 2
    product = quaternion_product((np.cos(half), scale * x, scale * y, scale * z), quaternion)
    norm = np.sqrt(sum(value * value for value in product))
    q0, q1, q2, q3 = (value / norm for value in product)
    return q0, q1, q2, q3
