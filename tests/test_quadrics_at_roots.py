"""Whether h0 divides a polynomial, by its values at integers: as by division."""

from random import Random
from typing import Any

import pytest
from flint import fmpz_poly

from pkm_exact.certify.checker.quadrics_at_roots import Values, are_multiples, integers_beside, values_at
from pkm_exact.certify.checker.solutions import primitive_part, vanishes

ROOT = fmpz_poly([0, 1])


def _says_that_it_divides(h0: fmpz_poly, polynomial: fmpz_poly) -> bool:
    places, divisors = integers_beside(h0)
    return are_multiples([values_at(places, polynomial)], divisors) == [True]


def _random(random: Random, degree: int, most: int) -> fmpz_poly:
    return fmpz_poly([random.randint(-most, most) for _ in range(degree + 1)])


def test_products_of_two_numerators() -> None:
    random = Random(5)
    seen = {True: 0, False: 0}
    for _ in range(400):
        factors = [fmpz_poly([random.randint(-4, 4), random.choice((1, 1, 2, 3))]) for _ in range(random.randint(1, 6))]
        h0 = fmpz_poly([1])
        for factor in factors:
            h0 *= factor
        h0, degree = primitive_part(h0), len(factors)
        places, divisors = integers_beside(h0)
        cut = random.randint(0, degree)
        # Two polynomials of smaller degree, in which all factors are left, or all but one; or any.
        e, f = fmpz_poly([1]), fmpz_poly([1])
        for factor in factors[:cut]:
            e *= factor
        for factor in factors[cut:]:
            f *= factor
        if max(e.degree(), f.degree()) == degree or random.random() < 0.3:
            e, f = _random(random, degree - 1, 3), _random(random, degree - 1, 3)
        rest = random.choice((0, 0, 1)) * _random(random, degree - 1, 2)
        at = [values_at(places, polynomial) for polynomial in (e, f, rest)]
        for scalar in (1, random.randint(-9, 9), 10**30):
            value = scalar * (at[0] * at[1]) - at[2] * at[2] + at[2]
            holds = vanishes(scalar * (e * f) - rest * rest + rest, h0)
            assert are_multiples([value], divisors) == [holds], (h0, e, f, rest, scalar)
            seen[holds] += 1
    assert min(seen.values()) > 200


CASES: dict[str, tuple[Any, Any]] = {
    "degree 1, where the values of h0 are units": (2 * ROOT + 1, fmpz_poly([1])),
    "degree 1, a value smaller than that of h0": (ROOT + 10, fmpz_poly([1])),
    "h0 divides all values: t^2 - t is even": (ROOT**2 - ROOT + 2, ROOT**2 - ROOT),
    "no remainder, and one quotient is another": (ROOT**2 + 1, 5 * ROOT * (ROOT + 1)),
    "a root that is no root of h0 as well": ((ROOT - 1) * (ROOT + 1), ROOT**2 - ROOT),
    "one factor is left": ((ROOT**2 - 2) * (ROOT**2 - 3), (ROOT**2 - 2) * ROOT**3),
}


@pytest.mark.parametrize("name", CASES)
def test_values_alone_do_not_deceive(name: str) -> None:
    h0, polynomial = CASES[name]
    assert polynomial.degree() <= 2 * h0.degree() - 2
    assert not _says_that_it_divides(h0, polynomial)
    assert _says_that_it_divides(h0, fmpz_poly([]))
    for power in range(int(h0.degree()) - 1):
        assert _says_that_it_divides(h0, h0 * ROOT**power)
        assert not _says_that_it_divides(h0, h0 * ROOT**power + polynomial)


@pytest.mark.parametrize("roots", [[0], [-1], [1], [-1, 0, 1], [-3, 1, 0, 7], [-6, 6, 17, 29, 39]])
def test_integers_are_beside_the_roots(roots: list[int]) -> None:
    h0 = fmpz_poly([1])
    for root in roots:
        h0 *= ROOT - root
    places, values = integers_beside(h0)
    assert not {*places} & {*roots}
    assert len(places) == 2 * len(roots) - 1
    assert values.listed == [h0(place) for place in places]


def test_values_are_a_ring() -> None:
    random = Random(1)
    places = range(-2, 5)
    for _ in range(50):
        f, g = (ROOT * (ROOT - 4) * (ROOT - 3) ** random.randint(0, 1) * _random(random, 2, 4) for _ in range(2))
        one, other = values_at(places, f), values_at(places, g)
        for found, expected in ((one + other, f + g), (one - other, f - g), (one * other, f * g), (-7 * one, -7 * f)):
            assert found == values_at(places, expected)
    assert Values(fmpz_poly([0, 5])).listed == [0, 5]
