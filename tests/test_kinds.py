"""Robots with cranks and slides: read exactly, reduced to their knees, refused with one sentence."""

from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import Crank, Slide, cosine_and_sine, parse_cosine_and_sine
from pkm_exact.geometry.inverse import dot
from pkm_exact.geometry.reader import read_robot, robot_from_toml
from pkm_exact.geometry.robot import Robot

MODELS = Path(__file__).parent.parent / "models"
HEXA = (MODELS / "hexa.toml").read_text()
GLIDE = (MODELS / "hexaglide.toml").read_text()

small = st.fractions(min_value=-4, max_value=4, max_denominator=7)


@given(small)
def test_a_half_tangent_gives_an_exact_point_of_the_circle(t: Fraction) -> None:
    c, s = cosine_and_sine(t)
    assert parse_cosine_and_sine((c, s), "x") == (c, s)
    assert s == t * (1 + c)


def test_knees_lie_on_the_cranks_circles() -> None:
    robot = read_robot(MODELS / "hexa.toml")
    for configuration in robot.configurations:
        for foot, knee in zip(robot.base_joints, robot.knees(configuration), strict=True):
            x, y, z = (k - a for k, a in zip(knee, foot, strict=True))
            assert dot((x, y, z), (x, y, z), robot.metric) == 300**2
    problem = robot.problem(robot.configuration("level"))
    assert problem.distances[0].base == (-105 - 180, Fraction(-2068, 6), -179 + 240)
    assert {leg.length_squared for leg in problem.distances} == {810000}


def test_half_tangents_and_cos_sin_mean_the_same() -> None:
    level = 'half_tangents = ["1/2", "1/2", "1/2", "1/2", "1/2", "1/2"]'
    text = HEXA[: HEXA.index("cos_sin")] + level
    assert robot_from_toml(text) == robot_from_toml(HEXA)


def test_slides_move_along_their_directions() -> None:
    robot = read_robot(MODELS / "linapod-n.toml")
    legs = robot.problem(robot.configuration()).distances
    assert legs[4].base == (Fraction("-0.755"), Fraction("-0.465"), Fraction("1.933"))
    assert legs[4].length_squared == Fraction("2.89")


def test_a_robot_with_knees_is_a_gough_platform() -> None:
    robot = read_robot(MODELS / "hexaglide.toml")
    home = robot.configuration()
    gough = robot.as_gough(home)
    assert gough.kind == "6-UPS"
    assert gough.problem(gough.configuration()) == robot.problem(home)
    assert gough.problem(home.lengths_squared) == robot.problem(home)
    assert gough.as_gough(None) is gough
    assert gough.source.endswith("the knees of the 6-PUS robot in configuration home are its base joints")
    with pytest.raises(InputError, match="has knees only in a configuration"):
        robot.as_gough(None)


