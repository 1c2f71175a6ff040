"""Published numbers of workspaces and singularities: areas, thresholds, loci."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import product
from math import cos, radians, sin
from pathlib import Path

import pytest
from flint import Ordering, fmpq_mpoly_ctx
from samples import MODELS, model, solved
from test_regions import asked

from pkm_exact import InputError, Robot
from pkm_exact.certify import pure
from pkm_exact.certify.check import Status, check_bytes
from pkm_exact.cli.main import main
from pkm_exact.cli.region_report import as_text
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.regions.arc_area import ArcArea, arc_area
from pkm_exact.regions.chart import rational
from pkm_exact.regions.crossings import crossings
from pkm_exact.regions.index_extremes import IndexRange
from pkm_exact.regions.largest_region import LargestAnswer, largest
from pkm_exact.regions.paving import leaves
from pkm_exact.regions.question_reader import of_size, question_from_toml
from pkm_exact.regions.region_conditions import asked_of
from pkm_exact.regions.region_legs import RegionMachine, region_machine
from pkm_exact.regions.region_points import PointJudge
from pkm_exact.regions.singularity_locus import locus, roots_in

FILES = {path.stem: path for path in MODELS}
ZERO, ONE = Fraction(0), Fraction(1)
LOCUS = "[conditions]\nno_type_2 = true\n[answer]\nkind = 'locus'\n"
SQUARES = """schema = 1
name = "4-RPR driven in turns"
kind = "4-RPR"
unit = "m"
source = "Firmani et al. in Parallel Manipulators: Towards New Applications (2008), chapter 6: edges 0.5, 0.2"
[base]
joints = [["-1/4", "-1/4"], ["1/4", "-1/4"], ["1/4", "1/4"], ["-1/4", "1/4"]]
[platform]
joints = [["-1/10", "-1/10"], ["1/10", "-1/10"], ["1/10", "1/10"], ["-1/10", "1/10"]]
[actuators]
driven = "R"
"""


HEXAPOD = """schema = 1
name = "Hexapod on inclined slides"
kind = "6-PUS"
unit = "m"
source = "Sinatra and Xi in Parallel Manipulators (2008), chapter 12, table 1; guides inward in pairs"
metric = [1, 3, 3]
[base]
joints = [
    ["-1/2", "-59/300", 0],
    ["1/2", "-59/300", 0],
    ["109/200", "-91/600", 0],
    ["9/200", "209/600", 0],
    ["-9/200", "209/600", 0],
    ["-109/200", "-91/600", 0],
]
[platform]
joints = [
    ["-1/4", "-17/150", 0],
    ["1/4", "-17/150", 0],
    ["59/200", "-41/600", 0],
    ["9/200", "109/600", 0],
    ["-9/200", "109/600", 0],
    ["-59/200", "-41/600", 0],
]
[slides]
directions = [
    ["3/2", "1/2", 1],
    ["-3/2", "1/2", 1],
    ["-3/2", "1/2", 1],
    [0, -1, 1],
    [0, -1, 1],
    ["3/2", "1/2", 1],
]
[rods]
length = 0.5
"""


def bipod(base: int) -> RegionMachine:
    text = FILES["bipod"].read_text().replace("[60, 0]", f"[{base}, 0]")
    return region_machine(
        robot_from_toml(text.replace("[[configurations]]", "[limits]\nlengths = [80, 130]\n[[configurations]]", 1))
    )


@pytest.mark.parametrize(("base", "area"), [(60, 4863.87799035), (62, 4693.32601787)])
def test_the_area_of_a_bipod(base: int, area: float) -> None:
    """Stan, Maties and Balan, chapter 14: the half plane above; what they print for 60 is the area for 62."""
    answer = asked(
        bipod(base),
        "position = [[-64, 128], [0, 128], 0]",
        "limits = true",
        "kind = 'map'\nsteps = 20\nboxes = 1000000",
    )
    assert answer.measures is not None
    low, high = map(float, answer.measures)
    assert low < area < high < low + 90
    arcs = arc_area(answer.machine, answer.question)
    assert arcs is not None
    assert arcs.pieces == 1
    assert arcs.area.width < Fraction(1, 10**9)
    assert abs(float(arcs.area) - area) < 1e-8


def test_both_halves_of_a_bipod_are_two_pieces_and_corners_are_cut() -> None:
    """The whole plane; a box in the area; a box that cuts it, against its map."""
    both = _arcs(60, "[-200, 400], [-200, 200]")
    assert both.pieces == 2
    assert abs(float(both.area) - 2 * 4863.87799035) < 1e-7
    assert float(_arcs(60, "[29, 31], [90, 95]").area) == 10
    cut = "[0, 90], [60, 110]"
    answer = asked(bipod(60), f"position = [{cut}, 0]", "limits = true", "kind = 'map'\nsteps = 16")
    assert answer.measures is not None
    assert answer.measures[0] < _arcs(60, cut).area.lo <= _arcs(60, cut).area.hi < answer.measures[1]


def test_arcs_say_nothing_of_what_else_is_asked() -> None:
    """A bound of an index cuts the area, and at a height out of its limits nothing is good."""
    question = (
        "[region]\nposition = [[-64, 128], [0, 128], 0]\n[conditions]\nlimits = true\n{0}[answer]\nkind = 'map'\n"
    )
    for more in ("indices = { transmission = 0.9 }\n", "forces = { load = [0, -10, 0], most = 6 }\n"):
        assert arc_area(bipod(60), question_from_toml(question.format(more), bipod(60))) is None
    limited = [((Fraction(-500), Fraction(500)),) * 2 + (pair,) for pair in ((ZERO, ONE), (ONE, ONE + 1))]
    inside, above = (replace(bipod(60), position=position) for position in limited)
    found = arc_area(inside, question_from_toml(question.format(""), inside))
    assert found is not None
    assert abs(float(found.area) - 4863.87799035) < 1e-8
    assert arc_area(above, question_from_toml(question.format(""), above)) is None


@pytest.mark.slow
@pytest.mark.parametrize(("base", "area"), [(60, 4863.87799035), (62, 4693.32601787)])
def test_the_area_of_a_bipod_by_paving_to_one_in_a_thousand(base: int, area: float) -> None:
    answer = asked(
        bipod(base),
        "position = [[-64, 128], [0, 128], 0]",
        "limits = true",
        "kind = 'map'\nsteps = 30\nboxes = 10000000",
    )
    assert answer.measures is not None
    low, high = map(float, answer.measures)
    assert low < area < high < 1.001 * low


@pytest.mark.parametrize(
    ("base", "low", "high", "pieces"),
    [(60, 80, 130, 2), (60, 80, 100, 2), (60, 50, 130, 1), (200, 80, 130, 1), (200, 110, 130, 2)],
)
def test_how_many_pieces_a_bipod_has(base: int, low: int, high: int, pieces: int) -> None:
    """Chapter 14: two mirror images in cases I (first) and II (last), one piece in IV; 50, 130, 60 is connected."""
    text = FILES["bipod"].read_text().replace("[60, 0]", f"[{base}, 0]")
    table = f"[limits]\nlengths = [{low}, {high}]\n[[configurations]]"
    machine = region_machine(robot_from_toml(text.replace("[[configurations]]", table, 1)))
    region = "[region]\nposition = [[-301, 401], [-301, 302], 0]\n[conditions]\nlimits = true\n"
    found = arc_area(machine, question_from_toml(f"{region}[answer]\nkind = 'map'\n", machine))
    assert found is not None
    assert found.pieces == pieces


@pytest.mark.parametrize(
    ("modes", "slides", "box"),
    [
        ("--", "[0, 3]", None),
        ("++", "[0, 3]", None),
        ("--", "[0, 8]", "[-0.7, 0.6], [3.7, 7]"),
        ("+-", "[-3, 6.7]", None),
    ],
)
def test_the_area_of_a_biglide_both_ways(modes: str, slides: str, box: str | None) -> None:
    """Chapter 14, with its L1 stated: 4, and rods of 5; by arcs and by paving, which agree."""
    text = (
        FILES["biglide"]
        .read_text()
        .replace("[[configurations]]", f"[limits]\nslides = {slides}\n[[configurations]]", 1)
    )
    machine = region_machine(robot_from_toml(text))
    region = f"position = [{box or '[-10, 10], [-20, 20]'}, 0]"
    answer = asked(machine, region, f"limits = true\nworking_modes = {list(modes)}", "kind = 'map'\nsteps = 16")
    arcs = arc_area(machine, answer.question)
    assert arcs is not None
    assert answer.measures is not None
    assert answer.measures[0] < arcs.area.lo <= arcs.area.hi < answer.measures[1]
    assert arcs.area.width < Fraction(1, 10**9)
    assert arcs.pieces == 1


def test_the_area_of_a_biglide_is_that_of_an_integral() -> None:
    """Both slides from 0 to 3: for each x the y between the upper of two half circles and 3 below the lower."""
    text = (
        FILES["biglide"].read_text().replace("[[configurations]]", "[limits]\nslides = [0, 3]\n[[configurations]]", 1)
    )
    machine = region_machine(robot_from_toml(text))
    lines = "[region]\nposition = [[-10, 10], [-20, 20], 0]\n[conditions]\nlimits = true\nworking_modes = ['-', '-']\n"
    found = arc_area(machine, question_from_toml(f"{lines}[answer]\nkind = 'map'\n", machine))
    assert found is not None
    count = 20000
    total = 0.0
    for k in range(count):
        x = -1 + 2 * (k + 0.5) / count
        heights = [(25 - (x - a) ** 2) ** 0.5 for a in (4, -4)]
        total += max(0.0, 3 + min(heights) - max(heights)) * 2 / count
    assert abs(total - float(found.area)) < 1e-4


def _arcs(base: int, box: str) -> ArcArea:
    machine = bipod(base)
    text = f"[region]\nposition = [{box}, 0]\n[conditions]\nlimits = true\n[answer]\nkind = 'map'\n"
    found = arc_area(machine, question_from_toml(text, machine))
    assert found is not None
    return found


def test_three_legs_that_turn_are_bounded_by_arcs_too() -> None:
    """Merlet's planar robot with limits, at an angle of 0: the area lies in the bounds of its map."""
    table = "[limits]\nlengths = [[4, 8], [4, 8], [1.5, 6]]\nposition = [[0, 6], [0, 11]]\n[[configurations]]"
    text = FILES["3-rpr-merlet-p"].read_text().replace("[[configurations]]", table, 1)
    machine = region_machine(robot_from_toml(text))
    region = "position = [[-9, 9], [-9, 12]]\ndegrees = 0"
    answer = asked(machine, region, "limits = true", "kind = 'map'\nsteps = 16")
    arcs = arc_area(machine, answer.question)
    assert arcs is not None
    assert answer.measures is not None
    assert answer.measures[0] < arcs.area.lo <= arcs.area.hi < answer.measures[1]
    assert arc_area(machine, question_from_toml(f"[region]\n{region}\n{LOCUS}", machine)) is None


