"""Multiplicities that are too large are rejected: every element must be 0 in the algebra that tells them."""

import json
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Final

import pytest
from certificate_tools import both, both_resealed, last_line
from flint import fmpz_poly
from forged_multiplicities import Content, Pose, Vector, forged, honest

from pkm_exact import solve
from pkm_exact.certify import pure
from pkm_exact.certify.build import certificate_bytes
from pkm_exact.certify.checker import claims, traceform
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.geometry.robot import Robot

CASES = Path(__file__).parent / "cases"

HALF: Final = ((-1, 0, 0), (0, -1, 0), (0, 0, 1))
LEFT: Final = ((0, -1, 0), (1, 0, 0), (0, 0, 1))
RIGHT: Final = ((0, 1, 0), (-1, 0, 0), (0, 0, 1))
CYCLE: Final = ((0, 0, 1), (1, 0, 0), (0, 1, 0))


@dataclass(frozen=True)
class Variant:
    """A robot, the pose that is made multiple, along which direction and by which products; counts, true and false."""

    base: tuple[Vector, ...]
    platform: tuple[Vector, ...]
    pose: Pose
    direction: dict[str, str]
    degree: int
    distinct: int
    total: int
    claimed: int
    multiplicities: tuple[int, ...]


SPATIAL: Final = Variant(
    ((2, -1, -2), (2, 0, 0), (0, 0, -2)) * 2,
    (*[(-1, 0, 0)] * 3, (0, 1, -1), (-1, -1, -1), (0, 1, -1)),
    (CYCLE, (0, -2, 0)),
    {"c3": "-1/8", "s": "1"},
    3,
    distinct=8,
    total=8,
    claimed=9,
    multiplicities=(1, 1, 1, 2, 1, 1, 1, 1),
)
VARIANTS: Final = {
    "planar, a simple pose as double": Variant(
        ((-2, 2, 0), (-1, 2, 0), (-1, 2, 0)),
        ((-2, 2, 0), (-2, 2, 0), (-1, 2, 0)),
        (HALF, (1, 0, 0)),
        {"c2": "1/8", "s": "1"},
        3,
        distinct=4,
        total=4,
        claimed=5,
        multiplicities=(2, 1, 1, 1),
    ),
    "planar, two simple poses as double": Variant(
        ((2, -2, 0), (2, 0, 0), (1, -1, 0)),
        ((-1, 1, 0), (1, 1, 0), (0, 2, 0)),
        (HALF, (-2, 2, 0)),
        {"c2": "3", "s": "-6", "r12": "-1", "r21": "1"},
        3,
        distinct=4,
        total=4,
        claimed=6,
        multiplicities=(2, 2),
    ),
    "planar, a simple pose as double beside one that is": Variant(
        ((-2, 1, 0), (1, 1, 0), (-1, 0, 0)),
        ((1, 1, 0), (1, 1, 0), (2, 0, 0)),
        (RIGHT, (1, 0, 0)),
        {"c2": "1/4", "s": "1"},
        4,
        distinct=3,
        total=4,
        claimed=5,
        multiplicities=(2, 2, 1),
    ),
    "spatial, a simple pose as double": SPATIAL,
}
NAMES = [pytest.param(name, marks=pytest.mark.slow if variant is SPATIAL else ()) for name, variant in VARIANTS.items()]


@cache
def _true(name: str) -> Content:
    variant = VARIANTS[name]
    kind = "3-RPR" if len(variant.base) == 3 else "6-UPS"
    return honest(kind, variant.base, variant.platform, variant.pose)


@cache
def _false(name: str) -> Content:
    variant = VARIANTS[name]
    direction = {coordinate: Fraction(value) for coordinate, value in variant.direction.items()}
    return forged(_true(name), variant.pose, direction, variant.degree, variant.multiplicities)


def _is_simple(name: str) -> bool:
    return VARIANTS[name].distinct == VARIANTS[name].total


def _no_evaluation(patch: pytest.MonkeyPatch) -> None:
    for module in (traceform, pure):
        patch.setattr(module.Algebra, "vanish", lambda _algebra, _elements: True)


def _no_word_of_simple_poses(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(pure, "are_simple", lambda *_: False)
    patch.setattr(claims, "dependent_factors", lambda *_: (fmpz_poly([1]),))  # as if there were one, which has no root


@pytest.mark.parametrize("name", NAMES)
def test_a_multiplicity_that_is_too_large_is_rejected(name: str) -> None:
    variant = VARIANTS[name]
    true, false = _true(name), _false(name)
    assert (true["distinct_solutions"], true["complex_solutions"]) == (variant.distinct, variant.total)
    assert false["complex_solutions"] == variant.claimed
    assert both_resealed(true).status == "accepted"
    answer = both_resealed(false)
    reason = (
        f"but the {variant.total} solutions are proved simple" if _is_simple(name) else "the solutions are not proved"
    )
    assert (answer.status, reason in last_line(answer)) == ("rejected", True), last_line(answer)


@pytest.mark.parametrize("name", NAMES)
def test_nothing_else_rejects_it(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each of the two checks does alone, where it applies; without them the certificate would be accepted."""
    _no_evaluation(monkeypatch)
    assert (both_resealed(_false(name)).status == "rejected") == _is_simple(name)
    _no_word_of_simple_poses(monkeypatch)
    assert both_resealed(_false(name)).status == "accepted"


@pytest.mark.parametrize("name", NAMES)
def test_the_evaluation_alone_rejects_it(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    _no_word_of_simple_poses(monkeypatch)
    answer = both_resealed(_false(name))
    assert (answer.status, "are not proved to fill them" in last_line(answer)) == ("rejected", True), last_line(answer)
    assert both_resealed(_true(name)).status == "accepted"


def test_the_spatial_one_by_another_hand_is_rejected() -> None:
    assert both((CASES / "honest_spatial.json").read_bytes()).status == "accepted"
    answer = both((CASES / "forged_spatial.json").read_bytes())
    assert (answer.status, "8 solutions are proved simple" in last_line(answer)) == ("rejected", True)


IN_LINE: Final = """
schema = 1
name = "3-RPR in line with two double poses, sqrt(2) above and below the base"
kind = "3-RPR"
unit = "1"
source = "made for this test: the leg lines meet in (1, -sqrt(2)), mirrored in (1, sqrt(2))"

[base]
joints = [["1/2", 0], [1, 0], ["7/6", 0]]

[platform]
joints = [[0, 0], [3, 0], [6, 0]]

[[configurations]]
name = "double"
lengths_squared = ["9/4", 18, "1825/36"]
"""


@cache
def _in_line() -> Content:
    robot = robot_from_toml(IN_LINE)
    assert isinstance(robot, Robot)
    solution = solve(robot.problem(robot.configuration()))
    content: Content = json.loads(certificate_bytes(robot, "double", solution))
    return content


@pytest.mark.parametrize(
    ("multiplicities", "status"), [((2, 2), "accepted"), ((1, 2), "rejected"), ((2, 1), "rejected")]
)
def test_double_poses_whose_parameters_are_irrational(multiplicities: tuple[int, ...], status: str) -> None:
    poses = [{**pose, "multiplicity": m} for pose, m in zip(_in_line()["poses"], multiplicities, strict=True)]
    assert all(pose["parameter"][0] != pose["parameter"][1] for pose in poses)
    assert both_resealed({**_in_line(), "poses": poses}).status == status
