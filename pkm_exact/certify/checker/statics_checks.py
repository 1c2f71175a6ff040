"""The checks of a statics certificate, numbered as in ``docs/certificates-statics.md``."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import combinations, product
from math import comb, isqrt, lcm
from typing import Final

from flint import arb, ctx, fmpq, fmpq_mat, fmpz_mat

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.statics_document import (
    EllipsoidClaim,
    Numbers,
    StaticsDocument,
    VelocityClaim,
    WrenchClaim,
    effort,
)
from pkm_exact.certify.checker.verdict import rejected, too_large

MAX_CANDIDATES: Final = 20_000
NEARLY: Final = 1 - Fraction(1, 10**12)

Sides = frozenset[tuple[int, int]]


def check_statics(document: StaticsDocument) -> Iterator[str]:
    """One line per claim."""
    yield f"machine: {len(document.rows)} legs at a pose, {len(document.columns)} freedoms"
    if document.velocity is not None and document.speeds is not None:
        _Velocities(document, document.speeds).check(document.velocity)
        facets, vertices = document.velocity.facets, document.velocity.vertices
        yield f"velocity polytope: {len(vertices)} vertices, {len(facets)} facets, and no others"
    if document.wrench is not None and document.forces is not None:
        _check_wrench(document, document.forces, document.wrench)
        facet_count, vertex_count = len(document.wrench.facets), len(document.wrench.vertices)
        yield f"wrench polytope: {vertex_count} vertices, {facet_count} facets, and no others"
    if document.ellipsoid is not None and document.speeds is not None:
        _check_ellipsoid(document, document.speeds, document.ellipsoid)
        yield "ellipsoid: in the velocity polytope, and no larger one but for a part in 10^12 of the volume"
    if document.indices is not None:
        _check_indices(document, document.indices)
        yield "indices: singular values and condition within their bounds"


def _matrix(rows: Sequence[Sequence[Fraction]]) -> fmpq_mat:
    return fmpq_mat(len(rows), len(rows[0]), [fmpq(x.numerator, x.denominator) for row in rows for x in row])


class _Roots:
    """Signs of sums of multiples of the lengths."""

    def __init__(self, squares: Numbers) -> None:
        # Of each length the class, by the first of it, and its ratio to that one.
        self._squares = squares
        self._classes: list[tuple[int, Fraction]] = []
        for square in squares:
            for index, known in enumerate(squares):
                ratio = square / known
                p, q = isqrt(ratio.numerator), isqrt(ratio.denominator)
                if p * p == ratio.numerator and q * q == ratio.denominator:
                    self._classes.append((index, Fraction(p, q)))
                    break

    def sign(self, coefficients: Sequence[Fraction]) -> int:
        """Of the sum of c_i l_i: 0 only if that of every class is."""
        totals: dict[int, Fraction] = {}
        for c, (place, ratio) in zip(coefficients, self._classes, strict=True):
            totals[place] = totals.get(place, Fraction(0)) + c * ratio
        left = [(c, self._squares[place]) for place, c in totals.items() if c]
        if not left:
            return 0
        if len({c > 0 for c, _ in left}) == 1:
            return 1 if left[0][0] > 0 else -1
        bits = 128
        while True:
            charge(2000 * len(left) * (1 + bits // 64))
            with ctx.workprec(bits):
                total = sum((_ball(c) * _ball(q).sqrt() for c, q in left), arb(0))
            if not total.contains(0):
                return 1 if total > 0 else -1
            bits *= 2


def _ball(value: Fraction) -> arb:
    return arb(fmpq(value.numerator, value.denominator))


class _Velocities:
    """The polytope of twists, found anew."""

    def __init__(self, document: StaticsDocument, speeds: Numbers) -> None:
        self._rows, self._speeds, self._roots = document.rows, speeds, _Roots(document.squares)
        self._effort = effort(document, speeds)
        self._n, self._count = len(document.columns), len(document.rows)

    def check(self, claim: VelocityClaim) -> None:
        """Check 1."""
        wanted = self._all
        listed: set[Sides] = set()
        for vertex in claim.vertices:
            sides = self._sides(vertex)
            if sides is None:
                raise rejected("velocity_polytope: a vertex lies outside")
            listed.add(sides)
        if len(listed) != len(claim.vertices):
            raise rejected("velocity_polytope: a vertex is listed twice")
        if listed != wanted:
            raise rejected("velocity_polytope: not all vertices are listed, or others are")
        if len(set(claim.facets)) != len(claim.facets):
            raise rejected("velocity_polytope: a facet is listed twice")
        if set(claim.facets) != self._facets():
            raise rejected("velocity_polytope: not all facets are listed, or others are")

    @cached_property
    def _all(self) -> set[Sides]:
        """All vertices, by the sides on which they lie: n independent ones, which leave no choice."""
        choices = comb(self._count, self._n) << self._n
        if choices > MAX_CANDIDATES:
            raise too_large("velocity_polytope: too many choices of legs")
        charge((choices + 1) * self._count**2 * 6000 * self._effort)
        if _matrix(self._rows).rank() < self._n:
            raise rejected("velocity_polytope: is not bounded")
        found: set[Sides] = set()
        for chosen in combinations(range(self._count), self._n):
            matrix = _matrix([self._rows[k] for k in chosen])
            if matrix.det() == 0:
                continue
            inverse = [[Fraction(int(x.p), int(x.q)) for x in line] for line in matrix.inv().tolist()]
            for signs in product((1, -1), repeat=self._n):
                point = []
                for line in inverse:
                    coefficients = [Fraction(0)] * self._count
                    for k, s, x in zip(chosen, signs, line, strict=True):
                        coefficients[k] = s * self._speeds[k] * x
                    point.append(tuple(coefficients))
                sides = self._sides(point)
                if sides is not None:
                    found.add(sides)
        return found

    def _sides(self, point: Sequence[Numbers]) -> Sides | None:
        """The sides on which a point lies; None if it is outside."""
        found = []
        for k, row in enumerate(self._rows):
            value = [sum((row[j] * point[j][i] for j in range(self._n)), Fraction(0)) for i in range(self._count)]
            for side in (1, -1):
                room = [-x if side > 0 else x for x in value]
                room[k] += self._speeds[k]
                sign = self._roots.sign(room)
                if sign < 0:
                    return None
                if sign == 0:
                    found.append((k, side))
        return frozenset(found)

    def _facets(self) -> set[tuple[int, int]]:
        """The sides whose vertices no other side has too; of sides with the same ones the first."""
        on: dict[tuple[int, int], set[Sides]] = {}
        for sides in self._all:
            for side in sides:
                on.setdefault(side, set()).add(sides)
        first: dict[frozenset[Sides], tuple[int, int]] = {}
        for side in sorted(on):
            if not any(on[side] < other for other in on.values()):
                first.setdefault(frozenset(on[side]), side)
        return set(first.values())


def _check_wrench(document: StaticsDocument, forces: Sequence[Numbers], claim: WrenchClaim) -> None:
    """Check 2: facets are found anew; each vertex has a direction in which it is farthest, and all are counted."""
    n, count = len(document.columns), len(document.rows)
    charge((comb(count, n - 1) + len(claim.vertices)) * count * n * n * 1000 * effort(document, *forces))
    rows = [_integral(row) for row in document.rows]
    if fmpz_mat([list(row) for row in rows]).rank() < n:
        raise rejected("wrench_polytope: has no interior")
    if not all(map(any, rows)):
        raise rejected("wrench_polytope: a leg exerts nothing, so that its force has no end at a vertex")
    normals = _normals(rows, n)
    wanted = _facets_wanted(document, forces, normals)
    if len({normal for normal, _ in claim.facets}) != len(claim.facets):
        raise rejected("wrench_polytope: a facet is listed twice")
    if {normal for normal, _ in claim.facets} != set(wanted):
        raise rejected("wrench_polytope: not all facets are listed, or others are")
    if any(wanted[normal] != offset for normal, offset in claim.facets):
        raise rejected("wrench_polytope: a facet is not where the forces reach")
    _check_ends(claim.vertices, rows, normals)


def _normals(rows: list[tuple[int, ...]], n: int) -> dict[tuple[int, ...], list[int]]:
    """The hyperplanes that rows span, and the products of their normals with all rows."""
    found: dict[tuple[int, ...], list[int]] = {}
    for chosen in combinations(rows, n - 1):
        normal = _orthogonal(chosen, n)
        if normal is not None:
            found[normal] = [sum(a * b for a, b in zip(normal, row, strict=True)) for row in rows]
    return found


def _facets_wanted(
    document: StaticsDocument, forces: Sequence[Numbers], normals: Iterable[tuple[int, ...]]
) -> dict[tuple[int, ...], Numbers]:
    """Outer normals and coefficients of the inverse lengths in their offsets."""
    found: dict[tuple[int, ...], Numbers] = {}
    for normal in normals:
        for side in (1, -1):
            outer = tuple(side * x for x in normal)
            reach = []
            for row, (low, high) in zip(document.rows, forces, strict=True):
                value = sum((a * b for a, b in zip(outer, row, strict=True)), Fraction(0))
                reach.append(max(value * low, value * high))
            found[outer] = tuple(reach)
    return found


def _check_ends(
    vertices: Sequence[tuple[int, ...]], rows: list[tuple[int, ...]], normals: dict[tuple[int, ...], list[int]]
) -> None:
    n = len(rows[0])
    if len(set(vertices)) != len(vertices):
        raise rejected("wrench_polytope: a vertex is listed twice")
    charge(len(vertices) * len(normals) * len(rows) * 1000)
    for vertex in vertices:
        direction = [0] * n
        for normal, products in normals.items():
            for side in (1, -1):
                if all(side * s * value >= 0 for s, value in zip(vertex, products, strict=True)):
                    direction = [x + side * y for x, y in zip(direction, normal, strict=True)]
        if any(s * sum(a * b for a, b in zip(direction, row, strict=True)) <= 0
               for s, row in zip(vertex, rows, strict=True)):  # fmt: skip
            raise rejected("wrench_polytope: a vertex is none")
    if len(vertices) != _regions({_up_to_sign(row) for row in rows}):
        raise rejected("wrench_polytope: not all vertices are listed, or others are")


def _regions(rows: set[tuple[int, ...]]) -> int:
    """How many regions the hyperplanes orthogonal to these rows divide space into, by deletion and restriction."""
    if not rows:
        return 1
    charge(20_000 * len(rows) * (1 + max(abs(x) for row in rows for x in row).bit_length() // 500))
    one = min(rows)
    rest = rows - {one}
    place = next(j for j, x in enumerate(one) if x)
    within = set()
    for row in rest:
        flat = tuple(
            one[place] * x - row[place] * y for j, (x, y) in enumerate(zip(row, one, strict=True)) if j != place
        )
        if any(flat):
            within.add(_up_to_sign(_integral([Fraction(x) for x in flat])))
    return _regions(rest) + _regions(within)


def _up_to_sign(row: tuple[int, ...]) -> tuple[int, ...]:
    return row if next((x for x in row if x), 1) > 0 else tuple(-x for x in row)


def _integral(row: Sequence[Fraction]) -> tuple[int, ...]:
    """The positive multiple with coprime integers."""
    matrix = fmpz_mat([[int(x * lcm(*(y.denominator for y in row))) for x in row]])
    content = 0
    for x in matrix.entries():
        content = int(x.gcd(content))
    return tuple(int(x) // (content or 1) for x in matrix.entries())


def _orthogonal(rows: Sequence[tuple[int, ...]], n: int) -> tuple[int, ...] | None:
    """The primitive vector orthogonal to n - 1 independent rows, its first number that is not 0 positive."""
    if n == 1:
        return (1,)
    space, rank = fmpz_mat([list(row) for row in rows]).nullspace()
    if rank != 1:
        return None
    return _up_to_sign(_integral([Fraction(int(space[j, 0])) for j in range(n)]))


def _check_ellipsoid(document: StaticsDocument, speeds: Numbers, claim: EllipsoidClaim) -> None:
    """Check 3."""
    charge(10**6 * effort(document, speeds, claim.weights, *claim.matrix))
    n = len(document.columns)
    matrix = _matrix(claim.matrix)
    if matrix != matrix.transpose() or not _is_definite(matrix):
        raise rejected("ellipsoid: not positive definite")
    if min(claim.weights) < 0 or sum(claim.weights) != 1:
        raise rejected("ellipsoid: weights are negative, or their sum is not 1")
    bounds = [speed * speed * square for speed, square in zip(speeds, document.squares, strict=True)]
    rows = _matrix(document.rows)
    reach = rows * matrix * rows.transpose()
    if any(reach[k, k] > fmpq(bound.numerator, bound.denominator) for k, bound in enumerate(bounds)):
        raise rejected("ellipsoid: leaves the velocity polytope")
    scaled = _matrix(
        [[n * w * x / b for x in row] for w, row, b in zip(claim.weights, document.rows, bounds, strict=True)]
    )
    share = matrix.det() * (rows.transpose() * scaled).det()
    if Fraction(int(share.p), int(share.q)) < NEARLY:
        raise rejected("ellipsoid: not proved to be the largest")


def _is_definite(matrix: fmpq_mat) -> bool:
    """Whether all leading minors are positive."""
    size = matrix.nrows()
    table = matrix.tolist()
    return all(fmpq_mat([line[:k] for line in table[:k]]).det() > 0 for k in range(1, size + 1))


def _check_indices(document: StaticsDocument, indices: Sequence[Numbers]) -> None:
    """Check 4."""
    charge(10**6 * effort(document, *indices))
    n = len(document.columns)
    rows = _matrix(document.rows)
    scaled = _matrix([[x / q for x in row] for row, q in zip(document.rows, document.squares, strict=True)])
    gram = rows.transpose() * scaled
    length = 1 if document.length is None else document.length**2
    scales = [(length if turning else 1) / k for k, turning in zip(document.columns, document.turning, strict=True)]

    def shifted(s: Fraction) -> fmpq_mat:
        return gram - _matrix([[s * s * scales[i] if i == j else Fraction(0) for j in range(n)] for i in range(n)])

    least, greatest, condition = indices
    if not _is_definite(shifted(least[0])):
        raise rejected("indices: sigma_min is below its bounds")
    if _is_definite(shifted(least[1])):
        raise rejected("indices: sigma_min is above its bounds")
    if not _is_definite(-shifted(greatest[1])):
        raise rejected("indices: sigma_max is above its bounds")
    if _is_definite(-shifted(greatest[0])):
        raise rejected("indices: sigma_max is below its bounds")
    if condition[0] * least[1] > greatest[0] or condition[1] * least[0] < greatest[1]:
        raise rejected("indices: condition is not between its bounds")
