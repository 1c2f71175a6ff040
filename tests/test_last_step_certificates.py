"""Shorter ways than the obvious one: a last step modulo a prime, and legs' equations of which one is subtracted."""

from __future__ import annotations

from pathlib import Path

import pytest
from certificate_tools import both
from forged_last_steps import LAST_STEPS, LENGTHS

from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.checker import elimination
from pkm_exact.certify.checker.budget import Budget, spending
from pkm_exact.certify.checker.elimination import Elimination
from pkm_exact.certify.checker.packed_monomials import Polynomial, Tuples

CASES = Path(__file__).parent / "cases"


@pytest.mark.parametrize("name", LAST_STEPS)
def test_a_last_step(name: str) -> None:
    make, status = LAST_STEPS[name]
    verdict = both(canonical_bytes(sealed(make())))
    assert verdict.status == status, verdict


@pytest.mark.parametrize("name", LENGTHS)
def test_longer_legs(name: str) -> None:
    make, status = LENGTHS[name]
    verdict = both(canonical_bytes(sealed(make())))
    assert verdict.status == status, verdict


@pytest.mark.parametrize(
    ("name", "status"),
    [
        ("planar-total-5-false", "rejected"),
        ("planar-total-4", "accepted"),
        ("last-step-on-a-prime", "rejected"),
        ("singular-scaled-by-a-prime", "accepted"),
    ],
)
def test_robots_built_on_primes_of_the_first_checker(name: str, status: str) -> None:
    """A double pose at which another determinant is divisible by its primes: 5 was a bound modulo one, and counted."""
    assert both((CASES / f"{name}.json").read_bytes()).status == status


def _begun(size: int, *elements: Polynomial) -> Elimination:
    """With these elements, their first terms leading."""
    packing = Tuples(size)
    packed = ({packing.packed(monomial): value for monomial, value in element.items()} for element in elements)
    return Elimination(packing, tuple(packed))


def test_a_prime_of_the_last_step_leaves_no_less_than_there_is() -> None:
    """Two at x^2 = 1; nothing is told where no power of x is there."""
    before = _begun(1, {(2,): 1, (0,): -1})
    assert before.at_most([(0, (0,))], 5) == 2
    assert _begun(1).at_most([], 5) is None


def test_residues_of_long_coefficients_are_charged_for() -> None:
    elements = ({(1,): 1 << 640_000, (0,): 1},)
    budget = Budget(0)
    with spending(budget):
        assert _begun(1, *elements).at_most([(0, ())], 5) == 1
    assert budget.spent > 10**6


ONE_UNKNOWN = {
    "7 x = 1": ({(1,): 7, (0,): -1}, None),
    "7 x^2 + x = 1": ({(2,): 7, (1,): 1, (0,): -1}, None),
    "x^2 + 7 x = 1": ({(2,): 1, (1,): 7, (0,): -1}, 2),
    "x^2 = 7": ({(2,): 1, (0,): -7}, 2),
}


@pytest.mark.parametrize("name", ONE_UNKNOWN)
@pytest.mark.parametrize("step", [[], [(0, ())], [(0, (0,))], [(0, (0, 0)), (0, ())]])
def test_whatever_the_prime_is_no_fewer_are_left(
    name: str, step: list[tuple[int, tuple[int, ...]]], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of one element, whose first coefficient may be divisible by it: nothing is told then, or as much as is true."""
    monkeypatch.setattr(elimination, "_prime", lambda _: 7)
    element, number = ONE_UNKNOWN[name]
    assert _begun(1, element).at_most(step, 5) == number


def test_an_unknown_without_a_power_may_be_anything(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two unknowns: x = 1 and 7 y = 1, or 7 y^2 + x y = 1 beside it; modulo 7 there is no y, or one."""
    monkeypatch.setattr(elimination, "_prime", lambda _: 7)
    line = {(1, 0): 1, (0, 0): -1}
    for other in ({(0, 1): 7, (0, 0): -1}, {(0, 2): 7, (1, 1): 1, (0, 0): -1}):
        for step in ([(1, ())], [(0, (1,)), (1, ())], [(0, (0,)), (0, (1,)), (0, ()), (1, ())]):
            assert _begun(2, line, other).at_most(step, 5) is None