def jl1(height: str) -> RegionMachine:
    text = FILES["2-ups-u"].read_text().replace("height = 4", f'height = "{height}"')
    return region_machine(robot_from_toml(text))


def test_the_threshold_of_a_reconfigurable_joint() -> None:
    """Chapter 16, plate-mounted struts: both angles within 45 degrees; free of singularities from 2 sqrt(2) on."""
    region = "position = [0, 0, 0]\nrpy_degrees = [[-45, 45], [-45, 45], 0]"
    assert asked(jl1("2.9"), region, "no_type_2 = true").is_proved
    assert asked(jl1("2.8"), region, "no_type_2 = true").counterexample is not None
    assert asked(jl1("2.829"), region, "no_type_2 = true").is_proved
    assert asked(jl1("2.828"), region, "no_type_2 = true").counterexample is not None


def test_a_singular_circle_of_a_planar_robot() -> None:
    """Firmani et al., chapter 6: at the angle 0 x^2 + y^2 = 3/100; the y of the model is y / sqrt(3)."""
    machine = region_machine(model("3-rpr-turned"))
    found = locus(
        machine, question_from_toml(f"[region]\nposition = [[-1, 1], [-1, 1]]\ndegrees = 0\n{LOCUS}", machine)
    )
    assert found.factors == (("100*x^2 + 300*y^2 - 3", 1),)


