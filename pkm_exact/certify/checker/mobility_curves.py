"""Independent algebraic curves of configurations: "curves" of version 3 of ``docs/certificates-mobility.md``."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from flint import fmpq, fmpq_poly

from pkm_exact.certify.checker.budget import charge, limbs, polynomials_cost
from pkm_exact.certify.checker.mobility_document import Curve, SecondOrder
from pkm_exact.certify.checker.mobility_machine import Machine, exact, rank_of
from pkm_exact.certify.checker.verdict import malformed, rejected

Sheets = list[fmpq_poly]
"""A polynomial in s and u, by powers of u."""


def check_curves(claim: SecondOrder, machine: Machine) -> tuple[int, int]:
    """The number of curves, and the freedoms of the platform that their speeds show."""
    speeds = [_speeds_of(curve, machine) for curve in claim.curves]
    moving = [{k for k, (n, _) in enumerate(curve.halves) if any(map(any, n))} for curve in claim.curves]
    loops = [{column for column, _ in machine.passed(loop)} for loop in machine.loops]
    for part in [*loops, *({k} for k in range(len(machine.twists)))]:
        if sum(bool(part & freedoms) for freedoms in moving) > 1:
            raise rejected("finite.below.curves: two move freedoms of one loop")
    for curve in claim.curves:
        _check_closed(curve, machine)
    twists = [[sum((a * b for a, b in zip(row, x, strict=True)), fmpq(0)) for row in machine.platform] for x in speeds]
    return len(speeds), rank_of(twists)


def _speeds_of(curve: Curve, machine: Machine) -> list[fmpq]:
    if len(curve.halves) != len(machine.twists):
        raise malformed("finite.below.curves: not a pair for each freedom")
    if _at(curve.relation, 0, 0) != 0 or _at(curve.relation, 1, 0) == 0:
        raise rejected("finite.below.curves: the relation is not regular at the configuration")
    if any(_at(n, 0, 0) != 0 or d[0] == 0 for n, d in curve.halves):
        raise rejected("finite.below.curves: does not begin at the configuration")
    charge(2000 * len(curve.halves))
    slope = -_at(curve.relation, 0, 1) / _at(curve.relation, 1, 0)
    speeds = [(_at(n, 0, 1) + slope * _at(n, 1, 0)) / exact(d[0]) for n, d in curve.halves]
    if not any(speeds):
        raise rejected("finite.below.curves: does not move")
    return speeds


def _at(sheets: Sequence[Sequence[Fraction]], sheet: int, power: int) -> fmpq:
    row = sheets[sheet] if sheet < len(sheets) else ()
    return exact(row[power]) if power < len(row) else fmpq(0)


def _check_closed(curve: Curve, machine: Machine) -> None:
    relation = _sheets(curve.relation)
    halves = [(_sheets(n), fmpq_poly([exact(x) for x in d])) for n, d in curve.halves]
    for loop in machine.loops:
        product = [[fmpq_poly([int(k == 0)])] for k in range(8)]
        for column, sign in machine.passed(loop):
            twist = machine.twists[column]
            if sum((a * b for a, b in zip(twist[:3], twist[3:], strict=True)), fmpq(0)) != 0:
                raise rejected("finite: a screw of a loop has a pitch")
            product = _remainders(_times_joint(product, halves[column], [sign * x for x in twist]), relation)
        if any(part for k in (1, 2, 3, 5, 6, 7) for part in product[k]):
            raise rejected("finite.below.curves: does not close the loops")


def _sheets(rows: Sequence[Sequence[Fraction]]) -> Sheets:
    return [fmpq_poly([exact(x) for x in row]) for row in rows]


def _times_joint(product: list[Sheets], half: tuple[Sheets, fmpq_poly], twist: Sequence[fmpq]) -> list[Sheets]:
    numerator, denominator = half
    size = len(product[0])  # as long as the others
    _charge(product, [*numerator, denominator], size * (len(numerator) + 1))
    turned = [_turned([part[k] for part in product], twist) for k in range(size)]
    found = []
    for place, part in enumerate(product):
        sums = [fmpq_poly()] * (size + len(numerator) - 1)
        for k, a in enumerate(part):
            sums[k] += a * denominator
            for j, b in enumerate(numerator):
                sums[k + j] += turned[k][place] * b
        found.append(sums)
    return found


def _turned(p: Sequence[fmpq_poly], twist: Sequence[fmpq]) -> list[fmpq_poly]:
    """(p + e q)(w + e v) = p w + e (p v + q w)."""
    w, v = twist[:3], twist[3:]
    dual = [a + b for a, b in zip(_times_vector(p[:4], v), _times_vector(p[4:], w), strict=True)]
    return [*_times_vector(p[:4], w), *dual]


def _times_vector(p: Sequence[fmpq_poly], u: Sequence[fmpq]) -> list[fmpq_poly]:
    a, b, c, d = p
    x, y, z = u
    return [-b * x - c * y - d * z, a * x + c * z - d * y, a * y + d * x - b * z, a * z + b * y - c * x]


def _remainders(product: list[Sheets], relation: Sheets) -> list[Sheets]:
    """All parts times one power of the last coefficient of F, less multiples of F."""
    degree = len(relation) - 1
    while len(product[0]) > degree:
        _charge(product, relation, len(product[0]) + degree)
        tops = [part[-1] for part in product]
        product = [[a * relation[-1] for a in part[:-1]] for part in product]
        start = len(product[0]) - degree
        for part, top in zip(product, tops, strict=True):
            for k in range(degree):
                part[start + k] -= top * relation[k]
    return product


def _charge(product: Sequence[Sheets], factors: Sequence[fmpq_poly], products: int) -> None:
    """For so many products of polynomials in s for each of the eight parts."""
    sizes = [_size_of(parts) for parts in ([part for sheets in product for part in sheets], factors)]
    terms, bits = max(size for size, _ in sizes), sum(bits for _, bits in sizes)
    charge(8 * products * (2000 + 4 * polynomials_cost(terms, 1 + limbs(bits))))


def _size_of(parts: Sequence[fmpq_poly]) -> tuple[int, int]:
    """Terms, and bits of the longest number."""
    numbers = [int(x) for part in parts for x in (*part.numer().coeffs(), part.denom())]
    return max(len(part) for part in parts) + 1, max((abs(x).bit_length() for x in numbers), default=1)
