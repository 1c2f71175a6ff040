"""Numbers of solutions found without the solver: modulo a prime, and over Q by Hermite's form.

The bases are those of other programs: msolve's modulo a prime for systems of any size, SymPy's over Q for small ones.
What follows from a basis, the quotient algebra and what is read off it, is done here.
"""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import numpy as np
from public_systems import Exponents, Polynomial, integral

from pkm_exact.backends.msolve_program import find_msolve

PRIME = (1 << 26) - 5
"""Sums of 2^11 products of residues fit into 63 bits."""


@dataclass(frozen=True)
class Count:
    """Numbers of solutions: ``None`` for infinitely many, or where it was not asked."""

    degree: int | None
    distinct: int | None
    real: int | None = None


INFINITE = Count(None, None)


# ---------------------------------------------------------------------------------------------------------------------
# Modulo a prime
# ---------------------------------------------------------------------------------------------------------------------

Residues = dict[Exponents, int]


def count_modulo(polynomials: Sequence[Polynomial], number: int, seconds: float, p: int = PRIME) -> Count:
    """Counted from msolve's Groebner basis modulo p, the degree reverse lexicographic order.

    The degree is that of the quotient algebra modulo p. The number of distinct solutions is that of the distinct values
    of a random linear form: the degree of the squarefree part of the polynomial that generates its powers.
    """
    basis = basis_modulo([integral(polynomial) for polynomial in polynomials], number, seconds, p)
    leads = [max(element, key=order) for element in basis]
    standard = staircase(leads, number)
    if standard is None:
        return INFINITE
    if not standard:
        return Count(0, 0)
    matrices = multiplications(dict(zip(leads, basis, strict=True)), standard, number, p)
    return Count(len(standard), distinct_values(matrices, p))


def order(exponents: Exponents) -> tuple[int, ...]:
    """Degree reverse lexicographic: the key of the greater monomial is greater."""
    return (sum(exponents), *(-exponent for exponent in reversed(exponents)))


_FACTOR = re.compile(r"x(\d+)(?:\^(\d+))?")


def basis_modulo(polynomials: Sequence[Mapping[Exponents, int]], number: int, seconds: float, p: int) -> list[Residues]:
    """The reduced Groebner basis, leading coefficients 1."""
    names = [f"x{place}" for place in range(number)]
    lines = []
    for polynomial in polynomials:
        residues = {key: value % p for key, value in polynomial.items() if value % p}
        terms = [
            "*".join([str(value), *(f"{names[k]}^{e}" for k, e in enumerate(key) if e)])
            for key, value in residues.items()
        ]
        if terms:
            lines.append("+".join(terms))
    program = find_msolve()
    assert program is not None
    with TemporaryDirectory() as folder:
        source, target = Path(folder) / "in.ms", Path(folder) / "out.ms"
        source.write_text(f"{','.join(names)}\n{p}\n" + ",\n".join(lines) + "\n", encoding="ascii")
        command = [str(program), "-f", str(source), "-o", str(target), "-g", "2"]
        subprocess.run(command, capture_output=True, timeout=seconds, check=True)
        text = target.read_text(encoding="ascii")
    body = "".join(line for line in text.splitlines() if not line.startswith("#"))
    elements = []
    for words in body.strip().rstrip(":").strip("[]").split(","):
        element: Residues = {}
        for term in words.replace("-", "+-").split("+"):
            if term.strip():
                exponents = [0] * number
                for place, power in _FACTOR.findall(term):
                    exponents[int(place)] += int(power or 1)
                factors = [factor for factor in term.strip().split("*") if "x" not in factor]
                element[tuple(exponents)] = int(factors[0]) % p if factors else 1
        elements.append(element)
    return elements


