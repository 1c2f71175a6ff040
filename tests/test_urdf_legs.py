"""Six-leg platforms in URDF files, recognised as robots with legs."""

from __future__ import annotations

import re
from fractions import Fraction
from math import cos, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pkm_exact import Robot, read_linkage
from pkm_exact.cli.main import main
from pkm_exact.geometry.urdf_reader import read_urdf
from pkm_exact.templates.legs_of_bodies import NoLegsError, legged_robot, platform_of_legs

Capture = pytest.CaptureFixture[str]
HEIGHT = 0.5
BASE = [(round(0.3 * cos(x), 4), round(0.3 * sin(x), 4), 0.0) for x in (0.1, 2.0, 2.2, 4.1, 4.3, 6.2)]
PLATFORM = [(round(0.2 * cos(x), 4), round(0.2 * sin(x), 4), 0.0) for x in (0.9, 1.2, 3.0, 3.3, 5.1, 5.4)]


def _words(vector: Any) -> str:
    return " ".join(repr(float(x)) for x in vector)


def _joint(name: str, kind: str, ends: tuple[str, str], place: Any = (0, 0, 0), axis: Any = (0, 0, 1)) -> str:
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{ends[0]}"/><child link="{ends[1]}"/>'
        f'<origin xyz="{_words(place)}"/><axis xyz="{_words(axis)}"/></joint>'
    )


def _hexapod(kind: str = "UPS") -> str:
    """Frames are parallel to the base's, so that places are differences."""
    names, joints = ["base"], []
    for k, (a, b) in enumerate(zip(np.array(BASE), np.array(PLATFORM) + np.array([0, 0, HEIGHT]), strict=True)):
        fork, low, high = (f"{part} {k}" for part in ("fork", "low", "high"))
        end = f"end {k}"
        along = (b - a) / np.linalg.norm(b - a)
        if kind == "UPS":
            names += [fork, low, high]
            joints.append(_joint(f"u1 {k}", "revolute", ("base", fork), a, (1, 0, 0)))
            joints.append(_joint(f"u2 {k}", "revolute", (fork, low), (0, 0, 0), (0, 1, 0)))
            joints.append(_joint(f"p {k}", "prismatic", (low, high), (0, 0, 0), along))
        else:
            names += [f"cart {k}", fork, high]
            joints.append(_joint(f"p {k}", "prismatic", ("base", f"cart {k}"), a, (0, 0, 1)))
            joints.append(_joint(f"u1 {k}", "revolute", (f"cart {k}", fork), (0, 0, 0), (1, 0, 0)))
            joints.append(_joint(f"u2 {k}", "revolute", (fork, high), (0, 0, 0), (0, 1, 0)))
        if k == 0:  # the tree: the platform hangs on the first leg, by three turns
            names += ["s1", "s2", "top"]
            joints.append(_joint("r1", "revolute", (high, "s1"), b - a, (0, 0, 1)))
            joints.append(_joint("r2", "revolute", ("s1", "s2"), (0, 0, 0), (1, 0, 0)))
            joints.append(_joint("r3", "revolute", ("s2", "top"), (0, 0, 0), (0, 1, 0)))
        else:
            first = np.array(PLATFORM[0])
            place = np.array(PLATFORM[k]) - first
            joints.append(
                f'<loop_joint name="{end}" type="ball"><link1 link="{high}" xyz="{_words(b - a)}"/>'
                f'<link2 link="top" xyz="{_words(place)}"/></loop_joint>'
            )
    links = "".join(f'<link name="{name}"/>' for name in names)
    return f'<robot name="my hexapod">{links}{"".join(joints)}</robot>'


