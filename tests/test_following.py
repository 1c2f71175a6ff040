"""A pose that follows its actuators: right within its bounds, and of the same mode only where that is so."""

from pathlib import Path

import numpy as np
import pytest
from following_tools import Array, planar_turn, precise_pose, values_at
from samples import solved

from pkm_exact import InputError, Robot
from pkm_exact.following.follower import Followed, next_pose
from pkm_exact.following.following_start import joint_values
from pkm_exact.following.leg_ends import leg_ends, way_between

MODELS = Path(__file__).parent.parent / "models"
LARGEST = [pytest.mark.slow, pytest.mark.largest]
KINDS = ["3-rpr-merlet-p", "3-rrr", "3-prr", "rolland-6-6", "hexa", "hexaglide", "mssm"]


def _start(name: str) -> tuple[Robot, Array, list[Followed]]:
    """A robot, its joint values at home, and all its poses there."""
    robot = Robot.load(MODELS / f"{name}.toml")
    values = joint_values(robot, robot.configuration())
    return robot, values, [robot.follow(values, pose) for pose in solved(name).poses]


def _step(robot: Robot, followed: Followed, size: float, rng: np.random.Generator) -> Array:
    unit = 1.0 if followed.tables.is_cranked else followed.tables.unit
    changed: Array = followed.values + size * unit * rng.uniform(-1, 1, len(followed.values))
    return changed


def _is_right(robot: Robot, found: Followed) -> bool:
    """Whether the true pose is within the bounds."""
    position, rotation, _, last = precise_pose(robot, found.values, found.position, found.quaternion)
    assert last < 1e-30
    # What is compared has the rounding of its own doubles.
    near = np.max(np.abs(position - found.position)) <= found.position_bound + 1e-15 * np.max(np.abs(position))
    return bool(near and np.max(np.abs(rotation - found.rotation)) <= found.rotation_bound + 1e-15)


@pytest.mark.parametrize("name", KINDS)
def test_poses_are_within_their_bounds_and_of_the_start_s_mode(name: str) -> None:
    robot, _, starts = _start(name)
    rng = np.random.default_rng(len(name))
    same = 0
    for start in starts[-2:]:
        assert start.is_proved
        assert _is_right(robot, start)
        sign = precise_pose(robot, start.values, start.position, start.quaternion)[2]
        for size in (1e-9, 1e-5, 1e-4, 1e-3, 1e-2):
            found = robot.follow(_step(robot, start, size, rng), start)
            if found.is_proved:
                assert _is_right(robot, found)
            if found.same_mode:
                same += 1
                assert precise_pose(robot, found.values, found.position, found.quaternion)[2] == sign
    assert same >= 4


@pytest.mark.parametrize("name", ["3-rpr-merlet-p", "mourrain-l"])
def test_the_pose_is_in_a_box_of_the_certified_answer_for_the_same_doubles(name: str) -> None:
    robot, _, starts = _start(name)
    found = robot.follow(_step(robot, starts[0], 1e-4, np.random.default_rng(3)), starts[0])
    solution = robot.solve([float(x) for x in found.values], doubles_are_exact=True)
    position_off, rotation_off = found.position_bound, found.rotation_bound
    met = [
        pose
        for pose in solution.poses
        if all(
            x.lo - position_off <= y <= x.hi + position_off for x, y in zip(pose.position, found.position, strict=True)
        )
        and all(
            x.lo - rotation_off <= y <= x.hi + rotation_off
            for row, other in zip(pose.rotation, found.rotation, strict=True)
            for x, y in zip(row, other, strict=True)
        )
    ]
    assert len(met) == 1
    assert found.position_bound < 1e-6


