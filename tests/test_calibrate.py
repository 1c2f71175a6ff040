"""Calibration: joints that are known, measured with and without noise, found again."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable
from dataclasses import replace
from math import cos, hypot, pi, radians, sin
from pathlib import Path
from random import Random

import numpy as np
import pytest
from samples import model

from pkm_exact.cli.main import main
from pkm_exact.geometry.inverse import distance_squared
from pkm_exact.geometry.reader import read_robot
from pkm_exact.geometry.robot import Robot
from pkm_exact.identification.calibration_doubts import _radians, doubts
from pkm_exact.identification.calibration_fit import fitted_legs
from pkm_exact.identification.measured_poses import identifiable, measured_poses_from_csv

Rotation = pytest.importorskip("scipy.spatial.transform").Rotation

MODEL = Path(__file__).parent.parent / "models" / "3-rpr-merlet-p.toml"
HEADER = "x,y,theta,l1,l2,l3"
Capture = pytest.CaptureFixture[str]


def _true(robot: Robot, seed: int) -> list[tuple[float, ...]]:
    """For each leg other joints than the model's, and an offset."""
    random = Random(seed)
    joints = zip(robot.base_joints, robot.platform_joints, strict=True)
    return [tuple(float(x) + random.uniform(-0.2, 0.2) for x in (*a[:2], *b[:2], 0)) for a, b in joints]


def _table(legs: list[tuple[float, ...]], count: int, *, noise: float = 0.0, turns: float = 1) -> str:
    random, rows = Random(7), [HEADER]
    for _ in range(count):
        x, y, angle = random.uniform(3, 7), random.uniform(3, 7), random.uniform(-40, 40) * turns
        c, s = cos(radians(angle)), sin(radians(angle))
        lengths = [
            hypot(x + c * u - s * v - a, y + s * u + c * v - b) - offset + random.gauss(0, noise)
            for a, b, u, v, offset in legs
        ]
        rows.append(",".join(f"{value:.12f}" for value in (x, y, angle, *lengths)))
    return "\n".join(rows) + "\n"


def test_joints_and_offsets_are_found_from_measurements_without_errors() -> None:
    robot = read_robot(MODEL)
    legs = _true(robot, 1)
    measured = measured_poses_from_csv(_table(legs, 20), robot)
    known = identifiable(robot, measured, offsets=True)
    assert [leg.rank for leg in known] == [5, 5, 5]
    for leg, fit in zip(legs, fitted_legs(robot, measured, known, offsets=True), strict=True):
        assert fit.values == pytest.approx(leg, abs=1e-6)
        assert max(map(abs, fit.after)) < 1e-8 < max(map(abs, fit.before))


def test_what_is_not_shown_stays_and_is_said() -> None:
    """A platform that does not turn: base joint and platform joint of a leg can move together."""
    robot = read_robot(MODEL)
    measured = measured_poses_from_csv(_table(_true(robot, 2), 12, turns=0), robot)
    known = identifiable(robot, measured, offsets=True)
    assert [leg.rank for leg in known] == [3, 3, 3]
    assert known[1].confused()[0] == "nothing shows a change of A2x by 1, B2x by 1"
    for leg, fit in enumerate(fitted_legs(robot, measured, known, offsets=True)):
        model = [float(x) for x in (*robot.base_joints[leg][:2], *robot.platform_joints[leg][:2])]
        assert fit.values[0] - model[0] == pytest.approx(model[2] - fit.values[2], abs=1e-9)
        assert max(map(abs, fit.after)) < 1e-8


def test_standard_deviations_are_those_of_repeated_measurements() -> None:
    robot = read_robot(MODEL)
    legs = _true(robot, 3)
    measured = measured_poses_from_csv(_table(legs, 200, noise=0.001), robot)
    fits = fitted_legs(robot, measured, identifiable(robot, measured, offsets=True), offsets=True)
    off = [
        (value - true) / fit.covariance[k][k] ** 0.5
        for fit, leg in zip(fits, legs, strict=True)
        for k, (value, true) in enumerate(zip(fit.values, leg, strict=True))
    ]
    assert 0.3 < (sum(x * x for x in off) / len(off)) ** 0.5 < 2


def test_residuals_are_drawn_whatever_the_unit_and_the_settings_are() -> None:
    mpl = pytest.importorskip("matplotlib")
    from pkm_exact.pictures.output import figure_bytes
    from pkm_exact.pictures.residuals import residuals_figure

    drawn = [figure_bytes(residuals_figure([[0.1, 0.2]], [[0.0, 0.1]], "$\\q"), "svg")]
    with mpl.rc_context({"axes.facecolor": "red", "font.size": 20}):
        drawn.append(figure_bytes(residuals_figure([[0.1, 0.2]], [[0.0, 0.1]], "$\\q"), "svg"))
    assert drawn[0] == drawn[1]


