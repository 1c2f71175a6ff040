"""Polynomial systems from the literature: files in msolve's format, with what was published of their solutions.

``systems/NAME.ms`` is a system, ``systems/systems.toml`` has a row for each. Members of families are made by the
formulas below, and a test compares the files with them; so a family can go on where its files end.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import lcm
from pathlib import Path

FOLDER = Path(__file__).parent / "systems"

Exponents = tuple[int, ...]
Polynomial = dict[Exponents, Fraction]


@dataclass(frozen=True)
class PublicSystem:
    """A system with finitely many solutions, or none, or infinitely many.

    Attributes
    ----------
    degree : int or None
        Complex solutions with multiplicity; None if they are infinitely many.
    distinct, real : int or None
        Distinct complex solutions; real ones.
    published : str
        What the source says of their number.
    source : str
    difference : str
        Why the numbers differ from those published, if they do; otherwise empty.
    """

    name: str
    unknowns: tuple[str, ...]
    polynomials: tuple[Polynomial, ...]
    degree: int | None
    distinct: int | None
    real: int | None
    published: str
    source: str
    difference: str

    @property
    def path(self) -> Path:
        return FOLDER / f"{self.name}.ms"


@cache
def public_systems() -> Mapping[str, PublicSystem]:
    """All systems, by name."""
    rows = tomllib.loads((FOLDER / "systems.toml").read_text(encoding="utf-8"))
    return {name: _system(name, row) for name, row in rows.items()}


def _system(name: str, row: Mapping[str, object]) -> PublicSystem:
    unknowns, polynomials = parsed((FOLDER / f"{name}.ms").read_text(encoding="ascii"))
    counts = {key: row.get(key) for key in ("degree", "distinct", "real")}
    words = {key: str(row.get(key, "")) for key in ("published", "source", "difference")}
    return PublicSystem(name, unknowns, polynomials, **counts, **words)  # type: ignore[arg-type]


_TERM = re.compile(r"([+-]?)([^+-]+)")


def parsed(text: str) -> tuple[tuple[str, ...], tuple[Polynomial, ...]]:
    """Unknowns and polynomials of a file as it is written here: sums of products, no brackets."""
    names, characteristic, body = text.split("\n", 2)
    assert characteristic == "0"
    unknowns = tuple(names.split(","))
    places = {name: place for place, name in enumerate(unknowns)}
    polynomials = []
    for words in "".join(body.split()).split(","):
        polynomial: Polynomial = {}
        for sign, term in _TERM.findall(words):
            coefficient, exponents = Fraction(-1 if sign == "-" else 1), [0] * len(unknowns)
            for factor in term.split("*"):
                base, _, power = factor.partition("^")
                if base in places:
                    exponents[places[base]] += int(power or 1)
                else:
                    coefficient *= Fraction(base)
            key = tuple(exponents)
            polynomial[key] = polynomial.get(key, Fraction(0)) + coefficient
        polynomials.append({key: value for key, value in polynomial.items() if value})
    return unknowns, tuple(polynomials)


def written(unknowns: Sequence[str], polynomials: Sequence[Polynomial]) -> str:
    """The file: terms by falling degree, then lexicographically; coefficients in lowest terms."""
    lines = []
    for polynomial in polynomials:
        words = ""
        for exponents in sorted(polynomial, key=lambda key: (-sum(key), [-exponent for exponent in key])):
            value = polynomial[exponents]
            powers = zip(unknowns, exponents, strict=True)
            factors = [name if power == 1 else f"{name}^{power}" for name, power in powers if power]
            if abs(value) != 1 or not factors:
                factors.insert(0, str(abs(value)))
            words += ("-" if value < 0 else "+") + "*".join(factors)
        lines.append(words.removeprefix("+"))
    return f"{','.join(unknowns)}\n0\n" + ",\n".join(lines) + "\n"


def integral(polynomial: Polynomial) -> dict[Exponents, int]:
    """The multiple with integers that have no common factor of denominators left."""
    common = lcm(*(value.denominator for value in polynomial.values()))
    return {key: int(value * common) for key, value in polynomial.items()}


# ---------------------------------------------------------------------------------------------------------------------
# Families
# ---------------------------------------------------------------------------------------------------------------------

System = tuple[tuple[str, ...], tuple[Polynomial, ...]]


class _Sum:
    """A polynomial that is being added up from terms with 0-based unknowns."""

    def __init__(self, number: int) -> None:
        self.number, self.terms = number, Polynomial()

    def add(self, value: Fraction | int, *unknowns: int) -> _Sum:
        exponents = [0] * self.number
        for unknown in unknowns:
            exponents[unknown] += 1
        key = tuple(exponents)
        self.terms[key] = self.terms.get(key, Fraction(0)) + value
        if not self.terms[key]:
            del self.terms[key]
        return self


def _names(letter: str, number: int, first: int = 1) -> tuple[str, ...]:
    return tuple(f"{letter}{first + place}" for place in range(number))


def katsura(n: int) -> System:
    """A problem of magnetism, 2^n solutions: u_m = sum over l of u_l u_(m-l), m < n, with u_-l = u_l, and sum u = 1."""
    polynomials = []
    for m in range(n):
        total = _Sum(n + 1).add(-1, m)
        for place in range(-n, n + 1):
            if abs(m - place) <= n:
                total.add(1, abs(place), abs(m - place))
        polynomials.append(total.terms)
    norm = _Sum(n + 1).add(-1).add(1, 0)
    for place in range(1, n + 1):
        norm.add(2, place)
    return _names("u", n + 1, 0), (*polynomials, norm.terms)


def cyclic(n: int) -> System:
    """The cyclic n-roots: sums over all cyclic products of 1, .., n - 1 factors are 0, the product of all is 1."""
    polynomials = []
    for length in range(1, n):
        total = _Sum(n)
        for first in range(n):
            total.add(1, *((first + step) % n for step in range(length)))
        polynomials.append(total.terms)
    return _names("z", n), (*polynomials, _Sum(n).add(1, *range(n)).add(-1).terms)


def eco(n: int) -> System:
    """An economics problem: (x_k + sum of x_i x_(i+k)) x_n = k for k < n, sum of x_1 .. x_(n-1) = -1."""
    last = n - 1
    polynomials = []
    for k in range(1, n):
        total = _Sum(n).add(-k).add(1, k - 1, last)
        for i in range(1, n - k):
            total.add(1, i - 1, i + k - 1, last)
        polynomials.append(total.terms)
    norm = _Sum(n).add(1)
    for place in range(last):
        norm.add(1, place)
    return _names("x", n), (*polynomials, norm.terms)


def redeco(n: int) -> System:
    """The reduced economics problem: u_n = 1/x_n, which takes the place of x_n."""
    last = n - 1
    polynomials = []
    for k in range(1, n):
        total = _Sum(n).add(-k, last).add(1, k - 1)
        for i in range(1, n - k):
            total.add(1, i - 1, i + k - 1)
        polynomials.append(total.terms)
    norm = _Sum(n).add(1)
    for place in range(last):
        norm.add(1, place)
    return (*_names("x", last), f"u{n}"), (*polynomials, norm.terms)


def noon(n: int) -> System:
    """A neural network of Noonburg: x_i sum over j != i of x_j^2 - 1.1 x_i + 1 = 0."""
    polynomials = []
    for i in range(n):
        total = _Sum(n).add(Fraction(-11, 10), i).add(1)
        for j in range(n):
            if j != i:
                total.add(1, i, j, j)
        polynomials.append(total.terms)
    return _names("x", n), tuple(polynomials)


def reimer(n: int) -> System:
    """Reimer's system: 2 (x_1^k - x_2^k + x_3^k - ..) = 1 for k = 2, .., n + 1."""
    polynomials = []
    for power in range(2, n + 2):
        total = _Sum(n).add(-1)
        for place in range(n):
            total.add(2 * (-1) ** place, *[place] * power)
        polynomials.append(total.terms)
    return _names("x", n), tuple(polynomials)


def chandra(n: int) -> System:
    """Chandrasekhar's equation, c = 0.51234: 2n h_i - c h_i (1 + sum over j < n of i / (i + j) h_j) = 2n."""
    c = Fraction("0.51234")
    polynomials = []
    for i in range(1, n + 1):
        total = _Sum(n).add(2 * n - c, i - 1).add(-2 * n)
        for j in range(1, n):
            total.add(-c * Fraction(i, i + j), i - 1, j - 1)
        polynomials.append(total.terms)
    return _names("h", n), tuple(polynomials)


def kss(n: int) -> System:
    """x_i^2 - 2 x_i + sum of all x = n - 1: a solution (1, .., 1) of high multiplicity."""
    polynomials = []
    for i in range(n):
        total = _Sum(n).add(1, i, i).add(-2, i).add(1 - n)
        for j in range(n):
            total.add(1, j)
        polynomials.append(total.terms)
    return _names("x", n), tuple(polynomials)


FAMILIES: Mapping[str, Callable[[int], System]] = {
    "katsura": katsura,
    "cyclic": cyclic,
    "eco": eco,
    "redeco": redeco,
    "noon": noon,
    "reimer": reimer,
    "chandra": chandra,
    "kss": kss,
}
