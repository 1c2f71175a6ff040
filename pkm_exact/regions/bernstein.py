r"""Polynomials on boxes: their Bernstein coefficients, exactly and for many boxes at once in floating point.

On [0, 1]^k a polynomial of degrees d is sum_i b_i B_i, B_i the products of C(d, i) u^i (1 - u)^(d - i); these are not
negative and their sum is 1, so that all its values lie between the least and the greatest b_i, and b at the corners are
values. On [a, b] inside [0, 1] the coefficients of one variable are

    b'_i = sum_l M_il b_l,   M_il = sum_(r + s = l) C(d - i, r) a^r (1 - a)^(d - i - r) C(i, s) b^s (1 - b)^(i - s)

with M_il >= 0 and row sums 1. In doubles, with a and b dyadic, each M_il is a sum of products of non-negative numbers:
its relative error is below (4 d + 8) u, u = 2^-53; the sum over l adds (d + 1) u times the greatest |b_l|. So one
variable adds at most (6 d + 16) u times the greatest coefficient to the error, whatever the box.

Reference: Garloff, "The Bernstein algorithm", Interval Computations 2 (1993).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from math import comb
from typing import Any, TypeAlias

import numpy as np
from flint import fmpq, fmpq_mat
from numpy.typing import NDArray

Real: TypeAlias = NDArray[np.float64]
Pair: TypeAlias = tuple[Fraction, Fraction]

UNIT = 2.0**-53


def bernstein_coefficients(
    terms: Mapping[tuple[int, ...], fmpq], degrees: Sequence[int], box: Sequence[Pair]
) -> list[Fraction]:
    """The Bernstein coefficients on a box, exactly, the last variable's index running first.

    Parameters
    ----------
    terms : mapping
        Exponents of the variables, and coefficients.
    degrees : sequence of int
        At least those of the polynomial.
    box : sequence of pairs of Fraction

    Examples
    --------
    >>> [str(b) for b in bernstein_coefficients({(2,): fmpq(1)}, [2], [(Fraction(-1), Fraction(1))])]
    ['1', '-1', '1']
    """
    shape = [d + 1 for d in degrees]
    size = int(np.prod(shape)) if shape else 1
    if not terms:
        return [Fraction(0)] * size
    values = [fmpq(0)] * size
    for exponents, coefficient in terms.items():
        place = 0
        for exponent, length in zip(exponents, shape, strict=True):
            place = place * length + exponent
        values[place] = coefficient
    for degree, pair in zip(degrees, box, strict=True):
        # One variable after the other: its index becomes that of columns' end, and the next one comes to the front.
        matrix = _conversion(degree, pair)
        table = matrix * fmpq_mat(degree + 1, size // (degree + 1), values)
        values = table.transpose().entries()
    return [Fraction(int(value.p), int(value.q)) for value in values]


@lru_cache(64)
def _conversion(degree: int, pair: Pair) -> fmpq_mat:
    """From powers of x to Bernstein coefficients in u, x = low + (high - low) u."""
    low, width = pair[0], pair[1] - pair[0]
    rows = []
    for i in range(degree + 1):
        row = []
        for power in range(degree + 1):
            total = sum(
                (
                    Fraction(comb(i, j), comb(degree, j)) * comb(power, j) * low ** (power - j) * width**j
                    for j in range(min(i, power) + 1)
                ),
                Fraction(0),
            )
            row.append(fmpq(total.numerator, total.denominator))
        rows.append(row)
    return fmpq_mat(rows)


def subdivision_matrices(degree: int, left: Real, right: Real) -> Real:
    """The matrices M for many intervals [a, b], shape (n, d + 1, d + 1).

    Examples
    --------
    >>> subdivision_matrices(1, np.array([0.0]), np.array([0.5]))[0].tolist()
    [[1.0, 0.0], [0.5, 0.5]]
    """
    powers = [(_powers(left, degree), _powers(1 - left, degree)), (_powers(right, degree), _powers(1 - right, degree))]
    found = np.zeros((len(left), degree + 1, degree + 1))
    for i in range(degree + 1):
        for r in range(degree - i + 1):
            first = comb(degree - i, r) * powers[0][0][r] * powers[0][1][degree - i - r]
            for s in range(i + 1):
                found[:, i, r + s] += first * (comb(i, s) * powers[1][0][s] * powers[1][1][i - s])
    return found


def _powers(values: Real, degree: int) -> list[Real]:
    found = [np.ones_like(values)]
    for _ in range(degree):
        found.append(found[-1] * values)
    return found


def error_factor(degrees: Sequence[int]) -> float:
    """By what share of the greatest coefficient those of a sub-box are off, at most."""
    return UNIT * sum(6 * d + 16 for d in degrees)


def on_sub_boxes(tensor: Real, matrices: Sequence[Real], *, first: int) -> Real:
    """The coefficients on many boxes: the matrices of each variable applied to its axis.

    Parameters
    ----------
    tensor : array
        Coefficients on the whole box; ``first`` axes that are left alone, then one per variable.
    matrices : sequence of arrays (n, d + 1, d + 1)
        One for each variable.
    first : int

    Returns
    -------
    array (n, ..)
    """
    count = len(matrices[0]) if matrices else 1
    found: Any = np.broadcast_to(tensor, (count, *tensor.shape))
    for place, matrix in enumerate(matrices):
        axis = 1 + first + place
        moved = np.moveaxis(found, axis, 1)
        shape = moved.shape
        product = np.matmul(matrix, moved.reshape(count, shape[1], -1))
        found = np.moveaxis(product.reshape(shape), 1, axis)
    return np.ascontiguousarray(found)