def test_the_command_writes_model_covariance_and_picture(tmp_path: Path, capsys: Capture) -> None:
    pytest.importorskip("matplotlib")
    legs = _true(read_robot(MODEL), 4)
    (tmp_path / "poses.csv").write_text(_table(legs, 15))
    target, picture = tmp_path / "new.toml", tmp_path / "residuals.svg"
    words = ["calibrate", str(MODEL), str(tmp_path / "poses.csv"), "-o", str(target), "--picture", str(picture)]
    assert main(words) == 0
    text = capsys.readouterr().out
    assert "15 poses, 45 lengths; they determine 15 of 15 parameters" in text
    robot, before = read_robot(target), read_robot(MODEL)
    for leg, (joint, true) in enumerate(zip(robot.base_joints, legs, strict=True)):
        assert [float(x) for x in joint[:2]] == pytest.approx(true[:2], abs=1e-5)
        old, new = (r.configuration().lengths_squared[leg] for r in (before, robot))
        assert float(new) ** 0.5 - float(old) ** 0.5 == pytest.approx(true[4], abs=1e-5)
    content = tomllib.loads((tmp_path / "new.covariance.toml").read_text())
    assert content["leg2"]["parameters"] == ["A2x", "A2y", "B2x", "B2y", "offset 2"]
    assert len(content["leg3"]["covariance"]) == 5
    assert picture.read_bytes().startswith(b"<?xml")
    assert main(words) == 2
    assert "exists; give -o another path" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("", "has no row of numbers"),
        ("x,y,z,l1,l2,l3\n1,1,1,1,1,1\n", "name them x,y,theta,l1,l2,l3"),
        (f"{HEADER}\n1,1,1,1,1\n", "line 2: 5 values; give 6"),
        (f"{HEADER}\n1,1,1,1,1,-1\n", "line 2, l3: -1 is not a length"),
        (f"{HEADER}\n1,1,1,1,x,1\n", "line 2, l2"),
        (f"{HEADER}\n1,1,1,1,2,1\n", "no measurement is left to judge by; give more poses"),
    ],
)
def test_bad_tables_are_refused_and_nothing_is_written(text: str, part: str, tmp_path: Path, capsys: Capture) -> None:
    (tmp_path / "poses.csv").write_text(text)
    assert main(["calibrate", str(MODEL), str(tmp_path / "poses.csv"), "-o", str(tmp_path / "new.toml")]) == 2
    assert part in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["poses.csv"]


def test_robots_with_cranks_are_refused(tmp_path: Path, capsys: Capture) -> None:
    (tmp_path / "poses.csv").write_text(f"{HEADER}\n1,1,1,1,2,1\n")
    assert main(["calibrate", str(MODEL.with_name("3-rrr.toml")), str(tmp_path / "poses.csv")]) == 2
    assert "N-RPR and N-UPS without a metric: not cranks (RRR, RUS)" in capsys.readouterr().err


def test_two_results_are_not_written_to_one_file(tmp_path: Path, capsys: Capture) -> None:
    (tmp_path / "poses.csv").write_text("x,y,theta,l1,l2,l3\n")
    target = str(tmp_path / "new.toml")
    words = ["calibrate", str(MODEL), str(tmp_path / "poses.csv"), "-o", target, "--covariance", target]
    assert main(words) == 2
    assert "is to be another file too; give --covariance another path" in capsys.readouterr().err
    assert not Path(target).exists()


def _judged(text: str, folder: Path, *words: str) -> tuple[int, list[str]]:
    """Exit code of a calibration without noise, and which files it wrote."""
    (folder / "poses.csv").write_text(text)
    code = main(["calibrate", str(MODEL), str(folder / "poses.csv"), "-o", str(folder / "new.toml"), *words])
    return code, sorted(path.name for path in folder.iterdir() if path.suffix == ".toml")


def _columns(text: str, change: Callable[[list[str]], list[str]]) -> str:
    """The table with its lengths changed, row by row."""
    head, *rows = text.splitlines()
    cells = [row.split(",") for row in rows]
    return "\n".join([head, *(",".join([*row[:3], *change(row[3:])]) for row in cells)]) + "\n"


