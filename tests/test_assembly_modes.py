"""Assembly modes: poses grouped by the sign of the determinant of the leg Jacobian, in the table and in JSON."""

import json
import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from samples import solved

from pkm_exact.cli.main import main
from pkm_exact.cli.modes import assembly_modes, summary

MODELS = Path(__file__).parent.parent / "models"
KEYS = ("positive", "negative", "singular", "undecided")


@pytest.mark.parametrize("name", ["mourrain-l", "3-rpr-merlet-p", "3-rpr-triple"])
def test_every_pose_has_one_mode(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    poses = solved(name).poses
    modes = assembly_modes(poses)
    assert tuple(modes) == KEYS
    assert sorted(place for places in modes.values() for place in places) == list(range(len(poses)))
    for key, sign in (("positive", 1), ("negative", -1), ("singular", 0)):
        assert all(pose.jacobian is not None and pose.jacobian.det_sign == sign for pose in _at(poses, modes[key]))
    assert main(["solve", str(MODELS / f"{name}.toml"), "--format", "json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["assembly_modes"] == modes
    assert all(answer["poses"][place]["jacobian"]["det_sign"] == 1 for place in modes["positive"])


def _at(poses: tuple, places: list[int]) -> list:
    return [poses[place] for place in places]


def test_the_table_says_which_poses_share_a_mode(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", str(MODELS / "mourrain-l.toml")]) == 0
    lines = capsys.readouterr().out.split("\n")
    (line,) = (line for line in lines if line.startswith("assembly modes: "))
    for sign, words in (("+", "> 0"), ("-", "< 0")):
        numbers = [
            row.split()[0]
            for row in lines
            if re.match(r" *[0-9]+ .* " + re.escape(sign) + r" +[0-9.]+ +[A-Z.0-9-]+$", row)
        ]
        assert f"{len(numbers)} " in line
        assert f"with det J {words} ({', '.join(numbers)})" in line


@given(st.lists(st.sampled_from(KEYS), min_size=1, max_size=60))
def test_the_summary_counts_all_poses_once(keys: list[str]) -> None:
    modes = {key: [place for place, other in enumerate(keys) if other == key] for key in KEYS}
    text = summary(modes, range(1, len(keys) + 1))
    counts = [int(number) for number in re.findall(r"([0-9]+)(?: poses?)? with det J", text)]
    assert counts == [len(places) for places in modes.values() if places]
    listed = [int(number) for group in re.findall(r"\(([0-9, ]+)\)", text) for number in group.split(", ")]
    assert sorted(listed) == list(range(1, len(keys) + 1))
    assert text.count("pose") == 1
