"""Multiplicities of poses, exactly: robots with several multiple poses, of which each has its own."""

from collections import Counter
from fractions import Fraction

import pytest
from certificate_tools import check_resealed, last_line
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mirrored_robots import STRAIGHT, mirrored, problem_at_home, vectors
from samples import placed

from pkm_exact import Robot, certificate
from pkm_exact.certify.check import Status
from pkm_exact.claim import Claim, CompletenessRoute
from pkm_exact.engine import solve

integers = st.integers(-5, 5)


@given(integers, integers, integers)
@settings(max_examples=20)
def test_a_fourfold_and_a_double_pose(b: int, height: int, top: int) -> None:
    robot = mirrored(b, height, top)
    assume(robot is not None)
    assert robot is not None
    solution = solve(problem_at_home(robot))
    assert (solution.claim, solution.complex_solutions, solution.distinct_solutions) == (Claim.COMPLETE, 6, 2)
    for pose in solution.poses:
        home = pose.rotation[0][0].contains(Fraction(1))
        assert pose.multiplicity == (4 if home else 2)
        assert pose.position[1].contains(Fraction(0 if home else 2 * top))
    assert check_resealed(certificate(robot, None, solution)).status is Status.ACCEPTED


@pytest.mark.parametrize("forged", [(2, 4), (3, 3), (5, 1), (4, 4), (2, 2), (4, None), (None, None)])
def test_forged_multiplicities_are_rejected(forged: tuple[int | None, ...]) -> None:
    robot = mirrored(1, 2, 1)
    assert robot is not None
    content = certificate(robot, None, solve(problem_at_home(robot)))
    assert check_resealed(content).status is Status.ACCEPTED
    true = [pose["multiplicity"] for pose in content["poses"]]
    for pose, was in zip(content["poses"], true, strict=True):
        pose["multiplicity"] = forged[0] if was == 4 else forged[1]
    answer = check_resealed(content)
    assert (answer.status, last_line(answer).partition(":")[0]) == (Status.REJECTED, "multiplicity")


HEXAGON = ((0, 0), (4, 0), (7, 3), (4, 8), (0, 7), (-2, 3))


def _similar() -> Robot:
    """Similar planar hexagons at a pose without rotation: two poses hold all 16 solutions."""
    base = vectors(*((x, y, 0) for x, y in HEXAGON))
    return Robot("similar", "6-UPS", "m", "made up", tuple(base), tuple((x / 2, y / 2, z) for x, y, z in base))


def test_two_poses_that_are_mirror_images_have_half_of_all_each() -> None:
    """All legs meet in the centre of similarity, and lines through a point have rank 3."""
    robot = _similar()
    position = (Fraction(1, 2), Fraction(1, 3), Fraction(5))
    legs = placed(robot.base_joints, robot.platform_joints, position, STRAIGHT).problem.distances
    solution = solve(robot.problem([leg.length_squared for leg in legs]))
    assert (solution.claim, solution.complex_solutions, solution.distinct_solutions) == (Claim.COMPLETE, 16, 2)
    assert [pose.multiplicity for pose in solution.poses] == [8, 8]
    jacobians = [pose.jacobian for pose in solution.poses]
    assert all(found is not None and (found.det_sign, found.rank) == (0, 3) for found in jacobians), jacobians
    content = certificate(robot, None, solution)
    assert check_resealed(content).status is Status.ACCEPTED
    content["poses"][0]["multiplicity"], content["poses"][1]["multiplicity"] = 7, 9
    assert check_resealed(content).status is Status.REJECTED


def test_a_platform_lying_on_its_base_has_an_eightfold_pose() -> None:
    """General planar joints in one plane: the leg lines have rank 3, so the pose counts 2^3 times, the others once."""
    base = vectors(*((x, y, 0) for x, y in HEXAGON))
    platform = vectors(*((x, y, 0) for x, y in ((1, 0), (2, 1), (3, 3), (1, 4), (-1, 2), (0, -1))))
    turn = (Fraction(2), Fraction(0), Fraction(0), Fraction(1))
    solution = solve(placed(base, platform, vectors((1, 2, 0))[0], turn).problem)
    assert solution.claim is Claim.COMPLETE
    assert solution.completeness_route is CompletenessRoute.EXACT_ELIMINATION
    counts = Counter(pose.multiplicity for pose in solution.poses)
    assert counts[8] == 1
    assert set(counts) <= {1, 8}
    assert solution.distinct_solutions == solution.complex_solutions - 7
