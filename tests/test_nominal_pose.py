"""Which pose is meant, joint values of all actuators on the command line, and words where lengths fit no pose."""

import json
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from samples import model, solved

from pkm_exact.cli.main import main
from pkm_exact.errors import InputError
from pkm_exact.geometry.nominal_pose import NominalPose, nominal_from_numbers
from pkm_exact.geometry.pose_reader import read_pose
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.motions.motion_groups import SPATIAL
from pkm_exact.poses.meant_lengths import farthest_note, meant_notes
from pkm_exact.poses.nearest_pose import nearest_pose
from pkm_exact.poses.unreachable_legs import unreachable_notes

MODELS = Path(__file__).parent.parent / "models"
PLANAR, ARMS, SLIDES, DELTA = (str(MODELS / f"{name}.toml") for name in ("3-rpr-merlet-p", "3-rrr", "3-prr", "delta"))
Capture = pytest.CaptureFixture[str]


def _json(words: Sequence[str], capsys: Capture) -> dict[str, object]:
    assert main([*words, "--format", "json"]) == 0
    found: dict[str, object] = json.loads(capsys.readouterr().out)
    return found


@pytest.mark.parametrize("name", ["3-rrr", "mssm"])
def test_every_pose_is_the_nearest_to_itself(name: str) -> None:
    poses = solved(name).poses
    for number, pose in enumerate(poses, 1):
        x, y, z = (entry.lo for entry in pose.position)
        rows = [tuple(entry.hi for entry in row) for row in pose.rotation]
        found = nearest_pose(poses, NominalPose((x, y, z), (rows[0], rows[1], rows[2])))  # type: ignore[arg-type]
        assert found is not None
        assert found.numbers == (number,)
        assert found.position_off < 1e-8


def test_poses_that_are_equally_near_are_all_named() -> None:
    poses = solved("3-rrr").poses
    x, y, z = (entry.lo for entry in poses[1].position)
    rows = [tuple(entry.hi for entry in row) for row in poses[1].rotation]
    meant = NominalPose((x, y, z), (rows[0], rows[1], rows[2]))  # type: ignore[arg-type]
    found = nearest_pose((poses[1], poses[0], poses[1]), meant)
    assert found is not None
    assert sorted(found.numbers) == [1, 3]


