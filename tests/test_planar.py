"""Planar robots: published poses, known poses found again, and the same answer in every frame."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from math import cos, degrees, isclose, sin
from pathlib import Path
from random import Random

import pytest
from budgets import budget
from hypothesis import given
from hypothesis import strategies as st
from samples import root, solved

from pkm_exact.claim import Claim
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.engine import solve
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import Crank, cosine_and_sine
from pkm_exact.geometry.inverse import Metric, distance_squared, dot
from pkm_exact.geometry.planar_rotation import quarter_turn, turn_of, weight
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.reader import read_robot
from pkm_exact.geometry.robot import Robot
from pkm_exact.geometry.working_modes import CrankMode, platform_point, working_modes
from pkm_exact.motions.motion_groups import PLANAR
from pkm_exact.poses.planar_coordinates import angle_in_degrees, planar_coordinates
from pkm_exact.poses.pose import Interval, Pose
from pkm_exact.solution import Solution

SHAPES = ("general", "collinear", "similar", "congruent", "coincident")
METRICS = [(1, 1, 1), (1, 3, 1), (2, 5, 7)]
seeds = st.integers(0, 10**9)
small = st.fractions(min_value=-4, max_value=4, max_denominator=6)


def _contains(pose: Pose, x: Fraction | int, y: Fraction | int, c: Fraction | int, s: Fraction | int) -> bool:
    values = map(Fraction, (x, y, c, s))
    return all(box.contains(value) for box, value in zip(planar_coordinates(pose).values(), values, strict=True))


def _half_tangent(pose: Pose) -> Interval:
    """Bounds for tan(theta / 2) = sin / (1 + cos), at a pose away from 180 degrees."""
    box = planar_coordinates(pose)
    ends = [s / (1 + c) for s in (box["sin"].lo, box["sin"].hi) for c in (box["cos"].lo, box["cos"].hi)]
    return Interval(min(ends), max(ends))


def _value(coefficients: Sequence[int], t: Fraction) -> Fraction:
    return sum((c * t**k for k, c in enumerate(reversed(coefficients))), Fraction(0))


def test_the_published_robot_has_its_two_poses() -> None:
    solution = solved("3-rpr-merlet-p")
    assert (solution.claim, solution.complex_solutions, solution.distinct_solutions) == (Claim.COMPLETE, 6, 6)
    turned, straight = solution.poses
    assert _contains(straight, 5, 5, 1, 0)
    angle = -0.806783438025
    printed = (3.369707130606, 6.216516215208, cos(angle), sin(angle))
    for box, value in zip(planar_coordinates(turned).values(), printed, strict=True):
        assert box.width <= Fraction(1, 10**9)
        assert isclose(box.midpoint, value, abs_tol=1e-9)
    quintic = (3844, -737, 1563, 273, 139, 210)
    t = _half_tangent(turned)
    assert _value(quintic, t.lo) * _value(quintic, t.hi) < 0
    assert [pose.jacobian.det_sign for pose in solution.poses if pose.jacobian] == [-1, 1]


def test_the_singular_robot_has_one_double_pose() -> None:
    solution = solved("3-rpr-double-q")
    assert (solution.claim, solution.complex_solutions, solution.distinct_solutions) == (Claim.COMPLETE, 6, 5)
    (pose,) = solution.poses
    assert _contains(pose, 0, 0, 1, 0)
    assert pose.multiplicity == 2
    assert pose.jacobian is not None
    assert (pose.jacobian.det_sign, pose.jacobian.rank, pose.jacobian.condition) == (0, 2, None)


@pytest.mark.parametrize("name", ["3-rrr", "3-prr"])
def test_six_real_poses(name: str) -> None:
    solution = solved(name)
    assert (solution.claim, solution.complex_solutions, len(solution.poses)) == (Claim.COMPLETE, 6, 6)
    for pose in solution.poses:
        assert all(box.contains(Fraction(0)) for box in (pose.position[2], pose.rotation[0][2], pose.rotation[2][1]))
        assert pose.rotation[2][2].contains(Fraction(1))


def _point(random: Random, size: int = 9) -> Vector:
    x, y = (Fraction(random.randint(-size, size), random.randint(1, 3)) for _ in range(2))
    return x, y, Fraction(0)


def _shaped(shape: str, random: Random) -> tuple[list[Vector], list[Vector]]:
    base, platform = [_point(random) for _ in range(3)], [_point(random, 5) for _ in range(3)]
    if shape == "collinear":
        base = [(x, Fraction(0), z) for x, _, z in base]
        platform = [(x, 2 * x, z) for x, _, z in platform]
    elif shape == "similar":
        platform = [(x / 2, y / 2, z) for x, y, z in base]
    elif shape == "congruent":
        platform = list(base)
    elif shape == "coincident":
        platform[1] = platform[0]
    return base, platform


def _placed(shape: str, seed: int, metric: Metric) -> tuple[ForwardProblem, Vector, tuple[Fraction, Fraction]]:
    """A robot, and a pose of it: position, and c and s in the metric."""
    random = Random(seed)
    turn = cosine_and_sine(Fraction(random.randint(-9, 9), random.randint(1, 5)), weight(metric))
    while True:
        base, platform = _shaped(shape, random)
        position = _point(random)
        rotation = turn_of(turn, metric)
        pairs = zip(base, platform, strict=True)
        legs = tuple(Distance(a, b, distance_squared(a, b, position, rotation, metric)) for a, b in pairs)
        if all(leg.length_squared for leg in legs) and len({(leg.base, leg.platform) for leg in legs}) == 3:
            return ForwardProblem(legs, metric, motion=PLANAR), position, turn


def _is_among(solution: Solution, position: Vector, turn: tuple[Fraction, Fraction]) -> bool:
    """Whether some box meets the narrow box of a pose given in the coordinates of the metric."""
    metric = solution.problem.metric
    factors = (root(metric[0]), root(metric[1]), root(1), root(weight(metric)))
    known = []
    for value, factor in zip((position[0], position[1], *turn), factors, strict=True):
        ends = sorted((value * factor.lo, value * factor.hi))
        known.append(Interval(*ends))
    return any(
        all(box.overlaps(value) for box, value in zip(planar_coordinates(pose).values(), known, strict=True))
        for pose in solution.poses
    )


@pytest.mark.parametrize("shape", SHAPES)
@budget(6)
@given(seed=seeds, metric=st.sampled_from(METRICS))
def test_a_known_pose_is_found_again(shape: str, seed: int, metric: Metric) -> None:
    problem, position, turn = _placed(shape, seed, metric)
    solution = solve(problem)
    if solution.claim in (Claim.POSITIVE_DIMENSIONAL_DETECTED, Claim.POSITIVE_DIMENSIONAL_PROVED):
        assert shape != "general"
        return
    assert solution.claim is Claim.COMPLETE
    assert 1 <= len(solution.poses) <= solution.complex_solutions <= 6
    assert _is_among(solution, position, turn)


def _moved(joint: Vector, turn: tuple[Fraction, Fraction], shift: Vector, metric: Metric) -> Vector:
    return platform_point(joint, shift, turn_of(turn, metric))


def _relatives(problem: ForwardProblem, random: Random) -> dict[str, ForwardProblem]:
    """The same robot in other frames and units, with legs renumbered, and with base and platform swapped."""
    metric, legs = problem.metric, problem.distances
    turn = cosine_and_sine(Fraction(random.randint(-5, 5), 3), weight(metric))
    shift = _point(random)
    k = Fraction(random.randint(1, 9), 4)
    changed = {
        "base": [replace(leg, base=_moved(leg.base, turn, shift, metric)) for leg in legs],
        "platform": [replace(leg, platform=_moved(leg.platform, turn, shift, metric)) for leg in legs],
        "order": random.sample(legs, 3),
        "swap": [Distance(leg.platform, leg.base, leg.length_squared) for leg in legs],
        "scale": [Distance(_times(k, leg.base), _times(k, leg.platform), k * k * leg.length_squared) for leg in legs],
    }
    return {name: replace(problem, constraints=tuple(rows)) for name, rows in changed.items()}


def _times(k: Fraction, joint: Vector) -> Vector:
    x, y, z = (k * value for value in joint)
    return x, y, z


@pytest.mark.parametrize("shape", SHAPES)
@budget(2)
@given(seed=seeds, metric=st.sampled_from(METRICS))
def test_the_answer_does_not_depend_on_the_frame(shape: str, seed: int, metric: Metric) -> None:
    problem, _, _ = _placed(shape, seed, metric)
    solution = solve(problem)
    facts = _facts(solution)
    for name, relative in _relatives(problem, Random(seed)).items():
        assert _facts(solve(relative)) == facts, name


def _facts(solution: Solution) -> tuple[Claim, int, int, list[int | None]]:
    multiplicities = sorted((pose.multiplicity for pose in solution.poses), key=str)
    return solution.claim, solution.complex_solutions, solution.distinct_solutions, multiplicities


def test_poses_move_with_the_base() -> None:
    problem = solved("3-rpr-merlet-p").problem
    turn, shift = (Fraction(3, 5), Fraction(4, 5)), (Fraction(7), Fraction(-2), Fraction(0))
    legs = tuple(replace(leg, base=_moved(leg.base, turn, shift, (1, 1, 1))) for leg in problem.distances)
    solution = solve(replace(problem, constraints=legs))
    position = _moved((Fraction(5), Fraction(5), Fraction(0)), turn, shift, (1, 1, 1))
    assert _is_among(solution, position, turn)


@given(st.tuples(*[small] * 3), st.tuples(small, small), small, seeds)
@budget(8)
def test_cranks_at_a_pose_lead_back_to_it(
    tangents: tuple[Fraction, ...], place: tuple[Fraction, Fraction], t: Fraction, seed: int
) -> None:
    random = Random(seed)
    position, turn = (*place, Fraction(0)), cosine_and_sine(t)
    feet, joints = [_point(random) for _ in range(3)], [_point(random, 4) for _ in range(3)]
    ends = [platform_point(joint, position, turn_of(turn, (1, 1, 1))) for joint in joints]
    values = [cosine_and_sine(tangent) for tangent in tangents]
    cranks = []
    for foot, end, value in zip(feet, ends, values, strict=True):
        knee = Crank((2, 0, 0), (0, 2, 0), 1).knee(foot, value)  # type: ignore[arg-type]
        rod = (knee[0] - end[0]) ** 2 + (knee[1] - end[1]) ** 2
        if rod == 0:
            return
        cranks.append(Crank((2, 0, 0), (0, 2, 0), rod))  # type: ignore[arg-type]
    robot = Robot("r", "3-RRR", "m", "s", tuple(feet), tuple(joints), chains=tuple(cranks))
    try:
        locked = robot.lock("home", values)
    except InputError as error:
        assert "join the same two points" in str(error)
        return
    solution = solve(robot.problem(locked))
    if solution.claim is Claim.COMPLETE:
        assert _is_among(solution, position, turn)
    for crank, foot, end, value in zip(cranks, feet, ends, values, strict=True):
        modes = working_modes(crank, foot, end, robot.metric)
        found = [(mode.cos.p, mode.sin.p) for mode in modes if isinstance(mode, CrankMode)]
        assert value in found or not found


@given(st.tuples(small, small), st.sampled_from([(1, 1, 1), (1, 4, 1), (2, 8, 1)]))
def test_a_quarter_turn_is_perpendicular_and_as_long(place: tuple[Fraction, Fraction], metric: Metric) -> None:
    vector = (*place, Fraction(0))
    turned = quarter_turn(vector, metric, "x")
    assert dot(vector, turned, metric) == 0
    assert dot(vector, vector, metric) == dot(turned, turned, metric)
    assert vector[0] * turned[1] >= vector[1] * turned[0]


@given(st.integers(-3600, 3600), st.integers(2, 60))
def test_angles_are_enclosed(tenths: int, bits: int) -> None:
    angle = tenths / 573  # about -6.3 to 6.3 in radians
    scale = 1 << bits
    c, s = (Interval(Fraction(int(v * scale) - 1, scale), Fraction(int(v * scale) + 1, scale)) for v in _unit(angle))
    found = angle_in_degrees(c, s)
    if found is None:
        assert bits < 3
        return
    assert any(found.lo - 1e-9 <= degrees(angle) + 360 * k <= found.hi + 1e-9 for k in (-2, -1, 0, 1, 2))
    assert found.width < 400 / scale
    assert -181 - 180 / scale * 4 < found.midpoint < 181 + 180 / scale * 4


def _unit(angle: float) -> tuple[float, float]:
    return cos(angle), sin(angle)


@pytest.mark.parametrize("digits", [17, 18, 20, 40])
@pytest.mark.parametrize(("sign", "count"), [(1, 2), (-1, 0)])
def test_poses_beside_a_double_one_are_told_apart(digits: int, sign: int, count: int) -> None:
    """Short fractions fit the residues of such nearly dependent coefficients before the right ones do."""
    robot = read_robot(Path(__file__).parent.parent / "models" / "3-rpr-double-q.toml")
    squares = list(robot.configuration().lengths_squared)
    squares[0] += sign * Fraction(1, 10**digits)
    solution = solve(robot.problem(squares))
    assert (solution.claim, solution.complex_solutions, len(solution.poses)) == (Claim.COMPLETE, 6, count)


@pytest.mark.parametrize("power", [30, 40, 200])
def test_legs_of_very_different_lengths_have_an_answer(power: int) -> None:
    corners = ((0, 0), (10, 0), (3, 10)), ((0, 0), (4, 0), (2, 2))
    base, platform = (tuple(tuple(map(Fraction, joint)) for joint in side) for side in corners)
    robot = Robot("long leg", "3-RPR", "m", "made up", base, platform)  # type: ignore[arg-type]
    solution = solve(robot.problem([(2**power + 1) ** 2, 25, 25]))
    assert (solution.claim, len(solution.poses)) == (Claim.COMPLETE, 0)
