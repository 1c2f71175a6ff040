"""Approximate solutions of a robot without paths: of six linear forms on all rigid motions, by an elimination template.

In a few milliseconds, where paths take ten times as long. Solutions that are lost, as some that lie close to each other
may be, are left to paths.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion_groups import SPATIAL
from pkm_exact.numeric.poses import GREATEST_CHANGE, Approximations, is_tracked
from pkm_exact.numeric.start import SAME
from pkm_exact.numeric.study_system import QUANTITIES, Complex, Real, motion_forms, numeric_section, section_quadrics
from pkm_exact.numeric.template import motion_seeds
from pkm_exact.numeric.tracker import polished

ENOUGH = 1e-8
"""Corrections of this size are the last ones."""
NOTHING = 1e-13
"""N(e) that is relatively smaller is 0 as far as doubles tell: at infinity, where small steps mean nothing."""
FITTED = 1e-3
"""N(e) that is relatively smaller is not divided by."""
SMALL = 1e-14
"""Relative singular values below which directions of f are taken for undetermined."""


def has_seeds(problem: ForwardProblem) -> bool:
    """Whether the template is one for the problem: six linear forms on all rigid motions, and nothing else."""
    return problem.motion == SPATIAL and is_tracked(problem)


def seeds(problem: ForwardProblem, *, conjugates: bool = True) -> Approximations:
    """The solutions that Newton's method finds from the template's guesses; none where the template breaks down.

    Of two conjugate ones the second is left out if it is not asked for.

    Raises
    ------
    OverflowError
        If a number of the robot is too large for floating point.
    """
    section = numeric_section(problem)
    points = seeds_of_each(section.legs[None])[0]
    if conjugates:
        are_complex = np.abs((points * points).sum(axis=1)) <= 1 - SAME
        points = np.concatenate([points, points[are_complex].conj()])
    return Approximations(section, points)


def seeds_of_each(legs: Complex) -> list[Complex]:
    """For each of several lists of forms (k, 6, 17), which the template takes all at once, the points of ``seeds``.

    Conjugate ones are mostly left out.
    """
    count = len(legs)
    with np.errstate(all="ignore"):
        try:
            points = study_points(motion_seeds(legs.real).reshape(-1, QUANTITIES))
        except np.linalg.LinAlgError:
            if count == 1:
                return [np.zeros((0, 8), dtype=complex)]
            return seeds_of_each(legs[: count // 2]) + seeds_of_each(legs[count // 2 :])
        are_finite = np.isfinite(points).all(axis=1)
        points[~are_finite] = 1
        points, change = polished(points, section_quadrics(legs, SPATIAL), enough=ENOUGH)
        e = points[:, :4]
        is_infinite = np.abs((e * e).sum(axis=1)) < NOTHING * (np.abs(e) ** 2).sum(axis=1)
        good = are_finite & ~is_infinite & (change < GREATEST_CHANGE)
    chosen = zip(points.reshape(count, -1, 8), good.reshape(count, -1), strict=True)
    return [rows[are_good] for rows, are_good in chosen]


def study_points(values: Complex) -> Complex:
    """Study coordinates (.., 8) from the 17 quantities (.., 17) of ``study_system``, as well as they fit.

    e follows from R and 1, which are linear in its products; f from u and C, linear in f, and Study's condition.
    """
    inverse, mixed = _inverse_forms()
    squares = np.tensordot(values[:, 7:], inverse, axes=([1], [2]))
    count = np.arange(len(values))
    largest = np.argmax(np.abs(np.einsum("pii->pi", squares)), axis=1)
    e = squares[count, largest] / np.sqrt(squares[count, largest, largest])[:, None]
    # With Study's condition the columns of the six equations are orthogonal, where N(e) is not small.
    norms = (e * e).sum(axis=1)
    f = (values[:, 1:7, None] * e[:, None]).reshape(len(e), -1) @ mixed[:6].reshape(-1, 4) / (2 * norms)[:, None]
    sizes = np.linalg.norm(e, axis=1)
    rest = np.flatnonzero(~(np.abs(norms) > FITTED * sizes**2))
    if len(rest):
        unit = e[rest] / sizes[rest, None]
        right = np.concatenate([values[rest, 1:7], np.zeros((len(rest), 1))], axis=1)
        f[rest] = _fitting(np.einsum("pi,kij->pkj", unit, mixed), right[:, :, None])[:, :, 0] / sizes[rest, None]
    return np.concatenate([e, f], axis=1)


def _fitting(matrices: Complex, right: Complex) -> Complex:
    """Least squares; where a matrix is singular to the bit, as one at infinity may be, the shortest for all."""
    rotation, triangle = np.linalg.qr(matrices)
    try:
        found = np.linalg.solve(triangle, rotation.conj().transpose(0, 2, 1) @ right)
    except np.linalg.LinAlgError:
        found = np.linalg.pinv(matrices, rcond=SMALL) @ right
    return np.asarray(found, dtype=np.complex128)


@cache
def _inverse_forms() -> tuple[Real, Real]:
    """(4, 4, 10): products e_i e_j in R and 1. (7, 4, 4): u, C and Study's condition, bilinear in e and f."""
    forms = motion_forms()
    i, j = np.triu_indices(4)
    products = forms[7:QUANTITIES, :4, :4][:, i, j] * np.where(i == j, 1, 2)
    place = np.empty((4, 4), dtype=np.intp)
    place[i, j] = place[j, i] = np.arange(10)
    mixed = np.empty((7, 4, 4))
    mixed[:6], mixed[6] = 2 * forms[1:7, :4, 4:], np.sqrt(8) * np.eye(4)
    inverse = np.linalg.inv(products)[place].astype(np.float64)
    return inverse, mixed
