"""Pictures of mechanisms declared by constraints: every kind of constraint looks like what it is."""

import json
import re
from fractions import Fraction
from math import dist, isclose
from pathlib import Path

import pytest
from certificate_tools import golden
from samples import model

from pkm_exact.certify.certified_machine import certified_machine
from pkm_exact.cli.main import main
from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.at_point import AtPoint
from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.on_line import OnLine
from pkm_exact.constraints.point_in_plane import Carries, InPlane
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.pictures.drawn_robot import Scene
from pkm_exact.pictures.mechanism_scene import shape_of
from pkm_exact.pictures.scene import scene_of
from pkm_exact.pictures.shapes import Point

MODEL = str(Path(__file__).parent / "cases" / "3-rps.toml")


@pytest.fixture(scope="module")
def certificate(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("pictures") / "3-rps.json"
    assert main(["solve", MODEL, "-o", str(path)]) == 0
    return path


@pytest.fixture(scope="module")
def scene(certificate: Path) -> Scene:
    return scene_of(json.loads(certificate.read_bytes()))


def test_legs_stand_between_their_joints_with_their_lengths(scene: Scene) -> None:
    assert len(scene.legs) == len(scene.lengths) == 3
    for pose in scene.poses:
        for (a, b), length in zip(scene.legs, scene.lengths, strict=True):
            assert isclose(dist(scene.base[a], pose.platform[b]), length, rel_tol=1e-9)


def test_planes_are_drawn_through_the_joints_that_they_hold(scene: Scene) -> None:
    assert [(shape.kind, shape.name) for shape in scene.shapes] == [("plane", f"hinge {k}") for k in (1, 2, 3)]
    for pose in scene.poses:
        for shape, joint in zip(scene.shapes, pose.platform, strict=True):
            (square,) = shape.lines(pose.position, pose.rotation, scene.size)
            corners = square[:-1]
            centre = [sum(values) / 4 for values in zip(*corners, strict=True)]
            assert dist(centre, joint) < 1e-9  # a hinge holds: its joint is in the plane
            for corner in corners:
                offset = [c - j for c, j in zip(corner, joint, strict=True)]
                assert abs(sum(n * x for n, x in zip(shape.direction, offset, strict=True))) < 1e-9


ZERO, ONE = Fraction(0), Fraction(1)
X, Y, Z = (ONE, ZERO, ZERO), (ZERO, ONE, ZERO), (ZERO, ZERO, ONE)
UNTURNED: tuple[Point, Point, Point] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
ROOTS = (1.0, 1.0, 1.0)


@pytest.mark.parametrize(
    ("constraint", "kind", "lines"),
    [
        (InPlane(Z, Fraction(2), X), "plane", 1),
        (Carries(Z, Fraction(2), X), "plane", 1),
        (OnLine(Y, Z, X), "line", 1),
        (AtPoint(Y, X), "point", 0),
        (AxisDistance(Y, Z, X, ONE), "axis", 2),
    ],
)
def test_every_constraint_that_holds_a_point_has_a_shape(
    constraint: InPlane | Carries | OnLine | AtPoint | AxisDistance, kind: str, lines: int
) -> None:
    shape = shape_of(5, constraint, ROOTS, (1, 1, 1))
    assert shape is not None
    assert (shape.kind, shape.number, shape.moves) == (kind, 5, isinstance(constraint, Carries))
    assert len(shape.lines((0.0, 0.0, 1.0), UNTURNED, 10.0)) == lines


def test_legs_and_angles_have_none() -> None:
    assert shape_of(1, Distance(X, Y, ONE), ROOTS, (1, 1, 1)) is None
    assert shape_of(1, Angle(X, Y, ZERO), ROOTS, (1, 1, 1)) is None


def test_a_picture_has_planes_and_legs(certificate: Path, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    picture = tmp_path / "it.svg"
    assert main(["plot", str(certificate), "--pose", "1", "-o", str(picture)]) == 0
    drawn = picture.read_text()
    assert len(set(re.findall(r'id="plane-(\d)-1"', drawn))) == 3
    assert len(set(re.findall(r'id="leg-(\d)"', drawn))) == 3
    assert "hinge 1 (plane)" in drawn


def test_a_report_has_the_constraints_and_the_planes(certificate: Path, tmp_path: Path) -> None:
    page = tmp_path / "it.html"
    assert main(["report", str(certificate), "-o", str(page)]) == 0
    text = page.read_text()
    assert "hinge 3 (plane)" in text
    assert "in-plane" in text
    assert '"shapes":' in text.replace('"shapes": ', '"shapes":')


def test_the_machine_of_a_certificate_is_a_mechanism(certificate: Path) -> None:
    machine = certified_machine(json.loads(certificate.read_bytes()))
    assert isinstance(machine, Mechanism)
    assert [constraint.name for constraint in machine.constraints][:2] == ["leg 1", "leg 2"]


@pytest.mark.parametrize(("name", "sort"), [("delta", "crank"), ("triglide", "slide"), ("3-prrr", "")])
def test_cranks_and_slides_of_a_known_machine_are_drawn(name: str, sort: str) -> None:
    """Of the 3-PRRR no rod is a leg, so that nothing stands on its cranks."""
    robot, document = model(name), golden(name)
    scene = scene_of(document, robot)
    assert scene.chain == sort
    assert scene_of(document, None).chain == ""
    for pose in scene.poses:
        assert len(pose.knees) == (3 if sort else 0)
    if sort == "crank":
        for knee, foot in zip(scene.poses[0].knees, scene.base, strict=True):
            assert sum((a - b) ** 2 for a, b in zip(knee, foot, strict=True)) == pytest.approx(1.73**2)
