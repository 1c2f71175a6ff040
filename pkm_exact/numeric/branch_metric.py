"""In which metric the matrices of a cell are definite, with errors of the data: found in doubles, nothing is proved.

Of matrices M = 1 + B + sum of u g^T t, |t| <= 1, with a vector u for each leg and a vector g for each of its errors,
the symmetric part of P M is positive definite if that of P (1 + B) exceeds the half of the sum of
w (P u) (P u)^T + g g^T / w, for any numbers w > 0. P and w are improved by descent on the greatest eigenvalue over all
corners of the cell.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]

SHARP: Final = 20.0
"""How much more the worst corners count than others, at first."""
LENGTH: Final = 0.05
"""Of a step, as part of P."""
INERTIA: Final = 0.8
DAMPED: Final = 0.5
SMALL: Final = 1e-12


@dataclass(frozen=True, eq=False)
class CornerMatrices:
    """The matrices of a cell.

    Attributes
    ----------
    slopes : corners x q x q
        B.
    effects : corners x legs x errors x q
        g.
    on_legs : q x legs
        u.
    off : float
        Norm of what is not at the corners, relative to P.
    rest : legs
        Greatest lengths of what a leg's errors add to its g beside the corners.
    """

    slopes: Real
    effects: Real
    on_legs: Real
    off: float
    rest: Real


@dataclass(frozen=True, eq=False)
class Metric:
    """P, w, and what they leave: below 1 if the symmetric parts are definite.

    Attributes
    ----------
    matrix : q x q
    weights : legs x errors
    share : float
    """

    matrix: Real
    weights: Real
    share: float


def best_metric(corners: CornerMatrices, start: Real, steps: int, enough: float = 0.0) -> Metric:
    """P and w after some steps, or as soon as ``enough`` is reached."""
    matrix, step = start, np.zeros_like(start)
    weights = _first_weights(corners, matrix)
    best = Metric(matrix, weights, np.inf)
    for count in range(steps):
        root = _root(matrix)
        if root is None:
            break
        share, found, vectors = _shares(corners, matrix, weights, root)
        if share < best.share:
            best = Metric(matrix, weights, share)
        if share < enough:
            break
        counted = np.exp((SHARP + count) * (found / share - 1))
        counted /= counted.sum()
        slope = root @ _slope(corners, matrix, weights, vectors, counted, found) @ root
        step = INERTIA * step + (1 - INERTIA) * slope / (np.linalg.norm(slope) + SMALL)
        length = LENGTH * (1 - count / steps) + LENGTH / 20
        matrix = matrix - length * len(matrix) ** 0.5 * root @ step @ root
        matrix = matrix * len(matrix) / np.trace(matrix)
        weights = weights ** (1 - DAMPED) * _weights(corners, matrix, vectors, counted) ** DAMPED
    return best


def _root(matrix: Real) -> Real | None:
    """Of the symmetric part."""
    values, vectors = np.linalg.eigh((matrix + matrix.T) / 2)
    return np.asarray(vectors * np.sqrt(values) @ vectors.T) if values[0] > SMALL else None


def _shares(corners: CornerMatrices, matrix: Real, weights: Real, root: Real) -> tuple[float, Real, Real]:
    """The greatest eigenvalue, all of them, and the vectors."""
    inverse = np.linalg.inv(root)
    legs = matrix @ corners.on_legs
    flat = corners.effects / np.sqrt(weights)[..., None]
    flat = flat.reshape(len(flat), -1, len(matrix))
    turned = matrix @ corners.slopes
    lost = (legs * weights.sum(axis=1)) @ legs.T + np.swapaxes(flat, 1, 2) @ flat
    lost = (lost - turned - np.swapaxes(turned, 1, 2)) / 2
    rest = corners.off * np.linalg.norm(matrix, 2) + np.linalg.norm(legs, axis=0) @ corners.rest
    values, vectors = np.linalg.eigh(inverse @ (lost + rest * np.eye(len(matrix))) @ inverse)
    return float(values.max()), values, inverse @ vectors


def _slope(corners: CornerMatrices, matrix: Real, weights: Real, vectors: Real, counted: Real, found: Real) -> Real:
    """Derivatives of the mean of eigenvalues by P."""
    there = corners.slopes @ vectors
    scaled = vectors * counted[:, None, :]
    across = np.einsum("vpk,vqk->pq", scaled, there) + np.einsum("vpk,vqk->pq", scaled * found[:, None, :], vectors)
    squares = np.einsum("vpk,vqk->pq", scaled, vectors)
    legs = corners.on_legs
    return np.asarray(squares @ (matrix @ legs * weights.sum(axis=1)) @ legs.T - across)


def _weights(corners: CornerMatrices, matrix: Real, vectors: Real, counted: Real) -> Real:
    """The best ones for the mean."""
    scaled = vectors * np.sqrt(counted)[:, None, :]
    flat = corners.effects.reshape(len(scaled), -1, len(matrix))
    effects = ((flat @ scaled) ** 2).sum(axis=(0, 2)).reshape(corners.effects.shape[1:3])
    legs = (((matrix @ corners.on_legs).T @ scaled) ** 2).sum(axis=(0, 2))
    return _ratios(effects, legs)


def _first_weights(corners: CornerMatrices, matrix: Real) -> Real:
    effects = (corners.effects**2).mean(axis=0).sum(axis=-1)
    return _ratios(effects, ((matrix @ corners.on_legs) ** 2).sum(axis=0))


def _ratios(effects: Real, legs: Real) -> Real:
    return np.asarray(np.sqrt((effects + SMALL * effects.max() + 1e-300) / (legs + SMALL * legs.max())[:, None]))
