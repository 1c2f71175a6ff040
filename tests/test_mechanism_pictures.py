"""Pictures of mechanisms declared by constraints: every kind of constraint looks like what it is."""

import json
import re
from fractions import Fraction
from itertools import pairwise
from math import cos, dist, hypot, isclose, pi, sin, sqrt
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
from pkm_exact.geometry.machines.machine_kinds import MACHINES
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.reader import read_robot, robot_from_toml
from pkm_exact.pictures.drawn_robot import Scene
from pkm_exact.pictures.mechanism_scene import drive_shapes, legs_on_chains, shape_of
from pkm_exact.pictures.scene import scene_of
from pkm_exact.pictures.shapes import Point
from pkm_exact.templates.machine_text import given_dimensions, machine_text

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


def test_legs_have_none_and_angles_are_two_axes() -> None:
    assert shape_of(1, Distance(X, Y, ONE), ROOTS, (1, 1, 1)) is None
    shape = shape_of(1, Angle(X, Y, ZERO), ROOTS, (1, 1, 1))
    assert shape is not None
    first, second = shape.lines((0.0, 0.0, 1.0), UNTURNED, 10.0)
    assert [round(b - a, 9) for a, b in zip(*first, strict=True)] == [3.2, 0, 0]
    assert [round(b - a, 9) for a, b in zip(*second, strict=True)] == [0, 3.2, 0]


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
    """Of the 3-PRRR no rod is a leg: its cranks are arms below the axes of the limbs."""
    robot, document = model(name), golden(name)
    scene = scene_of(document, robot)
    assert scene.sorts == ((sort,) if sort else ())
    assert scene_of(document, None).sorts == ()
    arms = [shape for shape in scene.shapes if shape.kind == "arm"]
    assert len(arms) == (0 if sort else 3)
    for arm in arms:
        (line,) = arm.lines((0.0, 0.0, 0.0), UNTURNED, 1.0)
        assert dist(*line) == pytest.approx(0.5)
    assert not [shape for shape in scene_of(document, None).shapes if shape.kind == "arm"]
    for pose in scene.poses:
        assert len(pose.knees) == (3 if sort else 0)
    if sort == "crank":
        for knee, foot in zip(scene.poses[0].knees, scene.base, strict=True):
            assert sum((a - b) ** 2 for a, b in zip(knee, foot, strict=True)) == pytest.approx(1.73**2)


def test_links_and_cranks_about_a_point_are_arcs_of_a_sphere() -> None:
    robot, document = model("spherical-3-rrr"), golden("spherical-3-rrr")
    scene = scene_of(document, robot)
    assert [shape.kind for shape in scene.shapes] == ["arc"] * 3 + ["arm"] * 3
    plain = scene_of(document, None)
    assert plain.sorts == ()
    for pose in scene.poses:
        for k in range(3):
            (link,) = scene.shapes[k].lines(pose.position, pose.rotation, scene.size)
            (crank,) = scene.shapes[3 + k].lines(pose.position, pose.rotation, scene.size)
            assert dist(link[0], plain.base[k]) < 1e-9
            assert dist(link[-1], pose.platform[k]) < 1e-9
            assert dist(crank[-1], link[0]) < 1e-9
            assert dist(crank[0], scene.base[k]) < 1e-9
            assert all(isclose(dist(point, pose.position), 1) for point in (*link, *crank))
            # The crank's axis is that of its motor.
            assert crank[0] == pytest.approx([float(k == i) for i in range(3)])


