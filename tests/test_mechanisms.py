"""Mechanisms whose constraints are not all legs: counts of published ones, motions, redundancy, and what is refused."""

from dataclasses import replace
from fractions import Fraction
from random import Random
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mechanism_samples import MECHANISMS, ORIGIN, Some, distance, general, h4, hinged, plane, solved, vector

from pkm_exact.claim import Claim, RealMotion
from pkm_exact.cli.feasible_poses import ShownPoses
from pkm_exact.cli.table import print_table
from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.at_point import AtPoint
from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint_types import CONSTRAINTS
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import in_frames, value_at
from pkm_exact.constraints.linear import LinearForm
from pkm_exact.engine import solve
from pkm_exact.errors import InputError
from pkm_exact.formulations.moved_platform import moved_platform
from pkm_exact.geometry.inverse import distance_squared, rotation_of
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.motions.motion_groups import MOTIONS, PLANAR, SCHOENFLIES, TRANSLATION
from pkm_exact.numeric.poses import approximations, certified_solutions, is_tracked
from pkm_exact.numeric.start import generic_start
from pkm_exact.numeric.study_system import section_quadrics
from pkm_exact.numeric.tolerance import tolerance_boxes
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.policy import Policy
from pkm_exact.poses.pose_consistency import has_degree_zero
from pkm_exact.poses.singularity import singularity
from pkm_exact.poses.symmetry import base_freedom, platform_freedom
from pkm_exact.solution import Solution

TRACKED = ["3 lines", "3-RPS", "H4", "Delta", "3 legs about a point", "3-RPR, driven in turns"]
UNIT = Tolerances.uniform("1/1000")
PLACE = vector("1/3", -2, "5/2")
TURN = (Fraction(3), Fraction(1), Fraction(-1), Fraction(2))


@pytest.mark.parametrize("name", MECHANISMS)
def test_published_counts(name: str) -> None:
    solution, count = solved(name), MECHANISMS[name][1]
    assert (solution.claim, solution.complex_solutions, solution.distinct_solutions) == (Claim.COMPLETE, count, count)
    assert abs(sum(pose.det_sign or 0 for pose in solution.poses)) == count % 2


def positions(solution: Solution) -> Any:
    return solution.to_numpy().position


def test_real_poses_of_published_mechanisms() -> None:
    assert len(solved("3-PSS+C").poses) == 8
    assert len(solved("H4").poses) == len(solved("Delta").poses) == 2
    found = {tuple(np.round(place, 6)) for place in positions(solved("3-PRRR, driven in turns"))}
    upper = {(0.252402, 0.252402, 0.121671), (0.293411, 0.916589, 0.20504), (0.783659, 0.426341, 0.327429)}
    upper.add((0.76288, 0.76288, 0.337939))
    assert found == upper | {(x, y, -z) for x, y, z in upper}


@pytest.mark.parametrize("name", TRACKED)
def test_paths_lead_to_all_solutions(name: str) -> None:
    problem, count = MECHANISMS[name][0](), MECHANISMS[name][1]
    _, isolated = certified_solutions(problem, approximations(problem))
    assert isolated.count == count
    assert len(isolated.real) == len(solved(name).poses)


@pytest.mark.parametrize("name", ["H4", "Delta", "3 legs about a point", "3 planes, 3 spheres"])
def test_as_many_boxes_as_the_degree_are_all(name: str) -> None:
    exact, boxed = solved(name), solve_krawczyk(MECHANISMS[name][0]())
    assert (boxed.method, boxed.claim) == ("krawczyk", Claim.COMPLETE)
    assert [pose.det_sign for pose in boxed.poses] == [pose.det_sign for pose in exact.poses]
    assert np.allclose(positions(boxed), positions(exact), rtol=0, atol=1e-8)


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=lambda motion: motion.name)
def test_start_sections_have_as_many_solutions_as_the_degree(motion: Any) -> None:
    start = generic_start(motion)
    assert (len(start.legs), len(start.solutions)) == (motion.dimension, motion.degree)
    points = start.solutions / np.linalg.norm(start.solutions, axis=1)[:, None]
    quadrics = section_quadrics(start.legs, motion)
    assert np.abs(np.einsum("kij,pi,pj->pk", quadrics, points, points)).max() < 1e-12
    assert np.abs(np.triu(points.conj() @ points.T, 1)).max() < 1 - 1e-8


