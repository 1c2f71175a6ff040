"""Robots close to degenerate ones: whatever is written of them, both checkers accept, with the same words."""

from fractions import Fraction
from math import prod
from pathlib import Path
from typing import Any

import pytest
from campaign import model
from certificate_tools import both, both_resealed, last_line, with_entry
from flint import fmpq, fmpz, fmpz_poly
from forged_representations import fit_real_poses, turning
from hypothesis import given, settings
from hypothesis import strategies as st

from pkm_exact import Robot, certificate
from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.checker import solutions
from pkm_exact.certify.checker.descartes import dyadic, real_roots
from pkm_exact.certify.checker.verdict import Refusal
from pkm_exact.certify.tolerance_build import tolerance_certificate
from pkm_exact.engine import solve
from pkm_exact.geometry.reader import read_robot, robot_from_toml
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.numeric.tolerance import tolerance_boxes
from pkm_exact.numeric_engine import solve_krawczyk

CASES = Path(__file__).parent / "cases"


@pytest.mark.parametrize(
    ("name", "solver"),
    [
        ("fast_rejects", solve_krawczyk),
        ("fast_rejects", solve),
        ("pure_rejects_spatial", solve_krawczyk),
        ("fast_checker_gives_up", solve),
        ("fast_checker_gives_up", solve_krawczyk),
        ("equations-of-different-sizes", solve_krawczyk),
    ],
)
def test_both_checkers_accept_what_is_written(name: str, solver: Any) -> None:
    robot = read_robot(CASES / f"{name}.toml")
    configuration = robot.configuration()
    solution = solver(robot.problem(configuration))
    answer = both(canonical_bytes(sealed(certificate(robot, configuration.name, solution))))
    assert (answer.status, answer.lines[-1].partition(":")[0]) == ("accepted", "complete")


@pytest.mark.parametrize(
    ("name", "tolerance", "proved"),
    [("planar-33", "7e-75", 2), ("planar-59", "4e-19", 4), ("planar-22", "7e-10", 2)],
)
def test_both_checkers_accept_tolerance_certificates(name: str, tolerance: str, proved: int) -> None:
    """Of the third robot two poses are closer than the grid tells apart: nothing is claimed of them."""
    robot = robot_from_toml(model(name))
    configuration = robot.configuration()
    problem = robot.problem(configuration)
    result = tolerance_boxes(problem, Tolerances.uniform(str(Fraction(tolerance))), solve_krawczyk(problem))
    assert sum(box.is_proved for box in result.boxes) == proved
    assert both(canonical_bytes(tolerance_certificate(robot, configuration.name, result))).status == "accepted"


# Robots that are degenerate modulo primes

FAR = [(Fraction(0), Fraction(0)), (Fraction(1), Fraction(0)), (Fraction(0), Fraction(1))]
NEAR = {
    "base": [(Fraction(0), Fraction(0)), (Fraction(5), Fraction(1)), (Fraction(2), Fraction(4))],
    "platform": [(Fraction(-1), Fraction(-1)), (Fraction(2), Fraction(0)), (Fraction(0), Fraction(3))],
}


@pytest.mark.parametrize("primes", [solutions.PRIMES, pure.PRIMES])
@pytest.mark.parametrize("side", ["base", "platform"])
def test_no_robot_is_built_on_the_primes_of_a_checker(primes: tuple[int, ...], side: str) -> None:
    """Modulo each of them, one side is a point. It is also 10^110 times as large as the other."""
    sides = {**NEAR, side: [(x * prod(primes), y * prod(primes)) for x, y in FAR]}
    pairs = zip(sides["base"], sides["platform"], strict=True)
    squares = [(1 + b[0] - a[0]) ** 2 + (2 + b[1] - a[1]) ** 2 for a, b in pairs]
    robot = Robot("built on primes", "3-RPR", "m", "made up", tuple(sides["base"]), tuple(sides["platform"]))
    answer = both_resealed(certificate(robot, None, solve(robot.problem(squares))))
    assert answer.status == "accepted", last_line(answer)


@given(st.integers(20, 1 << 63))
def test_primes_are_told_from_other_numbers(half: int) -> None:
    n = 2 * half - 1
    assert pure.is_prime(n) == fmpz(n).is_prime()


def test_numbers_that_look_like_primes_are_none() -> None:
    """Products of primes that pass Miller's test for the first bases."""
    for n in (3215031751, 3474749660383, 341550071728321, 3825123056546413051):
        assert not pure.is_prime(n)
    assert pure.is_prime((1 << 61) - 1)


# The grid point nearest to a solution

UNIT = Fraction(1, 1 << 28)
HAIR = Fraction(1, 1 << 500)


