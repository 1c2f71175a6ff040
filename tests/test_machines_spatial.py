"""Spatial machines, against the numbers of their sources."""

import json
from fractions import Fraction
from math import atan, cos, pi, sqrt, tan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from certificate_tools import golden
from samples import model, solved
from test_machine_kinds import contains

from pkm_exact.claim import Claim
from pkm_exact.cli.legs_report import joint_modes
from pkm_exact.cli.main import main
from pkm_exact.constraints.angle import Angle
from pkm_exact.engine import solve
from pkm_exact.geometry.drive_modes import joint_values
from pkm_exact.geometry.inverse import distance_squared, rotation_of
from pkm_exact.geometry.machines.carriage import carriage_branches
from pkm_exact.geometry.machines.machine_kinds import MACHINES
from pkm_exact.geometry.mechanism import LockedValues, Mechanism
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.geometry.redundant_drives import standing
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.poses.pose import Pose
from pkm_exact.solution import Solution
from pkm_exact.templates.machine_text import given_dimensions, machine_text

ZERO, ONE = Fraction(0), Fraction(1)
UNTURNED = rotation_of((ONE, ZERO, ZERO, ZERO))
MODELS = Path(__file__).parent.parent / "models"


def found(robot: Any, name: str | None = None) -> Solution:
    return solve(robot.problem(robot.configuration(name)))


def drawn(name: str, *dimensions: str, **joints: str) -> Mechanism:
    """A machine with some dimensions given, and other values at home."""
    kind = MACHINES[name]
    text = machine_text(kind, "r", "m", given_dimensions(kind, dimensions))
    if joints:
        text = text[: text.index('name = "home"')] + 'name = "home"\n'
        text += "".join(f"{key} = {value}\n" for key, value in joints.items())
    robot = robot_from_toml(text)
    assert isinstance(robot, Mechanism)
    return robot


def middle(pose: Pose) -> tuple[np.ndarray, np.ndarray]:  # type: ignore[type-arg]
    """Position and rotation matrix, rounded."""
    return (
        np.array([float(x.midpoint) for x in pose.position]),
        np.array([[float(x.midpoint) for x in row] for row in pose.rotation]),
    )


def places(solution: Solution, digits: int = 6) -> set[tuple[float, ...]]:
    return {tuple(round(float(x.midpoint), digits) + 0.0 for x in pose.position) for pose in solution.poses}


# Chapter 1


def test_the_octahedron_has_two_mirror_pairs_one_of_them_rational() -> None:
    solution = solved("robocrane-r")
    assert (solution.complex_solutions, len(solution.poses)) == (16, 4)
    assert solution.representation is not None
    _, factors = solution.representation.univariate.polynomial.factor()
    assert sorted(factor.degree() for factor, _ in factors) in ([1, 1, 7, 7], [1, 1, 14])


# Chapters 2 and 15: 3-RPS, 3-PRS


@pytest.mark.parametrize("name", ["3-RPS", "3-PRS"])
def test_operation_modes_and_parasitic_motion_of_legs_on_hinges(name: str) -> None:
    """Without errors r12 = r21, which is e0 e3 = 0; x = r (R11 - R22) / 2, y = -r R21."""
    solution = found(drawn(name))
    modes = set()
    for pose in solution.poses:
        position, rotation = middle(pose)
        assert rotation[0, 1] == pytest.approx(rotation[1, 0], abs=1e-8)
        assert position[0] == pytest.approx(0.7 * (rotation[0, 0] - rotation[1, 1]) / 2, abs=1e-8)
        assert position[1] == pytest.approx(-0.7 * rotation[1, 0], abs=1e-8)
        turned = pose.quaternion[0].contains(ZERO)
        assert turned or pose.quaternion[3].contains(ZERO)
        modes.add("e0" if turned else "e3")
        if not turned:
            # tan(phi / 2) = tan(theta / 2) tan(psi / 2) for R = Rz(phi) Ry(theta) Rx(psi)
            theta, psi = -np.arcsin(rotation[2, 0]), np.arctan2(rotation[2, 1], rotation[2, 2])
            phi = np.arctan2(rotation[1, 0], rotation[0, 0])
            same = tan(phi / 2) == pytest.approx(tan(theta / 2) * tan(psi / 2), abs=1e-7)
            assert same or abs(cos(phi / 2)) < 1e-6 or cos(theta) < 0 or cos(psi) < 0
    assert "e3" in modes


