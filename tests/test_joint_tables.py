"""Joints from arrays and CSV files, exactly as it is said, and robots written as model files."""

import math
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from samples import MODELS as PATHS

from pkm_exact import InputError, Robot
from pkm_exact.cli.main import main
from pkm_exact.geometry.model_writer import robot_text
from pkm_exact.geometry.reader import read_robot, robot_from_toml
from pkm_exact.geometry.robot import Robot as LeggedRobot

Capture = pytest.CaptureFixture[str]
LEGGED = [path for path in PATHS if isinstance(read_robot(path), LeggedRobot)]
HEADER = "base_x,base_y,base_z,platform_x,platform_y,platform_z"
ROWS = [
    (150 * math.cos(a), 150 * math.sin(a), 0.0, 100 * math.cos(b), 100 * math.sin(b), 0.0)
    for a, b in zip(np.radians([-10, 10, 110, 130, 230, 250]), np.radians([-50, 50, 70, 170, 190, 310]), strict=True)
]


@pytest.mark.parametrize("path", LEGGED, ids=lambda path: path.stem)
def test_a_robot_that_is_written_is_read_back(path: Path) -> None:
    robot = read_robot(path)
    assert robot_from_toml(robot_text(robot)) == robot  # type: ignore[arg-type]


def test_limits_tolerances_and_nominal_pose_are_written_too(tmp_path: Path) -> None:
    text = Path(PATHS[0].parent / "3-rpr-merlet-p.toml").read_text()
    text += '\n[limits]\nlengths = [1, "19/2"]\nposition = [[0, 9], [0, 9.5]]\n'
    text += "platform_cones = { axes = [0, -1], angle = 80 }\n"
    text += "\n[tolerances]\njoints = 0.001\n\n[nominal]\nposition = [5, 4]\nhalf_tangent = 0.25\n"
    robot = robot_from_toml(text)
    assert robot_from_toml(robot_text(robot)) == robot  # type: ignore[arg-type]


@given(st.integers(0, 8))
def test_floats_are_rounded_as_it_is_said(digits: int) -> None:
    robot = Robot.from_arrays([row[:3] for row in ROWS], np.array([row[3:] for row in ROWS]), digits=digits)
    for joint, row in zip(robot.base_joints, ROWS, strict=True):
        for x, y in zip(joint, row, strict=False):
            assert abs(x - Fraction(y)) <= Fraction(1, 2 * 10**digits)
            assert (x * 10**digits).denominator == 1


def test_floats_are_taken_exactly_only_if_that_is_said() -> None:
    base, platform = [row[:3] for row in ROWS], [row[3:] for row in ROWS]
    assert Robot.from_arrays(base, platform, doubles_are_exact=True).base_joints[0][0] == Fraction(ROWS[0][0])
    with pytest.raises(InputError, match=r"base\[1\]: .* is a binary float, .* say digits=6"):
        Robot.from_arrays(base, platform)
    with pytest.raises(InputError, match="not a finite number"):
        Robot.from_arrays([[math.nan, 0, 0], *base[1:]], platform, digits=3)
    with pytest.raises(InputError, match=r"base\[1\]: 0\.5 is a binary float"):
        Robot.from_arrays(np.full((6, 3), 0.5), platform)
    with pytest.raises(InputError, match="give one of the two"):
        Robot.from_arrays(base, platform, digits=3, doubles_are_exact=True)
    for digits in (-1, 3.5):
        with pytest.raises(InputError, match="give an integer from 0 to 30"):
            Robot.from_arrays(base, platform, digits=digits)  # type: ignore[arg-type]
    for wrong in (None, "abc", [1, 2, 3]):
        with pytest.raises(InputError, match=r"is no array; give a row of coordinates for each joint"):
            Robot.from_arrays(base, wrong, digits=3)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="4 numbers; give 2 or 3"):
        Robot.from_arrays([[1, 2, 3, 4], *base[1:]], platform, digits=3)


def _table(tmp_path: Path, header: str = HEADER, rows: list[str] | None = None) -> Path:
    lines = rows if rows is not None else [",".join(f"{x:.7f}" for x in row) for row in ROWS]
    path = tmp_path / "joints.csv"
    path.write_text("\n".join([header, *lines]) + "\n")
    return path