def staircase(leads: Sequence[Exponents], number: int) -> list[Exponents] | None:
    """The monomials that no leading monomial divides, by rising order; None if they are infinitely many."""
    powers = {k for lead in leads for k in range(number) if lead[k] == sum(lead)}
    if len(powers) < number:
        return None
    found: list[Exponents] = []
    front = {(0,) * number}
    while front:
        front = {m for m in front if not any(divides(lead, m) for lead in leads)}
        found += front
        front = {(*m[:k], m[k] + 1, *m[k + 1 :]) for m in front for k in range(number)}
    return sorted(found, key=order)


def divides(one: Exponents, other: Exponents) -> bool:
    return all(a <= b for a, b in zip(one, other, strict=True))


def multiplications(basis: Mapping[Exponents, Residues], standard: list[Exponents], number: int, p: int) -> np.ndarray:
    """Matrices of multiplication by the unknowns, shape (n, D, D), by rising monomials as Faugere et al. (1993)."""
    places = {monomial: place for place, monomial in enumerate(standard)}
    size = len(standard)
    matrices = np.zeros((number, size, size), dtype=np.int64)
    products = sorted(
        {(*m[:k], m[k] + 1, *m[k + 1 :]) for m in standard for k in range(number)} - set(places), key=order
    )
    normal: dict[Exponents, np.ndarray] = {}

    def enter(monomial: Exponents, vector: np.ndarray) -> None:
        for k in range(number):
            if monomial[k]:
                place = places.get((*monomial[:k], monomial[k] - 1, *monomial[k + 1 :]))
                if place is not None:
                    matrices[k, :, place] = vector

    for monomial, place in places.items():
        enter(monomial, np.eye(1, size, place, dtype=np.int64)[0])
    for monomial in products:
        if monomial in basis:
            vector = np.zeros(size, dtype=np.int64)
            for key, value in basis[monomial].items():
                if key != monomial:
                    vector[places[key]] = -value % p
        else:
            k, smaller = next(
                (k, part) for k in range(number) if monomial[k]
                for part in [(*monomial[:k], monomial[k] - 1, *monomial[k + 1 :])] if part in normal
            )  # fmt: skip
            vector = matrices[k] @ normal[smaller] % p
        normal[monomial] = vector
        enter(monomial, vector)
    return matrices


def distinct_values(matrices: np.ndarray, p: int, seed: int = 1) -> int:
    """Distinct eigenvalues of a random combination, from the minimal polynomial of a random sequence."""
    from flint import nmod_poly

    random = Random(seed)
    size = matrices.shape[1]
    matrix = np.zeros((size, size), dtype=np.int64)
    for one in matrices:
        matrix = (matrix + random.randrange(1, p) * one) % p
    vector = np.array([random.randrange(p) for _ in range(size)], dtype=np.int64)
    functional = np.array([random.randrange(p) for _ in range(size)], dtype=np.int64)
    terms = []
    for _ in range(2 * size):
        terms.append(int(functional @ vector % p))
        vector = matrix @ vector % p
    minimal = nmod_poly(shortest_recurrence(terms, p), p)
    return minimal.degree() - minimal.gcd(minimal.derivative()).degree()


def shortest_recurrence(terms: Sequence[int], p: int) -> list[int]:
    """Coefficients, lowest first, of the polynomial that annihilates the sequence: by Berlekamp and Massey."""
    current, previous = [1], [1]
    length, gap, last = 0, 1, 1
    for place, _ in enumerate(terms):
        error = sum(value * terms[place - k] for k, value in enumerate(current[: length + 1])) % p
        if not error:
            gap += 1
            continue
        factor = error * pow(last, -1, p) % p
        kept = list(current)
        current += [0] * (len(previous) + gap - len(current))
        for k, value in enumerate(previous):
            current[k + gap] = (current[k + gap] - factor * value) % p
        if 2 * length <= place:
            length, previous, last, gap = place + 1 - length, kept, error, 1
        else:
            gap += 1
    current += [0] * (length + 1 - len(current))
    return list(reversed(current[: length + 1]))


# ---------------------------------------------------------------------------------------------------------------------
# Over Q
# ---------------------------------------------------------------------------------------------------------------------


