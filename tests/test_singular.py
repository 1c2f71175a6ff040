"""Poses at singularities, and poses that a chart of rotations cannot hold: exact robots built around them."""

from fractions import Fraction
from pathlib import Path

import pytest

from pkm_exact.certify.build import canonical_bytes, certificate
from pkm_exact.certify.check import check_bytes
from pkm_exact.engine import solve
from pkm_exact.geometry.problem import ForwardProblem, Leg
from pkm_exact.geometry.reader import read_robot
from pkm_exact.geometry.rotation import quaternion_norm, scaled_rotation
from pkm_exact.verdict import Claim, CompletenessRoute

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
        legs.append(Leg(tuple(map(Fraction, a)), tuple(map(Fraction, b)), square))
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


def test_euler_angles_at_gimbal_lock_are_solved_in_a_turned_frame() -> None:
    (note,) = holds(robot_at(GIMBAL_LOCK, (1, 2, 5)), "AFD1", (1, 2, 5))
    assert "turned by the quaternion" in note


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


def test_two_multiple_poses_that_are_not_conjugate_share_what_is_known() -> None:
    """Similar planar robots, at a pose without rotation: two poses hold all 16 solutions, each an open share.

    All legs meet in the centre of similarity, and lines through a point have rank 3."""
    base = ((0, 0), (4, 0), (7, 3), (4, 8), (0, 7), (-2, 3))
    legs = []
    for x, y in base:
        square = (Fraction(1, 2) - Fraction(x, 2)) ** 2 + (Fraction(1, 3) - Fraction(y, 2)) ** 2 + 25
        legs.append(Leg((Fraction(x), Fraction(y), Fraction(0)), (Fraction(x, 2), Fraction(y, 2), Fraction(0)), square))
    solution = solve(ForwardProblem(tuple(legs)))
    assert (solution.claim, solution.complex_solutions, solution.distinct_solutions) == (Claim.COMPLETE, 16, 2)
    assert [pose.multiplicity for pose in solution.poses] == [None, None]
    jacobians = [pose.jacobian for pose in solution.poses]
    assert all(found is not None and (found.det_sign, found.rank) == (0, 3) for found in jacobians), jacobians
