"""Solutions for whose boxes doubles do not suffice, as where the platform is far off: values in integers, all at once.

Points are integers in units of 2^-128, so that values of the equations at them are exact, and Newton's method leads as
near to a solution as its grid asks for. All else is a matter of few digits, and done in doubles as before
(``double_krawczyk``), with equations that do not cancel (``chart_mixture``). Boxes are those that ball arithmetic
would find, on the first grid that bears a proof there (``grids.first_grid``). What is not as usual, and where it is
doubtful which grid is the first, is left to ``certification``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.chart_mixture import Integers, MixedEquations
from pkm_exact.numeric.double_boxes import (
    ASTRAY,
    NEAR,
    SURE,
    DoubleBoxes,
    box_at,
    grids_of,
    inverses_at,
    real_or_complex,
)
from pkm_exact.numeric.double_krawczyk import SLACK, DoubleEquations, DoubleSolution, Proofs, double_proofs, products
from pkm_exact.numeric.double_rounding import OUTWARD, SMALL, U
from pkm_exact.numeric.grids import GRIDS, WIDEST
from pkm_exact.numeric.study_system import Complex, Real
from pkm_exact.poses.isolated_solutions import RADIUS, ROOM

BITS: Final = 128
"""Of the units of points."""
TRIED: Final = (44, 72)
"""Grids that are tried here."""
STEPS: Final = 5
"""Newton steps at most."""
CLOSE: Final = 2.0**-4
"""Steps that are this small, in units of the finest grid, are the last ones."""
LARGEST: Final = 2.0**200
"""Coordinates are smaller."""


@dataclass(frozen=True, eq=False)
class _Limits:
    """Where Newton's method leads.

    Attributes
    ----------
    points : Integers
        In units of 2^-BITS.
    near : (p, n) array
        The same, rounded.
    inverses : (p, n, n) array
        Of G' there.
    values : (p, n) array
        G there, both parts rounded once.
    """

    points: Integers
    near: NDArray[Any]
    inverses: NDArray[Any]
    values: NDArray[Any]


def far_solutions(system: ChartSystem, points: Complex) -> DoubleBoxes:
    """The boxes of the solutions near the given points; None where it is not as usual.

    Parameters
    ----------
    system : ChartSystem
    points : (p, n) complex array
        Approximate solutions.
    """
    found = DoubleBoxes.none(points)
    mixed, original = system.mixed, system.in_doubles
    fit = np.isfinite(points).all(axis=1) & (np.abs(points) < LARGEST).all(axis=1) & points.any(axis=1)
    places = np.flatnonzero(fit)
    if mixed is None or original is None or not len(places):
        return found
    begun, are_real = real_or_complex(points[places])
    with np.errstate(all="ignore"):
        try:
            limits = _limits(mixed, begun, are_real)
        except OverflowError:
            return found
        left = (np.abs(limits.near - begun) <= ASTRAY * np.abs(begun).max(axis=1, keepdims=True)).all(axis=1)
        widths, usual = _widths((mixed, original), limits, are_real)
        left &= usual & (widths.max(axis=1) > WIDEST)
        grids = _grids(mixed.equations, limits.near, widths)
        rows = np.flatnonzero(left & (grids > 0))
        if len(rows):
            _add_boxes((mixed, original), limits, (begun, grids), rows, (places, found))
    return found


def _limits(mixed: MixedEquations, begun: NDArray[Any], are_real: NDArray[np.bool_]) -> _Limits:
    parts = np.ldexp(np.stack([begun.real, begun.imag], axis=-1), BITS).tolist()
    points: Integers = [[(int(a), int(b)) for a, b in row] for row in parts]
    units = grids_of(mixed.equations, begun, max(TRIED))[1]
    for number in range(STEPS):
        near = _rounded(points, BITS, begun)
        inverses = inverses_at(mixed.equations, near, are_real)
        values: NDArray[Any] = mixed.values(points, BITS)
        values = values if np.iscomplexobj(begun) else values.real
        steps = products(inverses, values)
        sizes = np.maximum(np.abs(steps.real), np.abs(steps.imag))
        if number == STEPS - 1 or not (sizes >= CLOSE * units).any():
            break
        moves = np.ldexp(np.stack([steps.real, steps.imag], axis=-1), BITS)
        moves[~np.isfinite(moves).all(axis=(1, 2))] = 0
        points = [
            [(a - int(c), b - int(d)) for (a, b), (c, d) in zip(x, row, strict=True)]
            for x, row in zip(points, moves.tolist(), strict=True)
        ]
    return _Limits(points, near, inverses, values)


def _rounded(points: Integers, bits: int, like: NDArray[Any]) -> NDArray[Any]:
    parts = np.ldexp(np.array(points, dtype=np.float64), -bits)
    return parts[..., 0] + 1j * parts[..., 1] if np.iscomplexobj(like) else parts[..., 0]


def _widths(
    equations: tuple[MixedEquations, DoubleEquations], limits: _Limits, are_real: NDArray[np.bool_]
) -> tuple[Real, NDArray[np.bool_]]:
    """How wide Y F'(X) is on the first grid, coordinate by coordinate, by the radii; where the grids are as usual."""
    exponents, units, is_sure = grids_of(equations[0].equations, limits.near, max(TRIED))
    radii = RADIUS * np.ldexp(units, max(TRIED) - GRIDS[0])
    widths = products(_variations(equations, limits.inverses, radii, are_real), radii) / radii
    return widths, is_sure & (max(TRIED) - exponents[:, 1] <= GRIDS[0])


