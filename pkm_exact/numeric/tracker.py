"""Many solution paths of a parameter homotopy at once, in floating point: predictor by power series, Newton corrector.

The equations are x^T (Q + t D) x = 0, quadrics that depend linearly on t in [0, 1]. Solutions are projective: at every
step the patch conj(x).x' = 1 through the current point x is used. The power series x(t + tau) = sum x_k tau^k has, with
P = Q + t D, the coefficients

    2 (P x_0) . x_k = - sum_{0 < i < k} x_i^T P x_{k-i} - sum_{i+j=k-1} x_i^T D x_j,   conj(x_0) . x_k = 0,

one matrix for all of them. The prediction is their Pade approximant (2, 1), coordinate by coordinate, its step chosen
from the size of the fourth coefficients; a step whose corrections do not shrink is halved.

Nothing here is certified: paths may be lost or run together, and what comes out is a first guess only.
References: Sommese and Wampler, The Numerical Solution of Systems of Polynomials (2005), chapters 2 and 7; Telen, Van
Barel and Verschelde, "A robust numerical path tracking algorithm for polynomial homotopy continuation", SIAM J. Sci.
Comput. 42 (2020).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pkm_exact.numeric.study_system import Complex, Real
from pkm_exact.stages import Amount, Watch

SMALLEST_PART = 1e-12
"""Floor of the sizes of e and f beside each other."""


@dataclass(frozen=True)
class TrackerPolicy:
    """Sizes of steps and corrections, all relative to a point of norm 1.

    Attributes
    ----------
    predicted : float
        The error of a prediction that the size of a step aims at.
    first_correction : float
        Largest first Newton correction of an accepted step.
    contraction : float
        Largest second correction, in times of the first one's size.
    noise : float
        A second correction of this size is good whatever the first was: far from the base, where the equations are
        ill-conditioned, corrections do not become much smaller.
    smallest_step : float
        A path whose steps become smaller is given up: it runs to infinity or to a multiple solution.
    steps : int
        Most steps of all paths together.
    """

    predicted: float = 1e-2
    first_correction: float = 1e-1
    contraction: float = 5e-2
    noise: float = 1e-6
    smallest_step: float = 1e-10
    steps: int = 500


def track(
    points: Complex,
    start: Complex,
    target: Complex,
    policy: TrackerPolicy | None = None,
    watch: Watch | None = None,
) -> tuple[Complex, NDArray[np.bool_]]:
    """Where the paths from the solutions of ``start`` end at ``target``, and which of them arrived.

    Parameters
    ----------
    points : (p, n) array
        Solutions of the start equations, one per path.
    start, target : (q, n, n) arrays
        Symmetric matrices of the quadrics, q = n - 1.
    policy : TrackerPolicy, optional
    watch : callable, optional
        Gets how many paths have ended, after every step.

    Returns
    -------
    (p, n) array
        Last point of every path, of norm 1.
    (p,) array of bool
        Whether the path arrived.
    """
    policy = policy or TrackerPolicy()
    flow = np.concatenate([start, target - start])
    x = normalised(points)
    t = np.zeros(len(x))
    limit = np.ones(len(x))
    active = np.arange(len(x))
    for _ in range(policy.steps):
        if not len(active):
            break
        sizes = _sizes(x[active])
        series = _series(x[active], sizes, t[active], flow)
        step = np.minimum(np.minimum(_step(series / sizes, policy.predicted), limit[active]), 1 - t[active])
        moved, good = _corrected(_pade(series, step), t[active] + step, flow, policy)
        x[active[good]] = moved[good]
        t[active[good]] += step[good]
        limit[active] = np.where(good, 4 * step, step / 3)
        active = active[(t[active] < 1) & (good | (step > policy.smallest_step))]
        if watch is not None:
            watch(Amount(len(x) - len(active), len(x), "paths"))
    return x, t >= 1


def normalised(points: Complex) -> Complex:
    """The same projective points, of norm 1."""
    unit: Complex = points / np.linalg.norm(points, axis=-1, keepdims=True)
    return unit


def polished(points: Complex, quadrics: Complex, steps: int = 3, enough: float = 0.0) -> tuple[Complex, Real]:
    """The points after Newton steps, of norm 1, and the relative size of the last correction of each.

    If corrections are smaller than what is enough, all of them, no further steps are made.
    """
    x = normalised(points)
    change = np.full(len(x), np.inf)
    for _ in range(steps):
        x, change = _newton(x, _gradients(x, quadrics))
        x = normalised(x)
        if change.max(initial=0) < enough:
            break
    return x, change


def _sizes(x: Complex) -> Real:
    """The size of e in the first half, of f in the second: steps and corrections are measured by them.

    Where the platform is far from the base, e is small beside f, and yet it is e that gives the rotation.
    """
    half = x.shape[1] // 2
    parts = [np.linalg.norm(x[:, :half], axis=1), np.linalg.norm(x[:, half:], axis=1)]
    return np.repeat(np.maximum(np.stack(parts, axis=1), SMALLEST_PART), half, axis=1)


def _gradients(x: Complex, quadrics: Complex) -> Complex:
    """(p, q, n): Q_k x for every point and quadric, half the gradients; of several lists each has as many points."""
    count, size = x.shape
    *lead, number = quadrics.shape[:-2]
    tables = np.swapaxes(quadrics.reshape(*lead, -1, size), -1, -2)
    return (x.reshape(*lead, -1, size) @ tables).reshape(count, number, size)


def _system(half: Complex, x: Complex, sizes: Real) -> Complex:
    """(p, n, n): the linear systems of the quadrics and the patch, in coordinates relative to their sizes.

    The patch, in these coordinates, is orthogonal to the point.
    """
    return np.concatenate([half * sizes[:, None, :], (x / sizes).conj()[:, None, :]], axis=1)


def _newton(x: Complex, half: Complex) -> tuple[Complex, Real]:
    """The points after one Newton step, and its relative size; infinite where the linear system is singular."""
    sizes = _sizes(x)
    values = (half @ x[:, :, None]) / -2
    right = np.concatenate([values, np.zeros((len(x), 1, 1))], axis=1)
    relative = _solved(_system(half, x, sizes), right)[:, :, 0]
    return x + relative * sizes, np.linalg.norm(relative, axis=1)


def _solved(matrices: Complex, right: Complex) -> Complex:
    """Solutions of the linear systems; infinite for a singular one."""
    try:
        solutions: Complex = np.linalg.solve(matrices, right).astype(np.complex128, copy=False)
        return solutions
    except np.linalg.LinAlgError:
        if len(matrices) == 1:
            return np.full(right.shape, np.inf, dtype=complex)
        middle = len(matrices) // 2
        parts = [_solved(matrices[part], right[part]) for part in (slice(middle), slice(middle, None))]
        return np.concatenate(parts)


def _series(x: Complex, sizes: Real, t: Real, flow: Complex) -> Complex:
    """(5, p, n): coefficients of the power series of every path at its t."""
    split = len(flow) // 2
    weight = t[:, None, None]
    coefficients = [x]
    moved, drift = [], []
    for order in range(1, 5):
        products = _gradients(coefficients[-1], flow)
        drift.append(products[:, split:])
        moved.append(products[:, :split] + weight * drift[-1])
        if order == 1:
            unit = np.broadcast_to(np.eye(split + 1, dtype=complex), (len(x), split + 1, split + 1))
            inverse = _solved(_system(moved[0], x, sizes), unit)[:, :, :-1] * sizes[:, :, None]
        terms = [moved[i] @ coefficients[order - i][:, :, None] for i in range(1, order)]
        terms += [drift[i] @ coefficients[order - 1 - i][:, :, None] for i in range(order)]
        right = np.add.reduce(terms)
        coefficients.append((inverse @ (right / -2))[:, :, 0])
    return np.array(coefficients)


def _step(series: Complex, error: float) -> Real:
    """The step at which the fourth term has the size ``error``."""
    fourth = np.linalg.norm(series[4], axis=1)
    third = np.linalg.norm(series[3], axis=1)
    size = np.maximum(fourth, third ** (4 / 3))
    step: Real = (error / np.maximum(size, 1e-300)) ** 0.25
    return step


def _pade(series: Complex, step: Real) -> Complex:
    """The Pade approximants (2, 1) after the step; where they have a pole nearby, the series itself."""
    tau = step[:, None]
    with np.errstate(all="ignore"):
        ratio = series[3] / series[2] * tau
        bounded = np.abs(ratio) < 0.5
        factor = np.where(bounded, 1 / (1 - ratio), 1 + np.where(np.isfinite(ratio), ratio, 0))
    moved: Complex = series[0] + tau * (series[1] + tau * series[2] * factor)
    return moved


def _corrected(x: Complex, t: Real, flow: Complex, policy: TrackerPolicy) -> tuple[Complex, NDArray[np.bool_]]:
    """Two Newton steps at the new t; good where the first is small and the second much smaller."""
    split = len(flow) // 2
    changes = []
    with np.errstate(invalid="ignore", over="ignore"):
        x = normalised(x)
        for _ in range(2):
            products = _gradients(x, flow)
            x, change = _newton(x, products[:, :split] + t[:, None, None] * products[:, split:])
            changes.append(change)
        x = normalised(x)
        small = changes[1] <= np.maximum(policy.contraction * changes[0], policy.noise)
        return x, (changes[0] < policy.first_correction) & small
