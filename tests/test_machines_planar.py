"""Planar machines and points in the plane, against the numbers of their sources."""

import json
import re
from fractions import Fraction
from itertools import product
from math import atan2, cos, degrees, hypot, radians, sin, sqrt
from pathlib import Path

import numpy as np
import pytest
from flint import fmpq_mpoly_ctx
from samples import model

from pkm_exact.claim import Claim
from pkm_exact.cli.main import main
from pkm_exact.engine import solve
from pkm_exact.errors import InputError
from pkm_exact.geometry.drive_modes import joint_values
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.geometry.working_modes import CrankMode
from pkm_exact.solution import Solution
from pkm_exact.statics.placement import held_at

UNTURNED = rotation_of((Fraction(1), Fraction(0), Fraction(0), Fraction(0)))
HEAD = 'schema = 1\nname = "r"\nunit = "m"\nsource = "a test"\n'
BASE = ["-1/4", "-1/12"], ["1/4", "-1/12"], ["0", "1/6"]
PLATFORM = ["-1/10", "-1/30"], ["1/10", "-1/30"], ["0", "1/15"]
X, Y, TURN = 0.03, 0.02, 0.2
"""The pose at which the digest of chapter 6 gives joint values and the second pose."""


def found(robot: Mechanism, name: str | None = None) -> Solution:
    return solve(robot.problem(robot.configuration(name)))


def points() -> list[tuple[complex, complex]]:
    """Base and platform joints at the pose, in ordinary coordinates."""
    turn = complex(cos(TURN), sin(TURN))
    sides = [[complex(float(Fraction(x)), float(Fraction(y)) * sqrt(3)) for x, y in side] for side in (BASE, PLATFORM)]
    return [(a, complex(X, Y) + turn * b) for a, b in zip(*sides, strict=True)]


def planar(kind: str, extra: str, joints: str, driven: str) -> Mechanism:
    text = f'{HEAD}kind = "{kind}"\nmetric = [1, 3]\n'
    text += f"[base]\njoints = {list(BASE)}\n[platform]\njoints = {list(PLATFORM)}\n"
    robot = robot_from_toml(
        f'{text}[actuators]\ndriven = "{driven}"\n{extra}[[configurations]]\nname = "home"\n{joints}\n'
    )
    assert isinstance(robot, Mechanism)
    return robot


def plane_poses(solution: Solution) -> set[tuple[float, ...]]:
    return {
        tuple(round(float(v.midpoint), 4) for v in (*pose.position[:2], pose.rotation[0][0], pose.rotation[1][0]))
        for pose in solution.poses
    }


HERE = (0.03, 0.02, round(cos(TURN), 4), round(sin(TURN), 4))


def test_three_cranks_of_chapter_6_have_six_poses_two_of_them_real() -> None:
    cranks = '[cranks]\nat_0 = [["1/5", 0], ["1/5", 0], ["1/5", 0]]\n[rods]\nlength = "1/5"\n'
    robot = planar("3-RRR", cranks, "degrees = [82.342987, 195.928503, -20.303394]", "R")
    solution = found(robot)
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 6)
    assert plane_poses(solution) == {HERE, (-0.0029, 0.0468, -0.1093, -0.994)}
    assert len(robot.configuration().stand_ins) == 3


def test_three_slides_of_chapter_6_have_six_poses_two_of_them_real() -> None:
    slides = '[slides]\ndirections = [[1, 0], ["-1/2", "1/2"], ["-1/2", "-1/2"]]\n[rods]\nlength = 0.23\n'
    solution = found(planar("3-PRR", slides, "slides = [0.40601, 0.39356, 0.345307]", "P"))
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 6)
    near = {tuple(round(v, 3) for v in pose) for pose in plane_poses(solution)}
    assert near == {tuple(round(v, 3) for v in HERE), (0.005, -0.003, -0.973, -0.23)}


def test_three_driven_directions_have_two_poses() -> None:
    angles = [f"{degrees(atan2((p - a).imag, (p - a).real)):.9f}" for a, p in points()]
    solution = found(planar("3-RPR", "", f"degrees = [{', '.join(angles)}]", "R"))
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 2)
    assert plane_poses(solution) == {HERE, (0.067, 0.0447, -0.8961, 0.4439)}


