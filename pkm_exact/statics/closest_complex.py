"""The linear complex that lines are nearest to: around which axis, and with which pitch, a platform is about to move.

A motion (c, m), angular velocity and velocity of the origin, works d.m + b.c against a line of the direction d and the
moment b. The least sum of squares over all lines with |c| = 1 is the least eigenvalue of the Schur complement of their
Gramian (equation 59 of chapter 19 of *Parallel Manipulators* (2008), with the square that is missing there). It is in
doubles and not proved: near a singular pose it says what the platform is about to do.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pkm_exact.errors import InputError


@dataclass(frozen=True)
class ClosestComplex:
    """A screw motion, in doubles.

    Attributes
    ----------
    direction : ndarray of shape (3,)
        Of the axis, of length 1; its last component that is not 0 is positive.
    moment : ndarray of shape (3,)
        Of the axis about the origin.
    pitch : float
        Way along the axis per radian.
    deviation : float
        Root of the least sum of squares, divided by the number of lines above five; 0 at a singular pose.
    """

    direction: NDArray[np.float64]
    moment: NDArray[np.float64]
    pitch: float
    deviation: float


def closest_complex(lines: NDArray[np.float64]) -> ClosestComplex:
    """The screw motion that a platform held by lines comes nearest to.

    Parameters
    ----------
    lines : ndarray of shape (k, 6)
        At least six: directions of length 1 and moments; (0, 0, 0) and a moment where a couple is held.

    Raises
    ------
    InputError
        If the lines are too few, or hold no translation.

    Examples
    --------
    >>> rows = [[1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0]]
    >>> rows += [[0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, 1, 0, 0, 0]]
    >>> found = closest_complex(np.array(rows, dtype=float))
    >>> print(found.direction + 0.0, found.pitch + 0.0, found.deviation)
    [0. 0. 1.] 0.0 0.0
    """
    if lines.ndim != 2 or lines.shape[1] != 6 or len(lines) < 6 or not np.isfinite(lines).all():
        raise InputError(f"lines: an array of shape {lines.shape}; give six finite numbers of at least six lines")
    directions, moments = lines[:, :3], lines[:, 3:]
    if np.linalg.matrix_rank(directions) < 3:
        raise InputError("lines: parallel to a plane, so that a translation is not held; add one that is not")
    back, *_ = np.linalg.lstsq(directions, -moments, rcond=None)
    left = moments + directions @ back
    _, sizes, axes = np.linalg.svd(left)
    axis = axes[2] * (1 if axes[2][np.flatnonzero(np.abs(axes[2]) > 1e-9)[-1]] > 0 else -1)
    velocity = back @ axis
    pitch = float(axis @ velocity)
    return ClosestComplex(axis, velocity - pitch * axis, pitch, float(sizes[2] / np.sqrt(len(lines) - 5)))
