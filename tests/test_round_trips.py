"""Forward after inverse kinematics: random robots of every shape, locked at a known pose, have that pose in a box.

Counts do not move when the frames move or are rescaled, legs change places, or base and platform do.
"""

from collections.abc import Sequence
from fractions import Fraction
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from samples import Placed, placed, random_vector, root

from pkm_exact.claim import Claim
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.engine import solve
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.working_modes import platform_point
from pkm_exact.solution import Solution

SHAPES = ("general", "planar", "similar", "coincident", "symmetric")
MANY = [pytest.param(shape, marks=pytest.mark.largest if shape == "coincident" else []) for shape in SHAPES]
"""Shapes that many seeds are tried of: a robot whose joints coincide takes a second."""
METRICS = [(1, 1, 1), (1, 3, 1)]
seeds = st.integers(0, 10**9)


def _flat(joint: Vector) -> Vector:
    return joint[0], joint[1], Fraction(0)


def _mirrored(joint: Vector) -> Vector:
    return -joint[0], joint[1], joint[2]


def _joints(shape: str, random: Random) -> tuple[list[Vector], list[Vector]]:
    base = [random_vector(random) for _ in range(6)]
    platform = [random_vector(random, 5) for _ in range(6)]
    if shape == "planar":
        base, platform = list(map(_flat, base)), list(map(_flat, platform))
    elif shape == "similar":
        base = list(map(_flat, base))
        platform = [(x / 2, y / 2, z) for x, y, z in base]
    elif shape == "coincident":
        base[1], platform[2], platform[4] = base[0], platform[1], platform[3]
    elif shape == "symmetric":
        base = [*base[:3], *map(_mirrored, base[:3])]
        platform = [*platform[:3], *map(_mirrored, platform[:3])]
    return base, platform


def _robot(shape: str, seed: int, metric: tuple[int, int, int]) -> Placed:
    random = Random(seed)
    quaternion = [Fraction(random.randint(-5, 5)) for _ in range(4)]
    if not any(quaternion):
        quaternion[0] = Fraction(1)
    while True:
        base, platform = _joints(shape, random)
        robot = placed(base, platform, random_vector(random), quaternion, metric)
        if all(leg.length_squared for leg in robot.problem.distances):
            return robot


def _holds(solution: Solution, robot: Placed) -> bool:
    """Whether the known pose lies in one of the boxes, which are in ordinary coordinates."""
    scales = [root(g) for g in robot.problem.metric]
    for pose in solution.poses:
        for i in range(3):
            ends = sorted((robot.position[i] * scales[i].lo, robot.position[i] * scales[i].hi))
            if ends[1] < pose.position[i].lo or ends[0] > pose.position[i].hi:
                break
            if not pose.rotation[i][i].contains(robot.rotation[i][i]):
                break
        else:
            return True
    return False


def _check_round_trip(shape: str, seed: int, metric: tuple[int, int, int]) -> None:
    robot = _robot(shape, seed, metric)
    solution = solve(robot.problem)
    if solution.claim is Claim.POSITIVE_DIMENSIONAL_DETECTED or solution.claim is Claim.POSITIVE_DIMENSIONAL_PROVED:
        assert shape in ("similar", "coincident", "symmetric")
        return
    assert solution.claim is Claim.COMPLETE
    assert solution.complex_solutions <= 40
    assert _holds(solution, robot)


@pytest.mark.parametrize(
    ("shape", "seed", "metric"),
    [
        ("general", 1, (1, 3, 1)),
        ("planar", 1, (1, 3, 1)),
        ("planar", 2, (1, 1, 1)),
        ("similar", 1, (1, 3, 1)),
        ("similar", 2, (1, 1, 1)),
        ("coincident", 1, (1, 3, 1)),
        ("symmetric", 1, (1, 3, 1)),
    ],
)
def test_the_known_pose_is_found(shape: str, seed: int, metric: tuple[int, int, int]) -> None:
    _check_round_trip(shape, seed, metric)


@pytest.mark.slow
@pytest.mark.parametrize("shape", MANY)
@settings(max_examples=25)
@given(seed=seeds, metric=st.sampled_from(METRICS))
def test_the_known_pose_is_found_often(shape: str, seed: int, metric: tuple[int, int, int]) -> None:
    _check_round_trip(shape, seed, metric)


def _moved(joint: Vector, quaternion: Sequence[int], shift: Vector) -> Vector:
    e0, e1, e2, e3 = map(Fraction, quaternion)
    return platform_point(joint, shift, rotation_of((e0, e1, e2, e3)))


def _relatives(problem: ForwardProblem, random: Random) -> dict[str, ForwardProblem]:
    """The same robot seen from other frames, in other units, with legs renumbered, and upside down."""
    legs, factor = problem.distances, Fraction(random.randint(2, 9), 7)
    shift, order = random_vector(random), random.sample(range(6), 6)

    def scaled(joint: Vector) -> Vector:
        x, y, z = (factor * value for value in joint)
        return x, y, z

    return {
        "base moved": ForwardProblem(
            tuple(Distance(_moved(leg.base, (2, 1, 0, -1), shift), leg.platform, leg.length_squared) for leg in legs)
        ),
        "platform moved": ForwardProblem(
            tuple(Distance(leg.base, _moved(leg.platform, (1, 3, -1, 2), shift), leg.length_squared) for leg in legs)
        ),
        "scaled": ForwardProblem(
            tuple(Distance(scaled(leg.base), scaled(leg.platform), factor**2 * leg.length_squared) for leg in legs)
        ),
        "permuted": ForwardProblem(tuple(legs[i] for i in order)),
        "swapped": ForwardProblem(tuple(Distance(leg.platform, leg.base, leg.length_squared) for leg in legs)),
    }


def _counts(solution: Solution) -> tuple[Claim, int, int, int]:
    return solution.claim, solution.complex_solutions, solution.distinct_solutions, len(solution.poses)


def _check_relatives(shape: str, seed: int) -> None:
    problem = _robot(shape, seed, (1, 1, 1)).problem
    expected = _counts(solve(problem))
    for name, relative in _relatives(problem, Random(seed)).items():
        assert _counts(solve(relative)) == expected, name


@pytest.mark.parametrize(("shape", "seed"), [("general", 1), pytest.param("similar", 2, marks=pytest.mark.slow)])
def test_counts_belong_to_the_robot(shape: str, seed: int) -> None:
    _check_relatives(shape, seed)


@pytest.mark.slow
@pytest.mark.parametrize("shape", MANY)
@settings(max_examples=4)
@given(seed=seeds)
def test_counts_belong_to_every_robot(shape: str, seed: int) -> None:
    _check_relatives(shape, seed)
