"""Integer Bernstein coefficients of the polynomials of a region certificate on the parts of a paving.

Halving a part adds neighbours and divides by two (de Casteljau); powers of two are left out, as signs do not change.
The y_i lie between rational bounds of the roots of those of the D_i, off by less than 2^-80 of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import comb, isqrt, lcm
from typing import Any, Final

import numpy as np

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.region_regular import Regular
from pkm_exact.certify.checker.region_ring import number_words, polynomial_words, size_factor
from pkm_exact.certify.checker.verdict import malformed, too_large

ROOT_BITS: Final = 80
MOST_COEFFICIENTS: Final = 1 << 20
"""Of one polynomial on a part."""


@dataclass(frozen=True, eq=False)
class _Table:
    """Integer Bernstein coefficients, times 2^-exponent over a denominator: two along each root, then the variables."""

    roots: tuple[int, ...]
    values: Any
    denominator: int
    bits: int
    exponent: int = 0

    def halved(self, variable: int) -> tuple[_Table, _Table]:
        """Those on the lower and on the upper half along a variable."""
        charge_table(self)
        axis = len(self.roots) + variable
        level = np.moveaxis(self.values, axis, 0)
        degree = len(level) - 1
        low, high = [level[0] << degree], [level[-1] << degree]
        for power in range(degree - 1, -1, -1):
            level = level[:-1] + level[1:]
            low.append(level[0] << power)
            high.append(level[-1] << power)
        halves = (np.moveaxis(np.array(part, dtype=object), 0, axis) for part in (low, high[::-1]))
        exponent = self.exponent + degree
        first, second = (_Table(self.roots, half, self.denominator, self.bits, exponent) for half in halves)
        return first, second

    def range_of(self, ends: Sequence[tuple[Fraction, Fraction]]) -> tuple[int, int]:
        """The least and the greatest coefficient, times something positive."""
        charge_table(self)
        found = self.values
        for root in self.roots:
            low, high = ends[root]
            scale = lcm(low.denominator, high.denominator)
            corners = [found[0] * scale + found[1] * int(end * scale) for end in (low, high)]
            found = np.stack(corners, axis=-1)
        return min(found.flat), max(found.flat)


def charge_table(table: _Table) -> None:
    """The work of halving, or of looking at all coefficients."""
    degree = max(table.values.shape, default=1)
    words = (table.bits + table.exponent) // 64 + 1
    charge(1000 + 25 * (table.values.size << len(table.roots)) * (4 + words) // 4 * (2 + degree))


class Part:
    """A part of the box: the coefficients of a polynomial on it are made when they are needed, from those around."""

    def __init__(self, depth: int, parent: Part | None = None, axis: int = 0, *, upper: bool = False) -> None:
        self.depth, self._parent, self._axis, self._upper = depth, parent, axis, upper
        self._tables: dict[int, _Table] = {}
        self._halves: dict[int, tuple[_Table, _Table]] = {}

    def halves(self, axis: int) -> tuple[Part, Part]:
        """The lower and the upper half along a variable."""
        lower, upper = (Part(self.depth + 1, self, axis, upper=upper) for upper in (False, True))
        return lower, upper

    def table(self, polynomial: Any, box: Sequence[tuple[Fraction, Fraction]]) -> _Table:
        """The coefficients of a polynomial; ``box`` is the whole one."""
        key = id(polynomial)
        if key not in self._tables:
            if self._parent is None:
                is_matrix = isinstance(polynomial, Regular)
                self._tables[key] = polynomial.table(box) if is_matrix else _table_of(polynomial, box)
            else:
                self._tables[key] = self._parent.half(polynomial, box, self._axis)[self._upper]
        return self._tables[key]

    def half(self, polynomial: Any, box: Sequence[tuple[Fraction, Fraction]], axis: int) -> tuple[_Table, _Table]:
        """Those on both halves."""
        key = id(polynomial)
        if key not in self._halves:
            self._halves[key] = self.table(polynomial, box).halved(axis)
        return self._halves[key]

    def root_ends(self, root: Any, box: Sequence[tuple[Fraction, Fraction]]) -> tuple[Fraction, Fraction]:
        """Bounds of the root of a polynomial."""
        table = self.table(root, box)
        low, high = table.range_of(())
        unit = Fraction(1, table.denominator << table.exponent)
        return _root_below(low * unit), _root_above(high * unit)


def _table_of(polynomial: Any, box: Sequence[tuple[Fraction, Fraction]]) -> _Table:
    """The coefficients on a box."""
    count = len(box)
    degrees = [int(d) for d in polynomial.degrees()] if not polynomial.is_zero() else [0] * polynomial_size(polynomial)
    inner, roots = degrees[:count], tuple(k for k, d in enumerate(degrees[count:]) if d)
    if any(degrees[count + k] > 1 for k in roots):
        raise malformed("conditions: a root appears squared")
    shape = tuple(d + 1 for d in (*(degrees[count + k] for k in roots), *inner))
    size = int(np.prod(shape, dtype=object))
    if size > MOST_COEFFICIENTS:
        raise too_large(f"conditions: a polynomial of more than {MOST_COEFFICIENTS} coefficients")
    ends = number_words(*(end for pair in box for end in pair))
    words = polynomial_words(polynomial) + ends * max(inner, default=0)
    charge(4000 * size * (1 + max(inner, default=0)) * size_factor(words // 5, words // 5))
    values = np.full(shape, Fraction(0), dtype=object)
    for exponents, coefficient in polynomial.to_dict().items():
        place = tuple(int(exponents[count + k]) for k in roots) + tuple(int(e) for e in exponents[:count])
        values[place] = Fraction(int(coefficient.p), int(coefficient.q))
    for variable, (low, high) in enumerate(box):
        axis = len(roots) + variable
        values = np.moveaxis(_converted(np.moveaxis(values, axis, 0), low, high), 0, axis)
    denominator = lcm(*(value.denominator for value in values.flat))
    whole = np.array([int(value * denominator) for value in values.flat], dtype=object).reshape(shape)
    bits = max(int(abs(value)).bit_length() for value in whole.flat)
    return _Table(roots, whole, denominator, bits)


def polynomial_size(polynomial: Any) -> int:
    """How many variables the ring of a polynomial has."""
    return int(polynomial.context().nvars())


def _converted(values: Any, low: Fraction, high: Fraction) -> Any:
    """From powers of x, along the first axis, to Bernstein coefficients on [low, high]."""
    degree = len(values) - 1
    rows = [values[k] for k in range(degree + 1)]
    for start in range(degree):  # p(low + x), by Horner's scheme
        for k in range(degree - 1, start - 1, -1):
            rows[k] = rows[k] + rows[k + 1] * low
    scaled = [row * (high - low) ** k for k, row in enumerate(rows)]
    found = []
    for i in range(degree + 1):
        total = scaled[0]
        for k in range(1, i + 1):
            total = total + scaled[k] * Fraction(comb(i, k), comb(degree, k))
        found.append(total)
    return np.array(found, dtype=object).reshape(values.shape)


def _root_below(square: Fraction) -> Fraction:
    """The root of a number, rounded down to a multiple of 1 / ``_scale``; 0 if it is negative."""
    if square <= 0:
        return Fraction(0)
    scale = _scale(square)
    return Fraction(isqrt(square.numerator * scale * scale // square.denominator), scale)


def _root_above(square: Fraction) -> Fraction:
    """The same, rounded up: a root that is such a multiple stays what it is."""
    if square <= 0:
        return Fraction(0)
    scale = _scale(square)
    above = -(-square.numerator * scale * scale // square.denominator)
    return Fraction(isqrt(above - 1) + 1, scale)


def _scale(square: Fraction) -> int:
    """A power of two that makes the root a number of more than ``ROOT_BITS`` bits."""
    return 1 << max(0, ROOT_BITS + 2 - (square.numerator.bit_length() - square.denominator.bit_length()) // 2)