IN_BRANCH = {
    "RPR": ("RP", 'half_tangents = ["1/2", "1/3", "-1/2"]\nslides = [5, 10, 5]\n', ""),
    "RRR": (
        "RR",
        'half_tangents = [0, 0, 0]\nlink_half_tangents = ["1/2", "1/3", "-1/2"]\n',
        "[cranks]\nat_0 = [[2, 0], [2, 0], [2, 0]]\n[rods]\nlengths = [5, 10, 5]\n",
    ),
    "PRR": (
        "PR",
        'slides = [2, 2, 2]\nlink_half_tangents = ["1/2", "1/3", "-1/2"]\n',
        "[slides]\ndirections = [[1, 0], [1, 0], [1, 0]]\n[rods]\nlengths = [5, 10, 5]\n",
    ),
}


def in_branch(chain: str, joints: str | None = None) -> Mechanism:
    """Legs of lengths 5, 10, 5 in the directions (3/5, 4/5), (4/5, 3/5), (3/5, -4/5), to the corners of a triangle."""
    driven, own, extra = IN_BRANCH[chain]
    shift = 0 if chain == "RPR" else 2
    ends = [(3, 4), (8, 6), (3, -4)]
    corners = [(0, 0), (4, 0), (1, 3)]
    base = [[x - dx - shift, y - dy] for (x, y), (dx, dy) in zip(corners, ends, strict=True)]
    text = f'{HEAD}kind = "3-{chain}"\n[base]\njoints = {base}\n[platform]\njoints = {[list(c) for c in corners]}\n'
    text += f'[actuators]\ndriven = "{driven}"\n{extra}[[configurations]]\nname = "home"\n'
    robot = robot_from_toml(text + (joints or own))
    assert isinstance(robot, Mechanism)
    return robot


@pytest.mark.parametrize("chain", IN_BRANCH)
def test_both_driven_joints_of_a_leg_have_working_modes_together(chain: str) -> None:
    """Two in each leg, eight in all; from every one of them the pose, and at irrational ones the leg's end, exactly."""
    robot = in_branch(chain)
    joints = joint_values(robot, (Fraction(0),) * 3, UNTURNED)
    assert [len(joint.modes) for joint in joints] == [2, 2, 2]
    assert sorted(", ".join(joint.name for joint in joints).split(", ")) == sorted(robot.actuated)
    combinations = list(product(*(joint.modes for joint in joints)))
    for modes in combinations if chain == "RRR" else (combinations[0], combinations[-1]):
        values = dict(value for mode in modes for value in mode.values)  # type: ignore[union-attr]
        rational = [
            (mode.cos.p, mode.sin.p) if isinstance(mode, CrankMode) else mode.position.p  # type: ignore[union-attr]
            for mode in (values[name] for name in robot.actuated)
        ]
        assert plane_poses(solve(robot.problem(rational))) == {(0, 0, 1, 0)}  # type: ignore[arg-type]
    aside = (Fraction(-1, 3), Fraction(1, 7), Fraction(0))
    for signs in ("-++", "+2-"):
        held = held_at(robot, aside, UNTURNED, modes=signs)
        assert len(held.actuators) == 6
    with pytest.raises(InputError, match="is not a sign"):
        held_at(robot, aside, UNTURNED, modes="++++++")
    far = joint_values(robot, (Fraction(90), Fraction(0), Fraction(0)), UNTURNED)
    assert [bool(joint.modes) for joint in far] == [chain != "RRR"] * 3
    assert all(joint.discriminant is not None and (joint.discriminant >= 0) == bool(joint.modes) for joint in far)


def test_a_stretched_leg_has_one_pair() -> None:
    robot = in_branch("RRR")
    corner = (Fraction(7 - 5), Fraction(0) - 4, Fraction(0))  # foot (-5, -4), arms 2 and 5 along x
    joint = joint_values(robot, corner, UNTURNED)[0]
    assert (len(joint.modes), joint.discriminant) == (1, 0)
    (pair,) = joint.modes
    assert [(value.cos.p, value.sin.p) for _, value in pair.values] == [(1, 0), (1, 0)]  # type: ignore[union-attr]


