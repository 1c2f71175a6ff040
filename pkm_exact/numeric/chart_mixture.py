"""The equations of a chart, mixed so that |C|^2 is left in one of them only, in doubles.

Far out the legs' equations are nearly the same: all have |C|^2, which drowns the rest, and their inverse derivatives
cancel it again, in doubles to a few digits. With G = A F, A regular, Y G = (Y A) F for all Y: Krawczyk's operator is
the same, and what is proved of G is proved of F.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import gcd

import numpy as np

from pkm_exact.numeric.double_forms import DoubleForms
from pkm_exact.numeric.double_krawczyk import DoubleEquations
from pkm_exact.numeric.study_system import Real

Quadric = Mapping[tuple[int, int], int]


@dataclass(frozen=True, eq=False)
class MixedEquations:
    """G = A F.

    Attributes
    ----------
    equations : DoubleEquations
        G in doubles.
    mixing : (n, n) array
        A, for the equations as they are scaled in doubles; rounded.
    """

    equations: DoubleEquations
    mixing: Real

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
        forms = DoubleForms.of([*mixed, last])
        mixing = np.eye(size)
        mixing[:-1, :-1] = weights
        mixing = np.ldexp(mixing, original.forms.powers[None, :] - forms.powers[:, None])
        return cls(DoubleEquations(original.support, forms, original.norm), mixing)


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
