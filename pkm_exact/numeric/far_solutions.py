"""Solutions for whose boxes doubles do not suffice, as where the platform is far off: values in integers, all at once.

Points are integers in units of 2^-128, so that values of the equations at them are exact, and Newton's method leads as
near to a solution as its grid asks for. All else is a matter of few digits, and done in doubles as before
(``double_krawczyk``), with equations that do not cancel (``chart_mixture``). Boxes are those that ball arithmetic
would find, on the first grid that bears a proof there (``grids.first_grid``). What is not as usual, and where it is
doubtful which grid is the first, is left to ``certification``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.double_boxes import (
    ASTRAY,
    SURE,
    DoubleBoxes,
    Limit,
    box_at,
    grids_of,
    inverses_at,
    real_or_complex,
)
from pkm_exact.numeric.double_krawczyk import SLACK, DoubleEquations, DoubleSolution, Proofs, double_proofs, products
from pkm_exact.numeric.double_rounding import OUTWARD, SMALL, U
from pkm_exact.numeric.grids import GRIDS, WIDEST
from pkm_exact.numeric.study_system import Complex, Real
from pkm_exact.poses.isolated_solutions import RADIUS, ROOM, Box

BITS: Final = 128
UNITS: Final = 2.0**BITS
"""Points are integers in units of 2^-BITS."""
TRIED: Final = (44, 72)
"""Grids that are tried here."""
STEPS: Final = 5
"""Newton steps at most."""
SHORTER: Final = 2.0**-6
"""Steps that are not shorter by this factor than those before are not followed: doubles do not invert the Jacobian."""
CLOSE: Final = 2.0**-10
"""Points of which steps are this small, in units of the finest grid, are not moved any more."""
LARGEST: Final = 2.0**200
"""Coordinates are smaller."""
NEARBY: Final = 2.0**-16
"""An approximation that is farther off, relative to the sizes of e and f, is not one of the solution found."""
MOVED: Final = 2.0**-30
"""After steps that are this large, relative to the sizes of e and f, Jacobians are inverted again."""
SETTLED: Final = 2.0**-30
"""Limits are known so well, in units of a grid, where it is certain which of its points is nearest."""
Integers: TypeAlias = list[list[tuple[int, int]]]
"""For each point its coordinates, real and imaginary parts."""


@dataclass(frozen=True, eq=False)
class _Equations:
    """Those of one robot, or of several: stacked, with as many points for each.

    Attributes
    ----------
    mixed, original : DoubleEquations
        G and F.
    mixing : (k, n, n) array
        A of each robot.
    """

    mixed: DoubleEquations
    original: DoubleEquations
    mixing: Real

    @classmethod
    def of(cls, systems: Sequence[ChartSystem]) -> _Equations | None:
        """None where numbers are too large, or equations differ too much to be stacked."""
        several = [entry for system in systems if (entry := system.mixed) is not None]
        originals = [plain for system in systems if (plain := system.in_doubles) is not None]
        if len(several) < len(systems) or not systems:
            return None
        mixed: DoubleEquations | None = several[0].equations
        original: DoubleEquations | None = originals[0]
        if len(systems) > 1:
            mixed = DoubleEquations.stacked([entry.equations for entry in several])
            original = DoubleEquations.stacked(originals)
        if mixed is None or original is None:
            return None
        return cls(mixed, original, np.stack([entry.mixing for entry in several]))

    def values(self, points: Integers, chosen: NDArray[np.bool_]) -> NDArray[Any]:
        """(p, n): G at those points that are chosen, in units of 2^-BITS; both parts are rounded once."""
        rows, several = np.flatnonzero(chosen), len(self.mixing)
        parts = [[list(part) for part in zip(*points[row], strict=True)] for row in rows.tolist()]
        found = self.mixed.forms.at_integers(parts, BITS, rows * several // len(points))
        return found[:, 0] + 1j * found[:, 1]

    def variations(self, inverses: NDArray[Any], radii: Real, are_real: NDArray[np.bool_]) -> Real:
        """(p, n, n): how much Y A F' varies, entry by entry, when it is computed as by balls: in F, not in G."""
        plain = inverses @ self.mixing.repeat(len(inverses) // len(self.mixing), axis=0)
        sizes = np.abs(plain.real) + np.abs(plain.imag)
        found: Real = np.where(are_real, 1.0, 2.0)[:, None, None] * (sizes @ self.original.variations(radii))
        return found


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
        Of G' there or nearby.
    values, off : (p, n) arrays
        G there, and how far both parts are off at most.
    """

    points: Integers
    near: NDArray[Any]
    inverses: NDArray[Any]
    values: NDArray[Any]
    off: Real

    @property
    def rest(self) -> Real:
        """(p, n): how far they are from solutions, roughly."""
        steps: Real = np.abs(products(self.inverses, self.values))
        return np.asarray(steps + products(np.abs(self.inverses), self.off))


def far_solutions(systems: Sequence[ChartSystem], points: Sequence[Complex]) -> list[DoubleBoxes]:
    """The boxes of the solutions near the given points; None where it is not as usual.

    Parameters
    ----------
    systems : sequence of ChartSystem
        Of one robot, or of several whose equations can be stacked.
    points : sequence of (p, n) complex arrays
        Approximate solutions of each.
    """
    found = [DoubleBoxes.none(there) for there in points]
    places = [_fit(there) for there in points]
    chosen = [row for row, fit in enumerate(places) if len(fit)]
    equations = _Equations.of([systems[row] for row in chosen])
    if equations is None:
        return found
    most = max(len(places[row]) for row in chosen)
    rows = [[*places[row].tolist(), *[int(places[row][-1])] * (most - len(places[row]))] for row in chosen]
    are_new = np.concatenate([np.arange(most) < len(places[row]) for row in chosen])
    begun, are_real = real_or_complex(np.concatenate([points[row][at] for row, at in zip(chosen, rows, strict=True)]))
    with np.errstate(all="ignore"):
        try:
            limits = _limits(equations, begun, are_real, are_new)
        except OverflowError:
            return found
        left = (np.abs(limits.near - begun) <= ASTRAY * np.abs(begun).max(axis=1, keepdims=True)).all(axis=1)
        widths, units, usual = _widths(equations, limits, are_real)
        left &= usual & (widths.max(axis=1) > WIDEST) & are_new
        grids = np.where(left, _grids(limits.near, units, widths), 0)
        known = _handed_on(limits, begun, np.ldexp(units, GRIDS[0] - max(TRIED)), grids, left)
        boxes: list[Box | None] = [None] * len(begun)
        solutions: list[DoubleSolution | None] = [None] * len(begun)
        if grids.any():
            boxes, solutions = _boxes(equations, limits, begun, grids)
    for number, (row, at) in enumerate(zip(chosen, rows, strict=True)):
        for place, k in zip(at, range(most * number, most * (number + 1)), strict=True):
            if are_new[k]:
                found[row].boxes[place], found[row].solutions[place] = boxes[k], solutions[k]
                found[row].limits[place] = known[k] if boxes[k] is None else None
    return found


def _handed_on(
    limits: _Limits, begun: NDArray[Any], units: Real, grids: NDArray[np.intp], left: NDArray[np.bool_]
) -> list[Limit | None]:
    """What is known of solutions even if no box is proved here, from the units of the finest grid; None of no use."""
    finest = max(TRIED)
    is_near = left & (np.abs(limits.near - begun) <= NEARBY * np.ldexp(units, finest)).all(axis=1)
    rest = (limits.rest / units).max(axis=1)
    known = np.zeros(len(begun), dtype=np.intp)
    for grid in TRIED:
        known[rest < np.ldexp(SETTLED, finest - grid)] = grid
    beyond = next(grid for grid in GRIDS if grid > finest)
    first = np.where(grids > 0, grids, beyond)
    rows = zip(limits.points, known.tolist(), first.tolist(), is_near.tolist(), strict=True)
    return [Limit(point, BITS, grid, exponent) if near else None for point, grid, exponent, near in rows]


def _fit(points: Complex) -> NDArray[np.intp]:
    """Which points are not beyond what is done here."""
    fit = np.isfinite(points).all(axis=1) & (np.abs(points) < LARGEST).all(axis=1) & points.any(axis=1)
    return np.flatnonzero(fit)


def _limits(
    equations: _Equations, begun: NDArray[Any], are_real: NDArray[np.bool_], are_new: NDArray[np.bool_]
) -> _Limits:
    """From where it begins; points that are not new are the ones before them again.

    Where values are known exactly and a step is short, doubles tell it so well that the values after it follow.
    """
    source, mixed = np.maximum.accumulate(np.where(are_new, np.arange(len(begun)), 0)), equations.mixed
    inverses, units = inverses_at(mixed, begun, are_real), grids_of(mixed, begun, max(TRIED))[1]
    # What a step in doubles leaves is so little that mostly values in integers are needed once.
    steps = products(inverses, mixed.forms.at(begun)[0])
    steps = np.where((np.abs(steps) < LARGEST).all(axis=1)[:, None], steps, 0)
    points: Integers = [[(int(a), int(b)) for a, b in row] for row in _parts(begun - steps)]
    near = _rounded(points, BITS, begun)
    if (np.abs(steps) > MOVED * np.ldexp(units, max(TRIED))).any():
        inverses = inverses_at(mixed, near, are_real)
    values, off = mixed.forms.at(near)
    before = blurs = np.full(len(begun), np.inf)
    for _ in range(STEPS):
        steps = np.rint(products(inverses, values) * UNITS)
        sizes = np.maximum(np.abs(steps.real), np.abs(steps.imag)) / UNITS
        lengths = (sizes / units).max(axis=1)
        moves = np.isfinite(steps).all(axis=1) & (lengths >= CLOSE)
        is_slow = moves & (lengths > SHORTER * before) & (lengths > blurs)
        before, blurs = lengths, (products(np.abs(inverses), off) / units).max(axis=1)
        moves &= ~is_slow
        if moves.any():
            steps = np.where(moves[:, None], steps, 0) / UNITS
            points = [
                [(a - int(c), b - int(d)) for (a, b), (c, d) in zip(points[k], row, strict=True)]
                for k, row in zip(source.tolist(), _parts(steps), strict=True)
            ]
            values, off = mixed.values_beside(near, -steps, (values, off))
            near = _rounded(points, BITS, begun)
        chosen = are_new & np.isfinite(values).all(axis=1)
        chosen &= ~is_slow & ~(products(np.abs(inverses), off) < CLOSE * units).all(axis=1)
        if not chosen.any():
            break
        exact = equations.values(points, chosen)
        values[chosen] = exact if np.iscomplexobj(begun) else exact.real
        off[chosen] = (np.abs(exact.real) + np.abs(exact.imag)) * U * OUTWARD + SMALL
        values, off = values[source], off[source]
    return _Limits(points, near, inverses, values, off)


def _parts(values: NDArray[Any]) -> list[list[list[float]]]:
    """Real and imaginary parts in units of 2^-BITS."""
    found: list[list[list[float]]] = np.ldexp(np.stack([values.real, values.imag], axis=-1), BITS).tolist()
    return found


def _rounded(points: Integers, bits: int, like: NDArray[Any]) -> NDArray[Any]:
    parts = np.ldexp(np.array(points, dtype=np.float64), -bits)
    return parts[..., 0] + 1j * parts[..., 1] if np.iscomplexobj(like) else parts[..., 0]


def _widths(
    equations: _Equations, limits: _Limits, are_real: NDArray[np.bool_]
) -> tuple[Real, Real, NDArray[np.bool_]]:
    """How wide Y F'(X) is on the first grid, coordinate by coordinate, by the radii; the units of that grid; where they
    are as usual: on finer grids those of e and of f are smaller by the same factor."""
    exponents, units, is_sure = grids_of(equations.mixed, limits.near, max(TRIED))
    units = np.ldexp(units, max(TRIED) - GRIDS[0])
    radii = RADIUS * units
    widths = products(equations.variations(limits.inverses, radii, are_real), radii) / radii
    return widths, units, is_sure & (max(TRIED) - exponents[:, 1] <= GRIDS[0])


def _grids(near: NDArray[Any], units: Real, widths: Real) -> NDArray[np.intp]:
    """(p,): for each limit the first grid of those that are tried on which a proof is not hopeless, or 0.

    Units and widths are those on the first grid of all.

    With any matrix Y there is as much of the width as ``grids.first_grid`` says; and the limit is as far from the
    centre, in units, as the double next to it is, but for the rounding of that.
    """
    found = np.zeros(len(near), dtype=np.intp)
    for grid in TRIED:
        narrower = np.ldexp(widths, GRIDS[0] - grid)
        width = narrower.max(axis=1, keepdims=True)
        places = near / np.ldexp(units, GRIDS[0] - grid)
        parts = np.stack([places.real, places.imag])
        apart = (np.abs(parts - np.rint(parts)) - 2 * U * np.abs(parts)).max(axis=0, initial=0)
        least = apart / RADIUS * (1 - width / 8) + narrower / (1 + width / 8)
        is_hopeless = (width[:, 0] > WIDEST) | (least.max(axis=1) * ROOM > SLACK)
        found[(found == 0) & ~is_hopeless] = grid
    return found


def _boxes(
    equations: _Equations, limits: _Limits, begun: NDArray[Any], grids: NDArray[np.intp]
) -> tuple[list[Box | None], list[DoubleSolution | None]]:
    """The boxes of limits on these grids, as far as they are proved; none where the grid is 0."""
    boxes: list[Box | None] = [None] * len(begun)
    solutions: list[DoubleSolution | None] = [None] * len(begun)
    mixed = equations.mixed
    rows = mixed.places(np.flatnonzero(grids), len(begun))
    grid = np.where(grids[rows] > 0, grids[rows], TRIED[0])
    near = limits.near[rows]
    exponents, units, decided = grids_of(mixed, near, grid)
    halves = [index // 4 for index in mixed.support]
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
    inverses = inverses_at(mixed, middle, are_real)
    wider = equations.variations(inverses, RADIUS * units, are_real)
    place = _rounded(beside, BITS, near), limits.values[rows], limits.off[rows]
    proofs = double_proofs(mixed, inverses, middle, RADIUS * units, ROOM, place, wider)
    distance = np.maximum(np.abs(proofs.moved.real), np.abs(proofs.moved.imag)) + proofs.errors
    decided &= proofs.proved & (distance < SURE * units).all(axis=1) & (grids[rows] > 0)
    decided &= (np.abs(begun[rows] - middle) <= NEARBY * np.ldexp(units, grid[:, None])).all(axis=1)
    decided &= are_real | middle.imag.any(axis=1)
    for row in np.flatnonzero(decided).tolist():
        box = boxes[rows[row]] = box_at(exponents[row].tolist(), centres[row], mixed.support)
        if box.is_real:
            solutions[rows[row]] = _solution(points[row], near[row].real, proofs, row)
    return boxes, solutions


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
