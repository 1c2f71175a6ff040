"""Geometry in degrees: exact where that is possible, otherwise exact numbers next to it that the answer names."""

import json
import math
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact.cli.main import main
from pkm_exact.errors import InputError
from pkm_exact.geometry.angle_degrees import StandIn
from pkm_exact.geometry.inverse import dot
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.polar_vectors import PolarVector
from pkm_exact.geometry.reader import any_from_toml, robot_from_toml
from pkm_exact.geometry.robot import Robot

Capture = pytest.CaptureFixture[str]
METRICS = [(1, 1, 1), (1, 3, 1), (4, 2, 7)]
HEAD = """
schema = 1
name = "turned"
unit = "mm"
source = "a test"
"""
PLANAR = f"""{HEAD}
kind = "3-RRR"
metric = METRIC
[base]
joints = [[0, 0], [10, 0], {{ length = 10, degrees = 60 }}]
[cranks]
at_0 = [{{ length = 4, degrees = 0 }}, [4, 0], [4, 0]]
at_90 = [[0, 4], [0, 4], [0, 4]]
[platform]
joints = [[0, 0], [3, 0], [1, 2]]
[rods]
length = 9
[[configurations]]
name = "home"
degrees = [90, 37, -45]
"""
WRIST = f"""{HEAD}
kind = "constraints"
motion = "spherical"
[[constraints]]
name = "link"
type = "angle"
base = [3, 0, 4]
platform = {{ length = 2, degrees = 90, elevation = 90 }}
product = {{ degrees = 60 }}
"""


@given(st.integers(-360, 360), st.integers(-360, 360), st.sampled_from(METRICS), st.integers(1, 9))
def test_a_vector_has_its_length_exactly_and_its_angles_nearly(
    degrees: int, elevation: int, metric: tuple[int, int, int], length: int
) -> None:
    table = {"degrees": degrees, "elevation": elevation, "length": length, "z": 2}
    written = PolarVector(table, "here", metric)
    x, y, z = written.numbers(3)
    assert dot((x, y, z - 2), (x, y, z - 2), metric) == length**2
    a, e = math.radians(degrees), math.radians(elevation)
    meant = math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)
    found = [float(v) * math.sqrt(g) / length for v, g in zip((x, y, z - 2), metric, strict=True)]
    assert found == pytest.approx(meant, abs=1e-12)
    assert all(stand_in.off < Fraction(1, 10**12) for stand_in in written.stand_ins.values())


@pytest.mark.parametrize(
    ("degrees", "metric", "exact"), [(60, (1, 3, 1), True), (60, (1, 1, 1), False), (-90, (1, 1, 1), True)]
)
def test_what_is_exact_needs_no_stand_in(degrees: int, metric: tuple[int, int, int], exact: bool) -> None:
    written = PolarVector({"degrees": degrees}, "here", metric)
    written.numbers(2)
    assert (not written.stand_ins) == exact
    strict = PolarVector({"degrees": degrees, "exact": True}, "here", metric)
    if exact:
        assert strict.numbers(2) == written.numbers(2)
    else:
        with pytest.raises(InputError, match=r"here\.degrees: cosine and sine of 60 degrees are not both rational"):
            strict.numbers(2)