def test_the_common_circle_of_four_legs() -> None:
    machine = region_machine(robot_from_toml(SQUARES))
    found = locus(
        machine, question_from_toml(f"[region]\nposition = [[-1, 1], [-1, 1]]\ndegrees = 0\n{LOCUS}", machine)
    )
    assert found.factors == (("200*x^2 + 200*y^2 - 9", 1),)
    assert found.is_redundant


def test_singular_poses_on_a_line() -> None:
    """Merlet's planar robot at the angle 0: y = 0, or 5 x + 2 y = 21."""
    machine = region_machine(model("3-rpr-merlet-p"))
    found = locus(machine, question_from_toml(f"[region]\nposition = [[-9, 9], 5]\ndegrees = 0\n{LOCUS}", machine))
    assert found.points is not None
    (point,) = found.points
    assert point.contains(Fraction(11, 5))
    none = locus(machine, question_from_toml(f"[region]\nposition = [[3, 9], 5]\ndegrees = 0\n{LOCUS}", machine))
    assert none.points == ()
    plane = locus(machine, question_from_toml(f"[region]\nposition = [[0, 9], [0, 9]]\ndegrees = 0\n{LOCUS}", machine))
    assert dict(plane.factors) == {"y": 1, "5*x + 2*y - 21": 1}