def test_a_model_from_a_table_of_joints(tmp_path: Path, capsys: Capture) -> None:
    path, model = _table(tmp_path), tmp_path / "robot.toml"
    assert main(["new", "--csv", str(path), "--height", "220", "--digits", "3", "-o", str(model)]) == 0
    robot = Robot.load(model)
    assert robot.base_joints[0][1] == Fraction(round(ROWS[0][1] * 1000), 1000)
    assert "rounded to 3 decimals" in robot.source
    assert "next: certify-poses solve" in capsys.readouterr().out
    assert main(["new", "--csv", str(path), "--height", "220", "-o", "-"]) == 0
    assert "exactly as it was given" in capsys.readouterr().out
    with_lengths = _table(tmp_path, f"{HEADER},length", [f"{','.join(map(str, row))},222.5" for row in ROWS])
    assert main(["new", "--csv", str(with_lengths), "-o", str(model), "--force"]) == 0
    assert Robot.load(model).configurations[0].lengths_squared == (Fraction("222.5") ** 2,) * 6


@pytest.mark.parametrize("mark", [";", "\t"])
def test_tables_of_spreadsheets_are_the_same_tables(mark: str, tmp_path: Path, capsys: Capture) -> None:
    """Between semicolons a comma is a decimal point; a byte order mark, comments and CRLF change nothing."""
    path, model = _table(tmp_path), tmp_path / "robot.toml"
    words = ["new", "--csv", str(path), "--height", "220", "-o", str(model), "--force"]
    assert main(words) == 0
    wanted = model.read_bytes()
    text = path.read_text().replace(",", mark).replace("\n", "\r\n")
    path.write_text("\ufeff# drawing\r\n" + (text.replace(".", ",") if mark == ";" else text), newline="")
    assert main(words) == 0
    assert model.read_bytes() == wanted
    assert "pose = { position = [0, 0, 220], quaternion = [1, 0, 0, 0] }" in wanted.decode()
    assert Robot.load(model).nominal is not None
    capsys.readouterr()


@pytest.mark.parametrize(
    ("header", "rows", "words", "part"),
    [
        ("a,b", ["1,2"], ["--height", "1"], "line 1: the columns are a, b; name them base_x, base_y,"),
        (HEADER, ["1,2,3,4,5"], ["--height", "1"], "line 2: 5 values; give 6"),
        (HEADER, ["1,2,3,4,5,x"], ["--height", "1"], "line 2, platform_z: x is not a number"),
        (HEADER, [], ["--height", "1"], "0 rows; give one per leg"),
        (
            HEADER,
            ["0,0,0,0,0,5"] * 5,
            ["--height", "1"],
            "joints.csv: 5 rows; give 6, one per leg, or 3 if it is planar",
        ),
        ("0,0,0,0,0,5", ["0,0,0,0,0,5"] * 5, ["--height", "1"], "line 1: has no names of columns; name them base_x,"),
        (
            HEADER.replace(",", ";"),
            ["1,0;0;0;0;0;1.000,5"] * 6,
            ["--height", "1"],
            "platform_z: 1.000,5 is not a number",
        ),
        (HEADER, None, [], "give either --height"),
        (HEADER, None, ["--height", "1", "--kind", "3-RRR"], "6 rows are those of a 6-UPS robot"),
        (HEADER, None, ["--height", "1", "--base-sides", "1,2"], "--csv and --base-sides exclude each other"),
        (HEADER, ["0,0,0,0,0,5"] * 6, ["--height", "-5"], "leg 1 would have length 0"),
    ],
)
def test_tables_that_are_none_give_one_sentence_and_no_file(
    header: str, rows: list[str] | None, words: list[str], part: str, tmp_path: Path, capsys: Capture
) -> None:
    model = tmp_path / "robot.toml"
    assert main(["new", "--csv", str(_table(tmp_path, header, rows)), "-o", str(model), *words]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n"), model.exists()) == ("", 1, False)
    assert part in err
