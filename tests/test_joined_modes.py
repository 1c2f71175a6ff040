"""Poses of one sign that motions without a singular pose join, and ways that must be refused."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from samples import boxed, model

from pkm_exact.cli.main import main
from pkm_exact.cli.modes import joined_in_words
from pkm_exact.poses.jacobian import characteristic_length
from pkm_exact.regions.joined_modes import _ends, _is_free, _is_regular_box, _row, joined_poses
from pkm_exact.regions.region_legs import region_machine

Capture = pytest.CaptureFixture[str]
SPATIAL = "mourrain-l"


@pytest.mark.slow
def test_poses_of_a_group_have_one_sign_and_each_pose_is_in_one_group() -> None:
    robot, solution = model("mssm"), boxed("mssm")
    groups = joined_poses(robot, solution)
    numbers = sorted(number for group in groups for number in group)
    assert numbers == [k for k, pose in enumerate(solution.poses, 1) if pose.det_sign]
    assert all(len({solution.poses[number - 1].det_sign for number in group}) == 1 for group in groups)
    assert max(len(group) for group in groups) > 1
    assert groups == joined_poses(robot, solution)


@pytest.mark.parametrize("name", ["3-rpr-merlet-p", "mssm"])
def test_a_way_through_a_singular_pose_is_refused(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Between poses of different sign; the look in floating point, which would see that, is left out."""
    monkeypatch.setattr("pkm_exact.regions.joined_modes._seems_free", lambda *_: True)
    robot, solution = model(name), boxed(name)
    machine, planar = region_machine(robot), solution.problem.motion.is_planar
    one = next(pose for pose in solution.poses if pose.det_sign == 1)
    other = next(pose for pose in solution.poses if pose.det_sign == -1)
    length = characteristic_length(solution.problem)
    columns = ("x", "y", "theta") if planar else ("x", "y", "z", "q0", "q1", "q2", "q3")
    for end in _ends(other, planar=planar):
        assert not _is_free(machine, (columns, [_row(one, planar=planar), end]), length)
    assert _is_free(machine, (columns, [_row(one, planar=planar)] * 2), length)
    assert _is_regular_box(machine, one, planar=planar)


def test_the_option_says_what_is_joined(capsys: Capture) -> None:
    assert main(["solve", "models/3-rpr-merlet-p.toml", "--method", "krawczyk", "--joined"]) == 0
    assert capsys.readouterr().out.endswith(
        "joined by motions without a singular pose: none found; limits and collisions are not looked at\n"
    )
    assert main(["solve", "models/3-rrr.toml", "--method", "krawczyk", "--joined"]) == 2
    assert "--joined: is for robots whose legs are of variable length" in capsys.readouterr().err


def test_what_is_not_known_is_said() -> None:
    assert "not known" in joined_in_words([(1, 2), (3,)], are_all=False, listed=(1, 2, 3))
    words = joined_in_words([(1, 2), (3, 4), (5,)], are_all=True, listed=(1, 3))
    assert words.endswith(": {1, 2}, {3, 4}; limits and collisions are not looked at; not listed: 2, 4")


def test_json_has_the_groups_by_numbers_and_says_which_are_not_listed(
    capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pkm_exact.regions.joined_modes.joined_poses", lambda *_: ((1, 2),))
    words = ["solve", "models/3-rpr-merlet-p.toml", "--method", "krawczyk", "--joined", "--format"]
    assert main([*words, "json", "--near", "5,5,0", "--nearest"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["joined"] == [[1, 2]]
    assert [entry["number"] for entry in found["poses"]] == [2]
    assert found["notes"][-1].endswith("{1, 2}; limits and collisions are not looked at; not listed: 1")
    for layout in ("csv", "csv_exact"):
        assert main([*words, layout]) == 2
        assert "--joined: has no place beside --format csv" in capsys.readouterr().err
    assert main([*words, "table", "--tolerance", "1/1000"]) == 2
    assert "--joined: has no place beside --tolerance" in capsys.readouterr().err


@pytest.mark.parametrize("words", [["models/3-rrr.toml"], ["models/x-y.toml"], ["models/links/four-bar.toml"]])
def test_what_it_is_not_for_is_refused_before_anything_is_written(
    words: list[str], tmp_path: Path, capsys: Capture
) -> None:
    target = tmp_path / "it.json"
    assert main(["solve", *words, "--joined", "-o", str(target)]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert "--joined: is for robots" in err
    assert not target.exists()
    assert main(["solve", "models/3-rpr-merlet-p.toml", "--joined", "--method", "newton"]) == 2
    assert "certified poses" in capsys.readouterr().err
