"""Orthogonal platforms of chapter 3: made from two linear conditions, with their forward kinematics."""

from fractions import Fraction
from itertools import permutations

import pytest
from budgets import budget
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact import InputError
from pkm_exact.constraints.distance import Distance
from pkm_exact.engine import solve
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.mobility.leg_failures import relative_manipulability
from pkm_exact.mobility.orthogonal_platforms import LegGroup, completed, leg_joints, weighted_gramian
from pkm_exact.screws.screw import cross

ZERO, ONE = Fraction(0), Fraction(1)
numbers = st.fractions(-3, 3, max_denominator=4)


def angle(t: Fraction) -> tuple[Fraction, Fraction]:
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)


tilts = st.sampled_from([Fraction(1, 3), Fraction(1, 2), Fraction(2, 5)])
weights = st.sampled_from([ONE, Fraction(2), Fraction(1, 3)])
groups = st.builds(LegGroup, tilts.map(angle), numbers.map(angle), numbers, numbers, weights)


@budget(15)
@given(st.lists(groups, min_size=1, max_size=3), tilts, numbers)
def test_completed_groups_have_the_gramian_of_theorem_4(some: list[LegGroup], tilt: Fraction, t: Fraction) -> None:
    every = [*some, completed(some, angle(tilt), angle(t), Fraction(3))]
    gramian = weighted_gramian(every)
    assert all(gramian[i][j] == 0 for i, j in permutations(range(6), 2))
    n = 4
    first = sum((n * g.weight * g.tilt[1] ** 2 for g in every), ZERO) / 2
    turning = sum((n * g.weight * (g.x**2 + g.y**2 * g.tilt[0] ** 2) for g in every), ZERO) / 2
    third = sum((n * g.weight for g in every), ZERO) - 2 * first
    last = sum((n * g.weight * g.y**2 * g.tilt[1] ** 2 for g in every), ZERO)
    assert [gramian[k][k] for k in range(6)] == [first, first, third, turning, turning, last]


def four_and_four() -> list[LegGroup]:
    first = LegGroup((Fraction(3, 5), Fraction(4, 5)), (ONE, ZERO), Fraction(2), ONE)
    return [first, completed([first], (Fraction(4, 5), Fraction(3, 5)), (ZERO, ONE))]


def test_the_failure_of_a_leg_of_two_groups_of_four_leaves_a_half() -> None:
    """r = sqrt(1 - 3/4), whatever the geometry."""
    rows = [row for group in four_and_four() for row in group.rows()]
    assert set(relative_manipulability(rows, 1).values()) == {Fraction(1, 4)}


@pytest.mark.parametrize("along", ["1/2", "3"])
def test_forward_kinematics_from_the_matrix(along: str) -> None:
    """Joints from M with any t have M's rows, and the platform is at home among its poses."""
    legs = []
    for row in (row for group in four_and_four() for row in group.rows()):
        base, joint = leg_joints(row, Fraction(along), Fraction(5))
        assert tuple(5 * x for x in row[:3]) == tuple(p - a for p, a in zip(joint, base, strict=True))
        assert cross(joint, row[:3]) == row[3:]
        legs.append(Distance(base, joint, Fraction(25)))
    solution = solve(ForwardProblem(tuple(legs)))
    assert str(solution.claim) == "complete"
    homes = [
        pose
        for pose in solution.poses
        if all(x.contains(ZERO) for x in pose.position)
        and all(x.contains(Fraction(int(i == j))) for i, row in enumerate(pose.rotation) for j, x in enumerate(row))
    ]
    assert len(homes) == 1


def test_groups_that_cannot_be_completed_are_refused() -> None:
    first = four_and_four()[0]
    with pytest.raises(InputError, match="along the axis or across it"):
        completed([first], (ONE, ZERO), (ONE, ZERO))
    with pytest.raises(InputError, match="along the axis or across it"):
        completed([first], (ZERO, ONE), (ONE, ZERO))
    with pytest.raises(InputError, match="azimuth: 1, 1 are not cosine and sine"):
        completed([first], (ONE, ZERO), (ONE, ONE))
    with pytest.raises(InputError, match="weight: 0 is not positive"):
        completed([first], (ONE, ZERO), (ONE, ZERO), ZERO)
