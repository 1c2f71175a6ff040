"""The family of hexapods: what special shapes do to the number of poses."""

from fractions import Fraction

import pytest
from samples import MODELS, solved

from pkm_exact.claim import Claim
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.engine import solve
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.reader import read_robot


def test_a_hexa_with_equal_crank_angles_is_an_ssm() -> None:
    robot = read_robot(next(path for path in MODELS if path.stem == "hexa"))
    solution = solve(robot.problem(robot.configuration("level")))
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 28)


def test_the_linapod_stands_where_it_was_published() -> None:
    positions = [[float(c.midpoint) for c in pose.position] for pose in solved("linapod-n").poses]
    assert sorted(positions) == [
        pytest.approx([-7.10e-5, -8.30e-5, 4.57e-4], abs=1e-6),
        pytest.approx([2.46e-4, -5.01e-4, 0.225342], abs=1e-6),
    ]


BASE = ((-5, -7, 0), (4, -7, 0), (8, 2, 0), (3, 6, 0), (-2, 6, 0), (-9, 2, 0))
PLATFORM = ((-3, -3, 0), (4, -3, 0), (5, -1, 0), (1, 5, 0), (-2, 5, 0), (-3, -1, 0))


@pytest.mark.parametrize(
    ("height", "shift", "count"), [(0, 0, 36), pytest.param(1, 0, 36, marks=pytest.mark.slow), (0, 1, 40)]
)
def test_three_pairs_of_parallel_chords_send_four_solutions_to_infinity(height: int, shift: int, count: int) -> None:
    """Joints 1-2, 3-6 and 4-5 are joined by parallels, in the base and in the platform: 36 solutions, not 40."""
    base = [(*BASE[0][:2], height), (*BASE[1][:2], height), *BASE[2:]]
    base[3] = (base[3][0], base[3][1] + shift, 0)
    squares = (101, 107, 111, 121, 99, 133)
    legs = tuple(Distance(_vector(a), _vector(b), Fraction(n)) for a, b, n in zip(base, PLATFORM, squares, strict=True))
    solution = solve(ForwardProblem(legs))
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, count)


def _vector(joint: tuple[int, int, int]) -> Vector:
    x, y, z = map(Fraction, joint)
    return x, y, z
