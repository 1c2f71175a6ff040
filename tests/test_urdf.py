"""Mechanisms of bodies and joints from URDF files, their loops closed."""

from fractions import Fraction
from pathlib import Path

import pytest

from pkm_exact import mobility_of, read_linkage
from pkm_exact.cli.main import main
from pkm_exact.errors import InputError
from pkm_exact.geometry.linkage_text import linkage_text
from pkm_exact.geometry.urdf_reader import read_urdf

ROOT = Path(__file__).parent.parent
CHAINS = sorted((ROOT / "models" / "chains").glob("*.toml"))
Capture = pytest.CaptureFixture[str]

SARRUS = (ROOT / "models" / "chains" / "sarrus.urdf").read_text(encoding="utf-8")


def written(folder: Path, text: str) -> Path:
    path = folder / "robot.urdf"
    path.write_text(text, encoding="utf-8")
    return path


def test_sarrus_linkage_moves_as_it_does(tmp_path: Path) -> None:
    found = read_urdf(written(tmp_path, SARRUS))
    linkage = found.linkage
    assert (linkage.base, linkage.platform, linkage.actuated) == ("ground", "top", ("A",))
    assert linkage.bodies == ("ground", "left 1", "left 2", "right 1", "right 2", "top")
    places = {joint.name: (joint.geometry.point, joint.geometry.axes[0]) for joint in linkage.joints}
    tenth = Fraction(1, 10)
    assert places["B"] == ((0, 5 * tenth, 3 * tenth), (1, 0, 0))
    assert places["F"] == ((3 * tenth, 0, tenth), (0, 1, 0)), "turned by a right angle, exactly"
    assert places["D"] == ((3 * tenth, 0, 5 * tenth), (0, 1, 0))
    assert found.notes == ("1 angle is taken as the multiple of a right angle within its last digit",)
    moved = mobility_of(linkage)
    assert (moved.free.rank, moved.free.total, moved.free.counted) == (5, 1, 0)
    assert str(moved.free.platform.free_motions()) == "1 translation along (0, 0, 1)"
    assert (moved.finite.least, str(moved.finite.argument)) == (1, "subgroups")


@pytest.mark.parametrize("path", CHAINS, ids=lambda path: path.stem)
def test_what_is_written_is_read_back(path: Path, tmp_path: Path) -> None:
    shipped = read_linkage(path)
    (tmp_path / "again.toml").write_text(linkage_text(shipped), encoding="utf-8")
    assert read_linkage(tmp_path / "again.toml") == shipped


def test_joints_of_every_type_in_turned_frames(tmp_path: Path) -> None:
    kinds = ("revolute", "continuous", "prismatic", "planar", "floating", "ball")
    text = '<robot name="chain"><link name="b0"/>' + "".join(f'<link name="b{k}"/>' for k in range(1, 7))
    for k, kind in enumerate(kinds, 1):
        text += f'<joint name="j{k}" type="{kind}"><parent link="b{k - 1}"/><child link="b{k}"/>'
        text += '<origin xyz="0.1 0 0" rpy="0 0 0.3"/><axis xyz="0 0 1"/></joint>'
    found = read_urdf(written(tmp_path, text + "</robot>"))
    assert "6 angles are no multiple of a right angle" in found.notes[0]
    assert [len(joint.twists) for joint in found.linkage.joints] == [1, 1, 1, 3, 6, 3]
    planar = found.linkage.joints[3]
    assert planar.twists[2][:3] == (0, 0, 1)
    assert {twist[:3] for twist in planar.twists[:2]} == {(0, 0, 0)}
    x = float(found.linkage.joints[1].geometry.point[0])
    assert x == pytest.approx(0.1 + 0.1 * 0.955336489125606, abs=1e-12)
    assert mobility_of(found.linkage).free.total == 15


def test_numbers_as_programs_write_them(tmp_path: Path) -> None:
    text = SARRUS.replace("0 0 1.5708", "-1.2246467991473532E-16 0 1.5707963267948966").replace(
        "0 0.3 0", "2e-17 3e-1 0"
    )
    found = read_urdf(written(tmp_path, text))
    assert found.linkage == read_urdf(written(tmp_path, SARRUS)).linkage
    assert found.notes[1:] == ("2 numbers are below 1e-12 and taken as 0",)