def test_errors_of_hinges_and_places_leave_sixteen_poses_near_the_nominal_ones() -> None:
    exact, nominal = (
        solved("3-prs"),
        found(drawn("3-PRS", "base_radius=7", "platform_radius=5", "rod=4", slides='[1, "5/4", "3/4"]')),
    )
    for solution in (exact, nominal):
        assert (solution.claim, solution.complex_solutions, len(solution.poses)) == (Claim.COMPLETE, 16, 8)
    for pose in nominal.poses:
        assert min(np.linalg.norm(middle(pose)[0] - middle(other)[0]) for other in exact.poses) < 0.1


# Chapter 4: RCID


def test_rcid_has_sixteen_poses_eight_of_them_real() -> None:
    solution = solved("rcid")
    assert (solution.complex_solutions, len(solution.poses)) == (16, 8)
    turn = np.array([[-sqrt(3), 1], [-1, -sqrt(3)]]) / 2
    expected = (*(turn @ [3, -5]), 120)
    assert min(np.linalg.norm(middle(pose)[0] - expected) for pose in solution.poses) < 0.01


def test_rcid_at_home_has_four_mirror_pairs() -> None:
    home = found(model("rcid"), "home")
    height = float(Fraction("41.734"))
    assert len(home.poses) == 8
    near = {tuple(np.round(middle(pose)[0], 5)) for pose in home.poses}
    assert near == {tuple(np.round((x, y, 2 * height - z), 5)) for x, y, z in near}


# Chapters 8 and 12: slides


def test_the_corrected_linapod_has_two_real_poses() -> None:
    solution = solved("linapod-n")
    first, second = sorted((middle(pose) for pose in solution.poses), key=lambda pair: float(pair[0][2]))
    assert first[0] == pytest.approx([-7.10e-5, -8.30e-5, 4.57e-4], abs=6e-7)
    assert second[0] == pytest.approx([2.46e-4, -5.01e-4, 0.225342], abs=6e-7)
    angles = [np.degrees(np.arccos((np.trace(rotation) - 1) / 2)) for _, rotation in (first, second)]
    assert angles == pytest.approx([0.098, 140.757], abs=6e-4)


def test_the_misprint_of_the_linapod_is_off_by_centimetres() -> None:
    """With 0.250 in place of 0.025 no pose is near home: the closure is off by 60 mm there."""
    text = (
        'schema = 1\nname = "printed"\nkind = "6-PUS"\nunit = "m"\nsource = "as printed"\n'
        "[base]\njoints = [[0.25, 0.886, 0], [-0.780, -0.421, 0], [0.755, -0.465, 0], [-0.25, 0.886, 0], "
        "[-0.755, -0.465, 0], [0.780, -0.421, 0]]\n[slides]\ndirection = [0, 0, 1]\n"
        "[rods]\nlengths = [1.25, 1.25, 1.25, 1.70, 1.70, 1.70]\n[platform]\njoints = [[-0.126, 0.180, 0.2], "
        "[-0.093, -0.199, 0.2], [0.219, 0.019, 0.2], [0.115, 0.164, 0.4], [-0.199, 0.017, 0.4], "
        '[0.085, -0.181, 0.4]]\n[[configurations]]\nname = "home"\n'
        "slides = [1.221, 1.221, 1.221, 1.933, 1.933, 1.933]\n"
    )
    robot = robot_from_toml(text)
    solution = solve_krawczyk(robot.problem(robot.configuration()))
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 40)
    assert all(np.linalg.norm(middle(pose)[0]) > 0.02 for pose in solution.poses)