def test_legs_prints_pairs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "pairs.toml"
    path.write_text(
        f'{HEAD}kind = "3-RRR"\n[base]\njoints = [[-5, -4], [-6, -6], [-4, 7]]\n'
        "[platform]\njoints = [[0, 0], [4, 0], [1, 3]]\n"
        f'[actuators]\ndriven = "RR"\n{IN_BRANCH["RRR"][2]}'
    )
    words = ["legs", str(path), "--position", "0,0", "--half-tangent", "0"]
    assert main(words) == 0
    out = capsys.readouterr().out
    assert "8 working modes\nactuator" in out
    assert len(re.findall(r"^ *(crank|link) \d +", out, re.M)) == 12
    assert main([*words, "--format", "json"]) == 0
    actuators = json.loads(capsys.readouterr().out)["actuators"]
    assert [actuator["name"] for actuator in actuators] == [f"crank {k}, link {k}" for k in (1, 2, 3)]
    assert list(actuators[0]["modes"][0]["joints"]) == ["crank 1", "link 1"]


@pytest.mark.parametrize("chain", IN_BRANCH)
def test_two_driven_joints_in_a_leg_hold_a_point(chain: str) -> None:
    solution = found(in_branch(chain))
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 1)
    assert plane_poses(solution) == {(0, 0, 1, 0)}
    other = found(in_branch(chain, IN_BRANCH[chain][1].replace("10", "9").replace('"1/3"', '"1/4"')))
    assert other.claim is Claim.INCONSISTENT


def test_the_fourth_leg_of_the_dual_v_must_fit() -> None:
    robot = model("dual-v")
    solution = found(robot)
    assert (solution.claim, solution.complex_solutions, len(solution.poses)) == (Claim.COMPLETE, 1, 1)
    assert plane_poses(solution) == {(0, 0, 1, 0)}
    assert found(robot, "does not fit").claim is Claim.INCONSISTENT
    joints = joint_values(robot, (Fraction(0),) * 3, UNTURNED)
    assert [len(joint.modes) for joint in joints] == [2, 2, 2, 2], "sixteen working modes"


def test_measured_ranges_do_not_fit_and_those_of_a_pose_do() -> None:
    robot = model("ranges-plane")
    assert found(robot).claim is Claim.INCONSISTENT
    solution = found(robot, "of a pose")
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 1)
    assert plane_poses(solution) == {(1, 5, round(12 / 13, 4), round(5 / 13, 4))}


@pytest.mark.parametrize("count", [3, 5, 10])
@pytest.mark.parametrize("size", [2, 3])
def test_ranges_to_a_point(count: int, size: int) -> None:
    anchors = [[(7 * k) % 11, (5 * k * k) % 13, (3 * k) % 7][:size] for k in range(count)]
    place = ["1/3", "5/2", "2" if size == 3 else 0]
    text = f'{HEAD}kind = "ranges"\n[dimensions]\nanchors = {anchors}\n'
    robot = robot_from_toml(f'{text}[[configurations]]\nname = "home"\npose = {{ position = {place} }}\n')
    solution = found(robot)  # type: ignore[arg-type]
    expected = 2 if count == size == 3 else 1
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, expected)


def test_the_bipod_has_the_poses_of_figures_9_and_10() -> None:
    places = {tuple(round(float(x.midpoint), 6) for x in pose.position[:2]) for pose in found(model("bipod")).poses}
    assert places == {(25, 60), (25, -60)}


def test_the_biglide_has_two_poses_and_four_working_modes() -> None:
    robot = model("biglide")
    places = {tuple(round(float(x.midpoint), 6) for x in pose.position[:2]) for pose in found(robot).poses}
    assert places == {(0, 0), (0, 6)}
    joints = joint_values(robot, (Fraction(0),) * 3, UNTURNED)
    assert [[str(mode.position) for mode in joint.modes] for joint in joints] == [["-3", "3"]] * 2  # type: ignore[union-attr]
    meeting = joint_values(robot, (Fraction(-1), Fraction(0), Fraction(0)), UNTURNED)
    assert meeting[0].discriminant == 0, "L1 + 1 is the length of the strut"


def test_three_legs_to_a_point_leave_one_place_or_none() -> None:
    robot = model("rp-2rpr")
    solution = found(robot)
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 1)
    squares = list(robot.configuration().values)
    assert solve(robot.problem([*squares[:2], squares[2] + 1])).claim is Claim.INCONSISTENT  # type: ignore[operator]


