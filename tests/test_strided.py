"""Polynomials in T^m: products, divisibility, and representations of symmetric systems, right and wrong ones."""

import random
from fractions import Fraction

import pytest
from flint import fmpq_poly, fmpz_poly

from pkm_exact import solve_system
from pkm_exact.algebra.representation import UnivariateRepresentation
from pkm_exact.algebra.strided import Strided, stride, strided
from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring
from pkm_exact.algebra.vanishing import satisfies
from pkm_exact.systems.system_sources import parse_system

CYCLIC_3 = "x,y,z\n0\nx+y+z,x*y+y*z+z*x,x*y*z-1\n"
"""Invariant if all are multiplied by a cubic root of 1."""
EVEN = "x,y\n0\nx^4+3*x^2*y^2-y^4-5,x^3*y+2*x^2-7\n"
MIXED = "x,y\n0\nx^5+x^4*y-x^2+3,y-x^2-x\n"
DENSE = "x,y\n0\nx^3*y^2+2*x^2*y^3-x*y^4+x^2*y^2+x-y+1,x^2+x*y+y-4\n"


def _whole(value: Strided) -> fmpz_poly:
    spread = (
        fmpz_poly([entry for c in part.coeffs() for entry in (c, *[0] * (value.step - 1))]).left_shift(place)
        for place, part in value.parts.items()
    )
    return sum(spread, fmpz_poly())


@pytest.mark.parametrize("step", [1, 2, 3, 7])
def test_arithmetic_is_that_of_polynomials(step: int) -> None:
    numbers = random.Random(step)
    for _ in range(20):
        a, b = (fmpz_poly([numbers.randint(-4, 4) * numbers.randint(0, 1) for _ in range(9)]) for _ in range(2))
        left, right = strided(a, step), strided(b, step)
        assert _whole(left) == a
        assert _whole(left * right) == a * b
        assert _whole(left + right) == a + b
        assert _whole(-3 * left + 0 * right) == -3 * a
        assert _whole(left**5) == a**5
        modulus = fmpz_poly([3, -1, 2])
        spread = _whole(strided(modulus, 1)) if step == 1 else modulus(fmpz_poly([*[0] * step, 1]))
        assert (left * strided(spread, step)).is_multiple(modulus)
        assert left.is_multiple(modulus) == (not divmod(fmpq_poly(a), fmpq_poly(spread))[1])


@pytest.mark.parametrize(("text", "step"), [(CYCLIC_3, 3), (EVEN, 2), (MIXED, 1), (DENSE, 1)])
def test_what_is_changed_anywhere_is_no_list_of_solutions(text: str, step: int) -> None:
    system = parse_system(text)
    found = solve_system(system).representation
    assert found is not None
    assert stride(found.primitive_polynomial) == step
    assert satisfies(found, system)
    for i, numerator in enumerate(found.numerators):
        for place in range(found.degree):
            changed = [*numerator, *[0] * (found.degree - len(numerator))]
            changed[place] += 1
            numerators = (*found.numerators[:i], tuple(changed), *found.numerators[i + 1 :])
            other = UnivariateRepresentation(found.form, found.eliminant, numerators)
            assert satisfies(other, system) == _by_residues(other, system)
            assert not satisfies(other, system)


def _by_residues(found: UnivariateRepresentation, system: PolynomialSystem) -> bool:
    """The same, by arithmetic over Q modulo the eliminant."""
    modulus = fmpq_poly(list(found.eliminant))
    inverse = modulus.derivative().xgcd(modulus)[1]
    at = [fmpq_poly(list(numerator)) * inverse % modulus for numerator in found.numerators]
    for polynomial in system.polynomials:
        total = fmpq_poly()
        for exponents, coefficient in polynomial.to_dict().items():
            term = fmpq_poly([int(coefficient)])
            for value, exponent in zip(at, exponents, strict=True):
                term = term * value ** int(exponent) % modulus
            total += term
        if total:
            return False
    return True


def test_terms_of_high_degree_are_factored() -> None:
    """Random polynomials, one of which vanishes where it is made to."""
    x, y, z = polynomial_ring(("x", "y", "z")).gens()
    found = UnivariateRepresentation((1, 0, 0), (-6, 11, -6, 1), ((18, -22, 6), (3, -6, 2), (5, 0, 7)))
    numbers = random.Random(3)
    for _ in range(20):
        F = sum(numbers.randint(-2, 2) * x**a * y**b * z**c for a in range(3) for b in range(3) for c in range(3))
        system = PolynomialSystem(("x", "y", "z"), (F + numbers.randint(5, 9),))
        assert satisfies(found, system) == _by_residues(found, system)
        roots = [
            [
                Fraction(sum(n * t**k for k, n in enumerate(numerator)), 3 * t**2 - 12 * t + 11)
                for numerator in found.numerators
            ]
            for t in (1, 2, 3)
        ]
        product = 4 + 0 * x
        for point in roots:
            product = product * (x - int(point[0]))
        system = PolynomialSystem(("x", "y", "z"), (F * product,))
        assert satisfies(found, system)
