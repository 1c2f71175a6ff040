"""The certified numeric engine: what Krawczyk's operator accepts and rejects, and agreement with the exact engine."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from flint import arb_mat
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st
from samples import MODELS, boxed, random_placed, random_vector, shipped, solved

from pkm_exact.claim import Claim, CompletenessRoute
from pkm_exact.engine import solve
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.reader import read_robot
from pkm_exact.numeric import certification
from pkm_exact.numeric import poses as numeric_poses
from pkm_exact.numeric.box_order import in_order
from pkm_exact.numeric.certification import GRIDS, isolated_solutions, nearest_box, refined
from pkm_exact.numeric.certified_boxes import centre, certified
from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.double_boxes import DoubleBoxes
from pkm_exact.numeric.poses import Approximations, approximations, box_enclosures, certified_solutions
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.poses.isolated_solutions import RADIUS, Box, IsolatedSolutions
from pkm_exact.poses.pose import Interval, Pose
from pkm_exact.precision import working_precision
from pkm_exact.solution import Solution

CASES = Path(__file__).parent / "cases"
GENERAL = "rolland-6-6"
SLOW = {"6-6pp", "hexa", "hexaglide", "linuxcnc-hexapod", "ssm-exact", "ssm-rounded", "tssm"}
NAMES = [pytest.param(path.stem, marks=pytest.mark.slow if path.stem in SLOW else ()) for path in MODELS]
FEWER = {"similar-planar-s", "ssm-rounded", "3-rpr-double-q", "3-rpr-triple"}
"""Robots whose boxes do not prove themselves complete, with exact points at infinity neither."""


@cache
def boxes_of(name: str) -> tuple[ChartSystem, IsolatedSolutions]:
    problem = shipped(name)
    return certified_solutions(problem, approximations(problem))


def _contains(outer: Box, inner: Box) -> bool:
    """Whether all points of the inner box lie in the outer one."""
    for index, (one, two) in enumerate(zip(outer.centre, inner.centre, strict=True)):
        here, there = (Fraction(2) ** -box.exponent(index) for box in (outer, inner))
        room = RADIUS * (here - there)
        if any(abs(a * here - b * there) > room for a, b in zip(one, two, strict=True)):
            return False
    return True


def moved(box: Box, index: int, units: int) -> Box:
    centre = list(box.centre)
    real, imaginary = centre[index]
    centre[index] = (real + units, imaginary)
    return replace(box, centre=tuple(centre))


def coarser(box: Box, bits: int) -> Box:
    """The box around the same point on a grid so many bits coarser."""
    half = 1 << (bits - 1)
    return Box(
        (box.exponents[0] - bits, box.exponents[1] - bits),
        tuple(((real + half) >> bits, (imaginary + half) >> bits) for real, imaginary in box.centre),
    )


def are_equal(one: Pose, other: Pose) -> bool:
    """Whether the boxes are the same, those of the quaternions up to sign, and the signs of the Jacobians too."""
    quaternions = one.quaternion, tuple(Interval(-q.hi, -q.lo) for q in one.quaternion)
    signs = {pose.jacobian.det_sign for pose in (one, other) if pose.jacobian}
    same = (one.position, one.rotation) == (other.position, other.rotation)
    return same and other.quaternion in quaternions and len(signs) == 1


def assert_same_answer(numeric: Solution, exact: Solution) -> None:
    assert numeric.claim == exact.claim
    assert numeric.complex_solutions == exact.complex_solutions
    assert len(numeric.poses) == len(exact.poses)
    assert all(map(are_equal, numeric.poses, exact.poses))


def random_robot(seed: int) -> ForwardProblem:
    random = Random(seed)
    quaternion = [Fraction(random.randint(1, 9)), *random_vector(random)]
    return random_placed(random, quaternion, random.choice([(1, 1, 1), (1, 3, 1)])).problem


@pytest.mark.parametrize("name", [GENERAL, "3-rpr-merlet-p"])
def test_true_boxes_are_accepted(name: str) -> None:
    system, isolated = boxes_of(name)
    assert isolated.count == system.problem.solution_bound
    boxes = [*isolated.real, *isolated.pairs]
    assert all(certified(system, boxes))
    assert all(certified(system, [box.conjugate() for box in boxes]))
    assert all(certified(system, [box]) == [True] for box in boxes)


@pytest.mark.parametrize("units", [2 * RADIUS, -3 * RADIUS, 1000])
def test_moved_boxes_are_rejected(units: int) -> None:
    system, isolated = boxes_of(GENERAL)
    for box in (*isolated.real, *isolated.pairs):
        assert not any(certified(system, [moved(box, index, units) for index in system.support]))


def test_answers_keep_the_order_of_real_complex_and_wrong_boxes() -> None:
    system, isolated = boxes_of(GENERAL)
    real, pair = isolated.real[0], isolated.pairs[0]
    boxes = [pair, moved(real, 0, 100), real, moved(pair, 3, 100), pair.conjugate()]
    assert certified(system, boxes) == [True, False, True, False, True]
    assert certified(system, []) == []


def test_boxes_that_are_too_wide_are_rejected() -> None:
    system, isolated = boxes_of(GENERAL)
    for box in (*isolated.real, *isolated.pairs):
        assert certified(system, [coarser(box, box.exponents[0])]) == [False]


def test_a_box_with_two_solutions_is_rejected() -> None:
    """On the coarse grid that holds both, K(X) cannot lie in the interior: there would be one solution only."""
    system, isolated = boxes_of(GENERAL)
    one, two = isolated.real[:2]
    for bits in range(1, 31):
        wide = coarser(one, bits)
        if _contains(wide, two):
            assert certified(system, [wide]) == [False]
    assert _contains(coarser(one, 30), two)


@pytest.mark.parametrize("name", ["3-rpr-double-q", "3-rpr-triple"])
def test_no_box_is_accepted_at_a_multiple_pose(name: str) -> None:
    """At a double solution the Jacobian is singular: no grid, however fine, helps."""
    exact = solved(name)
    multiple = [pose for pose in exact.poses if pose.multiplicity != 1]
    assert multiple
    system, isolated = boxes_of(name)
    assert isolated.count < system.problem.solution_bound
    for pose in multiple:
        e = np.array([[float(value.midpoint) for value in pose.quaternion]], dtype=complex)
        system = ChartSystem(system.problem, (1, 0, 0, 0) if abs(e[0, 0]) > 0.1 else (0, 0, 0, 1))
        c = np.array([float(value.midpoint) for value in pose.position])
        f = [-c @ e[0, 1:], *(e[0, 0] * c + np.cross(c, e[0, 1:]))]
        point = np.concatenate([e[0], f]) / (e[0] @ system.chart)
        assert isolated_solutions(system, point[None, list(system.support)]).count == 0


def test_reality_is_proved_never_guessed() -> None:
    system, isolated = boxes_of(GENERAL)
    assert len(isolated.real) == 16
    assert all(box.is_real and box == box.conjugate() for box in isolated.real)
    assert all(not box.is_real and box.is_disjoint(box.conjugate()) for box in isolated.pairs)
    everything = [*isolated.real, *isolated.pairs, *(box.conjugate() for box in isolated.pairs)]
    assert all(one.is_disjoint(two) for k, one in enumerate(everything) for two in everything[:k])
    real, pair = isolated.real[0], isolated.pairs[0]
    flattened = replace(pair, centre=tuple((part, 0) for part, _ in pair.centre))
    lifted = replace(real, centre=tuple((part, 1) for part, _ in real.centre))
    assert certified(system, [flattened]) == [False]
    assert not lifted.is_disjoint(lifted.conjugate())


@given(
    st.lists(
        st.builds(
            Box,
            st.tuples(st.integers(2, 4), st.integers(2, 4)),
            st.tuples(*[st.tuples(st.integers(-3, 3), st.integers(-1, 1))] * 8),
        ),
        max_size=6,
    )
)
def test_boxes_are_listed_by_their_centres_on_any_grids(boxes: list[Box]) -> None:
    def centre(box: Box) -> list[Fraction]:
        return [Fraction(part, 1 << box.exponent(k)) for k, pair in enumerate(box.centre) for part in pair]

    assert list(map(centre, in_order(boxes))) == sorted(map(centre, boxes))
    assert {Box(box.exponents, box.centre) for box in boxes} == set(boxes)


def test_repeated_and_conjugate_points_give_each_solution_once() -> None:
    system, isolated = boxes_of(GENERAL)
    points = np.array(
        [
            [complex(*part) / 2.0 ** box.exponent(index) for index, part in enumerate(box.centre)]
            for box in (*isolated.real, *isolated.pairs)
        ]
    )
    points = np.concatenate([points, points.conj(), points])
    again = isolated_solutions(system, points)
    assert again.count == 40
    assert set(again.real) == set(isolated.real)
    assert set(again.pairs) == set(isolated.pairs)


def test_points_that_are_no_solutions_are_left_out() -> None:
    system, _ = boxes_of(GENERAL)
    assert isolated_solutions(system, np.zeros((1, 8), dtype=complex)).count == 0
    random = np.random.default_rng(5)
    far = random.standard_normal((6, 8)) + 1j * random.standard_normal((6, 8))
    found = isolated_solutions(system, far)
    known = {*boxes_of(GENERAL)[1].real, *boxes_of(GENERAL)[1].pairs}
    assert {box for box in (*found.real, *found.pairs) if box.exponents[0] == GRIDS[0]} <= known


@pytest.mark.parametrize("precision", [200, 700])
def test_enclosures_hold_the_poses_of_the_exact_engine(precision: int) -> None:
    system, isolated = boxes_of(GENERAL)
    exact = solved(GENERAL).poses
    for values in box_enclosures(system, isolated.real)(precision, range(len(isolated.real))):
        middles = [Fraction(*map(int, (lambda q: (q.p, q.q))(value.mid().fmpq()))) for value in values[:12]]
        holding = [
            pose
            for pose in exact
            if all(
                interval.contains(middle)
                for interval, middle in zip([*pose.position, *sum(pose.rotation, ())], middles, strict=True)
            )
        ]
        assert len(holding) == 1
        assert all(value.rad() * 2 ** (precision - 40) < 1 for value in values)


def test_equations_are_of_one_size_and_exact_at_every_precision() -> None:
    robot = read_robot(CASES / "equations-of-different-sizes.toml")
    system = ChartSystem(robot.problem(robot.configuration()), (3, 0, 0, 1))
    points = [arb_mat(4, 1, [int(k == place) for k in range(4)]) for place in range(4)]
    with working_precision(64):
        system.jacobian(points[0])
    with working_precision(2000):
        rows = [jacobian.tolist()[:3] for jacobian in map(system.jacobian, points)]
    assert all(entry.is_exact() for block in rows for row in block for entry in row)
    largest = [max(abs(float(entry)) for block in rows for entry in block[place]) for place in range(3)]
    assert all(0.5 <= size <= 2 for size in largest)


@pytest.mark.parametrize("name", [GENERAL, "3-rps", "3-rrr"])
def test_equations_are_of_the_same_size_in_doubles(name: str) -> None:
    system, isolated = boxes_of(name)
    assert system.in_doubles is not None
    for box in isolated.real[:2]:
        point = centre(system, box)
        near = np.array([[float(entry.mid()) for entry in point.entries()]])
        with working_precision(100):
            exact = np.array([float(entry.mid()) for entry in system.jacobian(point).entries()])
        quadrics = slice(0, -system.size)  # the last equation, that of the chart, has no second derivatives
        found = system.in_doubles.jacobians(near).ravel()
        assert np.allclose(found[quadrics], exact[quadrics], rtol=1e-9, atol=1e-9 * np.abs(exact).max())


@pytest.mark.parametrize("lost_bits", [None, -12, 40])
def test_boxes_are_narrowed_to_the_same_poses_with_and_without_newton(
    lost_bits: int | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Not at all, around balls too small to hold the solution, and around larger ones than usual."""
    expected = solve_krawczyk(shipped("rolland-6-6")).poses
    monkeypatch.setattr(certification, "_in_doubles", lambda _, points, _known: DoubleBoxes.none(points))
    near_limit, found = numeric_poses._near_limit, []

    def noted(*arguments: Any) -> Any:
        found.append(None if lost_bits is None else near_limit(*arguments))
        return found[-1]

    if lost_bits is not None:
        monkeypatch.setattr(numeric_poses, "LOST_BITS", lost_bits)
    monkeypatch.setattr(numeric_poses, "_near_limit", noted)
    assert solve_krawczyk(shipped("rolland-6-6")).poses == expected
    assert len(found) == len(expected)
    assert all((enclosure is not None) == (lost_bits == 40) for enclosure in found)


