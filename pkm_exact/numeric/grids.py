"""Grids on which the centres of boxes lie: one for e, and one for f that is coarser where f is larger."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, TypeAlias

from flint import acb, acb_mat

from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.double_boxes import NEARLY_BITS
from pkm_exact.poses.isolated_solutions import Box

GRIDS: Final = (28, 44, 72, 120, 200, 340, 600, 1000)
"""Exponents of the grids of e, tried one after another."""

WIDEST: Final = 0.55
"""Widths of a box, by its radii, above which it is not tried (``first_grid``)."""

Dyadic: TypeAlias = tuple[tuple[int, int], tuple[int, int]]
"""Real and imaginary part, each an integer and the exponent of 2 that goes with it."""


def first_grid(width: float, grid: int) -> int:
    """The first grid that is tried for a solution, from the width w of Y F'(X) by the radii of X, on one of the grids.

    With Y the inverse of F' at the solution, the centre m of its box is within half a unit, 1 / 8 of the radii: Y F'(m)
    = 1 + E with |E| <= w / 8, and with the inverse at m the width is w / (1 + w / 8) at least. With another matrix Y'
    it is smaller by |1 - Y' F'(m)| at most, which counts as well. More than 1 / 2 is not borne, so that no proof would
    succeed where w > 0.54. Widths are computed without proof: what depends on them is how fine boxes are, no more.
    """
    return next((exponent for exponent in GRIDS if width * 2.0 ** (grid - exponent) <= WIDEST), GRIDS[-1])


def nearest_box(system: ChartSystem, point: acb_mat, exponent: int) -> Box:
    """The box around the grid point nearest to a point; of it and its conjugate, the one whose first coordinate that is
    not real has a positive imaginary part."""
    values = {index: dyadic(value) for index, value in zip(system.support, point.entries(), strict=True)}
    exponents = grid_exponents(system, list(values.values()), exponent)
    centre = []
    for index in range(8):
        real, imaginary = values.get(index, ((0, 0), (0, 0)))
        centre.append((_rounded(*real, exponents[index // 4]), _rounded(*imaginary, exponents[index // 4])))
    sign = next((-1 if imaginary < 0 else 1 for _, imaginary in centre if imaginary), 1)
    return Box(exponents, tuple((real, sign * imaginary) for real, imaginary in centre))


def dyadic(value: acb) -> Dyadic:
    """The midpoints of real and imaginary part, exactly."""
    parts = [part.mid().man_exp() for part in (value.real, value.imag)]
    real, imaginary = [(int(mantissa), int(exponent)) for mantissa, exponent in parts]
    return real, imaginary


def size_exponent(parts: Sequence[tuple[int, int]]) -> int:
    """The binary exponent of a number's size, roughly; that of 0 is very small."""
    sizes = [exponent + _lifted(abs(mantissa)).bit_length() for mantissa, exponent in parts if mantissa]
    return max([-GRIDS[-1], *sizes])


def _lifted(mantissa: int) -> int:
    """A little more: what is a power of 2 counts as one, from whichever side it is approximated."""
    return mantissa + (mantissa >> NEARLY_BITS)


def _rounded(mantissa: int, power: int, exponent: int) -> int:
    """The integer nearest to mantissa times 2^power, in units of 2^-exponent."""
    shift = power + exponent
    return mantissa << shift if shift >= 0 else ((mantissa >> (-shift - 1)) + 1) >> 1


def grid_exponents(system: ChartSystem, values: Sequence[Dyadic], exponent: int) -> tuple[int, int]:
    """The exponents of the grids of e and f: that of f is coarser where f is larger."""
    places = list(zip(system.support, values, strict=True))
    # Turns about a point have no f.
    e, f = (max((size_exponent(value) for k, value in places if k // 4 == half), default=0) for half in (0, 1))
    return exponent, max(0, exponent - max(0, f - e))
