"""The content of a certificate of a polynomial system, read into typed values; nothing in it is believed."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from flint import fmpz_poly

from pkm_exact.certify.checker.document import CLAIMS, ListedPose, read_polynomial
from pkm_exact.certify.checker.elimination import Row
from pkm_exact.certify.checker.spelling import (
    choice,
    count,
    entries,
    integer,
    items,
    rational,
    rational_texts,
    text,
)
from pkm_exact.certify.checker.system_supports import Subdivision
from pkm_exact.certify.checker.system_terms import MAX_VARIABLES, Terms, read_polynomials, read_variables
from pkm_exact.certify.checker.verdict import MAX_BOX_EXPONENT, MAX_ELIMINATION_ROWS, malformed, too_large

ROUTES: Final = (
    "refined-bezout",
    "multihomogeneous-bezout",
    "mixed-volume",
    "modular-rank",
    "counting-at-infinity",
    "exact-elimination",
)
CAUSES: Final = ("fewer-polynomials", "more-solutions-than-bound")

_KEYS: Final = (
    "format",
    "version",
    "title",
    "variables",
    "polynomials",
    "claim",
    "completeness_route",
    "complex_solutions",
    "distinct_solutions",
    "real_solutions",
    "representation",
    "groups",
    "infinity",
    "elimination",
    "witness",
    "box_exponent",
    "solutions",
    "notes",
)
_SUBDIVIDED: Final = (*_KEYS[:14], "subdivision", *_KEYS[14:])
"""The keys where the route is that by mixed volumes."""
_REPRESENTATION: Final = ("separating_form", "eliminant", "numerators")
_INFINITY: Final = ("chart", "separating_form", "eliminant", "coordinates", "multiplicity")
_WITNESS: Final = ("cause", "forms", "slices")
_SOLUTION: Final = ("parameter", "values", "multiplicity")

_NUMBERS: Final = re.compile(r"(?:0|-?[1-9][0-9]{0,17})(?: (?:0|-?[1-9][0-9]{0,17}))*", re.ASCII)
_PRODUCT: Final = re.compile(r"(?:0|[1-9][0-9]{0,5})(?: (?:[0-9]|[1-5][0-9]|6[0-3])){0,64}", re.ASCII)


@dataclass(frozen=True)
class Points:
    """x_i = numerators_i(t) / h'(t) at the roots t of the eliminant h."""

    form: tuple[int, ...]
    eliminant: fmpz_poly
    numerators: tuple[fmpz_poly, ...]


@dataclass(frozen=True)
class InfinitePoints:
    """Points (0 : z) at infinity, with w.z = 1, and how much they are said to count."""

    chart: tuple[int, ...]
    points: Points
    multiplicity: int


@dataclass(frozen=True)
class Witness:
    """Why there are infinitely many solutions."""

    cause: str
    forms: tuple[tuple[int, ...], ...]
    slices: tuple[tuple[Fraction, Points], ...]


@dataclass(frozen=True)
class SystemDocument:
    """What a certificate says."""

    size: int
    polynomials: tuple[Terms, ...]
    claim: str
    route: str | None
    complex_solutions: int | None
    distinct_solutions: int
    real_solutions: int
    points: Points | None
    groups: tuple[tuple[int, ...], ...] | None
    infinity: InfinitePoints | None
    elimination: tuple[tuple[Row, ...], ...] | None
    subdivision: Subdivision | None
    witness: Witness | None
    box_exponent: int
    solutions: tuple[ListedPose, ...]


def read_system_document(body: dict[str, Any]) -> SystemDocument:
    """The content of a certificate whose digest has been looked at."""
    keys = _SUBDIVIDED if "subdivision" in body else _KEYS
    values = dict(zip(keys, entries(body, "certificate", keys), strict=True))
    text(values["title"], "title")
    items(values["notes"], "notes", None, text)
    variables = read_variables(values["variables"])
    size = len(variables)
    exponent = count(values["box_exponent"], "box_exponent")
    if exponent > MAX_BOX_EXPONENT:
        raise too_large(f"box_exponent: more than {MAX_BOX_EXPONENT}")
    route, number = values["completeness_route"], values["complex_solutions"]
    groups, infinity, steps, witness = (values[key] for key in ("groups", "infinity", "elimination", "witness"))
    found = values["representation"]
    return SystemDocument(
        size=size,
        polynomials=read_polynomials(values["polynomials"], variables),
        claim=choice(values["claim"], "claim", CLAIMS),
        route=None if route is None else choice(route, "completeness_route", ROUTES),
        complex_solutions=None if number is None else count(number, "complex_solutions"),
        distinct_solutions=count(values["distinct_solutions"], "distinct_solutions"),
        real_solutions=count(values["real_solutions"], "real_solutions"),
        points=None if found is None else _points(found, "representation", size),
        groups=None if groups is None else _groups(groups, size),
        infinity=None if infinity is None else _infinity(infinity, size),
        elimination=None if steps is None else items(steps, "elimination", None, _step),
        subdivision=_subdivision(values["subdivision"], size) if "subdivision" in values else None,
        witness=None if witness is None else _witness(witness, size),
        box_exponent=exponent,
        solutions=items(values["solutions"], "solutions", None, lambda entry, where: _solution(entry, where, size)),
    )