@pytest.mark.parametrize(("legs", "kind"), [("UPS", "6-UPS"), ("PUS", "6-PUS")])
def test_the_robot_of_a_urdf_file_has_its_joints(legs: str, kind: str, tmp_path: Path, capsys: Capture) -> None:
    source, target = tmp_path / "robot.urdf", tmp_path / "robot.toml"
    source.write_text(_hexapod(legs))
    assert main(["new", "--urdf", str(source), "-o", str(target)]) == 0
    said = capsys.readouterr()
    assert f"six legs, kind {kind}" in said.out
    assert f"next: certify-poses solve {target}" in said.out
    robot = Robot.load(target)
    assert (robot.kind, robot.unit) == (kind, "m")
    assert np.allclose(np.array(robot.base_joints, dtype=float), BASE, atol=1e-12)
    assert np.allclose(np.array(robot.platform_joints, dtype=float), np.array(PLATFORM) - PLATFORM[0], atol=1e-12)
    assert main(["solve", str(target), "--method", "krawczyk", "--nearest", "--format", "csv"]) == 0
    home = capsys.readouterr().out.splitlines()[1].split(",")
    assert np.allclose([float(x) for x in home[4:10]], [*PLATFORM[0][:2], HEIGHT, 0, 0, 0], atol=1e-8)


def test_bodies_and_joints_are_kept_on_demand(tmp_path: Path, capsys: Capture) -> None:
    source, target = tmp_path / "robot.urdf", tmp_path / "robot.toml"
    source.write_text(_hexapod())
    assert main(["new", "--urdf", str(source), "--bodies", "--platform", "top", "-o", str(target)]) == 0
    assert "next: certify-poses mobility" in capsys.readouterr().out
    assert len(read_linkage(target).joints) == 26
    assert main(["new", "--bodies", "--kind", "6-6", "-o", "-"]) == 2
    assert "--bodies: belongs to --urdf" in capsys.readouterr().err


WRONG = [
    ('type="ball"', 'type="revolute"', "asks more of the platform|turns at one end"),
    ('<joint name="u2 2" type="revolute"', '<joint name="u2 2" type="prismatic"', "not turns and one slide"),
    ('<joint name="u2 2" type="revolute"', '<joint name="u2 2" type="fixed"', "asks more of the platform"),
]


@pytest.mark.parametrize(("old", "new", "said"), WRONG)
def test_why_it_is_not_recognised(old: str, new: str, said: str, tmp_path: Path, capsys: Capture) -> None:
    text = _hexapod()
    assert old in text
    source, target = tmp_path / "robot.urdf", tmp_path / "robot.toml"
    source.write_text(text.replace(old, new, 1))
    found = read_urdf(source, "top")
    with pytest.raises(NoLegsError, match=said):
        legged_robot(found.linkage, found.origin)
    assert main(["new", "--urdf", str(source), "-o", str(target)]) == 0
    out, err = capsys.readouterr()
    assert "is not recognised as one with six legs" in err
    assert "bodies" in out


def test_a_slide_off_its_line_and_axes_that_miss_are_no_legs(tmp_path: Path) -> None:
    source = tmp_path / "robot.urdf"
    text = _hexapod()
    slide = re.search(r'<joint name="p 3".*?</joint>', text)
    assert slide is not None
    fork = '<child link="low 3"/><origin xyz="0.0 0.0 {}"/>'
    for old, new, said in (
        (slide[0], re.sub(r'axis xyz="[^"]*"', 'axis xyz="0 0 1"', slide[0]), "is not along"),
        (fork.format("0.0"), fork.format("0.0001"), "do not meet"),
    ):
        assert old in text
        source.write_text(text.replace(old, new, 1))
        found = read_urdf(source, "top")
        with pytest.raises(NoLegsError, match=said):
            legged_robot(found.linkage, found.origin)


def test_the_platform_is_where_six_joints_end(tmp_path: Path) -> None:
    source = tmp_path / "robot.urdf"
    source.write_text(_hexapod())
    found = read_urdf(source)
    assert platform_of_legs(found.linkage) == "top"
    robot, off = legged_robot(read_urdf(source, "top").linkage, read_urdf(source, "top").origin)
    assert off < 1e-9
    assert robot.nominal is not None
    assert robot.nominal.position[2] == Fraction("0.5")
