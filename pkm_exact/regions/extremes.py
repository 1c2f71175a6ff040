"""The least and the greatest value of a quotient of polynomials over the good poses of a region, enclosed.

With p = sum of w_j p_j and q = sum of w_j q_j in the same Bernstein basis, weights not negative and all q_j positive,
p / q lies between the least and the greatest p_j / q_j. Roots y_i, in which both are linear, add the corners of their
intervals.

Parts in which no pose is good are dropped, and those where the bound is no better than what is reached elsewhere: in a
part all of whose poses are good, all values lie within its bounds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import inf
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.regions.bernstein import UNIT, Pair, Real
from pkm_exact.regions.chart import Polynomial
from pkm_exact.regions.compiled_formula import Compiled, CompiledFormula, View, compiled, degrees_of
from pkm_exact.regions.paving import depths_at
from pkm_exact.roots.interval import Interval

_ROOM: Final = 8 * UNIT
"""Relative, of a sum, a difference and a quotient."""
_NUMBERS_AT_ONCE: Final = 1 << 21


@dataclass(frozen=True, eq=False)
class Quotient:
    """A quotient of polynomials, of a chart's variables and of the roots of a formula.

    Attributes
    ----------
    numerator, denominator : fmpq_mpoly
        The latter positive at good poses; nothing is proved where that is not seen.
    size : float
        What is small beside it need not be known to the same relative precision.
    """

    numerator: Polynomial
    denominator: Polynomial
    size: float = 0.0


@dataclass(frozen=True)
class Extreme:
    """The greatest or the least value over the good poses of a region.

    Attributes
    ----------
    value : Interval
        It lies in it.
    where : tuple of pairs of Fraction
        A box that holds every pose with this value.
    is_precise : bool
        Whether it is enclosed to the precision asked for.
    """

    value: Interval
    where: tuple[Pair, ...]
    is_precise: bool


class _Values:
    """A quotient over many boxes at once."""

    def __init__(self, quotient: Quotient, formula: CompiledFormula, box: Sequence[Pair]) -> None:
        above, below = degrees_of(quotient.numerator), degrees_of(quotient.denominator)
        degrees = [max(pair) for pair in zip(above, below, strict=True)]
        self._formula = formula
        self._above: Compiled = compiled(quotient.numerator, box, formula.scales, degrees)
        self._below: Compiled = compiled(quotient.denominator, box, formula.scales, degrees)
        self._scale = 2.0 ** (self._above.exponent - self._below.exponent)
        self.size = max(1, self._above.tensor.size)

    def bounds(self, view: View, ends: Any) -> tuple[Real, Real]:
        """Below and above the values in each box."""
        above, error = self._formula_free(view, self._above, ends)
        below, wrong = self._formula_free(view, self._below, ends)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            least, most = below - wrong, below + wrong
            lows, highs = above - error, above + error
            low = np.where(lows >= 0, lows / most, lows / least).min(axis=1)
            high = np.where(highs >= 0, highs / least, highs / most).max(axis=1)
        positive = (least > 0).all(axis=1)
        low = np.where(positive, _outward(low * self._scale, -1), -inf)
        high = np.where(positive, _outward(high * self._scale, 1), inf)
        return np.where(np.isnan(low), -inf, low), np.where(np.isnan(high), inf, high)

    @staticmethod
    def _formula_free(view: View, part: Compiled, ends: Any) -> tuple[Real, Real]:
        values, error = view.coefficients_of(part, ends)
        return values, np.broadcast_to(error[:, None] if error.ndim else error, values.shape)


def _outward(values: Real, way: int) -> Real:
    return values + way * (np.abs(values) * _ROOM + 2.0**-1000)


def greatest(
    quotient: Quotient,
    formula: CompiledFormula,
    box: Sequence[Pair],
    axes: Sequence[int],
    *,
    precision: Fraction,
    boxes: int,
    sign: int = 1,
) -> Extreme | None:
    """The greatest value, or with ``sign`` -1 the least; None if no pose is shown to be good, or there is no bound.

    Parameters
    ----------
    quotient : Quotient
    formula : CompiledFormula
        Holds at good poses.
    box : sequence of pairs of Fraction
    axes : sequence of int
        Along which variable the parts of each depth are halved.
    precision : Fraction
        Of the enclosure, as a share of the value, or of the quotient's size if that is greater.
    boxes : int
        Parts that may be open at a time.
    """
    values = _Values(quotient, formula, box)
    places: NDArray[np.int64] = np.zeros((1, len(box)), dtype=np.int64)
    best, depth = -inf, 0
    while True:
        depths = depths_at(axes, depth, len(box))
        low, high, truths = _batched(values, formula, depths, places, sign)
        best = max(best, float(low[truths > 0].max(initial=-inf)))
        kept = (truths >= 0) & (high >= best)
        places, high = places[kept], high[kept]
        most = max(best, float(high.max(initial=-inf)))
        narrow = best > -inf and most - best <= float(precision) * max(abs(most), abs(best), quotient.size)
        if narrow or depth == len(axes) or len(places) > boxes or not len(places):
            break
        axis, depth = axes[depth], depth + 1
        places = np.repeat(places, 2, axis=0)
        places[:, axis] *= 2
        places[1::2, axis] += 1
    if best == -inf or most == inf:
        return None
    ends = sorted((sign * Fraction(best), sign * Fraction(most)))
    return Extreme(Interval(*ends), _hull(box, depths, places), bool(narrow))


def _batched(
    values: _Values, formula: CompiledFormula, depths: Sequence[int], places: NDArray[np.int64], sign: int
) -> tuple[Real, Real, NDArray[np.int8]]:
    size = max(1, _NUMBERS_AT_ONCE // max(values.size, formula.numbers))
    found = []
    for start in range(0, len(places), size):
        view = View(depths, places[start : start + size])
        low, high = values.bounds(view, formula.root_ends(view))
        found.append((low, high, formula.truths_in(view)) if sign > 0 else (-high, -low, formula.truths_in(view)))
    low, high, truths = (np.concatenate(part) for part in zip(*found, strict=True))
    return low, high, truths


def _hull(box: Sequence[Pair], depths: Sequence[int], places: NDArray[np.int64]) -> tuple[Pair, ...]:
    """The box around open parts; the whole one if there is none."""
    if not len(places):
        return tuple(box)
    ends = zip(places.min(axis=0).tolist(), places.max(axis=0).tolist(), strict=True)
    found = []
    for (low, high), (first, last), depth in zip(box, ends, depths, strict=True):
        width = (high - low) / 2**depth
        found.append((low + first * width, low + (last + 1) * width))
    return tuple(found)
