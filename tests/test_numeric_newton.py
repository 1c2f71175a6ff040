"""The uncertified iterations: where they end, that the numbers they start from are right, and that they say why."""

import pickle
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import partial
from math import sqrt
from multiprocessing import active_children
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from samples import METRICS, MODELS, Placed, random_placed, shipped, solved

from pkm_exact.constraints.distance import Distance
from pkm_exact.engine import solve
from pkm_exact.errors import InputError, PkmExactError, ReconstructionError
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.reader import read_robot
from pkm_exact.geometry.robot import Robot
from pkm_exact.numeric.fallback import _packed, solve_within
from pkm_exact.numeric.home import distance_squared, home_pose, random_states
from pkm_exact.numeric.levenberg_marquardt import (
    DescentPolicy,
    distinct_poses,
    levenberg_marquardt,
    solve_levenberg_marquardt,
)
from pkm_exact.numeric.newton_iteration import (
    NewtonPolicy,
    NotConvergedError,
    newton,
    solve_newton,
)
from pkm_exact.numeric.numeric_machine import StartPose, centred, placed
from pkm_exact.numeric.numeric_robot import NumericRobot, numeric_robot, transposed_jacobian
from pkm_exact.numeric.quaternions import rotation_matrix, turned
from pkm_exact.numeric.uncertified import Ending, NumericPose, UncertifiedSolution
from pkm_exact.solution import Solution

NAMES = [path.stem for path in MODELS if isinstance(read_robot(path), Robot)]
"""Newton's method is for legs of known length."""
IDENTITY = (1.0, 0.0, 0.0, 0.0)


def ordinary(found: Placed) -> tuple[np.ndarray, np.ndarray]:
    """The known pose in ordinary coordinates."""
    scales = np.sqrt(np.array(found.problem.metric, dtype=float))
    rotation = np.array([[float(x) for x in row] for row in found.rotation])
    return scales * [float(x) for x in found.position], scales[:, None] * rotation / scales


def near(robot: NumericRobot, position: np.ndarray, rotation: np.ndarray, step: float) -> StartPose:
    """A start beside a pose, by about ``step`` sizes of the robot."""
    trace = np.trace(rotation)
    q0 = sqrt(max(1 + trace, 0)) / 2
    vector = np.array(
        [rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]]
    )
    quaternion = turned((q0, *(vector / (4 * q0))), (step, -step, step))
    x, y, z = position + step * robot.unit * np.array([1, -1, 1]) / 2
    q0, q1, q2, q3 = map(float, quaternion)
    return StartPose((float(x), float(y), float(z)), (q0, q1, q2, q3))


def moved(problem: ForwardProblem, factor: Fraction, shift: Fraction) -> ForwardProblem:
    """The robot scaled, then its base moved along all axes."""
    legs = []
    for leg in problem.distances:
        x, y, z = (factor * value + shift for value in leg.base)
        b1, b2, b3 = (factor * value for value in leg.platform)
        legs.append(Distance((x, y, z), (b1, b2, b3), leg.length_squared * factor**2))
    return ForwardProblem(tuple(legs), problem.metric, problem.motion)


def with_lengths(problem: ForwardProblem, squares: list[Fraction]) -> ForwardProblem:
    legs = (replace(leg, length_squared=square) for leg, square in zip(problem.distances, squares, strict=True))
    return ForwardProblem(tuple(legs), problem.metric, problem.motion)


@settings(max_examples=40)
@given(seed=st.integers(0, 10**6), metric=st.sampled_from(METRICS))
def test_newton_returns_to_a_known_pose(seed: int, metric: tuple[int, int, int]) -> None:
    random = Random(seed)
    quaternion = [Fraction(9), *(Fraction(random.randint(-9, 9), 3) for _ in range(3))]
    found = random_placed(random, quaternion, metric)
    robot = numeric_robot(found.problem)
    position, rotation = ordinary(found)
    c, q = centred(robot, near(robot, position, rotation, 0.0))
    arms = rotation_matrix(q) @ robot.platform
    lines = arms + c[:, None] - robot.base
    jacobian = transposed_jacobian(arms, lines, robot.lengths)
    least = np.linalg.svd(jacobian, compute_uv=False)[-1]
    pose = newton(robot, near(robot, position, rotation, min(1e-3, 1e-2 * least)))
    if least < 1e-3:  # nearly singular: where it goes is not known
        return
    assert pose.converged
    assert pose.iterations <= 8
    assert np.abs(np.array(pose.position) - position).max() <= 1e-11 * robot.unit / least
    assert np.abs(np.array(pose.rotation) - rotation).max() <= 1e-11 / least
    assert np.abs(np.array(pose.rotation) - rotation_matrix(pose.quaternion)).max() < 1e-15
    assert pose.quaternion[0] >= 0