def test_the_linapod_has_sixty_four_working_modes() -> None:
    robot = model("linapod-n")
    modes = joint_modes(robot, (ZERO,) * 3, rotation_of((ONE, ZERO, ZERO, ZERO)))
    assert [len(leg) for leg in modes] == [2] * 6
    assert [float(leg[1].position.p) + float(leg[1].position.q) * sqrt(leg[1].position.n) for leg in modes] == (
        pytest.approx([1.221] * 3 + [1.933] * 3, abs=2e-3)
    )


HEXAGONS = (
    'schema = 1\nname = "r"\nkind = "6-UPS"\nunit = "mm"\nsource = "a test"\nmetric = [1, 3, 1]\n'
    "[base]\nhexagon = {{ sides = [{base}] }}\n[platform]\nhexagon = {{ sides = [{platform}] }}\n"
    '[[configurations]]\nname = "home"\nlengths = [{lengths}]\n'
)


@pytest.mark.parametrize(
    ("base", "platform"),
    [
        ("400, 100", "800, 200"),
        pytest.param("1000, 250", "800, 200", marks=pytest.mark.slow),
        pytest.param("100, 100", "50, 50", marks=pytest.mark.slow),
    ],
)
def test_similar_hexagons_with_matching_labels_are_an_architecture_singularity(base: str, platform: str) -> None:
    """Table 3 of chapter 12 with equal sliders, and the aligned model of chapter 18: of the forms, so at every pose."""
    equal = found(robot_from_toml(HEXAGONS.format(base=base, platform=platform, lengths=", ".join(["750"] * 6))))
    assert equal.claim is Claim.POSITIVE_DIMENSIONAL_PROVED
    assert "architecture singularity" in " ".join(equal.notes)


HEXAM = (
    'schema = 1\nname = "r"\nkind = "6-PUS"\nunit = "m"\nsource = "a test"\nmetric = [1, 3, 1]\n'
    "[base]\nhexagon = { sides = [1, 0.09] }\n[platform]\nhexagon = { sides = [0.5, 0.09] }\n[rods]\nlength = 0.5\n"
    "[slides]\ndirections = DIRECTIONS\n"
)


def test_positions_of_inclined_slides() -> None:
    """Table 1 of chapter 12, guides inwards at 45 degrees: s = 0.179684, 0.292805, 0.425146 at z = 0.6, 0.7, 0.8."""
    from pkm_exact.geometry.hexagons import semi_regular_hexagon

    corners = semi_regular_hexagon(1, "0.09")
    radius = Fraction("0.605006887")
    directions = [[str(-x), str(-y), str(radius)] for x, y, _ in corners]
    robot = robot_from_toml(HEXAM.replace("DIRECTIONS", str(directions)))
    assert corners[0][0] ** 2 + 3 * corners[0][1] ** 2 == pytest.approx(0.3660333333)
    for height, expected in (("0.6", 0.179684), ("0.7", 0.292805), ("0.8", 0.425146)):
        modes = joint_modes(robot, (ZERO, ZERO, Fraction(height)), rotation_of((ONE, ZERO, ZERO, ZERO), (1, 3, 1)))  # type: ignore[arg-type]
        lower = [_float(leg[0].position) * float(radius) * sqrt(2) for leg in modes]  # type: ignore[union-attr]
        upper = [_float(leg[1].position) * float(radius) * sqrt(2) for leg in modes]  # type: ignore[union-attr]
        assert lower == pytest.approx([expected] * 6, abs=1e-6)
        assert min(upper) > 0.6, "beyond the guides"
    outwards = robot_from_toml(HEXAM.replace("DIRECTIONS", str([[str(x), str(y), str(radius)] for x, y, _ in corners])))
    modes = joint_modes(outwards, (ZERO, ZERO, Fraction("0.7")), rotation_of((ONE, ZERO, ZERO, ZERO), (1, 3, 1)))  # type: ignore[arg-type]
    assert modes == [()] * 6