def test_the_v_shape_has_two_forward_solutions() -> None:
    """Not one, as its unit Jacobian in the middle may suggest."""
    assert found(model("v-shape")).complex_solutions == 2
    assert found(model("x-y")).complex_solutions == 1
    assert found(model("pmar-collinear")).complex_solutions == 1


def synchronisation() -> tuple:  # type: ignore[type-arg]
    """The condition on q1, q2, q3 and L under which three rods 120 degrees apart meet, by elimination.

    With X = |x|^2 the equations X - 2 q_i u_i.x + q_i^2 = L^2 are linear in X and x; they are solved by minors, and put
    into X = |x|^2. Coordinates in the metric (1, 3).
    """
    context = fmpq_mpoly_ctx.get(("q1", "q2", "q3", "L"), "lex")
    q1, q2, q3, size = context.gens()
    rows = [
        [1 + 0 * q, -2 * q * a, -6 * q * b, size**2 - q**2]
        for q, (a, b) in zip(
            (q1, q2, q3),
            ((Fraction(1), Fraction(0)), (Fraction(-1, 2), Fraction(1, 2)), (Fraction(-1, 2), Fraction(-1, 2))),
            strict=True,
        )
        for a, b in [(_rational(a), _rational(b))]
    ]

    def minor(*columns: int):  # type: ignore[no-untyped-def]
        (a, b, c), (d, e, f), (g, h, i) = ([row[k] for k in columns] for row in rows)
        return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)

    det, square, x, y = minor(0, 1, 2), minor(3, 1, 2), minor(0, 3, 2), minor(0, 1, 3)
    return square * det - x * x - 3 * y * y, (q1, q2, q3, size)


def _rational(value: Fraction):  # type: ignore[no-untyped-def]
    from flint import fmpq

    return fmpq(value.numerator, value.denominator)


def test_the_synchronisation_equation_follows_by_elimination() -> None:
    """With s = sum q / sum 1/q it reads  sum (q_i^2 - s)^2 / q_i^2 = 6 (L^2 - s)."""
    eliminant, (q1, q2, q3, size) = synchronisation()
    total, products = q1 + q2 + q3, q1 * q2 + q2 * q3 + q3 * q1
    volume = q1 * q2 * q3
    # s = total volume / products; everything times (products q1 q2 q3)^2
    left = sum(
        (q * q * products - total * volume) ** 2 * (a * b) ** 2
        for q, a, b in ((q1, q2, q3), (q2, q3, q1), (q3, q1, q2))
    )
    right = 6 * volume**2 * (size * size * products**2 - total * volume * products)
    _, factors = eliminant.factor()
    own = [factor for factor, _ in factors if factor.degrees()[3]]
    assert len(own) == 1
    assert divmod(left - right, own[0])[1] == 0


@pytest.mark.parametrize(("slides", "complex_solutions"), [([7, 7, 7], 1), ([8, 5, 7], 0)])
def test_positions_fit_together_where_the_synchronisation_equation_holds(
    slides: list[int], complex_solutions: int
) -> None:
    eliminant, _ = synchronisation()
    value = eliminant(*slides, 7)
    robot = model("pmar-120")
    solution = solve(robot.problem([Fraction(q) for q in slides]))
    assert solution.complex_solutions == complex_solutions
    assert (value == 0) == bool(complex_solutions)
    assert (solution.claim is Claim.INCONSISTENT) == (value != 0)


def test_the_case_study_of_three_slides_is_off_the_centre() -> None:
    """x = (-40, -10), L = 100, rails at 30, 150 and 270 degrees: q as printed in no table, but in the digest."""
    x = np.array([-40.0, -10.0])
    slides = []
    for angle in (30, 150, 270):
        u = np.array([cos(radians(angle)), sin(radians(angle))])
        normal = np.array([-u[1], u[0]])
        slides.append(x @ u + sqrt(100**2 - (x @ normal) ** 2))
    assert slides == pytest.approx([59.7139543409, 125.445973426, 101.651513899])
    sigma = sum(slides) / sum(1 / q for q in slides)
    assert sum((q * q - sigma) ** 2 / q**2 for q in slides) == pytest.approx(6 * (100**2 - sigma))
    assert hypot(*x) ** 2 == pytest.approx(100**2 - sigma)
