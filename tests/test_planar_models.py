"""Planar robots as files and on the command line: what is read, printed and refused."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from pkm_exact.cli.main import main
from pkm_exact.constraints.form import Vector
from pkm_exact.engine import solve
from pkm_exact.errors import InputError
from pkm_exact.export.targets import TARGETS
from pkm_exact.formulations.registry import formulation_codes
from pkm_exact.geometry.chains import Crank, Slide
from pkm_exact.geometry.inverse import dot
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.reader import read_robot, robot_from_toml
from pkm_exact.geometry.robot import Robot
from pkm_exact.poses.planar_coordinates import angle_in_degrees, planar_coordinates

MODELS = Path(__file__).parent.parent / "models"
P, RRR, PRR = (str(MODELS / f"{name}.toml") for name in ("3-rpr-merlet-p", "3-rrr", "3-prr"))
Capture = pytest.CaptureFixture[str]

POSED = """
[[configurations]]
name = "posed"
pose = { position = [5, "9/2"], half_tangent = "1/3" }
[[configurations]]
name = "same"
pose = { position = [5, "9/2"], cos_sin = ["4/5", "3/5"] }
[[configurations]]
name = "lengths"
lengths = [7, "5.1", 5]
"""
RPR_TEXT = Path(P).read_text() + POSED
RRR_TEXT, PRR_TEXT = Path(RRR).read_text(), Path(PRR).read_text()


def test_lengths_come_from_a_planar_pose() -> None:
    robot = robot_from_toml(RPR_TEXT)
    problem = robot.problem(robot.configuration("posed"))
    assert problem.motion.is_planar
    assert problem == robot.problem(robot.configuration("same"))
    known = tuple(map(Fraction, ("5", "9/2", "4/5", "3/5")))
    boxes = [planar_coordinates(pose).values() for pose in solve(problem).poses]
    assert any(all(box.contains(value) for box, value in zip(row, known, strict=True)) for row in boxes)
    assert robot.configuration("lengths").lengths_squared == (49, Fraction("26.01"), 25)
    assert robot.base_joints[2] == (3, 10, 0)
    assert replace(robot, name="other").base_joints == robot.base_joints


def test_an_equilateral_robot_in_the_metric() -> None:
    text = RPR_TEXT.replace("[[0, 0], [10, 0], [3, 10]]", "[[0, 0], [2, 0], [1, 1]]").replace("[2, 2]", "[2, 1]")
    text = text.replace("[base]", "metric = [1, 3]\n[base]", 1).replace('["4/5", "3/5"]', '["1/2", "1/2"]')
    robot = robot_from_toml(text)
    assert robot.metric == (1, 3, 1)
    assert replace(robot, metric=(1, 3)) == robot  # type: ignore[arg-type]
    problem = robot.problem(robot.configuration("same"))
    sides = {dot(edge, edge, robot.metric) for edge in _edges(problem)}
    assert sides == {4}
    solution = solve(problem)
    angles = [angle_in_degrees(box["cos"], box["sin"]) for box in map(planar_coordinates, solution.poses)]
    assert any(angle is not None and angle.contains(Fraction(60)) for angle in angles)


def _edges(problem: ForwardProblem) -> list[Vector]:
    a, b, c = (leg.base for leg in problem.distances)
    pairs = ((a, b), (b, c), (c, a))
    return [(q[0] - p[0], q[1] - p[1], q[2] - p[2]) for p, q in pairs]


def test_knees_of_planar_robots() -> None:
    rrr, prr = read_robot(RRR), read_robot(PRR)
    assert rrr.knees(rrr.configuration())[0] == (Fraction(12, 5), Fraction(16, 5), 0)
    assert prr.knees(prr.configuration())[1] == (12 - Fraction(12, 5), Fraction(16, 5), 0)
    for robot in (rrr, prr):
        reduced = robot.as_gough(robot.configuration())
        assert reduced.kind == "3-RPR"
        assert reduced.problem(reduced.configuration()) == robot.problem(robot.configuration())
    explicit = RRR_TEXT.replace("[rods]", "at_90 = [[0, 4], [0, 4], [0, 4]]\n[rods]")
    assert robot_from_toml(explicit) == rrr


BAD = {
    "six joints": (
        RPR_TEXT.replace("[3, 10]]", "[3, 10], [1, 1], [2, 2], [5, 5]]"),
        "base.joints: 6 rows; give 3 joints of 2 coordinates, one per leg",
    ),
    "two joints": (RPR_TEXT.replace(", [2, 2]]", "]"), "platform.joints: 2 rows; give 3 joints of 2"),
    "three coordinates": (RPR_TEXT.replace("[3, 10]", "[3, 10, 0]"), "base.joints[3]: a list of 3; give a list of 2"),
    "one coordinate": (RPR_TEXT.replace("[3, 10]", "[3]"), "base.joints[3]: a list of 1; give a list of 2 numbers"),
    "hexagon": (RPR_TEXT.replace("joints = [[0, 0], [10", "hexagon = [[0, 0], [10"), "base: unknown key 'hexagon'"),
    "same legs": (RPR_TEXT.replace("10, 0", "0, 0").replace("4, 0", "0, 0"), "legs 1 and 2 join the same two points"),
    "lengths": (RPR_TEXT.replace("[50, 26, 25]", "[50, 26]"), "lengths_squared: 2 values; give 3, one per leg"),
    "six lengths": (RPR_TEXT.replace("[50, 26, 25]", "[1, 1, 1, 1, 1, 1]"), "lengths_squared: 6 values; give 3"),
    "zero length": (RPR_TEXT.replace("[50, 26, 25]", "[50, 26, 0]"), "lengths_squared[3]: 0 is not positive"),
    "spatial pose": (
        RPR_TEXT.replace("half_tangent", "quaternion"),
        "configurations[2].pose: unknown key 'quaternion'",
    ),
    "spatial position": (
        RPR_TEXT.replace('[5, "9/2"]', '[5, "9/2", 0]', 1),
        "pose.position: a list of 3; give a list of 2",
    ),
    "no angle": (RPR_TEXT.replace(', half_tangent = "1/3"', ""), "no angle given; give one of half_tangent, cos_sin"),
    "two angles": (RPR_TEXT.replace('"1/3"', '"1/3", cos_sin = [1, 0]'), "half_tangent and cos_sin given; give one of"),
    "no pose": (
        RPR_TEXT.replace('{ position = [5, "9/2"], half_tangent = "1/3" }', "3"),
        "pose: 3 is not a table; write",
    ),
    "circle": (
        RPR_TEXT.replace('["4/5", "3/5"]', '["4/5", "4/5"]'),
        "pose.cos_sin: the squares of cosine and sine sum",
    ),
    "circle in the metric": (
        RPR_TEXT.replace("[base]", "metric = [1, 3]\n[base]"),
        "c^2 + w s^2 is 43/25, not 1; in this metric w is 3",
    ),
    "at a joint": (
        RPR_TEXT.replace('[5, "9/2"]', "[0, 0]", 1),
        "configurations[2].pose: leg 1 has length 0 at this pose",
    ),
    "metric": (RPR_TEXT.replace("[base]", "metric = [1]\n[base]"), "metric: a list of 1"),
    "negative metric": (
        RPR_TEXT.replace("[base]", "metric = [1, -3]\n[base]"),
        "metric[2]: -3 is not a positive integer",
    ),
    "slides of a 3-RPR": (PRR_TEXT.replace("3-PRR", "3-RPR"), "slides: a 3-RPR robot has none; remove the table"),
    "two cranks": (RRR_TEXT.replace("[4, 0], [4, 0], [4, 0]", "[4, 0], [4, 0]"), "at_0: 2 rows; give 3 vectors of 2"),
    "spatial crank": (
        RRR_TEXT.replace("at_0 = [[4, 0]", "at_0 = [[4, 0, 0]"),
        "cranks.at_0[1]: a list of 3; give a list of 2",
    ),
    "zero crank": (RRR_TEXT.replace("at_0 = [[4, 0]", "at_0 = [[0, 0]"), "cranks, leg 1: the crank has length 0"),
    "irrational crank": (
        RRR_TEXT.replace("[base]", "metric = [1, 3]\n[base]"),
        "not rational in this metric; choose one whose",
    ),
    "half tangents": (RRR_TEXT.replace(', "1/3", -2]', "]"), "half_tangents: 1 values; give 3, one per leg"),
    "direction": (PRR_TEXT.replace("[1, 0], [", "[0, 0], ["), "slides, leg 1: the direction is 0"),
    "spatial direction": (
        PRR_TEXT.replace("[1, 0], [", "[1, 0, 0], ["),
        "slides.directions[1]: a list of 3; give a list of 2",
    ),
    "rods": (
        PRR_TEXT.replace("length = 7", "lengths = [7, 7, 7, 7, 7, 7]"),
        "rods.lengths: 6 values; give 3, one per leg",
    ),
    "spatial kind": (RPR_TEXT.replace("3-RPR", "6-UPS"), "base.joints: 3 rows; give 6 joints of 3 coordinates"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_defect_gives_one_sentence(name: str) -> None:
    text, part = BAD[name]
    assert text not in (RPR_TEXT, RRR_TEXT, PRR_TEXT)
    with pytest.raises(InputError) as caught:
        robot_from_toml(text)
    message = str(caught.value)
    assert part in message
    assert message.isprintable()
    assert len(message) < 400


def test_constructors_refuse_what_leaves_the_plane() -> None:
    robot = read_robot(P)
    hexapod = read_robot(MODELS / "mssm.toml")
    corners = ((0, 0), (10, 0), (3, 10))
    with pytest.raises(InputError, match=r"base.joints\[1\]: a list of 3; give a list of 2"):
        replace(robot, base_joints=tuple((*corner, Fraction(1)) for corner in corners))  # type: ignore[arg-type]
    with pytest.raises(InputError, match="lengths_squared: 6 values; give 3, one per leg"):
        robot.problem([1] * 6)
    with pytest.raises(InputError, match="lengths_squared: 6 values; give 3, one per leg"):
        robot.problem(hexapod.configuration())
    with pytest.raises(InputError, match="lengths_squared: 3 values; give 6, one per leg"):
        hexapod.problem(robot.configuration())
    with pytest.raises(InputError, match="give the three leg lengths"):
        replace(robot, configurations=()).configuration()
    rest = (corners, robot.platform_joints, robot.metric, ())
    with pytest.raises(InputError, match="slides, leg 1: leaves the plane of a 3-PRR robot"):
        Robot("r", "3-PRR", "m", "s", *rest, (Slide((1, 0, 1), Fraction(1)),) * 3)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="cranks, leg 1: leaves the plane of a 3-RRR robot"):
        Robot("r", "3-RRR", "m", "s", *rest, (Crank((1, 0, 0), (0, 0, 1), Fraction(1)),) * 3)  # type: ignore[arg-type]


def test_the_table_shows_an_angle(capsys: Capture) -> None:
    assert main(["solve", P]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "Merlet 3-RPR (3-RPR), configuration home, formulation SE3"
    assert lines[1].startswith("6 complex solutions, 2 real poses; complete: ")
    assert lines[3] == "assembly modes: 1 pose with det J > 0 (2), 1 with det J < 0 (1)"
    assert "angle [degrees]" in lines[4]
    lines = lines[1:]
    assert lines[4].split() == ["x", "y", "theta", "det", "J", "cond", "J", "name"]
    assert lines[5].split()[:4] == ["1", "3.369707131", "6.216516215", "-46.2252860"]
    assert lines[6].split()[:4] == ["2", "5.000000000", "5.000000000", "0.0000000"]


def test_json_and_csv(capsys: Capture) -> None:
    assert main(["solve", RRR, "--format", "json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["robot"]["kind"] == "3-RRR"
    assert answer["configuration"]["joint_values"][0] == ["3/5", "4/5"]
    for pose in answer["poses"]:
        planar = pose["planar"]
        assert [planar["x"], planar["y"]] == pose["position"][:2]
        assert [planar["cos"], planar["sin"]] == [pose["rotation"][0][0], pose["rotation"][1][0]]
        assert (len(pose["position"]), len(pose["quaternion"])) == (3, 4)
    assert main(["solve", RRR, "--format", "csv"]) == 0
    assert len(capsys.readouterr().out.splitlines()) == 7
    assert main(["solve", str(MODELS / "robocrane-r.toml"), "--format", "json"]) == 0
    assert all("planar" not in pose for pose in json.loads(capsys.readouterr().out)["poses"])


def test_lengths_on_the_command_line(capsys: Capture) -> None:
    assert main(["solve", P, "--lengths", "7,5,5", "--format", "json"]) == 0
    assert json.loads(capsys.readouterr().out)["configuration"]["lengths_squared"] == ["49", "25", "25"]


def test_legs_of_planar_robots(capsys: Capture) -> None:
    assert main(["legs", P, "--position", "5,5", "--half-tangent", "0"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[:2] == [
        "Merlet 3-RPR (3-RPR), position (5, 5), cosine and sine (1, 0)",
        "lengths_squared = [50, 26, 25]",
    ]
    assert main(["legs", PRR, "--position", "5,4", "--cos-sin", "4/5,3/5", "--format", "json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["pose"]["planar"] == {"x": "5", "y": "4", "cos": "4/5", "sin": "3/5"}
    assert answer["working_modes"] == 8
    assert answer["legs"][0][0]["position"]["exact"] == "5 - sqrt(33)"
    assert main(["legs", RRR, "--position", "5,4", "--half-tangent", "1/3"]) == 0
    out = capsys.readouterr().out
    assert "out of reach: leg 3" in out
    assert "half tangent" in out


WRONG = [
    (["solve", P, "--lengths", "1,1,1,1,1,1"], "3-rpr-merlet-p.toml: lengths: 6 values; give 3, one per leg"),
    (
        ["solve", P, "--lengths", "1,1,1,1"],
        "lengths: 4 values; give 3, one per leg",
    ),
    (["solve", P, "--formulation", "AFD4"], "AFD4 is for spatial robots, but this one is planar; use SE3"),
    (["export", P, "--formulation", "AFP4", "--to", TARGETS[0]], "AFP4 is for spatial robots, but this one is planar"),
    (
        ["legs", P, "--position", "1,2"],
        "give exactly one of --quaternion, --cayley, --matrix and --rpy; of --half-tangent,",
    ),
    (["legs", P, "--position", "1,2,0", "--half-tangent", "0"], "--position: 3 numbers given, 2 are needed"),
    (
        ["legs", P, "--position", "1,2,0", "--cayley", "0,0,0"],
        "--cayley is for spatial robots, but a 3-RPR robot is planar",
    ),
    (["legs", P, "--position", "1,2", "--cos-sin", "1"], "--cos-sin: 1 numbers given, 2 are needed between commas"),
    (
        ["legs", P, "--position", "1,2", "--cos-sin", "1,1"],
        "--cos-sin: the squares of cosine and sine sum to 2, not to 1",
    ),
    (
        ["legs", str(MODELS / "6-6p.toml"), "--position", "1,2", "--cos-sin", "1,0"],
        "but a 6-UPS robot is spatial; give",
    ),
]


@pytest.mark.parametrize(("words", "part"), WRONG)
def test_wrong_words_give_one_sentence(words: list[str], part: str, capsys: Capture) -> None:
    assert main(words) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert part in captured.err
    assert captured.err.count("\n") == 1


def test_other_formulations_do_not_apply(capsys: Capture, tmp_path: Path) -> None:
    path = tmp_path / "rows.json"
    first = formulation_codes()[0]
    assert main(["formulations", P, "--only", f"{first},AFP4", "--json", str(path)]) == 3
    rows = json.loads(path.read_text())["rows"]
    assert [row["status"] for row in rows] == ["done", "not-applicable"]
