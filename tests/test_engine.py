"""The engine end to end: known counts and poses, agreement of the formulations, and robots that are not generic."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from random import Random

import pytest
from flint import fmpq, fmpq_mat
from samples import CODES, Placed, leg_length_squared, placed, random_vector, shipped, solved

from pkm_exact.claim import Claim, CompletenessRoute
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.engine import solve
from pkm_exact.errors import InputError
from pkm_exact.formulations.registry import formulation_codes
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.policy import Policy
from pkm_exact.poses.pose import Interval, Pose

# Complex solutions with multiplicity, distinct ones, real poses.
COUNTS = {
    "rolland-6-6": (40, 40, 16),
    "dietmaier": (40, 40, 40),
    "mourrain-l": (40, 40, 4),
    "similar-planar-s": (16, 16, 8),
    "robocrane-r": (16, 16, 4),
}
SMALL = ("mourrain-l", "similar-planar-s", "robocrane-r")
LARGE = ("robocrane-r", "rolland-6-6", "dietmaier")
ZERO, ONE = Fraction(0), Fraction(1)


def _near(value: str, digits: int) -> Interval:
    """The numbers that a decimal rounded to ``digits`` places may stand for."""
    margin = Fraction(1, 10**digits)
    return Interval(Fraction(value) - margin, Fraction(value) + margin)


def _holds(pose: Pose, position: Vector, rotation: tuple[Vector, ...]) -> bool:
    places = zip(pose.position, position, strict=True)
    rows = zip(pose.rotation, rotation, strict=True)
    entries = [pair for row, line in rows for pair in zip(row, line, strict=True)]
    return all(box.contains(value) for box, value in [*places, *entries])


@pytest.mark.parametrize("name", COUNTS)
def test_known_counts(name: str) -> None:
    solution = solved(name)
    complex_solutions, distinct, real = COUNTS[name]
    assert (solution.complex_solutions, solution.distinct_solutions, len(solution.poses)) == (
        complex_solutions,
        distinct,
        real,
    )
    if distinct == 40:
        assert solution.claim is Claim.COMPLETE
        assert solution.completeness_route is CompletenessRoute.REFINED_BEZOUT
        assert solution.notes == ()


@pytest.mark.parametrize("name", COUNTS)
def test_every_box_allows_the_given_lengths(name: str) -> None:
    problem = shipped(name)
    for pose in solved(name).poses:
        for leg in problem.distances:
            length = leg_length_squared(leg, problem.metric, pose)
            assert length.contains(leg.length_squared)


@pytest.mark.parametrize("name", COUNTS)
def test_boxes_are_narrow_and_apart(name: str) -> None:
    solution = solved(name)
    coordinates = [[*pose.position, *(entry for row in pose.rotation for entry in row)] for pose in solution.poses]
    for i, boxes in enumerate(coordinates):
        assert all(box.width <= Fraction(1, 10**9) for box in [*boxes, *solution.poses[i].quaternion])
        for others in coordinates[:i]:
            assert any(not box.overlaps(other) for box, other in zip(boxes, others, strict=True))
        assert sum(box.lo**2 <= 1 for row in solution.poses[i].rotation for box in row) == 9


def _boxes(name: str, code: str) -> set[tuple[object, object]]:
    solution = solved(name, code)
    return {(solution.box_exponent, (pose.position, pose.rotation)) for pose in solution.poses}


@pytest.mark.parametrize("code", CODES[1:])
@pytest.mark.parametrize("name", [*SMALL[:2], *(pytest.param(name, marks=pytest.mark.slow) for name in LARGE)])
def test_formulations_agree_box_by_box(name: str, code: str) -> None:
    assert _boxes(name, code) == _boxes(name, "SE3")
    ours, reference = solved(name, code), solved(name)
    assert ours.formulation == code
    assert ours.complex_solutions == reference.complex_solutions
    assert ours.distinct_solutions == reference.distinct_solutions
    assert ours.claim == reference.claim


@pytest.mark.slow
@pytest.mark.parametrize("code", [code for code in formulation_codes() if code not in CODES])
@pytest.mark.parametrize("name", ["similar-planar-s", "robocrane-r"])
def test_the_other_formulations_agree_too(name: str, code: str) -> None:
    assert _boxes(name, code) == _boxes(name, "SE3")


def test_published_positions_of_l() -> None:
    published = [
        ("-0.5553828298", "-0.0129902855", "-0.8314933342"),
        ("-0.2742689528", "-0.3449467452", "-0.8976571085"),
        ("0.2719987020", "0.9583636519", "0.0869242018"),
        ("0.3557683959", "0.9001773125", "0.2512163500"),
    ]
    poses = solved("mourrain-l").poses
    for position in published:
        near = [_near(value, 10) for value in position]
        assert sum(all(a.overlaps(b) for a, b in zip(pose.position, near, strict=True)) for pose in poses) == 1


def test_published_quaternions_of_s() -> None:
    sizes = ("0.8980265101", "0.1796053020", "0.3592106041", "0.1796053020")
    for pose in solved("similar-planar-s").poses:
        for entry, size in zip(pose.quaternion, sizes, strict=True):
            assert _near(size, 10).overlaps(entry) or _near(f"-{size}", 10).overlaps(entry)


def test_the_pose_that_gave_s_its_lengths_is_found() -> None:
    rotation = rotation_of((Fraction(5), ONE, Fraction(-2), ONE))
    position = (Fraction(1, 2), Fraction(-1, 3), Fraction(7, 4))
    assert sum(_holds(pose, position, rotation) for pose in solved("similar-planar-s").poses) == 1


def test_published_poses_of_the_linapod() -> None:
    slides = ["0.025 0.886", "-0.780 -0.421", "0.755 -0.465", "-0.025 0.886", "-0.755 -0.465", "0.780 -0.421"]
    joints = ["-0.126 0.180 0.2", "-0.093 -0.199 0.2", "0.219 0.019 0.2"]
    joints += ["0.115 0.164 0.4", "-0.199 0.017 0.4", "0.085 -0.181 0.4"]
    legs = []
    for i in range(6):
        x, y = map(Fraction, slides[i].split())
        b1, b2, b3 = map(Fraction, joints[i].split())
        slide, bar = (Fraction("1.221"), Fraction("1.25")) if i < 3 else (Fraction("1.933"), Fraction("1.70"))
        legs.append(Distance((x, y, slide), (b1, b2, b3), bar * bar))
    solution = solve(ForwardProblem(tuple(legs)))
    assert (solution.complex_solutions, len(solution.poses)) == (40, 2)
    assert solution.claim is Claim.COMPLETE
    for position in (("-0.0000710", "-0.0000830", "0.000457"), ("0.000246", "-0.000501", "0.225342")):
        near = [_near(value, 6) for value in position]
        assert sum(all(a.overlaps(b) for a, b in zip(pose.position, near, strict=True)) for pose in solution.poses) == 1


def test_a_random_robot_is_found_where_it_was_placed() -> None:
    random = Random(6)
    joints = [random_vector(random, 3) for _ in range(12)]
    robot = placed(joints[:6], joints[6:], random_vector(random, 3), (ONE, -ONE, Fraction(2), ONE))
    poses = solve(robot.problem).poses
    assert sum(_holds(pose, robot.position, robot.rotation) for pose in poses) == 1


def test_a_half_turn_is_not_lost() -> None:
    # At a half turn e0 = 0: the first chart does not hold this pose.
    random = Random(8)
    joints = [random_vector(random, 2) for _ in range(12)]
    robot = placed(joints[:6], joints[6:], random_vector(random, 2), (ZERO, ONE, ZERO, ZERO))
    solution = solve(robot.problem)
    assert solution.representation is not None
    assert solution.representation.chart != (1, 0, 0, 0)
    assert sum(_holds(pose, robot.position, robot.rotation) for pose in solution.poses) == 1


@pytest.mark.parametrize("name", ["robocrane-r", "similar-planar-s"])
def test_both_ways_of_lifting_agree(name: str) -> None:
    other = solve(shipped(name), policy=Policy(lifting="multimodular"))
    assert other.representation == solved(name).representation
    assert other.poses == solved(name).poses
    assert len(other.statistics.primes) > len(solved(name).statistics.primes)


@pytest.mark.parametrize("name", SMALL)
def test_the_seed_does_not_matter(name: str) -> None:
    other = solve(shipped(name), policy=Policy(seed=1))
    assert {(pose.position, pose.rotation) for pose in other.poses} == {
        (pose.position, pose.rotation) for pose in solved(name).poses
    }


def test_a_width_is_kept() -> None:
    width = Fraction(1, 10**60)
    poses = solve(shipped("robocrane-r"), width=width).poses
    for fine, coarse in zip(poses, solved("robocrane-r").poses, strict=True):
        assert all(a.width <= width and a.overlaps(b) for a, b in zip(fine.position, coarse.position, strict=True))


@pytest.mark.parametrize("name", SMALL)
def test_the_order_of_the_legs_does_not_matter(name: str) -> None:
    problem = shipped(name)
    legs = list(problem.distances)
    Random(9).shuffle(legs)
    other = solve(replace(problem, constraints=tuple(legs)))
    assert other.complex_solutions == solved(name).complex_solutions
    assert {(pose.position, pose.rotation) for pose in other.poses} == {
        (pose.position, pose.rotation) for pose in solved(name).poses
    }


@pytest.mark.parametrize("name", SMALL)
def test_base_and_platform_may_change_places(name: str) -> None:
    problem = shipped(name)
    legs = tuple(Distance(leg.platform, leg.base, leg.length_squared) for leg in problem.distances)
    other = solve(replace(problem, constraints=legs))
    assert other.complex_solutions == solved(name).complex_solutions
    assert other.distinct_solutions == solved(name).distinct_solutions
    # The rotations are transposed; the positions are -R^T C.
    places = [(i, j) for i in range(3) for j in range(3)]
    for pose in solved(name).poses:
        mates = [new for new in other.poses if all(pose.rotation[i][j].overlaps(new.rotation[j][i]) for i, j in places)]
        assert len(mates) == sum(pose.rotation == twin.rotation for twin in solved(name).poses)


def test_a_scaled_and_moved_robot_has_the_scaled_poses() -> None:
    problem, scale = shipped("mourrain-l"), Fraction(3, 2)
    shift = (Fraction(1), Fraction(-2), Fraction(1, 3))
    legs = []
    for leg in problem.distances:
        a1, a2, a3 = (scale * a + c for a, c in zip(leg.base, shift, strict=True))
        b1, b2, b3 = (scale * b for b in leg.platform)
        legs.append(Distance((a1, a2, a3), (b1, b2, b3), scale**2 * leg.length_squared))
    other = solve(replace(problem, constraints=tuple(legs)))
    for pose in solved("mourrain-l").poses:
        moved = [Interval(scale * box.lo + c, scale * box.hi + c) for box, c in zip(pose.position, shift, strict=True)]
        assert sum(all(a.overlaps(b) for a, b in zip(moved, new.position, strict=True)) for new in other.poses) == 1


def _singular(seed: int, *, merged: bool) -> Placed:
    """A robot at a pose in which its legs have a common infinitesimal motion.

    The sixth leg is laid orthogonal to the velocity of its platform joint under the motion that the other five legs
    leave. With ``merged`` the platform is a triangle (16 solutions in general instead of 40).
    """
    random = Random(seed)
    quaternion = (Fraction(2), ONE, ZERO, -ONE)
    corners = [random_vector(random, 3) for _ in range(6)]
    platform = [corners[i // 2 if merged else i] for i in range(6)]
    base = [random_vector(random, 3) for _ in range(6)]
    position, rotation = random_vector(random, 2), rotation_of(quaternion)
    points = [
        [position[i] + sum(r * b for r, b in zip(rotation[i], joint, strict=True)) for i in range(3)]
        for joint in platform
    ]
    rows = []
    for joint, point in zip(base[:5], points[:5], strict=True):
        d = [p - a for p, a in zip(point, joint, strict=True)]
        rows.append([*d, *_cross(point, d)])
    matrix = fmpq_mat([[fmpq(value.numerator, value.denominator) for value in row] for row in rows])
    echelon, rank = matrix.rref()
    assert rank == 5
    pivots = [next(j for j in range(6) if echelon[i, j] != 0) for i in range(5)]
    free = next(j for j in range(6) if j not in pivots)
    twist = [ONE] * 6
    for i, pivot in enumerate(pivots):
        twist[pivot] = -Fraction(int(echelon[i, free].p), int(echelon[i, free].q))
    linear, angular = twist[:3], twist[3:]
    velocity = [v + w for v, w in zip(linear, _cross(angular, points[5]), strict=True)]
    direction = _cross(velocity, [ONE, Fraction(2), Fraction(-1)])
    scale = 3 / max(abs(value) for value in direction)
    x, y, z = (p - scale * d for p, d in zip(points[5], direction, strict=True))
    base[5] = (x, y, z)
    return placed(base, platform, position, quaternion)


def _cross(left: Sequence[Fraction], right: Sequence[Fraction]) -> list[Fraction]:
    return [left[(i + 1) % 3] * right[(i + 2) % 3] - left[(i + 2) % 3] * right[(i + 1) % 3] for i in range(3)]


def _check_double_pose(robot: Placed, total: int) -> None:
    """One pose of multiplicity two, all others simple: a proof of completeness has to say so."""
    solution = solve(robot.problem)
    assert (solution.complex_solutions, solution.distinct_solutions) == (total, total - 1)
    assert solution.completeness_route is not CompletenessRoute.REFINED_BEZOUT
    found = [pose for pose in solution.poses if _holds(pose, robot.position, robot.rotation)]
    assert len(found) == 1
    if solution.claim is Claim.COMPLETE:
        assert [pose.multiplicity for pose in solution.poses if pose is not found[0]] == [1] * (len(solution.poses) - 1)
        assert found[0].multiplicity == 2
    else:
        assert solution.claim is Claim.NOT_PROVEN_COMPLETE
        assert len(solution.notes) == 1


def test_a_double_pose_of_a_triangular_platform() -> None:
    _check_double_pose(_singular(1, merged=True), 16)


@pytest.mark.slow
def test_a_double_pose_of_a_general_robot() -> None:
    _check_double_pose(_singular(2, merged=False), 40)


def test_equal_hexagons_with_equal_legs_move() -> None:
    joints = [(2, 0), (1, 2), (-1, 2), (-2, 0), (-1, -2), (1, -2)]
    ring = [(Fraction(x), Fraction(y), ZERO) for x, y in joints]
    solution = solve(placed(ring, ring, (ZERO, ZERO, Fraction(3)), (ONE, ZERO, ZERO, ZERO)).problem)
    assert solution.claim in {Claim.POSITIVE_DIMENSIONAL_DETECTED, Claim.POSITIVE_DIMENSIONAL_PROVED}
    assert solution.poses == ()
    assert solution.representation is None


@pytest.mark.parametrize("code", CODES)
def test_legs_that_contradict_each_other_have_no_pose(code: str) -> None:
    legs = list(shipped("mourrain-l").distances)
    legs[1] = Distance(legs[0].base, legs[0].platform, legs[0].length_squared + 1)
    solution = solve(ForwardProblem(tuple(legs)), formulation=code)
    assert solution.poses == ()
    assert solution.claim is not Claim.COMPLETE


def test_legs_too_short_to_reach_have_complex_poses_only() -> None:
    legs = tuple(replace(leg, length_squared=Fraction(1, 100)) for leg in shipped("mourrain-l").distances)
    solution = solve(ForwardProblem(legs))
    assert (solution.complex_solutions, len(solution.poses)) == (40, 0)
    assert solution.claim is Claim.COMPLETE


def test_stages_are_reported_in_order() -> None:
    stages: list[str] = []
    solution = solve(shipped("robocrane-r"), progress=stages.append)
    assert stages[:3] == ["self-motion", "numeric lifting", "formulation"]
    assert stages[-1] == "Jacobians"
    assert set(solution.statistics.seconds) == set(stages)
    assert str(solution).startswith("16 complex solutions, 4 real poses")


def test_an_unknown_formulation_is_refused() -> None:
    with pytest.raises(InputError, match="is unknown"):
        solve(shipped("robocrane-r"), formulation="AFD9")


def test_an_unknown_formulation_is_refused_even_where_none_is_needed() -> None:
    origin = (Fraction(0),) * 3
    problem = ForwardProblem(tuple(Distance(origin, origin, Fraction(1)) for _ in range(6)))
    with pytest.raises(InputError, match="is unknown"):
        solve(problem, formulation="AFD9")


@pytest.mark.parametrize("name", ["3-rpr-merlet-p", "mssm"])
def test_a_representation_is_verified_for_all_its_legs_and_no_others(name: str) -> None:
    representation, problem = solved(name).representation, shipped(name)
    assert representation is not None
    assert representation.is_verified(problem)
    for changed in range(len(problem.constraints)):
        legs = [
            replace(leg, length_squared=leg.length_squared + (place == changed))
            for place, leg in enumerate(problem.distances)
        ]
        assert not representation.is_verified(ForwardProblem(tuple(legs), problem.metric, problem.motion))
