"""That a matrix of polynomials is regular all over a part, of region certificates of version 2: exactly, in integers.

The matrix is that of the wrenches, of which ``no_type_2`` takes the determinant; the condition is called "regular". Its
section in ``docs/certificates-regions.md`` defines the test, and says why it is one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import comb, lcm
from typing import Any, Final

import numpy as np
from flint import fmpq, fmpq_mat, fmpz, fmpz_mat

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.region_ring import RegionRing, number_words, polynomial_words, size_factor

DIGITS: Final = 48
"""Binary ones of the entries of the approximate inverse."""

Box = Sequence[tuple[Fraction, Fraction]]
Ends = Sequence[tuple[Fraction, Fraction]]


@dataclass(frozen=True, eq=False)
class Regular:
    """A matrix that must be regular: its rows, and of each the place of its root among the y, or None."""

    rows: tuple[tuple[Any, ...], ...]
    roots: tuple[int | None, ...]

    def table(self, box: Box) -> MatrixTable:
        """Its coefficients on the whole box."""
        return MatrixTable(
            self.roots, tuple(_column(column, self.roots, box) for column in zip(*self.rows, strict=True))
        )

    def determinant_at(self, point: Sequence[Fraction]) -> Any:
        """Its determinant at a point, with the roots as variables; each is in one row."""
        ring, count, size = self.rows[0][0].context(), len(point), len(self.rows)
        options = []
        for row, root in zip(self.rows, self.roots, strict=True):
            parts = [[_value(entry, point, None) for entry in row]]
            if root is not None:
                parts.append([_value(entry, point, root) for entry in row])
            options.append(parts)
        terms: dict[tuple[int, ...], Any] = {}
        words = number_words(*(x for parts in options for row in parts for x in row))
        for choice in product(*(range(len(parts)) for parts in options)):
            charge(5000 + 100 * size**3 * size_factor(size * words, size * words))
            rows = [parts[k] for parts, k in zip(options, choice, strict=True)]
            found = fmpq_mat([[fmpq(x.numerator, x.denominator) for x in row] for row in rows]).det()
            used = {root for root, k in zip(self.roots, choice, strict=True) if k}
            key = (0,) * count + tuple(int(k in used) for k in range(ring.nvars() - count))
            terms[key] = terms.get(key, fmpq(0)) + found
        return ring.from_dict(terms)


def regular_of(ring: RegionRing, rows: Sequence[Sequence[Any]], names: Sequence[str]) -> Regular:
    """The condition on a matrix; ``names`` are those of the roots of its rows, empty where there is none."""
    driven = [name for name in ring.named if name in names]
    return Regular(tuple(map(tuple, rows)), tuple(driven.index(name) if name else None for name in names))


def own_length_row(
    ring: RegionRing, arm: Sequence[Any], rod: Sequence[Any], base: Sequence[Fraction], place: Sequence[Any]
) -> list[Any]:
    """The wrench of a leg of its own length without the factor N: forces, then moments."""
    g = ring.g
    way = [ring.entry(c) - ring.number(a) for c, a in zip(place, base, strict=True)]
    moment = []
    for j, k in ((1, 2), (2, 0), (0, 1)):
        moment.append(g[j] * g[k] * (ring.times(arm[j], way[k]) - ring.times(arm[k], way[j])))
    return [*(g[i] * rod[i] for i in range(3)), *moment]


@dataclass(frozen=True, eq=False)
class _Column:
    """Integers, times 2^-exponent over a denominator: by rows, powers of their roots, and the variables."""

    values: Any
    denominator: int
    bits: int
    exponent: int = 0


@dataclass(frozen=True, eq=False)
class MatrixTable:
    """The coefficients of all columns of a matrix on a part."""

    roots: tuple[int | None, ...]
    columns: tuple[_Column, ...]

    def halved(self, variable: int) -> tuple[MatrixTable, MatrixTable]:
        """Those on the lower and on the upper half along a variable."""
        halves = [_halved(column, 2 + variable) for column in self.columns]
        first, second = (MatrixTable(self.roots, tuple(pair[side] for pair in halves)) for side in (0, 1))
        return first, second

    def range_of(self, ends: Ends) -> tuple[int, int]:
        """Twice 1 if the matrix is proved to be regular all over the part, otherwise twice 0."""
        return (int(self.is_regular(ends)),) * 2

    def is_regular(self, ends: Ends) -> bool:
        """Whether the matrix is proved to be regular all over the part; ``ends`` are bounds of the roots there."""
        units = [_unit(ends, root) for root in self.roots]
        bounds = [self._bounds(column, ends, units) for column in self.columns]
        middles = [[min(low) + max(high) for low, high in zip(*both, strict=True)] for both in bounds]
        charge_inverse(self.columns, units)
        scales = [column.denominator << column.exponent for column in self.columns]
        weights = _weights(*_inverse([list(row) for row in zip(*middles, strict=True)]), scales, units)
        words = number_words(*(w for row, _ in weights for w in row))
        far = []
        for column, (low, high) in zip(self.columns, bounds, strict=True):
            charge_product(column, words + number_words(*units))
            far.append(_combined([row for row, _ in weights], low, high))
        rows = []
        for i, (_, common) in enumerate(weights):
            wholes = [common * scale * (i == j) for j, scale in enumerate(scales)]
            rows.append(
                [
                    whole - max(abs(whole - least), abs(whole - most))
                    for whole, (least, most) in zip(wholes, (ranges[i] for ranges in far), strict=True)
                ]
            )
        return _has_positive_minors(rows)

    def _bounds(self, column: _Column, ends: Ends, units: Sequence[int]) -> tuple[list[list[fmpz]], list[list[fmpz]]]:
        """By rows the lesser and the greater of the coefficients at both ends of the row's root, times its unit."""
        charge_looks(column, 5)
        layers = column.values.reshape(len(self.roots), column.values.shape[1], -1)
        low = [row[0].tolist() for row in layers]
        high = list(low)
        for k, (root, unit) in enumerate(zip(self.roots, units, strict=True)):
            if root is not None:
                one, other = (layers[k, 0] * unit + layers[k, 1] * int(end * unit) for end in ends[root])
                low[k], high[k] = np.minimum(one, other).tolist(), np.maximum(one, other).tolist()
        return low, high