def test_newton_refines_to_the_same_box_on_every_grid() -> None:
    system, isolated = boxes_of(GENERAL)
    for box in isolated.real[:3]:
        limit = refined(system, centre(system, box), 150)
        assert limit is not None
        point, is_settled = limit
        assert is_settled
        fine = nearest_box(system, point, 150)
        assert certified(system, [fine]) == [True]
        assert _contains(box, fine)


@pytest.mark.parametrize("name", NAMES)
def test_shipped_robots_have_the_poses_of_the_exact_engine(name: str) -> None:
    numeric, exact = boxed(name), solved(name)
    assert_same_answer(numeric, exact)
    if numeric.method == "krawczyk":
        infinity = numeric.completeness.infinity if numeric.completeness else None
        counted = CompletenessRoute.COUNTING_AT_INFINITY if infinity else CompletenessRoute.REFINED_BEZOUT
        beyond = infinity.multiplicity if infinity else 0
        # Where the degree is not filled, the number of solutions itself is proved, as a rank.
        is_filled = numeric.complex_solutions + beyond == shipped(name).solution_bound
        # Two spheres and planes have a bound of their own, below the degree.
        short = (CompletenessRoute.MODULAR_RANK, CompletenessRoute.PRODUCT_BOUND)
        assert numeric.completeness_route in ((counted,) if is_filled else short)
        assert numeric.isolated is not None
        assert numeric.isolated.count == numeric.complex_solutions
    else:
        assert any("the exact engine answered" in note for note in numeric.notes)
    assert (numeric.method == "exact") >= (name in FEWER)


