"""The motion of a mechanism with one freedom to the first order as power series modulo a prime, to high orders.

With half tangents t_i as in ``closure_series``, t = speeds s + terms of higher order: the independent equations give
these terms one from another, and the others either hold at each order or not.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import reduce
from typing import Final

from flint import fmpz, nmod_mat, nmod_poly

from pkm_exact.mobility.instantaneous_mobility import Instantaneous
from pkm_exact.screws.exact_matrix import Row, echelon

VECTOR_PARTS: Final = (1, 2, 3, 5, 6, 7)


def primes_below(start: int, count: int) -> list[int]:
    """So many primes, descending.

    Examples
    --------
    >>> primes_below(20, 3)
    [19, 17, 13]
    """
    found: list[int] = []
    number = start
    while len(found) < count:
        if fmpz(number).is_prime():
            found.append(number)
        number -= 1
    return found


def residue(value: Fraction, prime: int) -> int | None:
    """A rational number modulo a prime; None if the prime divides the denominator.

    Examples
    --------
    >>> residue(Fraction(1, 2), 7), residue(Fraction(1, 7), 7)
    (4, None)
    """
    if value.denominator % prime == 0:
        return None
    return value.numerator * pow(value.denominator, -1, prime) % prime


def residues(rows: Sequence[Sequence[Fraction]], prime: int) -> list[list[int]] | None:
    """A matrix modulo a prime; None if the prime divides a denominator."""
    found = [[residue(value, prime) for value in row] for row in rows]
    kept = [[value for value in row if value is not None] for row in found]
    return kept if all(len(a) == len(b) for a, b in zip(kept, found, strict=True)) else None


def minor_places(matrix: Sequence[Row], columns: Sequence[int]) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Rows and columns, among some columns, of a minor of full rank that is not 0."""
    _, pivots = echelon([[row[k] for k in columns] for row in matrix], len(columns))
    chosen = [columns[k] for k in pivots]
    _, rows = echelon([[row[k] for row in matrix] for k in chosen], len(matrix))
    return tuple(rows), tuple(chosen)


def motion_series(found: Instantaneous, prime: int, order: int) -> list[nmod_poly] | None:
    """The half tangents of all freedoms up to an order, in the one free half tangent.

    None if the loops cannot be closed to this order, or the prime divides what must not be 0.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> from pkm_exact.mobility.instantaneous_mobility import instantaneous
    >>> [str(part) for part in motion_series(instantaneous(read_linkage("models/chains/bennett.toml")), 101, 2)]
    ['2*x^2 + 100*x', 'x', '2*x^2 + 100*x', 'x']
    """
    matrix, twists = residues(found.loops.matrix, prime), residues(found.loops.twists, prime)
    speeds = residues(found.speeds, prime)
    names = found.linkage.freedoms
    rows, columns = minor_places(found.loops.matrix, [k for k, name in enumerate(names) if name not in found.locked])
    if matrix is None or twists is None or speeds is None or len(speeds) != 1:
        return None
    minor = nmod_mat([[matrix[i][j] for j in columns] for i in rows], prime) if rows else None
    if minor is not None and int(minor.det()) == 0:
        return None
    inverse = minor.inv() if minor is not None else None
    others = [k for k in range(len(matrix)) if k not in rows]
    half = [nmod_poly([0, value], prime) for value in speeds[0]]
    for k in range(2, order + 1):
        left = [int(part[k]) for part in closures(found, twists, half, prime, k + 1)]
        change = [0] * len(names)
        if inverse is not None:
            step = inverse * nmod_mat(len(rows), 1, [-left[i] for i in rows], prime)
            for place, column in enumerate(columns):
                change[column] = int(step[place, 0])
        if any((left[i] + sum(a * b for a, b in zip(matrix[i], change, strict=True))) % prime for i in others):
            return None
        half = [part + nmod_poly([0] * k + [x], prime) if x else part for part, x in zip(half, change, strict=True)]
    return half


def closures(
    found: Instantaneous, twists: Sequence[Sequence[int]], half: Sequence[nmod_poly], prime: int, length: int
) -> list[nmod_poly]:
    """The six vector parts of each loop, as polynomials with so many coefficients."""
    parts = []
    for loop in found.loops.loops:
        product = [nmod_poly([int(k == 0)], prime) for k in range(8)]
        for index, sign in loop:
            if half[index].is_zero():
                continue
            turned = times_twist(product, [sign * value for value in twists[index]])
            moved = [part.mul_low(half[index], length) for part in turned]
            product = [a + b for a, b in zip(product, moved, strict=True)]
        parts += [product[k] for k in VECTOR_PARTS]
    return parts


def times_twist(p: Sequence[nmod_poly], twist: Sequence[int]) -> list[nmod_poly]:
    """A dual quaternion times w + e v.

    Examples
    --------
    >>> one = [nmod_poly([int(k == 0)], 7) for k in range(8)]
    >>> [int(part[0]) for part in times_twist(one, [1, 2, 3, 4, 5, 6])]
    [0, 1, 2, 3, 0, 4, 5, 6]
    """
    real, dual = p[:4], p[4:]
    left, right = _times_vector(real, twist[3:]), _times_vector(dual, twist[:3])
    return _times_vector(real, twist[:3]) + [a + b for a, b in zip(left, right, strict=True)]


def _times_vector(p: Sequence[nmod_poly], u: Sequence[int]) -> list[nmod_poly]:
    """A quaternion times a vector: (-p.u, p0 u + p x u)."""
    terms: list[list[tuple[int, nmod_poly]]] = [[(-u[0], p[1]), (-u[1], p[2]), (-u[2], p[3])]]
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        terms.append([(u[i], p[0]), (u[k], p[1 + j]), (-u[j], p[1 + k])])
    return [reduce(lambda total, term: total + term[1] * term[0], row, p[0] * 0) for row in terms]
