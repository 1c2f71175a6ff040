"""Systems of any kind are lifted to Q: both ways give the same representation, and it satisfies the system."""

from collections.abc import Sequence
from dataclasses import dataclass

import pytest
from flint import nmod_poly
from samples import images, katsura, random_quadrics, shipped, solved, system

from pkm_exact.algebra.equations import SystemEquations
from pkm_exact.algebra.lifting import lift_by_newton, lift_by_primes
from pkm_exact.algebra.modular_elimination import Elimination
from pkm_exact.algebra.representation import UnivariateRepresentation, are_coprime
from pkm_exact.algebra.rur import ModularRepresentation, modular_representation
from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.algebra.vanishing import satisfies
from pkm_exact.errors import ReconstructionError
from pkm_exact.policy import Policy
from pkm_exact.poses.study_equations import StudyEquations

CASES = {
    "circle and hyperbola": (system("x y", "x**2 + y**2 - 5", "3*x*y - 7"), (1, 2)),
    "two conics": (random_quadrics(2, 11), (1, 3)),
    "three quadrics": (random_quadrics(3, 12, size=99), (2, -1, 5)),
    "katsura-3": (katsura(3), (1, 2, 3, 5)),
    "rational points": (system("x y", "(3*x - 1)*(5*x + 7)", "y - x**2"), (1, 1)),
    "one point": (system("x y", "3*x - 1", "7*y + 11*x - 2"), (1, 1)),
}


def _modular(image: object, form: tuple[int, ...]) -> ModularRepresentation:
    algebra = image.algebra  # type: ignore[attr-defined]
    unknowns = [algebra.element(([algebra.ring.unknown(i)], [1])) for i in range(algebra.ring.size)]
    combined = unknowns[0] * form[0]
    for scalar, unknown in zip(form[1:], unknowns[1:], strict=True):
        combined += unknown * scalar
    return modular_representation(algebra, combined, unknowns)


def _by_newton(polynomials: PolynomialSystem, form: tuple[int, ...], seed: int = 1) -> UnivariateRepresentation:
    image = Elimination(polynomials, Policy()).image()
    return lift_by_newton(SystemEquations(polynomials, seed), form, _modular(image, form), 1 << 16)


def _by_primes(polynomials: PolynomialSystem, form: tuple[int, ...]) -> UnivariateRepresentation:
    return lift_by_primes(form, (_modular(image, form) for image in images(polynomials)), 1 << 16)


@pytest.mark.parametrize("case", CASES)
def test_both_ways_agree_and_satisfy_the_system(case: str) -> None:
    polynomials, form = CASES[case]
    representation = _by_newton(polynomials, form)
    assert representation == _by_primes(polynomials, form)
    assert representation.eliminant[-1] > 0
    assert representation.is_squarefree
    assert representation.is_separated
    assert satisfies(representation, polynomials)


def test_the_combination_of_equations_does_not_matter() -> None:
    polynomials, form = CASES["three quadrics"]
    assert _by_newton(polynomials, form, seed=1) == _by_newton(polynomials, form, seed=2)


def test_the_prime_does_not_matter() -> None:
    polynomials, form = CASES["katsura-3"]
    image = Elimination(polynomials, Policy(prime_bits=31)).image()
    small = lift_by_newton(SystemEquations(polynomials, 1), form, _modular(image, form), 1 << 16)
    assert small == _by_newton(polynomials, form)


def test_multiple_solutions_are_lifted_by_primes() -> None:
    polynomials = system("x y", "(2*x - 1)**2*(x**2 - 3)", "5*y - x**3 + 1")
    representation = _by_primes(polynomials, (1, 1))
    assert representation.degree == 3
    assert representation.is_separated
    assert satisfies(representation, polynomials)


