"""Data that are built on primes: the answer stays what it is, whatever is special about them modulo some primes."""

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import islice
from pathlib import Path
from typing import Any

import pytest
from flint import nmod_poly
from hypothesis import given, settings
from hypothesis import strategies as st
from samples import shipped, system

from pkm_exact import Robot, engine
from pkm_exact.algebra import primes
from pkm_exact.algebra.exact_basis import exact_basis
from pkm_exact.algebra.groebner import OutOfReachError, UnluckyPrimeError, learn
from pkm_exact.algebra.lifting import lift_by_primes
from pkm_exact.algebra.modular_elimination import Elimination
from pkm_exact.algebra.primes import primes_from
from pkm_exact.algebra.rur import ModularRepresentation
from pkm_exact.claim import Claim
from pkm_exact.constraints.distance import Distance
from pkm_exact.engine import solve
from pkm_exact.formulations.motion_variety import SE3
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion_groups import PLANAR
from pkm_exact.policy import Policy
from pkm_exact.solution import Solution

CASES = Path(__file__).parent / "cases"
UNLUCKY = {bits: next(primes_from(2, bits)) for bits in (24, 62)}
"""Primes that the robots below are built on, by their size. Short ones make short numbers."""

Patch = pytest.MonkeyPatch
Numbers = tuple[int, ...]
"""Of a planar robot: base joints, platform joints (two numbers each), squared lengths."""


