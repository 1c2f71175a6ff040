"""p-adic lifting keeps three promises at every precision: the equations hold, and the form keeps the value T."""

from itertools import pairwise
from random import Random

import pytest
from flint import Ordering, fmpz_mpoly_ctx
from samples import images, katsura, random_quadrics, system

from pkm_exact.algebra.equations import PointProducts, SystemEquations
from pkm_exact.algebra.groebner import UnluckyPrimeError
from pkm_exact.algebra.newton import is_regular, lift, precision_schedule
from pkm_exact.algebra.residue_ring import ResidueRing, combination
from pkm_exact.algebra.rur import ModularRepresentation, modular_representation
from pkm_exact.algebra.system import PolynomialSystem


def _modular(polynomials: PolynomialSystem, form: tuple[int, ...]) -> ModularRepresentation:
    algebra = next(images(polynomials)).algebra
    assert algebra is not None
    unknowns = [algebra.element(([algebra.ring.unknown(i)], [1])) for i in range(algebra.ring.size)]
    combined = unknowns[0] * form[0]
    for scalar, unknown in zip(form[1:], unknowns[1:], strict=True):
        combined += unknown * scalar
    representation = modular_representation(algebra, combined, unknowns)
    assert representation.degree == algebra.dimension
    return representation


CASES = [
    (random_quadrics(2, 3), (1, 0)),
    (random_quadrics(2, 3), (2, -5)),
    (random_quadrics(3, 5), (3, 1, -2)),
    (katsura(3), (1, 2, -3, 4)),
    (katsura(3), (0, 1, 0, 7)),
    (system("x y", "3*x - 1", "7*y + 11*x - 2"), (1, 1)),
]


@pytest.mark.parametrize(("polynomials", "form"), CASES, ids=range(len(CASES)))
def test_equations_and_form_hold_at_every_precision(polynomials: PolynomialSystem, form: tuple[int, ...]) -> None:
    modular = _modular(polynomials, form)
    equations = SystemEquations(polynomials, seed=1)
    exponents = [exponent for exponent, _ in precision_schedule(30)]
    steps = list(lift(equations, form, modular.eliminant, modular.shape(), 30))
    prime = int(modular.eliminant.modulus())
    assert [step.modulus for step in steps] == [prime**exponent for exponent in exponents]
    for step in steps:
        ring = ResidueRing(step.modulus, step.eliminant)
        point = [ring.convert(coordinate) for coordinate in step.coordinates]
        assert step.eliminant[-1] == 1
        assert ring.reduce(combination(form, point)) == ring.reduce(ring.convert((0, 1)))
        values = equations.values(ring, step.point)
        assert not any(ring.reduce(ring.polynomials(value)) for value in values)


@pytest.mark.parametrize(("polynomials", "form"), CASES, ids=range(len(CASES)))
def test_each_step_lifts_the_one_before(polynomials: PolynomialSystem, form: tuple[int, ...]) -> None:
    modular = _modular(polynomials, form)
    steps = list(lift(SystemEquations(polynomials, seed=2), form, modular.eliminant, modular.shape(), 30))
    for coarse, fine in pairwise(steps):
        assert tuple(value % coarse.modulus for value in fine.eliminant) == coarse.eliminant
        for old, new in zip(coarse.coordinates, fine.coordinates, strict=True):
            width = max(len(old), len(new))
            padded = [[*values, *[0] * (width - len(values))] for values in (old, new)]
            assert [value % coarse.modulus for value in padded[1]] == padded[0]


def test_every_step_has_the_precision_that_it_needs() -> None:
    reached, previous = 1, 1
    for target, factored in precision_schedule(5000):
        assert previous <= factored <= reached < target <= reached + factored
        reached, previous = target, factored
    assert reached > 3500


def test_a_multiple_solution_is_not_lifted() -> None:
    # (x - y)^2 = 0 on the circle: two double points, of equal multiplicity.
    polynomials = system("x y", "(x - y)**2", "x**2 + y**2 - 3")
    algebra = next(images(polynomials)).algebra
    assert algebra is not None
    unknowns = [algebra.element(([algebra.ring.unknown(i)], [1])) for i in range(2)]
    modular = modular_representation(algebra, unknowns[0], unknowns)
    assert modular.is_simple
    equations = SystemEquations(polynomials, seed=3)
    assert not is_regular(equations, modular.eliminant, modular.shape())
    with pytest.raises(UnluckyPrimeError, match="not a unit"):
        next(lift(equations, (1, 0), modular.eliminant, modular.shape(), 4))


def test_simple_solutions_are_regular() -> None:
    modular = _modular(katsura(3), (1, 2, -3, 4))
    assert is_regular(SystemEquations(katsura(3), seed=4), modular.eliminant, modular.shape())


def test_reductions_by_products_are_remainders() -> None:
    """Long numbers, every length up to three times the degree."""
    random = Random(5)
    for degree, bits in ((12, 12000), (13, 11000), (44, 3100)):
        modulus = random.getrandbits(bits) | 1 << bits - 1 | 1
        ring = ResidueRing(modulus, (*(random.randrange(modulus) for _ in range(degree)), 1))
        for length in (degree - 1, degree, degree + 1, 2 * degree - 2, 2 * degree - 1, 2 * degree, 3 * degree):
            value = ring.convert([*(random.choice((0, random.randrange(modulus))) for _ in range(length)), 1])
            assert ring.reduce(value) == value % ring.relation


def test_values_summed_over_the_integers_are_values() -> None:
    x, y = fmpz_mpoly_ctx.get(("x", "y"), Ordering.degrevlex).gens()
    ring = ResidueRing((2**61 - 1) ** 2, (3, 0, 7, 1))
    point = [ring.convert([1, 2, 3]), ring.convert([5, 0, 1])]
    for polynomial in (x**5 * y**2 - 3 * x * y + 7, x - y, x**0 * 4, x - x):
        products = PointProducts(ring, point)
        assert products.value(polynomial) == ring.reduce(products.evaluate(polynomial))