@pytest.mark.parametrize(
    ("slides", "complex_ones", "real_ones"),
    [
        ([".292805"] * 6, 28, 8),
        ([".31", ".25", ".3", ".35", ".28", ".33"], 40, 12),
    ],
)
def test_assembly_modes_on_inclined_slides(slides: list[str], complex_ones: int, real_ones: int) -> None:
    """Guides inwards and radially: level at z = 0.7, and on unequal slides."""
    from pkm_exact.geometry.hexagons import semi_regular_hexagon

    radius = Fraction("0.605006887")
    directions = [[str(-x), str(-y), str(radius)] for x, y, _ in semi_regular_hexagon(1, "0.09")]
    values = [str((Fraction(s) / radius / Fraction(sqrt(2))).limit_denominator(10**5)) for s in slides]
    text = HEXAM.replace("DIRECTIONS", str(directions))
    solution = found(robot_from_toml(f'{text}[[configurations]]\nname = "home"\nslides = {values}\n'))
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, complex_ones)
    assert len(solution.poses) == real_ones
    if len(set(slides)) == 1:
        assert any(place == pytest.approx((0, 0, 0.7), abs=2e-5) for place in places(solution))


def test_the_shipped_hexapod_on_inclined_slides_has_the_hexagons_of_table_1() -> None:
    """Guides in pairs: with rods upright six equal parallel legs join congruent hexagons, which move."""
    from pkm_exact.geometry.hexagons import semi_regular_hexagon
    from pkm_exact.geometry.robot import Robot
    from pkm_exact.screws.exact_matrix import rank

    robot = model("inclined-slides")
    assert isinstance(robot, Robot)
    assert set(robot.base_joints) == set(semi_regular_hexagon(1, "0.09"))
    assert set(robot.platform_joints) == set(semi_regular_hexagon("0.5", "0.09"))
    solution = solved("inclined-slides")
    assert (solution.claim, solution.complex_solutions, len(solution.poses)) == (Claim.COMPLETE, 40, 4)
    upright = robot.problem(robot.configuration("upright rods"))
    assert all(leg.base[:2] == leg.platform[:2] and leg.base[2] == Fraction(1, 6) for leg in upright.distances)
    rows = [(0, 0, 1, y, -x, 0) for x, y, _ in (leg.platform for leg in upright.distances)]
    assert rank(rows, 6) == 3
    # The sliders are at z = sqrt(3)/6, the rods are 1/2: z = 1/2 + 1/(2 sqrt(3)) = 0.788675 is within the travel.
    assert {leg.length_squared for leg in upright.distances} == {Fraction(1, 4)}
    assert solve(upright).claim is Claim.POSITIVE_DIMENSIONAL_PROVED


# Chapter 13: 3-PRRR


def test_a_region_of_the_rotary_3_prrr_with_four_real_poses() -> None:
    """Half tangents (1/2, 0, 3/2); each pose closes the three loops of the book."""
    angles = [(0.6, 0.8), (1.0, 0.0), (-5 / 13, 12 / 13)]
    solution = found(drawn("3-PRRR", half_tangents='["1/2", 0, "3/2"]'))
    assert (solution.claim, solution.complex_solutions, len(solution.poses)) == (Claim.COMPLETE, 8, 4)
    (c1, s1), (c2, s2), (c3, s3) = angles
    for x, y, z in (middle(pose)[0] for pose in solution.poses):
        loops = [
            (y - 0.5 * c1 - 0.105, z - 0.5 * s1),
            (z - 0.5 * c2, x - 0.5 * s2 - 0.105),
            (x - 0.5 * c3, y - 0.9144 + 0.105 + 0.5 * s3),
        ]
        assert [a * a + b * b for a, b in loops] == pytest.approx([0.373**2] * 3, abs=1e-9)
    assert len(places(solution)) == 4