def test_what_is_not_tracked_is_solved_exactly_at_once() -> None:
    problem = MECHANISMS["3-PRRR, driven in turns"][0]()
    assert not is_tracked(problem)
    solution = solve_krawczyk(problem)
    assert (solution.method, solution.claim) == ("exact", Claim.COMPLETE)
    assert "path tracking" not in solution.statistics.seconds
    assert "as many linear constraints as freedoms" in solution.notes[-1]


def legs_at_a_pose(count: int, metric: tuple[int, int, int] = (1, 1, 1)) -> tuple[Distance, ...]:
    """Legs with the lengths that they have at one pose."""
    some, rotation = Some(77), rotation_of(TURN, metric)
    pairs = [(some.point(), some.point()) for _ in range(count)]
    return tuple(Distance(a, b, distance_squared(a, b, PLACE, rotation, metric)) for a, b in pairs)


@pytest.mark.parametrize(("count", "metric"), [(7, (1, 1, 1)), (8, (1, 3, 2))])
def test_redundant_legs_leave_one_pose(count: int, metric: tuple[int, int, int]) -> None:
    solution = solve(ForwardProblem(legs_at_a_pose(count, metric), metric))
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 1)
    (pose,) = solution.poses
    ordinary = [float(x) * g**0.5 for x, g in zip(PLACE, metric, strict=True)]
    assert np.allclose([float(x.midpoint) for x in pose.position], ordinary)
    assert (pose.multiplicity, pose.det_sign) == (1, None), "a matrix that is not square has no determinant"
    assert pose.condition is not None
    assert pose.condition.lo > 1


def test_the_condition_of_redundant_legs_is_that_of_all_rows() -> None:
    legs = legs_at_a_pose(7)
    (pose,) = solve(ForwardProblem(legs)).poses
    assert pose.jacobian is not None
    c, rotation = np.array(list(map(float, PLACE))), np.array(rotation_of(TURN, (1, 1, 1)), dtype=float)
    rows = []
    for leg in legs:
        arm = rotation @ np.array(list(map(float, leg.platform)))
        line = c + arm - np.array(list(map(float, leg.base)))
        unit = line / np.linalg.norm(line)
        rows.append([*unit, *np.cross(arm, unit) / float(pose.jacobian.length)])
    values = np.linalg.svd(np.array(rows), compute_uv=False)
    assert float(pose.jacobian.sigma_min.midpoint) == pytest.approx(values[-1])
    assert float(pose.condition.midpoint) == pytest.approx(values[0] / values[-1])  # type: ignore[union-attr]


def test_redundant_mechanisms_are_shown_without_a_sign(capsys: pytest.CaptureFixture[str]) -> None:
    legs = legs_at_a_pose(7)
    named = tuple(replace(leg, name=f"leg {k}") for k, leg in enumerate(legs, 1))
    robot = Mechanism("seven legs", "m", "made up for a test", named)
    solution = solve(robot.problem(robot.configuration()))
    print_table(robot, "home", solution, "", ShownPoses.of(robot, "home", solution), verbose=False)
    shown = capsys.readouterr().out
    assert "assembly modes" not in shown
    assert shown.splitlines()[-1].split()[-3:-1] == ["none", "12.06"]


def test_the_mechanism_that_is_a_point_has_a_form_that_is_not_zero() -> None:
    planes = (plane(vector(0, 0, 1), 1, ORIGIN), plane(vector(0, 1, 1), 2, ORIGIN), plane(vector(1, 0, 1), 5, ORIGIN))
    representation = solve(ForwardProblem(planes, motion=TRANSLATION)).representation
    assert representation is not None
    assert representation.univariate.degree == 1
    assert any(representation.separating_form)