def planar(numbers: list[Fraction] | Numbers) -> ForwardProblem:
    """The robot with these numbers."""
    x = [Fraction(value) for value in numbers]
    zero = Fraction(0)
    legs = [Distance((x[k], x[k + 1], zero), (x[k + 6], x[k + 7], zero), x[12 + k // 2]) for k in (0, 2, 4)]
    return ForwardProblem(tuple(legs), motion=PLANAR)


SPECIAL: dict[str, Numbers] = {
    "base and platform congruent, legs equal": (0, 0, 10, 0, 3, 10, 0, 0, 10, 0, 3, 10, 25, 25, 25),
    "two base joints coincide": (0, 0, 0, 0, 3, 10, 0, 0, 4, 0, 2, 2, 50, 26, 25),
    "base joints in one point": (1, 2, 1, 2, 1, 2, 0, 0, 4, 0, 2, 2, 9, 11, 13),
    "no pose, not even a complex one": (1, 2, 1, 2, 1, 2, 3, 4, 3, 4, 3, 4, 9, 11, 13),
    "all joints on lines": (0, 0, 4, 0, 9, 0, 0, 0, 3, 0, 5, 0, 9, 16, 25),
    "a double pose": (0, 0, 10, 0, 3, 10, 0, 0, 4, 0, 2, 2, 25, 61, 34),
    "everything is 0": (0,) * 15,
}


def special_modulo(prime: int, name: str, changes: Numbers) -> ForwardProblem:
    """A robot that is the special one modulo a prime, and about the special one plus the changes."""
    unit = Fraction(prime, 2 ** prime.bit_length())
    return planar([value + change * unit for value, change in zip(SPECIAL[name], changes, strict=True)])


def chosen_first(patch: Patch, *numbers: int | None) -> None:
    """The first primes of every choice, whatever it is for; None where the usual one is to be taken."""
    usual = primes.drawn

    def drawn(seed: int, number: int, bits: int) -> int:
        forced = numbers[number] if number < len(numbers) else None
        return usual(seed, number, bits) if forced is None or forced.bit_length() != bits else forced

    patch.setattr(primes, "drawn", drawn)


def first_primes(problem: ForwardProblem) -> Iterator[int]:
    """The primes at which a solve eliminates, first to last: anybody can compute them."""
    return primes_from(Policy().seed_for(SE3().formulate(problem).system.digest), Policy().prime_bits)


def answer(solution: Solution) -> tuple[Any, ...]:
    """All that is said, but for how it was found: at an unlucky prime a chart may seem to miss a pose."""
    proof = solution.completeness
    counts = solution.complex_solutions, solution.distinct_solutions
    total = None if proof is None else (proof.route, proof.total)
    poses = [(pose.position, pose.rotation, pose.multiplicity, pose.jacobian) for pose in solution.poses]
    return solution.claim, *counts, poses, solution.notes, total


def test_primes_are_of_their_size_and_each_comes_once() -> None:
    found = list(islice(primes_from(7, 62), 50))
    assert len(set(found)) == 50
    assert {prime.bit_length() for prime in found} == {62}
    assert found == list(islice(primes_from(7, 62), 50))
    assert not set(found) & set(islice(primes_from(8, 62), 50))


@pytest.mark.parametrize("place", range(15))
def test_every_number_of_a_robot_changes_its_primes(place: int) -> None:
    numbers = [Fraction(value) for value in SPECIAL["a double pose"]]
    before = planar(numbers)
    numbers[place] += Fraction(1, 10**60)
    after = planar(numbers)
    assert before.digest != after.digest
    assert next(first_primes(before)) != next(first_primes(after))


@pytest.mark.parametrize(
    ("name", "solutions", "real"), [("unlucky-prime", 6, 2), ("congruent-modulo-two-primes", 4, 4)]
)
def test_numbers_built_on_primes_that_were_once_fixed(name: str, solutions: int, real: int) -> None:
    robot = Robot.load(CASES / f"{name}.toml")
    solution = solve(robot.problem(robot.configuration()))
    assert (solution.claim, solution.complex_solutions, len(solution)) == (Claim.COMPLETE, solutions, real)


@settings(max_examples=12)
@given(
    st.sampled_from(sorted(SPECIAL)),
    st.lists(st.integers(-3, 3), min_size=15, max_size=15).filter(any).map(tuple),
    st.integers(0, 2),
)
def test_an_unlucky_prime_changes_no_answer(name: str, changes: Numbers, place: int) -> None:
    problem, policy = special_modulo(UNLUCKY[24], name, changes), Policy(prime_bits=24)
    expected = solve(problem, policy=policy)
    with Patch.context() as patch:
        chosen_first(patch, *[None] * place, UNLUCKY[24])
        assert answer(solve(problem, policy=policy)) == answer(expected)


@pytest.mark.parametrize("lifting", ["newton", "multimodular"])
@pytest.mark.parametrize(
    "name", ["base and platform congruent, legs equal", "base joints in one point", "everything is 0"]
)
def test_an_unlucky_prime_is_tried_and_left(name: str, lifting: str, monkeypatch: Patch) -> None:
    changes = (1, 0, 0, 2, 0, 0, 0, -1, 0, 1, 0, 0, 1, 0, 0)
    problem, policy = special_modulo(UNLUCKY[62], name, changes), Policy(lifting=lifting)
    expected = solve(problem, policy=policy)
    chosen_first(monkeypatch, UNLUCKY[62])
    found = solve(problem, policy=policy)
    assert UNLUCKY[62] in found.statistics.primes
    assert answer(found) == answer(expected)


@pytest.mark.parametrize("place", range(12))
def test_a_coordinate_that_is_a_prime_or_has_one_below_is_no_obstacle(place: int, monkeypatch: Patch) -> None:
    numbers = [Fraction(value) for value in SPECIAL["a double pose"]]
    for change in (Fraction(UNLUCKY[24], 10**7), Fraction(10**7, UNLUCKY[24])):
        problem = planar([*numbers[:place], change, *numbers[place + 1 :]])
        with Patch.context() as patch:
            expected = solve(problem)
            chosen_first(patch, UNLUCKY[24])
            assert answer(solve(problem, policy=Policy(prime_bits=24))) == answer(expected)


@settings(max_examples=4)
@given(st.sampled_from(sorted(SPECIAL)), st.integers(0, 14), st.integers(1, 3))
def test_who_builds_on_the_primes_of_a_robot_gets_a_robot_of_other_primes(name: str, place: int, tries: int) -> None:
    numbers = [Fraction(value) for value in SPECIAL[name]]
    used: set[int] = set()
    for _ in range(tries):
        used.update(islice(first_primes(planar(numbers)), 12))
        numbers[place] = Fraction(next(first_primes(planar(numbers))), 2**62)
    problem = planar(numbers)
    found, other = solve(problem), solve(problem, policy=Policy(seed=1))
    assert not used & {*islice(first_primes(problem), 12), *found.statistics.primes, *other.statistics.primes}
    assert (found.claim, found.complex_solutions) == (other.claim, other.complex_solutions)
    assert [pose.position for pose in found.poses] == [pose.position for pose in other.poses]


def test_a_later_prime_at_which_there_is_no_pose_is_passed_over(monkeypatch: Patch) -> None:
    numbers = [Fraction(value) for value in SPECIAL["a double pose"]]
    numbers[3] = Fraction(10**7, UNLUCKY[24])
    problem, policy = planar(numbers), Policy(prime_bits=24, lifting="multimodular")
    expected = solve(problem, policy=policy)
    chosen_first(monkeypatch, None, UNLUCKY[24])
    found = solve(problem, policy=policy)
    assert UNLUCKY[24] in found.statistics.primes
    assert answer(found) == answer(expected)


def test_a_trace_that_no_other_prime_follows_is_recorded_anew(monkeypatch: Patch) -> None:
    # y f - x g = 101 y^2 - 5 x y, which begins with x y modulo 101 only.
    polynomials = system("x y", "x**2 + 101*y", "x*y + 5*y")
    chosen_first(monkeypatch, 101)
    elimination = Elimination(polynomials, Policy(prime_bits=7, attempts=3))
    found = [elimination.following().dimension for _ in range(4)]
    assert elimination.primes_used[0] == 101
    assert len(elimination.primes_unlucky) == 3
    assert found[1:] == [3, 3, 3]


def test_primes_of_a_size_that_are_used_up_are_said_to_be() -> None:
    elimination = Elimination(system("x", "x - 1"), Policy(prime_bits=3))
    assert {elimination.image().prime for _ in range(2)} == {5, 7}
    with pytest.raises(OutOfReachError, match="no further prime of 3 bits"):
        elimination.image()


def test_an_elimination_that_differs_over_the_rationals_is_left() -> None:
    polynomials = system("x y", "x**2 + 101*y", "x*y + 5*y")
    trace = learn(polynomials.modulo(101), polynomials.monomials, 101, degree_limit=10).trace
    assert trace is not None
    with pytest.raises(UnluckyPrimeError, match="over Q other leading monomials"):
        exact_basis(polynomials, trace)


def test_multiplicities_that_are_none_are_the_fault_of_a_prime() -> None:
    eliminant = nmod_poly([-1, 0, 1], 101)
    modular = ModularRepresentation(eliminant, 3 * eliminant.derivative(), ())
    assert {count: part.degree for count, part in modular.parts().items()} == {3: 2}
    with pytest.raises(UnluckyPrimeError, match="multiples of 2"):
        modular.parts(2)


def test_more_solutions_than_at_other_primes_are_the_fault_of_a_prime() -> None:
    def images() -> Iterator[ModularRepresentation]:
        for number, prime in enumerate(primes_from(3, 62)):
            eliminant = nmod_poly([-2, 0, 1] if number == 0 else [-2, 1], prime)
            yield ModularRepresentation(eliminant, eliminant.derivative(), (nmod_poly([2], prime),))

    with pytest.raises(UnluckyPrimeError, match="2 solutions at few primes only"):
        lift_by_primes((1,), images(), 1 << 16)


def test_further_legs_that_contradict_the_robot_are_drawn_again(monkeypatch: Patch) -> None:
    seed = Policy().seed
    problem = planar((*SPECIAL["base joints in one point"][:12], 9, 1, 5))
    usual, seeds = engine.extended_problem, []

    def extended(given: ForwardProblem, count: int, own: int) -> ForwardProblem:
        seeds.append(own)
        if own != seed:
            return usual(given, count, own)
        first = given.distances[0]
        return replace(given, constraints=(*given.constraints, replace(first, length_squared=first.length_squared + 1)))

    monkeypatch.setattr(engine, "extended_problem", extended)
    assert solve(problem).claim == Claim.POSITIVE_DIMENSIONAL_PROVED
    assert seeds == [seed, Policy().seed_for(problem.digest, "further legs")]


@pytest.mark.slow
@pytest.mark.parametrize("code", ["SE3", "AFD1", "AFD3", "AFD6", "AFP1", "AFP4"])
@pytest.mark.parametrize("value", [Fraction(UNLUCKY[24], 2**24), Fraction(2**24, UNLUCKY[24])])
def test_an_unlucky_prime_changes_no_answer_of_a_formulation(code: str, value: Fraction, monkeypatch: Patch) -> None:
    given, policy = shipped("mourrain-l"), Policy(prime_bits=24)
    first, *others = given.distances
    problem = replace(given, constraints=(replace(first, base=(value, *first.base[1:])), *others))
    expected = solve(problem, formulation=code, policy=policy)
    chosen_first(monkeypatch, UNLUCKY[24])
    assert answer(solve(problem, formulation=code, policy=policy)) == answer(expected)
