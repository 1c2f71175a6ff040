"""Poses at singularities, and poses that a chart of rotations cannot hold: exact robots built around them."""

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

import pytest

from pkm_exact.certify.build import canonical_bytes, certificate
from pkm_exact.certify.check import check_bytes
from pkm_exact.claim import Claim, CompletenessRoute
from pkm_exact.constraints.distance import Distance
from pkm_exact.engine import solve
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.reader import read_robot
from pkm_exact.geometry.rotation import quaternion_norm, scaled_rotation
from pkm_exact.motions.motion_groups import PLANAR, SPATIAL

MODELS = Path(__file__).parent.parent / "models"
BASE = ((0, 0, 0), (3, 1, 0), (2, 4, 1), (-2, 3, 0), (-3, -1, 1), (1, -3, 0))
PLATFORM = ((1, 0, 0), (2, 1, 1), (0, 2, 1), (-1, 1, 0), (-1, -1, 1), (0, -2, 0))
GIMBAL_LOCK, HALF_TURN = (1, 0, 1, 0), (0, 0, 0, 1)


def robot_at(quaternion: tuple[int, ...], position: tuple[int, int, int]) -> ForwardProblem:
    """A general robot with the leg lengths of a given pose."""
    products = [[Fraction(a * b) for b in quaternion] for a in quaternion]
    norm = quaternion_norm(products, (1, 1, 1))
    rotation = scaled_rotation(products, (1, 1, 1))
    legs = []
    for a, b in zip(BASE, PLATFORM, strict=True):
        tip = [
            c + sum(r * x for r, x in zip(row, b, strict=True)) / norm
            for c, row in zip(position, rotation, strict=True)
        ]
        square = sum(((x - y) ** 2 for x, y in zip(tip, a, strict=True)), Fraction(0))
        legs.append(Distance(tuple(map(Fraction, a)), tuple(map(Fraction, b)), square))
    return ForwardProblem(tuple(legs))


def holds(problem: ForwardProblem, code: str, position: tuple[int, int, int]) -> tuple[str, ...]:
    """Solve, find the given position among the boxes of a complete list, and return the notes."""
    solution = solve(problem, formulation=code)
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 40)
    expected = map(Fraction, position)
    values = list(expected)
    assert any(all(i.contains(v) for i, v in zip(pose.position, values, strict=True)) for pose in solution.poses)
    return solution.notes


@pytest.mark.parametrize("quaternion", [GIMBAL_LOCK, HALF_TURN, (0, 1, 0, 0), (0, 0, 1, 0)])
def test_no_pose_is_lost_where_a_rotation_has_no_half_tangent(quaternion: tuple[int, ...]) -> None:
    assert holds(robot_at(quaternion, (1, 2, 5)), "SE3", (1, 2, 5)) == ()


@pytest.mark.slow
def test_euler_angles_at_gimbal_lock_are_solved_in_a_turned_frame() -> None:
    (note,) = holds(robot_at(GIMBAL_LOCK, (1, 2, 5)), "AFD1", (1, 2, 5))
    assert "turned by the quaternion" in note


@pytest.mark.slow
def test_another_convention_has_its_gimbal_lock_elsewhere() -> None:
    assert holds(robot_at(GIMBAL_LOCK, (1, 2, 5)), "AFD1:zxz", (1, 2, 5)) == ()


@pytest.mark.slow
def test_half_tangents_at_a_half_turn_are_solved_in_a_turned_frame() -> None:
    (note,) = holds(robot_at(HALF_TURN, (1, 2, 5)), "AFD2", (1, 2, 5))
    assert "turned by the quaternion" in note


@pytest.mark.parametrize(("name", "multiplicity", "total"), [("3-rpr-double-q", 2, 6), ("3-rpr-triple", 3, 6)])
def test_a_multiple_pose_is_counted_and_singular(name: str, multiplicity: int, total: int) -> None:
    robot = read_robot(MODELS / f"{name}.toml")
    configuration = robot.configuration(None)
    solution = solve(robot.problem(configuration))
    assert solution.claim is Claim.COMPLETE
    assert solution.completeness_route is CompletenessRoute.EXACT_ELIMINATION
    assert solution.complex_solutions == total
    pose = next(pose for pose in solution.poses if pose.multiplicity == multiplicity)
    assert all(interval.contains(Fraction(0)) for interval in pose.position)
    assert pose.jacobian is not None
    assert (pose.jacobian.det_sign, pose.jacobian.rank) == (0, 2)
    data = canonical_bytes(certificate(robot, configuration.name, solution))
    assert check_bytes(data).status == "accepted"
    lie = data.replace(f'"multiplicity": {multiplicity}'.encode(), b'"multiplicity": 1')
    assert lie != data
    assert check_bytes(lie).status == "rejected"


