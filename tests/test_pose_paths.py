"""Paths of poses: joint values, singularities, limits and bounds along the way, against floating point."""

from __future__ import annotations

import csv
import json
from fractions import Fraction
from math import cos, pi, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from flint import arb
from samples import MODELS, model

from pkm_exact import InputError
from pkm_exact.cli.main import main
from pkm_exact.geometry.pose_path_reader import pose_path_from_csv
from pkm_exact.regions.jets import constant, parameter

Capture = pytest.CaptureFixture[str]
FILES = {path.stem: path for path in MODELS}
LIMITS = "[limits]\nlengths = [[4, 8], [4, 8], [1, 6]]\nposition = [[0, 7], [0, 11]]\n[[configurations]]"


def tracked(tmp_path: Path, robot: str, rows: str, *more: str, code: int = 0) -> Any:
    """The JSON of a path of poses."""
    path, target = tmp_path / "path.csv", tmp_path / "out.json"
    path.write_text(rows)
    assert main(["track", robot, str(path), "-o", str(target), *more]) == code
    return json.loads(target.read_text())


@pytest.mark.parametrize("middle", [Fraction(1, 3), Fraction(2), Fraction(-5, 4)])
def test_jets_hold_values_and_slopes(middle: Fraction) -> None:
    s = parameter(middle, Fraction(1, 16))
    two = constant(arb(2), s)
    cosine, sine = (s * 40).cos_sin_of_degrees()
    found = (s * s + two).root() / (cosine * cosine + two) - sine * 3
    for share in np.linspace(-1, 1, 9):
        x = float(middle) + share / 16
        c, n = cos(x * 40 * pi / 180), sin(x * 40 * pi / 180)
        value = (x * x + 2) ** 0.5 / (c * c + 2) - 3 * n
        assert abs(value - float(found.value.mid())) <= float(found.value.rad()) + 1e-12
        step = 1e-6
        above, below = (
            ((y * y + 2) ** 0.5 / (cos(y * 40 * pi / 180) ** 2 + 2) - 3 * sin(y * 40 * pi / 180))
            for y in (x + step, x - step)
        )
        assert abs((above - below) / 2 / step - float(found.slope.mid())) <= float(found.slope.rad()) + 1e-6


def test_lengths_are_those_of_the_poses(tmp_path: Path) -> None:
    found = tracked(tmp_path, str(FILES["3-rpr-merlet-p"]), "time,x,y,theta\n0,5,5,0\n2,6,5,90\n")
    first = [
        Fraction(low) ** 2 <= square <= Fraction(high) ** 2
        for (low, high), square in zip(found["samples"][0]["joints"], (50, 26, 25), strict=True)
    ]
    assert all(first)
    turned = [(6, 5), (6, 9), (4, 7)]
    lengths = [
        ((x - a) ** 2 + (y - b) ** 2) ** 0.5 for (x, y), (a, b) in zip(turned, [(0, 0), (10, 0), (3, 10)], strict=True)
    ]
    assert all(
        abs(float(low) - length) < 1e-9 for (low, _), length in zip(found["samples"][1]["joints"], lengths, strict=True)
    )
    assert [sample["time"] for sample in found["samples"]] == ["0", "2"]
    assert found["stopped"] is None


def test_bounds_hold_along_the_way(tmp_path: Path) -> None:
    """Many poses of the path in floating point: none is worse than the bound, and one is nearly as bad."""
    found = tracked(tmp_path, str(FILES["3-rpr-merlet-p"]), "x,y,theta\n5,5,0\n6,5,-10\n6,6,-20\n")
    robot = model("3-rpr-merlet-p")
    base, platform = (np.array(joints, dtype=float)[:, :2] for joints in (robot.base_joints, robot.platform_joints))
    length = float(np.sqrt(((platform - platform.mean(axis=0)) ** 2).sum() / 3))
    values = []
    for (x1, y1, t1), (x2, y2, t2) in (((5, 5, 0), (6, 5, -10)), ((6, 5, -10), (6, 6, -20))):
        for s in np.linspace(0, 1, 101):
            angle = (t1 + s * (t2 - t1)) * pi / 180
            turn = np.array([[cos(angle), -sin(angle)], [sin(angle), cos(angle)]])
            arm = platform @ turn.T
            rod = np.array([x1 + s * (x2 - x1), y1 + s * (y2 - y1)]) + arm - base
            unit = rod / np.linalg.norm(rod, axis=1)[:, None]
            rows = np.column_stack([unit, (arm[:, 0] * unit[:, 1] - arm[:, 1] * unit[:, 0]) / length])
            singular = np.linalg.svd(rows, compute_uv=False)
            values.append((singular[-1], abs(np.linalg.det(rows)), singular[0] / singular[-1]))
    sigma, determinant, condition = zip(*values, strict=True)
    for name, seen in (("sigma_min", min(sigma)), ("determinant", min(determinant)), ("condition", max(condition))):
        low, high = map(float, found["worst"][name])
        assert low - 1e-4 <= seen <= high + 1e-4, name
        assert high < 4 * low


