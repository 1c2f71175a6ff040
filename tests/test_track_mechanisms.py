"""``track`` for mechanisms declared by constraints: other constraints than legs, and other groups of motions."""

from __future__ import annotations

import csv
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest
from flint import arb
from samples import MODELS, model

from pkm_exact.cli.main import main
from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.errors import InputError
from pkm_exact.geometry.machines.machine_kinds import MACHINES
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.path_reader import path_from_csv
from pkm_exact.geometry.reader import read_robot, robot_from_toml
from pkm_exact.motions.motion_groups import SCHOENFLIES, SPHERICAL, TRANSLATION
from pkm_exact.numeric.centred import centred_form, centred_frames, form_size
from pkm_exact.numeric.path_forms import JointRow, path_forms, problem_at
from pkm_exact.numeric.trajectory import track_branch
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.precision import working_precision
from pkm_exact.solution import Solution
from pkm_exact.templates.machine_text import machine_text

Capture = pytest.CaptureFixture[str]
HINGED = next(path for path in MODELS if path.stem == "3-rps")


def vector(*values: int | str) -> Vector:
    x, y, z = map(Fraction, values)
    return x, y, z


ZERO = vector(0, 0, 0)


def rod(number: int, base: Vector, platform: Vector = ZERO) -> Distance:
    return Distance(base, platform, Fraction(1), f"rod {number}")


def mechanism(*constraints: Constraint, actuated: str = "", **more: object) -> Mechanism:
    names = tuple(actuated.split(", ")) if actuated else ()
    return Mechanism("a mechanism", "m", "made up", constraints, names, **more)  # type: ignore[arg-type]


DELTA = mechanism(
    rod(1, vector(1, 0, 0)),
    rod(2, vector("-1/2", "4/5", "1/10")),
    InPlane(vector(1, 2, 9), Fraction(1), ZERO, "slide"),
    actuated="rod 1, rod 2, slide",
    motion=TRANSLATION,
)
"""Two rods and a guided plane: no turns."""
WRIST = mechanism(
    Angle(vector(1, 0, 0), vector(0, 1, "1/3"), Fraction(0), "pitch"),
    Angle(vector(0, 1, 0), vector(0, "1/4", 1), Fraction(0), "roll"),
    rod(1, vector(2, 1, "1/2"), vector(1, "-1/3", 1)),
    actuated="pitch, roll, rod 1",
    motion=SPHERICAL,
)
"""Turns about the origin, measured by two products and a rod."""
SCARA = mechanism(
    rod(1, vector(2, 0, 0), vector("1/2", 0, 0)),
    rod(2, vector(-1, 2, 0), vector(0, "1/3", 0)),
    rod(3, vector(-1, -2, "1/2"), vector("-1/4", "-1/4", 0)),
    InPlane(vector(0, 0, 1), Fraction(1), ZERO, "height"),
    actuated="rod 1, rod 2, rod 3, height",
    motion=SCHOENFLIES,
    metric=(1, 3, 1),
)


def row(*values: str) -> JointRow:
    return tuple(map(Fraction, values))


CASES = {
    "3-rps": (read_robot(HINGED), [row("1.3", "1.5", "1.4"), row("1.35", "1.48", "1.4"), row("1.4", "1.5", "1.38")]),
    "delta": (DELTA, [row("2.2", "2.4", "8"), row("2.3", "2.4", "7"), row("2.2", "2.5", "6.5")]),
    "wrist": (WRIST, [row("0.3", "0.2", "2.1"), row("0.35", "0.1", "2.2"), row("0.2", "0.1", "2.3")]),
    "scara": (
        SCARA,
        [row("1.6", "3", "3.6", "1"), row("1.59", "3.02", "3.6", "1.01"), row("1.6", "3.04", "3.59", "1.02")],
    ),
    "cranks": (model("delta"), [row("0.75", "0.5", "0.66"), row("0.7", "0.4", "0.6"), row("0.6", "0.45", "0.7")]),
    "turned": (
        model("3-rpr-turned"),
        [row("0.2", "0.75", "-1.25"), row("0.22", "0.76", "-1.24"), row("0.21", "0.8", "-1.2")],
    ),
    "slides": (model("3-prs"), [row("1", "1.25", "0.75"), row("1.02", "1.2", "0.75"), row("1", "1.2", "0.8")]),
}


@cache
def solved_at(name: str, number: int) -> Solution:
    robot, rows = CASES[name]
    return solve_krawczyk(problem_at(robot, rows[number]))


@pytest.mark.parametrize("name", CASES)
def test_every_sample_is_a_pose_that_solve_lists_and_the_way_back_ends_where_it_began(name: str) -> None:
    robot, rows = CASES[name]
    poses = solved_at(name, 0).poses
    samples = list(track_branch(robot, [*rows, *rows[1::-1]], poses[0], poses=poses))
    assert len(samples) == 5
    assert len({sample.det_sign for sample in samples}) == 1
    for sample, number in zip(samples, (0, 1, 2, 1, 0), strict=True):
        listed = [pose for pose in solved_at(name, number).poses if pose.position == sample.pose.position]
        assert [pose for pose in listed if pose.rotation == sample.pose.rotation]
        assert {pose.jacobian.det_sign for pose in listed if pose.jacobian} >= {sample.det_sign}