def test_the_distance_of_singular_poses_is_enclosed(tmp_path: Path) -> None:
    """Merlet's planar robot at the angle 0: 5 x + 2 y = 21 is 12 / sqrt(29) from (5, 4)."""
    question = tmp_path / "question.toml"
    text = "[region]\ndegrees = 0\n[conditions]\n{0} = true\n[answer]\nkind = 'largest'\nshape = '{1}'\n"
    text += "about = [5, 4]\nprecision = '1/50'\n"
    question.write_text(text.format("no_type_2", "ball"))
    robot = Robot.load(FILES["3-rpr-merlet-p"])
    found = robot.region(question)
    assert isinstance(found, LargestAnswer)
    assert found.distance is not None
    assert found.distance.lo**2 <= Fraction(144, 29) <= found.distance.hi**2
    assert found.distance.width <= found.distance.lo / 50
    assert "distance of the nearest singular pose of this orientation: between 2.2" in as_text(found)
    for conditions, shape in (("no_type_2", "cube"), ("no_type_1", "ball")):
        question.write_text(text.format(conditions, shape).replace("1/50", "1"))
        other = robot.region(question)
        assert isinstance(other, LargestAnswer)
        assert other.distance is None


def test_extremes_are_answered_to_programs_too() -> None:
    """And no other answer in their place."""
    text = "[region]\nposition = [[4, 6], [4, 6]]\ndegrees = 0\n[conditions]\nreachable = true\nlength = 3\n[answer]\n"
    robot = Robot.load(FILES["3-rpr-merlet-p"])
    ranges = robot.region(f"{text}kind = 'extremes'\nof = 'joint_values'\nprecision = '1/10'\n")
    assert isinstance(ranges, tuple)
    assert [leg.name for leg in ranges] == ["leg 1", "leg 2", "leg 3"]
    index = robot.region(f"{text}kind = 'extremes'\nof = 'transmission'\nprecision = '1'\n")
    assert isinstance(index, IndexRange)
    assert 0 <= index.least.lo <= index.greatest.hi <= 1
    with pytest.raises(InputError, match="varies a number of a model file"):
        robot.region(f"{text}kind = 'threshold'\nparameter = 'base.joints.2.1'\nbetween = [1, 2]\n")


