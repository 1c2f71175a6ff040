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
    steps : (p, n) array
        The next ones.
    """

    points: Integers
    near: NDArray[Any]
    inverses: NDArray[Any]
    values: NDArray[Any]
    steps: NDArray[Any]


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
        for grid in TRIED:
            narrower = np.ldexp(widths, GRIDS[0] - grid)
            rows = np.flatnonzero(left & (narrower.max(axis=1) <= WIDEST))
            if len(rows):
                is_hopeless = _add_boxes((mixed, original), limits, (begun, narrower), rows, grid, (places, found))
                left[rows] = is_hopeless
    return found


def _limits(mixed: MixedEquations, begun: NDArray[Any], are_real: NDArray[np.bool_]) -> _Limits:
    parts = np.ldexp(np.stack([begun.real, begun.imag], axis=-1), BITS).tolist()
    points: Integers = [[(int(a), int(b)) for a, b in row] for row in parts]
    units = grids_of(mixed.equations, begun, max(TRIED))[1]
    for number in range(STEPS):
        near = _rounded(points, BITS, begun)
        inverses = inverses_at(mixed.equations, near, are_real)
        values: NDArray[Any] = mixed.values(points, BITS)
        steps = products(inverses, values if np.iscomplexobj(begun) else values.real)
        sizes = np.maximum(np.abs(steps.real), np.abs(steps.imag))
        if number == STEPS - 1 or not (sizes >= CLOSE * units).any():
            break
        moves = np.ldexp(np.stack([steps.real, steps.imag], axis=-1), BITS)
        moves[~np.isfinite(moves).all(axis=(1, 2))] = 0
        points = [
            [(a - int(c), b - int(d)) for (a, b), (c, d) in zip(x, row, strict=True)]
            for x, row in zip(points, moves.tolist(), strict=True)
        ]
    return _Limits(points, near, inverses, values if np.iscomplexobj(begun) else values.real, steps)


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


def _add_boxes(
    equations: tuple[MixedEquations, DoubleEquations],
    limits: _Limits,
    known: tuple[NDArray[Any], Real],
    rows: NDArray[np.intp],
    grid: int,
    into: tuple[NDArray[np.intp], DoubleBoxes],
) -> NDArray[np.bool_]:
    """The boxes of some limits on a grid, as far as they are proved; for which surely none can be.

    Parameters
    ----------
    known : two (p, n) arrays
        Where Newton's method began, and the widths at all limits on this grid.
    """
    (mixed, _), (begun, widths), (places, found) = equations, known, into
    near, values = limits.near[rows], limits.values[rows]
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
    decided &= (np.abs(begun[rows] - middle) <= NEAR * 2.0**grid * units).all(axis=1)
    decided &= are_real | middle.imag.any(axis=1)
    for row in np.flatnonzero(decided).tolist():
        box, at = box_at(exponents[row].tolist(), centres[row], mixed.equations.support), places[rows[row]]
        found.boxes[at] = box
        if box.is_real:
            found.solutions[at] = _solution(points[row], near[row].real, proofs, row)
    # With any matrix Y there is as much as that (``grids.first_grid``).
    width = widths[rows].max(axis=1, keepdims=True)
    least = (distance - proofs.errors) / (RADIUS * units) * (1 - width / 8) + widths[rows] / (1 + width / 8)
    is_hopeless: NDArray[np.bool_] = (least.max(axis=1) * ROOM > SLACK) & ~decided
    return is_hopeless


def _solution(point: list[tuple[int, int]], near: Real, proofs: Proofs, row: int) -> DoubleSolution:
    """The point, rounded, with what it lacks in the step."""
    lacking = [a - int(b) for (a, _), b in zip(point, np.ldexp(near, BITS).tolist(), strict=True)]
    step = proofs.steps[row].real - np.ldexp(np.array(lacking, dtype=np.float64), -BITS)
    return DoubleSolution(near, step, (proofs.errors[row] + 2 * U * np.abs(step)) * OUTWARD + SMALL)