def test_the_answer_names_what_stands_in_for_what(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "turned.toml"
    path.write_text(PLANAR.replace("METRIC", "[1, 1]"))
    assert main(["solve", str(path), "--format", "json"]) == 0
    out = capsys.readouterr()
    notes = " ".join(json.loads(out.out)["notes"])
    assert "4 angles" not in notes
    for name, degrees in (("base.joints[3].degrees", 60), ("leg 2", 37), ("leg 3", -45)):
        assert f"{name} was given as {degrees} degrees" in notes
    assert "leg 1 was given" not in notes
    assert "exact angles next to those in degrees are taken" in out.err


def test_a_robot_in_degrees_is_exact_in_its_metric() -> None:
    robot = robot_from_toml(PLANAR.replace("metric = METRIC", "").replace("60 }", "180 }"))
    assert isinstance(robot, Robot)
    assert robot.stand_ins == ()
    assert [found.name for found in robot.configuration().stand_ins] == ["leg 2", "leg 3"]
    assert robot.configuration().joint_values[0] == (0, 1)
    gough = robot.as_gough(robot.configuration())
    assert gough.configuration().stand_ins == robot.configuration().stand_ins
    with pytest.raises(InputError, match=r"configurations\[1\]\.degrees\[2\]: cosine and sine of 37 degrees"):
        robot_from_toml(PLANAR.replace("metric = METRIC", "").replace("-45]", "-45]\nexact = true"))


def test_a_product_may_be_an_angle() -> None:
    wrist = robot_from_toml(WRIST)
    assert isinstance(wrist, Mechanism)
    assert wrist.stand_ins == ()
    (link,) = wrist.constraints
    assert getattr(link, "product") == 5  # noqa: B009 - the length 5, the length 2, the cosine 1/2
    turned = robot_from_toml(WRIST.replace("60 }", "50 }"))
    assert isinstance(turned, Mechanism)
    assert [found.name for found in turned.stand_ins] == ["constraints[1].product.degrees"]
    assert float(getattr(turned.constraints[0], "product")) == pytest.approx(10 * math.cos(math.radians(50)), abs=1e-12)  # noqa: B009
    with pytest.raises(InputError, match="have no rational product"):
        robot_from_toml(WRIST.replace("[3, 0, 4]", "[3, 1, 4]"))


MACHINES = {
    "direction": (
        "linear-delta",
        "[dimensions]\nbase_radius = 150\nplatform_radius = 40\nrod = 250\ndirection = { degrees = 45 }",
        "slides = [0, 10, 20]",
        "dimensions.direction.degrees",
    ),
    "heading": (
        "carriage-hexapod",
        (
            "[dimensions]\nbase = [[6, 0, 0], [0, 5, 1], [-5, 1, 0], [1, -6, 0], [4, 4, 0], [-3, 5, -1]]\n"
            "platform = [[3, 1, 0], [1, 3, 1], [-2, 1, 0], [0, -3, 1], [2, 2, -1], [-1, 2, 0]]\n"
            "reach = 2\narm = 5\nheading = { degrees = 30 }"
        ),
        "lengths = [9, 9, 9, 9, 9, 9]\nslides = [1, 2]\nhalf_tangents = [1]",
        "dimensions.heading.degrees",
    ),
    "products": (
        "spherical-3-RRR",
        (
            "[dimensions]\naxes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\nlinks = [[0, 3, 4], [4, 0, 3], [3, 4, 0]]\n"
            "platform = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]\n"
            "products = [{ degrees = 60 }, { degrees = 90 }, { degrees = 80 }]"
        ),
        "half_tangents = [0, 0, 0]",
        "dimensions.products[3].degrees",
    ),
}


@pytest.mark.parametrize("name", MACHINES)
def test_machines_have_dimensions_in_degrees(name: str) -> None:
    kind, dimensions, values, place = MACHINES[name]
    robot = robot_from_toml(f'{HEAD}kind = "{kind}"\n{dimensions}\n[[configurations]]\nname = "home"\n{values}\n')
    assert isinstance(robot, Mechanism)
    assert [found.name for found in robot.stand_ins if isinstance(found, StandIn)] == [place]


CHAIN = f"""{HEAD}
kind = "chains"
[[bodies]]
name = "frame"
[[bodies]]
name = "arm"
[[joints]]
name = "hinge"
type = "R"
bodies = ["frame", "arm"]
point = [0, 0, 0]
axis = {{ degrees = 45 }}
"""
BAD = {
    "typo": (PLANAR.replace("length = 10,", "lenght = 10,"), "base.joints[3]: unknown key 'lenght'"),
    "in the plane": (PLANAR.replace("length = 10,", "elevation = 10,"), "base.joints[3]: unknown key 'elevation'"),
    "range": (PLANAR.replace("degrees = 60", "degrees = 400"), "base.joints[3].degrees: 400 is out of range"),
    "no number": (PLANAR.replace("degrees = 60", 'degrees = "pi"'), "base.joints[3].degrees: pi is not a number"),
    "length": (PLANAR.replace("length = 10,", "length = 0,"), "base.joints[3].length: 0 is not positive"),
    "truth": (PLANAR.replace("length = 10,", "exact = 1,"), "base.joints[3].exact: 1 is neither true nor false"),
    "metric": (PLANAR.replace("METRIC", "[2, 2]"), "cranks.at_0[1]: in a metric whose first number is no square"),
    "place": (PLANAR.replace("length = 9", "length = { degrees = 9 }"), "rods.length: "),
    "chains": (CHAIN, "joints[1].axis.degrees: cosine and sine of 45 degrees are not both rational"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_defect_gives_one_sentence(name: str) -> None:
    text, part = BAD[name]
    with pytest.raises(InputError) as caught:
        any_from_toml(text.replace("METRIC", "[1, 1]"))
    assert part in str(caught.value)
    assert str(caught.value).isprintable()