@given(seed=st.integers(0, 10**6))
def test_the_jacobian_is_the_derivative_of_the_lengths(seed: int) -> None:
    generator = np.random.default_rng(seed)
    base, platform, c = generator.normal(size=(3, 6)), generator.normal(size=(3, 6)), generator.normal(size=3)
    q = tuple(generator.normal(size=4))
    q = turned(q, (0.0, 0.0, 0.0))
    step, size = generator.normal(size=6), 1e-6

    def lengths(h: float) -> np.ndarray:
        rotation = rotation_matrix(turned(q, h * step[3:]))
        return np.linalg.norm(rotation @ platform + (c + h * step[:3])[:, None] - base, axis=0)

    arms = rotation_matrix(q) @ platform
    lines = arms + c[:, None] - base
    jacobian = transposed_jacobian(arms, lines, lengths(0.0))
    assert step @ jacobian == pytest.approx((lengths(size) - lengths(-size)) / (2 * size), abs=1e-7)
    stacked = transposed_jacobian(np.stack([arms, -arms]), np.stack([lines, lines]), np.stack([lengths(0.0)] * 2))
    assert stacked[0] == pytest.approx(jacobian)


@given(seed=st.integers(0, 10**6))
def test_turning_is_the_exponential(seed: int) -> None:
    generator = np.random.default_rng(seed)
    q, w = turned(tuple(generator.normal(size=4)), (0, 0, 0)), generator.normal(size=3)
    once, twice = rotation_matrix(turned(q, w)), rotation_matrix(turned(turned(q, w / 2), w / 2))
    assert once == pytest.approx(twice, abs=1e-14)
    assert once @ once.T == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(once) == pytest.approx(1)
    relative = once @ rotation_matrix(q).T
    assert relative @ w == pytest.approx(w)
    assert np.trace(relative) == pytest.approx(1 + 2 * np.cos(np.linalg.norm(w)))


@pytest.mark.parametrize("exponent", [-80, -3, 0, 3, 80])
def test_size_does_not_matter(exponent: int) -> None:
    factor = Fraction(10) ** exponent
    plain, scaled = (numeric_robot(moved(shipped("rolland-6-6"), by, Fraction(0))) for by in (Fraction(1), factor))
    poses = [newton(robot, home_pose(robot)) for robot in (plain, scaled)]
    assert [pose.ending for pose in poses] == [Ending.CONVERGED] * 2
    assert np.array(poses[1].position) / float(factor) == pytest.approx(np.array(poses[0].position), abs=1e-8)
    assert poses[1].residual <= 1e-13 * scaled.unit


def test_a_robot_far_from_its_origin_loses_no_digits() -> None:
    shift = Fraction(10) ** 9
    near_by, far_off = (numeric_robot(moved(shipped("rolland-6-6"), Fraction(1), s)) for s in (Fraction(0), shift))
    assert (near_by.base == far_off.base).all()
    poses = [newton(robot, home_pose(robot)) for robot in (near_by, far_off)]
    assert np.array(poses[1].rotation) == pytest.approx(np.array(poses[0].rotation), abs=1e-11)
    assert np.array(poses[1].position) - 1e9 == pytest.approx(np.array(poses[0].position), abs=1e-6)


@pytest.mark.parametrize("exponent", [-101, 101])
def test_numbers_that_doubles_cannot_hold_are_refused(exponent: int) -> None:
    problem = moved(shipped("mourrain-l"), Fraction(10) ** exponent, Fraction(0))
    for attempt in (numeric_robot, solve_newton, solve_levenberg_marquardt, lambda p: solve_within(solve, p, 60.0)):
        with pytest.raises(InputError, match="out of reach of floating point"):
            attempt(problem)