def test_a_jacobian_with_equal_rows_and_entries_0_is_enclosed() -> None:
    """A point that is held, and a cylinder whose normal is an axis of coordinates there."""
    held = AtPoint(vector(-2, 0, 0), vector(-1, -1, -1))
    cylinder = AxisDistance(vector(-1, 0, -1), vector(-1, -1, 0), vector(0, -1, 0), Fraction(20))
    solution = solve(ForwardProblem((cylinder, held), (2, 3, 5), TRANSLATION))
    (pose,) = solution.poses
    assert solution.claim == Claim.COMPLETE
    assert pose.condition is not None
    assert pose.condition.lo**2 < 2 < pose.condition.hi**2


def test_a_leg_too_long_is_inconsistent() -> None:
    legs = legs_at_a_pose(7)
    problem = ForwardProblem((*legs[:6], replace(legs[6], length_squared=legs[6].length_squared + 1)))
    solution = solve(problem)
    assert (solution.claim, solution.poses) == (Claim.INCONSISTENT, ())


def test_redundant_planes_of_other_motions() -> None:
    """Four legs on a Schoenflies platform leave 8 poses; a fifth one fits none of them."""
    five = ForwardProblem((*h4().constraints, Some(1).distance()), motion=SCHOENFLIES)
    assert solve(five).claim == Claim.INCONSISTENT


MOVING = {
    "five legs": lambda: ForwardProblem(legs_at_a_pose(5)),
    "two legs in the plane": lambda: ForwardProblem(
        (distance(ORIGIN, vector(1, 0, 0), 9), distance(vector(5, 0, 0), vector(-1, 0, 0), 9)), motion=PLANAR
    ),
    "three planes": lambda: general(3, in_plane=3),
    "three rods on a Schoenflies platform": lambda: ForwardProblem(h4().constraints[:3], motion=SCHOENFLIES),
    "two cylinders with parallel axes": lambda: ForwardProblem(
        tuple(AxisDistance(vector(k, 0, 0), vector(0, 0, 1), ORIGIN, Fraction(4)) for k in range(2)), motion=TRANSLATION
    ),
    "concentric spheres": lambda: ForwardProblem(
        (distance(ORIGIN, ORIGIN, 4), distance(ORIGIN, ORIGIN, 4), distance(vector(1, 0, 0), ORIGIN, 4)),
        motion=TRANSLATION,
    ),
    "no constraint": lambda: ForwardProblem((), motion=TRANSLATION),
}


@pytest.mark.parametrize("name", MOVING)
def test_what_can_move_says_so(name: str) -> None:
    solution = solve(MOVING[name]())
    assert solution.claim == Claim.POSITIVE_DIMENSIONAL_PROVED
    assert solution.self_motion is not None
    assert getattr(solution.self_motion, "real", None) == RealMotion.PROVED


@pytest.mark.parametrize(
    ("problem", "platform", "base"),
    [
        (ForwardProblem(tuple(distance(Some(k).point(), vector(0, 0, k), 30) for k in range(6))), 1, 0),
        (ForwardProblem(tuple(distance(vector(k, 2 * k, 1), Some(k).point(), 30) for k in range(6)), (1, 3, 2)), 0, 1),
        (ForwardProblem(tuple(plane(vector(k, 1, 0), k, Some(k).point()) for k in range(6))), 0, 1),
        (ForwardProblem((AxisDistance(ORIGIN, vector(0, 0, 1), ORIGIN, Fraction(9)),)), 3, 2),
        (general(1, on_line=1), 3, 2),
        (general(2, distance=6), 0, 0),
    ],
)
def test_motions_that_keep_all_constraints_are_counted(problem: ForwardProblem, platform: int, base: int) -> None:
    assert (platform_freedom(problem), base_freedom(problem)) == (platform, base)


def test_signs_need_not_cancel_where_the_map_is_not_proper() -> None:
    planes = (vector(0, 0, 1), vector(0, 1, 1), vector(1, 0, 1))
    problem = ForwardProblem(tuple(plane(normal, 1, ORIGIN) for normal in planes), motion=TRANSLATION)
    assert not has_degree_zero(problem)
    solution = solve(problem)
    assert (solution.claim, [abs(pose.det_sign or 0) for pose in solution.poses]) == (Claim.COMPLETE, [1])