@pytest.mark.parametrize(
    ("low", "high", "count"),
    [
        ("7/10", "3/4", 1),
        ("0.7071067811865475244", "1", 1),
        ("0.7071067811865475245", "1", 0),
        ("0", "0.7071067811865475244", 0),
        ("0", "0.7071067811865475245", 1),
    ],
)
def test_a_root_beside_an_end_of_the_region_is_in_it_or_not(low: str, high: str, count: int) -> None:
    """1 / sqrt(2): closer to the end than its first enclosure is wide."""
    ring = fmpq_mpoly_ctx.get(("x",), Ordering.lex)
    (x,) = ring.gens()
    ends = Fraction(low), Fraction(high)
    found = list(roots_in(2 * x * x - 1, *ends))
    assert len(found) == count
    for root in found:
        assert ends[0] <= root.lo < root.hi <= ends[1]
        assert root.lo**2 < Fraction(1, 2) < root.hi**2
    assert [root.lo for root in roots_in(3 * x - 1, Fraction(1, 3), ONE)] == [Fraction(1, 3)]
    assert not list(roots_in(3 * x - 1, Fraction(1, 3) + Fraction(1, 10**30), ONE))


def test_the_largest_cube_about_a_pose_of_rollands_robot() -> None:
    """About pose 10, at its orientation to nine digits, to one per cent."""
    machine, pose = region_machine(model("rolland-6-6")), solved("rolland-6-6").poses[9]
    turn = [str(q.midpoint.limit_denominator(10**9)) for q in pose.quaternion]
    place = [str(c.midpoint.limit_denominator(10**6)) for c in pose.position]
    text = (
        f"[region]\nquaternion = {turn}\n[conditions]\nno_type_2 = true\n[answer]\nkind = 'largest'\nshape = 'cube'\n"
    )
    question = question_from_toml(f"{text}about = {place}\n", machine)
    answer = largest(machine, question, lambda size: of_size(question, machine, size))
    assert answer.refused is not None
    assert answer.refused.counterexample is not None
    assert 2300 < answer.size < (answer.refused_size or 0) < 1.011 * float(answer.size) < 2450