def test_cranks_and_slides_may_stand_side_by_side(tmp_path: Path) -> None:
    """The P-FUS with five freedoms: three rods on slides, two on cranks."""
    text = (Path(__file__).parent.parent / "models" / "p-fus.toml").read_text()
    head = text.partition("[[configurations]]")[0].replace('freedoms = "3"', 'freedoms = "5"')
    path = tmp_path / "five.toml"
    path.write_text(f'{head}[[configurations]]\nname = "it"\nslides = [30, 35, 27]\nhalf_tangents = ["1/2", "1/3"]\n')
    found = read_robot(path)
    assert isinstance(found, Mechanism)
    problem = found.problem(found.configuration())
    legs = [found for found in problem.constraints if isinstance(found, Distance)]
    feet, sorts = legs_on_chains(found, legs)
    assert sorts == ("slide",) * 3 + ("crank",) * 2
    for foot, leg, sort in zip(feet, legs, sorts, strict=True):
        if sort == "crank":
            way = [b - a for a, b in zip(foot, leg.base, strict=True)]
            assert sum(g * x * x for g, x in zip(found.metric, way, strict=True)) == 150**2


def test_a_universal_joint_and_the_arms_of_in_branch_drives_are_drawn() -> None:
    crossed = scene_of(golden("2-ups-u"), model("2-ups-u"))
    assert "axes" in [shape.kind for shape in crossed.shapes]
    robot = robot_from_toml(IN_BRANCH)
    assert isinstance(robot, Mechanism)
    problem = robot.problem(robot.configuration())
    arms = list(drive_shapes(robot, problem, ROOTS))
    assert [arm.name for arm in arms] == [f"crank {k}, link {k}" for k in (1, 2, 3)]
    for arm in arms:
        (line,) = arm.lines((0.0, 0.0, 0.0), UNTURNED, 1.0)
        assert [round(dist(a, b), 9) for a, b in pairwise(line)] == [2, 3]


def test_slides_and_arm_of_a_carriage_end_amid_the_feet() -> None:
    """X = 1, Y = 2, and the arm of length 5, with the middle of the feet, tilted by 2 atan(1/3)."""
    scene = scene_of(golden("carriage-hexapod"), model("carriage-hexapod"))
    (arm,) = (shape for shape in scene.shapes if shape.kind == "arm")
    assert arm.name == "X, Y, tilt"
    (line,) = arm.lines((3.0, 1.0, 2.0), UNTURNED, 1.0)
    steps = [tuple(b - a for a, b in zip(one, other, strict=True)) for one, other in pairwise(line)]
    assert steps[:2] == [(1, 0, 0), (0, 2, 0)]
    middle = tuple(sum(foot[i] for foot in scene.base) / 6 for i in range(3))
    assert dist(line[-1], middle) < 1e-9
    y, z = 5 + sum((0, 5, 1, -6, 4, 5)) / 6, 1 / 6 * (0 + 1 + 0 + 0 + 0 - 1)
    assert steps[2] == pytest.approx((0, 0.8 * y - 0.6 * z, 0.6 * y + 0.8 * z))
    assert not [shape for shape in scene_of(golden("carriage-hexapod"), None).shapes if shape.kind == "arm"]


def test_the_platform_has_the_joints_of_all_that_holds_it() -> None:
    """Of the R-TCS one leg is a rod on a crank; three joints are in planes and on a collar."""
    for robot in (model("r-tcs"), None):
        scene = scene_of(golden("r-tcs"), robot)
        assert len(set(scene.platform)) == len(scene.platform) == 4
        assert {round(hypot(*joint), 9) for joint in scene.platform} == {50}
        joint = scene.platform[scene.legs[0][1]]
        assert joint[:2] == pytest.approx((25, 25 * sqrt(3)))
        assert len(scene.poses[0].platform) == 4


