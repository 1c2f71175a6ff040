"""Reduction steps over Q: against the echelon form of the whole matrix, whatever was expected of it."""

from __future__ import annotations

from math import gcd
from random import Random

import pytest
from samples import shipped

from pkm_exact.algebra import exact_basis as module
from pkm_exact.algebra import groebner
from pkm_exact.algebra.exact_basis import exact_basis
from pkm_exact.algebra.exact_reduction import ExactPolynomial, echelon_form, exact_new_rows
from pkm_exact.algebra.modular_elimination import Elimination
from pkm_exact.completeness.completeness_proof import elimination_system
from pkm_exact.engine import solve
from pkm_exact.policy import Policy

SIMILAR = "similar-planar-s"


def _rows(seed: int) -> list[ExactPolynomial]:
    """Sparse rows of coprime integers, some of them combinations of others."""
    random = Random(seed)
    rows: list[ExactPolynomial] = []
    for _ in range(random.randint(1, 9)):
        places = sorted(random.sample(range(12), random.randint(1, 4)), reverse=True)
        values = [random.choice((-1, 1)) * random.randint(1, 9) for _ in places]
        rows.append(tuple((place, value // gcd(*values)) for place, value in zip(places, values, strict=True)))
    for _ in range(random.randint(0, 2)):
        first, second = dict(random.choice(rows)), dict(random.choice(rows))
        total = {place: 2 * first.get(place, 0) + 3 * second.get(place, 0) for place in first.keys() | second.keys()}
        if any(total.values()):
            rows.append(tuple((place, total[place]) for place in sorted(total, reverse=True) if total[place]))
    random.shuffle(rows)
    return rows


def _wanted(rows: list[ExactPolynomial]) -> list[ExactPolynomial]:
    given = {row[0][0] for row in rows}
    return [row for row in echelon_form(rows) if row[0][0] not in given]


@pytest.mark.parametrize("seed", range(30))
def test_the_new_rows_are_those_of_the_whole_echelon_form(seed: int) -> None:
    rows = _rows(seed)
    leading = [row[0][0] for row in echelon_form(rows)]
    assert exact_new_rows(rows, leading) == _wanted(rows)


@pytest.mark.parametrize("seed", range(30))
def test_wrong_expectations_change_nothing(seed: int) -> None:
    rows = _rows(seed)
    random = Random(seed)
    leading = [row[0][0] for row in echelon_form(rows)]
    for expected in ([], range(12), random.sample(range(12), len(leading)), [place + 1 for place in leading]):
        assert exact_new_rows(rows, expected) == _wanted(rows)


def test_pivots_that_come_too_late_are_seen() -> None:
    rows = [((3, 1), (2, 1)), ((3, 1), (2, 2), (1, 3))]
    assert exact_new_rows(rows, {3, 2}) == exact_new_rows(rows, {3, 1}) == [((2, 1), (1, 3))]


def test_elements_are_those_of_whole_echelon_forms(monkeypatch: pytest.MonkeyPatch) -> None:
    system = elimination_system(shipped(SIMILAR))
    trace = Elimination(system, Policy()).trace()
    assert trace is not None
    short = exact_basis(system, trace)
    monkeypatch.setattr(module, "exact_new_rows", lambda rows, _: echelon_form(rows))
    assert exact_basis(system, trace) == short


def test_the_proof_eliminates_no_second_time_modulo_the_prime_of_the_solve(monkeypatch: pytest.MonkeyPatch) -> None:
    primes = []
    learn = groebner.learn

    def counted(polynomials: object, ring: object, prime: int, **options: object) -> object:
        primes.append(prime)
        return learn(polynomials, ring, prime, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(groebner, "learn", counted)
    assert solve(shipped(SIMILAR)).completeness is not None
    assert len(primes) == 1


def test_a_trace_recorded_later_is_the_same() -> None:
    system = elimination_system(shipped("3-rpr-merlet-p"))
    ring = system.monomials
    prime = 2**31 - 1
    at_once = groebner.learn(system.modulo(prime), ring, prime, degree_limit=20)
    later = groebner.learn(system.modulo(prime), ring, prime, degree_limit=20, record=False)
    assert later.trace is None
    assert later.recorded().trace == at_once.trace
    assert at_once.trace is not None
    other = 2**31 - 19
    followed = groebner.apply(at_once.trace, system.modulo(other), ring, other)
    assert followed.leading_monomials == at_once.leading_monomials


def test_bases_of_other_systems_are_not_taken_over() -> None:
    one, other = (Elimination(elimination_system(shipped(name)), Policy()) for name in ("3-rpr-merlet-p", "3-rrr"))
    one.image()
    assert other.knowing(one).learned == {}
    again = Elimination(elimination_system(shipped("3-rpr-merlet-p")), Policy(seed=5))
    assert again.knowing(one).learned == {}