def _unit(ends: Ends, root: int | None) -> int:
    """What makes the ends of a root integers."""
    return lcm(*(end.denominator for end in (() if root is None else ends[root])))


def _inverse(rows: Sequence[Sequence[fmpz]]) -> tuple[list[list[int]], int]:
    """The inverse of a matrix: integers, and what they are divided by; zeros if it is singular."""
    size = len(rows)
    table = [[*row, *(fmpz(int(i == k)) for k in range(size))] for i, row in enumerate(rows)]
    found, divisor, _ = fmpz_mat(table).rref()
    below = abs(int(divisor))
    sign = int(found[size - 1, size - 1]) // below  # the last pivot is the divisor, or 0
    return [[sign * int(found[i, size + k]) for k in range(size)] for i in range(size)], below


def _weights(
    inverse: Sequence[Sequence[int]], below: int, scales: Sequence[int], units: Sequence[int]
) -> list[tuple[list[int], int]]:
    """By rows the entries of the approximate inverse times something positive, and that."""
    together = lcm(*units)
    found = []
    for i, scale in enumerate(scales):
        digits = [_first_digits(2 * scale * unit * inverse[i][k], below) for k, unit in enumerate(units)]
        power = max(0, *(power for _, power in digits))
        row = [(x << (power - own)) * (together // unit) for (x, own), unit in zip(digits, units, strict=True)]
        found.append((row, together << power))
    return found


def _has_positive_minors(rows: list[list[int]]) -> bool:
    """Whether the determinants of the first 1, 2, .. rows and columns are positive: the pivots of Bareiss."""
    divisor = 1
    while rows:
        (pivot, *upper), *lower = rows
        if pivot <= 0:
            return False
        rows = [
            [(pivot * x - first * y) // divisor for x, y in zip(rest, upper, strict=True)] for first, *rest in lower
        ]
        divisor = pivot
    return True


def _combined(weights: Sequence[Sequence[int]], low: list[list[fmpz]], high: list[list[fmpz]]) -> list[tuple[int, int]]:
    """For each row of weights between what its combinations of what is between bounds lie."""
    size, places = len(low), len(low[0])
    lower = fmpz_mat(size, places, [x for row in low for x in row])
    if all(a is b for a, b in zip(low, high, strict=True)):
        least = most = (fmpz_mat(weights) * lower).entries()
    else:
        upper = fmpz_mat(size, places, [x for row in high for x in row])
        positive, negative = (fmpz_mat([[part(w, 0) for w in row] for row in weights]) for part in (max, min))
        least = (positive * lower + negative * upper).entries()
        most = (positive * upper + negative * lower).entries()
    return [
        (int(min(least[start : start + places])), int(max(most[start : start + places])))
        for start in range(0, len(weights) * places, places)
    ]


def _first_digits(numerator: int, denominator: int) -> tuple[int, int]:
    """A quotient with its first ``DIGITS`` binary digits only: an integer, and the power of 2 that divides it."""
    if not numerator:
        return 0, 0
    power = DIGITS - (numerator.bit_length() - denominator.bit_length())
    found = (abs(numerator) << max(power, 0)) // (denominator << max(-power, 0))
    if found.bit_length() > DIGITS:
        found, power = found >> 1, power - 1
    return (found if numerator > 0 else -found), power


def _halved(column: _Column, axis: int) -> tuple[_Column, _Column]:
    charge_looks(column, 3 + column.values.shape[axis])
    if column.values.shape[axis] == 1:
        return column, column
    level = np.moveaxis(column.values, axis, 0)
    degree = len(level) - 1
    low, high = [level[0] << degree], [level[-1] << degree]
    for power in range(degree - 1, -1, -1):
        level = level[:-1] + level[1:]
        low.append(level[0] << power)
        high.insert(0, level[-1] << power)
    first, second = (
        _Column(
            np.moveaxis(np.array(part, dtype=object), 0, axis),
            column.denominator,
            column.bits,
            column.exponent + degree,
        )
        for part in (low, high)
    )
    return first, second


def _column(entries: Sequence[Any], roots: Sequence[int | None], box: Box) -> _Column:
    """The coefficients of a column on a box, all of its degrees."""
    count = len(box)
    monomials = [exponents for entry in entries for exponents in entry.monoms()]
    degrees = [max((int(exponents[k]) for exponents in monomials), default=0) for k in range(count)]
    shape = (len(entries), 1 + any(root is not None for root in roots), *(degree + 1 for degree in degrees))
    charge_column(entries, degrees, box)
    values = np.full(shape, Fraction(0), dtype=object)
    for k, (entry, root) in enumerate(zip(entries, roots, strict=True)):
        for exponents, coefficient in entry.to_dict().items():
            power = 0 if root is None else int(exponents[count + root])
            values[(k, power, *map(int, exponents[:count]))] = Fraction(int(coefficient.p), int(coefficient.q))
    for variable, (low, high) in enumerate(box):
        axis = 2 + variable
        turned = np.tensordot(_to_bernstein(degrees[variable], low, high - low), values, axes=(1, axis))
        values = np.moveaxis(turned, 0, axis)
    denominator = lcm(*(x.denominator for x in values.flat))
    whole = np.array([fmpz(int(x * denominator)) for x in values.flat], dtype=object).reshape(shape)
    return _Column(whole, denominator, max(abs(x).bit_length() for x in whole.flat))


def charge_looks(column: _Column, times: int) -> None:
    """Work that looks so often at every coefficient of a column."""
    charge(1000 + 5 * times * column.values.size * (4 + (column.bits + column.exponent) // 64))


def charge_product(column: _Column, words: int) -> None:
    """The work of combining the rows of a column in as many ways, by weights of so many words."""
    own = (column.bits + column.exponent) // 64 + 1
    charge(1000 + 20 * len(column.values) * column.values.size * size_factor(own, words))


def charge_value(polynomial: Any, point: Sequence[Fraction]) -> None:
    """The work of a value at a point."""
    degree = sum(max(0, int(d)) for d in polynomial.degrees()[: len(point)])
    words = polynomial_words(polynomial) + number_words(*point) * degree
    charge(2000 * (1 + len(polynomial)) * size_factor(words // 5, words // 5))


def charge_inverse(columns: Sequence[_Column], units: Sequence[int]) -> None:
    """The work of an inverse and of determinants."""
    size = len(columns)
    sizes = (column.bits + column.exponent + column.denominator.bit_length() for column in columns)
    words = size * (1 + max(sizes) // 64 + number_words(*units))
    charge(20_000 + 4 * size**3 * size_factor(words, words))


def charge_column(entries: Sequence[Any], degrees: Sequence[int], box: Box) -> None:
    """The work of the coefficients of a column."""
    size = 2 * len(entries)
    for degree in degrees:
        size *= degree + 1
    ends = number_words(*(end for pair in box for end in pair))
    words = max(map(polynomial_words, entries)) + ends * max(degrees)
    charge(4000 * size * (1 + max(degrees)) * size_factor(words // 5, words // 5))


def _to_bernstein(degree: int, low: Fraction, width: Fraction) -> Any:
    """From powers of x to Bernstein coefficients on [low, low + width]."""
    found = np.full((degree + 1, degree + 1), Fraction(0), dtype=object)
    for i, power in product(range(degree + 1), repeat=2):
        for j in range(min(i, power) + 1):
            share = Fraction(comb(i, j) * comb(power, j), comb(degree, j))
            found[i, power] += share * low ** (power - j) * width**j
    return found


def _value(polynomial: Any, point: Sequence[Fraction], root: int | None) -> Fraction:
    """The value at a point of the terms without roots, or of what a root is multiplied by."""
    count, total = len(point), Fraction(0)
    charge_value(polynomial, point)
    for exponents, coefficient in polynomial.to_dict().items():
        if [k for k, e in enumerate(exponents[count:]) if e] == ([] if root is None else [root]):
            term = Fraction(int(coefficient.p), int(coefficient.q))
            for x, exponent in zip(point, exponents, strict=False):
                term *= x ** int(exponent)
            total += term
    return total
