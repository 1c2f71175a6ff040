"""Coordinates next to the distance from a grid point at which a cell becomes two: solver and checkers agree."""

from collections.abc import Callable
from fractions import Fraction

import pytest
from certificate_tools import both
from mirrored_robots import STRAIGHT, mirrored

from pkm_exact import Robot, certificate, solve, solve_krawczyk
from pkm_exact.certify.build import canonical_bytes
from pkm_exact.geometry.inverse import distance_squared, rotation_of
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.solution import Solution

PRIME = (1 << 63) - 25


@pytest.mark.parametrize("denominator", [PRIME, 1 << 63, (1 << 63) + 1000])
@pytest.mark.parametrize("method", [solve, solve_krawczyk])
def test_a_turn_at_the_limit_has_the_cell_that_checkers_ask_for(
    denominator: int, method: Callable[[ForwardProblem], Solution]
) -> None:
    """The quaternion's last entry is the tangent of half the turn within 2^-126: 2^-32 of a cell within 2^-58."""
    robot = mirrored(1, 2, 1)
    assert robot is not None
    t, zero = Fraction(1, denominator), Fraction(0)
    (a, b, _), (c, d, _), _ = rotation_of((Fraction(1), zero, zero, t))
    base = tuple((a * x + b * y, c * x + d * y, zero) for x, y, _ in robot.base_joints)
    turned = Robot("turned", "3-RPR", "m", "made up", base, robot.platform_joints)
    squares = [
        distance_squared(a, b, (zero,) * 3, rotation_of(STRAIGHT))
        for a, b in zip(robot.base_joints, robot.platform_joints, strict=True)
    ]
    found = method(turned.problem(squares))
    assert both(canonical_bytes(certificate(turned, None, found))).status == "accepted"
