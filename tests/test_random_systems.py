"""Random small systems against msolve and against resultants: no disagreement, and certificates are accepted."""

from fractions import Fraction
from itertools import pairwise
from math import prod

import pytest
from flint import fmpq, fmpz_mpoly
from random_systems import plane_count, random_system

from pkm_exact.backends.msolve_program import find_msolve, run_msolve
from pkm_exact.claim import Claim
from pkm_exact.interactive.system_answers import solve_system

QUICK, ALL = range(40), range(1000)
MISSED_BY_MSOLVE = {374: (Fraction(-1, 3), Fraction(0))}
"""Real solutions that msolve (0.9) leaves out, by seeds; that they are solutions is seen by putting them in."""
INFINITE = (Claim.POSITIVE_DIMENSIONAL_PROVED, Claim.POSITIVE_DIMENSIONAL_DETECTED)


def agree(seed: int, *, with_msolve: bool) -> Claim:
    """What is claimed of a system, after everything has been compared."""
    system = random_system(seed)
    found = solve_system(system)
    verdict = found.check()
    assert verdict, (seed, verdict)
    plane = plane_count(system)
    if plane is not None:
        assert found.claim in (Claim.COMPLETE, Claim.INCONSISTENT), seed
        assert (found.complex_solutions, found.distinct_solutions) == (plane.total, plane.distinct), seed
    if not with_msolve:
        return found.claim
    theirs = run_msolve(system, seconds=60)
    assert (theirs.dimension == 1) == (found.claim in INFINITE), seed
    assert (theirs.dimension == -1) == (found.claim is Claim.INCONSISTENT), seed
    if theirs.dimension == 0:
        assert found.claim is Claim.COMPLETE, seed
        assert found.complex_solutions == theirs.degree, seed
        missed = 1 if seed in MISSED_BY_MSOLVE else 0
        assert found.real_solutions == len(theirs.real_solutions) + missed, seed
        for point in theirs.real_solutions:
            near = [b for b in found if all(v.overlaps(w) for v, w in zip(b.values, point, strict=True))]
            assert len(near) == 1, seed
    return found.claim


@pytest.mark.parametrize("seed", QUICK)
def test_a_few(seed: int) -> None:
    agree(seed, with_msolve=False)


@pytest.mark.slow
@pytest.mark.skipif(find_msolve() is None, reason="msolve is not installed")
@pytest.mark.parametrize("hundred", range(10))
def test_a_thousand(hundred: int) -> None:
    claims = [agree(seed, with_msolve=True) for seed in ALL[100 * hundred : 100 * hundred + 100]]
    assert {Claim.COMPLETE, Claim.INCONSISTENT} <= set(claims)


@pytest.mark.parametrize("seed", MISSED_BY_MSOLVE)
def test_what_msolve_misses_is_a_solution(seed: int) -> None:
    point = [fmpq(value.numerator, value.denominator) for value in MISSED_BY_MSOLVE[seed]]
    assert all(_at(polynomial, point) == 0 for polynomial in random_system(seed).polynomials)


def _at(polynomial: fmpz_mpoly, point: list[fmpq]) -> fmpq:
    terms = polynomial.to_dict().items()
    return sum(
        (
            fmpq(value) * prod((x ** int(e) for x, e in zip(point, key, strict=True)), start=fmpq(1))
            for key, value in terms
        ),
        fmpq(0),
    )


def test_counts_of_curves_in_the_plane() -> None:
    """The independent count itself, of which an answer is known."""
    from pkm_exact.systems.system_sources import polynomial_system

    counts = [plane_count(polynomial_system(given)) for given in (["x^2 - y", "y"], ["x*y - 1", "x - y"], ["x*y", "x"])]
    assert counts[2] is None
    assert [(found.total, found.distinct) for found in counts[:2] if found] == [(2, 1), (2, 2)]
    assert all(random_system(a) != random_system(b) for a, b in pairwise(range(20)))
