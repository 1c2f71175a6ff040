r"""Matrices of polynomials that are regular all over a box, proved in doubles for many boxes at once.

With the Bernstein coefficients b of the entries of M, those of C M are combinations of them, whatever the matrix C. Let
E be the greatest absolute values of the coefficients of I - C M. If a vector v > 0 has E v < v, the spectral radius
of E is below 1, so that I - (I - C M) is regular at every point, and M with it. C is an approximate inverse of
the middle of the intervals in which the entries of M lie. A row with a root y in it is linear in y: each of its
contributions to a coefficient of C M is between those at both ends of y, and rows have different roots.

References: Rex and Rohn, "Sufficient conditions for regularity and singularity of interval matrices", SIAM J. Matrix
Anal. Appl. 20 (1998); Merlet, Parallel Robots (2006), on regularity of Jacobians over workspaces.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.regions.bernstein import UNIT, Pair, Real, bernstein_coefficients, error_factor, on_sub_boxes

_SLACK: Final = 1 + 2.0**-30
"""Room for the rounding of bounds themselves."""
_LEAST: Final = 2.0**-900
_BELOW_ONE: Final = 1 - 2.0**-20
_SQUARINGS: Final = 5
_NOTHING: Final = -1000
"""The exponent of what is 0, or all but 0."""


@dataclass(frozen=True, eq=False)
class Column:
    """A column of a matrix, all entries with the same degrees.

    Attributes
    ----------
    degrees : tuple of int
    tensor : array (n, 2, ..)
        Coefficients of y^0 and y^1, y the root of the row.
    sizes : array (n, 2)
        Bounds of their absolute values.
    """

    degrees: tuple[int, ...]
    tensor: Real
    sizes: Real


@dataclass(frozen=True, eq=False)
class CompiledMatrix:
    """A matrix on the box of a chart, its rows and columns multiplied by powers of two.

    Attributes
    ----------
    columns : tuple of Column
    roots : tuple of int or None
        For each row the place of its root.
    """

    columns: tuple[Column, ...]
    roots: tuple[int | None, ...]

    @property
    def size(self) -> int:
        """How many coefficients it has."""
        return sum(column.tensor.size for column in self.columns)


def compiled_matrix(rows: Sequence[Sequence[Any]], box: Sequence[Pair], scales: Sequence[int]) -> CompiledMatrix:
    """A matrix of polynomials of a chart and roots, in doubles.

    Parameters
    ----------
    rows : sequence of sequences of fmpq_mpoly
    box : sequence of pairs of Fraction
        Of the variables of the chart, which come first.
    scales : sequence of int
        y_i is taken in units of 2^scale.
    """
    count, size = len(box), len(rows)
    degrees = [[[max(0, int(d)) for d in entry.degrees()] for entry in row] for row in rows]
    roots = tuple(
        next((k for k in range(len(scales)) if any(entry[count + k] for entry in row)), None) for row in degrees
    )
    exact: list[tuple[tuple[int, ...], list[list[list[Fraction]]]]] = []
    for j in range(size):
        wide = tuple(max(degrees[k][j][v] for k in range(size)) for v in range(count))
        exact.append((wide, [_parts(rows[k][j], wide, box, scales, roots[k]) for k in range(size)]))
    across = [_exponent([part for entry in entries for part in entry]) for _, entries in exact]
    along = [max(_exponent(exact[j][1][k]) - across[j] for j in range(size)) for k in range(size)]
    columns = []
    for (wide, entries), shift in zip(exact, across, strict=True):
        units = [Fraction(2) ** -(shift + more) for more in along]
        scaled = [
            [[value * unit if value else value for value in part] for part in entry]
            for entry, unit in zip(entries, units, strict=True)
        ]
        tensor = np.array([[list(map(float, part)) for part in entry] for entry in scaled])
        least = [[_LEAST if any(part) else 0.0 for part in entry] for entry in scaled]
        sizes = np.maximum(np.abs(tensor).max(axis=-1), least) * _SLACK
        columns.append(Column(wide, tensor.reshape(size, 2, *(d + 1 for d in wide)), sizes))
    return CompiledMatrix(tuple(columns), roots)


def _parts(
    entry: Any, degrees: Sequence[int], box: Sequence[Pair], scales: Sequence[int], root: int | None
) -> list[list[Fraction]]:
    """The coefficients of y^0 and of y^1."""
    count = len(box)
    found: list[dict[tuple[int, ...], Any]] = [{}, {}]
    for exponents, coefficient in entry.to_dict().items():
        powers = tuple(map(int, exponents))
        found[0 if root is None else powers[count + root]][powers[:count]] = coefficient
    unit = Fraction(1) if root is None else Fraction(2) ** scales[root]
    constant, slope = (bernstein_coefficients(terms, degrees, box) for terms in found)
    return [constant, [value * unit if value else value for value in slope]]


def _exponent(parts: Sequence[Sequence[Fraction]]) -> int:
    value = max((abs(x) for part in parts for x in part if x), default=Fraction(0))
    return value.numerator.bit_length() - value.denominator.bit_length() if value else _NOTHING


def proved_regular(
    matrix: CompiledMatrix, ways: Sequence[Sequence[Real]], ends: Sequence[tuple[Real, Real]]
) -> NDArray[np.bool_]:
    """Whether a matrix is proved to be regular all over each of many boxes.

    Checkers take the inverse of the middle exactly, with its first 48 digits: what that changes is added to E, so that
    their test holds where this one does (but for the ends of roots near 0, which are a little wider here).

    Parameters
    ----------
    matrix : CompiledMatrix
    ways : sequence of sequences of arrays
        For each column the matrices of each variable that lead to the boxes (``bernstein.subdivision_matrices``).
    ends : sequence of pairs of arrays
        Bounds of the roots over the boxes, each in its unit.
    """
    tables = [_ends_of(column, matrix.roots, way, ends) for column, way in zip(matrix.columns, ways, strict=True)]
    middle = np.stack([(low.min(axis=2) + high.max(axis=2)) / 2 for low, high, _ in tables], axis=2)
    off = np.stack([error for _, _, error in tables], axis=2)
    with np.errstate(all="ignore"):
        return _is_regular(tables, middle, off)


def _is_regular(tables: Sequence[tuple[Real, Real, Real]], middle: Real, off: Real) -> NDArray[np.bool_]:
    solvable = np.abs(np.linalg.det(middle)) > 0
    eye = np.eye(len(tables))
    inverse = np.linalg.inv(np.where(solvable[:, None, None], middle, eye))
    sizes = np.abs(inverse)
    greatest = np.stack([np.maximum(np.abs(low), np.abs(high)).max(axis=2) for low, high, _ in tables], axis=2) + off
    product = sizes @ greatest
    far = np.stack([_farthest(inverse, low, high, eye[:, j]) for j, (low, high, _) in enumerate(tables)], axis=2)
    few = 4 * (len(eye) + 8) * UNIT
    # How far the inverse is from that of the true middle, (R + R^2 + ..) C, and what that and rounding can change.
    rest = np.abs(eye - inverse @ middle) + few * (eye + product) + sizes @ off
    near = rest.sum(axis=2).max(axis=1) < 0.1
    rest = np.broadcast_to(rest.max(axis=1, keepdims=True), rest.shape)
    apart = far + sizes @ off + few * (1 + product) + (2 * rest + 2.0**-45 * eye) @ product
    found: NDArray[np.bool_] = solvable & near & (_radius(apart * _SLACK) < _BELOW_ONE)
    return found


def _ends_of(
    column: Column, roots: Sequence[int | None], ways: Sequence[Real], ends: Sequence[tuple[Real, Real]]
) -> tuple[Real, Real, Real]:
    """The lower and the upper of both ends of y, by boxes, rows and coefficients, and how far they are off."""
    found = on_sub_boxes(column.tensor, ways, first=2)
    found = found.reshape(*found.shape[:3], -1)
    factor = (error_factor(column.degrees) + 16 * UNIT) * _SLACK
    constant, slope = found[:, :, 0], found[:, :, 1]
    sizes = np.broadcast_to(column.sizes[:, 0], constant.shape[:2]).copy()
    low = high = constant
    if any(root is not None for root in roots):
        low, high = constant.copy(), constant.copy()
        for row, root in enumerate(roots):
            if root is not None:
                one, other = (constant[:, row] + slope[:, row] * end[:, None] for end in ends[root])
                low[:, row], high[:, row] = np.minimum(one, other), np.maximum(one, other)
                sizes[:, row] += column.sizes[row, 1] * ends[root][1]
    return low, high, sizes * factor


def _farthest(inverse: Real, low: Real, high: Real, unit: Real) -> Real:
    """For each box and row of C M the greatest |delta - coefficient| in a column."""
    if low is high:
        found: Real = np.abs(unit[:, None] - inverse @ low).max(axis=2)
        return found
    positive, negative = np.maximum(inverse, 0), np.minimum(inverse, 0)
    least, greatest = positive @ low + negative @ high, positive @ high + negative @ low
    farthest: Real = np.maximum(np.abs(unit[:, None] - least), np.abs(unit[:, None] - greatest)).max(axis=2)
    return farthest


def _radius(matrices: Real) -> Real:
    """Bounds of the spectral radii of matrices without negative entries (Collatz and Wielandt)."""
    powers = matrices + np.eye(matrices.shape[-1])
    for _ in range(_SQUARINGS):
        powers = powers / powers.max(axis=(1, 2), keepdims=True)
        powers = powers @ powers
    vectors = powers.sum(axis=2) + 2.0**-200
    bounds: Real = ((matrices @ vectors[:, :, None])[:, :, 0] / vectors).max(axis=1)
    return bounds
