"""Indices of statics at every pose of a sweep."""

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_sweep import GOOD, PLANAR, WIDTH, Capture, records, run, written

from pkm_exact import Policy, read_robot
from pkm_exact.engine import solve
from pkm_exact.poses.pose import Pose
from pkm_exact.sweep.asked_indices import AskedIndices
from pkm_exact.sweep.job import SweepJob, identity, sweep_job
from pkm_exact.sweep.lengths import read_lengths


def job(rows: Path, *names: str, **limits: str) -> SweepJob:
    robot = read_robot(PLANAR)
    lengths = read_lengths(str(rows), robot)
    asked = AskedIndices.of(names, {key: [value] for key, value in limits.items()}, 3) if names else None
    options: dict[str, Any] = {"squared": False, "certificates": False, "indices": asked}
    return sweep_job(robot, lengths, method="exact", width=WIDTH, policy=Policy(), **options)


def jacobian(pose: Pose) -> np.ndarray:
    """Of the lengths of the legs at a pose, in floating point."""
    robot = read_robot(PLANAR)
    base, platform = (
        np.array([[float(x) for x in joint] for joint in joints])[:, :2]
        for joints in (robot.base_joints, robot.platform_joints)
    )
    rotation = np.array([[float(x) for x in row] for row in pose.rotation])[:2, :2]
    arms = platform @ rotation.T
    legs = np.array([float(x) for x in pose.position])[:2] + arms - base
    legs /= np.linalg.norm(legs, axis=1)[:, None]
    return np.column_stack([legs, arms[:, 0] * legs[:, 1] - arms[:, 1] * legs[:, 0]])


def test_every_pose_has_the_indices_that_statics_gives_it(tmp_path: Path) -> None:
    rows = written(tmp_path / "rows.csv", GOOD[:1])
    asked = job(rows, "condition", "v_iso_p", length="3", speeds="1/5")
    row = next(iter(read_lengths(str(rows), asked.robot).rows()))
    found = json.loads(asked.answer(row).line)
    poses = solve(asked.robot.problem_at([Fraction(x) for x in ("7.1", "5.1", "5")])).poses
    assert len(found["poses"]) == len(poses) > 0
    for entry, pose in zip(found["poses"], poses, strict=True):
        assert list(entry["indices"]) == ["condition", "v_iso_p"]
        assert abs(Fraction(entry["indices"]["v_iso_p"]) - Fraction(1, 5)) < Fraction(1, 10**6)  # of unit vectors
        rows_of_j = jacobian(pose) / [1, 1, 3]
        assert float(entry["indices"]["condition"]) == pytest.approx(np.linalg.cond(rows_of_j), rel=1e-5)
    plain = json.loads(job(rows).answer(row).line)
    for entry in found["poses"]:
        del entry["indices"]
    assert found == plain


def test_an_index_without_a_value_is_null_and_says_why(tmp_path: Path) -> None:
    rows = written(tmp_path / "rows.csv", GOOD[:1])
    asked = job(rows, "condition", "w_iso_o")
    row = next(iter(read_lengths(str(rows), asked.robot).rows()))
    found = json.loads(asked.answer(row).line)
    assert [entry["indices"] for entry in found["poses"]] == [{"condition": None, "w_iso_o": None}] * len(
        found["poses"]
    )
    assert any(
        note.startswith("index condition: mixes translations and turns: give a length") for note in found["notes"]
    )
    assert any(note == "index w_iso_o: needs limits: speeds" for note in found["notes"])


def test_the_indices_belong_to_the_job(tmp_path: Path) -> None:
    rows = written(tmp_path / "rows.csv", GOOD[:1])
    lengths = read_lengths(str(rows), read_robot(PLANAR))
    jobs = [job(rows), job(rows, "ms", length="2"), job(rows, "ms", length="3"), job(rows, "condition", length="3")]
    assert len({identity(one, lengths, None) for one in jobs}) == 4
    assert identity(jobs[1], lengths, None) == identity(job(rows, "ms", length="2"), lengths, None)


def test_the_command_has_them(tmp_path: Path) -> None:
    rows, out = written(tmp_path / "rows.csv", GOOD[:2]), tmp_path / "out.jsonl"
    words = ["--index", "transmission", "--limits", "length=3", "--method", "exact"]
    assert run(PLANAR, rows, out, *words) == 0
    values = [entry["indices"] for row in records(out) for entry in row["poses"]]
    assert values
    assert all(0 < float(value["transmission"]) <= 1 for value in values)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--index", "swiftness"], "--index: 'swiftness' is unknown; give one of condition"),
        (["--index", "ms", "--limits", "length=x"], "--limits, length"),
        (["--index", "ms", "--limits", "width=1"], "--limits: 'width' is unknown"),
        (["--limits", "length=1"], "--limits: belongs to --index"),
    ],
)
def test_what_cannot_be_asked_is_refused_before_any_row(
    words: list[str], sentence: str, tmp_path: Path, capsys: Capture
) -> None:
    rows, out = written(tmp_path / "rows.csv", GOOD[:1]), tmp_path / "out.jsonl"
    assert run(PLANAR, rows, out, *words) == 2
    assert sentence in capsys.readouterr().err
    assert sorted(tmp_path.iterdir()) == [rows]
