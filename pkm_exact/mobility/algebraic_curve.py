"""Motions of one freedom in closed form: half tangents as rational functions on an algebraic curve.

The power series of a motion satisfy polynomial relations if it is algebraic, as all motions of hinges and slides are.
With the half tangents s and u of two joints there is one relation F(s, u) = 0, and the others are quotients
N(s, u) / D(s).
They are guessed from series modulo primes and lifted to the rational numbers; then they are proved: F is regular at
(0, 0), so that u(s) is a real analytic function, and the loops are closed for polynomials modulo F.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import gcd, isqrt, lcm
from typing import Final, TypeAlias

from flint import fmpz_poly, nmod_mat, nmod_poly

from pkm_exact.mobility.instantaneous_mobility import Instantaneous
from pkm_exact.mobility.motion_series import VECTOR_PARTS, branch_series, motion_series, primes_below
from pkm_exact.screws.exact_matrix import Row

ORDER: Final = 120
MOST_FREEDOMS: Final = 24
MOST_DEGREE: Final = 10
MOST_SHEETS: Final = 4
MOST_PRIMES: Final = 12
LARGEST_PRIME: Final = 2**61 - 1
"""Orders of the series, freedoms, degrees in s and in u, and primes that are looked at; beyond, nothing is known."""

Sheets: TypeAlias = tuple[Row, ...]
"""A polynomial in s and u: for each power of u the coefficients in s, lowest degree first."""
_Half: TypeAlias = tuple[list[fmpz_poly], fmpz_poly]


@dataclass(frozen=True)
class AlgebraicCurve:
    """A real curve of configurations through the given one.

    Attributes
    ----------
    relation : tuple of rows
        F, with F(0, 0) = 0 and dF/du not 0 there.
    halves : tuple of (tuple of rows, row)
        For each freedom N and D; N(0, 0) = 0 and D(0) is not.
    """

    relation: Sheets
    halves: tuple[tuple[Sheets, Row], ...]

    @property
    def speeds(self) -> Row:
        """The speeds at s = 0 of all freedoms, for s with speed 1.

        Examples
        --------
        >>> zero, one, two = Fraction(0), Fraction(1), Fraction(2)
        >>> circle = ((zero, two, one), (two,), (one,))
        >>> AlgebraicCurve(circle, ((((zero, one),), (one,)), (((zero,), (one,)), (two,)))).speeds
        (Fraction(1, 1), Fraction(-1, 2))
        """
        slope = -_entry(self.relation, 0, 1) / _entry(self.relation, 1, 0)
        return tuple((_entry(n, 0, 1) + _entry(n, 1, 0) * slope) / d[0] for n, d in self.halves)


def _entry(sheets: Sheets, sheet: int, power: int) -> Fraction:
    return sheets[sheet][power] if sheet < len(sheets) and power < len(sheets[sheet]) else Fraction(0)


def algebraic_curve(found: Instantaneous, direction: Sequence[Fraction] | None = None) -> AlgebraicCurve | None:
    """The motion of a mechanism with one freedom to the first order; None if it has none or none is found.

    With more of them the motion that begins in a direction, factors of the speeds.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> from pkm_exact.mobility.instantaneous_mobility import instantaneous
    >>> motion = algebraic_curve(instantaneous(read_linkage("models/chains/bennett.toml")))
    >>> [str(speed) for speed in motion.speeds]
    ['1', '-1', '1', '-1']
    """
    names = found.linkage.freedoms
    twists = [found.loops.twists[index] for loop in found.loops.loops for index, _ in loop]
    lines = all(sum(a * b for a, b in zip(t[:3], t[3:], strict=True)) == 0 for t in twists)
    if (direction is None and found.total != 1) or not lines or len(names) - len(found.locked) > MOST_FREEDOMS:
        return None
    primes = primes_below(LARGEST_PRIME, MOST_PRIMES)
    series = _series(found, direction, primes[0], ORDER)
    if series is None:
        return None
    shape = next(_shapes(series, primes[0]), None)
    if shape is None:
        return None
    curve = _lifted(found, direction, shape, primes)
    return curve if curve is not None and closes(found, curve) else None


def _series(
    found: Instantaneous, direction: Sequence[Fraction] | None, prime: int, order: int
) -> list[nmod_poly] | None:
    if direction is None:
        return motion_series(found, prime, order)
    return branch_series(found, direction, prime, order)


@dataclass(frozen=True)
class _Shape:
    """Which joints are s and u, the degrees of F, and those of the quotients; no u if all are rational in s."""

    first: int
    second: int | None
    degree: int
    sheets: int
    degrees: tuple[int, ...]

    @property
    def order(self) -> int:
        """Orders that determine all coefficients, and some more."""
        return max((self.degree + 1) * (self.sheets + 1), *((e + 1) * (self.sheets + 1) for e in self.degrees)) + 8

    def vectors(self, series: Sequence[nmod_poly], prime: int, order: int) -> list[list[int]] | None:
        """The coefficients of F and of each quotient modulo a prime, the last that is not 0 being 1."""
        s, u = series[self.first], None if self.second is None else series[self.second]
        found = [] if u is None else [_relation(s, u, self.degree, self.sheets, prime, order)]
        found += [
            _quotient(s, u, part, e, self.sheets, prime, order) for part, e in zip(series, self.degrees, strict=True)
        ]
        kept = [entry for entry in found if entry is not None]
        return kept if len(kept) == len(found) else None


def _shapes(series: Sequence[nmod_poly], prime: int) -> Iterator[_Shape]:
    """Pairs of joints whose half tangents give all others, those of few sheets first."""
    moving = [k for k, part in enumerate(series) if part[1]]
    pairs = []
    for first, second in product(moving, moving):
        if first == second:
            continue
        for sheets in range(1, MOST_SHEETS + 1):
            if _kernel(_products(series[first], series[second], MOST_DEGREE, sheets, ORDER), prime, ORDER):
                pairs.append((sheets, first, second))
                break
    most = {first: max((n for n, one, _ in pairs if one == first), default=0) for first in moving}
    counted = {first: sum(one == first for _, one, _ in pairs) for first in moving}
    for first in sorted((k for k in moving if counted[k] == len(moving) - 1), key=lambda k: most[k]):
        if most[first] <= 1:
            candidates: list[int | None] = [None]
        else:
            candidates = [second for n, one, second in pairs if one == first and n == most[first]]
        for other in candidates:
            shape = _shape(series, first, other, max(1, most[first]), prime)
            if shape is not None:
                yield shape


def _shape(series: Sequence[nmod_poly], first: int, second: int | None, sheets: int, prime: int) -> _Shape | None:
    s, u = series[first], None if second is None else series[second]
    degree = 0
    if u is not None:
        fits = [a for a in range(1, MOST_DEGREE + 1) if _relation(s, u, a, sheets, prime, ORDER) is not None]
        if not fits:
            return None
        degree = fits[0]
    degrees = []
    for part in series:
        tried = ((e, _quotient(s, u, part, e, sheets, prime, ORDER)) for e in range(MOST_DEGREE + 1))
        e, vector = next(((e, vector) for e, vector in tried if vector is not None), (0, [0]))
        if not vector[0]:  # none was found, or D(0) is 0
            return None
        degrees.append(e)
    return _Shape(first, second, degree, sheets, tuple(degrees))


def _products(s: nmod_poly, u: nmod_poly, degree: int, sheets: int, order: int) -> list[nmod_poly]:
    """s^k u^l, by l and then by k."""
    one = s**0
    found = []
    for _ in range(sheets + 1):
        power = one
        for _ in range(degree + 1):
            found.append(power)
            power = power.mul_low(s, order)
        one = one.mul_low(u, order)
    return found


def _kernel(columns: Sequence[nmod_poly], prime: int, order: int) -> list[list[int]]:
    """All combinations of series that are 0 up to an order."""
    matrix = nmod_mat([[int(column[k]) for column in columns] for k in range(order)], prime)
    basis, nullity = matrix.nullspace()
    return [[int(basis[k, j]) for k in range(len(columns))] for j in range(nullity)]


def _only(kernel: Sequence[Sequence[int]], prime: int) -> list[int] | None:
    """The combination, if there is one only, with 1 as its last entry that is not 0."""
    if len(kernel) != 1:
        return None
    last = next(value for value in reversed(kernel[0]) if value)
    inverse = pow(last, -1, prime)
    return [value * inverse % prime for value in kernel[0]]


def _relation(s: nmod_poly, u: nmod_poly, degree: int, sheets: int, prime: int, order: int) -> list[int] | None:
    return _only(_kernel(_products(s, u, degree, sheets, order), prime, order), prime)


def _quotient(
    s: nmod_poly, u: nmod_poly | None, part: nmod_poly, degree: int, sheets: int, prime: int, order: int
) -> list[int] | None:
    """D, then N."""
    below = _products(s, s**0 if u is None else u, degree, sheets - 1, order)
    above = [power.mul_low(part, order) for power in below[: degree + 1]]
    return _only(_kernel([*above, *below], prime, order), prime)


def _lifted(
    found: Instantaneous, direction: Sequence[Fraction] | None, shape: _Shape, primes: Sequence[int]
) -> AlgebraicCurve | None:
    """The curve over the rational numbers that has these coefficients modulo primes; it is still to be proved."""
    known: list[list[int]] = []
    modulus = 1
    before: list[list[Fraction]] | None = None
    for prime in primes:
        series = _series(found, direction, prime, shape.order)
        vectors = None if series is None else shape.vectors(series, prime, shape.order)
        if vectors is None:
            continue
        if known:
            inverse = pow(modulus, -1, prime)
            known = [
                [a + modulus * ((b - a) * inverse % prime) for a, b in zip(one, other, strict=True)]
                for one, other in zip(known, vectors, strict=True)
            ]
        else:
            known = vectors
        modulus *= prime
        lifted = [[_rational(value, modulus) for value in vector] for vector in known]
        certain = [[value for value in vector if value is not None] for vector in lifted]
        if certain == before:
            return _curve(shape, certain)
        before = certain if all(len(a) == len(b) for a, b in zip(certain, known, strict=True)) else None
    return None


def _rational(value: int, modulus: int) -> Fraction | None:
    """The fraction of numbers below the root of half the modulus that is the value modulo it."""
    bound = isqrt(modulus // 2)
    a, b, x, y = modulus, value % modulus, 0, 1
    while b > bound:
        q = a // b
        a, b, x, y = b, a - q * b, y, x - q * y
    if not y or abs(y) > bound or gcd(b, y) != 1:
        return None
    return Fraction(b, y)


def _curve(shape: _Shape, vectors: Sequence[Sequence[Fraction]]) -> AlgebraicCurve:
    relation: Sheets = ((Fraction(0),), (Fraction(1),))
    quotients = list(vectors)
    if shape.second is not None:
        relation = _sheets(quotients.pop(0), shape.degree)
    halves = []
    for vector, e in zip(quotients, shape.degrees, strict=True):
        denominator = vector[: e + 1]
        halves.append((_sheets([-x for x in vector[e + 1 :]], e), _trimmed(denominator)))
    return AlgebraicCurve(relation, tuple(halves))


def _sheets(vector: Sequence[Fraction], degree: int) -> Sheets:
    parts = [_trimmed(vector[k : k + degree + 1]) for k in range(0, len(vector), degree + 1)]
    while len(parts) > 1 and not any(parts[-1]):
        parts.pop()
    return tuple(parts)


def _trimmed(values: Sequence[Fraction]) -> Row:
    last = max((k for k, value in enumerate(values) if value), default=0)
    return tuple(values[: last + 1])


def closes(found: Instantaneous, curve: AlgebraicCurve) -> bool:
    """Whether the half tangents close all loops, exactly, and begin at the configuration."""
    if _entry(curve.relation, 0, 0) or not _entry(curve.relation, 1, 0) or not any(curve.speeds):
        return False
    if any(_entry(n, 0, 0) or not d[0] for n, d in curve.halves):
        return False
    relation, _ = _whole(curve.relation, (Fraction(1),))
    halves = [_whole(n, d) for n, d in curve.halves]
    scale = lcm(*(value.denominator for twist in found.loops.twists for value in twist))
    twists = [[int(value * scale) for value in twist] for twist in found.loops.twists]
    for loop in found.loops.loops:
        product = [[fmpz_poly([int(k == 0)])] for k in range(8)]
        for index, sign in loop:
            numerator, denominator = halves[index]
            if not any(numerator):
                continue
            turned = _times_twist(product, [sign * value for value in twists[index]])
            product = [
                _added(_scaled(a, denominator * scale), _multiplied(b, numerator))
                for a, b in zip(product, turned, strict=True)
            ]
            product = _reduced(product, relation)
        if any(any(product[k]) for k in VECTOR_PARTS):
            return False
    return True


def _whole(sheets: Sheets, denominator: Row) -> _Half:
    """Numerator and denominator times a common integer."""
    scale = lcm(*(x.denominator for row in (*sheets, denominator) for x in row))
    return [fmpz_poly([int(x * scale) for x in row]) for row in sheets], fmpz_poly(
        [int(x * scale) for x in denominator]
    )


def _reduced(product: list[list[fmpz_poly]], relation: Sequence[fmpz_poly]) -> list[list[fmpz_poly]]:
    """Times a power of the leading coefficient of F, and less multiples of F: of smaller degree in u."""
    *lower, leading = relation
    size = len(lower)
    while max(map(len, product)) > size:
        degree = max(map(len, product)) - 1
        parts = []
        for part in product:
            top = part[degree] if len(part) > degree else fmpz_poly()
            rest = _scaled(part[:degree], leading)
            shifted = [fmpz_poly()] * (degree - size) + [-top * value for value in lower]
            parts.append(_added(rest, shifted))
        product = parts
    return product


def _added(one: Sequence[fmpz_poly], other: Sequence[fmpz_poly]) -> list[fmpz_poly]:
    longer, shorter = (one, other) if len(one) >= len(other) else (other, one)
    return [a + shorter[k] if k < len(shorter) else a for k, a in enumerate(longer)]


def _scaled(one: Sequence[fmpz_poly], factor: fmpz_poly | int) -> list[fmpz_poly]:
    return [a * factor for a in one]


def _multiplied(one: Sequence[fmpz_poly], other: Sequence[fmpz_poly]) -> list[fmpz_poly]:
    found = [fmpz_poly()] * (len(one) + len(other) - 1)
    for i, a in enumerate(one):
        for j, b in enumerate(other):
            found[i + j] += a * b
    return found


def _times_twist(p: Sequence[list[fmpz_poly]], twist: Sequence[int]) -> list[list[fmpz_poly]]:
    """A dual quaternion times w + e v."""
    real, dual = p[:4], p[4:]
    left, right = _times_vector(real, twist[3:]), _times_vector(dual, twist[:3])
    return _times_vector(real, twist[:3]) + [_added(a, b) for a, b in zip(left, right, strict=True)]


def _times_vector(p: Sequence[list[fmpz_poly]], u: Sequence[int]) -> list[list[fmpz_poly]]:
    """A quaternion times a vector: (-p.u, p0 u + p x u)."""
    rows = [[(-u[0], p[1]), (-u[1], p[2]), (-u[2], p[3])]]
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        rows.append([(u[i], p[0]), (u[k], p[1 + j]), (-u[j], p[1 + k])])
    found = []
    for row in rows:
        total: list[fmpz_poly] = [fmpz_poly()]
        for factor, part in row:
            total = _added(total, _scaled(part, factor))
        found.append(total)
    return found