def test_lengths_in_another_unit_are_said_and_written_with_force_only(tmp_path: Path, capsys: Capture) -> None:
    table = _table(_true(read_robot(MODEL), 5), 12)
    far = _columns(table, lambda lengths: [str(1000 * float(length)) for length in lengths])
    assert _judged(far, tmp_path) == (3, [])
    text = capsys.readouterr().err
    assert re.search(r"lengths read are about (99\d|1\d\d\d)(\.\d)? times those of the model", text)
    assert "the model is not written (--force writes it all the same)" in text
    assert _judged(far, tmp_path, "--force") == (3, ["new.covariance.toml", "new.toml"])
    assert "this calibration is not credible\n" in capsys.readouterr().err


def test_exchanged_columns_are_said(tmp_path: Path, capsys: Capture) -> None:
    table = _table(_true(read_robot(MODEL), 6), 12)
    assert _judged(table, tmp_path, "--force") == (0, ["new.covariance.toml", "new.toml"])
    assert "warning" not in capsys.readouterr().err
    assert _judged(_columns(table, lambda found: [found[1], found[0], found[2]]), tmp_path, "--force")[0] == 3
    assert "columns of lengths look exchanged: with l2 for leg 1, l1 for leg 2" in capsys.readouterr().err


def test_angles_in_radians_are_said(tmp_path: Path, capsys: Capture) -> None:
    head, *rows = _table(_true(read_robot(MODEL), 4), 12).splitlines()
    cells = [row.split(",") for row in rows]
    turned = [",".join([*row[:2], f"{radians(float(row[2])):.12f}", *row[3:]]) for row in cells]
    assert _judged("\n".join([head, *turned]) + "\n", tmp_path, "--no-offsets")[0] == 3
    assert "the angles look like radians: taken so the model is off by " in capsys.readouterr().err


def test_roll_pitch_and_yaw_in_radians_are_said() -> None:
    """Of a hexapod, with lengths by another program's rotations."""
    robot, rows = model("rolland-6-6"), []
    base, platform = (np.array(joints, float) for joints in (robot.base_joints, robot.platform_joints))
    random = np.random.default_rng(1)
    for _ in range(8):
        place, angles = np.array([0, 0, 700]) + random.uniform(-50, 50, 3), random.uniform(-25, 25, 3)
        turned = platform @ Rotation.from_euler("xyz", angles, degrees=True).as_matrix().T
        rows.append([*place, *angles, *np.linalg.norm(place + turned - base, axis=1)])
    head = "x,y,z,roll,pitch,yaw,l1,l2,l3,l4,l5,l6"
    for factor, said in ((pi / 180, 1), (1, 0)):
        changed = [[*row[:3], *(factor * x for x in row[3:6]), *row[6:]] for row in rows]
        text = "\n".join([head, *(",".join(f"{x:.12f}" for x in row) for row in changed)])
        measured = measured_poses_from_csv(text, robot)
        of_model = [
            [float(distance_squared(a, b, pose.position, pose.rotation)) ** 0.5 for pose in measured]
            for a, b in zip(robot.base_joints, robot.platform_joints, strict=True)
        ]
        found = list(_radians(robot, measured, of_model))
        assert len(found) == said


def test_a_fit_that_runs_away_is_no_success(tmp_path: Path, capsys: Capture) -> None:
    """Lengths as of no robot; and a platform that hardly turns, measured badly."""
    random = Random(3)
    nonsense = _columns(
        _table(_true(read_robot(MODEL), 7), 6), lambda _: [f"{random.uniform(3, 9):.3f}" for _ in "123"]
    )
    assert _judged(nonsense, tmp_path, "--no-offsets") == (3, [])
    assert (
        "changed by more than base and platform are wide, 12.2; the fit has left the model" in capsys.readouterr().err
    )
    level = _table(_true(read_robot(MODEL), 8), 12, noise=0.02, turns=0.001)
    assert _judged(level, tmp_path, "--no-offsets") == (3, [])
    assert "standard deviation greater than base and platform are wide" in capsys.readouterr().err


def test_a_search_that_did_not_end_is_said() -> None:
    robot = read_robot(MODEL)
    measured = measured_poses_from_csv(_table(_true(robot, 9), 12), robot)
    fits = fitted_legs(robot, measured, identifiable(robot, measured, offsets=False), offsets=False)
    assert doubts(robot, measured, fits) == ()
    broken = [fits[0], replace(fits[1], is_minimum=False), fits[2]]
    assert doubts(robot, measured, broken) == ("leg 2: the search ended before a minimum",)
