"""A basis of the chart in which the equations are monotone over much: found in doubles, nothing is proved.

In another basis, T (1 + X) with a small X, a matrix B(y) of the same displacement becomes (1 - X) B(y) (1 + X), and f
becomes (1 - X) f, to first order. So the derivatives of slope, bend and residual (``branch_cells.CellBounds``) are
known, and the basis is improved by descent.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from pkm_exact.numeric.branch_cells import Cell, CellShape, Real

STEPS: Final = 60
SHARP: Final = 20.0
"""How much more the worst corners count than others, at first."""
LENGTH: Final = 0.15
INERTIA: Final = 0.8
TINY: Final = 1e-300


def best_rows(root: Cell) -> Real:
    """The basis, on the coordinates that are kept."""
    family = root.family
    inverse = np.linalg.inv(np.concatenate([root.slope, family.chart[None]]))
    rotation, sizes, _ = np.linalg.svd(inverse[family.kept][:, :-1])
    rows = rotation * np.sqrt(sizes)
    best, least, step = rows, np.inf, np.zeros_like(rows)
    for count in range(STEPS):
        excess, slope = _descent(root.shape(family.basis(rows)), root.half, SHARP + count)
        if not np.isfinite(excess):
            break
        if excess < least:
            best, least = rows, excess
        step = INERTIA * step + (1 - INERTIA) * slope / (np.linalg.norm(slope) + TINY)
        length = LENGTH * (1 - count / STEPS) + LENGTH / 50
        rows = rows - length * len(rows) ** 0.5 * rows @ step
    return np.asarray(best)


def _descent(shape: CellShape, half: Real, sharp: float) -> tuple[float, Real]:
    """``CellBounds.excess``, and its derivatives by X."""
    shifts = shape.on_legs * half
    turns = np.einsum("pqr,ri->ipq", shape.bend, shifts)
    at = np.tensordot(shape.vertices, turns, 1)
    values, vectors = np.linalg.eigh((at + np.swapaxes(at, 1, 2)) / 2)
    slope = float(np.abs(values).max())
    counted = _counted(np.abs(values), sharp) * np.sign(values)
    scaled = vectors * counted[:, None, :]
    by_slope = np.einsum("vpk,vqk->pq", np.swapaxes(at, 1, 2) @ scaled, vectors)
    by_slope -= np.einsum("vpk,vqk->pq", scaled, at @ vectors)

    images = shape.vertices @ np.einsum("ipq,qj->pij", turns, shifts) @ shape.vertices.T / 2
    flat = images.reshape(len(images), -1)
    sizes = np.linalg.norm(flat, axis=0)
    residual = float(sizes.max())
    by_residual = -(flat * (_counted(sizes, sharp) / (sizes + TINY))) @ flat.T

    rows = shape.bend.reshape(len(shape.bend), -1)
    squares, directions = np.linalg.eigh(rows @ rows.T)
    bend = float(squares[-1]) ** 0.5
    across = np.tensordot(directions[:, -1], shape.bend, 1)
    by_bend = (2 * across @ across - squares[-1] * np.outer(directions[:, -1], directions[:, -1])) / (bend + TINY)

    ratio = ((residual + TINY) / (bend + TINY)) ** 0.5
    return slope + 2 * (bend * residual) ** 0.5, by_slope + ratio * by_bend + by_residual / ratio


def _counted(values: Real, sharp: float) -> Real:
    """Weights of values, of sum 1, the greatest with most."""
    weights = np.exp(sharp * (values / (values.max() + TINY) - 1))
    return np.asarray(weights / weights.sum())
