"""Directions in which a singular configuration may be left: rational zeros of the forms of the second order.

With two or three freedoms to the first order the forms u.Q(y) that must be 0 are in two or three unknowns. Their
rational zeros are found by gcds and resultants; which of them belong to motions is for their power series to say.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import reduce
from typing import Final

from flint import fmpq, fmpq_poly

from pkm_exact.mobility.second_order import Quadratic

MOST_DIRECTIONS: Final = 8


def rational_directions(forms: Sequence[Quadratic], count: int) -> list[tuple[Fraction, ...]]:
    """Common zeros of forms in two or three unknowns, up to a factor; none if they are infinitely many.

    Examples
    --------
    >>> [[str(x) for x in y] for y in rational_directions([{(0, 0): Fraction(1), (1, 1): Fraction(-4)}], 2)]
    [['-2', '1'], ['2', '1']]
    """
    if count == 2:
        return [(Fraction(x), Fraction(y)) for x, y in _of_two([_binary(form, 0, 1) for form in forms])]
    if count != 3:
        return []
    found: list[tuple[Fraction, ...]] = []
    infinity = [{pair: value for pair, value in form.items() if 2 not in pair} for form in forms]
    found += [(x, y, Fraction(0)) for x, y in _of_two([_binary(form, 0, 1) for form in infinity])]
    for x in _first_coordinates(forms):
        at = [_at_first(form, x) for form in forms]
        common = reduce(lambda a, b: a.gcd(b), at)
        found += [(x, y, Fraction(1)) for y in _roots(common)]
    return found[:MOST_DIRECTIONS]


def _binary(form: Quadratic, i: int, j: int) -> fmpq_poly:
    """The form at (x, 1), in x."""
    return fmpq_poly([_flint(form.get(pair, Fraction(0))) for pair in ((j, j), (i, j), (i, i))])


def _of_two(polynomials: Sequence[fmpq_poly]) -> list[tuple[Fraction, Fraction]]:
    if not any(polynomials):
        return []
    common = reduce(lambda a, b: a.gcd(b), polynomials)
    found = [(x, Fraction(1)) for x in _roots(common)]
    if all(part[2] == 0 for part in polynomials):
        found.append((Fraction(1), Fraction(0)))
    return found


def _first_coordinates(forms: Sequence[Quadratic]) -> list[Fraction]:
    """x of the common zeros (x, y, 1): roots of the resultants of two of the forms in y."""
    parts = [_in_second(form) for form in forms]
    resultants = [_resultant(parts[i], parts[j]) for i in range(len(parts)) for j in range(i)]
    known = [value for value in resultants if value]
    return _roots(reduce(lambda a, b: a.gcd(b), known)) if known else []


def _in_second(form: Quadratic) -> list[fmpq_poly]:
    """The coefficients of 1, y, y^2 at (x, y, 1), in x."""
    value = {pair: _flint(x) for pair, x in form.items()}
    zero = fmpq(0)
    return [
        fmpq_poly([value.get((2, 2), zero), value.get((0, 2), zero), value.get((0, 0), zero)]),
        fmpq_poly([value.get((1, 2), zero), value.get((0, 1), zero)]),
        fmpq_poly([value.get((1, 1), zero)]),
    ]


def _resultant(one: Sequence[fmpq_poly], other: Sequence[fmpq_poly]) -> fmpq_poly:
    """Of c + b y + a y^2 and another: (a c' - c a')^2 - (a b' - b a') (b c' - c b')."""
    (c, b, a), (z, y, x) = one, other
    outer = a * z - c * x
    return outer * outer - (a * y - b * x) * (b * z - c * y)


def _at_first(form: Quadratic, x: Fraction) -> fmpq_poly:
    return fmpq_poly([part(_flint(x)) for part in _in_second(form)])


def _roots(polynomial: fmpq_poly) -> list[Fraction]:
    """The rational roots, in increasing order; none of 0."""
    if not polynomial or polynomial.degree() < 1:
        return []
    linear = [factor for factor, _ in polynomial.factor()[1] if factor.degree() == 1]
    return sorted(Fraction(int((-f[0] / f[1]).p), int((-f[0] / f[1]).q)) for f in linear)


def _flint(value: Fraction) -> fmpq:
    return fmpq(value.numerator, value.denominator)