@pytest.mark.parametrize(
    ("angles", "heights"),
    [
        ("[89.411, 93.107, 82.085]", [0.14312, 0.3]),
        ("[89.411, 0.589, 82.085]", [0.14971, 0.1594, 0.3, 0.69995, 0.84054, 0.85024]),
    ],
)
def test_real_poses_of_the_rotary_3_prrr_by_region(angles: str, heights: list[float]) -> None:
    solution = found(drawn("3-PRRR", degrees=angles))
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 8)
    assert sorted(middle(pose)[0][2] for pose in solution.poses) == pytest.approx(heights, abs=2e-3)


def test_the_slides_of_the_3_prrr_are_its_coordinates_and_eight_working_modes_turn_it() -> None:
    linear = found(drawn("3-PRRR", 'driven="P"', offsets='["1/3", "1/4", "1/5"]'))
    assert (linear.claim, linear.complex_solutions) == (Claim.COMPLETE, 1)
    assert places(linear) == {(0.333333, 0.25, 0.2)}
    centre = (Fraction("0.425"), Fraction("0.425"), Fraction("0.3"))
    joints = joint_values(drawn("3-PRRR"), centre, rotation_of((ONE, ZERO, ZERO, ZERO)))
    assert [len(joint.modes) for joint in joints] == [2, 2, 2]
    angles = [sorted(2 * atan(_float(mode.half_tangent)) * 180 / pi for mode in joint.modes) for joint in joints]  # type: ignore[union-attr]
    for own, expected in zip(angles, (89.411, 93.107, 82.085), strict=True):
        assert min(abs(angle - expected) for angle in own) < 6e-4


def _float(value: Any) -> float:
    return float(value.p) + float(value.q) * sqrt(value.n)


# Chapter 15: 3-PSS+C


@pytest.mark.parametrize(
    ("base", "heights"),
    [("7", "[0, 0, 0]"), ("7", '[0, "1/2", "-1/4"]'), ("7", '[0, 1, "-1/2"]'), ("7", "[0, 2, -1]"), ("8", "[0, 0, 0]")],
)
def test_all_five_real_counts_of_the_reflector_support(base: str, heights: str) -> None:
    solution = found(drawn("3-PSS+C", f"base_radius={base}", slides=heights))
    assert (solution.claim, solution.complex_solutions, len(solution.poses)) == (Claim.COMPLETE, 24, 8)


# Chapter 16: 2-UPS+U


@pytest.mark.parametrize("tangents", [("1/3", "-1/2"), ("1/5", "2/7"), (0, "1/4")])
def test_the_lengths_of_the_struts_obey_the_identities(tangents: tuple[Any, Any]) -> None:
    """L1^2 - L2^2 = 4 K sx (K sy - L),  L1^2 + L2^2 = 8 K^2 + 2 L^2 - 4 K (K cy + L cx sy + K cx), R = Ry Rx."""
    (sx, cx), (sy, cy) = ((2 * t / (1 + t * t), (1 - t * t) / (1 + t * t)) for t in map(Fraction, tangents))
    rotation = (cy, sy * sx, sy * cx), (ZERO, cx, -sx), (-sy, cy * sx, cy * cx)
    robot, k, height = model("2-ups-u"), 1, 4
    values = robot.values_at((ZERO,) * 3, rotation)  # type: ignore[union-attr]
    one, two = values["leg 1"], values["leg 2"]
    assert one - two == 4 * k * sx * (k * sy - height)
    assert one + two == 8 * k * k + 2 * height**2 - 4 * k * (k * cy + height * cx * sy + k * cx)
    assert values["universal joint"] == 0


