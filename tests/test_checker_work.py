"""What a checker does on one file is bounded: its work is counted before it is done."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from random import Random

import pytest
from campaign import model
from certificate_tools import canonical_bytes, golden, sealed
from flint import fmpz_poly

from pkm_exact import solve
from pkm_exact.certify import check, pure
from pkm_exact.certify.build import certificate_bytes
from pkm_exact.certify.checker.budget import Budget, spending
from pkm_exact.certify.checker.descartes import real_roots
from pkm_exact.certify.checker.mechanism_forms import GROUPS, Mechanism, at_point, distance
from pkm_exact.certify.checker.mechanism_section import Section
from pkm_exact.certify.checker.realposes import parameter_cells
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.geometry.robot import Robot

ROOT = Path(__file__).parents[1]
CASES = Path(__file__).parent / "cases"
LARGE = ("6-6p", "6-6pp", "dietmaier", "hexa", "linapod-n", "rolland-6-6", "ssm-rounded")
GOLDENS = [
    pytest.param(path, id=path.stem, marks=pytest.mark.slow if path.stem in LARGE else ())
    for path in sorted((ROOT / "certs").glob("*.json"))
]


@pytest.mark.parametrize("path", GOLDENS)
def test_honest_certificates_need_half_of_the_work_allowed_at_most(path: Path) -> None:
    data = path.read_bytes()
    verdict, budget = check.check_counted(data)
    assert verdict, verdict
    assert 0 < 2 * budget.spent <= budget.limit
    answer, work = pure.check_counted(data)
    assert answer.status == "accepted", answer
    assert 0 < 2 * work.spent <= work.allowed


@pytest.mark.slow
@pytest.mark.largest
def test_an_elimination_with_long_coefficients_needs_half_of_the_work_allowed() -> None:
    """It was refused: the last step, with coefficients of 10,000 bits, was taken over Q where a prime tells as much."""
    robot = robot_from_toml(model("spatial-237"))
    assert isinstance(robot, Robot)
    data = certificate_bytes(robot, "home", solve(robot.problem(robot.configuration())))
    verdict, budget = check.check_counted(data)
    assert verdict, verdict
    assert 2 * budget.spent <= budget.limit
    answer, work = pure.check_counted(data)
    assert (answer.status, answer.lines) == (verdict.status, verdict.lines)
    assert 2 * work.spent <= work.allowed


def test_a_close_pair_of_roots_is_told_apart_bit_by_bit_with_little_work() -> None:
    """Each root was narrowed anew from its middle for every second bit of the grid that tells two of them apart."""
    h = fmpz_poly([0, 1]) * fmpz_poly([-1, 1 << 400])
    for k in range(10):
        h *= fmpz_poly([-3 - k, 3])
    budget = Budget(10**6)
    with spending(budget):
        _, exponent = parameter_cells(h, real_roots(h))
    assert exponent == 400
    assert budget.spent < 15 * 10**7


def test_a_step_that_would_take_minutes_is_not_begun() -> None:
    """5,000 dense products in a file of 178 kB kept a checker busy for eight minutes."""
    data = (CASES / "slow-elimination.json").read_bytes()
    verdict, budget = check.check_counted(data)
    assert verdict.status is check.Status.TOO_LARGE
    assert budget.spent < budget.limit // 4
    answer, work = pure.check_counted(data)
    assert answer.status == "too-large"
    assert work.spent < work.allowed // 4


@pytest.mark.slow
def test_numbers_that_would_take_minutes_are_not_worked_with() -> None:
    """Joints of 150 digits: the polynomials of the section have numbers of 77,000 bits, their echelon form more."""
    content = golden("3-rpr-six")
    content["robot"] |= {"kind": "6-UPS", "base": _long(6), "platform": _long(6)}
    content["configuration"]["lengths_squared"] = [joint[0] for joint in _long(6)]
    content |= {"representation": None, "poses": [], "real_poses": 0, "complex_solutions": 0, "distinct_solutions": 0}
    content |= {"claim": "inconsistent", "box_exponent": 0}
    verdict, budget = check.check_counted(canonical_bytes(sealed(content)))
    assert verdict.status is check.Status.TOO_LARGE
    assert verdict.lines[-1].startswith("work: "), verdict
    assert budget.spent > budget.limit


def _long(number: int) -> list[list[str]]:
    random = Random(number)
    return [
        [str(Fraction(random.getrandbits(500) + 1, random.getrandbits(500) + 2)) for _ in "xyz"] for _ in range(number)
    ]


def test_linear_elements_with_long_numbers_cost_no_more_than_the_forms() -> None:
    """A fixed joint and three legs, in two rounds. The squares of the longest numbers would be thirty times as much."""
    random = Random(8)

    def point() -> tuple[Fraction, Fraction, Fraction]:
        x, y, z = (Fraction(random.getrandbits(27), random.getrandbits(27) | 1) for _ in range(3))
        return x, y, z

    legs = [distance((1, 1, 1), point(), point(), point()[0]) for _ in range(3)]
    mechanism = Mechanism(GROUPS["spatial"], (1, 1, 1), (at_point((1, 1, 1), point(), point()), *legs))
    budget = Budget(10**9)
    with spending(budget):
        found = Section(mechanism)
    assert (found.size, found.is_empty) == (6, False)
    assert budget.spent < 2 * 10**9
