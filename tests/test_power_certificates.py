"""Eliminants that are polynomials in T^m: real roots are found as m-th roots, by the solver and by both checkers."""

from __future__ import annotations

import re
from math import prod

import pytest
from certificate_tools import both
from flint import fmpz_poly
from handmade_systems import Content, complete, listed, sealed_bytes

from pkm_exact.certify import pure
from pkm_exact.certify.checker import realposes
from pkm_exact.certify.checker.descartes import real_roots
from pkm_exact.roots import isolation

FAR, NEAR = 10**40, 2**200
POWERS: dict[str, tuple[int, list[list[int]]]] = {
    "two square roots": (2, [[-2, 1]]),
    "exact and not, square roots": (2, [[-1, 1], [-2, 1]]),
    "of numbers below 0, square roots": (2, [[2, 1], [-9, 4]]),
    "no real one, square roots": (2, [[1, 1]]),
    "no real one, fourth roots": (4, [[7, 1], [3, 2]]),
    "of conjugates, square roots": (2, [[1, 1, 1]]),
    "cube roots on both sides": (3, [[1, 1], [-8, 1]]),
    "cube roots below 0": (3, [[8, 1], [27, 8], [3, 1]]),
    "irrational cube roots of neighbours": (3, [[-2, 1], [-3, 1], [2, 1], [3, 1]]),
    "fourth roots": (4, [[-16, 1], [-17, 1], [-81, 16], [-5, 1]]),
    "fifth roots around whole numbers": (5, [[-31, 1], [-32, 1], [-33, 1], [31, 1], [32, 1], [33, 1]]),
    "sixth roots of conjugates": (6, [[-2, -5, 1], [1, 0, 1]]),
    "far out": (3, [[-FAR, 1], [FAR + 1, 1]]),
    "near 0": (3, [[-1, FAR], [1, FAR + 1]]),
    "near 0 and far out": (2, [[-1, FAR], [-FAR, 1], [-FAR - 1, 1]]),
    "close to each other": (3, [[-2, 1], [-2 * NEAR - 1, NEAR], [2, 1], [2 * NEAR + 1, NEAR]]),
    "close square roots": (2, [[-2, 1], [-2 * NEAR - 1, NEAR]]),
    "close to a whole number": (3, [[-1, 1], [-NEAR - 1, NEAR]]),
    "close to 1 from below": (2, [[-1, 1], [1 - NEAR, NEAR]]),
    "square roots of numbers little below 0": (2, [[1, 2], [1, 2**70], [-1, 1]]),
    "in the cell beside 0": (3, [[-1, 2**100 + 1], [-1, 1]]),
    "a little above squares": (2, [[-NEAR - 1, NEAR], [-9 * NEAR - 1, NEAR]]),
    "two close to 0, square roots": (2, [[-1, 2**140], [-3, 2**140]]),
    "four close to 0, cube roots": (3, [[-1, 2**210], [-3, 2**210], [1, 2**210], [3, 2**210]]),
    "a little below a whole number, and far out": (1, [[1 - 3 * 2**40, 1, *[0] * 18, -3 * 2**40, 1]]),
    "a little below 1, and others on both sides": (1, [[-1, 1], [1 - NEAR, NEAR], [-1, 3], [-4, 3], [-5, 3]]),
    "three so close that their slopes are enclosed from 0 on at first": (
        1,
        [[-1, 1], [-(2**280) - 3, 2**280], [1 - 2**281, 2**281]],
    ),
    "fine but exact": (2, [[-1, 2**80], [-1, 2**82], [-3, 2**80]]),
}
"""m, and the factors of the polynomial in S = T^m."""


def _polynomial(name: str) -> fmpz_poly:
    m, factors = POWERS[name]
    return prod(map(fmpz_poly, factors), start=fmpz_poly([1]))(fmpz_poly([0] * m + [1]))


def _content(name: str) -> Content:
    """The certificate of the equation h(x) = 0."""
    h = _polynomial(name)
    terms = [f"{c}*x^{power}" for power, c in enumerate(h.coeffs()) if c]
    slope = h.derivative()
    numerator = fmpz_poly([0, 1]) * slope - h.degree() * h
    representation = {
        "separating_form": [1],
        "eliminant": [hex(int(c)) for c in h.coeffs()],
        "numerators": [[hex(int(c)) for c in numerator.coeffs()]],
    }
    degree = int(h.degree())
    return listed("x", ["+".join(terms)], representation, exponent=300, **complete("refined-bezout", degree))


@pytest.mark.parametrize("name", POWERS)
def test_all_find_the_same_cells(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """By all complex roots, by balls, and by the exact arithmetic of both checkers."""
    h = _polynomial(name)
    expected = isolation.isolate_real_roots(h)
    monkeypatch.setattr(isolation, "MOST_COMPLEX_ROOTS", 0)
    assert isolation.isolate_real_roots(h) == expected
    cells, exponent = realposes.parameter_cells(h, real_roots(h))
    assert cells == [(root.cell, root.cell + (not root.is_exact)) for root in expected]
    roots = pure.isolated([int(c) for c in h.coeffs()])
    assert [(root.m, root.m + (not root.exact)) for root in roots] == cells
    assert {root.exponent for root in expected} | {root.k for root in roots} <= {exponent}


@pytest.mark.parametrize("name", POWERS)
def test_both_accept(name: str) -> None:
    verdict = both(sealed_bytes(_content(name)))
    assert verdict.status == "accepted", verdict.lines


@pytest.mark.parametrize("name", ["two square roots", "cube roots on both sides", "fifth roots around whole numbers"])
@pytest.mark.parametrize("sign", ["-", ""])
def test_roots_of_one_sign_are_not_all(name: str, sign: str) -> None:
    content = _content(name)
    kept = [entry for entry in content["solutions"] if entry["values"][0][0].startswith("-") == bool(sign)]
    verdict = both(sealed_bytes(content | {"solutions": kept, "real_solutions": len(kept)}))
    assert verdict.status == "rejected"
    assert re.search("listed, the eliminant has", verdict.lines[-1])