@pytest.mark.parametrize("name", CASES)
def test_forms_between_rows_are_those_of_the_mechanism_there(name: str) -> None:
    robot, (first, last, _) = CASES[name]
    share = Fraction(2, 7)
    between = tuple(a + share * (b - a) for a, b in zip(first, last, strict=True))
    with working_precision(128):
        frames = centred_frames(problem_at(robot, first))
        zeroth, once, twice = path_forms(robot, frames, first, last).coefficients
        s = arb(share.numerator) / share.denominator
        rows = (zeroth + s * once + (s * s) * twice).tolist()[int(robot.motion.has_study_condition) :]
        for found, form in zip(rows, problem_at(robot, between).forms, strict=True):
            wanted = centred_form(form, frames, robot.metric)
            place = max(range(18), key=lambda k: abs(float(wanted[k])))
            scale = found[place] / wanted[place]
            assert all((entry - scale * value).contains(0) for entry, value in zip(found, wanted, strict=True))
            assert all(entry.rad() < 1e-30 for entry in found)


def test_sizes_of_forms_are_powers_of_two_near_the_largest_coefficient() -> None:
    form = tuple(Fraction(value) for value in (1, 0, -9, *[0] * 13, "1/3"))
    assert form_size(form) in (Fraction(8), Fraction(16))


ROD, CYLINDER = rod(1, ZERO, vector(1, 2, 3)), AxisDistance(ZERO, vector(0, 0, 1), ZERO, Fraction(4), "cylinder")


@pytest.mark.parametrize(
    ("robot", "part"),
    [
        (mechanism(ROD, CYLINDER, actuated="rod 1"), "one is a quadric (axis-distance)"),
        (mechanism(ROD, actuated="rod 1"), "1 equations for 6 freedoms"),
        (
            mechanism(*(rod(k, vector(k, k * k, k**3)) for k in range(4)), actuated="rod 1", motion=TRANSLATION),
            "4 equations for 3 freedoms",
        ),
    ],
)
def test_what_cannot_be_followed_is_refused(robot: Mechanism, part: str) -> None:
    pose = solved_at("delta", 0).poses[0]
    with pytest.raises(InputError) as error:
        next(track_branch(robot, [row("1"), row("2")], pose))
    assert part in str(error.value)
    assert "sweep" in str(error.value)


@pytest.mark.parametrize(
    ("robot", "text", "part"),
    [
        (DELTA, "1,2,-3\n1,0,3\n", "line 2, rod 2: 0 is not a length"),
        (DELTA, "rod 1,rod 2,slid\n", "name them [time,]rod 1,rod 2,slide"),
        (mechanism(ROD), "1\n", "no actuated constraints"),
        (
            mechanism(Distance(ZERO, ZERO, Fraction(1), "Time"), actuated="Time"),
            "1\n",
            "constraint time another name",
        ),
    ],
)
def test_bad_paths_are_refused(robot: Mechanism, text: str, part: str) -> None:
    with pytest.raises(InputError) as error:
        path_from_csv(text, robot)
    assert part in str(error.value)


def test_the_command_names_columns_by_the_actuated_constraints(tmp_path: Path, capsys: Capture) -> None:
    path, output = tmp_path / "path.csv", tmp_path / "out.csv"
    path.write_text("time,LEG 1,leg 2,leg 3\n0,1.3,1.5,1.4\n1/2,1.32,1.5,1.4\n")
    assert main(["track", str(HINGED), str(path), "--start", "1", "-o", str(output), "--exact"]) == 0
    assert "2 of 2 rows" in capsys.readouterr().out
    with output.open() as stream:
        rows = list(csv.DictReader(stream))
    assert list(rows[0])[:5] == ["row", "time", "joint_leg 1", "joint_leg 2", "joint_leg 3"]
    assert [found["joint_leg 1"] for found in rows] == ["13/10", "33/25"]
    robot = read_robot(HINGED)
    for found, values in zip(rows, (row("1.3", "1.5", "1.4"), row("1.32", "1.5", "1.4")), strict=True):
        poses = solve_krawczyk(problem_at(robot, values)).poses
        assert (found["x_lo"], found["z_hi"]) in [(str(p.position[0].lo), str(p.position[2].hi)) for p in poses]


def test_a_crank_that_shares_its_constraint_is_refused() -> None:
    kind = MACHINES["2-UPS+U"]
    text = machine_text(kind, "r", "m", {"mounted": '"base"'})
    robot = robot_from_toml(text + 'half_tangents = ["1/3"]\n')
    rows = [row("4.25", "3.75", "0.3"), row("4.25", "3.75", "0.4")]
    pose = solve_krawczyk(problem_at(robot, rows[0])).poses[0]
    with pytest.raises(
        InputError, match=r"constraint 'leg 1': a crank moves it, and so does another actuator \(leg 1, turn\)"
    ):
        next(track_branch(robot, rows, pose))