def _at_home(base: Sequence[Sequence[Fraction | int]], platform: Sequence[Sequence[Fraction | int]]) -> ForwardProblem:
    """The robot, planar if it has three legs, at the pose C = 0, R = 1."""
    legs = []
    for a, b in zip(base, platform, strict=True):
        foot, tip = ((Fraction(x), Fraction(y), Fraction(z)) for x, y, z in (a, b))
        legs.append(Distance(foot, tip, sum(((x - y) ** 2 for x, y in zip(foot, tip, strict=True)), Fraction(0))))
    return ForwardProblem(tuple(legs), motion=PLANAR if len(legs) == 3 else SPATIAL)


def _between(start: Sequence[int], end: Sequence[int], part: Fraction) -> list[Fraction]:
    return [a + part * (b - a) for a, b in zip(start, end, strict=True)]


PARTS = tuple(map(Fraction, ("1/2", "1/3", "2/3", "1/4", "3/4", "2/5")))
FLAT = ((0, 0, 0), (4, 0, 0), (7, 3, 0), (4, 8, 0), (0, 7, 0), (-2, 3, 0))
FLAT_PLATFORM = ((1, 0, 0), (2, 1, 0), (3, 3, 0), (1, 4, 0), (-1, 2, 0), (0, -1, 0))
TRIANGLE = ((3, 0, 1), (3, 0, 1), (-1, 2, 2), (-1, 2, 2), (-1, -3, 0), (-1, -3, 0))
AXIS = [(0, 0, height) for height in (5, -1, 3, 7, -2, 4)]
AXIAL = [_between(joint, point, 3 * part) for joint, point, part in zip(TRIANGLE, AXIS, PARTS, strict=True)]
SPECIAL = {
    "all joints in a plane": (FLAT, FLAT_PLATFORM, 3, "; all joints lie in one plane"),
    "legs that meet an axis": (AXIAL, TRIANGLE, 5, ""),
    "planar legs to a point": (
        FLAT[:3],
        [_between(a, (2, 5, 0), part) for a, part in zip(FLAT[:3], PARTS[:3], strict=True)],
        2,
        "; all leg lines meet in one point",
    ),
    "planar parallel legs": (FLAT[:3], ((0, 3, 0), (4, 4, 0), (7, 8, 0)), 2, "; all leg lines are parallel"),
    "planar legs on a line": (
        ((0, 0, 0), (1, 0, 0), (5, 0, 0)),
        ((2, 0, 0), (4, 0, 0), (6, 0, 0)),
        1,
        "; all leg lines are parallel",
    ),
}


@pytest.mark.parametrize("name", SPECIAL)
def test_a_singular_pose_says_what_is_special(name: str) -> None:
    base, platform, rank, special = SPECIAL[name]
    problem = _at_home(base, platform)
    solution = solve(problem)
    assert solution.claim is Claim.COMPLETE
    places = [
        place
        for place, pose in enumerate(solution.poses, 1)
        if all(pose.rotation[i][i].contains(Fraction(1)) for i in range(3))
        and all(interval.contains(Fraction(0)) for interval in pose.position)
    ]
    (place,) = places
    jacobian = solution.poses[place - 1].jacobian
    assert jacobian is not None
    assert jacobian.rank == rank
    gained = len(problem.distances) - rank
    legs = len(problem.distances)
    words = f"pose {place} is singular, rank {rank} of {legs}: the legs lose control of {gained} degree"
    (note,) = solution.notes
    assert note.startswith(words)
    assert note.endswith(f"which the platform gains{special}")


def test_singular_poses_of_one_kind_share_a_note() -> None:
    """Similar hexagons without rotation: the legs meet in the centre of similarity, above the base and below it."""
    platform = [(Fraction(x, 2), Fraction(y, 2), Fraction(4)) for x, y, _ in FLAT]
    solution = solve(_at_home(FLAT, platform))
    words = (
        "poses 1, 2 are singular, rank 3 of 6: the legs lose control of 3 degrees of freedom, which the platform gains"
    )
    assert solution.notes == (f"{words}; all leg lines meet in one point",)


def test_regular_poses_have_no_notes() -> None:
    assert solve(_at_home(FLAT[:3], FLAT_PLATFORM[:3])).notes == ()
