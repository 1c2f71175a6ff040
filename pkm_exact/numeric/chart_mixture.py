"""The equations of a chart, mixed so that |C|^2 is left in one of them only: in doubles, and exactly at integers.

Far out the legs' equations are nearly the same: all have |C|^2, which drowns the rest, and their inverse derivatives
cancel it again, in doubles to a few digits. With G = A F, A regular, Y G = (Y A) F for all Y: Krawczyk's operator is
the same, and what is proved of G is proved of F.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import gcd

import numpy as np
from flint import fmpz, fmpz_mat
from numpy.typing import NDArray

from pkm_exact.numeric.double_forms import DoubleForms
from pkm_exact.numeric.double_krawczyk import DoubleEquations
from pkm_exact.numeric.study_system import Real

Quadric = Mapping[tuple[int, int], int]
Integers = list[list[tuple[int, int]]]
"""For each point its coordinates, real and imaginary parts, in some unit."""


@dataclass(frozen=True, eq=False)
class MixedEquations:
    """G = A F.

    Attributes
    ----------
    equations : DoubleEquations
        G in doubles.
    mixing : (n, n) array
        A, for the equations as they are scaled in doubles; rounded.
    chart : sequence of n int
        w in w.e = 1, which is the last equation, by places in the support.
    monomials : list of pairs of int
        Those of the other equations, all of degree 2.
    coefficients : fmpz_mat
        (n - 1, m): theirs.
    """

    equations: DoubleEquations
    mixing: Real
    chart: Sequence[int]
    monomials: list[tuple[int, int]]
    coefficients: fmpz_mat

    @classmethod
    def of(
        cls, original: DoubleEquations, quadrics: Sequence[Quadric], chart: Sequence[int], kinds: Sequence[int]
    ) -> MixedEquations:
        """From quadrics over the integers, in places of the support.

        Raises
        ------
        OverflowError
            If a number is too large for doubles.
        ValueError
            If one quadric is a multiple of another.
        """
        size = len(chart)
        weights = _weights(quadrics, kinds.index(1) if 1 in kinds else size)
        mixed = [_combination(row, quadrics) for row in weights]
        if not all(mixed):
            raise ValueError("dependent quadrics")
        last = {(place, size): weight for place, weight in enumerate(chart) if weight} | {(size, size): -1}
        forms = DoubleForms.of([*mixed, last], [*kinds, 0])
        mixing = np.eye(size)
        mixing[:-1, :-1] = weights
        mixing = np.ldexp(mixing, original.forms.powers[None, :] - forms.powers[:, None])
        monomials = sorted({place for quadric in mixed for place in quadric})
        coefficients = fmpz_mat([[quadric.get(place, 0) for place in monomials] for quadric in mixed])
        equations = DoubleEquations(original.support, forms, original.norm)
        return cls(equations, mixing, chart, monomials, coefficients)

    def values(self, points: Integers, bits: int) -> NDArray[np.complex128]:
        """(p, n): G at points in units of 2^-bits, scaled as in doubles; both parts are rounded once.

        Raises
        ------
        OverflowError
            If a value is too large for doubles.
        """
        large = [[(fmpz(a), fmpz(b)) for a, b in x] for x in points]
        products = fmpz_mat([[part for x in large for part in _product(*x[i], *x[j])] for i, j in self.monomials])
        rows = [[float(int(value)) for value in row] for row in (self.coefficients * products).tolist()]
        found = np.ldexp(np.array(rows).T.reshape(len(points), 2, -1), -2 * bits - self.equations.forms.powers[:-1])
        unit = 1 << bits
        sums = [
            (sum(w * a for w, (a, _) in zip(self.chart, x, strict=True)) - unit, _imaginary(self.chart, x))
            for x in points
        ]
        last = np.ldexp(np.array(sums, dtype=np.float64), -bits - int(self.equations.forms.powers[-1]))
        parts = np.concatenate([found, last[:, :, None]], axis=2)
        values: NDArray[np.complex128] = parts[:, 0] + 1j * parts[:, 1]
        return values


def _imaginary(chart: Sequence[int], x: Sequence[tuple[int, int]]) -> int:
    return sum(w * b for w, (_, b) in zip(chart, x, strict=True))


def _product(a: fmpz, b: fmpz, c: fmpz, d: fmpz) -> tuple[fmpz, fmpz]:
    """(a + b i) (c + d i)."""
    return a * c - b * d, a * d + b * c


def _weights(quadrics: Sequence[Quadric], first: int) -> list[list[int]]:
    """The matrix A that takes the square of the first coordinate of f out of all quadrics but one."""
    squares = [quadric.get((first, first), 0) for quadric in quadrics]
    rows = [[int(i == j) for j in range(len(quadrics))] for i in range(len(quadrics))]
    pivot = next((place for place, value in enumerate(squares) if value), None)
    for place, value in enumerate(squares):
        if value and pivot is not None and place != pivot:
            common = gcd(value, squares[pivot])
            rows[place][place], rows[place][pivot] = squares[pivot] // common, -value // common
    return rows


def _combination(weights: Sequence[int], quadrics: Sequence[Quadric]) -> dict[tuple[int, int], int]:
    found: dict[tuple[int, int], int] = {}
    for weight, quadric in zip(weights, quadrics, strict=True):
        if weight:
            for place, value in quadric.items():
                found[place] = found.get(place, 0) + weight * value
    return {place: value for place, value in found.items() if value}
