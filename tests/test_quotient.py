"""Quotient algebras: multiplication matrices commute, satisfy the system, and have the traces of the solutions."""

import pytest
from flint import nmod_mat
from samples import cyclic, katsura, random_quadrics, system

from pkm_exact.algebra.groebner import OutOfReachError, learn
from pkm_exact.algebra.primes import primes_from
from pkm_exact.algebra.quotient import QuotientAlgebra, quotient_algebra
from pkm_exact.algebra.system import PolynomialSystem, modular_image

PRIME = next(primes_from(1, 62))

# The points (1, 2), (3, 4), (5, -7): y is the interpolation polynomial in x.
POINTS = system("x y", "(x - 1)*(x - 3)*(x - 5)", "8*y - (-13*x**2 + 60*x - 31)")


def _algebra(polynomials: PolynomialSystem, limit: int = 100) -> QuotientAlgebra:
    basis = learn(polynomials.modulo(PRIME), polynomials.monomials, PRIME, degree_limit=30)
    return quotient_algebra(basis, limit)


def _element(algebra: QuotientAlgebra, polynomials: PolynomialSystem, index: int) -> nmod_mat:
    return algebra.element(modular_image(polynomials.polynomials[index], polynomials.monomials, PRIME))


SYSTEMS = [POINTS, katsura(3), cyclic(5), random_quadrics(3, 2), system("x y", "x**3", "x*y", "y**2 - x**2")]


@pytest.mark.parametrize("polynomials", SYSTEMS, ids=["points", "katsura-3", "cyclic-5", "quadrics-3", "fat point"])
def test_unknowns_commute_and_satisfy_the_system(polynomials: PolynomialSystem) -> None:
    algebra = _algebra(polynomials)
    for left in algebra.unknowns:
        for right in algebra.unknowns:
            assert left * right == right * left
    for index in range(len(polynomials.polynomials)):
        assert not any(int(value) for value in _element(algebra, polynomials, index).entries())


@pytest.mark.parametrize("polynomials", SYSTEMS, ids=["points", "katsura-3", "cyclic-5", "quadrics-3", "fat point"])
def test_the_normal_set_is_its_own_basis(polynomials: PolynomialSystem) -> None:
    algebra = _algebra(polynomials)
    assert algebra.normal_set[0] == 0
    for index, monomial in enumerate(algebra.normal_set):
        row = algebra.element(([monomial], [1]))
        assert [int(value) for value in row.entries()] == [int(index == k) for k in range(algebra.dimension)]
        assert algebra.matrix(row) == algebra.basis_matrices[index]


def test_traces_are_sums_over_the_solutions() -> None:
    algebra = _algebra(POINTS)
    x, y = (algebra.element(([POINTS.monomials.unknown(index)], [1])) for index in (0, 1))
    assert int((algebra.one * algebra.trace)[0, 0]) == 3
    assert int((x * algebra.trace)[0, 0]) == 1 + 3 + 5
    assert int((y * algebra.trace)[0, 0]) == (2 + 4 - 7) % PRIME
    assert int((x * algebra.matrix(y) * algebra.trace)[0, 0]) == (2 + 12 - 35) % PRIME


def test_a_multiple_point_counts_with_its_multiplicity() -> None:
    algebra = _algebra(system("x y", "x**2*(x - 1)", "y - 3*x + 1"))
    y = algebra.element(([algebra.ring.unknown(1)], [1]))
    assert algebra.dimension == 3
    assert int((y * algebra.trace)[0, 0]) == (-1 - 1 + 2) % PRIME


def test_too_many_solutions_are_out_of_reach() -> None:
    with pytest.raises(OutOfReachError, match="more than 10 solutions"):
        _algebra(katsura(4), limit=10)
