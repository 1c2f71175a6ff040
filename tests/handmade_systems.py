"""Certificates of systems whose solutions are rational and known, written without the solver: honest or not.

A representation is interpolated from points; boxes are those of the plain checker for whatever is represented, so that
a forged certificate is wrong only where it is meant to be.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import partial
from math import gcd, lcm
from typing import Any

from public_systems import parsed

from pkm_exact.certify import pure, pure_system
from pkm_exact.certify.build import canonical_bytes, sealed

Content = dict[str, Any]
Point = Sequence[Fraction | int]


def multiplied(one: Sequence[Fraction | int], other: Sequence[Fraction | int]) -> list[Fraction]:
    """The product of polynomials, lowest degree first."""
    total = [Fraction(0)] * (len(one) + len(other) - 1)
    for i, a in enumerate(one):
        for j, b in enumerate(other):
            total[i + j] += Fraction(a) * b
    return total


def interpolated(points: Sequence[Point], form: Sequence[int], shift: Sequence[int] = ()) -> tuple[list[int], Any]:
    """h and the N_i with N_i / h' = x_i at the root of each point, which is the value of the form, plus a shift."""
    values = [sum(c * Fraction(x) for c, x in zip(form, point, strict=True)) for point in points]
    roots = [value + step for value, step in zip(values, shift or [0] * len(points), strict=True)]
    h: list[Fraction] = [Fraction(1)]
    for root in roots:
        h = multiplied(h, [-root, 1])
    numerators = [[Fraction(0)] * len(points) for _ in form]
    for place, point in enumerate(points):
        basis: list[Fraction] = [Fraction(1)]
        for other, root in enumerate(roots):
            if other != place:
                basis = multiplied(basis, [-root, 1])
        for numerator, x in zip(numerators, point, strict=True):
            for power, coefficient in enumerate(basis):
                numerator[power] += Fraction(x) * coefficient
    common = lcm(*(c.denominator for each in (h, *numerators) for c in each))
    whole = [[int(c * common) for c in each] for each in (h, *numerators)]
    content = gcd(*(c for each in whole for c in each))
    lowest = [trimmed([c // content for c in each]) for each in whole]
    return lowest[0], lowest[1:]


def trimmed(coefficients: Sequence[int]) -> list[int]:
    """Without zeros at the end."""
    found = list(coefficients)
    while found and not found[-1]:
        found.pop()
    return found


def hexadecimal(coefficients: Sequence[int]) -> list[str]:
    return [hex(coefficient) for coefficient in coefficients]


def represented(points: Sequence[Point], form: Sequence[int], shift: Sequence[int] = ()) -> Content:
    """An entry ``representation``."""
    h, numerators = interpolated(points, form, shift)
    return {
        "separating_form": list(form),
        "eliminant": hexadecimal(h),
        "numerators": [hexadecimal(numerator) for numerator in numerators],
    }


def at_infinity(points: Sequence[Point], chart: Sequence[int], form: Sequence[int], multiplicity: int) -> Content:
    """An entry ``infinity``; w.z = 1 at the points."""
    found = represented(points, form)
    return {
        "chart": list(chart),
        "separating_form": list(form),
        "eliminant": found["eliminant"],
        "coordinates": found["numerators"],
        "multiplicity": multiplicity,
    }


def polynomials_of(unknowns: str, *texts: str) -> list[list[str]]:
    """Polynomials in the spelling of certificates."""
    names, polynomials = parsed(f"{unknowns}\n0\n{','.join(texts)}\n")
    found = []
    for polynomial in polynomials:
        common = lcm(*(value.denominator for value in polynomial.values()))
        terms = []
        for monomial in sorted(polynomial, key=pure.order, reverse=True):
            powers = zip(names, monomial, strict=True)
            factors = [name if power == 1 else f"{name}^{power}" for name, power in powers if power]
            value = str(int(polynomial[monomial] * common))
            if factors and value in ("1", "-1"):
                factors[0] = value[:-1] + factors[0]
            else:
                factors.insert(0, value)
            terms.append("*".join(factors))
        found.append(terms)
    return found


def real_solutions(representation: Content, exponent: int, multiplicities: Any) -> list[Content]:
    """The entries ``solutions`` for what is represented; one multiplicity for all, or each by the order of boxes."""
    h = [int(c, 16) for c in representation["eliminant"]]
    numerators = tuple([int(c, 16) for c in each] for each in representation["numerators"])
    form = tuple(representation["separating_form"])
    points = pure.Representation((0,) * len(form), form, h, numerators)
    h0 = pure.primitive_part(h)
    roots = pure.isolated(h0)
    cells = [pure.cells_of(partial(pure_system.coordinates_at, points, h0, root), exponent) for root in roots]
    order = sorted(range(len(roots)), key=cells.__getitem__)
    if not isinstance(multiplicities, list):
        multiplicities = [multiplicities] * len(roots)
    return [
        {
            "parameter": list(pure.ends(roots[i].m, roots[i].m + (not roots[i].exact), roots[i].k)),
            "values": [list(pure.ends(low, high, exponent)) for low, high in cells[i]],
            "multiplicity": multiplicity,
        }
        for i, multiplicity in zip(order, multiplicities, strict=True)
    ]


def system_content(unknowns: str, texts: Sequence[str], **entries: Any) -> Content:
    """A certificate, without its digest: of nothing, unless ``entries`` say more."""
    content: Content = {
        "format": "pkm_exact system certificate",
        "version": 1,
        "title": "made by hand",
        "variables": unknowns.split(","),
        "polynomials": polynomials_of(unknowns, *texts),
        "claim": "not-proven-complete",
        "completeness_route": None,
        "complex_solutions": None,
        "distinct_solutions": 0,
        "real_solutions": 0,
        "representation": None,
        "groups": None,
        "infinity": None,
        "elimination": None,
        "witness": None,
        "box_exponent": 0,
        "solutions": [],
        "notes": [],
    }
    if "subdivision" in entries:
        last = {key: content.pop(key) for key in ("witness", "box_exponent", "solutions", "notes")}
        content |= {"subdivision": None} | last
    assert set(entries) <= set(content)
    return content | entries


def listed(
    unknowns: str,
    texts: Sequence[str],
    representation: Content,
    *,
    exponent: int = 8,
    multiplicities: Any = 1,
    **entries: Any,
) -> Content:
    """A certificate with solutions."""
    solutions = real_solutions(representation, exponent, multiplicities)
    counts = {
        "distinct_solutions": len(representation["eliminant"]) - 1,
        "real_solutions": len(solutions),
        "box_exponent": exponent if solutions else 0,
    }
    return system_content(unknowns, texts, representation=representation, solutions=solutions, **(counts | entries))


def complete(route: str, total: int, **entries: Any) -> Content:
    """The entries of a claim "complete"."""
    return {"claim": "complete", "completeness_route": route, "complex_solutions": total, **entries}


def sealed_bytes(content: Content) -> bytes:
    return canonical_bytes(sealed(content))


# ---------------------------------------------------------------------------------------------------------------------
# Honest certificates, one for each claim and route
# ---------------------------------------------------------------------------------------------------------------------

SQUARES = ("x^2-1", "y^2-4")
CORNERS = [(-1, -2), (-1, 2), (1, -2), (1, 2)]
BILINEAR = ("x*y-2", "x*y-2*x-2*y+4")
PAIR = [(1, 2), (2, 1)]
ENDS = at_infinity([(1, 0), (0, 1)], (1, 1), (1, 2), 2)
DOUBLE = ("x^2", "y^2-1")
TANGENT = ("x^2-y", "y^2")
LINE = ("x*y-x", "x*y-2*x")
CURVES = ("x^3*y-900", "x*y+x-19")
CROSSINGS = [(10, Fraction(9, 10)), (15, Fraction(4, 15)), (-6, Fraction(-25, 6))]
CELLS = {"lifting": ["6 6", "0 4 7"], "obstructions": ["0 0 -1 0 1 1 1 0 1 1 1 2 1 2 -3"]}
BILINEAR_CELLS = {
    "lifting": ["6 6", "0 4 7 6"],
    "obstructions": ["0 0 -1 0 1 1 1 0 1 1 3 -1", "0 0 -1 0 1 1 1 0 2 1 1 -1 1 2 -1"],
}


def _slices(constants: Sequence[int]) -> list[Content]:
    """Of the line x = 0, at these y."""
    return [{"constant": str(a), "representation": represented([(0, a)], (0, 1))} for a in constants]


def handmade() -> dict[str, Content]:
    """All of them, by name."""
    none = {"claim": "inconsistent", "complex_solutions": 0}
    curve = {"claim": "positive-dimensional-proved"}
    few = {"cause": "fewer-polynomials", "forms": [], "slices": []}
    many = {"cause": "more-solutions-than-bound", "forms": [[0, 1, 0]], "slices": _slices(range(3, 8))}
    return {
        "bezout": listed("x,y", SQUARES, represented(CORNERS, (1, 1)), **complete("refined-bezout", 4)),
        "complex": listed(
            "x",
            ("x^3-x^2+x-1",),
            {"separating_form": [1], "eliminant": hexadecimal([-1, 1, -1, 1]), "numerators": [["0x3", "-0x2", "0x1"]]},
            **complete("refined-bezout", 3),
        ),
        "groups": listed(
            "x,y", BILINEAR, represented(PAIR, (1, 0)), **complete("multihomogeneous-bezout", 2, groups=[[0], [1]])
        ),
        "rank": listed(
            "x,y", DOUBLE, represented([(0, -1), (0, 1)], (1, 1)), multiplicities=2, **complete("modular-rank", 4)
        ),
        "cells": listed(
            "x,y", CURVES, represented(CROSSINGS, (1, 0)), **complete("mixed-volume", 3, subdivision=CELLS)
        ),
        "cells of groups": listed(
            "x,y", BILINEAR, represented(PAIR, (1, 0)), **complete("mixed-volume", 2, subdivision=BILINEAR_CELLS)
        ),
        "infinity": listed(
            "x,y", BILINEAR, represented(PAIR, (1, 0)), **complete("counting-at-infinity", 2, infinity=ENDS)
        ),
        "algebra": listed(
            "x,y",
            TANGENT,
            represented([(0, 0)], (1, 1)),
            multiplicities=4,
            **complete("exact-elimination", 4, elimination=[]),
        ),
        "elimination": listed(
            "x,y",
            ("x*y-1", "x-1"),
            represented([(1, 1)], (1, 1)),
            **complete("exact-elimination", 1, elimination=[["0", "1 1"]]),
        ),
        "some": listed("x,y", SQUARES, represented(CORNERS[1:], (1, 1))),
        "multiple": listed("x,y", TANGENT, represented([(0, 0)], (1, 1)), multiplicities=None),
        "nothing": system_content("x,y", SQUARES),
        "detected": system_content("x,y", LINE, claim="positive-dimensional-detected"),
        "none, rank": system_content("x,y", ("x", "x-1", "y"), completeness_route="modular-rank", **none),
        "none, elimination": system_content(
            "x,y", ("x*y-1", "x"), completeness_route="exact-elimination", elimination=[["0", "1 1"]], **none
        ),
        "few": system_content(
            "x,y", ("x*y-1", "2*x*y-2"), representation=represented([(1, 1)], (1, 1)), witness=few, **curve
        ),
        "many": system_content("x,y", LINE, witness=many, **curve),
    }