def _beside_a_grid_point(distance: Fraction) -> dict[str, Any]:
    """Boxes of a planar robot with a solution at f1 = 2^-28 (n + distance), in the chart 3 e0 + e3 = 1, f1 as n."""
    position = 3 * UNIT * (12345 + distance)
    base = ((Fraction(0), Fraction(0)), (Fraction(5), Fraction(1)), (Fraction(2), Fraction(4)))
    platform = ((Fraction(-1), Fraction(-1)), (Fraction(2), Fraction(0)), (Fraction(0), Fraction(3)))
    squares = [(position + b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2 for a, b in zip(base, platform, strict=True)]
    robot = Robot("beside a grid point", "3-RPR", "m", "made up", base, platform)
    content = certificate(robot, None, solve_krawczyk(robot.problem(squares)))
    boxes = content["krawczyk"]
    assert boxes["chart"] == [3, 0, 0, 1]
    here = [place for place, box in enumerate(boxes["real"]) if abs(int(box["centre"][5], 16) - 12345) <= 1]
    (place,) = here
    assert boxes["real"][place]["exponents"] == [28, 28]
    return with_entry(content, ("krawczyk", "real", place, "centre", 5), hex(12345))


@pytest.mark.parametrize(
    ("distance", "is_nearest"),
    [
        (Fraction(0), True),
        (Fraction(1, 2), True),
        (Fraction(1, 2) + Fraction(1, 1 << 20) - HAIR, True),
        (Fraction(1, 2) + Fraction(1, 1 << 20) + HAIR, False),
        (-Fraction(1, 2) - Fraction(1, 1 << 20) + HAIR, True),
        (-Fraction(1, 2) - Fraction(1, 1 << 20) - HAIR, False),
        (Fraction(1), False),
    ],
)
def test_a_centre_is_the_nearest_grid_point_however_close_another_is(distance: Fraction, is_nearest: bool) -> None:
    answer = both_resealed(_beside_a_grid_point(distance))
    if is_nearest:
        assert answer.status == "accepted", last_line(answer)
    else:
        assert answer.status == "rejected"
        assert last_line(answer).endswith("is not the grid point nearest to the solution")


# Real roots by the rule of Descartes


def _product(roots: list[Fraction]) -> fmpz_poly:
    h = fmpz_poly([1])
    for root in roots:
        h *= fmpz_poly([-root.numerator, root.denominator])
    return h


rationals = st.fractions(-30, 30, max_denominator=40) | st.builds(
    lambda sign, power: Fraction(sign) * Fraction(2) ** power, st.sampled_from((-1, 1)), st.integers(-300, 300)
)


@given(st.lists(rationals, min_size=1, max_size=5, unique=True), st.integers(0, 80))
@settings(max_examples=40)
def test_every_real_root_is_enclosed_once(roots: list[Fraction], bits: int) -> None:
    """Beside them, complex ones: they are 2^-50 from a real number."""
    found = real_roots(_product(roots) * fmpz_poly([(1 << 100) + 1, -(1 << 101), 1 << 100]))
    assert len(found) == len(roots)
    for root, value in zip(found, sorted(roots), strict=True):
        exact = fmpq(value.numerator, value.denominator)
        assert root.low == exact == root.high or root.low < exact < root.high
        ball = root.ball(bits)
        assert abs(exact - fmpq(*dyadic(ball.mid()))) <= fmpq(*dyadic(ball.rad()))
        assert root.high - root.low <= fmpq(1, 1 << bits)
        whole = value * (1 << bits)
        assert root.cell(bits) == (whole.__floor__(), whole.__floor__() + (whole.denominator > 1))


def test_roots_far_apart_in_size_and_close_to_each_other() -> None:
    tiny = Fraction(1, 10**61)
    roots = [Fraction(10**123), Fraction(1, 3), Fraction(1, 3) + tiny, -tiny, Fraction(0), Fraction(-(10**40))]
    found = real_roots(_product(roots))
    assert [root.cell(0)[0] for root in found] == [value.__floor__() for value in sorted(roots)]
    with pytest.raises(Refusal, match="above 2"):
        real_roots(_product([Fraction(2**5000)]))


def test_work_on_roots_is_limited(monkeypatch: pytest.MonkeyPatch) -> None:
    h = _product([Fraction(n, 7) for n in range(6)])
    assert len(real_roots(h)) == 6
    monkeypatch.setattr("pkm_exact.certify.checker.descartes.MAX_WORK", 1000)
    with pytest.raises(Refusal, match="too long"):
        real_roots(h)


# The same on certificates: a platform that turns freely stands at whatever angles are named


@pytest.mark.parametrize(
    "roots",
    [
        [Fraction(0)],
        [Fraction(0), Fraction(1, 4), Fraction(1, 3), Fraction(-5), Fraction(-3, 2**33)],
        [Fraction(1, 3), Fraction(1, 3) + Fraction(1, 10**61), -Fraction(1, 10**61), Fraction(0)],
        [Fraction(10**40), Fraction(-(10**40)), Fraction(1, 10**40)],
        [Fraction(1, 2) + Fraction(1, 2**200), Fraction(1, 2) - Fraction(1, 2**200)],
        [Fraction(2**70), Fraction(2**70 - 1)],
    ],
)
@pytest.mark.parametrize("others", [[1], [1, 1, 1], [(1 << 200) + 1, -(1 << 201), 1 << 200]])
def test_poses_at_any_angles_are_accepted(roots: list[Fraction], others: list[int]) -> None:
    content = turning(_product(roots) * fmpz_poly(others), box_exponent=600)
    fit_real_poses(content, None)
    answer = both_resealed(content)
    assert answer.status == "accepted", last_line(answer)
    assert f"real poses: {len(roots)}, one for each real root of the eliminant" in answer.lines
    fewer = content | {"poses": content["poses"][1:], "real_poses": len(roots) - 1}
    assert last_line(both_resealed(fewer)).startswith("real poses: ")


@pytest.mark.parametrize(("power", "status"), [(4093, "rejected"), (4094, "too-large")])
@pytest.mark.parametrize("sign", [-1, 1])
def test_a_pose_at_half_a_turn_but_for_a_hair(power: int, status: str, sign: int) -> None:
    """Both count the root, or give up: the limit is one of size."""
    assert both_resealed(turning(fmpz_poly([sign << power, 1]))).status == status
