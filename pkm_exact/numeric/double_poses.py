"""Real poses in doubles, from where solutions are known to lie: positions, rotations and quaternions, with bounds.

All for many poses at once; the roundings are those of ``double_rounding``. A pose x = p - d is given by doubles p and d
and a bound of how far off that is (``double_krawczyk``). A quadratic form is q(p) - 2 B(p, d) + q(d) with q(p) in twice
as many bits (``double_forms``): that of a position is then as exact as a double, also in large coordinates.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np

from pkm_exact.geometry.study import Quadric, motion_quadrics
from pkm_exact.numeric.double_forms import DoubleForms
from pkm_exact.numeric.double_krawczyk import DoubleSolution
from pkm_exact.numeric.double_rounding import OUTWARD, SMALL, U, gamma
from pkm_exact.numeric.study_system import Real
from pkm_exact.poses.boxes import NEAR_EXPONENT
from pkm_exact.roots.interval import Interval

_FEW: Final = 10
"""Roundings in a row in products, quotients and roots here, and in sums of up to eight terms, at most."""
NEAR: Final = 2.0**-NEAR_EXPONENT
"""Values that are as close to a grid point, in units, get the cells on both sides."""
DOUBT: Final = 2.0**-42
"""What is closer to that limit, in units, is not decided by doubles."""
GREATEST: Final = 2.0**50
"""Grid points, in units, that doubles tell from their halves are smaller."""


@dataclass(frozen=True, eq=False)
class DoubleCoordinates:
    """Position (3), rotation matrix by rows (9) and unit quaternion (4) of p poses, in ordinary coordinates.

    Attributes
    ----------
    values, errors : (p, 16) arrays
        How far values are off, at most.
    """

    values: Real
    errors: Real


def double_coordinates(
    solutions: Sequence[DoubleSolution], support: Sequence[int], metric: tuple[int, int, int]
) -> DoubleCoordinates:
    """The coordinates of real poses that doubles have found; errors are nan where they cannot be told."""
    if not solutions:
        return DoubleCoordinates(np.zeros((0, 16)), np.zeros((0, 16)))
    points, steps, errors = study_points(solutions, support)
    scales = np.sqrt(np.array(metric, dtype=float))
    factors = np.concatenate([scales, (scales[:, None] / scales[None]).ravel()])
    weights = np.concatenate([[np.prod(scales)], scales])
    with np.errstate(all="ignore"):
        values, off = _quantities(points, steps, errors, metric)
        norm, norm_off = values[:, -1:], off[:, -1:]
        part = norm_off / (norm - norm_off)
        quotients = values[:, :-1] / norm
        quotients_off = off[:, :-1] / norm * (1 + part) + part * np.abs(quotients)
        quaternion, about = (weights * numbers[:, :4] / np.sqrt(norm) for numbers in (points - steps, errors))
        quaternion_off = about * (1 + part) + part * np.abs(quaternion)
        middles = np.concatenate([factors * quotients, quaternion], axis=1)
        bounds = np.concatenate([factors * quotients_off, quaternion_off], axis=1)
        bounds = (bounds + gamma(_FEW) * np.abs(middles)) * OUTWARD + SMALL
    for places, value in zip(_constants(metric, tuple(support)), (0.0, 1.0), strict=True):
        middles[:, places], bounds[:, places] = value, 0.0
    bounds[~(np.abs(part) < 1 / 4)[:, 0] | ~(norm > 0)[:, 0]] = np.nan
    return DoubleCoordinates(middles, bounds)


@lru_cache(maxsize=32)
def _constants(metric: tuple[int, int, int], support: tuple[int, ...]) -> tuple[list[int], list[int]]:
    """Which coordinates are 0, and which are 1, for all motions with this support: entries of rotations among them."""
    quadrics = [
        {place: value for place, value in quadric.items() if set(place) <= set(support)}
        for quadric in motion_quadrics(metric)[4:]
    ]
    zeros, ones = (
        [place for place, quadric in enumerate(quadrics[:-1]) if quadric == other] for other in ({}, quadrics[-1])
    )
    return zeros + [12 + index for index in range(4) if index not in support], ones


def study_points(solutions: Sequence[DoubleSolution], support: Sequence[int]) -> tuple[Real, Real, Real]:
    """Points, steps and errors, (p, 8) each: coordinates that are not of the support are 0."""
    points, steps, errors = np.zeros((3, len(solutions), 8))
    places = list(support)
    points[:, places] = [found.point for found in solutions]
    steps[:, places] = [found.step for found in solutions]
    errors[:, places] = [found.error for found in solutions]
    return points, steps, errors


def _quantities(points: Real, steps: Real, errors: Real, metric: tuple[int, int, int]) -> tuple[Real, Real]:
    """N(e) times C, R and 1, (p, 13), and how far these values are off at most."""
    forms, slopes = _motion_forms(metric)
    head, tail, off = forms_at(forms, slopes, (points, steps, errors))
    found = head + tail
    return found, (off + U * np.abs(found)) * OUTWARD


def forms_at(forms: DoubleForms, slopes: Real, place: tuple[Real, Real, Real]) -> tuple[Real, Real, Real]:
    """Quadratic forms with these second derivatives (k, 8, 8) at p - d, as sums of two doubles; how far they are off.

    The place is p, d, and how far p - d is off at most, (p, 8) each.
    """
    points, steps, errors = place
    parts = forms.in_two(points)
    head, tail, off = (np.ldexp(part, forms.powers) for part in parts)
    sizes, moves = np.abs(points), np.abs(steps)

    def sums(table: Real, left: Real, right: Real) -> Real:
        rows = (left[:, :, None] * right[:, None, :]).reshape(len(left), -1)
        found: Real = rows @ table.reshape(len(table), -1).T
        return found

    change = sums(slopes, points, steps)
    around = np.abs(slopes)
    tail = tail - change
    bound = off + gamma(2 * _FEW) * (sums(around, sizes, moves) + np.abs(tail))
    bound += sums(around, moves, moves) + sums(around, sizes + moves + errors, errors)
    return head, tail, bound * OUTWARD + SMALL


@lru_cache(maxsize=8)
def _motion_forms(metric: tuple[int, int, int]) -> tuple[DoubleForms, Real]:
    """C, R and N(e) as quadratic forms, and their second derivatives, (13, 8, 8)."""
    quadrics = motion_quadrics(metric)[4:]
    return DoubleForms.of(quadrics), second_derivatives(quadrics)


def second_derivatives(quadrics: Sequence[Quadric]) -> Real:
    """(k, 8, 8): those of quadratic forms."""
    slopes = np.zeros((len(quadrics), 8, 8))
    for table, quadric in zip(slopes, quadrics, strict=True):
        for (i, j), value in quadric.items():
            table[i, j] += value
            table[j, i] += value
    return slopes


def double_cells(found: DoubleCoordinates, exponent: int) -> list[list[Interval | None]]:
    """The cells of the grid 2^-exponent (``poses.boxes``); None where doubles do not decide them.

    Examples
    --------
    >>> coordinates = DoubleCoordinates(np.array([[0.375, 0.5, 0.4999]]), np.full((1, 3), 1e-9))
    >>> [cell and str(cell.lo) for cell in double_cells(coordinates, 2)[0]]
    ['1/4', None, '1/4']
    """
    values, errors = np.ldexp(found.values, exponent), np.ldexp(found.errors, exponent)
    nearest = np.floor(values + 0.5)
    distance = np.abs(values - nearest)
    are_far, are_near = distance - errors > NEAR + DOUBT, distance + errors < NEAR - DOUBT
    decided = (are_far | are_near) & (np.abs(values) < GREATEST)
    low = np.where(are_near, nearest - 1, np.floor(values))
    high = np.where(are_near, nearest, low) + 1
    numbers = [np.where(decided, ends, 0).astype(np.int64).ravel().tolist() for ends in (low, high)]
    cells: list[Interval | None] = [*Interval.cells(numbers[0], numbers[1], exponent)]
    for place in np.flatnonzero(~decided).tolist():
        cells[place] = None
    width = values.shape[1]
    return [cells[start : start + width] for start in range(0, len(cells), width)]