def test_both_models_of_the_strutted_joint_have_eight_poses() -> None:
    robot = drawn("2-UPS+U", 'mounted="base"', lengths='["17/4", "15/4"]', half_tangents='["1/3"]')
    solution = found(robot)
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 8)


def test_unturned_and_turned_by_a_right_angle_the_models_compose() -> None:
    """With T = Ry Rx Rz, the turn of the printed model is a turn of the platform before it is tilted."""
    plate = {str(np.round(middle(p)[1], 6) + 0.0) for p in found(model("2-ups-u")).poses}
    for turn in ("0", "90", "180"):
        robot = drawn("2-UPS+U", 'mounted="base"', lengths='["17/4", "15/4"]', degrees=f"[{turn}]")
        angle = np.radians(float(turn))
        rz = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        solution = found(robot)
        assert solution.complex_solutions == 8
        if turn == "0":
            assert {str(np.round(middle(p)[1] @ rz.T, 6) + 0.0) for p in solution.poses} == plate
        for pose in solution.poses:
            tilt = middle(pose)[1] @ rz.T
            assert tilt[1, 0] == pytest.approx(0, abs=1e-8), "Ry Rx"
            corners = [rz @ [1, y, 0] for y in (-1, 1)]
            lengths = [np.linalg.norm(middle(pose)[1] @ [1, y, 4] - a) for y, a in zip((-1, 1), corners, strict=True)]
            assert lengths == pytest.approx([17 / 4, 15 / 4])


# Chapter 17: a hexapod on a carriage


def test_the_carriage_takes_its_hexapod_along() -> None:
    """Forty poses; moved by X, Y and the heading they move along."""
    robot = drawn("carriage-hexapod")
    squares, carriage = robot.configuration().values[:6], robot.configuration().values[6:]
    solution = solve(robot.problem([*squares, *carriage]))
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 40)
    moved = solve(robot.problem([*squares, Fraction(11), Fraction(-2), carriage[2]]))
    assert {(round(x + 10, 5), round(y - 4, 5), z) for x, y, z in places(solution, 5)} == {
        (round(x, 5), round(y, 5), z) for x, y, z in places(moved, 5)
    }
    turned = drawn("carriage-hexapod", 'heading="90"')
    other = solve(turned.problem([*squares, Fraction(-2), Fraction(1), carriage[2]]))
    assert {(round(-y, 4) + 0.0, round(x, 4) + 0.0, round(z, 4)) for x, y, z in places(solution, 6)} == {
        (round(x, 4) + 0.0, round(y, 4) + 0.0, round(z, 4)) for x, y, z in places(other, 6)
    }