def test_a_yaw_through_a_singularity_is_refused_with_its_angle(tmp_path: Path, capsys: Capture) -> None:
    rows = "x,y,z,roll,pitch,yaw\n0,0,700,0,0,80\n0,0,700,0,0,100\n"
    found = tracked(tmp_path, str(FILES["ssm-exact"]), rows, code=3)
    low, high = map(float, found["stopped"]["at"]["yaw"])
    assert 89.99 < low <= 90.0001
    assert low < high < low + 1e-4
    assert len(found["samples"]) == 1
    assert "refused after row 1, yaw from 89.99" in capsys.readouterr().out


def test_what_is_out_of_reach_is_refused(tmp_path: Path) -> None:
    found = tracked(tmp_path, str(FILES["3-rrr"]), "x,y,theta\n0,5,0\n-60,5,0\n", "--working-modes", "+,-,-", code=3)
    assert "does not reach" in found["stopped"]["reason"]
    assert -20 < float(found["stopped"]["at"]["x"][0]) < 0


def test_limits_are_said_with_the_place(tmp_path: Path, capsys: Capture) -> None:
    robot = tmp_path / "robot.toml"
    robot.write_text(FILES["3-rpr-merlet-p"].read_text().replace("[[configurations]]", LIMITS, 1))
    found = tracked(tmp_path, str(robot), "x,y,theta\n5,5,0\n5.2,5,0\n")
    assert {name: entry["kept"] for name, entry in found["limits"].items()} == {"lengths": "yes", "position": "yes"}
    found = tracked(tmp_path, str(robot), "x,y,theta\n5,5,0\n9,5,0\n", code=3)
    assert found["limits"]["position"]["kept"] == "no"
    assert abs(float(found["limits"]["position"]["at"]["x"][0]) - 7) < 0.01
    assert "limits, position: broken between rows 1 and 2" in capsys.readouterr().out


def test_quaternions_and_angles_say_the_same(tmp_path: Path) -> None:
    """At the rows; between them a quaternion runs a little differently."""
    name = str(FILES["rolland-6-6"])
    one = tracked(tmp_path, name, "x,y,z,roll,pitch,yaw\n0,0,770,0,0,0\n0,0,780,0,0,0\n")
    other = tracked(tmp_path, name, "x,y,z,q0,q1,q2,q3\n0,0,770,2,0,0,0\n0,0,780,3,0,0,0\n")
    assert [sample["joints"] for sample in one["samples"]] == [sample["joints"] for sample in other["samples"]]
    turned = tracked(tmp_path, name, "x,y,z,roll,pitch,yaw\n0,0,770,0,0,0\n0,0,770,20,0,0\n")
    half = 10 * pi / 180
    quaternion = f"x,y,z,q0,q1,q2,q3\n0,0,770,1,0,0,0\n0,0,770,{cos(half):.15f},{sin(half):.15f},0,0\n"
    again = tracked(tmp_path, name, quaternion)
    for a, b in zip(turned["samples"][1]["joints"], again["samples"][1]["joints"], strict=True):
        assert abs(float(a[0]) - float(b[0])) < 1e-8


def test_the_table(tmp_path: Path) -> None:
    path, target = tmp_path / "path.csv", tmp_path / "out.csv"
    path.write_text("x,y,theta\n0,5,0\n0.2,5,0\n")
    assert main(["track", str(FILES["3-rrr"]), str(path), "-o", str(target), "--working-modes", "+,+,+"]) == 0
    rows = list(csv.DictReader(target.read_text().splitlines()))
    assert [row["x"] for row in rows] == ["0", "1/5"]
    assert float(rows[0]["joint1_lo"]) <= float(rows[0]["joint1_hi"])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("x,y,theta\n1,2\n1,2,3\n", "2 values; give 3"),
        ("x,y,theta\n1,2,3\n", "has 1 rows; give two poses"),
        ("time,x,y,theta\n1,1,2,3\n1,1,2,3\n", "1 is not after 1"),
        ("x,y,angle\n1,2,3\n", "name them [time,]x,y,theta"),
    ],
)
def test_a_path_that_is_none_is_refused(text: str, said: str) -> None:
    with pytest.raises(InputError) as error:
        pose_path_from_csv(text, model("3-rpr-merlet-p"))
    assert said in str(error.value)
    assert pose_path_from_csv("", model("3-rpr-merlet-p")) is None


def test_words_that_do_not_fit_are_refused(tmp_path: Path, capsys: Capture) -> None:
    path, target = tmp_path / "path.csv", str(tmp_path / "out.json")
    path.write_text("x,y,theta\n2,5,0\n2.2,5,0\n")
    cases = (
        (["3-rrr"], "--working-modes: slides and cranks"),
        (["3-rrr", "--working-modes", "+,+"], "give 3 signs"),
        (["3-rrr", "--start", "1"], "--start: the poses of the path"),
        (["3-rrr", "--exact"], "--exact: is for a path of joint values"),
        (["3-rpr-merlet-p", "--width", "1e-9"], "--width: is for a path of joint values"),
        (["3-rpr-turned", "--working-modes", "+,+,+"], "leg 1: is driven at its hinge"),
    )
    for (name, *more), said in cases:
        assert main(["track", str(FILES[name]), str(path), "-o", target, *more]) == 2
        assert said in capsys.readouterr().err
    path.write_text("l1,l2,l3\n7,5,5\n7,5,5\n")
    assert main(["track", str(FILES["3-rpr-merlet-p"]), str(path), "-o", target]) == 2
    assert "--start: is missing" in capsys.readouterr().err
