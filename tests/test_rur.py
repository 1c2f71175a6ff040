"""Rational univariate representations modulo a prime: values at the roots, separation, multiplicities."""

from flint import nmod_mat, nmod_poly
from samples import images, katsura, system

from pkm_exact.algebra.quotient import QuotientAlgebra
from pkm_exact.algebra.rur import distinct_values, modular_representation, squarefree_part
from pkm_exact.algebra.system import PolynomialSystem


def _unknowns(polynomials: PolynomialSystem) -> tuple[QuotientAlgebra, list[nmod_mat]]:
    algebra = next(images(polynomials)).algebra
    assert algebra is not None
    return algebra, [algebra.element(([algebra.ring.unknown(i)], [1])) for i in range(algebra.ring.size)]


def test_coordinates_are_values_at_the_roots() -> None:
    algebra, (x, y) = _unknowns(system("x y", "(x - 1)*(x - 3)*(x - 5)", "8*y - (-13*x**2 + 60*x - 31)"))
    representation = modular_representation(algebra, x + 2 * y, [x, y])
    assert representation.degree == 3
    assert representation.is_simple
    shape = representation.shape()
    for point in ((1, 2), (3, 4), (5, -7)):
        t = point[0] + 2 * point[1]
        assert int(representation.eliminant(t)) == 0
        assert [int(coordinate(t)) for coordinate in shape] == [value % algebra.prime for value in point]
        numerators = [int(numerator(t) / representation.denominator(t)) for numerator in representation.numerators]
        assert numerators == [value % algebra.prime for value in point]


def test_a_form_that_does_not_separate_has_a_smaller_eliminant() -> None:
    algebra, (x, y) = _unknowns(system("x y", "x**2 - 1", "y**2 - 4"))
    assert [distinct_values(algebra, form) for form in (x, y, x + y, 2 * x + y)] == [2, 2, 4, 3]
    assert modular_representation(algebra, x, [x, y]).degree == 2


def test_multiplicities_leave_the_values_alone() -> None:
    algebra, (x, y) = _unknowns(system("x y", "x**2*(x - 1)", "y - 3*x + 1"))
    representation = modular_representation(algebra, x, [x, y])
    assert representation.degree == 2
    assert not representation.is_simple
    shape = representation.shape()
    for t in (0, 1):
        assert [int(coordinate(t)) for coordinate in shape] == [t, (3 * t - 1) % algebra.prime]
    # g_1 = 2 (T - 1) + 1 (T - 0): each root weighs with its multiplicity.
    assert representation.denominator == nmod_poly([-2, 3], algebra.prime)


def test_equal_multiplicities_count_as_simple() -> None:
    algebra, (x, y) = _unknowns(system("x y", "(x**2 - 2)**2", "y - x**3"))
    representation = modular_representation(algebra, x, [x, y])
    assert representation.degree == 2
    assert representation.is_simple


def test_the_representation_satisfies_the_system() -> None:
    polynomials = katsura(3)
    algebra, unknowns = _unknowns(polynomials)
    representation = modular_representation(algebra, unknowns[0] + 3 * unknowns[1], unknowns)
    shape, h = representation.shape(), representation.eliminant
    assert representation.degree == 8
    for polynomial in polynomials.polynomials:
        total = nmod_poly([0], algebra.prime)
        for exponents, coefficient in polynomial.to_dict().items():
            term = nmod_poly([int(coefficient) % algebra.prime], algebra.prime)
            for value, exponent in zip(shape, exponents, strict=True):
                for _ in range(int(exponent)):
                    term = term * value % h
            total += term
        assert total == 0


def test_the_squarefree_part_keeps_each_root_once() -> None:
    t = nmod_poly([0, 1], 101)
    assert squarefree_part(7 * t**3 * (t - 1) ** 2 * (t - 2)) == t * (t - 1) * (t - 2)