def test_a_loop_that_is_open_is_refused_and_one_that_is_nearly_closed_is_said(tmp_path: Path) -> None:
    near = SARRUS.replace('xyz="0.3 -0.3 0"', 'xyz="0.3001 -0.3 0"')
    assert "frames of a loop are up to 1.0e-04 apart" in read_urdf(written(tmp_path, near)).notes[1]
    with pytest.raises(InputError, match=r"loop_joint 'D': .* 0\.1 apart, so that the loop is open"):
        read_urdf(written(tmp_path, SARRUS.replace('xyz="0.3 -0.3 0"', 'xyz="0.4 -0.3 0"')))


WRONG = [
    ('<robot name="Sarrus">', '<robot name="Sarrus"', "is no XML"),
    ("<robot", '<!DOCTYPE robot [<!ENTITY a "b">]><robot', "has a document type"),
    ("<robot", "<sdf><robot", "is no XML"),
    ('xyz="0 0.2 0.2"/><axis', 'xyz="0 0.2"/><axis', "is not three numbers"),
    ('xyz="0 0.2 0.2"/><axis', 'xyz="0 nan 0.2"/><axis', "xyz"),
    ('xyz="0 0.2 0.2"/><axis', 'xyz="0 __import__ 0.2"/><axis', "xyz"),
    ('type="continuous"', 'type="rubber"', "type 'rubber' is unknown"),
    ('<axis xyz="1 0 0"/></joint>', '<axis xyz="0 0 0"/></joint>', "its axis is 0"),
    ('<axis xyz="1 0 0"/></joint>', '<mimic joint="B"/></joint>', "mimics another one"),
    ('<child link="top"/>', '<child link="left 1"/>', "is the child of two joints"),
    (
        '<parent link="base"/><child link="left 1"/>',
        '<parent link="hall"/><child link="left 1"/>',
        "is not the name of a link",
    ),
    (
        '<parent link="base"/><child link="left 1"/>',
        '<parent link="top"/><child link="left 1"/>',
        "in a ring of joints",
    ),
    ('<link name="top"/>', '<link name="top"/><link name="more"/>', "2 links are no child"),
    ('<link name="top"/>', '<link name="top"/><link name="top"/>', "with different names"),
    ('rpy="0 0 1.5708"', 'rpy="0 0 2e3"', "is no angle in radians"),
    ('<joint name="B"', "<joint", "is missing or no label"),
]


@pytest.mark.parametrize(("old", "new", "said"), WRONG)
def test_what_is_wrong_is_said_in_a_sentence(old: str, new: str, said: str, tmp_path: Path, capsys: Capture) -> None:
    assert old in SARRUS
    path, output = written(tmp_path, SARRUS.replace(old, new, 1)), tmp_path / "model.toml"
    assert main(["new", "--urdf", str(path), "-o", str(output)]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1
    assert not output.exists()


def test_files_that_are_none(tmp_path: Path) -> None:
    path = tmp_path / "robot.urdf"
    for content, said in (
        (b"\xff\xfe<\x00", "is no text in UTF-8"),
        (b"<a/>", "begins with 'a'"),
        (b" " * 4_000_001, "bytes"),
    ):
        path.write_bytes(content)
        with pytest.raises(InputError, match=said):
            read_urdf(path)
    with pytest.raises(InputError, match="cannot be read"):
        read_urdf(tmp_path / "missing.urdf")


def test_the_command(tmp_path: Path, capsys: Capture) -> None:
    path, output = written(tmp_path, SARRUS), tmp_path / "model.toml"
    assert main(["new", "--urdf", str(path), "-o", str(output)]) == 0
    said = capsys.readouterr()
    assert "6 bodies, 6 joints" in said.out
    assert "note:" in said.err
    assert main(["mobility", str(output)]) == 0
    assert "finite mobility          1, proved (subgroups)" in capsys.readouterr().out
    assert main(["new", "--urdf", str(path), "-o", "-", "--platform", "left 2"]) == 0
    assert 'platform = "left 2"' in capsys.readouterr().out
    for words in (["--crank", "3"], ["--kind", "6-6"], ["--platform", "nothing"]):
        assert main(["new", "--urdf", str(path), "-o", str(output), "--force", *words]) == 2
    assert main(["new", "--urdf", str(path)]) == 2
    assert main(["new", "--kind", "6-6", "--platform", "top", "-o", "-"]) == 2
    assert "--platform: belongs to --urdf" in capsys.readouterr().err
