"""Model files are read exactly; every defect gives one sentence with file, field, value and remedy."""

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import distance_squared, rotation_of
from pkm_exact.geometry.model_writer import robot_text
from pkm_exact.geometry.reader import any_from_toml, read_robot, robot_from_toml
from pkm_exact.geometry.robot import Configuration, Robot

MODEL = """
schema = 1
name = "example"
kind = "6-UPS"
unit = "mm"
source = "made up"
metric = [1, 3, 1]

[base]
joints = [[0.1, 0, 0], ["2/3", 0, 0], [4, 0, 0], [2, 1.5, 0], [0, 3, 0], [0, 1e0, 0]]

[platform]
joints = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [1, 1, 0], [0, 2, 0], [0, 1, 0]]

[[configurations]]
name = "home"
lengths = [1, 2, 3, 4, 5, "1/2"]

[[configurations]]
name = "squares"
lengths_squared = [1, 2, 3, 4, 5, 0.25]

[[configurations]]
name = "posed"
pose = { position = [0, 0, 1], quaternion = [2, 0, 0, 0] }
"""


def test_a_model_is_read_exactly() -> None:
    robot = robot_from_toml(MODEL)
    assert robot.base_joints[0] == (Fraction(1, 10), 0, 0)
    assert robot.base_joints[1][0] == Fraction(2, 3)
    assert robot.metric == (1, 3, 1)
    assert [c.name for c in robot.configurations] == ["home", "squares", "posed"]
    assert robot.configuration("home").lengths_squared == (1, 4, 9, 16, 25, Fraction(1, 4))
    assert robot.configuration("squares").lengths_squared[5] == Fraction(1, 4)
    assert robot.configuration().name == "home"
    assert repr(robot) == "Robot('example', kind='6-UPS')"


def test_lengths_come_from_a_pose_in_the_metric() -> None:
    squares = robot_from_toml(MODEL).configuration("posed").lengths_squared
    assert squares[0] == Fraction(1, 100) + 1
    assert squares[3] == 1 + 3 * Fraction(1, 4) + 1
    assert squares[4] == 3 + 1


def test_a_problem_has_six_legs_in_order() -> None:
    robot = robot_from_toml(MODEL)
    problem = robot.problem(robot.configuration("squares").lengths_squared)
    assert [leg.length_squared for leg in problem.distances] == [1, 2, 3, 4, 5, Fraction(1, 4)]
    assert problem.distances[2].base == (4, 0, 0)
    assert problem.distances[2].platform == (2, 0, 0)
    assert problem.metric == (1, 3, 1)


def _without(line_start: str) -> str:
    return "\n".join(line for line in MODEL.split("\n") if not line.startswith(line_start))


