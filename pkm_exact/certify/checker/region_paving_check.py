"""The paving of a region certificate, checked letter by letter with exact Bernstein coefficients.

Halving a part adds neighbours and divides by two (de Casteljau); powers of two are left out, as signs do not change.
The y_i lie between rational bounds of the roots of those of the D_i, off by less than 2^-80 of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import comb, isqrt, lcm
from typing import Any, Final

import numpy as np

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.region_document import RegionDocument
from pkm_exact.certify.checker.region_polynomials import (
    Condition,
    Conditions,
    RegionEquations,
    Test,
    number_words,
    polynomial_words,
    size_factor,
)
from pkm_exact.certify.checker.verdict import malformed, rejected, too_large

ROOT_BITS: Final = 80
MOST_COEFFICIENTS: Final = 1 << 20
"""Of one polynomial on a part."""
_SIGN_BITS: Final = (64, 256, 1024)


@dataclass(frozen=True, eq=False)
class _Table:
    """Integer Bernstein coefficients, times 2^-exponent over a denominator: two along each root, then the variables."""

    roots: tuple[int, ...]
    values: Any
    denominator: int
    exponent: int = 0

    def halved(self, variable: int) -> tuple[_Table, _Table]:
        """Those on the lower and on the upper half along a variable."""
        axis = len(self.roots) + variable
        level = np.moveaxis(self.values, axis, 0)
        degree = len(level) - 1
        low, high = [level[0] << degree], [level[-1] << degree]
        for power in range(degree - 1, -1, -1):
            level = level[:-1] + level[1:]
            low.append(level[0] << power)
            high.append(level[-1] << power)
        halves = (np.moveaxis(np.array(part, dtype=object), 0, axis) for part in (low, high[::-1]))
        first, second = (_Table(self.roots, half, self.denominator, self.exponent + degree) for half in halves)
        return first, second

    def range_of(self, ends: Sequence[tuple[Fraction, Fraction]]) -> tuple[int, int]:
        """The least and the greatest coefficient, times something positive."""
        found = self.values
        for root in self.roots:
            low, high = ends[root]
            scale = lcm(low.denominator, high.denominator)
            corners = [found[0] * scale + found[1] * int(end * scale) for end in (low, high)]
            found = np.stack(corners, axis=-1)
        flat = found.reshape(-1)
        return min(flat), max(flat)


def check_region(document: RegionDocument) -> Iterator[str]:
    """One line for each claim that is proved."""
    if any(weight < 0 for part in document.shape for weight in part.weights):
        raise malformed("shape: a weight is negative")
    conditions = RegionEquations(document).conditions()
    yield f"conditions: {', '.join(document.conditions)}, as polynomials in {', '.join(document.variables)}"
    if document.claim == "not-all":
        if document.paving or document.inside or document.undecided or document.measure is not None:
            raise malformed("paving: there is one, but a pose refutes the question")
        yield _refuted(document, conditions)
        return
    if document.points:
        raise malformed("counterexample: there is one, but the claim is another")
    yield from _paved(document, conditions)


def _paved(document: RegionDocument, conditions: Conditions) -> Iterator[str]:
    shape: list[Condition] = list(conditions.shape)
    if document.claim == "map":
        condition: Condition = ("and", [*shape, conditions.asked])
    else:
        condition = ("or", [*(Test(-part.polynomial, "+") for part in conditions.shape), conditions.asked])
    shares = _Walk(document, condition, conditions.roots).shares()
    counts = {letter: document.paving.count(letter) for letter in "iou"}
    if (counts["i"], counts["u"]) != (document.inside, document.undecided):
        raise rejected("inside, undecided: not as many parts as the paving has")
    yield f"paving: {counts['i']} parts inside, {counts['o']} outside, each proved; {counts['u']} undecided"
    if document.claim == "all":
        if counts["o"] or counts["u"]:
            raise rejected("claim: not all parts are inside")
        middle = [(low + high) / 2 for low, high in document.box]
        if any(_value(part.polynomial, middle, ()) < 0 for part in conditions.shape):
            raise rejected("shape: the middle of the box is not in it, so nothing shows that the region has poses")
        yield "claim: all poses of the region are good"
    elif document.claim == "undecided":
        if not counts["u"] and not counts["o"]:
            raise rejected("claim: all parts are inside, which is more than claimed")
        yield "claim: none but what is proved of the parts"
    yield from _measured(document, shares)


def _measured(document: RegionDocument, shares: dict[str, Fraction]) -> Iterator[str]:
    """The bounds of a map, if it has any."""
    if document.claim != "map" or not all(name in "xyz" for name in document.variables):
        if document.measure is not None:
            raise rejected("measure: claimed where there is none")
        return
    size = Fraction(1)
    for low, high in document.box:
        size *= high - low
    if document.measure != (size * shares["i"], size * (shares["i"] + shares["u"])):
        raise rejected("measure: not that of the parts inside, and of these with the undecided ones")
    yield "measure: between that of the parts inside, and that of these with the undecided ones"


class _Walk:
    """Follows the word of a paving."""

    def __init__(self, document: RegionDocument, condition: Condition, roots: Sequence[Any]) -> None:
        self._document, self._condition, self._count = document, condition, len(document.variables)
        tables: list[_Table] = []
        self._tests: dict[int, int] = {}
        for test in _tests_of(condition):
            if id(test) not in self._tests:
                self._tests[id(test)] = len(tables)
                tables.append(self._table(test.polynomial))
        self._roots = len(roots)
        self._start = [self._table(root) for root in roots] + tables
        bits = max((int(abs(v)).bit_length() for table in self._start for v in table.values.reshape(-1)), default=1)
        size = sum(table.values.size << len(table.roots) for table in self._start)
        steps = sum(max(table.values.shape, default=1) for table in self._start)
        words = (bits + 8 * len(document.axes) * max(1, steps // max(1, len(self._start)))) // 64 + 1
        self._cost = 40_000 + 25 * size * (4 + words) // 4 * (2 + steps // max(1, len(self._start)))

    def shares(self) -> dict[str, Fraction]:
        """For every letter the share of the box of the parts that have it; refused if one is not proved."""
        word, axes = self._document.paving, self._document.axes
        found = dict.fromkeys("iou", Fraction(0))
        waiting = [(0, self._start)]
        for place, letter in enumerate(word, 1):
            if not waiting:
                raise rejected("paving: it goes on after its end")
            depth, tables = waiting.pop()
            charge(self._cost)
            if letter == "s":
                if depth >= len(axes):
                    raise rejected(f"paving: letter {place} halves a part deeper than the axes say")
                halves = [table.halved(axes[depth]) for table in tables]
                waiting += [(depth + 1, [pair[1] for pair in halves]), (depth + 1, [pair[0] for pair in halves])]
                continue
            if letter != "u" and not self._holds(letter, tables):
                word_for = "inside" if letter == "i" else "outside"
                raise rejected(f"paving: the part of letter {place} is not proved to be {word_for}")
            found[letter] += Fraction(1, 1 << depth)
        if waiting:
            raise rejected("paving: parts of the region are missing")
        return found

    def _holds(self, letter: str, tables: Sequence[_Table]) -> bool:
        ends = []
        for table in tables[: self._roots]:
            low, high = table.range_of(())
            unit = Fraction(1, table.denominator << table.exponent)
            ends.append((_root_below(low * unit), _root_above(high * unit)))
        ranges: dict[int, tuple[int, int]] = {}

        def range_of(test: Test) -> tuple[int, int]:
            place = self._tests[id(test)]
            if place not in ranges:
                ranges[place] = tables[self._roots + place].range_of(ends)
            return ranges[place]

        return _is(self._condition, range_of, wanted=letter == "i")

    def _table(self, polynomial: Any) -> _Table:
        count, box = self._count, self._document.box
        degrees = (
            [int(d) for d in polynomial.degrees()] if not polynomial.is_zero() else [0] * polynomial_size(polynomial)
        )
        inner, roots = degrees[:count], tuple(k for k, d in enumerate(degrees[count:]) if d)
        if any(degrees[count + k] > 1 for k in roots):
            raise malformed("conditions: a root appears squared")
        shape = (2,) * len(roots) + tuple(d + 1 for d in inner)
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
        denominator = lcm(1, *(value.denominator for value in values.reshape(-1)))
        whole = np.array([int(value * denominator) for value in values.reshape(-1)], dtype=object).reshape(shape)
        return _Table(roots, whole, denominator)


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


def _tests_of(condition: Condition) -> Iterator[Test]:
    if isinstance(condition, Test):
        yield condition
    else:
        for part in condition[1]:
            yield from _tests_of(part)


def _is(condition: Condition, range_of: Any, *, wanted: bool) -> bool:
    """Whether a condition is proved to hold all over a part, or if not ``wanted`` to hold nowhere in it."""
    if isinstance(condition, Test):
        low, high = range_of(condition)
        if condition.sign == "/":
            return wanted and (low > 0 or high < 0)
        if wanted:
            return bool(low > 0 if condition.sign == "+" else low >= 0)
        return bool(high <= 0 if condition.sign == "+" else high < 0)
    word, parts = condition
    some = (word == "or") is wanted
    results = (_is(part, range_of, wanted=wanted) for part in parts)
    return any(results) if some else all(results)


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


def _refuted(document: RegionDocument, conditions: Conditions) -> str:
    """That a pose of the region is not good, or that the determinant has both signs in it."""
    for point in document.points:
        inside = all(low <= x <= high for x, (low, high) in zip(point, document.box, strict=True))
        if not inside or any(_value(part.polynomial, point, ()) < 0 for part in conditions.shape):
            raise rejected("counterexample: a pose is not one of the region")
    if len(document.points) == 1:
        (point,) = document.points
        if not _fails(conditions.asked, point, conditions.roots):
            raise rejected("counterexample: no condition is proved to fail there")
        return "claim: not all poses of the region are good, as one shows"
    if len(document.points) != 2 or conditions.determinant is None:
        raise malformed("counterexample: neither one pose, nor two between which a determinant changes its sign")
    signs = [_sign(conditions.determinant, point, conditions.roots) for point in document.points]
    if None in signs or signs[0] != -(signs[1] or 0) or not signs[0]:
        raise rejected("counterexample: the determinants are not proved to have opposite signs")
    return "claim: not all poses of the region are good, as the determinant has both signs in it, which is convex"


def _fails(condition: Condition, point: Sequence[Fraction], roots: Sequence[Any]) -> bool:
    if isinstance(condition, Test):
        sign = _sign(condition.polynomial, point, roots)
        if sign is None:
            return False
        return {"+": sign <= 0, "0+": sign < 0, "/": sign == 0}[condition.sign]
    word, parts = condition
    failing = (_fails(part, point, roots) for part in parts)
    return any(failing) if word == "and" else all(failing)


def _value(polynomial: Any, point: Sequence[Fraction], used: tuple[int, ...]) -> Fraction:
    """The value at a point of the part of a polynomial that has exactly these roots."""
    total, count = Fraction(0), len(point)
    degree = max((sum(int(e) for e in exponents[:count]) for exponents in polynomial.to_dict()), default=0)
    words = polynomial_words(polynomial) + number_words(*point) * degree
    charge(2000 * max(1, len(polynomial)) * size_factor(words // 5, words // 5))
    for exponents, coefficient in polynomial.to_dict().items():
        if tuple(k for k, e in enumerate(exponents[count:]) if e) != used:
            continue
        term = Fraction(int(coefficient.p), int(coefficient.q))
        for x, exponent in zip(point, exponents, strict=False):
            term *= x ** int(exponent)
        total += term
    return total


def _sign(polynomial: Any, point: Sequence[Fraction], roots: Sequence[Any]) -> int | None:
    """The sign of a polynomial at a point; None if it is not proved."""
    count = len(point)
    used = {tuple(k for k, e in enumerate(exponents[count:]) if e) for exponents in polynomial.to_dict()}
    values = {key: _value(polynomial, point, key) for key in sorted(used)}
    if not any(used):
        total = values.get((), Fraction(0))
        return (total > 0) - (total < 0)
    squares = [_value(root, point, ()) for root in roots]
    if any(square < 0 for square in squares):
        return None
    for bits in _SIGN_BITS:
        scale = 1 << bits
        low = high = Fraction(0)
        for key, value in values.items():
            ends = [Fraction(1), Fraction(1)]
            for k in key:
                root = isqrt(squares[k].numerator * scale * scale // squares[k].denominator)
                ends = [ends[0] * Fraction(root, scale), ends[1] * Fraction(root + 1, scale)]
            low += min(value * end for end in ends)
            high += max(value * end for end in ends)
        if low > 0 or high < 0:
            return 1 if low > 0 else -1
    return None
