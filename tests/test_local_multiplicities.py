"""Multiplicities by functionals of growing order: known singularities, found by the solver and by both checkers."""

from __future__ import annotations

import re
from typing import Any

import pytest
from certificate_tools import both
from handmade_systems import Content, complete, handmade, listed, represented, sealed_bytes

from pkm_exact import solve_system
from pkm_exact.certify import pure, pure_system
from pkm_exact.certify.check import check_bytes
from pkm_exact.certify.checker import system_verdicts
from pkm_exact.systems import local_multiplicity, no_more_solutions
from pkm_exact.systems.system_claims import BEYOND_CHECKERS_NOTE

SINGULARITIES: dict[str, tuple[tuple[str, ...], int]] = {
    "A5": (("x^5", "y"), 5),
    "A5, bent, and a simple solution": (("y-x^2", "y^2+x^5-x^4+x^6"), 6),
    "D5": (("x*y", "x^2+4*y^3"), 5),
    "E6": (("x^2", "y^3"), 6),
    "E7": (("3*x^2+y^3", "x*y^2"), 7),
    "E8": (("x^2", "y^4"), 8),
    "E8, elsewhere": (("(x-3)^2", "(y+x/2)^4"), 8),
    "J10": (("x^2+x*y^2", "y^5-x*y^3"), 10),
    "three lines, four polynomials": (("x*y", "y*z", "x*z", "x^3+y^3+z^3"), 9),
    "with a simple solution": (("x^2*(x-1)", "y^3-y^4"), 12),
    "of two kinds": (("x^2*(x-1)^3", "y^2"), 10),
    "at square roots": (("(x^2-2)^3", "(y-x)^2"), 12),
    "at square roots, of two kinds": (("(x^2-2)^3*(x^2-3)^2", "(y-x)^2"), 20),
    "at numbers of degree three, and at infinity": (("(3*x^3-x+1)^2", "x*y^3-x^2+1"), 18),
}
"""Systems, and the number of their solutions with multiplicity: Milnor numbers, or products of powers."""


@pytest.mark.parametrize("name", SINGULARITIES)
def test_known_numbers(name: str) -> None:
    texts, number = SINGULARITIES[name]
    found = solve_system(list(texts))
    assert (str(found.claim), found.complex_solutions) == ("complete", number)
    assert both(found.certificate().data).status == "accepted"


def test_multiplicities_one_by_one() -> None:
    found = solve_system(["(x^2-2)^3*(x^2-3)^2", "(y-x)^2"])
    assert found.completeness_route == "modular-rank"
    assert [solution.multiplicity for solution in found] == [4, 6, 6, 4]


TWO_KINDS = ("x^5-3*x^4+3*x^3-x^2", "y^2")
POINTS = [(0, 0), (1, 0)]


def two_kinds(total: int, multiplicities: Any, texts: tuple[str, ...] = TWO_KINDS) -> Content:
    points = represented(POINTS, (1, 1))
    return listed("x,y", texts, points, multiplicities=multiplicities, **complete("modular-rank", total))


def test_accepted_as_they_are() -> None:
    assert both(sealed_bytes(two_kinds(10, [4, 6]))).status == "accepted"


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (two_kinds(10, [6, 4]), "multiplicity: "),
        (two_kinds(10, 5), "multiplicity: "),
        (two_kinds(8, 4), "complex solutions: "),
        (two_kinds(12, [4, 6], ("x^6-3*x^5+3*x^4-x^3", "y^2")), "multiplicity: "),
        (two_kinds(12, [4, 6], ("x^6-5*x^5+9*x^4-7*x^3+2*x^2", "y^2")), "(modular rank|claim): "),
    ],
    ids=["exchanged", "the mean", "weights only", "another power", "a further solution"],
)
def test_what_is_not_so_is_rejected(content: Content, reason: str) -> None:
    data = sealed_bytes(content)
    for verdict in (check_bytes(data), pure.check_bytes(data)):
        assert str(verdict.status) == "rejected", verdict.lines
        assert re.match(reason, verdict.lines[-1]), verdict.lines


@pytest.mark.parametrize("name", ["algebra", "elimination"])
def test_an_algebra_is_tried_if_multiplicities_cost_too_much(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(system_verdicts, "_PART_FOR_MULTIPLICITIES", 10**30)
    monkeypatch.setattr(pure_system, "PART_FOR_MULTIPLICITIES", 10**30)
    assert both(sealed_bytes(handmade()[name])).status == "accepted"


@pytest.mark.parametrize("number", [2, 3, 5])
def test_an_algebra_tells_multiplicities_too(number: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(system_verdicts, "_PART_FOR_MULTIPLICITIES", 10**30)
    monkeypatch.setattr(pure_system, "PART_FOR_MULTIPLICITIES", 10**30)
    data = sealed_bytes(handmade()["algebra"] | {"complex_solutions": number})
    for verdict in (check_bytes(data), pure.check_bytes(data)):
        assert str(verdict.status) == "rejected"


def test_what_checkers_could_not_afford_is_not_claimed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(local_multiplicity, "MOST_SOLUTIONS", 0)
    texts = ["(x-1)^3", "x*y^2-y^2+y"]
    assert str(solve_system(texts).claim) == "complete"
    monkeypatch.setattr(no_more_solutions, "MOST_WORK", 1)
    found = solve_system(texts)
    assert (str(found.claim), found.notes) == ("not-proven-complete", (BEYOND_CHECKERS_NOTE,))
    assert both(found.certificate().data).status == "accepted"


def test_coefficients_that_are_0_modulo_the_first_prime() -> None:
    large = 2**127 - 1
    texts = (f"{large}*x^2-{large}*y", f"{large}*y^2")
    points = represented([(0, 0)], (1, 1))
    content = listed("x,y", texts, points, multiplicities=4, **complete("exact-elimination", 4, elimination=[]))
    assert both(sealed_bytes(content)).status == "accepted"