def test_the_model_s_nominal_pose_is_marked_everywhere(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "meant.toml"
    path.write_text(Path(PLANAR).read_text() + "\n[nominal]\nposition = [5, 4]\ndegrees = 5\n")
    assert main(["solve", str(path)]) == 0
    out = capsys.readouterr().out
    assert "note: pose 2 is the nearest to the nominal pose: its position is 1, its rotation 5 degrees from it" in out
    assert "\n2*  " in out
    answer = _json(["solve", str(path)], capsys)
    assert answer["nearest_to_nominal"] == [2]
    far = _json(["solve", str(path), "--near", "-1,3,-170"], capsys)
    assert far["nearest_to_nominal"] == [1]
    assert "nearest_to_nominal" not in _json(["solve", PLANAR], capsys)


@pytest.mark.parametrize(
    ("table", "part"),
    [
        ("position = [5]\ndegrees = 5", "nominal.position"),
        ("position = [5, 4]", "nominal: no angle given"),
        ("position = [5, 4]\nquaternion = [1, 0, 0, 0]", "quaternion"),
    ],
)
def test_a_nominal_pose_that_is_none_is_refused(table: str, part: str) -> None:
    with pytest.raises(InputError, match=part):
        robot_from_toml(Path(PLANAR).read_text() + f"\n[nominal]\n{table}\n")


def test_joint_values_of_all_kinds(capsys: Capture) -> None:
    legs = _json(["solve", PLANAR, "--joints", "7.1,26/5,5"], capsys)
    assert legs["poses"] == _json(["solve", PLANAR, "--lengths", "7.1,26/5,5"], capsys)["poses"]
    for path, key in ((SLIDES, "slides"), (ARMS, "half_tangents")):
        numbers = next(line for line in Path(path).read_text().splitlines() if line.startswith(f"{key} ="))
        words = numbers.partition("[")[2].partition("]")[0].replace('"', "").replace(" ", "")
        assert _json(["solve", path, "--joints", words], capsys)["poses"] == _json(["solve", path], capsys)["poses"]
    right = _json(["solve", ARMS, "--joints", "90deg,0deg,-90deg"], capsys)
    assert right["poses"] == _json(["solve", ARMS, "--joints", "1,0,-1"], capsys)["poses"]
    assert _json(["solve", DELTA, "--joints", "0,1/7,1/5"], capsys)["claim"] == "complete"


def test_an_angle_that_is_not_rational_is_not_rounded_in_silence(capsys: Capture) -> None:
    assert main(["solve", ARMS, "--joints", "37deg,0,0"]) == 0
    sentence = "37 degrees, whose cosine and sine are not both rational here"
    assert capsys.readouterr().out.count(sentence) == 1
    assert main(["solve", ARMS, "--joints", "37deg,0,0", "--format", "csv"]) == 0
    assert capsys.readouterr().err.count(sentence) == 1
    assert sentence in _json(["solve", ARMS, "--joints", "37deg,0,0"], capsys)["notes"][-1]


def test_a_number_that_is_no_small_half_tangent_is_perhaps_one_of_degrees(capsys: Capture) -> None:
    said = "--joints, crank 1: 30 is taken as a half tangent, an angle of 176.2 degrees; write 30deg for degrees"
    notes = _json(["solve", ARMS, "--joints", "30,0,5"], capsys)["notes"]
    assert [note for note in notes if "half tangent" in note] == [said.replace("crank", "leg")]
    assert main(["solve", SLIDES, "--joints", "30,0,5"]) == 0
    assert "half tangent" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["--joints", "1,2"], "--joints: 2 values; give 3, for leg 1, leg 2, leg 3"),
        (["--joints", "1,2,30deg"], "--joints, leg 3: is no angle"),
        (["--joints", "1,2,0"], "--joints, leg 3: 0 is no length"),
        (["--joints", "1,2,x"], "--joints, number 3: x is not a number"),
        (["--joints", "1,2,3", "--lengths", "1,2,3"], "--lengths and --joints exclude each other"),
        (["--near", "1,2"], "--near: 2 numbers; give X,Y,DEGREES"),
        (["--near", "1,2,1e9"], "out of range; give degrees"),
    ],
)
def test_words_that_do_not_fit_give_one_sentence(words: list[str], part: str, capsys: Capture) -> None:
    assert main(["solve", PLANAR, *words]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert part in err


def test_lengths_in_another_unit_or_exchanged_are_recognised(capsys: Capture) -> None:
    rolland = str(MODELS / "rolland-6-6.toml")
    assert main(["solve", rolland, "--lengths", "1.25,1.25,1.25,1.25,1.25,1.25"]) == 0
    out = capsys.readouterr().out
    assert "leg 1 is 1.25 mm long, but with the others as they are it could be no shorter than 790.7 mm" in out
    assert "lengths 1000 times these would not contradict each other" in out
    robot = model("mourrain-l")
    squares = [leg.length_squared for leg in robot.problem(robot.configuration()).distances]
    assert unreachable_notes(robot.problem(squares), "mm") == ()


def test_rods_that_do_not_reach_are_called_rods_and_not_lengths_to_change(capsys: Capture) -> None:
    assert main(["solve", DELTA, "--joints", "30deg,45deg,150deg"]) == 0
    last = capsys.readouterr().out.splitlines()[-1]
    assert last == (
        "note: no pose: rod 1 is 2.66 long, but at these joint values with the others as they are it could be no "
        "shorter than 2.724"
    )


@given(st.lists(st.integers(1, 60), min_size=3, max_size=3))
def test_nothing_is_said_where_a_pose_exists(lengths: list[int]) -> None:
    """Legs from joints to a platform placed somewhere never contradict each other."""
    robot = model("3-rpr-merlet-p")
    at = [Fraction(x, 4) for x in lengths]
    joints = zip(robot.base_joints, robot.platform_joints, strict=True)
    squares = [(at[0] + b[0] - a[0]) ** 2 + (at[1] + b[1] - a[1]) ** 2 for a, b in joints]
    if all(squares):
        assert unreachable_notes(robot.problem(squares), "mm") == ()


def test_two_lengths_that_were_exchanged_are_named() -> None:
    """By the lengths alone: legs 1 and 2 in each other's place close all quadrilaterals."""
    robot = model("3-rpr-merlet-p")
    assert unreachable_notes(robot.problem_at([Fraction(n) for n in (5, 1, 15)]), "mm") == ()
    assert unreachable_notes(robot.problem_at([Fraction(n) for n in (1, 5, 15)]), "m") == (
        "no pose: leg 1 is 1 m long, but with the others as they are it could be no shorter than 1.731 m",
        "with the lengths of legs 1 and 2 exchanged they would not contradict each other",
    )
    with_unit, without = (
        unreachable_notes(robot.problem_at([Fraction(50), Fraction(5), Fraction(7)]), unit) for unit in ("mm", "1")
    )
    assert without[0].endswith("leg 1 is 50 long, but with the others as they are it could be at most 19 long")
    assert with_unit[0].startswith("no pose: leg 1 is 50 mm long")


MEANT = "\n[nominal]\nposition = [5, 5]\ndegrees = 0\n"


@pytest.mark.parametrize(
    ("lengths", "words"),
    [
        ("7.08,5.1,5.03", None),
        ("0.00708,0.0051,0.00503", "multiplied by 1000, as if they were in metres, they are off by"),
        ("7.08,5.1,0.00503", "with that of leg 3 multiplied by 1000, as if it was in metres, they are off by"),
        ("0.278,0.2,0.198", "multiplied by 25.4, as if they were in inches, they are off by"),
        ("7.08,0.2,5.03", "with that of leg 2 multiplied by 25.4, as if it was in inches, they are off by"),
    ],
)
def test_what_was_meant_is_guessed_at_the_nominal_pose(
    lengths: str, words: str | None, tmp_path: Path, capsys: Capture
) -> None:
    path = tmp_path / "meant.toml"
    path.write_text(Path(PLANAR).read_text().replace('unit = "1"', 'unit = "mm"') + MEANT)
    notes = _json(["solve", str(path), "--lengths", lengths], capsys)["notes"]
    guesses = [note for note in notes if note.startswith("at the nominal pose these lengths are off by")]
    assert len(guesses) == (words is not None)
    assert words is None or words in guesses[0]


def test_exchanged_joints_are_recognised_though_there_are_poses() -> None:
    """A hexapod whose rows 1 and 4 of the platform are in each other's place has poses, none of which is meant."""
    robot = replace(
        model("rolland-6-6"), nominal=nominal_from_numbers([Fraction(n) for n in (0, 0, 770, 0, 0, 0)], "", SPATIAL)
    )
    rows = list(robot.platform_joints)
    rows[0], rows[3] = rows[3], rows[0]
    problem = replace(robot, platform_joints=tuple(rows)).problem(robot.configuration())
    assert robot.nominal is not None
    (note,) = meant_notes(problem, robot.nominal, "mm")
    assert "with the platform joints of legs 1 and 4 exchanged they are off by" in note
    assert meant_notes(robot.problem(robot.configuration()), robot.nominal, "mm") == ()
    far = robot.problem_at([Fraction(10) ** 399] * 6, squared=True)
    assert meant_notes(far, robot.nominal, "mm") == farthest_note(far, robot.nominal, "mm") == ()


def test_a_rotation_may_be_a_matrix_as_it_was_recorded() -> None:
    rows = [["0.866", "-0.5", "0"], ["0.5", "0.866", "0"], ["0", "0", "1"]]
    pose: dict[str, object] = {"position": [1, 2, 3], "matrix": rows}
    with pytest.raises(
        InputError, match=r"pose\.matrix: is no rotation, the next one differs by up to 0.0000191; give"
    ):
        read_pose(pose, "pose", SPATIAL, (1, 1, 1))
    with pytest.raises(InputError, match=r"is no rotation, the next one differs"):
        read_pose(pose | {"nearest": "0.00001"}, "pose", SPATIAL, (1, 1, 1))
    _, turned = read_pose(pose | {"nearest": "0.001"}, "pose", SPATIAL, (1, 1, 1))
    assert abs(turned[0][0] - Fraction("0.866")) < Fraction(1, 10**4)
    assert sum(x * x for x in turned[0]) == 1
    exact = [["3/5", "-4/5", 0], ["4/5", "3/5", 0], [0, 0, 1]]
    assert read_pose(pose | {"matrix": exact}, "pose", SPATIAL, (1, 1, 1))[1][1][0] == Fraction(4, 5)
    for wrong, part in (
        ([[0, 1, 0], [1, 0, 0], [0, 0, 1]], "is not even nearly a rotation"),
        ([[1, 0, 0], [0, 1, 0]], "2 rows; give 3"),
        ([[1, 0], [0, 1], [0, 0]], "matrix"),
    ):
        with pytest.raises(InputError, match=part):
            read_pose(pose | {"matrix": wrong}, "pose", SPATIAL, (1, 1, 1))
    with pytest.raises(InputError, match="in a metric give a quaternion"):
        read_pose(pose, "pose", SPATIAL, (1, 3, 1))
    with pytest.raises(InputError, match="unknown key 'nearest'"):
        read_pose({"position": [1, 2, 3], "quaternion": [1, 0, 0, 0], "nearest": 1}, "pose", SPATIAL, (1, 1, 1))
    numbers = [Fraction(str(n)) for n in (1, 2, 3, *(entry for row in rows for entry in row))]
    assert abs(nominal_from_numbers(numbers, "--near", SPATIAL).rotation[1][0] - Fraction(1, 2)) < Fraction(1, 10**4)
    with pytest.raises(InputError, match="--near: is not even nearly a rotation"):
        nominal_from_numbers([Fraction(1)] * 12, "--near", SPATIAL)


def test_a_path_begins_at_the_nominal_pose(tmp_path: Path, capsys: Capture) -> None:
    path, model_path, out = tmp_path / "path.csv", tmp_path / "meant.toml", tmp_path / "out.json"
    path.write_text("l1,l2,l3\n7.1,5.1,5\n7.12,5.1,5\n")
    model_path.write_text(Path(PLANAR).read_text() + "\n[nominal]\nposition = [5, 4]\ndegrees = 5\n")
    assert main(["track", str(model_path), str(path), "--start", "near", "-o", str(out)]) == 0
    near = out.read_bytes()
    out.unlink()
    assert main(["track", str(model_path), str(path), "--start", "2", "-o", str(out)]) == 0
    assert out.read_bytes() == near
    capsys.readouterr()
    for words, part in (
        (["near"], "the model has no nominal pose"),
        (["x"], "--start: 'x' is no pose"),
        (["0"], "is no pose"),
    ):
        assert main(["track", PLANAR, str(path), "--start", *words, "-o", str(tmp_path / "other.json")]) == 2
        assert part in capsys.readouterr().err
