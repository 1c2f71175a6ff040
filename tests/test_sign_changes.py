"""Real roots by Descartes' rule in balls: the same as by all complex roots, and as they were put in."""

from __future__ import annotations

from fractions import Fraction
from math import prod
from random import Random

import pytest
from flint import fmpq, fmpz_poly

from pkm_exact.precision import working_precision
from pkm_exact.roots import isolation
from pkm_exact.roots.isolation import isolate_real_roots
from pkm_exact.roots.sign_changes import descartes_enclosures

BITS = 64


def _of(*roots: Fraction | int) -> fmpz_poly:
    factors = [fmpz_poly([-Fraction(root).numerator, Fraction(root).denominator]) for root in roots]
    return prod(factors, start=fmpz_poly([1]))


RATIONAL: dict[str, list[Fraction | int]] = {
    "none": [],
    "0": [0],
    "powers of 2": [-4, -2, -1, 0, 1, 2, 4, 8, 1024],
    "halves of one interval": [Fraction(k, 8) for k in range(-9, 10)],
    "integers": list(range(-20, 21)),
    "close": [Fraction(1, 3), Fraction(1, 3) + Fraction(1, 10**30), Fraction(1, 3) - Fraction(1, 10**40)],
    "of all sizes": [Fraction(3) ** k for k in range(-30, 31, 5)] + [-(Fraction(3) ** k) for k in range(-30, 31, 7)],
}


@pytest.mark.parametrize("name", RATIONAL)
def test_roots_that_were_put_in(name: str) -> None:
    roots = sorted(map(Fraction, RATIONAL[name]))
    for factor in (fmpz_poly([1]), fmpz_poly([1, 0, 1]), fmpz_poly([7, -3, 5])):
        found = descartes_enclosures(_of(*roots) * factor, BITS)
        assert found is not None
        assert len(found) == len(roots)
        with working_precision(2000):
            places = [fmpq(root.numerator, root.denominator) for root in roots]
            assert [[ball.contains(place) for place in places] for ball in found] == [
                [one == other for other in places] for one in places
            ]


@pytest.mark.parametrize("seed", range(12))
def test_cells_are_those_found_by_all_complex_roots(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    random = Random(seed)
    size = random.choice((3, 10, 10**9))
    polynomial = fmpz_poly([random.randint(-size, size) for _ in range(random.randrange(2, 40))] + [1])
    polynomial = prod((factor for factor, _ in polynomial.factor()[1]), start=fmpz_poly([1]))
    expected = isolate_real_roots(polynomial)
    monkeypatch.setattr(isolation, "MOST_COMPLEX_ROOTS", 0)
    assert isolate_real_roots(polynomial) == expected


def test_a_root_at_an_end_of_an_interval_is_found_otherwise(monkeypatch: pytest.MonkeyPatch) -> None:
    polynomial = _of(Fraction(1009, 1000), Fraction(1009, 2000), Fraction(-1009, 4000))
    assert descartes_enclosures(polynomial, BITS) is None
    monkeypatch.setattr(isolation, "MOST_COMPLEX_ROOTS", 0)
    assert len(isolate_real_roots(polynomial)) == 3


def test_nothing_is_said_of_double_roots() -> None:
    """They are never told from two roots, or from none, however many bits."""
    assert descartes_enclosures(fmpz_poly([-1, 3]) ** 2, BITS) is None
