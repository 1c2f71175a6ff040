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


def branch_series(
    found: Instantaneous, direction: Sequence[Fraction], prime: int, order: int
) -> list[nmod_poly] | None:
    """The half tangents of a branch that leaves a singular configuration in a direction, up to an order.

    ``direction`` are factors of the speeds. The terms of order k are free but for those that the independent equations
    give; what the others ask of order k + 1 is linear in them. None if this does not determine them, up to the
    parameter, or cannot be fulfilled.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> from pkm_exact.mobility.instantaneous_mobility import instantaneous
    >>> singular = instantaneous(read_linkage("models/chains/seven-link-oblique.toml"))
    >>> branch_series(singular, [Fraction(1), Fraction(0)], 101, 3) is None
    True
    """
    matrix, twists = residues(found.loops.matrix, prime), residues(found.loops.twists, prime)
    speeds, along = residues(found.speeds, prime), residues([direction], prime)
    if matrix is None or twists is None or speeds is None or along is None or not any(along[0]):
        return None
    solved = _Split(found, matrix, prime)
    if not solved.is_regular:
        return None
    start = [sum(y * row[k] for y, row in zip(along[0], speeds, strict=True)) % prime for k in range(len(twists))]
    half = [nmod_poly([0, value], prime) for value in start]
    gauge = next(k for k, y in enumerate(along[0]) if y)
    moving = [row for k, row in enumerate(speeds) if k != gauge]

    def left_at(tried: Sequence[nmod_poly], power: int) -> tuple[list[int], list[int]]:
        return solved.split([int(part[power]) for part in closures(found, twists, tried, prime, power + 1)])

    def moved(values: Sequence[int], power: int) -> list[nmod_poly]:
        return [part + nmod_poly([0] * power + [x], prime) for part, x in zip(half, values, strict=True)]

    still = left_at(half, 3)[1]
    columns = [[(a - b) % prime for a, b in zip(left_at(moved(row, 2), 3)[1], still, strict=True)] for row in moving]
    slopes = nmod_mat(len(still), len(columns), [column[i] for i in range(len(still)) for column in columns], prime)
    if int(slopes.rank()) < len(columns):
        return None
    for k in range(2, order + 1):
        given, rest = left_at(half, k)
        if any(rest):
            return None
        half = moved(solved.correction(given), k)
        factors = _solution(slopes, [-value for value in left_at(half, k + 1)[1]], prime)
        if factors is None:
            return None
        half = moved([sum(y * row[i] for y, row in zip(factors, moving, strict=True)) for i in range(len(twists))], k)
    return half


class _Split:
    """Independent equations, solved for some half tangents, and what is left of the others without these."""

    def __init__(self, found: Instantaneous, matrix: Sequence[Sequence[int]], prime: int) -> None:
        names = found.linkage.freedoms
        free = [k for k, name in enumerate(names) if name not in found.locked]
        self.rows, self.columns = minor_places(found.loops.matrix, free)
        self.prime, self.size = prime, len(names)
        self.others = [k for k in range(len(matrix)) if k not in self.rows]
        count = len(self.rows)
        minor = nmod_mat(count, count, [matrix[i][j] for i in self.rows for j in self.columns], prime)
        self.is_regular = bool(count) and bool(self.others) and int(minor.det()) != 0
        if self.is_regular:
            self.inverse = minor.inv()
            self.linear = nmod_mat([[matrix[i][j] for j in self.columns] for i in self.others], prime) * self.inverse

    def split(self, values: Sequence[int]) -> tuple[list[int], list[int]]:
        """Of terms of one order those of the independent equations, and those of the others less their multiples."""
        given = [values[i] for i in self.rows]
        follows = (self.linear * nmod_mat(len(given), 1, given, self.prime)).entries()
        return given, [(values[i] - int(x)) % self.prime for i, x in zip(self.others, follows, strict=True)]

    def correction(self, given: Sequence[int]) -> list[int]:
        """The terms of the half tangents that make up for those of the independent equations."""
        found = [0] * self.size
        steps = (self.inverse * nmod_mat(len(given), 1, [-value for value in given], self.prime)).entries()
        for column, step in zip(self.columns, steps, strict=True):
            found[column] = int(step)
        return found


def _solution(matrix: nmod_mat, right: Sequence[int], prime: int) -> list[int] | None:
    """The x with A x = b, of a matrix whose columns are independent; None if there is none."""
    count = matrix.ncols()
    rows = [[*map(int, row), value] for row, value in zip(matrix.tolist(), right, strict=True)]
    reduced, rank = nmod_mat(rows, prime).rref()
    if rank > count:
        return None
    return [int(reduced[k, count]) for k in range(count)]