def _variations(
    equations: tuple[MixedEquations, DoubleEquations], inverses: NDArray[Any], radii: Real, are_real: NDArray[np.bool_]
) -> Real:
    """(p, n, n): how much Y A F' varies, entry by entry, when it is computed as by balls: in F, not in G."""
    mixed, original = equations
    plain = inverses @ mixed.mixing
    sizes = np.abs(plain.real) + np.abs(plain.imag)
    found: Real = np.where(are_real, 1.0, 2.0)[:, None, None] * (sizes @ original.variations(radii))
    return found


def _grids(equations: DoubleEquations, near: NDArray[Any], widths: Real) -> NDArray[np.intp]:
    """(p,): for each limit the first grid on which a proof is not hopeless; 0 for none of those that are tried.

    With any matrix Y there is as much of the width as ``grids.first_grid`` says; and the limit is as far from the
    centre, in units, as the double next to it is, but for the rounding of that.
    """
    found = np.zeros(len(near), dtype=np.intp)
    for grid in TRIED:
        narrower = np.ldexp(widths, GRIDS[0] - grid)
        width = narrower.max(axis=1, keepdims=True)
        places = near / grids_of(equations, near, grid)[1]
        parts = np.stack([places.real, places.imag])
        apart = (np.abs(parts - np.rint(parts)) - 2 * U * np.abs(parts)).max(axis=0, initial=0)
        least = apart / RADIUS * (1 - width / 8) + narrower / (1 + width / 8)
        is_hopeless = (width[:, 0] > WIDEST) | (least.max(axis=1) * ROOM > SLACK)
        found[(found == 0) & ~is_hopeless] = grid
    return found


def _add_boxes(
    equations: tuple[MixedEquations, DoubleEquations],
    limits: _Limits,
    known: tuple[NDArray[Any], NDArray[np.intp]],
    rows: NDArray[np.intp],
    into: tuple[NDArray[np.intp], DoubleBoxes],
) -> None:
    """The boxes of some limits, as far as they are proved.

    Parameters
    ----------
    known : (p, n) array, (p,) array
        Where Newton's method began, and the grids of all limits.
    """
    (mixed, _), (begun, grids), (places, found) = equations, known, into
    near, values, grid = limits.near[rows], limits.values[rows], grids[rows]
    exponents, units, decided = grids_of(mixed.equations, near, grid)
    halves = [index // 4 for index in mixed.equations.support]
    shifts = [[BITS - row[half] for half in halves] for row in exponents.tolist()]
    points = [limits.points[row] for row in rows.tolist()]
    centres = [
        [((a + (1 << k - 1)) >> k, (b + (1 << k - 1)) >> k) for (a, b), k in zip(x, row, strict=True)]
        for x, row in zip(points, shifts, strict=True)
    ]
    beside = [
        [(a - (c << k), b - (d << k)) for (a, b), (c, d), k in zip(x, centre, row, strict=True)]
        for x, centre, row in zip(points, centres, shifts, strict=True)
    ]
    middle = _rounded(centres, 0, near) * units
    are_real = np.logical_not(near.imag.any(axis=1))
    inverses = inverses_at(mixed.equations, middle, are_real)
    wider = _variations(equations, inverses, RADIUS * units, are_real)
    off = (np.abs(values.real) + np.abs(values.imag)) * U * OUTWARD + SMALL
    place = _rounded(beside, BITS, near), values, off
    proofs = double_proofs(mixed.equations, inverses, middle, RADIUS * units, ROOM, place, wider)
    distance = np.maximum(np.abs(proofs.moved.real), np.abs(proofs.moved.imag)) + proofs.errors
    decided &= proofs.proved & (distance < SURE * units).all(axis=1)
    decided &= (np.abs(begun[rows] - middle) <= NEAR * np.ldexp(units, grid[:, None])).all(axis=1)
    decided &= are_real | middle.imag.any(axis=1)
    for row in np.flatnonzero(decided).tolist():
        box, at = box_at(exponents[row].tolist(), centres[row], mixed.equations.support), places[rows[row]]
        found.boxes[at] = box
        if box.is_real:
            found.solutions[at] = _solution(points[row], near[row].real, proofs, row)


def _solution(point: list[tuple[int, int]], near: Real, proofs: Proofs, row: int) -> DoubleSolution:
    """The point, rounded, with what it lacks in the step.

    The solution is x - s up to an error, with x the point and s = Y F(x) the step. With p the double next to x it is p
    - d, d = s - l, l = x - p, which is exact in integers. Rounding l, and then d, is off by u |l| + u |d| at most, that
    is u |s| + 2 u |d| and terms in u^2. 2 u |d| is added here. u |s| is in the error already: of the product Y F(x) it
    counts gamma(``TERMS``) = gamma(12) times |Y| |F(x)| where sums of eight products are off by gamma(8) times that, so
    that 4 u |Y| |F(x)| >= 3 u |s| is left over, also for the terms in u^2.
    """
    lacking = [a - int(b) for (a, _), b in zip(point, np.ldexp(near, BITS).tolist(), strict=True)]
    step = proofs.steps[row].real - np.ldexp(np.array(lacking, dtype=np.float64), -BITS)
    return DoubleSolution(near, step, (proofs.errors[row] + 2 * U * np.abs(step)) * OUTWARD + SMALL)
