"""What doubles prove: that bounds of roundings hold, exactly, and that answers are those of ball arithmetic."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from random import Random
from typing import Any

import numpy as np
import pytest
from budgets import budget
from flint import arb
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp
from numpy.typing import NDArray
from samples import shipped
from test_numeric_krawczyk import random_robot

from pkm_exact.numeric import certification, double_boxes
from pkm_exact.numeric.certified_boxes import certified
from pkm_exact.numeric.double_boxes import CLEARLY_COMPLEX, DoubleBoxes
from pkm_exact.numeric.double_forms import DoubleForms
from pkm_exact.numeric.double_jacobians import _extremes
from pkm_exact.numeric.double_krawczyk import DoubleEquations, Proofs, double_proofs
from pkm_exact.numeric.double_poses import double_cells, double_coordinates
from pkm_exact.numeric.double_rounding import LARGE, two_product, twofold_sums
from pkm_exact.numeric.poses import approximations, box_enclosures, certified_solutions, real_poses
from pkm_exact.numeric.seeds import has_seeds, seeds
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.poses.boxes import DEFAULT_WIDTH
from pkm_exact.poses.isolated_solutions import RADIUS, ROOM

Patch = pytest.MonkeyPatch
ROBOTS = [
    *("mourrain-l", "3-rps", "3-rrr", "h4"),
    *(
        pytest.param(n, marks=pytest.mark.slow)
        for n in ("rolland-6-6", "6-6p", "6-6pp", "dietmaier", "hexa", "hexaglide")
    ),
]
SEEDS = [2, *(pytest.param(n, marks=pytest.mark.slow) for n in (1039, *range(3, 44)))]


def _no_doubles(monkeypatch: Patch) -> None:
    """All boxes by ball arithmetic, on the first grids that are tried there."""
    monkeypatch.setattr(certification, "_in_doubles", lambda _, points, __: DoubleBoxes.none(points))
    monkeypatch.setattr(certification, "_first_grid", lambda *_: certification.GRIDS[0])


def _exact(value: Any) -> tuple[Fraction, Fraction]:
    return Fraction(float(np.real(value))), Fraction(float(np.imag(value)))


def _value(polynomial: dict[tuple[int, int], int], point: Sequence[Any]) -> tuple[Fraction, Fraction]:
    """Of a polynomial at a point, with one more coordinate 1, exactly."""
    return _value_at(polynomial, [*map(_exact, point)], 1)


def _value_at(
    polynomial: dict[tuple[int, int], int], place: Sequence[tuple[Fraction, Fraction]], scale: int
) -> tuple[Fraction, Fraction]:
    """Of a polynomial at a point that is given exactly, scaled."""
    x = [*place, (Fraction(1), Fraction(0))]
    real = sum((c * (x[i][0] * x[j][0] - x[i][1] * x[j][1]) for (i, j), c in polynomial.items()), Fraction(0))
    imaginary = sum((c * (x[i][0] * x[j][1] + x[i][1] * x[j][0]) for (i, j), c in polynomial.items()), Fraction(0))
    return real / scale, imaginary / scale


@budget(25)
@given(st.integers(0, 10**9), st.booleans())
def test_values_of_forms_are_within_their_bounds(seed: int, is_complex: bool) -> None:
    random, size = Random(seed), 3
    polynomials = [
        {(i, j): random.randint(-(2**bits), 2**bits) or 1 for i in range(size) for j in range(i, size + 1)}
        for bits in (3, 50, 53, 100, 300)
    ]
    scale = 10.0 ** random.randint(-12, 12)
    points = np.array([[scale * random.gauss(0, 1) * 10.0 ** random.randint(-3, 3) for _ in range(size)]])
    if is_complex:
        points = points + 1j * np.array([[scale * random.gauss(0, 1) for _ in range(size)]])
    # The last coefficient makes the sum of one of them nearly 0.
    real, _ = _value(polynomials[2], points[0])
    polynomials[2][size, size] = -round(real)
    forms = DoubleForms.of(polynomials)
    values, bounds = forms.at(points)
    for polynomial, power, value, bound in zip(polynomials, forms.powers.tolist(), values[0], bounds[0], strict=True):
        exact, found = _value(polynomial, points[0]), _exact(value)
        error = sum((abs(a / 2**power - b) for a, b in zip(exact, found, strict=True)), Fraction(0))
        assert error <= 2 * Fraction(float(bound))
        largest = max(abs(c) for c in polynomial.values()) * max(1, float(np.abs(points).max())) ** 2 / 2**power
        assert bound < 1e-15 * abs(value) + 1e-25 * largest


def test_values_are_exact_to_twice_the_bits_where_coordinates_are_of_different_sizes() -> None:
    random = Random(7)
    polynomials = [
        {(i, j): random.randint(1, 2**60) << 40 * (i + j < 2) for i in range(3) for j in range(i, 4)} for _ in range(2)
    ]
    points = np.array([[random.uniform(0.5, 1), random.uniform(0.5, 1) * 2.0**60, 1.0]])
    forms = DoubleForms.of(polynomials)
    first, second, bound = forms.in_two(points)
    for k, polynomial in enumerate(polynomials):
        exact = _value(polynomial, points[0])[0] / 2 ** int(forms.powers[k])
        error = abs(Fraction(float(first[0, k])) + Fraction(float(second[0, k])) - exact)
        assert error <= Fraction(float(bound[0, k]))
        assert bound[0, k] < 1e-25 * abs(exact)


@pytest.mark.parametrize("is_complex", [True, False])
def test_values_from_derivatives_are_within_their_bounds(is_complex: bool) -> None:
    """At points, and beside points at which they are known exactly."""
    random, size = np.random.default_rng(3), 8
    integers = Random(3)
    polynomials = [
        {(i, j): integers.randint(-(1 << 70), 1 << 70) for i in range(size) for j in range(i, size + 1)}
        for _ in range(size)
    ]
    equations = DoubleEquations(tuple(range(size)), DoubleForms.of(polynomials), np.ones(size))
    points: Any = random.standard_normal((4, size)) * [*[1] * 4, *[1e4] * 4]
    moves: Any = 2.0**-30 * random.standard_normal((4, size))
    if is_complex:
        points, moves = points + 1j * random.standard_normal((4, size)), moves * (1 + 2j)
    found = (equations.values_at(points), equations.values_beside(points, moves, equations.forms.at(points)))
    for (values, bounds), moved, least in zip(found, (False, True), (1e-4, 1e-6), strict=True):
        worst = 0.0
        for row in range(4):
            place = [_exact(value) for value in points[row]]
            if moved:
                place = [(a + c, b + d) for (a, b), (c, d) in zip(place, map(_exact, moves[row]), strict=True)]
            for k, polynomial in enumerate(polynomials):
                exact = _value_at(polynomial, place, 2 ** int(equations.forms.powers[k]))
                for part, value in zip(exact, _exact(values[row, k]), strict=True):
                    assert abs(part - value) <= Fraction(float(bounds[row, k]))
                    worst = max(worst, float(abs(part - value) / Fraction(float(bounds[row, k]))))
        assert worst > least


def test_values_at_points_that_are_too_large_prove_nothing() -> None:
    forms = DoubleForms.of([{(0, 0): 1, (0, 2): 3, (1, 1): 1 << 70}])
    wrong = np.array([[1.0, np.inf], [np.nan, 1.0], [1e300, 1e-300], [1.0, 2.0]])
    values, _ = forms.at(wrong)
    assert np.isfinite(values[:, 0]).tolist() == [False, False, False, True]
    assert np.isinf(forms.at_integers([[[1 << 900, 1]]], 0, [0])).all()
    assert forms.at(wrong[:0])[0].shape == (0, 1)


@budget(50)
@given(st.lists(st.floats(-1e100, 1e100), min_size=1, max_size=40), st.floats(-1e100, 1e100))
def test_sums_and_products_are_exact_where_they_say_so(terms: list[float], other: float) -> None:
    table = np.array([[*terms, *(-value for value in terms[::2])]])
    head, tail, bound = twofold_sums(table, np.zeros_like(table))
    exact = sum(map(Fraction, table[0].tolist()), Fraction(0))
    assert abs(Fraction(float(head[0])) + Fraction(float(tail[0])) - exact) <= Fraction(float(bound[0]))
    values = np.array([value for value in terms if value == 0 or abs(value) > 1e-100])
    factors = np.full_like(values, other if abs(other) > 1e-100 else 0.0)
    for a, b, p, e in zip(values, factors, *two_product(values, factors), strict=True):
        assert Fraction(float(a)) * Fraction(float(b)) == Fraction(float(p)) + Fraction(float(e))


@dataclass(frozen=True)
class _Pair:
    """(x - a)(x - b) = 0, y = 1, with a, b integers in units of 2^-40, or a conjugate pair: exact, however near."""

    a: tuple[int, int]
    b: tuple[int, int]

    @property
    def equations(self) -> DoubleEquations:
        (a, c), (b, d) = self.a, self.b
        polynomials = [{(0, 0): 1 << 80, (0, 2): -(a + b) << 40, (2, 2): a * b - c * d}, {(1, 2): 1, (2, 2): -1}]
        return DoubleEquations(
            (0, 1), DoubleForms.of([{k: v for k, v in p.items() if v} for p in polynomials]), np.array([0.0, 1.0])
        )

    def roots(self) -> list[tuple[Fraction, Fraction]]:
        return [(Fraction(x, 1 << 40), Fraction(y, 1 << 40)) for x, y in (self.a, self.b)]


def _proofs(pair: _Pair, point: complex, centre: complex, radius: float) -> Proofs:
    equations = pair.equations
    is_complex = pair.a[1] != 0
    points, centres = (np.array([[x, 1.0]]) if is_complex else np.array([[x.real, 1.0]]) for x in (point, centre))
    inverses = np.linalg.pinv(equations.jacobians(centres))
    near = points - centres, *equations.forms.at(points)
    return double_proofs(equations, inverses, centres, np.full((1, 2), radius), ROOM, near)


@budget(150)
@given(st.integers(0, 10**9))
def test_a_proved_box_holds_one_root_and_says_where(seed: int) -> None:
    """Pairs of roots from far apart to 2^-40 apart, boxes of all sizes around them and beside them."""
    random = Random(seed)
    gap, radius = 1 << random.randint(0, 40), 2.0 ** random.randint(-42, 0)
    middle = random.randint(1, 1 << 42)
    pair = random.choice([_Pair((middle, 0), (middle + gap, 0)), _Pair((middle, gap), (middle, -gap))])
    root = complex(*(float(value) for value in pair.roots()[0]))
    centre = root + radius * (random.uniform(-1, 1) * 2 ** -random.randint(0, 12) + 1j * random.uniform(-1, 1) / 16)
    centre = complex(*(round(part * 2**44) / 2**44 for part in (centre.real, centre.imag)))
    point = random.choice([root, centre, centre + radius / 8])
    proofs = _proofs(pair, point, centre, radius)
    if not proofs.proved[0]:
        assert proofs.proved.shape == (1,)
        return
    if pair.a[1] == 0:
        centre, point = complex(centre.real), complex(point.real)
    inside = [
        found
        for found in pair.roots()
        if all(abs(a - b) <= Fraction(radius) for a, b in zip(found, _exact(centre), strict=True))
    ]
    assert len(inside) == 1
    for exact, start, step in zip(inside[0], _exact(point), _exact(proofs.steps[0, 0]), strict=True):
        assert abs(start - step - exact) <= Fraction(float(proofs.errors[0, 0]))


def test_boxes_are_proved_where_roots_are_apart_and_not_where_they_are_near() -> None:
    unit = 2.0**-28
    apart, near = _Pair((1 << 40, 0), (3 << 40, 0)), _Pair((1 << 40, 0), ((1 << 40) + (1 << 12), 0))
    assert _proofs(apart, 1, 1, RADIUS * unit).proved[0]
    assert not _proofs(near, 1, 1, RADIUS * unit).proved[0]
    assert not _proofs(near, 1, 1, unit / 2).proved[0]
    assert _proofs(near, 1, 1, unit / 64).proved[0]
    assert not _proofs(apart, 1 + unit / 8, 1 + 3 * unit, RADIUS * unit).proved[0]  # not into half of it
    assert not _proofs(_Pair((1 << 40, 0), (1 << 40, 0)), 1, 1, RADIUS * unit).proved[0]
    assert not _proofs(apart, 1, 1, 2.0**3).proved[0]


def test_no_motion_is_no_solution() -> None:
    """The root is simple; N(e) = x^2 is 0 in the box."""
    pair = _Pair((1, 0), (1 << 40, 0))
    equations = pair.equations
    for norm, is_motion in ((np.array([1.0, 0.0]), False), (np.array([1.0, 1.0]), True)):
        changed = DoubleEquations(equations.support, equations.forms, norm)
        x = np.array([[2.0**-40, 1.0]])
        near = 0 * x, *changed.forms.at(x)
        found = double_proofs(changed, np.linalg.inv(changed.jacobians(x)), x, np.full((1, 2), 2.0**-26), ROOM, near)
        assert found.proved[0] == is_motion


@pytest.mark.parametrize("factor", [np.nan, np.inf, 4 * LARGE])
def test_numbers_out_of_bounds_prove_nothing(factor: float) -> None:
    equations = _Pair((1 << 40, 0), (3 << 40, 0)).equations
    x = np.array([[1.0, 1.0], [1.0, 1.0]])
    inverses = np.linalg.inv(equations.jacobians(x))
    with np.errstate(all="ignore"):
        inverses[1] *= factor
        near = 0 * x, *equations.forms.at(x)
        found = double_proofs(equations, inverses, x, np.full((2, 2), 2.0**-26), ROOM, near)
    assert found.proved.tolist() == [True, False]


def _found(problem: Any) -> Any:
    return seeds(problem) if has_seeds(problem) else approximations(problem)


def _agrees(problem: Any, monkeypatch: Patch) -> tuple[int, int]:
    """Boxes, poses and Jacobians as by ball arithmetic; how many real boxes doubles proved, of how many."""
    approximate = _found(problem)
    system, isolated = certified_solutions(problem, approximate)
    answer = real_poses(system, isolated, DEFAULT_WIDTH)
    with monkeypatch.context() as changed:
        _no_doubles(changed)
        other, again = certified_solutions(problem, approximate)
        assert not other.double_solutions
        assert again == isolated
        assert real_poses(other, again, DEFAULT_WIDTH) == answer
    assert all(certified(system, [*isolated.real, *isolated.pairs]))
    return len(system.double_solutions), len(isolated.real)


@pytest.mark.parametrize("name", ROBOTS)
def test_answers_are_those_of_ball_arithmetic(name: str, monkeypatch: Patch) -> None:
    some, real = _agrees(shipped(name), monkeypatch)
    assert 2 * some > real


@pytest.mark.parametrize("seed", SEEDS)
def test_answers_for_random_robots_are_those_of_ball_arithmetic(seed: int, monkeypatch: Patch) -> None:
    _agrees(random_robot(seed), monkeypatch)


@pytest.mark.parametrize("name", ["3-rps", "3-rrr"])
def test_coordinates_are_within_their_bounds(name: str) -> None:
    problem = shipped(name)
    system, isolated = certified_solutions(problem, _found(problem))
    solutions = [system.double_solutions[box] for box in isolated.real]
    found = double_coordinates(solutions, system.support, problem.metric)
    exact = box_enclosures(system, isolated.real)(200, range(len(isolated.real)))
    for values, errors, enclosures in zip(found.values, found.errors, exact, strict=True):
        for value, error, enclosure in zip(values.tolist(), errors.tolist(), enclosures, strict=True):
            assert abs(arb(value) - enclosure) <= arb(error) if error else value in (0, 1) and enclosure.contains(value)
            assert error < 1e-13 * max(1, abs(value))
    assert sum(cell is None for row in double_cells(found, 31) for cell in row) < len(solutions) * 8


def test_points_that_are_not_solutions_are_left_to_ball_arithmetic() -> None:
    problem = shipped("mourrain-l")
    system, isolated = certified_solutions(problem, _found(problem))
    assert system.in_doubles is not None
    points = np.array([[Fraction(a, 1 << 28) for a, _ in box.centre] for box in isolated.real], dtype=complex)
    for box, row in zip(isolated.real, points, strict=True):
        row[4:] *= 2.0 ** (box.exponents[0] - box.exponents[1])
    assert double_boxes.double_boxes(system.in_doubles, points, 28).boxes == list(isolated.real)
    random = np.random.default_rng(1)
    moved = points * (1 + 1e-3 * random.standard_normal(points.shape))
    flat = points * (1 + CLEARLY_COMPLEX * 1j * 2)
    wrong = np.full_like(points, np.nan)
    rest: list[Any] = [moved, flat, wrong, 0 * points]
    for others in rest:
        assert double_boxes.double_boxes(system.in_doubles, others, 28).boxes == [None] * len(points)


def test_solutions_between_two_grid_points_are_left_to_ball_arithmetic(monkeypatch: Patch) -> None:
    problem = shipped("3-rrr")
    expected = solve_krawczyk(problem)
    for changed in ({"SURE": 0.2}, {"SURE": 0.0}, {"DOUBT": 0.9}, {"GREATEST": 1.0}, {"NEAR": 0.0}):
        with monkeypatch.context() as patched:
            for name, value in changed.items():
                patched.setattr(double_boxes, name, value)
            again = solve_krawczyk(problem)
        assert (again.isolated, again.poses) == (expected.isolated, expected.poses)


def test_numbers_beyond_doubles_are_left_to_ball_arithmetic(monkeypatch: Patch) -> None:
    def too_large(*_: Any) -> Any:
        raise OverflowError

    expected = solve_krawczyk(shipped("3-rrr"))
    monkeypatch.setattr(DoubleForms, "of", too_large)
    again = solve_krawczyk(shipped("3-rrr"))
    assert (again.method, again.isolated, again.poses) == ("krawczyk", expected.isolated, expected.poses)


def _sizes(diagonal: NDArray[Any], part: NDArray[Any]) -> list[Fraction]:
    """The smallest and the largest singular value of the sum, far more exactly than doubles."""
    with mp.workdps(60):
        values = mp.svd_r(mp.diag(diagonal.tolist()) + mp.matrix(part.tolist()), compute_uv=False)
        return [Fraction(str(value)) for value in (min(values), max(values))]


def test_bounds_of_extreme_singular_values_hold_whatever_the_gaps() -> None:
    """Also between corners of what is lacking, and where the bounds are all that is there."""
    random = np.random.default_rng(3)
    narrow = 0
    for size, spread, noise in itertools.product((1, 2, 3, 6), (0.0, 1e-9, 1e-3, 0.5), (1e-12, 1e-6, 1e-2)):
        diagonal = 1 + spread * random.standard_normal(size)
        lacking = noise * random.random((size, size))
        bounds = list(_extremes(diagonal[None], lacking[None]))
        narrow += sum(bool(radius[0] < np.linalg.norm(lacking)) for _, radius in bounds)
        for _ in range(3):
            signs = random.choice((-1.0, 1.0), (size, size))
            found = _sizes(diagonal, signs * lacking)
            for value, (middle, radius) in zip(found, bounds, strict=True):
                assert abs(value - Fraction(float(middle[0]))) <= Fraction(float(radius[0]))
    assert narrow > 20


def test_a_singular_value_moves_by_its_own_entry_and_the_square_of_the_others() -> None:
    lacking = np.full((1, 3, 3), 1e-5)
    lacking[0, range(3), range(3)] = 1e-12
    for middle, radius in _extremes(np.array([[1.0, 2.0, 4.0]]), lacking):
        assert float(middle[0]) in (1.0, 4.0)
        assert 1e-10 < float(radius[0]) < 1.3e-9
