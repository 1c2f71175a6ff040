"""Eliminations cut down to what wanted elements need, and the dimensions that an elimination of forms bounds."""

from __future__ import annotations

import pytest
from public_systems import public_systems

from pkm_exact.algebra.exact_basis import exact_basis
from pkm_exact.algebra.graded_algebra import graded_dimensions
from pkm_exact.algebra.groebner import GroebnerBasis, learn
from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.systems.shortened_elimination import shortened, with_basis_only, with_falls_only
from pkm_exact.systems.system_sources import read_system

PRIME = (1 << 61) - 1


def system(name: str) -> PolynomialSystem:
    return read_system(str(public_systems()[name].path))


def recorded(given: PolynomialSystem) -> GroebnerBasis:
    return learn(given.modulo(PRIME), given.monomials, PRIME, degree_limit=40)


@pytest.mark.parametrize("name", ["eco-5", "boon", "sendra", "griewank-osborne"])
def test_elements_of_the_basis_stay_and_rows_go(name: str) -> None:
    given = system(name)
    basis = recorded(given)
    assert basis.trace is not None
    whole, short = exact_basis(given, basis.trace), exact_basis(given, with_basis_only(basis))
    assert {whole.elements[index] for index in basis.trace.basis} <= set(short.elements)
    assert sum(map(len, short.steps)) <= sum(map(len, whole.steps))


def test_falling_elements_stay_with_fewer_rows() -> None:
    given = system("eco-6")
    basis = recorded(given)
    assert basis.trace is not None
    whole, short = exact_basis(given, basis.trace), exact_basis(given, with_falls_only(basis))
    falling = set()
    elements = list(whole.elements[: len(basis.trace.start)])
    for step in basis.trace.steps:
        degree = max(given.monomials.degree(elements[index][0][0] + monomial) for index, monomial in step.rows)
        new = whole.elements[len(elements) : len(elements) + len(step.new)]
        falling |= {element for element in new if given.monomials.degree(element[0][0]) < degree}
        elements += new
    assert falling
    assert falling <= set(short.elements)
    assert sum(map(len, short.steps)) < sum(map(len, whole.steps))


def test_nothing_wanted_leaves_the_generators() -> None:
    assert shortened(recorded(system("eco-5")), ()).steps == ()


def test_an_elimination_that_was_not_recorded_is_an_error() -> None:
    given = system("eco-5")
    basis = learn(given.modulo(PRIME), given.monomials, PRIME, degree_limit=40, record=False)
    with pytest.raises(ValueError, match="not recorded"):
        with_basis_only(basis)


def test_dimensions_of_graded_algebras() -> None:
    """General forms of degrees 2, 3, 4, what forms of one variable less leave, and limits."""
    powers = [{(2, 0, 0): 1, (0, 1, 1): 3}, {(0, 3, 0): 1, (1, 1, 1): 5}, {(0, 0, 4): 1, (2, 1, 1): 7}]
    assert graded_dimensions(3, powers, PRIME, 7, 24) == (1, 3, 5, 6, 5, 3, 1)
    assert graded_dimensions(3, powers, PRIME, 6, 24) is None
    assert graded_dimensions(3, powers, PRIME, 7, 23) is None
    assert graded_dimensions(3, powers[:2], PRIME, 7, 24) is None
    assert graded_dimensions(3, [*powers, {(0, 0, 0): 2}], PRIME, 7, 24) == ()
    assert graded_dimensions(2, [{(1, 1): 1}, {(2, 1): 1}], PRIME, 9, 99) is None