def test_one_leg_makes_signs_cancel() -> None:
    assert has_degree_zero(MECHANISMS["5 planes, 1 sphere"][0]())
    assert not has_degree_zero(MECHANISMS["6 planes"][0]())
    assert not has_degree_zero(ForwardProblem(legs_at_a_pose(7)))
    assert has_degree_zero(MECHANISMS["3 legs about a point"][0]())


def test_a_tangent_pose_counts_twice() -> None:
    touching = (plane(vector(0, 0, 1), 0, ORIGIN), distance(ORIGIN, ORIGIN, 1), distance(vector(2, 0, 0), ORIGIN, 1))
    solution = solve(ForwardProblem(touching, motion=TRANSLATION))
    (pose,) = solution.poses
    assert (solution.claim, pose.multiplicity, pose.det_sign) == (Claim.COMPLETE, 2, 0)
    (note,) = solution.notes
    assert note.startswith("pose 1 is singular, rank 2 of 3: the constraints lose control of 1 degree of freedom,")
    factor, _ = solution.representation.univariate.primitive_polynomial.factor()[1][0]  # type: ignore[union-attr]
    assert singularity(solution.representation, solution.problem, factor).rank == 2  # type: ignore[arg-type]


CODES = ("AFD1", "AFD3", "AFD4", "AFD5", "AFD6")


@pytest.mark.parametrize("code", CODES)
def test_formulations_of_the_displacement_take_any_constraint(code: str) -> None:
    exact = solved("3 lines")
    other = solve(exact.problem, formulation=code)
    assert (other.complex_solutions, [str(p) for p in other.poses]) == (8, [str(p) for p in exact.poses])


@pytest.mark.parametrize(
    ("name", "code", "sentence"),
    [
        (
            "3 lines",
            "AFP1",
            "AFP1 is for six legs of known length, but this robot has a constraint of the type on",
        ),
        ("H4", "AFD4", "AFD4 is for spatial robots, but the motion of this one is schoenflies; use SE3"),
        ("3-RPR, driven in turns", "AFD6", "AFD6 is for spatial robots, but this one is planar; use SE3"),
    ],
)
def test_formulations_refuse_what_they_cannot_write(name: str, code: str, sentence: str) -> None:
    with pytest.raises(InputError, match=sentence):
        solve(MECHANISMS[name][0](), formulation=code)


def test_seven_legs_and_cylinders_are_refused_by_some() -> None:
    with pytest.raises(InputError, match="six legs of known length, but this robot has 7 constraints"):
        solve(ForwardProblem(legs_at_a_pose(7)), formulation="AFP2")
    cylinder = AxisDistance(ORIGIN, vector(1, 2, 3), vector(3, 1, 1), Fraction(30))
    problem = ForwardProblem((*general(1, at_point=1).constraints, *general(2, on_line=1).constraints, cylinder))
    with pytest.raises(InputError, match="linear on rigid motions, but this robot has one of the type axis-distance"):
        solve(problem, formulation="AFD2")
    found = solve(problem)
    assert (found.claim, found.complex_solutions, len(found.poses)) == (Claim.COMPLETE, 8, 2)
    assert [str(pose) for pose in solve(problem, formulation="AFD5").poses] == [str(pose) for pose in found.poses]


def test_questions_about_legs_refuse_other_robots() -> None:
    delta, lines = MECHANISMS["Delta"][0](), MECHANISMS["3 lines"][0]()
    with pytest.raises(InputError, match="3 legs and translation motions"):
        tolerance_boxes(delta, UNIT, solved("Delta"))
    with pytest.raises(InputError, match="is of the type on-line"):
        tolerance_boxes(lines, UNIT, solved("3 lines"))


@pytest.mark.parametrize("lifting", ["newton", "multimodular"])
def test_both_ways_of_lifting(lifting: Any) -> None:
    exact = solved("2-UPS+U")
    other = solve(exact.problem, policy=replace(Policy(), lifting=lifting))
    assert other.poses == exact.poses


@given(st.integers(0, 10**6))
@settings(max_examples=5, deadline=None)
def test_order_and_splitting_do_not_matter(seed: int) -> None:
    exact = solved("3 lines")
    constraints = list(exact.problem.constraints)
    Random(seed).shuffle(constraints)
    split = [part for found in constraints[:1] for part in found.planes((1, 1, 1))]  # type: ignore[attr-defined]
    other = solve(ForwardProblem((*split, *constraints[1:])))
    assert (other.claim, [str(pose) for pose in other.poses]) == (exact.claim, [str(pose) for pose in exact.poses])