def test_the_legs_of_a_carriage_are_those_of_its_configuration(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["legs", str(MODELS / "carriage-hexapod.toml"), "--position", "1,6,9", "--quaternion", "1,0,0,0"]
    assert main([*words, "--format", "json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    robot = model("carriage-hexapod")
    home = robot.configuration()
    legs = robot.locked(home.values, "home")
    place = (Fraction(1), Fraction(6), Fraction(9))
    squares = [
        str(distance_squared(leg.base, leg.platform, place, UNTURNED, (1, 1, 1)))  # type: ignore[attr-defined]
        for leg in legs
    ]
    assert [entry["value_squared"] for entry in answer["constraints"]] == squares
    assert answer["standing"] == {"configuration": "home", "values": {"X": "1", "Y": "2", "tilt": ["4/5", "3/5"]}}
    for name in ("home", None):
        assert main([*words, *(["--configuration", name] if name else [])]) == 0
        assert "X 1, Y 2, tilt (cosine 4/5, sine 3/5), as in configuration home" in capsys.readouterr().out
    assert main([*words, "--configuration", "away"]) == 2
    capsys.readouterr()
    for name, pose in (("biglide", ["--position", "0,7,0"]), ("rolland-6-6", words[2:])):
        assert main(["legs", str(MODELS / f"{name}.toml"), *pose, "--configuration", "home"]) == 2
        assert "the pose says what all joint values are" in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.parametrize("branch", [0, 1])
def test_forward_kinematics_of_both_branches_of_the_carriage_contains_the_pose(branch: int) -> None:
    robot = drawn("carriage-hexapod")
    x, y, cosine, sine = carriage_branches((ONE, Fraction(2), Fraction(3)), Fraction(2), Fraction(5), "0")[branch]
    place, rotation = (Fraction(2), Fraction(3), Fraction(11)), rotation_of(tuple(map(Fraction, (9, 1, -1, 2))))  # type: ignore[arg-type]
    axes = (x.p, y.p, (cosine.p, sine))
    still = standing(robot, LockedValues("here", (*[ONE] * 6, *axes))).mechanism
    squares = still.values_at(place, rotation)
    solution = solve(robot.problem([*(squares[f"leg {k}"] for k in range(1, 7)), *axes]))
    assert solution.complex_solutions == 40
    assert contains(solution, place, rotation)


@pytest.mark.parametrize("heading", ["0", "90", "180", "-90"])
def test_both_branches_of_the_carriage_bring_the_arm_to_a_point(heading: str) -> None:
    """The arm's end is where a leg of length 0 would stand: the foot of one whose base joint is the end itself."""
    end = Fraction(1), Fraction(2), Fraction(3)
    branches = carriage_branches(end, Fraction(2), Fraction(5), heading)
    assert len(branches) == 2
    robot = drawn(
        "carriage-hexapod",
        f'heading="{heading}"',
        "base=[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [2, 1, 1]]",
    )
    for x, y, cosine, sine in branches:
        values = [*[Fraction(1)] * 6, x.p, y.p, (cosine.p, sine)]
        assert robot.locked(values, "x")[0].base == end  # type: ignore[attr-defined]
    assert carriage_branches((ZERO, ZERO, Fraction(6)), Fraction(2), Fraction(5), heading) == ()
    assert len(carriage_branches((ZERO, ZERO, Fraction(5)), Fraction(2), Fraction(5), heading)) == 1


# Chapter 18: P-FUS


def test_the_modes_of_the_reconfigurable_robot() -> None:
    assert solved("p-fus").complex_solutions == 16
    cranks = {"4": '["1/2"]', "5": '["1/2", "2/3"]', "6": '["1/2", "2/3", "3/5"]'}
    for freedoms, tangents in cranks.items():
        robot = drawn("P-FUS", f'freedoms="{freedoms}"', slides="[30, 35, 27]", half_tangents=tangents)
        assert len(robot.constraints) == 6
        assert sum(found.type == "in-plane" for found in robot.constraints) == 6 - int(freedoms)


def test_the_other_modes_are_shipped_with_their_counts() -> None:
    counts = {"p-fus-4": 32, "p-fus-5": 40, "p-fus-6": 40, "carriage-hexapod": 40}
    assert {name: golden(name)["complex_solutions"] for name in counts} == counts
    assert {golden(name)["claim"] for name in counts} == {"complete"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("freedoms", "tangents", "count"),
    [("4", '["1/2"]', 32), ("5", '["1/2", "2/3"]', 40), ("6", '["1/2", "2/3", "3/5"]', 40)],
)
def test_the_other_modes_have_as_many_poses_as_said(freedoms: str, tangents: str, count: int) -> None:
    robot = drawn("P-FUS", f'freedoms="{freedoms}"', slides="[30, 35, 27]", half_tangents=tangents)
    solution = found(robot)
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, count)


# Chapter 19: H4


def test_the_positions_of_the_slides_of_the_h4_are_those_printed() -> None:
    """Inverse kinematics at (5, -5, -30), 30 degrees, to nine digits of 2 - sqrt(3)."""
    turn = rotation_of((ONE, ZERO, ZERO, Fraction("0.267949192")))
    joints = joint_values(model("h4"), (Fraction(5), Fraction(-5), Fraction(-30)), turn)  # type: ignore[arg-type]
    upper = [_float(joint.modes[1].position) for joint in joints]  # type: ignore[union-attr]
    assert upper == pytest.approx([13.0208340, -7.4879553, 9.6786127, 15.7697401], abs=2e-7)
    assert [len(joint.modes) for joint in joints] == [2, 2, 2, 2], "sixteen working modes"


def test_both_poses_of_the_h4_and_no_twelve_or_sixteen() -> None:
    """The source counts 16 and finds 12; 8 is proved, and 12 = 8 + 4 are those and a squared leading coefficient."""
    solution = found(drawn("H4", slides="[13.021, -7.488, 9.679, 15.770]"))
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 8)
    angles = sorted(2 * atan(float(p.quaternion[3].midpoint) / float(p.quaternion[0].midpoint)) for p in solution.poses)
    assert angles == pytest.approx([2 * atan(-2.8822772941), 2 * atan(0.2679575385)], abs=1e-6)
    assert {tuple(np.round(middle(p)[0], 1) + 0.0) for p in solution.poses} == {(5.0, -5.0, -30.0), (3.0, -8.0, -14.6)}


def test_the_h4_at_home_has_four_real_poses() -> None:
    solution = found(model("h4"), "zero")
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 8)
    assert places(solution, 4) == {(0, 0, 42), (0, 0, -42), (0.4216, -4.6717, 28.3647), (0.4216, -4.6717, -28.3647)}
    tangents = {float(p.quaternion[3].midpoint) / float(p.quaternion[0].midpoint) for p in solution.poses}
    for value in tangents:
        assert value**2 * (9 * value**3 + 18 * value**2 + 5 * value + 14) == pytest.approx(0, abs=1e-5)


