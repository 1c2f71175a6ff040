"""Polynomials as certificates of systems spell them, each in one way only, and what checks make of them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, Final, TypeAlias

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.spelling import items, text
from pkm_exact.certify.checker.verdict import malformed, too_large

Monomial: TypeAlias = tuple[int, ...]
Terms: TypeAlias = dict[Monomial, int]
"""A polynomial that is not 0: coefficients by exponents, monomials decreasing."""

MAX_VARIABLES: Final = 64
MAX_POLYNOMIALS: Final = 256
MAX_TERMS: Final = 1 << 16
"""Of all polynomials together."""
MAX_TOTAL_DEGREE: Final = 64
MAX_COEFFICIENT_DIGITS: Final = 4000

_NAME: Final = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,31}", re.ASCII)
_NUMBER: Final = re.compile(r"[1-9][0-9]*", re.ASCII)
_TERM_COST: Final = 20_000
"""Operations charged for reading a term of few variables."""


def read_variables(value: Any) -> tuple[str, ...]:
    """The names of the variables."""
    if isinstance(value, list) and len(value) > MAX_VARIABLES:
        raise too_large(f"variables: more than {MAX_VARIABLES}")
    names = items(value, "variables", None, text)
    if not names or len(set(names)) < len(names) or not all(map(_NAME.fullmatch, names)):
        raise malformed("variables: not different names of letters and digits")
    return names


def read_polynomials(value: Any, variables: Sequence[str]) -> tuple[Terms, ...]:
    """The polynomials of a system."""
    if not isinstance(value, list) or not value:
        raise malformed("polynomials: not a list of some")
    if len(value) > MAX_POLYNOMIALS:
        raise too_large(f"polynomials: more than {MAX_POLYNOMIALS}")
    number = sum(len(entry) for entry in value if isinstance(entry, list))
    if number > MAX_TERMS:
        raise too_large(f"polynomials: more than {MAX_TERMS} terms")
    charge(_TERM_COST * (number + len(variables)))
    place = {name: index for index, name in enumerate(variables)}
    return items(value, "polynomials", None, lambda entry, where: _polynomial(entry, where, place))


def _polynomial(value: Any, where: str, place: Mapping[str, int]) -> Terms:
    terms = items(value, where, None, lambda entry, there: _term(entry, there, place))
    if not terms:
        raise malformed(f"{where}: no term")
    keys = [order(monomial) for monomial, _ in terms]
    if any(left <= right for left, right in pairwise(keys)):
        raise malformed(f"{where}: monomials do not decrease")
    if sum(terms[0][0]) > MAX_TOTAL_DEGREE:
        raise too_large(f"{where}: degree above {MAX_TOTAL_DEGREE}")
    return dict(terms)


def _term(value: Any, where: str, place: Mapping[str, int]) -> tuple[Monomial, int]:
    """Exponents and coefficient; the text must be the one that spells them."""
    written = text(value, where)
    first, *rest = written.removeprefix("-").split("*")
    number = bool(_NUMBER.fullmatch(first))
    if number and len(first) > MAX_COEFFICIENT_DIGITS:
        raise too_large(f"{where}: a coefficient of more than {MAX_COEFFICIENT_DIGITS} digits")
    exponents = [0] * len(place)
    for factor in rest if number else [first, *rest]:
        name, _, power = factor.partition("^")
        if name not in place or (power and not _NUMBER.fullmatch(power)) or len(power) > 2:
            raise malformed(f"{where}: not a term in the variables")
        exponents[place[name]] += int(power or 1)
    coefficient = (int(first) if number else 1) * (-1 if written.startswith("-") else 1)
    monomial = tuple(exponents)
    if _spelled(monomial, coefficient, list(place)) != written:
        raise malformed(f"{where}: not in the one spelling of a term")
    return monomial, coefficient


def _spelled(monomial: Monomial, coefficient: int, variables: Sequence[str]) -> str:
    pairs = zip(variables, monomial, strict=True)
    factors = [name if exponent == 1 else f"{name}^{exponent}" for name, exponent in pairs if exponent]
    if abs(coefficient) != 1 or not factors:
        factors.insert(0, str(abs(coefficient)))
    return ("-" if coefficient < 0 else "") + "*".join(factors)


def order(monomial: Monomial) -> tuple[int, ...]:
    """Sorting key of the degree reverse lexicographic order."""
    return (sum(monomial), *(-exponent for exponent in reversed(monomial)))


def degree(polynomial: Mapping[Monomial, int]) -> int:
    """The total degree."""
    return max(map(sum, polynomial))


def top_form(polynomial: Mapping[Monomial, int]) -> Terms:
    """The terms of greatest degree."""
    most = degree(polynomial)
    return {monomial: value for monomial, value in polynomial.items() if sum(monomial) == most}


def homogeneous(polynomial: Mapping[Monomial, int]) -> Terms:
    """The polynomial made homogeneous by a further, first variable."""
    most = degree(polynomial)
    return {(most - sum(monomial), *monomial): value for monomial, value in polynomial.items()}


def derivative(polynomial: Mapping[Monomial, int], axis: int) -> Terms:
    """The partial derivative; empty if it is 0."""
    return {
        (*monomial[:axis], monomial[axis] - 1, *monomial[axis + 1 :]): value * monomial[axis]
        for monomial, value in polynomial.items()
        if monomial[axis]
    }


def linear(form: Sequence[int]) -> Terms:
    """The polynomial with these coefficients of the variables and this constant, the last one; empty if it is 0."""
    size = len(form) - 1
    monomials = [tuple(int(i == j) for j in range(size)) for i in range(size + 1)]
    return {monomial: value for monomial, value in zip(monomials, form, strict=True) if value}