BAD = {
    "bad toml": ("schema = = 1", "not valid TOML"),
    "empty": ("", "schema: is missing"),
    "schema": (MODEL.replace("schema = 1", "schema = 2"), "schema: 2 is unknown; write schema = 1"),
    "schema true": (MODEL.replace("schema = 1", "schema = true"), "schema: true is unknown"),
    "no source": (_without("source"), "source: is missing"),
    "no name": (_without('name = "example"'), "name: is missing"),
    "no base": (MODEL.replace("[base]", "[platform2]"), "unknown key 'platform2'; the known keys are: schema, name"),
    "empty source": (MODEL.replace('"made up"', '" "'), "source: ' ' is not a label"),
    "control": (MODEL.replace('"made up"', '"\\u001b[2J"'), "source: '\\x1b[2J' is not a label"),
    "number for text": (MODEL.replace('"made up"', "1.5"), "source: 1.5 is not text"),
    "kind": (MODEL.replace("6-UPS", "6-XYZ"), "kind: '6-XYZ' is unknown; use one of: 6-UPS"),
    "five legs": (MODEL.replace("[[0.1, 0, 0], ", "["), "base.joints: 5 rows; give 6"),
    "seven legs": (MODEL.replace("[[0, 0, 0],", "[[0, 0, 0], [9, 9, 9],"), "platform.joints: 7 rows; give 6"),
    "two numbers": (MODEL.replace("[2, 1.5, 0]", "[2, 1.5]"), "base.joints[4]: a list of 2; give a list of 3"),
    "unknown key": (MODEL.replace("[platform]", "[platform]\nlever = 1"), "the known keys are: joints, hexagon, tool"),
    "tool of the base": (MODEL.replace("[base]", "[base]\ntool = [0, 0, 0]"), "base: unknown key 'tool'"),
    "no angle": (
        MODEL.replace("[2, 1.5, 0]", "{ length = 2, angle = 3 }"),
        "base.joints[4]: is a table without degrees or elevation; give a list of 3 numbers, or a length and",
    ),
    "not a row": (MODEL.replace("[2, 1.5, 0]", "7"), "base.joints[4]: 7 is not a list"),
    "joints text": (MODEL.replace("[0.1, 0, 0]", '"0.1,0,0"'), "base.joints[1]: '0.1,0,0' is not a list"),
    "nan": (MODEL.replace("1.5", "nan"), "base.joints[4][2]: nan is not a finite number"),
    "inf": (MODEL.replace("1.5", "-inf"), "base.joints[4][2]: -inf is not a finite number"),
    "code": (MODEL.replace('"2/3"', '"__import__(1)"'), "base.joints[2][1]: '__import__(1)' is not a number"),
    "date": (MODEL.replace("1.5", "1979-05-27"), "base.joints[4][2]: 1979-05-27 is not a number"),
    "true": (MODEL.replace("1.5", "true"), "base.joints[4][2]: true is not a number"),
    "long": (MODEL.replace("1.5", "1" * 300), "base.joints[4][2]: 111111"),
    "million": (MODEL.replace("1.5", "1" * 10**6), "line 10 (joints): 11111111111111111111... (1000000 digits)"),
    "exponent": (MODEL.replace("1.5", "1e999999999"), "base.joints[4][2]: 1e999999999 is too long"),
    "hexadecimal": (MODEL.replace("1.5", "0x" + "f" * 9000), "base.joints[4][2]: an integer of 36000 bits is too long"),
    "negative length": (MODEL.replace("[1, 2, 3, 4, 5, ", "[1, 2, -3, 4, 5, ", 1), "lengths[3]: -3 is not positive"),
    "zero length": (MODEL.replace("5, 0.25]", "5, 0.0]"), "lengths_squared[6]: 0.0 is not positive"),
    "five lengths": (MODEL.replace(', "1/2"]', "]"), "configurations[1].lengths: 5 values; give 6"),
    "length list": (MODEL.replace('[1, 2, 3, 4, 5, "1/2"]', "4"), "configurations[1].lengths: 4 is not a list"),
    "both": (
        MODEL.replace("lengths_squared", "lengths = [1, 1, 1, 1, 1, 1]\nlengths_squared"),
        "configurations[2] ('squares'): lengths and lengths_squared given; give exactly one",
    ),
    "neither": (_without("lengths = "), "configurations[1] ('home'): none of them given; give exactly one"),
    "twice": (MODEL.replace('"squares"', '"home"'), "the name 'home' is used twice"),
    "no table": (
        MODEL[: MODEL.index("[[conf")].replace("[base]", "configurations = 3\n[base]"),
        "configurations: 3 is not",
    ),
    "key": (
        MODEL.replace("lengths = ", "length = "),
        "configurations[1]: unknown key 'length'; the known keys are",
    ),
    "metric 0": (MODEL.replace("[1, 3, 1]", "[1, 0, 1]"), "metric[2]: 0 is not a positive integer"),
    "metric 1/2": (MODEL.replace("[1, 3, 1]", '["1/2", 1, 1]'), "metric[1]: 1/2 is not a positive integer"),
    "metric 2": (MODEL.replace("[1, 3, 1]", "[1, 3]"), "metric: a list of 2"),
    "quaternion 0": (MODEL.replace("[2, 0, 0, 0]", "[0, 0, 0, 0]"), "pose.quaternion: all four numbers are 0"),
    "degrees in a metric": (
        MODEL.replace("quaternion = [2, 0, 0, 0]", "rpy_degrees = [0, 0, 30]"),
        "pose.rpy_degrees: angles in degrees are not rational in the metric [1, 3, 1]",
    ),
    "quaternion and degrees": (
        MODEL.replace("[2, 0, 0, 0]", "[1, 0, 0, 0], rpy_degrees = [0, 0, 0]"),
        "quaternion and rpy_degrees given",
    ),
    "quaternion 3": (MODEL.replace("[2, 0, 0, 0]", "[1, 0, 0]"), "pose.quaternion: 3 numbers; give 4"),
    "pose": (
        MODEL.replace("{ position = [0, 0, 1], quaternion = [2, 0, 0, 0] }", "1"),
        "configurations[3].pose: 1 is not",
    ),
    "same legs": (
        MODEL.replace("[4, 0, 0]", '["2/3", 0, 0]').replace("[2, 0, 0]", "[1, 0, 0]"),
        "legs 2 and 3 join the same two points",
    ),
    "nested": ("a = " + "[" * 50_000, "brackets are nested too deeply"),
    "dots": ("a." * 30_000 + "a = 1", "line 1: more than 200 dots in one line"),
    "large": ("# comment\n" * 7000, "the file has more than 65536 characters"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_defect_gives_one_sentence(name: str, tmp_path: Path) -> None:
    text, part = BAD[name]
    path = tmp_path / "robot.toml"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        read_robot(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: ")
    assert part in message
    assert message.isprintable()
    assert len(message) < len(str(path)) + 400
    assert caught.value.__suppress_context__


@pytest.mark.parametrize("yaw", [90, 30])
def test_a_pose_in_degrees_has_the_lengths_of_the_rotation_next_to_it(yaw: int) -> None:
    text = MODEL.replace("metric = [1, 3, 1]\n", "")
    degrees = text.replace("quaternion = [2, 0, 0, 0]", f"rpy_degrees = [0, 0, {yaw}]")
    found = robot_from_toml(degrees).configuration("posed").lengths_squared
    exact = rotation_of((Fraction(1), Fraction(0), Fraction(0), Fraction(1)))
    robot = robot_from_toml(text)
    joints = zip(robot.base_joints, robot.platform_joints, strict=True)
    place = (Fraction(0), Fraction(0), Fraction(1))
    if yaw == 90:
        assert found == tuple(distance_squared(a, b, place, exact) for a, b in joints)
        return
    c, s = 3**0.5 / 2, 0.5
    for square, (a, b) in zip(found, joints, strict=True):
        at = c * b[0] - s * b[1], s * b[0] + c * b[1], b[2] + 1
        assert float(square) == pytest.approx(sum((float(x) - y) ** 2 for x, y in zip(a, at, strict=True)), abs=1e-10)


def test_a_posed_leg_of_length_zero_is_refused() -> None:
    text = MODEL.replace("position = [0, 0, 1]", "position = [4, 0, 0]").replace("[4, 0, 0], [2", "[5, 0, 0], [2")
    with pytest.raises(InputError, match="leg 2 has length 0"):
        robot_from_toml(text.replace('"2/3"', "5"))


def test_unreadable_paths(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        read_robot(tmp_path / "none.toml")
    with pytest.raises(InputError, match="is a directory"):
        read_robot(tmp_path)
    with pytest.raises(InputError, match="cannot be read"):
        read_robot("a\0b")
    (tmp_path / "latin.toml").write_bytes(b'name = "\xe9"')
    with pytest.raises(InputError, match="byte 9 is not UTF-8 text; save"):
        read_robot(tmp_path / "latin.toml")


def test_windows_line_ends_are_read(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    path.write_bytes(MODEL.replace("\n", "\r\n").encode())
    assert read_robot(path) == robot_from_toml(MODEL)


def test_a_robot_may_have_no_configuration() -> None:
    robot = robot_from_toml(MODEL[: MODEL.index("[[configurations]]")])
    with pytest.raises(InputError, match="has none; give the six leg lengths"):
        robot.configuration()
    assert len(robot.problem([1] * 6).distances) == 6


def test_merged_joints_are_legal() -> None:
    robot = robot_from_toml(MODEL.replace("[4, 0, 0]", '["2/3", 0, 0]'))
    assert robot.base_joints[1] == robot.base_joints[2]


def test_an_unknown_configuration_lists_the_known_ones() -> None:
    with pytest.raises(InputError, match="'away' is unknown; use one of: home, squares, posed"):
        robot_from_toml(MODEL).configuration("away")


def test_constructors_refuse_floats() -> None:
    robot = robot_from_toml(MODEL)
    with pytest.raises(InputError, match="binary float"):
        robot.problem([1, 1, 1, 1, 1, 1.5])  # type: ignore[list-item]
    with pytest.raises(InputError, match="binary float"):
        Configuration("c", (0.5,) * 6)  # type: ignore[arg-type]
    with pytest.raises(InputError, match=r"base\.joints\[1\]\[1\]: 0.5 is a binary float"):
        Robot("r", "6-UPS", "m", "s", ((0.5, 0, 0),) * 6, robot.platform_joints)  # type: ignore[arg-type]


small = st.fractions(min_value=-3, max_value=3, max_denominator=5)
vectors = st.tuples(small, small, small)
metrics = st.tuples(*[st.integers(1, 5)] * 3)


@given(st.tuples(small, small, small, small).filter(any), metrics, vectors, vectors)
def test_rotations_keep_the_metric(
    quaternion: tuple[Fraction, Fraction, Fraction, Fraction], metric: tuple[int, int, int], a: tuple, b: tuple
) -> None:
    turn = rotation_of(quaternion, metric)
    for i in range(3):
        for j in range(3):
            product = sum(g * row[i] * row[j] for g, row in zip(metric, turn, strict=True))
            assert product == (metric[i] if i == j else 0)
    origin = (Fraction(0),) * 3
    square = sum(g * x * x for g, x in zip(metric, b, strict=True))
    assert distance_squared(origin, b, origin, turn, metric) == square
    scaled = tuple(7 * e for e in quaternion)
    assert distance_squared(a, b, a, turn, metric) == distance_squared(a, b, a, rotation_of(scaled, metric), metric)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.binary(max_size=200) | st.integers(0, len(MODEL)).map(lambda n: MODEL[:n].encode()))
def test_any_bytes_are_a_robot_or_an_input_error(data: bytes, tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    path.write_bytes(data)
    try:
        assert isinstance(read_robot(path), Robot)
    except InputError as error:
        assert str(error).isprintable()


tokens = st.sampled_from(
    ["1", "1.5", '"1/2"', "nan", "inf", "true", "[]", "{}", '"x"', "1e9999", "-1", "[[1]]", "'''a'''"]
)


@given(
    st.lists(tokens, min_size=3, max_size=3),
    st.sampled_from(["1.5", "[1, 3, 1]", "[base]", '"home"', "= 1\n", "[0, 0, 1]"]),
)
def test_any_value_in_any_place_is_read_or_refused(values: list[str], place: str) -> None:
    text = MODEL.replace(place, ", ".join(values) if place == "1.5" else f"[{', '.join(values)}]", 1)
    try:
        assert isinstance(robot_from_toml(text), Robot)
    except InputError as error:
        assert str(error).isprintable()


@pytest.mark.parametrize("name", ["3-rpr-merlet-p", "mourrain-l"])
def test_positions_are_those_of_the_tool_point(name: str) -> None:
    """Platform joints are relative to it; lengths, which do not depend on where a pose is read, stay."""
    path = Path(__file__).parent.parent / "models" / f"{name}.toml"
    robot = read_robot(path)
    size = 2 if robot.motion.is_planar else 3
    tool = (Fraction(1, 2), Fraction(-3), Fraction(2))[:size]
    words = ", ".join(f'"{x}"' for x in tool)
    text = path.read_text(encoding="utf-8").replace("[platform]\n", f"[platform]\ntool = [{words}]\n")
    moved = robot_from_toml(text)
    shifted = tuple(tuple(b - t for b, t in zip(joint, tool, strict=False)) for joint in robot.platform_joints)
    assert tuple(joint[:size] for joint in moved.platform_joints) == shifted
    assert moved.base_joints == robot.base_joints
    assert [c.lengths_squared for c in moved.configurations if c.name != "pose"] == [
        c.lengths_squared for c in robot.configurations if c.name != "pose"
    ]
    with pytest.raises(InputError, match=r"platform\.tool"):
        robot_from_toml(text.replace(f"tool = [{words}]", "tool = [1]"))
    with pytest.raises(InputError, match="tool"):
        robot_from_toml(text.replace(f"tool = [{words}]", "").replace("[base]\n", f"[base]\ntool = [{words}]\n"))


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ('{"format": 1}', "is JSON, as certificates"),
        ("{" + '"1234567890' * 10**6 + '"}', "is JSON, as certificates"),
        ("# a\nname: x\n", "is YAML"),
        ("\n<?xml version='1.0'?>", "is XML, it seems; `new --urdf`"),
        ("base_x,base_y\n1,2", "is a table of numbers, it seems; `new --csv`"),
        ("1.5;2", "is a table of numbers"),
        ("schema = 1, 2", "not valid TOML"),
    ],
)
def test_files_of_other_sorts_are_named(text: str, part: str) -> None:
    with pytest.raises(InputError, match=part):
        robot_from_toml(text)


def test_legs_may_be_cables() -> None:
    """They are written too; what has no legs of actuated length cannot have cables."""
    slack, taut = robot_from_toml(MODEL), robot_from_toml(MODEL.replace("[base]", "cables = true\n\n[base]", 1))
    assert (slack.cables, taut.cables) == (False, True)
    assert replace(taut, cables=False) == slack
    assert robot_from_toml(robot_text(taut)) == taut
    with pytest.raises(InputError, match=r"^cables: 1 is neither true nor false"):
        robot_from_toml(MODEL.replace("[base]", "cables = 1\n\n[base]", 1))


@pytest.mark.parametrize("name", ["hexa", "links/watt", "chains/sarrus"])
def test_what_has_no_legs_has_no_cables(name: str) -> None:
    text = (Path(__file__).parent.parent / "models" / f"{name}.toml").read_text(encoding="utf-8")
    with pytest.raises(InputError, match=r"has no legs that could be cables; take the line out"):
        any_from_toml(text.replace("schema = 1", "schema = 1\ncables = true", 1))
