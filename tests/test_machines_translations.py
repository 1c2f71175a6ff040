"""Deltas and their like, against the numbers that their sources print, or should."""

from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from samples import model

from pkm_exact.engine import solve
from pkm_exact.geometry.drive_modes import JointModes, joint_values
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.geometry.machines.machine_kinds import MACHINES
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.templates.machine_text import given_dimensions, machine_text

UNTURNED = rotation_of((Fraction(1), Fraction(0), Fraction(0), Fraction(0)), (1, 3, 1))


def machine(name: str, *dimensions: str) -> Mechanism:
    """A machine with some dimensions given."""
    kind = MACHINES[name]
    robot = robot_from_toml(machine_text(kind, "r", "1", given_dimensions(kind, dimensions)))
    assert isinstance(robot, Mechanism)
    return robot


def delta(rod: str, arm: str, radius: str) -> Mechanism:
    """L1, L2 and r of the book."""
    return machine("delta", f"rod={rod}", f"arm={arm}", f"base_radius={radius}")


def at(robot: Mechanism, x: str, y: str, z: str) -> tuple[JointModes, ...]:
    """The working modes at a position; the y is that of the file."""
    return joint_values(robot, (Fraction(x), Fraction(y), Fraction(z)), UNTURNED)


def test_the_two_poses_of_example_1() -> None:
    robot = model("delta")
    solution = solve(robot.problem(robot.configuration("level")))
    heights = [float(pose.position[2].midpoint) for pose in solution.poses]
    root = 2.12764464**0.5
    assert heights == pytest.approx([-1.6608 - root, -1.6608 + root])
    assert all(abs(pose.position[k].midpoint) < Fraction(1, 10**8) for pose in solution.poses for k in (0, 1))


def test_the_function_of_reachability_is_minus_the_discriminant() -> None:
    """h_j of the book: its figure 5 has h_j(0, 0, 1) = -10.296, f = 30.888."""
    joints = at(delta("1.9", "1.2", "0.9"), "0", "0", "1")
    assert [joint.discriminant for joint in joints] == [Fraction("10.296")] * 3
    assert sum(-(joint.discriminant or 0) for joint in joints) == -Fraction("30.888")
    assert [len(joint.modes) for joint in joints] == [2, 2, 2]


def test_the_printed_design_reaches_the_vertices_of_its_cube_with_room() -> None:
    """Table 3, side 2 and H = 1.01: the greatest h is -6.1093, so that no vertex is on the boundary."""
    robot = delta("2.66", "1.73", "1.74")
    found = []
    for x, y, z in product((-1, 1), (-1, 1), ("1.01", "3.01")):
        # y = 1 is not rational in the metric: 0.5773502692 is within 2e-10 of it.
        joints = at(robot, str(x), str(y * Fraction("0.5773502692")), z)
        found += [-float(joint.discriminant or 0) for joint in joints]
    assert max(found) == pytest.approx(-6.1093, abs=1e-4)


def test_vertices_within_reach_do_not_make_a_cube_within_reach() -> None:
    """At the optimum of example 1 all eight vertices pass within rounding, and a point on the axis is in the void."""
    robot = delta("2.45808", "0.97868", "1/1000000000")
    for x, y, z in product((-1, 1), (-1, 1), (1, 3)):
        joints = at(robot, str(x), str(y * Fraction("0.57735")), str(z))
        assert all((joint.discriminant or 0) > -Fraction(1, 1000) for joint in joints)
    (void, *_) = at(robot, "0", "0", "1")
    assert void.modes == ()
    assert -float(void.discriminant or 0) == pytest.approx(12.85, abs=5e-3)


def test_the_triglide_is_mirrored_in_the_plane_of_its_slides() -> None:
    robot = model("triglide")
    first, second = (np.array([float(x.midpoint) for x in pose.position]) for pose in solve_home(robot))
    assert np.allclose(first * [1, 1, -1], second)
    feet = [(300, 0), (-175, 175 * 3**0.5), (-135, -135 * 3**0.5)]
    for x, y in feet:
        assert np.linalg.norm(second - [x, y, 0]) == pytest.approx(500)


def solve_home(robot: Mechanism) -> tuple:  # type: ignore[type-arg]
    return solve(robot.problem(robot.configuration())).poses
