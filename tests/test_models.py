"""The shipped robots: what their files say, and where it comes from."""

from fractions import Fraction
from pathlib import Path

import pytest
from robots_table import PAGES

from pkm_exact.geometry.kinds import KINDS
from pkm_exact.geometry.reader import read_robot
from pkm_exact.geometry.robot import Robot

MODELS = sorted((Path(__file__).parent.parent / "models").glob("*.toml"))


@pytest.fixture(params=MODELS, ids=lambda path: path.stem)
def robot(request: pytest.FixtureRequest) -> Robot:
    return read_robot(request.param)


def _model(name: str) -> Robot:
    return read_robot(Path(__file__).parent.parent / "models" / f"{name}.toml")


def test_five_robots_are_shipped() -> None:
    names = {path.stem for path in MODELS}
    assert names >= {"rolland-6-6", "dietmaier", "mourrain-l", "similar-planar-s", "robocrane-r"}


def test_every_robot_has_provenance_and_a_configuration(robot: Robot) -> None:
    assert len(robot.source) > 40
    assert robot.configurations
    if isinstance(robot, Robot):
        assert all(len(c.lengths_squared) == KINDS[robot.kind].legs for c in robot.configurations)
    else:
        assert all(len(c.values) == len(robot.actuated) for c in robot.configurations)


def test_robot_names_are_distinct() -> None:
    assert len({read_robot(path).name for path in MODELS}) == len(MODELS)


def test_rolland() -> None:
    robot = _model("rolland-6-6")
    assert robot.base_joints[2] == (Fraction("105.2905"), Fraction("-597.151"), Fraction("-178.741"))
    assert robot.platform_joints[5] == (Fraction("-68.228"), Fraction("393.62"), Fraction("236.4"))
    assert set(robot.configuration().lengths_squared) == {1250**2}


def test_dietmaier_lengths_are_not_squared_in_the_file() -> None:
    assert _model("dietmaier").configuration().lengths_squared[1] == Fraction("0.645275") ** 2


def test_similar_planar_lengths_come_from_the_pose() -> None:
    robot = _model("similar-planar-s")
    assert all(
        2 * b[i] == a[i] for a, b in zip(robot.base_joints, robot.platform_joints, strict=True) for i in range(3)
    )
    first = Fraction(1, 4) + Fraction(1, 9) + Fraction(49, 16)
    assert robot.configuration().lengths_squared[0] == first


def test_robocrane_triangles_are_equilateral_in_the_metric() -> None:
    robot = _model("robocrane-r")
    assert robot.metric == (1, 3, 1)
    for joints, side in ((robot.base_joints, 4), (robot.platform_joints, 2)):
        corners = sorted(set(joints))
        assert len(corners) == 3
        for i in range(3):
            d = [x - y for x, y in zip(corners[i], corners[i - 1], strict=True)]
            assert d[0] ** 2 + 3 * d[1] ** 2 + d[2] ** 2 == side**2


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_documents_say_what_models_and_kinds_say(page: Path) -> None:
    """If not: python tests/robots_table.py."""
    text = page.read_text(encoding="utf-8")
    assert PAGES[page](text) == text
