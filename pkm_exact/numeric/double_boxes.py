"""Boxes of solutions that doubles suffice to prove: those, to the bit, that ball arithmetic would find.

The box is the one around the grid point nearest to the solution, which is proved to be the nearest. Where a doubt is
left, as between two grid points, the solution is left to others (``far_solutions``, ``certification``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from operator import neg
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.numeric.double_krawczyk import (
    SLACK,
    DoubleEquations,
    DoubleSolution,
    double_proofs,
    inverses_of,
    newton_step,
    products,
)
from pkm_exact.numeric.study_system import Complex, Real
from pkm_exact.poses.isolated_solutions import RADIUS, ROOM, Box

CLEARLY_COMPLEX: Final = 1e-6
"""Imaginary parts, relative to the point, from which a point is not taken for its own conjugate."""
NEARLY_BITS: Final = 26
"""Numbers that are smaller than a power of 2 by less than 2^-26 of it count as large as it is."""
DOUBT: Final = 2.0**-30
"""Sizes that are closer to such a limit are not decided by doubles."""
SURE: Final = 0.5 - 2.0**-20
"""A grid point that is closer, in units, is the nearest one whatever small errors there are."""
NEAR: Final = 2.0**-26
"""An approximation that is farther off, relative to the sizes of e and f, is not surely one of the solution found."""
STEPS: Final = 3
"""Newton steps with more exact values of F, at most."""
ARRIVED: Final = 2.0**-10
"""Newton steps that are this small, in units, have arrived."""
SETTLED: Final = 2.0**-20
"""Those that are larger are followed by another one all the same: how far off a solution may be is in proportion."""
EXACT: Final = 2.0**-32
"""Steps that are this small times how wide Y F'(X) is, are not followed by another one after all."""
ASTRAY: Final = 2.0**-16
"""Where Newton's method leads farther than this, relative to the point, it is not followed."""
HOPELESS: Final = 1.0
"""Widths of Y F'(X), by the radii of X, from which on no proof succeeds (``grids.first_grid``)."""
GREATEST_SHIFT: Final = 1000
"""Numbers that are 0 count as smaller than others by so many bits."""
GREATEST: Final = 2.0**52
"""Grid points, in units, that doubles hold exactly are smaller."""


@dataclass(frozen=True, eq=False)
class Limit:
    """Where Newton's method leads to with more bits than doubles have.

    Attributes
    ----------
    point : sequence of n pairs of int
        Real and imaginary parts, in units of 2^-bits.
    bits : int
    known : int
        It is known far better than this grid tells; 0 if nothing is known.
    exponent : int
        Of the first grid on which a proof is not hopeless, if anything is known.
    """

    point: Sequence[tuple[int, int]]
    bits: int
    known: int
    exponent: int


@dataclass(frozen=True, eq=False)
class DoubleBoxes:
    """What doubles prove of approximate solutions.

    Attributes
    ----------
    boxes : list of Box or None
        The box of each point; None where doubles do not suffice.
    points : (p, n) complex array
        Where Newton's method led to from there; the point itself where that is too far off.
    solutions : list of DoubleSolution or None
        Of the real boxes.
    limits : list of Limit or None
        Where points led to for which there is no box.
    """

    boxes: list[Box | None]
    points: Complex
    solutions: list[DoubleSolution | None]
    limits: list[Limit | None]

    @classmethod
    def none(cls, points: Complex) -> DoubleBoxes:
        """Nothing is proved yet."""
        return cls([None] * len(points), points, [None] * len(points), [None] * len(points))

    def parts(self, counts: Sequence[int]) -> list[DoubleBoxes]:
        """Parts of one size, of each the first so many points."""
        size = len(self.boxes) // len(counts)
        places = [slice(size * k, size * k + count) for k, count in enumerate(counts)]
        return [
            DoubleBoxes(self.boxes[place], self.points[place], self.solutions[place], self.limits[place])
            for place in places
        ]


def double_boxes(equations: DoubleEquations, points: Complex, exponent: int) -> DoubleBoxes:
    """The boxes of the solutions near the given points, on the grid 2^-exponent, and on a coarser one where f is large.

    Parameters
    ----------
    equations : DoubleEquations
    points : (p, n) complex array
        Approximate solutions in the equations' chart.
    exponent : int
    """
    found = DoubleBoxes.none(points.copy())
    if len(points):
        with np.errstate(all="ignore"):
            near, has_arrived = _arrived(equations, *real_or_complex(points), exponent)
            found.points[:] = near.points
            doubtful = _add_boxes(equations, near, has_arrived, exponent, found)
            if doubtful.any():
                _add_exact_values(equations, near.points, doubtful, (near.values, near.off))
                _add_boxes(equations, near, has_arrived, exponent, found)
    return found