def test_too_little_precision_is_an_error() -> None:
    polynomials, form = CASES["three quadrics"]
    image = Elimination(polynomials, Policy()).image()
    with pytest.raises(ReconstructionError, match="within 70 bits"):
        lift_by_newton(SystemEquations(polynomials, 1), form, _modular(image, form), 70)
    with pytest.raises(ReconstructionError, match="within 60 bits"):
        lift_by_primes(form, (_modular(image, form) for image in images(polynomials)), 60)


def test_a_wrong_coefficient_is_noticed() -> None:
    polynomials, form = CASES["two conics"]
    right = _by_newton(polynomials, form)
    for index in range(2):
        numerators = [list(numerator) for numerator in right.numerators]
        numerators[index][0] += 1
        wrong = UnivariateRepresentation(right.form, right.eliminant, tuple(map(tuple, numerators)))
        assert not satisfies(wrong, polynomials)
        assert not wrong.is_separated
    moved = UnivariateRepresentation(right.form, (right.eliminant[0] + 1, *right.eliminant[1:]), right.numerators)
    assert not satisfies(moved, polynomials)


def test_squares_are_not_squarefree() -> None:
    double = UnivariateRepresentation((1,), (4, -4, 1), ((0,),))
    assert not double.is_squarefree
    assert not are_coprime(double.polynomial, double.polynomial.derivative())


@dataclass(frozen=True)
class Graph:
    """z = x^2 / 7 - y, of which there is nothing but squares of numerators; or no answer at all."""

    known: int
    answers: bool

    def modulo(self, eliminant: nmod_poly, numerators: Sequence[nmod_poly]) -> list[nmod_poly] | None:
        if not self.answers:
            return None
        x, y = numerators
        prime = int(eliminant.modulus())
        inverse = eliminant.derivative().xgcd(eliminant)[1]
        return [(x * x * inverse * pow(7, -1, prime) - y) % eliminant]


@dataclass(frozen=True)
class CompletedEquations(SystemEquations):
    """Equations of which the last coordinate follows from the first two."""

    answers: bool = True

    def completion(self, form: Sequence[int]) -> Graph:  # type: ignore[override]
        assert form[2] == 0
        return Graph(2, self.answers)


@pytest.mark.parametrize("answers", [True, False])
def test_a_completion_gives_what_lifting_gives(answers: bool) -> None:
    polynomials = system("x y z", "x**3 + 5*y**2 - 13*x + 2", "x*y - 97*y + 31", "7*z - x**2 + 7*y")
    form = (1, 2, 0)
    modular = _modular(Elimination(polynomials, Policy()).image(), form)
    expected = lift_by_newton(SystemEquations(polynomials, 1), form, modular, 1 << 16)
    assert satisfies(expected, polynomials)
    assert lift_by_newton(CompletedEquations(polynomials, 1, answers), form, modular, 1 << 16) == expected


@pytest.mark.parametrize("name", ["rolland-6-6", "mssm", "3-rpr-merlet-p", "ssm-exact"])
def test_translations_follow_from_rotations(name: str) -> None:
    found = solved(name).representation
    assert found is not None
    problem, univariate = shipped(name), found.univariate
    equations = StudyEquations(problem, found.chart, seed=3)
    form = [univariate.form[k] for k in equations.free]
    translation = equations.completion(form)
    assert translation is not None
    assert translation.known == sum(k < 4 for k in equations.free)
    prime = 2**61 - 1
    h = nmod_poly(univariate.polynomial, prime)
    scale = pow(int(h.leading_coefficient()), -1, prime)
    numerators = [nmod_poly(univariate.numerator_polynomials[k], prime) * scale for k in equations.free]
    assert translation.modulo(h * scale, numerators[: translation.known]) == numerators[translation.known :]


def test_a_form_in_the_translation_leaves_nothing_to_follow() -> None:
    equations = StudyEquations(shipped("rolland-6-6"), (1, 0, 0, 0), seed=1)
    assert equations.completion((0, 0, 1, 0, 0, 0, 0)) is not None
    assert equations.completion((0, 0, 1, 0, 0, 5, 0)) is None