def test_every_ending_has_its_reason() -> None:
    robot = numeric_robot(shipped("similar-planar-s"))
    parallel = newton(robot, StartPose((0.0, 0.0, 2.0), IDENTITY))
    assert parallel.ending is Ending.SINGULAR  # similar hexagons, one above the other
    rolland = numeric_robot(shipped("rolland-6-6"))
    start = StartPose((0.0, 0.0, 700.0), IDENTITY)
    assert newton(rolland, start, NewtonPolicy(iterations=1)).ending is Ending.TOO_MANY_ITERATIONS
    assert newton(rolland, start).converged
    apart = with_lengths(shipped("rolland-6-6"), [Fraction(1250**2)] * 5 + [Fraction(9000**2)])
    impossible = numeric_robot(apart)
    assert newton(impossible, start).ending in (Ending.STAGNATED, Ending.SINGULAR)
    ends = levenberg_marquardt(impossible, DescentPolicy(starts=20))
    assert not any(pose.converged for pose in ends)
    assert min(pose.residual for pose in ends) > 100
    assert solve_levenberg_marquardt(apart).poses == ()


def test_no_convergence_is_an_error_that_names_the_reason() -> None:
    with pytest.raises(NotConvergedError, match=r"from the home pose \(singular Jacobian; iterations: 0"):
        solve_newton(shipped("similar-planar-s"))


@pytest.mark.parametrize("name", NAMES)
def test_residuals_are_what_they_say(name: str) -> None:
    problem = shipped(name)
    for pose in levenberg_marquardt(numeric_robot(problem), DescentPolicy(starts=10)):
        scales = np.sqrt(np.array(problem.metric, dtype=float))
        errors = []
        for leg in problem.distances:
            base, joint = (scales * [float(x) for x in end] for end in (leg.base, leg.platform))
            line = np.array(pose.position) + np.array(pose.rotation) @ joint - base
            errors.append(abs(np.linalg.norm(line) - sqrt(leg.length_squared)))
        size = sqrt(max(leg.length_squared for leg in problem.distances))
        assert max(errors) == pytest.approx(pose.residual, abs=1e-13 * size)
        if pose.converged:
            assert pose.residual <= 1e-12 * size


@pytest.mark.parametrize("name", NAMES)
def test_starts_satisfy_the_mean_of_the_legs_if_they_can(name: str) -> None:
    robot = numeric_robot(shipped(name))
    c, quaternions = random_states(robot, 30, 5)
    rotations = rotation_matrix(tuple(quaternions))
    lines = rotations @ robot.platform + c[:, :, None] - robot.base
    means = (lines**2).sum(axis=1).mean(axis=1)
    possible = distance_squared(robot, rotations) >= 0
    assert means[possible] == pytest.approx(np.mean(robot.lengths**2))
    assert (c[~possible] == 0).all()
    assert (quaternions**2).sum(axis=0) == pytest.approx(1)
    if robot.motion.is_planar:
        assert not np.any(c[:, 2])
        assert not np.any(quaternions[1:3])
    fewer = random_states(robot, 7, 5)
    assert (fewer[0] == c[:7]).all()
    assert (fewer[1] == quaternions[:, :7]).all()
    assert not (random_states(robot, 7, 6)[1] == quaternions[:, :7]).all()


@pytest.mark.parametrize("name", ["rolland-6-6", "hexaglide", "mssm", "linuxcnc-hexapod", "robocrane-r", "3-rrr"])
def test_the_home_pose_of_a_sensible_robot_is_near_one(name: str) -> None:
    robot = numeric_robot(shipped(name))
    home = home_pose(robot)
    c, q = centred(robot, home)
    lines = rotation_matrix(q) @ robot.platform + c[:, None] - robot.base
    assert (lines**2).sum(axis=0).mean() == pytest.approx(np.mean(robot.lengths**2))
    assert newton(robot, home).converged
    if not robot.motion.is_planar:
        assert c[2] > 0
    back = placed(robot, c, q)[0]
    assert np.array(back) == pytest.approx(np.array(home.position), abs=1e-12 * robot.unit)


@pytest.mark.parametrize(
    ("planar", "start", "part"),
    [
        (False, StartPose((float("nan"), 0.0, 0.0), IDENTITY), "not finite"),
        (False, StartPose((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)), "all four numbers of the quaternion are 0"),
        (False, StartPose((1e30, 0.0, 0.0), IDENTITY), "a million times"),
        (True, StartPose((0.0, 0.0, 1.0), IDENTITY), "leaves the plane"),
        (True, StartPose((0.0, 0.0, 0.0), (1.0, 1.0, 0.0, 0.0)), "leaves the plane"),
    ],
)
def test_starts_that_are_none_are_refused(planar: bool, start: StartPose, part: str) -> None:
    with pytest.raises(InputError, match=part):
        newton(numeric_robot(shipped("3-rrr" if planar else "mourrain-l")), start)