def test_the_command_says_where(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    question = tmp_path / "locus.toml"
    question.write_text(f"[region]\nposition = [[-9, 9], 5]\ndegrees = 0\n{LOCUS}")
    assert main(["region", str(FILES["3-rpr-merlet-p"]), str(question)]) == 0
    out = capsys.readouterr().out
    assert "5*x - 11 = 0\n" in out
    assert "in the region: x = 2.2" in out
    assert main(["region", str(FILES["3-rpr-merlet-p"]), str(question), "--format", "json"]) == 0
    content = json.loads(capsys.readouterr().out)
    assert content["factors"] == [{"polynomial": "5*x - 11", "power": 1}]
    assert main(["region", str(FILES["3-rpr-merlet-p"]), str(question), "-o", str(tmp_path / "a.json")]) == 2


def test_the_singular_point_on_the_path_of_a_hexapod(tmp_path: Path) -> None:
    """Sinatra and Xi, chapter 12: six vertical parallel legs at z = 1/2 + 1/(2 sqrt(3)), on the way from 0.7 to 0.8."""
    robot, path, target = tmp_path / "robot.toml", tmp_path / "path.csv", tmp_path / "out.json"
    robot.write_text(HEXAPOD)
    path.write_text("x,y,z,roll,pitch,yaw\n0,0,0.7,0,0,0\n0,0,0.8,0,0,0\n")
    command = ["track", str(robot), str(path), "-o", str(target), "--working-modes=-,-,-,-,-,-"]
    assert main(command) == 3
    low, high = map(float, json.loads(target.read_text())["stopped"]["at"]["z"])
    assert low < high < 0.5 + 1 / (2 * 3**0.5) < low + 1e-6
    path.write_text("x,y,z,roll,pitch,yaw\n0,0,0.7,0,0,0\n0,0,0.788,0,0,0\n")
    assert main(command) == 0


def test_driven_hinges_have_no_certificates(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    question = tmp_path / "question.toml"
    lines = "[region]\nposition = [[0, '1/10'], [0, '1/20']]\ndegrees = 0\n[conditions]\nno_type_2 = true\n"
    question.write_text(f"{lines}[answer]\nkind = 'all'\n")
    path = str(FILES["3-rpr-turned"])
    assert main(["region", path, str(question)]) == 0
    assert "proved" in capsys.readouterr().out
    assert main(["region", path, str(question), "-o", str(tmp_path / "a.json")]) == 2
    assert "no word for driven hinges" in capsys.readouterr().err


CIRCLE = "arc = {{ center = [0.425, 0.425, 0.3], radius = 0.175, degrees = [{0}, {1}] }}"
HALVES = (CIRCLE.format(-90, 90), CIRCLE.format(90, 270))


@pytest.mark.slow
def test_half_of_the_circle_of_the_cartesian_manipulator() -> None:
    """Two working modes: one is regular along it, the other crosses singularities of type 2 twice."""
    machine = region_machine(model("3-prrr"))
    assert asked(machine, HALVES[0], "no_type_1 = true\nno_type_2 = true\nworking_modes = ['+', '+', '+']").is_proved
    assert _crossings(machine, ["+", "+", "-"], HALVES[:1]) == 2


def test_crossings_of_the_circle_are_isolated(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of the working mode (+, +, -) two on this half, and none on the other."""
    machine = region_machine(model("3-prrr"))
    text = "[region]\n{0}\n[conditions]\nno_type_2 = true\nworking_modes = {1}\n[answer]\nkind = '{2}'\n"
    for half, count in zip(HALVES, (2, 0), strict=True):
        question = question_from_toml(text.format(half, ["+", "+", "-"], "locus"), machine)
        found = locus(machine, question)
        assert found.points is not None
        assert (len(found.points), found.undecided) == (count, ())
        asked_here = asked_of(machine, question.chart, question.conditions)
        judge = PointJudge(asked_here, asked_here.formula)
        for point in found.points:
            assert point.width < 1e-12
            assert judge.determinant_sign((point.lo,)) == -judge.determinant_sign((point.hi,)) != 0
    path = tmp_path / "question.toml"
    path.write_text(text.format(HALVES[0], ["+", "+", "-"], "locus"))
    assert main(["region", str(FILES["3-prrr"]), str(path)]) == 0
    assert "in the region: arc = -0.5546130402" in capsys.readouterr().out


def test_zeros_of_functions_with_roots() -> None:
    """y = 2 t meets the circle once; a double zero, and one where the circle ends, are undecided, and nothing else."""
    t, y = fmpq_mpoly_ctx.get(("t", "y"), Ordering.lex).gens()
    circle = [1 - t * t]
    one = crossings(y - 2 * t, circle, Fraction(-2), Fraction(2))
    assert [root.contains(Fraction(4472135954999579392818, 10**22)) for root in one.zeros] == [True]
    assert one.undecided == ()
    double = crossings((5 * y - 4) ** 2, circle, Fraction(0), Fraction(2))
    assert double.zeros == ()
    assert [part.contains(Fraction(3, 5)) and part.width < 1e-6 for part in double.undecided] == [True]
    edge = crossings(y, circle, Fraction(0), Fraction(2))
    assert edge.zeros == ()
    assert [part.contains(ONE) and part.width < 1e-6 for part in edge.undecided] == [True]


@pytest.mark.slow
def test_the_circle_of_the_cartesian_manipulator() -> None:
    """Elkady et al., chapter 13: all reached; six of the eight working modes are regular all along, the others not."""
    machine = region_machine(model("3-prrr"))
    for half in HALVES:
        assert asked(machine, half, "no_type_1 = true").is_proved
    refuted = []
    for modes in product("+-", repeat=3):
        answers = [asked(machine, half, f"no_type_2 = true\nworking_modes = {list(modes)}") for half in HALVES]
        assert all(answer.is_proved or answer.counterexample is not None for answer in answers)
        if not all(answer.is_proved for answer in answers):
            refuted.append("".join(modes))
    assert len(refuted) == 2
    assert sum(one != other for one, other in zip(*refuted, strict=True)) == 1
    for modes in refuted:
        assert _crossings(machine, list(modes)) == 2
    text = "[region]\n{0}\n[conditions]\nno_type_2 = true\nworking_modes = {1}\n[answer]\nkind = 'locus'\n"
    for modes in product("+-", repeat=3):
        found = [locus(machine, question_from_toml(text.format(half, list(modes)), machine)) for half in HALVES]
        assert not any(half.undecided for half in found)
        assert sum(len(half.points or ()) for half in found) == (2 if "".join(modes) in refuted else 0)


def _crossings(machine: RegionMachine, modes: list[str], halves: Sequence[str] = HALVES) -> int:
    """Short stretches that are undecided, at whose ends the determinant has opposite signs, decided exactly."""
    count = 0
    for half in halves:
        answer = asked(machine, half, f"no_type_2 = true\nworking_modes = {modes}", "kind = 'map'\nsteps = 20")
        found = asked_of(machine, answer.question.chart, answer.question.conditions)
        judge, (low, high) = PointJudge(found, found.formula), answer.question.chart.box[0]
        ends: list[Fraction] = []
        for letter, part in leaves(answer.word, answer.axes, 1):
            begin, end = (low + (high - low) * (part.places[0] + k) / 2**part.depth for k in (0, 1))
            assert letter in "iu"
            if letter == "u" and ends and ends[-1] == begin:
                ends[-1] = end
            elif letter == "u":
                ends += [begin, end]
        for begin, end in zip(ends[::2], ends[1::2], strict=True):
            assert end - begin < Fraction(1, 10**4)
            assert judge.determinant_sign((begin,)) == -judge.determinant_sign((end,)) != 0
            count += 1
    return count


def test_an_arc_lies_on_its_circle_and_is_refused_where_it_is_none() -> None:
    machine = region_machine(model("3-rpr-merlet-p"))
    arc = "[region]\narc = {{ center = [1, 2], radius = 3, degrees = {0} }}\ndegrees = 0\n"
    text = f"{arc}[conditions]\nreachable = true\n"
    question = question_from_toml(f"{text.format('[100, 200]')}[answer]\nkind = 'all'\n", machine)
    pose = asked_of(machine, question.chart, question.conditions).pose
    for t, angle in zip(question.chart.box[0], (100, 200), strict=True):
        n, x, y = (
            float(Fraction(int(v.p), int(v.q))) for v in (p(rational(t)) for p in (pose.norm, *pose.position[:2]))
        )
        assert abs(x / n - 1 - 3 * cos(radians(angle))) < 1e-9
        assert abs(y / n - 2 - 3 * sin(radians(angle))) < 1e-9
    for degrees, said in (("[0, 350]", "too long"), ("[3, 1]", "not less than")):
        with pytest.raises(InputError, match=said):
            question_from_toml(f"{text.format(degrees)}[answer]\nkind = 'all'\n", machine)
    with pytest.raises(InputError, match="in models without metric"):
        asked(region_machine(model("delta")), CIRCLE.format(0, 90), "reachable = true")


@pytest.mark.parametrize(
    ("name", "region"),
    [
        ("3-prrr", "position = [[0.4, 0.45], 0.4, 0.3]"),
        ("3-rpr-merlet-p", "arc = { center = [5, 5], radius = 1, degrees = [0, 9] }\ndegrees = 0"),
    ],
)
def test_arcs_and_rods_along_axes_have_certificates(name: str, region: str, tmp_path: Path) -> None:
    question, target = tmp_path / "question.toml", tmp_path / "a.json"
    question.write_text(f"[region]\n{region}\n[conditions]\nreachable = true\n[answer]\nkind = 'all'\n")
    assert main(["region", str(FILES[name]), str(question), "-o", str(target)]) == 0
    data = target.read_bytes()
    assert check_bytes(data).status is Status.ACCEPTED
    assert pure.check_bytes(data).status == "accepted"
