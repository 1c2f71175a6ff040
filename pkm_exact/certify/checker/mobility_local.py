"""The configuration is isolated on a section: "local" of version 3 of ``docs/certificates-mobility.md``."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations_with_replacement
from math import comb
from typing import Final

from flint import fmpq, nmod_mat

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.mobility_document import RankProof, SecondOrder
from pkm_exact.certify.checker.mobility_machine import Machine, Rows, exact, times
from pkm_exact.certify.checker.verdict import malformed, rejected, too_large

PRIME: Final = (1 << 61) - 1
MOST_MONOMIALS: Final = 500
Values = list[int]
"""Coefficients of a polynomial, by the degrees of its monomials."""


class Ring:
    """Polynomials modulo the prime without terms above a degree."""

    def __init__(self, unknowns: int, degree: int) -> None:
        size = comb(unknowns + degree, degree)
        if size > MOST_MONOMIALS:
            raise too_large(f"finite.above: more than {MOST_MONOMIALS} monomials")
        charge(2000 * size * size)
        self.degree, self.size = degree, size
        names = [m for k in range(degree + 1) for m in combinations_with_replacement(range(unknowns), k)]
        places = {m: place for place, m in enumerate(names)}
        self.degrees = [len(m) for m in names]
        self.shifts = [
            [places[tuple(sorted(m + other))] for other in names if len(m) + len(other) <= degree] for m in names
        ]

    def factor(self, values: Values) -> nmod_mat:
        """The matrix from the right of the product with a polynomial."""
        charge(200 * self.size * self.size)
        found = nmod_mat(self.size, self.size, PRIME)
        for value, targets in zip(values, self.shifts, strict=True):
            if value:
                for source, target in enumerate(targets):
                    found[source, target] = value
        return found


def check_local(claim: SecondOrder, machine: Machine, proof: RankProof, motions: Rows) -> None:
    """All monomials of the degree are in the ideal of the loops, on the section."""
    section = [[exact(x) for x in vector] for vector in claim.section]
    if any(len(vector) != len(motions) for vector in section):
        raise malformed("finite.above.section: not a number for each motion")
    if claim.most != len(motions) - len(section):
        raise rejected("finite.most: not the number that follows")
    ring = Ring(len(section), claim.degree)
    others = _others(machine, proof, times([list(column) for column in zip(*motions, strict=True)], section), ring)
    rows = [
        shifted
        for values in others
        if any(values)
        for place, targets in enumerate(ring.shifts)
        if ring.degrees[place] <= claim.degree - 2
        for shifted in [_shifted(values, targets, ring.size)]
    ]
    charge(1000 + 20 * len(rows) * ring.size * min(len(rows), ring.size))
    low = sum(degree < claim.degree for degree in ring.degrees)
    rank = int(nmod_mat(rows, PRIME).rank()) if rows else 0
    below = int(nmod_mat([row[:low] for row in rows], PRIME).rank()) if rows else 0
    if rank - below != ring.size - low:
        raise rejected("finite.above: the configuration may not be isolated on the section")


def _shifted(values: Values, targets: Sequence[int], size: int) -> Values:
    found = [0] * size
    for source, target in enumerate(targets):
        found[target] = values[source]
    return found


def _others(machine: Machine, proof: RankProof, directions: Rows, ring: Ring) -> list[Values]:
    """The vector parts at the rows that are not among those of the minor."""
    twists = [[_modulo(x) for x in twist] for twist in machine.twists]
    half = [[0, *(_modulo(x) for x in row), *[0] * (ring.size - 1 - len(row))] for row in directions]
    size = len(proof.rows)
    charge(1000 + size**3 * 100)
    minor = nmod_mat(size, size, [_modulo(machine.matrix[i][j]) for i in proof.rows for j in proof.columns], PRIME)
    if size and int(minor.det()) == 0:
        raise rejected("finite.above: the minor is 0 modulo the prime")
    parts = _vector_parts(machine, twists, half, ring)
    for _ in range(ring.degree if size else 0):  # each step is right to one degree more
        steps = minor.solve(nmod_mat([parts[row] for row in proof.rows], PRIME)).tolist()
        for column, step in zip(proof.columns, steps, strict=True):
            half[column] = [(a - int(b)) % PRIME for a, b in zip(half[column], step, strict=True)]
        parts = _vector_parts(machine, twists, half, ring)
    return [values for row, values in enumerate(parts) if row not in proof.rows]


def _modulo(value: fmpq) -> int:
    if int(value.q) % PRIME == 0:
        raise rejected("finite.above: the prime divides a denominator")
    return int(value.p) * pow(int(value.q), -1, PRIME) % PRIME


def _vector_parts(machine: Machine, twists: list[Values], half: list[Values], ring: Ring) -> list[Values]:
    factors = [ring.factor(values) for values in half]
    found: list[Values] = []
    for loop in machine.loops:
        product = nmod_mat(8, ring.size, PRIME)
        product[0, 0] = 1
        for column, sign in machine.passed(loop):
            twist = machine.twists[column]
            if sum((a * b for a, b in zip(twist[:3], twist[3:], strict=True)), fmpq(0)) != 0:
                raise rejected("finite: a screw of a loop has a pitch")
            charge(1000 + 100 * ring.size * ring.size)
            product += _from_right([sign * x for x in twists[column]]) * product * factors[column]
        rows = product.tolist()
        found += [[int(x) for x in rows[k]] for k in (1, 2, 3, 5, 6, 7)]
    return found


def _from_right(twist: Values) -> nmod_mat:
    """The matrix of p + e q -> (p + e q)(w + e v), on columns."""
    w, v, nothing = _square(twist[:3]), _square(twist[3:]), [[0] * 4] * 4
    upper = [[*a, *b] for a, b in zip(w, nothing, strict=True)]
    lower = [[*a, *b] for a, b in zip(v, w, strict=True)]
    return nmod_mat([[x % PRIME for x in row] for row in (*upper, *lower)], PRIME)


def _square(u: Values) -> list[Values]:
    x, y, z = u
    return [[0, -x, -y, -z], [x, 0, z, -y], [y, -z, 0, x], [z, y, -x, 0]]