# From practice


def test_a_pentapod_has_each_position_of_its_axis_twice() -> None:
    solution = solved("pentapod")
    assert (solution.claim, solution.complex_solutions, len(solution.poses)) == (Claim.COMPLETE, 16, 8)
    axes = {
        (*np.round(position, 5), *np.round(rotation[:, 2], 6)) for position, rotation in map(middle, solution.poses)
    }
    assert len(axes) == 4
    free = drawn("pentapod", 'spin="free"')
    moving = found(free)
    assert moving.claim is Claim.POSITIVE_DIMENSIONAL_PROVED
    assert "turning about their line" in " ".join(moving.notes)


def test_four_legs_move_and_eight_must_fit() -> None:
    assert solved("4-4").claim is Claim.POSITIVE_DIMENSIONAL_PROVED
    rounded = solved("8-8")
    assert (rounded.claim, rounded.complex_solutions) == (Claim.COMPLETE, 4)
    assert all(pose.condition.lo > 10**8 for pose in rounded.poses), "what rounding leaves"  # type: ignore[union-attr]


def test_three_legs_about_a_point_and_a_spherical_robot_have_eight_poses() -> None:
    for name in ("ankle", "spherical-3-rrr"):
        solution = solved(name)
        assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 8)
        assert places(solution) == {(0, 0, 0)}


def test_the_links_of_the_spherical_robot_keep_their_angles() -> None:
    robot = model("spherical-3-rrr")
    solution = solved("spherical-3-rrr")
    for pose in solution.poses:
        rotation = middle(pose)[1]
        for link in solution.problem.constraints:
            assert isinstance(link, Angle)
            w, v = (np.array(list(map(float, side))) for side in (link.base, link.platform))
            assert np.linalg.norm(w) == pytest.approx(1)
            assert w @ rotation @ v == pytest.approx(0, abs=1e-8)
    assert robot.kind == "spherical-3-RRR"


def test_equal_arms_set_heights_and_distances() -> None:
    """micabo h: twelve poses, as heights leave two signs of the third axis and six poses in the plane."""
    solution = solved("micabo-h")
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 12)
