"""Polynomial systems: what is claimed of their solutions, by which route, and that the checker accepts it."""

import json
from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from math import isqrt
from typing import Any

import pytest

from pkm_exact import solve_system
from pkm_exact.certify.check import check_bytes
from pkm_exact.interactive.system_answers import SystemSolution

CASES: dict[str, tuple[list[str], tuple[str, str | None, int | None, int, list[int | None]]]] = {
    "simple, all that degrees admit": (
        ["x^2 + y^2 - 4", "x*y - 1"],
        ("complete", "refined-bezout", 4, 4, [1, 1, 1, 1]),
    ),
    "one unknown": (["7*x^3 - 2"], ("complete", "refined-bezout", 3, 3, [1])),
    "in groups": (["x*y - 2", "x*y + x + y"], ("complete", "multihomogeneous-bezout", 2, 2, [])),
    "more polynomials than unknowns": (
        ["x*y", "x^2 - x", "y^2 - y"],
        ("complete", "modular-rank", 3, 3, [1, 1, 1]),
    ),
    "double": (["x^2", "y^2 - 1"], ("complete", "modular-rank", 4, 2, [2, 2])),
    "fourfold": (["x^2", "y^2"], ("complete", "modular-rank", 4, 1, [4])),
    "touching circles": (
        ["(x - 1)^2 + y^2 - 1", "x^2 + y^2 - 4"],
        ("complete", "counting-at-infinity", 2, 1, [2]),
    ),
    "circles": (["(x - 1)^2 + y^2 - 1", "x^2 + y^2 - 2"], ("complete", "counting-at-infinity", 2, 2, [1, 1])),
    "a degree falls": (["x^2*y - 1", "x*y - y"], ("complete", "exact-elimination", 1, 1, [1])),
    "triple": (["(x - 1)^3", "x*y^2 - y^2 + y"], ("complete", "exact-elimination", 3, 1, [3])),
    "triple and simple": (
        ["x^3 - x^4", "x*y^2 - y^2 + y"],
        ("complete", "exact-elimination", 7, 3, [3, 3, 1]),
    ),
    "lines that do not meet": (["x - 1", "x - 2"], ("inconsistent", "exact-elimination", 0, 0, [])),
    "hyperbolas that do not meet": (["x*y - 1", "x*y - 2"], ("inconsistent", "exact-elimination", 0, 0, [])),
    "nothing, not even at infinity": (
        ["x^2 + y^2 - 1", "x^3 - y", "x - 2"],
        ("inconsistent", "modular-rank", 0, 0, []),
    ),
    "a constant": (["x^2 - 1", "3"], ("inconsistent", "modular-rank", 0, 0, [])),
    "a curve": (["x*y - 1"], ("positive-dimensional-proved", None, None, 0, [])),
    "a curve and a point": (["x*y - x", "x^2 - x"], ("positive-dimensional-proved", None, None, 0, [])),
    "a curve, twice the same": (["x*y - 1", "2*x*y - 2"], ("positive-dimensional-proved", None, None, 0, [])),
}


@cache
def solved(name: str) -> SystemSolution:
    """The solution of a case."""
    polynomials, _ = CASES[name]
    return solve_system(polynomials, None if len(polynomials) == 1 and "y" not in polynomials[0] else ["x", "y"])


@pytest.mark.parametrize("name", CASES)
def test_claims_routes_and_multiplicities(name: str) -> None:
    found = solved(name)
    assert CASES[name][1] == (
        found.claim,
        found.completeness_route,
        found.complex_solutions,
        found.distinct_solutions,
        [solution.multiplicity for solution in found],
    )


@pytest.mark.parametrize("name", CASES)
def test_the_checker_accepts(name: str) -> None:
    verdict = solved(name).check()
    assert verdict, verdict
    assert verdict.lines[-1].startswith(CASES[name][1][0].replace("-proved", "").replace("-dimensional", " dimension"))


@pytest.mark.parametrize("name", CASES)
def test_the_answer_as_json(name: str) -> None:
    found = solved(name).to_dict()
    assert list(json.loads(json.dumps(found)))[:6] == [
        "claim",
        "completeness_route",
        "complex_solutions",
        "distinct_solutions",
        "real_solutions",
        "solutions",
    ]
    assert len(found["solutions"]) == found["real_solutions"]
    assert all(list(entry["values"]) == found["variables"] for entry in found["solutions"])


def _parts(content: Any) -> Iterator[tuple[str, Any]]:
    """The certificate with one entry changed for that of another, each in turn."""
    for key, other in (("claim", "not-proven-complete"), ("complex_solutions", 5), ("distinct_solutions", 5)):
        yield key, {**content, key: other}
    yield "real_solutions", {**content, "real_solutions": content["real_solutions"] + 1}
    yield "box_exponent", {**content, "box_exponent": content["box_exponent"] + 1}
    for route in ("refined-bezout", "modular-rank", "exact-elimination", None):
        if route != content["completeness_route"]:
            yield f"route {route}", {**content, "completeness_route": route}


@pytest.mark.parametrize("name", ["simple, all that degrees admit", "double", "touching circles", "triple"])
def test_the_checker_refuses_what_is_changed(name: str) -> None:
    from pkm_exact.certify.build import canonical_bytes, sealed

    content = solved(name).certificate().content
    for key, changed in _parts(content):
        verdict = check_bytes(canonical_bytes(sealed(changed)))
        assert not verdict, key


def test_boxes_hold_the_solutions() -> None:
    found = solve_system(["x^2 - 2", "y - x"], width=Fraction(1, 10**30))
    low, high = found.solutions[1].values[0].lo, found.solutions[1].values[0].hi
    root = isqrt(2 * 10**80)
    assert low < high <= low + 1
    assert low * 10**40 <= root + 1
    assert high * 10**40 >= root
    assert high - low <= 10**-30
