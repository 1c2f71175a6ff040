"""Mechanisms of bodies and joints from URDF files, their loops closed."""

import sys
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


LOOP = SARRUS[SARRUS.index("  <loop_joint") : SARRUS.index("  <transmission")]
TIP = """  <link name="tip"/><joint name="D" type="revolute"><parent link="right 2"/><child link="tip"/>
    <origin xyz="0 0.2 0.2"/><axis xyz="1 0 0"/></joint>
  <link name="corner"/><joint name="there" type="fixed"><parent link="top"/><child link="corner"/>
    <origin xyz="0.3 -0.3 0" rpy="0 0 1.5708"/></joint>
"""
OPENED = SARRUS.replace(LOOP, TIP).replace(SARRUS[SARRUS.index("  <transmission") : SARRUS.index("</robot>")], "")
YAML = "closed_loop: [['tip', there]]\ntype: ['6d']\nname_mot: [A]\njoint_name: []\njoint_type: []\n"


def _closed(folder: Path, yaml: str, *words: str) -> tuple[int, Path]:
    path, output = written(folder, OPENED), folder / "model.toml"
    (folder / "robot.yaml").write_text(yaml, encoding="utf-8")
    loops = str(folder / "robot.yaml")
    return main(["new", "--urdf", str(path), "--loops", loops, "--platform", "top", "-o", str(output), *words]), output


def test_loops_are_closed_by_a_yaml_file(tmp_path: Path) -> None:
    """The same mechanism as with a loop_joint: the tip of the second chain is the platform."""
    wanted = read_urdf(written(tmp_path, SARRUS)).linkage
    code, output = _closed(tmp_path, YAML)
    assert code == 0
    found = read_linkage(output)
    assert (found.bodies, found.base, found.platform) == (wanted.bodies, "ground", "top")
    assert found.actuated == wanted.actuated == ("A",)
    places = [{joint.name: (joint.type, joint.geometry) for joint in linkage.joints} for linkage in (found, wanted)]
    assert places[0] == places[1]


def test_types_and_origins_of_a_yaml_file(tmp_path: Path) -> None:
    yaml = "closed_loop: [[tip, there]]\ntype: [3D]\njoint_name: [B, F, E]\njoint_type: [SPHERICAL, UJOINT_YZ, FIXED]\n"
    code, output = _closed(tmp_path, yaml)
    assert code == 0
    found = {joint.name: joint for joint in read_linkage(output).joints}
    assert {name: joint.type for name, joint in found.items()} == {
        "A": "R",
        "B": "S",
        "C": "R",
        "F": "U",
        "D": "R",
        "tip, there": "S",
    }
    assert found["F"].geometry.axes == ((-1, 0, 0), (0, 0, 1)), "y and z of a frame turned by a right angle"
    assert found["tip, there"].bodies == ("tip", "top")


@pytest.mark.parametrize(
    ("yaml", "said"),
    [
        ("", "has no keys"),
        ("[1, 2]", "has no keys"),
        ("closed_loop: [[tip", "is not YAML"),
        ("a: " + "[" * 50000, "lists within lists, 9 deep"),
        (" " * (1 << 16) + "# x", "has more than 65536 bytes"),
        ("closed_loop: [&pair [tip, there], *pair]", "has an alias (*..); write out what it stands for"),
        ("closed_lop: []", "unknown key 'closed_lop'; the known keys are: closed_loop"),
        ("closed_loop: [[tip, 3]]", "closed_loop: is no list of pairs of names"),
        ("closed_loop: [[tip, nowhere]]", "closed_loop: 'nowhere' is the name of neither a link nor a joint"),
        ("closed_loop: [[tip, base]]", "are 0.4 apart, so that the loop is open"),
        ("closed_loop: [[tip, top]]", "are 0.3 apart, so that the loop is open"),
        ("closed_loop: [[corner, right 2]]", "0.2 apart"),
        (
            "closed_loop: [[left 1, A]]\njoint_name: [A]\njoint_type: [UJOINT_XY]",
            "closed_loop: 'left 1' and 'A' are of one body",
        ),
        ("closed_loop: [[tip, there]]\ntype: [5d]", "type: '5d' is unknown; use 3d or 6d"),
        ("closed_loop: [[tip, there]]\ntype: [3d, 3d]", "type: 2 given; give 1"),
        ("name_mot: [Z]", "name_mot: 'Z' is not the name of a joint"),
        ("name_mot: [there]", "the joint 'there' neither turns nor slides"),
        ("name_mot: A", "name_mot: is no list of names"),
        ("joint_name: [A]", "joint_type: 0 types for 1 names"),
        ("joint_name: [A]\njoint_type: [ROUND]", "joint_type: 'ROUND' is unknown; use one of: SPHERICAL"),
        ("joint_name: [Z]\njoint_type: [FIXED]", "joint_name: 'Z' is not the name of a joint"),
    ],
)
def test_a_yaml_file_that_does_not_fit_gives_one_sentence(
    yaml: str, said: str, tmp_path: Path, capsys: Capture
) -> None:
    code, output = _closed(tmp_path, yaml)
    out, err = capsys.readouterr()
    assert (code, out, err.count("\n"), output.exists()) == (2, "", 1, False)
    assert said in err


def test_loops_belong_to_urdf_and_need_a_package(
    tmp_path: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert main(["new", "--kind", "6-6", "--loops", "x.yaml", "-o", "-"]) == 2
    assert "--loops: belongs to --urdf" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "yaml", None)
    assert _closed(tmp_path, YAML)[0] == 2
    assert 'pip install "pkm_exact[urdf]"' in capsys.readouterr().err
