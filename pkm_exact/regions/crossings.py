"""Where a polynomial of one variable and of square roots is 0: zeros isolated, each proved to be there and simple.

With t the variable and y_i = sqrt(D_i(t)), f(t, y) is a function of t wherever all D_i are positive. On an interval it
is enclosed with its slope (``jets``): where it is bounded away from 0 there is no zero; where its slope is, there is
one if it has opposite signs at the ends, and none if it has the same. Other intervals are divided, by a ratio that is
not likely to meet a zero. What is left is undecided: a rod only just reaches there, or a zero is double.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from flint import arb

from pkm_exact.precision import working_precision
from pkm_exact.regions.chart import Polynomial
from pkm_exact.regions.jets import Jet, constant, parameter
from pkm_exact.roots.interval import Interval

_PRECISION: Final = 192
_SHARE: Final = Fraction(503, 1024)
_FINEST: Final = 40
"""Intervals are not divided more often."""
_MOST: Final = 20_000
"""Intervals that are looked at."""
_WIDTH: Final = Fraction(1, 2**50)
"""Of the interval about a zero, as a share of the whole."""

Terms = list[tuple[tuple[int, ...], list[arb]]]


@dataclass(frozen=True)
class Crossings:
    """Zeros of a function on an interval.

    Attributes
    ----------
    zeros : tuple of Interval
        Each has one zero, and there is none elsewhere but in what is undecided.
    undecided : tuple of Interval
    """

    zeros: tuple[Interval, ...]
    undecided: tuple[Interval, ...]


def crossings(polynomial: Polynomial, roots: Sequence[Polynomial], low: Fraction, high: Fraction) -> Crossings:
    """The zeros of f(t, sqrt(D_1(t)), ..) in [low, high] where all D_i are not negative.

    Parameters
    ----------
    polynomial : fmpq_mpoly
        f, of t and of the roots, in this order.
    roots : sequence of fmpq_mpoly
        D_i, of t alone, in the same ring.
    low, high : Fraction

    Examples
    --------
    >>> from flint import Ordering, fmpq_mpoly_ctx
    >>> t, y = fmpq_mpoly_ctx.get(("t", "y"), Ordering.lex).gens()
    >>> found = crossings(y - 2 * t, [1 - t * t], Fraction(-1, 2), Fraction(1, 2))
    >>> print(*found.zeros, found.undecided)
    0.447213595499958 ()
    """
    with working_precision(_PRECISION):
        return _Search(_terms(polynomial), [_terms(root) for root in roots]).found(low, high)


def _terms(polynomial: Polynomial) -> Terms:
    """The powers of the roots, and for each the coefficients of powers of t."""
    parts: dict[tuple[int, ...], dict[int, arb]] = {}
    for exponents, coefficient in polynomial.to_dict().items():
        power, *others = map(int, exponents)
        parts.setdefault(tuple(others), {})[power] = arb(coefficient)
    return [(key, [row.get(k, arb(0)) for k in range(max(row) + 1)]) for key, row in parts.items()]


class _Search:
    def __init__(self, terms: Terms, roots: Sequence[Terms]) -> None:
        self._terms, self._roots = terms, roots

    def found(self, low: Fraction, high: Fraction) -> Crossings:
        """Zeros and what is undecided, from left to right."""
        zeros: list[Interval] = []
        undecided: list[Interval] = []
        waiting, looked, finest = [(low, high, 0)], 0, (high - low) * _WIDTH
        while waiting:
            start, end, depth = waiting.pop()
            looked += 1
            has_zero = self._has_zero(start, end)
            if has_zero:
                zeros.append(self._narrowed(start, end, finest))
            elif has_zero is None and (depth == _FINEST or looked > _MOST):
                _append(undecided, start, end)
            elif has_zero is None:
                middle = start + (end - start) * _SHARE
                waiting += [(middle, end, depth + 1), (start, middle, depth + 1)]
        return Crossings(tuple(zeros), tuple(undecided))

    def _has_zero(self, start: Fraction, end: Fraction) -> bool | None:
        """Whether there is exactly one zero, or none, between; None if that is not decided."""
        t = parameter((start + end) / 2, (end - start) / 2)
        squares = [_value(terms, t, []) for terms in self._roots]
        if any(square.value < 0 for square in squares):
            return False
        found = _value(self._terms, t, [_root(square) for square in squares])
        if found.value > 0 or found.value < 0:
            return False
        if not all(square.value > 0 for square in squares) or not (found.slope > 0 or found.slope < 0):
            return None
        signs = self._sign(start), self._sign(end)
        return None if 0 in signs else signs[0] != signs[1]

    def _sign(self, at: Fraction) -> int:
        """The sign at a point where all D_i are positive; 0 if it is not decided."""
        t = parameter(at, Fraction(0))
        value = _value(self._terms, t, [_value(terms, t, []).root() for terms in self._roots]).middle
        return 1 if value > 0 else -1 if value < 0 else 0

    def _narrowed(self, start: Fraction, end: Fraction, width: Fraction) -> Interval:
        """The interval about one simple zero, halved until it is narrow."""
        first = self._sign(start)
        while end - start > width:
            middle = start + (end - start) * _SHARE
            sign = self._sign(middle)
            if not sign:
                break
            start, end = (middle, end) if sign == first else (start, middle)
        return Interval(start, end)


def _root(square: Jet) -> Jet:
    """The square root; where it may be 0, something that has its values, but not its slopes."""
    if square.value > 0:
        return square.root()
    return Jet(arb(0).union(square.value.abs_upper().sqrt()), arb(0), square.half)


def _append(found: list[Interval], start: Fraction, end: Fraction) -> None:
    """Add an interval, joined with the last one if they touch."""
    if found and found[-1].hi == start:
        start = found.pop().lo
    found.append(Interval(start, end))


def _value(terms: Terms, t: Jet, roots: Sequence[Jet]) -> Jet:
    total = constant(arb(0), t)
    for key, coefficients in terms:
        part = constant(coefficients[-1], t)
        for coefficient in reversed(coefficients[:-1]):
            part = part * t + constant(coefficient, t)
        for root, power in zip(roots, key, strict=False):
            for _ in range(power):
                part = part * root
        total = total + part
    return total
