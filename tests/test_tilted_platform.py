"""The 3-PRS with errors: what height and tilt leave open, all of it, where the source iterates."""

from fractions import Fraction

import pytest
from samples import model

from pkm_exact import read_robot, solve_system
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import cosine_and_sine
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.systems.tilted_platform import tilted_platform

TILT = (Fraction(9), Fraction(1), Fraction(-1), Fraction(0))
HEAD = """schema = 1
name = "3-PRS"
kind = "3-PRS"
unit = "m"
source = "chapter 15"
[dimensions]
base_radius = 7
platform_radius = 5
rod = 20
"""


def test_with_errors_there_are_sixteen_and_each_fits() -> None:
    """The source brings the slides and x, y, phi into each other until nothing changes, which proves nothing."""
    robot = model("3-prs")
    assert isinstance(robot, Mechanism)
    system = tilted_platform(robot, Fraction(4), TILT)
    found = solve_system(system.equations, system.variables)
    assert str(found) == "16 complex solutions, 8 real; complete: it is proved that there is no other"
    for solution in found.solutions:
        x, y, c, s, *slides = (value.midpoint for value in solution.values)
        turn = ((c, -3 * s, Fraction(0)), (s, c, Fraction(0)), (Fraction(0), Fraction(0), Fraction(1)))
        tilt = rotation_of(TILT, robot.metric)
        rotation = tuple(
            tuple(sum((turn[i][k] * tilt[k][j] for k in range(3)), Fraction(0)) for j in range(3)) for i in range(3)
        )
        for constraint in robot.locked(slides, "it"):
            assert abs(robot.equation_at(constraint, (x, y, Fraction(4)), rotation)) < Fraction(1, 10**6)  # type: ignore[arg-type]


def test_without_errors_the_turn_is_that_of_the_closed_form() -> None:
    """tan(phi/2) = tan(theta/2) tan(psi/2), or half a turn more: both slides' signs and both turns make 2 * 2^3."""
    robot = robot_from_toml(HEAD)
    assert isinstance(robot, Mechanism)
    first, second = Fraction(3, 7), Fraction(1, 5)  # sqrt(3) tan(psi/2) and tan(theta/2), in the metric (1, 3, 1)
    system = tilted_platform(robot, Fraction(4), (Fraction(1), first, second, -first * second))
    found = solve_system(system.equations, system.variables)
    assert str(found) == "16 complex solutions, 16 real; complete: it is proved that there is no other"
    c, s = cosine_and_sine(first * second / 3, 3)
    meant = [(c, s), (-c, -s)] * 8
    turns = [(solution.values[2].midpoint, solution.values[3].midpoint) for solution in found.solutions]
    for turn, expected in zip(sorted(turns), sorted(meant), strict=True):
        assert all(abs(x - y) < Fraction(1, 10**9) for x, y in zip(turn, expected, strict=True))


def test_other_machines_are_refused() -> None:
    for name, part in (("delta", "is no slide of its own"), ("3-rps", "is actuated itself"), ("3-prrr", "is of type")):
        robot = read_robot(f"models/{name}.toml")
        assert isinstance(robot, Mechanism)
        with pytest.raises(InputError, match=part):
            tilted_platform(robot, Fraction(1), TILT)
