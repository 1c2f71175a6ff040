"""One freedom to the first order: does it go on? The power series of the only motion there can be, order by order.

Half tangents t_i of the joints make a loop the product of dual quaternions 1 + s_i t_i (w_i + e v_i), with the twist
(w_i; v_i), a line or a translation, and the sign s_i of its passing. The loop is closed exactly if the vector part of
the product is 0, real and dual. If the linear terms have rank n - 1, there is one curve at most: its terms follow one
from another, until an equation has no solution (then there is none), or as long as one likes. If they are those of
rational functions, the product shows whether these close the loops for good.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final, TypeAlias

from pkm_exact.mobility.instantaneous_mobility import Instantaneous
from pkm_exact.screws.exact_matrix import Row, null_space, solution

Series: TypeAlias = list[Fraction]
MOST_ORDERS: Final = 10
MOST_FREEDOMS: Final = 24
MOST_DIGITS: Final = 300
"""Orders that are looked at, in how many freedoms, and digits of their terms; beyond, nothing is known."""
_DEGREES: Final = (1, 2, 3)


@dataclass(frozen=True)
class HigherOrder:
    """What the series say.

    Attributes
    ----------
    terms : tuple of rows
        The terms of the half tangents, from the first order on, as far as there are any.
    factors : tuple of Fraction
        u with u M = 0 that has no solution in the next order; empty if a curve was found.
    curve : tuple of pairs of rows
        Numerators and denominators of the half tangents, lowest degree first; empty if there is no solution.
    """

    terms: tuple[Row, ...]
    factors: Row = ()
    curve: tuple[tuple[Row, Row], ...] = ()


def higher_order(found: Instantaneous) -> HigherOrder | None:
    """Whether a mechanism with one freedom to the first order moves; None if that is not found.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> from pkm_exact.mobility.instantaneous_mobility import instantaneous
    >>> proved = higher_order(instantaneous(read_linkage("models/chains/bennett.toml")))
    >>> [[str(x) for x in numerator] for numerator, _ in proved.curve]
    [['0', '-1'], ['0', '1'], ['0', '-1'], ['0', '1']]
    """
    loops, count = found.loops, len(found.linkage.freedoms)
    twists = [loops.twists[index] for loop in loops.loops for index, _ in loop]
    simple = all(sum(a * b for a, b in zip(t[:3], t[3:], strict=True)) == 0 for t in twists)
    if found.total != 1 or not simple or not loops.loops or count > MOST_FREEDOMS or found.locked:
        return None
    terms: list[Row] = [found.speeds[0]]
    for order in range(2, MOST_ORDERS + 1):
        series = [[Fraction(0), *(term[k] for term in terms)] for k in range(count)]
        rest = [value[order] for value in _vector_parts(found, [(t, [Fraction(1)]) for t in series], order)]
        if max(len(str(value)) for value in rest) > MOST_DIGITS:
            return None
        following = solution(loops.matrix, [-value for value in rest], count)
        if following is None:
            dependent = null_space(list(zip(*loops.matrix, strict=True)), len(loops.matrix))
            return HigherOrder(tuple(terms), next(u for u in dependent if _product(u, rest)))
        terms.append(following)
    return _curve(found, terms)


def _product(one: Sequence[Fraction], other: Sequence[Fraction]) -> Fraction:
    return sum((a * b for a, b in zip(one, other, strict=True)), Fraction(0))


def _curve(found: Instantaneous, terms: Sequence[Row]) -> HigherOrder | None:
    """Rational functions with these terms, if they close the loops."""
    count = len(found.linkage.freedoms)
    curve = [_rational([Fraction(0), *(term[k] for term in terms)]) for k in range(count)]
    known = [entry for entry in curve if entry is not None]
    if len(known) < count:
        return None
    degree = sum(max(len(n), len(d)) for n, d in known)
    if any(any(value) for value in _vector_parts(found, known, degree)):
        return None
    return HigherOrder(tuple(terms), curve=tuple((tuple(n), tuple(d)) for n, d in known))


def _rational(series: Series) -> tuple[Series, Series] | None:
    """Numerator and denominator of a rational function of small degree with the given terms."""
    if not any(series):
        return [Fraction(0)], [Fraction(1)]
    for degree in _DEGREES:
        rows = [[series[k - j] for j in range(degree + 1)] for k in range(degree + 1, len(series))]
        for denominator in null_space(rows, degree + 1)[:1]:
            if denominator[0]:
                monic = [value / denominator[0] for value in denominator]
                numerator = [_product(monic[: k + 1], series[k::-1]) for k in range(degree + 1)]
                return _trimmed(numerator), _trimmed(monic)
    return None


def _trimmed(values: Series) -> Series:
    while len(values) > 1 and not values[-1]:
        values = values[:-1]
    return values


def _vector_parts(found: Instantaneous, halves: Sequence[tuple[Series, Series]], order: int) -> list[Series]:
    """The six vector parts of each loop, as polynomials up to an order."""
    parts = []
    for loop in found.loops.loops:
        product: list[Series] = [[Fraction(1)], *([Fraction(0)] for _ in range(7))]
        for index, sign in loop:
            numerator, denominator = halves[index]
            turned = _by_twist(product, [sign * value for value in found.loops.twists[index]])
            product = [
                _sum(_times(a, denominator, order), _times(b, numerator, order))
                for a, b in zip(product, turned, strict=True)
            ]
        parts += [[*product[k], *[Fraction(0)] * (order + 1 - len(product[k]))] for k in (1, 2, 3, 5, 6, 7)]
    return parts


def _by_twist(p: Sequence[Series], twist: Sequence[Fraction]) -> list[Series]:
    """A dual quaternion times w + e v."""
    real, dual = _by_vector(p[:4], twist[:3]), _by_vector(p[4:], twist[:3])
    return real + [_sum(a, b) for a, b in zip(_by_vector(p[:4], twist[3:]), dual, strict=True)]


def _by_vector(p: Sequence[Series], u: Sequence[Fraction]) -> list[Series]:
    """A quaternion times a vector: (-p.u, p0 u + p x u)."""
    found = [_combined([(-u[0], p[1]), (-u[1], p[2]), (-u[2], p[3])])]
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        found.append(_combined([(u[i], p[0]), (u[k], p[1 + j]), (-u[j], p[1 + k])]))
    return found


def _combined(terms: Sequence[tuple[Fraction, Series]]) -> Series:
    length = max(len(series) for _, series in terms)
    return [sum((f * s[k] for f, s in terms if f and k < len(s)), Fraction(0)) for k in range(length)]


def _sum(one: Series, other: Series) -> Series:
    return _combined([(Fraction(1), one), (Fraction(1), other)])


def _times(one: Series, other: Series, order: int) -> Series:
    found = [Fraction(0)] * min(len(one) + len(other) - 1, order + 1)
    for i, a in enumerate(one):
        for j, b in enumerate(other[: max(0, len(found) - i)]):
            if a and b:
                found[i + j] += a * b
    return found