def real_or_complex(points: Complex) -> tuple[NDArray[Any], NDArray[np.bool_]]:
    """The points, of which those that are not clearly complex become real; which those are."""
    sizes = np.abs(points).max(axis=1, initial=0)
    are_real = ~(np.abs(points.imag).max(axis=1, initial=0) > CLEARLY_COMPLEX * sizes)
    return points.real if are_real.all() else np.where(are_real[:, None], points.real, points), are_real


@dataclass(frozen=True, eq=False)
class _Near:
    """Points near solutions.

    Attributes
    ----------
    begun, points : (p, n) arrays
        From where Newton's method led, and where to.
    are_real : (p,) array of bool
    inverses : (p, n, n) array
        Of F' there or nearby.
    values, off : (p, n) arrays
        F there, and how far that is off at most.
    """

    begun: NDArray[Any]
    points: NDArray[Any]
    are_real: NDArray[np.bool_]
    inverses: NDArray[Any]
    values: NDArray[Any]
    off: Real


def _add_boxes(
    equations: DoubleEquations, near: _Near, decided: NDArray[np.bool_], exponent: int, found: DoubleBoxes
) -> NDArray[np.bool_]:
    """The boxes of those points, at their places in what is found; which may be another with more exact values."""
    points, are_real = near.points, near.are_real
    exponents, units, is_sure = grids_of(equations, points, exponent)
    limits = points - products(near.inverses, near.values)
    grid = np.floor(np.stack([limits.real, limits.imag], axis=-1) / units[:, :, None] + 0.5)
    centres = (grid[..., 0] + 1j * grid[..., 1] if np.iscomplexobj(points) else grid[..., 0]) * units
    place = points - centres, near.values, near.off
    # Inverses at the points serve as well: boxes are far larger than what lies between these and the centres.
    proofs = double_proofs(equations, near.inverses, centres, RADIUS * units, ROOM, place)
    decided = decided & is_sure & proofs.proved & (np.abs(grid) < GREATEST).all(axis=(1, 2))
    distance = np.maximum(np.abs(proofs.moved.real), np.abs(proofs.moved.imag)) + proofs.errors
    are_nearest = (distance < SURE * units).all(axis=1)
    doubtful: NDArray[np.bool_] = decided & ~are_nearest & ~are_real
    decided &= are_nearest
    decided &= (np.abs(near.begun - centres) <= NEAR * 2.0**exponent * units).all(axis=1)
    decided &= are_real | centres.imag.any(axis=1)  # what is real after all is left to others
    chosen = np.flatnonzero(decided)
    rows = zip(exponents[chosen].tolist(), grid[chosen].astype(np.int64).tolist(), strict=True)
    for row, (sizes, numbers) in zip(chosen.tolist(), rows, strict=True):
        box = box_at(sizes, numbers, equations.support)
        found.boxes[row] = box
        if box.is_real:
            found.solutions[row] = DoubleSolution(points[row].real, proofs.steps[row].real, proofs.errors[row])
    return doubtful


def _arrived(
    equations: DoubleEquations, begun: NDArray[Any], are_real: NDArray[np.bool_], exponent: int
) -> tuple[_Near, NDArray[np.bool_]]:
    """Where Newton's method leads until steps are far smaller than units, and where it does so.

    Real points get more exact values of F: coordinates of poses follow from them. Others do where there is a doubt.
    """
    inverses = inverses_at(equations, begun, are_real)
    points = newton_step(equations, begun, inverses)
    values, off = equations.values_at(points)
    _add_exact_values(equations, points, are_real, (values, off))
    units = grids_of(equations, points, exponent)[1]
    steps = products(inverses, values)
    sizes = (np.abs(steps) / units).max(axis=1)
    blurs = products(np.abs(inverses), off)
    moves = np.where(are_real, ~(sizes < SETTLED), ~(sizes < ARRIVED) | _are_doubtful(points - steps, blurs, units))
    is_hopeless = np.zeros(len(points), dtype=np.bool_)
    if moves.any():
        rows = equations.places(np.flatnonzero(moves), len(points))
        widths = _widths(equations, inverses[rows], units[rows], are_real[rows])
        is_hopeless[rows] = widths > HOPELESS
        # How far off a solution may be is in proportion to both.
        moves[rows] &= ~is_hopeless[rows] & ~(are_real[rows] & (sizes[rows] < ARRIVED) & (sizes[rows] * widths < EXACT))
    for _ in range(STEPS - 1):
        left = np.flatnonzero(moves)
        if not len(left):
            break
        points[left] -= steps[left]
        rows = equations.places(left, len(points))
        inverses[rows] = inverses_at(equations, points[rows], are_real[rows])
        _add_exact_values(equations, points, moves, (values, off))
        steps[left] = products(inverses[left], values[left])
        sizes[left] = (np.abs(steps[left]) / units[left]).max(axis=1)
        moves[left] = ~(sizes[left] < SETTLED)
    is_near = (np.abs(points - begun) <= ASTRAY * np.abs(begun).max(axis=1, keepdims=True)).all(axis=1)
    has_arrived = is_near & (sizes < ARRIVED) & ~is_hopeless
    points = np.where(has_arrived[:, None], points, begun)
    return _Near(begun, points, are_real, inverses, values, off), has_arrived