def count_rational(polynomials: Sequence[Polynomial], number: int) -> Count:
    """All three numbers, from SymPy's basis over Q and Hermite's form Tr(b c).

    Its rank is the number of distinct solutions, its signature that of real ones (Basu, Pollack and Roy 2006, theorem
    4.102). For systems with few solutions.
    """
    from sympy import QQ, Poly, groebner, symbols

    unknowns = symbols(f"x:{number}")
    given = [
        Poly({key: QQ(v.numerator, v.denominator) for key, v in p.items()}, *unknowns, domain=QQ) for p in polynomials
    ]
    basis = groebner(given, *unknowns, order="grevlex", domain=QQ).polys
    elements: dict[Exponents, dict[Exponents, Fraction]] = {}
    for element in basis:
        terms = {tuple(key): Fraction(int(v.numerator), int(v.denominator)) for key, v in element.rep.to_dict().items()}
        lead = max(terms, key=order)
        elements[lead] = {key: value / terms[lead] for key, value in terms.items()}
    standard = staircase(list(elements), number)
    if standard is None:
        return INFINITE
    if not standard:
        return Count(0, 0, 0)
    normal = _normal_forms(elements, standard, number)
    traces = {m: sum(normal(_times(m, b)).get(b, Fraction(0)) for b in standard) for m in standard}
    rows = [
        [sum(value * traces[key] for key, value in normal(_times(b, c)).items()) for c in standard] for b in standard
    ]
    rank, signature = signature_of([[Fraction(value) for value in row] for row in rows])
    return Count(len(standard), rank, signature)


def _times(one: Exponents, other: Exponents) -> Exponents:
    return tuple(a + b for a, b in zip(one, other, strict=True))


def _normal_forms(
    elements: Mapping[Exponents, Mapping[Exponents, Fraction]], standard: Sequence[Exponents], number: int
) -> Callable[[Exponents], dict[Exponents, Fraction]]:
    inside = set(standard)
    known: dict[Exponents, dict[Exponents, Fraction]] = {m: {m: Fraction(1)} for m in standard}

    def normal(monomial: Exponents) -> dict[Exponents, Fraction]:
        if monomial in known:
            return known[monomial]
        total: dict[Exponents, Fraction] = {}
        if monomial in elements:
            total = {key: -value for key, value in elements[monomial].items() if key != monomial}
        else:
            parts = [(k, (*monomial[:k], monomial[k] - 1, *monomial[k + 1 :])) for k in range(number) if monomial[k]]
            k, part = next(((k, part) for k, part in parts if part not in inside), parts[0])
            for key, value in normal(part).items():
                for lower, weight in normal((*key[:k], key[k] + 1, *key[k + 1 :])).items():
                    total[lower] = total.get(lower, Fraction(0)) + value * weight
        known[monomial] = {key: value for key, value in total.items() if value}
        return known[monomial]

    return normal


def signature_of(matrix: list[list[Fraction]]) -> tuple[int, int]:
    """Rank and signature of a symmetric matrix, by completing squares."""
    rows = [list(row) for row in matrix]
    positive = negative = 0
    while rows:
        size = len(rows)
        pivot = next((k for k in range(size) if rows[k][k]), None)
        if pivot is None:
            pair = next(((i, j) for i in range(size) for j in range(i) if rows[i][j]), None)
            if pair is None:
                break
            i, j = pair  # x_i -> x_i + x_j makes the diagonal entry 2 a_ij
            rows[i] = [a + b for a, b in zip(rows[i], rows[j], strict=True)]
            for row in rows:
                row[i] += row[j]
            pivot = i
        lead = rows[pivot][pivot]
        positive, negative = positive + (lead > 0), negative + (lead < 0)
        rest = [k for k in range(size) if k != pivot]
        rows = [[rows[a][b] - rows[a][pivot] * rows[pivot][b] / lead for b in rest] for a in rest]
    return positive + negative, positive - negative