@pytest.mark.parametrize("name", ["3 planes of the base, 3 of the platform", "6 planes"])
def test_exchange_of_base_and_platform(name: str) -> None:
    exact = solved(name)
    other = solve(replace(exact.problem, constraints=tuple(found.mirrored() for found in exact.problem.constraints)))
    counts = [(s.claim, s.complex_solutions, len(s.poses)) for s in (exact, other)]
    assert counts[0] == counts[1]


def test_a_turned_platform_turns_the_poses() -> None:
    """Every type of constraint, forms given by coefficients too."""
    rotation = rotation_of(TURN, (1, 3, 1))
    exact = solve(hinged(("13/10", "3/2", "7/5"), "6/5", "7/10"))
    forms = tuple(LinearForm(form) for form in exact.problem.forms)
    for problem in (exact.problem, ForwardProblem(forms, (1, 3, 1))):
        other = solve(moved_platform(problem, rotation))
        assert (other.complex_solutions, len(other.poses)) == (16, 8)
        assert sorted(map(tuple, np.round(positions(other), 6))) == sorted(map(tuple, np.round(positions(exact), 6)))


@pytest.mark.parametrize("type_", [name for name in CONSTRAINTS if name != "axis-distance"])
@pytest.mark.parametrize("metric", [(1, 1, 1), (2, 3, 5)])
def test_forms_in_other_frames_have_the_same_values(type_: str, metric: tuple[int, int, int]) -> None:
    random = Random(5)
    form = tuple(Fraction(random.randint(-9, 9)) for _ in range(17))
    if type_ != "linear":
        some = Some(6)
        made = {name: some.point() for name in CONSTRAINTS[type_].fields}
        numbers = {"length_squared", "offset", "product"}
        values = {name: Fraction(3) if name in numbers else value for name, value in made.items()}
        form = CONSTRAINTS[type_](**values).forms(metric)[0]  # type: ignore[call-arg]
    base, platform, unit = Some(1).point(), Some(2).point(), Fraction(3, 2)
    rotation = rotation_of(TURN, metric)
    moved = [
        unit * c + b - sum((r * a for r, a in zip(row, platform, strict=True)), Fraction(0))
        for c, b, row in zip(PLACE, base, rotation, strict=True)
    ]
    inside = in_frames(form, base, platform, unit, metric)
    assert value_at(inside, PLACE, rotation, metric) == value_at(form, moved, rotation, metric)


def mixed_types() -> ForwardProblem:
    """One constraint of each linear type that takes one freedom, and two legs: 6 equations."""
    some = Some(21)
    cosine = Angle(some.point(), some.point(), Fraction(11))
    sensor = LinearForm(
        (Fraction(0), *some.point(), *some.point(), *some.point(), *some.point(), *some.point(), Fraction(7))
    )
    return ForwardProblem((some.distance(), some.distance(), some.in_plane(), some.carries(), cosine, sensor))


@pytest.mark.slow
def test_rigid_motions_and_units_change_no_claim() -> None:
    exact = solve(mixed_types())
    base, platform, unit = Some(1).point(), Some(2).point(), Fraction(5, 3)
    moved = tuple(LinearForm(in_frames(form, base, platform, unit, (1, 1, 1))) for form in exact.problem.forms)
    other = solve(moved_platform(ForwardProblem(moved), rotation_of(TURN, (1, 1, 1))))
    counts = [(s.claim, s.complex_solutions, s.distinct_solutions, len(s.poses)) for s in (exact, other)]
    assert counts[0] == counts[1]
    assert len(exact.poses) > 0
    rotations = exact.to_numpy().rotation
    a, b = (np.array(list(map(float, point))) for point in (platform, base))
    expected = (positions(exact) + rotations @ a - b) / float(unit)
    assert np.allclose(sorted(map(tuple, positions(other))), sorted(map(tuple, expected)), atol=1e-6)