def _are_doubtful(points: NDArray[Any], blurs: Real, units: Real) -> NDArray[np.bool_]:
    """Where it is in doubt, by so much, which point of the grid is nearest."""
    places = points / units
    beside = places - np.rint(places)
    apart = np.maximum(np.abs(beside.real), np.abs(beside.imag)) + SLACK * blurs / units
    found: NDArray[np.bool_] = np.logical_not((apart < SURE).all(axis=1))
    return found


def _add_exact_values(
    equations: DoubleEquations,
    points: NDArray[Any],
    chosen: NDArray[np.bool_],
    found: tuple[NDArray[Any], Real],
) -> None:
    """Values of F, and how far they are off, where points are chosen: to twice as many bits, but for one rounding."""
    rows = np.flatnonzero(chosen)
    if len(rows):
        for values, better in zip(found, equations.forms.at(points, rows), strict=True):
            values[rows] = better


def _widths(equations: DoubleEquations, inverses: NDArray[Any], units: Real, are_real: NDArray[np.bool_]) -> Real:
    """How wide Y F'(X) is in the largest coordinate, by the radii of X, roughly."""
    radii, sizes = RADIUS * units, np.abs(inverses.real) + np.abs(inverses.imag)
    widths = products(sizes, products(equations.variations(radii), radii)) / radii
    found: Real = widths.max(axis=1) * np.where(are_real, 1, 2)
    return found


def inverses_at(equations: DoubleEquations, points: NDArray[Any], are_real: NDArray[np.bool_]) -> NDArray[Any]:
    """Those of F', real at points that are real."""
    inverses = inverses_of(equations.jacobians(points))
    if np.iscomplexobj(inverses):
        inverses.imag[are_real] = 0
    return inverses


def grids_of(
    equations: DoubleEquations, points: NDArray[Any], exponent: int | NDArray[np.intp]
) -> tuple[NDArray[np.intp], Real, NDArray[np.bool_]]:
    """The exponents of the grids of e and f, (p, 2), as ``certification`` chooses them; units; whether it is sure.

    That of e is given, for all or for each point.
    """
    halves, members = _halves(tuple(equations.support))
    largest = np.abs(points)
    if np.iscomplexobj(points):
        largest = np.maximum(np.abs(points.real), np.abs(points.imag))
    sizes = np.zeros((2, len(points)))
    for size, places in zip(sizes, members, strict=True):
        if len(places):
            largest[:, places].max(axis=1, out=size)
    limits = (1 + 2.0**-NEARLY_BITS) * np.array([[1 - DOUBT], [1 + DOUBT]])
    bits = np.frexp(sizes[:, None] * limits)[1]
    if not (sizes > 0).all():
        # Turns about a point have no f; where there are f and they are 0, they are very small.
        smallest = [-GREATEST_SHIFT if len(places) else 0 for places in members]
        bits = np.where(sizes[:, None] > 0, bits, np.array(smallest)[:, None, None])
    (e, also_e), (f, also_f) = bits
    shifts = np.maximum(f - also_e, 0)
    is_sure = (shifts == np.maximum(also_f - e, 0)) & np.isfinite(sizes).all(axis=0) & (sizes[0] > 0)
    exponents = np.empty((len(points), 2), dtype=np.intp)
    exponents[:, 0], exponents[:, 1] = exponent, np.maximum(exponent - shifts, 0)
    return exponents, np.ldexp(1.0, -exponents)[:, halves], is_sure


@lru_cache(maxsize=16)
def _halves(support: tuple[int, ...]) -> tuple[NDArray[np.intp], tuple[NDArray[np.intp], NDArray[np.intp]]]:
    """Of each coordinate whether it is one of f, and the places of those of e and of f."""
    halves = np.array(support) // 4
    return halves, (np.flatnonzero(halves == 0), np.flatnonzero(halves == 1))


def box_at(exponents: Sequence[int], grid: Sequence[Sequence[int]], support: Sequence[int]) -> Box:
    """Of the box and its conjugate, the one whose first coordinate that is not real has a positive imaginary part."""
    real, imaginary = zip(*grid, strict=True)
    is_turned = any(imaginary) and next(filter(None, imaginary)) < 0
    pairs = zip(real, map(neg, imaginary) if is_turned else imaginary, strict=True)
    if len(support) == 8:
        return Box((exponents[0], exponents[1]), tuple(pairs))
    centre = [(0, 0)] * 8
    for index, pair in zip(support, pairs, strict=True):
        centre[index] = pair
    return Box((exponents[0], exponents[1]), tuple(centre))
