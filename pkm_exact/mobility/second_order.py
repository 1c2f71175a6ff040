"""The second order of the equations of loops: speeds for which no accelerations fit are speeds of no motion.

Along a loop with twists S_i, signs s_i and joint values q_i near 0 the product of exp(s_i q_i S_i) is 1, so that by the
formula of Baker, Campbell and Hausdorff, with x_i = s_i q_i S_i,

    sum x_i + 1/2 sum over i < j of [x_i, x_j] + terms of third order = 0.

For a curve q(t) = q_k t^k + .. the terms of order k and 2 k give M q_k = 0 and u.Q(q_k) = 0 for every u with u M = 0, Q
the quadratic terms. So the tangent cone of the complex configurations lies in the cone of these q_k, and they have no
more dimensions than it. And if one u.Q is 0 at no real motion but 0, no real curve begins there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations_with_replacement
from math import comb
from typing import Final, TypeAlias

from pkm_exact.mobility.instantaneous_mobility import Instantaneous
from pkm_exact.screws.exact_matrix import Row, null_space, rank
from pkm_exact.screws.screw import Screw

Quadratic: TypeAlias = dict[tuple[int, int], Fraction]
"""Coefficients of y_i y_j, i <= j."""

MOST_MONOMIALS: Final = 500
MOST_TERMS: Final = 100_000
"""Bound the matrices that are looked at, and the products that make the quadratic forms."""


@dataclass(frozen=True)
class Obstruction:
    """A dependency of the equations, and what it asks of motions in the second order: that its form is 0.

    Attributes
    ----------
    factors : tuple of Fraction
        u with u M = 0, a number for each equation of the loops.
    form : dict
        u.Q on the motions.
    """

    factors: Row
    form: Quadratic


def cone_dimension(found: Instantaneous) -> int:
    """An upper bound, proved, of the dimension of the cone of speeds that have accelerations; often the dimension.

    Sections of the cone with fewer and fewer linear forms are looked at: if d forms leave 0 alone, real or complex, it
    has at most d complex dimensions; so have the complex configurations, and no more the real ones.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> from pkm_exact.mobility.instantaneous_mobility import instantaneous
    >>> found = instantaneous(read_linkage("models/chains/seven-link-oblique.toml"))
    >>> found.total, cone_dimension(found)
    (2, 1)
    """
    quadratics = [entry.form for entry in obstructions(found)]
    best = found.total
    if not quadratics:
        return best
    for dimension in range(found.total - 1, -1, -1):
        kept = found.total - dimension
        if not _spans([_section(form, found.total, dimension) for form in quadratics], kept, kept + 1):
            break
        best = dimension
    return best


def closing_degree(found: Instantaneous, dimension: int) -> int | None:
    """The least degree of which all monomials are combinations of multiples of the forms, cut to so many dimensions.

    None if there is none up to Macaulay's bound: the section of the cone is not proved to be 0.
    """
    kept = found.total - dimension
    cut = [_section(entry.form, found.total, dimension) for entry in obstructions(found)]
    return next((degree for degree in range(2, kept + 2) if _spans(cut, kept, degree)), None)


def section_vectors(count: int, dimension: int) -> tuple[Row, ...]:
    """A basis of the space that the cone is cut with."""
    kept = count - dimension
    rows = [[Fraction(0)] * count for _ in range(kept)]
    for place in range(count):
        for k, value in _expanded(place, kept).items():
            rows[k][place] = Fraction(value)
    return tuple(map(tuple, rows))


@dataclass(frozen=True)
class Signature:
    """Numbers of positive, negative and zero squares of a real quadratic form."""

    positive: int
    negative: int
    zero: int

    @property
    def is_definite(self) -> bool:
        """Whether the form is 0 at 0 only."""
        return not self.zero and not (self.positive and self.negative)

    @property
    def is_indefinite(self) -> bool:
        """Whether the form takes both signs."""
        return bool(self.positive and self.negative)


def signature(form: Quadratic, count: int) -> Signature:
    """The signature of a form, by congruence over the rational numbers.

    Examples
    --------
    >>> signature({(0, 1): Fraction(1)}, 3)
    Signature(positive=1, negative=1, zero=1)
    """
    signs = [value > 0 for value, _ in squares(form, count)]
    return Signature(signs.count(True), signs.count(False), count - len(signs))


def squares(form: Quadratic, count: int) -> list[tuple[Fraction, Row]]:
    """Vectors that are orthogonal for the form, with its values there, none 0; on the rest of the space it is 0.

    Examples
    --------
    >>> [(str(value), [str(x) for x in vector]) for value, vector in squares({(0, 1): Fraction(1)}, 2)]
    [('1', ['1', '1']), ('-1/4', ['1/2', '-1/2'])]
    """
    matrix = [[Fraction(0)] * count for _ in range(count)]
    for (i, j), value in form.items():
        matrix[i][j] += value / 2
        matrix[j][i] += value / 2
    vectors = [[Fraction(int(i == j)) for j in range(count)] for i in range(count)]
    found: list[tuple[Fraction, Row]] = []
    while matrix:
        size = len(matrix)
        place = next((k for k in range(size) if matrix[k][k]), None)
        if place is None:
            pair = next(((i, j) for i in range(size) for j in range(i) if matrix[i][j]), None)
            if pair is None:
                break
            # y_i + y_j in place of y_i has a square.
            i, j = pair
            matrix[i] = [a + b for a, b in zip(matrix[i], matrix[j], strict=True)]
            for row in matrix:
                row[i] += row[j]
            vectors[i] = [a + b for a, b in zip(vectors[i], vectors[j], strict=True)]
            place = i
        pivot, along = matrix[place], vectors[place]
        found.append((pivot[place], tuple(along)))
        kept = [k for k in range(size) if k != place]
        vectors = [[a - pivot[i] / pivot[place] * b for a, b in zip(vectors[i], along, strict=True)] for i in kept]
        matrix = [[matrix[i][j] - pivot[i] * pivot[j] / pivot[place] for j in kept] for i in kept]
    return found


def obstructions(found: Instantaneous) -> list[Obstruction]:
    """The quadratic forms u.Q on the motions for a basis of all u with u M = 0, without forms that are 0.

    None at all if there would be too many products to form: then nothing is known of the second order.
    """
    matrix = found.loops.matrix
    pairs = sum(len(loop) ** 2 for loop in found.loops.loops)
    if not matrix or not found.speeds or pairs * found.total**2 > MOST_TERMS:
        return []
    shut = {found.linkage.freedoms.index(name) for name in found.locked}
    free = [[value for k, value in enumerate(row) if k not in shut] for row in matrix]
    dependent = null_space(list(zip(*free, strict=True)), len(free)) if free[0] else ()
    brackets = [_second_order(found, loop) for loop in range(len(found.loops.loops))]
    forms = []
    for factors in dependent:
        form: Quadratic = {}
        for loop, terms in enumerate(brackets):
            weights = factors[6 * loop : 6 * loop + 6]
            for pair, twist in terms.items():
                value = sum((a * b for a, b in zip(weights, twist, strict=True)), Fraction(0))
                form[pair] = form.get(pair, Fraction(0)) + value
        forms.append(Obstruction(factors, form))
    return [entry for entry in forms if any(entry.form.values())]


def _second_order(found: Instantaneous, loop: int) -> dict[tuple[int, int], Row]:
    """The coefficients of y_i y_j in the sum of [x_i, x_j], for speeds that are combinations y of the motions."""
    along = found.loops.loops[loop]
    count = len(found.speeds)
    twists = [Screw.from_coordinates(found.loops.twists[index]) for index, _ in along]
    speeds = [[sign * row[index] for row in found.speeds] for index, sign in along]
    terms: dict[tuple[int, int], list[Fraction]] = {}
    for second in range(len(along)):
        for first in range(second):
            if not any(speeds[first]) or not any(speeds[second]):
                continue
            bracket = twists[first].bracket(twists[second]).coordinates
            for i in range(count):
                for j in range(count):
                    factor = speeds[first][i] * speeds[second][j]
                    if factor:
                        entry = terms.setdefault((min(i, j), max(i, j)), [Fraction(0)] * 6)
                        for k, value in enumerate(bracket):
                            entry[k] += factor * value
    return {pair: tuple(entry) for pair, entry in terms.items()}


def _expanded(place: int, kept: int) -> dict[int, int]:
    """A coordinate as a combination of those that are kept, with small coefficients."""
    if place < kept:
        return {place: 1}
    return {i: (i + 2) ** (place - kept + 1) + place for i in range(kept)}


def _section(form: Quadratic, count: int, dimension: int) -> Quadratic:
    """The form where y_k for the last ``dimension`` places is a combination of the others."""
    kept = count - dimension
    found: Quadratic = {}
    for (i, j), value in form.items():
        for a, x in _expanded(i, kept).items():
            for b, y in _expanded(j, kept).items():
                pair = (min(a, b), max(a, b))
                found[pair] = found.get(pair, Fraction(0)) + value * x * y
    return found


def _spans(forms: Sequence[Quadratic], count: int, degree: int) -> bool:
    """Whether all monomials of a degree are combinations of multiples of forms: then 0 is their only common zero.

    If it is, real and complex, they are so of degree count + 1, by Macaulay's bound. False too if they are too many.
    """
    if comb(count + degree - 1, degree) > MOST_MONOMIALS:
        return False
    monomials = {m: k for k, m in enumerate(combinations_with_replacement(range(count), degree))}
    rows = []
    for form in forms:
        for factor in combinations_with_replacement(range(count), degree - 2):
            row = [Fraction(0)] * len(monomials)
            for pair, value in form.items():
                row[monomials[tuple(sorted((*pair, *factor)))]] += value
            rows.append(row)
    return rank(rows, len(monomials)) == len(monomials)