def _points(value: Any, where: str, size: int) -> Points:
    form, eliminant, numerators = entries(value, where, _REPRESENTATION)
    return _placed(form, eliminant, numerators, where, size, "numerators")


def _placed(form: Any, eliminant: Any, numerators: Any, where: str, size: int, key: str) -> Points:
    h = read_polynomial(eliminant, f"{where}.eliminant")
    if h.degree() < 1:
        raise malformed(f"{where}.eliminant: constant")
    return Points(
        items(form, f"{where}.separating_form", size, integer),
        h,
        items(numerators, f"{where}.{key}", size, read_polynomial),
    )


def _infinity(value: Any, size: int) -> InfinitePoints:
    chart, form, eliminant, coordinates, multiplicity = entries(value, "infinity", _INFINITY)
    return InfinitePoints(
        items(chart, "infinity.chart", size, integer),
        _placed(form, eliminant, coordinates, "infinity", size, "coordinates"),
        count(multiplicity, "infinity.multiplicity"),
    )


def _groups(value: Any, size: int) -> tuple[tuple[int, ...], ...]:
    groups = items(value, "groups", None, lambda entry, where: items(entry, where, None, count))
    flat = [place for group in groups for place in group]
    firsts = [group[0] for group in groups if group]
    ordered = all(list(group) == sorted(group) for group in groups) and firsts == sorted(firsts)
    if len(groups) < 2 or len(firsts) < len(groups) or not ordered or sorted(flat) != list(range(size)):
        raise malformed("groups: not all variables in at least two groups, by increasing numbers")
    return groups


def _step(value: Any, where: str) -> tuple[Row, ...]:
    if isinstance(value, list) and len(value) > MAX_ELIMINATION_ROWS:
        raise too_large(f"{where}: more than {MAX_ELIMINATION_ROWS} products")
    return items(value, where, None, _product)


def _product(value: Any, where: str) -> Row:
    if not _PRODUCT.fullmatch(text(value, where)):
        raise malformed(f"{where}: not the index of an element and those of the variables that multiply it")
    index, *factors = map(int, value.split(" "))
    if factors != sorted(factors):
        raise malformed(f"{where}: the variables are not in increasing order")
    return index, tuple(factors)


def _subdivision(value: Any, size: int) -> Subdivision:
    lifting, obstructions = entries(value, "subdivision", ("lifting", "obstructions"))
    return Subdivision(
        items(lifting, "subdivision.lifting", size, _numbers),
        items(obstructions, "subdivision.obstructions", None, _obstruction),
    )


def _numbers(value: Any, where: str) -> tuple[int, ...]:
    if not _NUMBERS.fullmatch(text(value, where)):
        raise malformed(f"{where}: not integers with a space between them")
    return tuple(map(int, value.split(" ")))


def _obstruction(value: Any, where: str) -> tuple[tuple[int, int, int], ...]:
    numbers = _numbers(value, where)
    found = tuple(zip(numbers[::3], numbers[1::3], numbers[2::3], strict=False))
    places = [(i, k) for i, k, _ in found]
    ordered = places == sorted(set(places)) and all(i >= 0 and k >= 0 and weight for i, k, weight in found)
    if len(numbers) % 3 or not ordered:
        raise malformed(f"{where}: not weights other than 0 of points in increasing order")
    return found


def _witness(value: Any, size: int) -> Witness:
    cause, forms, slices = entries(value, "witness", _WITNESS)
    if isinstance(forms, list) and len(forms) > MAX_VARIABLES:
        raise too_large(f"witness.forms: more than {MAX_VARIABLES}")
    return Witness(
        choice(cause, "witness.cause", CAUSES),
        items(forms, "witness.forms", None, lambda entry, where: items(entry, where, size + 1, integer)),
        items(slices, "witness.slices", None, lambda entry, where: _slice(entry, where, size)),
    )


def _slice(value: Any, where: str, size: int) -> tuple[Fraction, Points]:
    constant, found = entries(value, where, ("constant", "representation"))
    return rational(constant, f"{where}.constant"), _points(found, f"{where}.representation", size)


def _solution(value: Any, where: str, size: int) -> ListedPose:
    parameter, values, multiplicity = entries(value, where, _SOLUTION)
    return ListedPose(
        _ends(parameter, f"{where}.parameter"),
        items(values, f"{where}.values", size, _ends),
        None if multiplicity is None else count(multiplicity, f"{where}.multiplicity"),
    )


def _ends(value: Any, where: str) -> tuple[str, str]:
    low, high = rational_texts(value, where, 2)
    return low, high