BAD = {
    "crank angle": (HEXA.replace("[150, -150, 0]", "[150, -150, 1]"), "cranks, leg 3: at_0 and at_90 are not perpen"),
    "crank length": (
        HEXA.replace("[150, -150, 0]", "[150, 150, 0]", 1).replace("[0, 0, 300]", "[0, 0, 301]", 1),
        "leg 1",
    ),
    "crank zero": (HEXA.replace("300", "0").replace("150", "0"), "cranks, leg 1: the crank has length 0"),
    "five cranks": (HEXA.replace("    [0, 0, 300],\n", "", 1), "cranks.at_90: 5 rows; give 6 vectors"),
    "no cranks": (HEXA.replace("[cranks]", "[slides]"), "slides: a 6-RUS robot has none"),
    "cranks of a 6-UPS": (HEXA.replace("6-RUS", "6-UPS"), "cranks: a 6-UPS robot has none; remove the table"),
    "no rods": (HEXA.replace("[rods]\nlength = 900\n", ""), "rods: is missing; add it"),
    "rod": (HEXA.replace("length = 900", "length = -900"), "rods.length: -900 is not positive"),
    "rods twice": (HEXA.replace("length = 900", "length = 900\nlengths = []"), "rods: length and lengths given"),
    "lengths": (HEXA.replace("half_tangents", "lengths"), "configurations[1]: unknown key 'lengths'"),
    "circle": (HEXA.replace('"4/5"', '"3/5"', 1), "configurations[2].cos_sin[1]: the squares of cosine and sine sum"),
    "pair": (HEXA.replace('["3/5", "4/5"], ["3/5"', '"1", ["3/5"', 1), "cos_sin[1]: '1' is not a pair"),
    "tangent": (HEXA.replace('"1/10"', "inf"), "half_tangents[1]: inf is not a finite number"),
    "both": (
        HEXA.replace("cos_sin", "half_tangents = [0, 0, 0, 0, 0, 0]\ncos_sin"),
        "half_tangents and cos_sin given; give exactly one of half_tangents, cos_sin",
    ),
    "direction": (GLIDE.replace("direction = [1, 0, 0]", "direction = [0, 0, 0]"), "slides, leg 1: the direction is 0"),
    "directions": (GLIDE.replace("direction = [1, 0, 0]", ""), "slides: none of them given; give exactly one of"),
    "five slides": (GLIDE.replace(", -590]", "]"), "configurations[1].slides: 5 values; give 6, one per leg"),
    "no slides": (GLIDE.replace("slides = ", "# "), "configurations[1] ('home'): none of them given; give slides"),
    "same rods": (
        GLIDE.replace("-500, 520", "7, 7").replace("sides = [613, 137]", "sides = [0, 137]"),
        "configurations[1]: knees and platform.joints: legs 1 and 2 join the same two points",
    ),
    "sides": (GLIDE.replace("[613, 137]", "[613]"), "platform.hexagon.sides: 1 numbers; give 2"),
    "zero sides": (GLIDE.replace("[613, 137]", "[0, 0]"), "platform.hexagon.sides: both are 0"),
    "negative side": (GLIDE.replace("[613, 137]", "[613, -1]"), "platform.hexagon.sides[2]: -1 is negative"),
    "hexagon": (GLIDE.replace("{ sides = [613, 137], height = 236 }", "3"), "platform.hexagon: 3 is not a table"),
    "metric": (GLIDE.replace("[1, 3, 1]", "[1, 1, 1]"), "write metric = [1, 3, 1]"),
    "twice": (GLIDE.replace("hexagon =", "joints = []\nhexagon ="), "platform: joints and hexagon given"),
    "long knee": (
        GLIDE.replace("[1, 0, 0]", f'["1/{10**150 + 1}", 0, 0]')
        .replace("-500", f'"1/{10**190 + 3}"')
        .replace("[0, -340, 0],", f'["1/{10**190 + 9}", -340, 0],', 1),
        "the knee of leg 1",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_a_defect_gives_one_sentence(name: str) -> None:
    text, part = BAD[name]
    assert text not in (HEXA, GLIDE)
    with pytest.raises(InputError) as caught:
        robot_from_toml(text)
    message = str(caught.value)
    assert part in message
    assert message.isprintable()
    assert len(message) < 400


def test_joint_values_must_fit_the_kind() -> None:
    hexa, glide = robot_from_toml(HEXA), robot_from_toml(GLIDE)
    gough = read_robot(MODELS / "mssm.toml")
    with pytest.raises(InputError, match="rods of a 6-RUS robot have fixed lengths"):
        hexa.problem([1] * 6)
    with pytest.raises(InputError, match="0 joint values do not fit the kind 6-PUS"):
        glide.problem(gough.configuration())
    with pytest.raises(InputError, match="give a slide's position as one number"):
        glide.problem(hexa.configuration())
    with pytest.raises(InputError, match="give a crank's angle as cosine and sine"):
        hexa.problem(glide.configuration())
    with pytest.raises(InputError, match="locked by their lengths"):
        gough.lock("x", [1] * 6)
    with pytest.raises(InputError, match="5 given; give 6"):
        glide.lock("x", [1] * 5)
    with pytest.raises(InputError, match=r"joint values\[1\]: 0.5 is a binary float"):
        glide.lock("x", [0.5] * 6)


def test_chains_must_fit_the_kind() -> None:
    glide = robot_from_toml(GLIDE)
    rest = (glide.base_joints, glide.platform_joints, glide.metric, ())
    with pytest.raises(InputError, match=r"cranks\[1\]: does not belong to the kind 6-RUS"):
        Robot("r", "6-RUS", "m", "s", *rest, glide.chains)
    with pytest.raises(InputError, match="slides: 0 given; give 6"):
        Robot("r", "6-PUS", "m", "s", *rest)
    with pytest.raises(InputError, match="has neither cranks nor slides"):
        Robot("r", "6-UPS", "m", "s", *rest, glide.chains)
    with pytest.raises(InputError, match="binary float"):
        Slide((0.5, 0, 0), Fraction(1))  # type: ignore[arg-type]
    with pytest.raises(InputError, match="not positive"):
        Crank((1, 0, 0), (0, 1, 0), 0)  # type: ignore[arg-type]