@pytest.mark.parametrize(
    "count", [200, pytest.param(1_000, marks=pytest.mark.slow), pytest.param(10_000, marks=LARGEST)]
)
def test_no_way_across_a_singularity_is_called_one_mode(count: int) -> None:
    """Ways between poses on both sides of det J = 0, and along it."""
    robot = Robot.load(MODELS / "3-rpr-merlet-p.toml")
    rng = np.random.default_rng(count)
    claimed = crossed = 0
    for _ in range(count // 10):
        place, angle = _singular_pose(robot, rng)
        for _ in range(10):
            away = 10.0 ** rng.uniform(-6, 0)
            first = np.append(place, angle) + away * rng.normal(size=3)
            ends = (first, first + away * 10.0 ** rng.uniform(-3, 1) * rng.normal(size=3))
            lengths = [values_at(robot, np.append(end[:2], 0), planar_turn(end[2])) for end in ends]
            start = robot.follow(lengths[0], (first[:2], (np.cos(first[2] / 2), 0, 0, np.sin(first[2] / 2))))
            found = next_pose(start.tables, lengths[1], start)
            if found.is_proved and start.is_proved:
                signs = [precise_pose(robot, x.values, x.position, x.quaternion)[2] for x in (start, found)]
                claimed += found.same_mode
                crossed += signs[0] != signs[1]
                assert not found.same_mode or signs[0] == signs[1] != 0
    assert claimed > count // 20
    assert crossed


def _singular_pose(robot: Robot, rng: np.random.Generator) -> tuple[Array, float]:
    """A place and an angle, about, at which det J is 0."""
    while True:
        place, angle, way = rng.uniform(0, 8, 2), rng.uniform(-3, 3), rng.normal(size=3)

        def determinant(t: float, place: Array = place, angle: float = angle, way: Array = way) -> float:
            at, turn = np.append(place + t * way[:2], 0), planar_turn(angle + t * way[2])
            arms = np.array(robot.platform_joints, dtype=object).astype(float) @ turn.T
            d = at + arms - np.array(robot.base_joints, dtype=object).astype(float)
            rows = np.column_stack([d[:, :2], arms[:, 0] * d[:, 1] - arms[:, 1] * d[:, 0]])
            return float(np.linalg.det(rows))

        low, high = 0.0, 1.0
        if determinant(low) * determinant(high) > 0:
            continue
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if determinant(low) * determinant(middle) > 0 else (low, middle)
        return place + low * way[:2], angle + low * way[2]


def test_a_chain_of_steps_stays_proved_and_comes_back() -> None:
    robot, home, starts = _start("rolland-6-6")
    pose = starts[0]
    goal = home + np.array([3.0, -2, 1, 0, 2, -3])
    for k in range(1, 201):
        pose = robot.follow(home + (goal - home) * np.sin(np.pi * k / 200), pose)
        assert pose.same_mode
    assert np.max(np.abs(pose.position - starts[0].position)) < 1e-6
    assert abs(pose.point @ pose.tables.norm @ pose.point - 1) < 1e-12


def test_a_long_way_is_halved_until_it_is_proved() -> None:
    robot, home, starts = _start("3-rpr-merlet-p")
    goal = home + np.array([0.1, -0.05, 0.02])
    assert not next_pose(starts[1].tables, goal, starts[1]).same_mode
    assert robot.follow(goal, starts[1]).same_mode


def test_a_pose_goes_on_with_another_robot_that_is_equal() -> None:
    first, values, starts = _start("3-rrr")
    second = Robot.load(MODELS / "3-rrr.toml")
    for robot in (first, second):
        assert robot.follow(values, starts[0]).same_mode
        assert robot.follow(values, robot.follow(values, starts[0])).same_mode


@pytest.mark.parametrize("name", ["3-rpr-merlet-p", "3-rrr", "3-prr"])
def test_on_the_way_equations_stay_within_the_bend(name: str) -> None:
    """Squared distances at values that all go evenly, against those evenly between the ends."""
    robot, before, starts = _start(name)
    after = before + np.array([0.5, -0.25, 0.125])
    tables, point = starts[0].tables, starts[0].point
    ends = [leg_ends(tables, values) for values in (before, after)]

    def squares(values: Array) -> Array:
        at = leg_ends(tables, values)
        forms = tables.legs + at.squares[:, None, None] * tables.norm
        if robot.chains:
            forms = forms + np.einsum("ji,jimn->jmn", at.places, tables.moved)
        found: Array = (forms @ point) @ point / (point @ tables.norm @ point)
        return found

    first, last = squares(before), squares(after)
    reach = np.sqrt(tables.rods_squared + np.abs(last))
    bend = way_between(tables, ends[0], ends[1], reach).bend
    off = [np.abs(squares(before + t * (after - before)) - (1 - t) * first - t * last) for t in np.linspace(0, 1, 33)]
    assert np.all(np.max(off, axis=0) <= bend + 1e-13)
    assert np.all(np.max(off, axis=0) > bend / 20)


def test_lengths_that_no_pose_has_prove_nothing() -> None:
    robot, home, starts = _start("3-rpr-merlet-p")
    found = robot.follow(home + np.array([0, 0, 100.0]), starts[0])
    assert (found.is_proved, found.same_mode) == (False, False)
    assert found.position_bound == float("inf")


@pytest.mark.parametrize(
    ("values", "start"),
    [
        ([1, 2], ((0, 0), (1, 0, 0, 0))),
        ([1, 2, float("nan")], ((0, 0), (1, 0, 0, 0))),
        ([1, 2, -3], ((0, 0), (1, 0, 0, 0))),
        ([1, 2, 3], ((0, 0), (0, 0, 0, 0))),
        ([1, 2, 3], ((0, float("inf")), (1, 0, 0, 0))),
    ],
)
def test_what_is_no_start_or_no_values_is_refused(values: list[float], start: object) -> None:
    with pytest.raises(InputError, match=r"^(values|start): .*; give "):
        Robot.load(MODELS / "3-rpr-merlet-p.toml").follow(values, start)  # type: ignore[arg-type]
