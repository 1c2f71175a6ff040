"""An upper bound of the dimension from the ideal itself, in the local ring at the configuration.

The independent equations of the loops give their half tangents as power series in the others, the free ones; the rest
of the equations are power series f_j in these. Cut by c linear forms, n free half tangents are combinations of
z_1, .., z_k, k = n - c. If, for some D,

    every monomial of degree D in z is a combination of multiples of f_j and of terms of higher degree,

then by Nakayama's lemma it is one of multiples of f_j alone: the point is isolated on the cut, also over the complex
numbers, and the configurations have at most c dimensions there. All of this is a rank, of finitely many coefficients.

It is enough modulo one prime p that divides no denominator and not the minor: Z_p[[z]] modulo the f_j is then finitely
generated over Z_p, the p-adic integers, because it is modulo p, so that it has finite dimension over their quotients.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations_with_replacement
from math import comb
from typing import Final, TypeAlias

from flint import nmod_mat

from pkm_exact.mobility.instantaneous_mobility import Instantaneous
from pkm_exact.mobility.motion_series import VECTOR_PARTS, minor_places, residues
from pkm_exact.mobility.second_order import section_vectors
from pkm_exact.screws.exact_matrix import Row, product

PRIME: Final = 2**61 - 1
MOST_DEGREE: Final = 12
MOST_MONOMIALS: Final = 130
MOST_FREEDOMS: Final = 36
"""The prime, degrees D, monomials up to this degree, and freedoms that are looked at; beyond, nothing is known."""

Monomial: TypeAlias = tuple[int, ...]


def local_dimension(found: Instantaneous, least: int, most: int) -> int:
    """An upper bound, proved, of the dimension of the complex configurations near the given one; none below ``least``.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> from pkm_exact.mobility.instantaneous_mobility import instantaneous
    >>> local_dimension(instantaneous(read_linkage("models/chains/seven-link-oblique.toml")), 0, 2)
    1
    """
    while most > least and local_degree(found, section_vectors(found.total, most - 1)) is not None:
        most -= 1
    return most


def local_degree(found: Instantaneous, section: Sequence[Row]) -> int | None:
    """The least degree of which all monomials are in the ideal, on a section of the motions; None if none is found."""
    count = len(section)
    twists = [found.loops.twists[index] for loop in found.loops.loops for index, _ in loop]
    lines = all(sum(a * b for a, b in zip(t[:3], t[3:], strict=True)) == 0 for t in twists)
    if not lines or found.locked or len(found.linkage.freedoms) > MOST_FREEDOMS:
        return None
    for degree in range(2, MOST_DEGREE + 1):
        if comb(count + degree, degree) > MOST_MONOMIALS:
            break
        if _contains(found, section, degree):
            return degree
    return None


class _Truncated:
    """Polynomials in so many unknowns up to a degree, modulo the prime: coefficients by degrees of the monomials."""

    def __init__(self, count: int, degree: int) -> None:
        self.degree = degree
        self.monomials: list[Monomial] = [
            monomial for size in range(degree + 1) for monomial in combinations_with_replacement(range(count), size)
        ]
        places = {monomial: place for place, monomial in enumerate(self.monomials)}
        self.times = [
            [places[tuple(sorted((*a, *b)))] for b in self.monomials if len(a) + len(b) <= degree]
            for a in self.monomials
        ]

    def multiplication(self, factor: Sequence[int]) -> nmod_mat:
        """The matrix that multiplies by a polynomial."""
        size = len(self.monomials)
        entries = [[0] * size for _ in range(size)]
        for value, row in zip(factor, self.times, strict=True):
            if value:
                for source, target in enumerate(row):
                    entries[target][source] = value
        return nmod_mat(entries, PRIME)


def _contains(found: Instantaneous, section: Sequence[Row], degree: int) -> bool:
    """Whether all monomials of the degree are in the ideal of the equations, on the section."""
    ring = _Truncated(len(section), degree)
    others = _other_equations(found, section, ring)
    if others is None:
        return False
    rows = []
    for equation in others:
        for factor, row in zip(ring.monomials, ring.times, strict=True):
            if len(factor) <= degree - 2 and any(equation):
                entries = [0] * len(ring.monomials)
                for source, target in enumerate(row):
                    entries[target] = equation[source]
                rows.append(entries)
    if not rows:
        return False
    reduced, rank = nmod_mat(rows, PRIME).rref()
    highest = sum(len(monomial) == degree for monomial in ring.monomials)
    start = len(ring.monomials) - highest
    return sum(not any(int(reduced[i, j]) for j in range(start)) for i in range(rank)) == highest


def _other_equations(found: Instantaneous, section: Sequence[Row], ring: _Truncated) -> list[list[int]] | None:
    """The equations that do not follow to the first order, as series on the section; None if the prime does not do."""
    loops, size = found.loops, len(ring.monomials)
    matrix, twists = residues(loops.matrix, PRIME), residues(loops.twists, PRIME)
    motions = residues(product(section, found.speeds), PRIME)
    rows, columns = minor_places(loops.matrix, range(len(loops.twists)))
    if matrix is None or twists is None or motions is None:
        return None
    minor = nmod_mat(len(rows), len(rows), [matrix[i][j] for i in rows for j in columns], PRIME)
    if rows and int(minor.det()) == 0:
        return None
    inverse = minor.inv() if rows else minor
    half = [[0, *(motion[k] for motion in motions), *[0] * (size - 1 - len(motions))] for k in range(len(twists))]
    left = _closures(found, twists, half, ring)
    for _ in range(ring.degree):
        if not rows or not any(any(left[i]) for i in rows):
            break
        steps = (inverse * nmod_mat([left[i] for i in rows], PRIME)).tolist()
        for column, step in zip(columns, steps, strict=True):
            half[column] = [(a - int(b)) % PRIME for a, b in zip(half[column], step, strict=True)]
        left = _closures(found, twists, half, ring)
    return [values for k, values in enumerate(left) if k not in rows]


def _closures(
    found: Instantaneous, twists: Sequence[Sequence[int]], half: Sequence[Sequence[int]], ring: _Truncated
) -> list[list[int]]:
    """The six vector parts of each loop."""
    size = len(ring.monomials)
    factors = [ring.multiplication(values) for values in half]
    parts: list[list[int]] = []
    for loop in found.loops.loops:
        product = nmod_mat(size, 8, [int(k == 0) for k in range(8 * size)], PRIME)
        for index, sign in loop:
            product += factors[index] * (product * _by_twist([sign * value for value in twists[index]]))
        rows = product.transpose().tolist()
        parts += [[int(value) for value in rows[k]] for k in VECTOR_PARTS]
    return parts


def _by_twist(twist: Sequence[int]) -> nmod_mat:
    """The matrix of the product p (w + e v), for p as a row."""
    entries = [[0] * 8 for _ in range(8)]
    for vector, pairs in ((twist[:3], ((0, 0), (4, 4))), (twist[3:], ((0, 4),))):
        for source, target in pairs:
            for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
                entries[source + 1 + i][target] += -vector[i]
                entries[source][target + 1 + i] += vector[i]
                entries[source + 1 + j][target + 1 + i] += vector[k]
                entries[source + 1 + k][target + 1 + i] += -vector[j]
    return nmod_mat([[value % PRIME for value in row] for row in entries], PRIME)
