"""Paths of joint values beside the poses that are meant: how far off, and where they part."""

from __future__ import annotations

import json
from fractions import Fraction
from math import cos, hypot, radians, sin
from pathlib import Path

import numpy as np
import pytest
from samples import MODELS, model, solved

from pkm_exact.cli.main import main
from pkm_exact.poses.limit_checks import LimitVerdict
from pkm_exact.poses.pose import Pose
from pkm_exact.regions.intended_poses import Deviation, deviation
from pkm_exact.roots.interval import Interval

FILES = {path.stem: path for path in MODELS}
Capture = pytest.CaptureFixture[str]
PLACES = (Fraction(3), Fraction("2.7"), Fraction("2.4"), Fraction(2), Fraction("1.7"))
"""Of x, at y = 5 and the angle 0: the robot is singular at 2.2, between the third and the fourth."""


def _files(folder: Path, places: tuple[Fraction, ...] = PLACES) -> tuple[str, str]:
    """Leg lengths of Merlet's planar robot to 12 decimals, and the poses."""
    robot, lines = model("3-rpr-merlet-p"), ["l1,l2,l3"]
    for x in places:
        legs = zip(robot.base_joints, robot.platform_joints, strict=True)
        lines.append(",".join(f"{hypot(float(x + b[0] - a[0]), float(5 + b[1] - a[1])):.12f}" for a, b in legs))
    path, poses = folder / "path.csv", folder / "poses.csv"
    path.write_text("\n".join(lines) + "\n")
    poses.write_text("x,y,theta\n" + "".join(f"{x},5,0\n" for x in places))
    return str(path), str(poses)


def _track(folder: Path, number: int, *more: str) -> tuple[int, Path]:
    path, poses = _files(folder)
    target = folder / "out.json"
    command = ["track", str(FILES["3-rpr-merlet-p"]), path, "--start", str(number), "-o", str(target)]
    return main([*command, "--intended", poses, "--within", "0.001,0.01", *more]), target


def test_a_path_through_a_singularity_parts_from_what_is_meant(tmp_path: Path, capsys: Capture) -> None:
    """The lengths are followed well, as another motion: det J keeps its sign, and at the fourth row it is said."""
    code, target = _track(tmp_path, 2)
    assert code == 3
    out = capsys.readouterr().out
    assert "5 of 5 rows" in out
    assert "they part after row 3" in out
    found = json.loads(target.read_text())["intended"]
    assert found["parted_at_row"] == 4
    assert found["compared"] == "rows"
    assert [row["within"] for row in found["rows"]] == ["yes"] * 3 + ["no"] * 2
    samples = json.loads(target.read_text())["samples"]
    for row, sample, x in zip(found["rows"], samples, PLACES, strict=True):
        here = [float(Fraction(sample["position"][k][0])) for k in (0, 1)]
        low, high = (float(Fraction(end)) for end in row["distance"])
        assert low - 1e-8 <= hypot(here[0] - float(x), here[1] - 5) <= high + 1e-8


def test_a_path_beside_the_singularity_is_what_is_meant(tmp_path: Path, capsys: Capture) -> None:
    path, poses = _files(tmp_path, PLACES[:3])
    command = ["track", str(FILES["3-rpr-merlet-p"]), path, "--start", "2", "-o", str(tmp_path / "out.csv")]
    assert main([*command, "--intended", poses, "--within", "0.001,0.01"]) == 0
    out = capsys.readouterr().out
    assert "intended: at every row within 0.001 and 0.01 degrees; at most" in out
    assert "degrees off; between rows nothing is compared\n" in out
    assert main([*command, "--intended", poses, "--within", "1e-11,1e-11"]) == 3
    assert "not decided at rows 1, 2, 3" in capsys.readouterr().out
    code, _ = _track(tmp_path, 1)
    assert code == 3
    assert "they differ from the first row on" in capsys.readouterr().out


def test_deviations_are_those_of_rotations() -> None:
    """Of a pose of the MSSM from itself, and turned by 1e-6, 20 and 180 degrees about z."""
    pose = solved("mssm").poses[0]
    place = [c.midpoint for c in pose.position]
    q = np.array([float(x.midpoint) for x in pose.quaternion])
    for angle in (0, 1e-6, 20, 180):
        w, z = cos(radians(angle) / 2), sin(radians(angle) / 2)
        turned = [w * q[0] - z * q[3], w * q[1] - z * q[2], w * q[2] + z * q[1], w * q[3] + z * q[0]]
        columns = ("x", "y", "z", "q0", "q1", "q2", "q3")
        off = deviation(pose, columns, [place[0] + 3, place[1], place[2] - 4, *map(Fraction, turned)])
        assert abs(float(off.distance) - 5) < 1e-8
        assert float(off.degrees.lo) - 1e-6 < angle < float(off.degrees.hi) + 1e-6
        assert off.degrees.width < 1e-2
    box = Pose(None, (Interval(Fraction(0), Fraction(1)),) * 3, pose.rotation, pose.quaternion)
    wide = deviation(box, ("x", "y", "z"), [Fraction(0)] * 3).distance
    assert wide.lo == 0
    assert 3 <= wide.hi**2 < 3 + 1e-6


@pytest.mark.parametrize(
    ("distance", "degrees", "verdict"),
    [((0, 1), (0, 1), "yes"), ((0, 3), (0, 1), "undecided"), ((0, 3), (3, 4), "no"), ((3, 4), (0, 1), "no")],
)
def test_what_is_allowed_is_compared_with_both_ends(
    distance: tuple[int, int], degrees: tuple[int, int], verdict: str
) -> None:
    off = Deviation(*(Interval(*map(Fraction, pair)) for pair in (distance, degrees)))
    assert off.within(Fraction(2), Fraction(2)) is LimitVerdict(verdict)


def test_options_that_do_not_fit_are_refused(tmp_path: Path, capsys: Capture) -> None:
    path, poses = _files(tmp_path)
    short = tmp_path / "short.csv"
    short.write_text("x,y,theta\n1,5,0\n2,5,0\n")
    command = ["track", str(FILES["3-rpr-merlet-p"]), path, "--start", "2", "-o", str(tmp_path / "out.csv")]
    for more, said in (
        (["--intended", poses], "--within: is missing"),
        (["--within", "1,1"], "--within: belongs to --intended"),
        (["--intended", poses, "--within", "1"], "a length and degrees"),
        (["--intended", poses, "--within", "1,0"], "not positive"),
        (["--intended", path, "--within", "1,1"], "has no columns of poses"),
        (["--intended", str(short), "--within", "1,1"], "has 2 poses, and the path 5 rows"),
    ):
        assert main([*command, *more]) == 2
        assert said in capsys.readouterr().err
    poses_command = ["track", str(FILES["3-rpr-merlet-p"]), poses, "-o", str(tmp_path / "out.csv")]
    assert main([*poses_command, "--intended", poses, "--within", "1,1"]) == 2
    assert "--intended: is for a path of joint values" in capsys.readouterr().err
    assert not (tmp_path / "out.csv").exists()