def test_the_general_robots_need_no_exact_engine() -> None:
    assert {name: boxed(name).method for name in (GENERAL, "dietmaier", "3-rpr-merlet-p")} == {
        GENERAL: "krawczyk",
        "dietmaier": "krawczyk",
        "3-rpr-merlet-p": "krawczyk",
    }


def test_numbers_beyond_floating_point_are_left_to_the_exact_engine(monkeypatch: pytest.MonkeyPatch) -> None:
    def too_large(*_: object) -> None:
        raise OverflowError

    monkeypatch.setattr("pkm_exact.numeric_engine.approximations", too_large)
    numeric = solve_krawczyk(shipped("3-rpr-merlet-p"))
    assert numeric.method == "exact"
    assert "did not certify all of the 6" in numeric.notes[-1]
    assert_same_answer(numeric, solved("3-rpr-merlet-p"))


def test_lost_paths_never_shorten_the_list(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever path tracking finds, fewer certified solutions than the degree lead to the exact engine."""

    def shortened(*arguments: object) -> Approximations:
        found = approximations(*arguments)  # type: ignore[arg-type]
        return Approximations(found.section, found.points[3:])

    monkeypatch.setattr("pkm_exact.numeric_engine.approximations", shortened)
    numeric = solve_krawczyk(shipped("3-rpr-merlet-p"))
    assert_same_answer(numeric, solved("3-rpr-merlet-p"))
    assert (numeric.method == "exact") == ("the exact engine answered" in " ".join(numeric.notes))


@hypothesis_settings(max_examples=4)
@given(st.integers(0, 10**6))
def test_random_robots_have_the_poses_of_the_exact_engine(seed: int) -> None:
    problem = random_robot(seed)
    assert_same_answer(solve_krawczyk(problem), solve(problem))


@pytest.mark.slow
@hypothesis_settings(max_examples=60)
@given(st.integers(0, 10**9))
def test_many_random_robots_have_the_poses_of_the_exact_engine(seed: int) -> None:
    problem = random_robot(seed)
    assert_same_answer(solve_krawczyk(problem), solve(problem))


def test_lengths_that_contradict_each_other_are_inconsistent_and_no_empty_list() -> None:
    first, _, *others = shipped("mssm").distances
    contradicting = replace(first, length_squared=first.length_squared + 1)
    found = solve_krawczyk(replace(shipped("mssm"), constraints=(first, contradicting, *others)))
    assert (found.claim, found.complex_solutions) == (Claim.INCONSISTENT, 0)