def test_the_norm_of_the_quaternion_does_not_matter() -> None:
    robot = numeric_robot(shipped("rolland-6-6"))
    poses = [newton(robot, StartPose((0.0, 0.0, 800.0), (scale, 0.0, 0.0, 0.0))) for scale in (1.0, 1e-200, -1e200)]
    assert poses[0] == poses[1] == poses[2]


@pytest.mark.parametrize(("name", "count"), [("rolland-6-6", 16), ("linapod-n", 2), ("3-rrr", 6), ("ssm-exact", 16)])
def test_levenberg_marquardt_finds_what_is_certified(name: str, count: int) -> None:
    found = solve_levenberg_marquardt(shipped(name)).poses
    certified = np.array([[float(c.midpoint) for c in pose.position] for pose in solved(name).poses])
    assert len(found) == len(certified) == count
    for pose in found:
        assert np.linalg.norm(certified - np.array(pose.position), axis=1).min() < 1e-7


def test_distinct_poses_do_not_depend_on_the_order() -> None:
    robot = numeric_robot(shipped("linapod-n"))
    limits = list(levenberg_marquardt(robot))
    chosen = distinct_poses(robot, limits, 1e-5)
    assert len(chosen) == 2
    for seed in range(3):
        Random(seed).shuffle(limits)
        assert distinct_poses(robot, limits, 1e-5) == chosen
    assert len(distinct_poses(robot, limits, 10.0)) == 1
    assert distinct_poses(robot, [pose for pose in limits if not pose.converged], 1e-5) == ()


def test_the_words_of_a_result() -> None:
    solution = solve_levenberg_marquardt(shipped("3-rrr"), DescentPolicy(starts=40, seed=3))
    assert str(solution) == "6 poses found by levenberg-marquardt; uncertified"
    assert solution.notes == ("found from 40 random start poses (seed 3)",)
    (pose,) = solve_newton(shipped("3-rrr")).poses
    assert isinstance(pose, NumericPose)
    assert solution.claim == "uncertified"


# With a time limit


def test_a_solution_in_time_is_the_same() -> None:
    stages: list[str] = []
    for name in ("similar-planar-s", "3-rpr-double-q"):
        solution = solve_within(partial(solve, width=Fraction(1, 1000)), shipped(name), 300.0, progress=stages.append)
        assert isinstance(solution, Solution)
        assert solution == solve(shipped(name), width=Fraction(1, 1000))
    assert "Groebner basis" in stages
    assert active_children() == []


def test_when_the_time_is_over_the_answer_is_uncertified() -> None:
    answer = solve_within(partial(solve, formulation="AFD2"), shipped("rolland-6-6"), 0.5)
    assert isinstance(answer, UncertifiedSolution)
    assert len(answer.poses) == 16
    assert answer.notes[0].startswith("the certified engine did not end within the time limit of 0.5 seconds")
    assert active_children() == []


def gives_up(_problem: ForwardProblem, **_: object) -> None:
    raise ReconstructionError("the lift did not settle")


def falls_over(_problem: ForwardProblem, progress: Callable[[str], None]) -> None:
    progress("falling")
    raise SystemExit(7)


def test_errors_of_the_engine_arrive() -> None:
    with pytest.raises(ReconstructionError, match="the lift did not settle"):
        solve_within(gives_up, shipped("3-rrr"), 300.0)  # type: ignore[arg-type]
    with pytest.raises(PkmExactError, match="ended with code 7 at the stage: falling"):
        solve_within(falls_over, shipped("3-rrr"), 300.0)  # type: ignore[arg-type]
    assert active_children() == []


def test_a_solution_is_sent_without_what_it_keeps_for_later() -> None:
    """Numbers near the roots are FLINT's balls, which no process can send."""
    found = solved("rolland-6-6")
    assert found.representation is not None
    assert found.representation.univariate.near
    sent = pickle.loads(_packed(found))  # noqa: S301
    assert sent == found
    assert sent.representation.univariate.near == ()