@pytest.mark.parametrize(("name", "lengths"), [("r-tcs", [150, 150]), ("cp-vs", [50 * sqrt(2), 53 * sqrt(2)])])
def test_struts_on_rails_and_cranks_stand_upright(name: str, lengths: list[float]) -> None:
    """Rods of 150 on cranks; struts of sqrt(2) times the positions on guides. Without the model they are planes."""
    robot, document = model(name), golden(name)
    scene = scene_of(document, robot)
    struts = [shape for shape in scene.shapes if shape.kind == "strut"]
    for pose in scene.poses:
        for k, (strut, length) in enumerate(zip(struts, lengths, strict=True)):
            (start, foot), (again, joint) = strut.lines(pose.position, pose.rotation, scene.size)
            assert foot == again
            assert dist(foot, joint) == pytest.approx(length)
            assert dist(start, (0, 0, 0)) == pytest.approx(100)
            rail, rod = ([b - a for a, b in zip(*pair, strict=True)] for pair in ((start, foot), (foot, joint)))
            assert sum(a * b for a, b in zip(rail, rod, strict=True)) == pytest.approx(0, abs=1e-4)
            assert min(dist(joint, other) for other in pose.platform) < 1e-6
            turn = 2 * pi * k / 3  # in the vertical plane of its leg
            assert foot[0] * sin(turn) - foot[1] * cos(turn) == pytest.approx(0, abs=1e-4)
    kinds = [shape.kind for shape in scene_of(document, None).shapes]
    assert "strut" not in kinds
    assert kinds.count("plane") == len([shape for shape in scene.shapes if shape.kind == "plane"]) + 2


def test_a_crank_with_a_free_collar_reaches_its_rod() -> None:
    kind = MACHINES["R-TCS"]
    text = machine_text(kind, "r", "mm", given_dimensions(kind, ('freedoms="4"',)))
    robot = robot_from_toml(text.replace('"1/3", "2/5", "3/8", "4/7"', '"1/3", "1/3", "3/4", 1'))
    assert isinstance(robot, Mechanism)
    (arm,) = drive_shapes(robot, robot.problem(robot.configuration()), (1.0, sqrt(3), 1.0))
    assert arm.name == "crank 3"
    start, end = arm.lines((3.0, 1.0, 140.0), UNTURNED, 1.0)[0]
    assert start == arm.place
    along = tuple(b - a for a, b in zip(start, end, strict=True))
    held = tuple(p + c - e for p, c, e in zip(arm.joint, (3.0, 1.0, 140.0), end, strict=True))
    assert sum(a * b for a, b in zip(along, held, strict=True)) == pytest.approx(0, abs=1e-9)
    assert along[2] / hypot(*along) == pytest.approx(0.96)
    assert dist(start, (0, 0, 0)) == pytest.approx(100)


IN_BRANCH = """schema = 1
name = "both driven"
kind = "3-RRR"
unit = "1"
source = "a test"
[base]
joints = [[0, 0], [12, 0], [6, 10]]
[platform]
joints = [[0, 0], [5, 0], [1, 4]]
[cranks]
at_0 = [[2, 0], [2, 0], [2, 0]]
[rods]
length = 3
[actuators]
driven = "RR"
[[configurations]]
name = "it"
half_tangents = [0, "1/2", 1]
link_half_tangents = [1, "1/3", 0]
"""


def test_the_bars_of_an_h4_hold_its_rods() -> None:
    """Slides stand where the model has them; rods of the model's lengths end on bars that do not turn."""
    robot = read_robot("models/h4.toml")
    shown = scene_of(golden("h4"), robot)
    feet = [(-48, -48), (-48, 48), (6, 48), (48, -6)]
    bars = [(0, -6, 0), (0, 6, 0), (0, 6, 0), (0, -6, 0)]
    assert [point[:2] for point in shown.base] == feet
    for pose in shown.poses:
        heights = (13.02, -7.49, 9.68, 15.77)
        assert all(knee == pytest.approx((*foot, q)) for knee, foot, q in zip(pose.knees, feet, heights, strict=True))
        for (knee, end), joint, bar, square in zip(
            shown.ends(pose), pose.platform, bars, (5292, 5292, 3528, 3528), strict=True
        ):
            assert dist(knee, end) ** 2 == pytest.approx(square)
            assert [a - b for a, b in zip(end, joint, strict=True)] == pytest.approx(bar)
    assert scene_of(golden("h4")).bars == ()
