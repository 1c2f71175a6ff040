"""Bounds of indices and forces over regions: against statics at single poses, and published optima."""

from __future__ import annotations

import json
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from samples import MODELS, model
from test_regions import asked

from pkm_exact import InputError, Robot
from pkm_exact.cli.main import main
from pkm_exact.regions.chart import Chart, rational
from pkm_exact.regions.index_extremes import IndexRange, index_range
from pkm_exact.regions.index_quotients import speed_rows, weights_of
from pkm_exact.regions.question_reader import question_from_toml
from pkm_exact.regions.region_conditions import Conditions, asked_of, placed_legs
from pkm_exact.regions.region_legs import RegionMachine, region_machine
from pkm_exact.regions.region_points import PointJudge

FILES = {path.stem: path for path in MODELS}
ZERO, ONE = Fraction(0), Fraction(1)
POSE = {"half_tangent": "-1/14"}
POINTS = {
    "3-rpr-merlet-p": (Fraction(5), Fraction(9, 2)),
    "3-prr": (Fraction(31, 5), Fraction(19, 5)),
    "3-rrr": (Fraction(31, 5), Fraction(-19, 5)),
}
NAMES = ["3-rpr-merlet-p", pytest.param("3-prr", marks=pytest.mark.slow)]


def fails(machine: RegionMachine, place: tuple[Fraction, Fraction], conditions: Conditions) -> bool:
    """Whether a condition fails for certain at a pose of a planar robot, turned by a half tangent of -1/14."""
    chart = Chart(("x", place[1], ZERO), (ONE, ZERO, ZERO, Fraction(-1, 14)), (), ("x",), ((place[0], place[0] + 1),))
    question = asked_of(machine, chart, conditions)
    return PointJudge(question, question.formula).failing((place[0],)) is not None


def at_all_modes(name: str) -> list[Any]:
    """What statics has at the pose, in every working mode."""
    robot = Robot.load(FILES[name])
    modes = [""] if name == "3-rpr-merlet-p" else ["".join(signs) for signs in product("+-", repeat=3)]
    pose = POSE | {"position": list(POINTS[name])}
    return [robot.at(pose, modes=mode) if mode else robot.at(pose) for mode in modes]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("index", ["transmission", "manipulability"])
def test_indices_are_those_of_statics(name: str, index: str) -> None:
    """Of every working mode the bound just below the value holds, and that just above it fails."""
    machine = region_machine(model(name))
    found = sorted(Fraction(at.indices(length=3, speeds=1)[index].midpoint) for at in at_all_modes(name))
    signs = [(0, 0, 0)] if len(found) == 1 else list(product((1, -1), repeat=3))

    def above(bound: Fraction) -> int:
        conditions = (Conditions((), modes, ((index, bound),), Fraction(3)) for modes in signs)
        return sum(not fails(machine, POINTS[name], found) for found in conditions)

    near = Fraction(1, 10**9)
    for value in found:
        higher = sum(other > value * (1 + near) for other in found)
        same = sum(abs(other - value) <= value * near for other in found)
        assert above(value * (1 + near)) == higher
        assert above(value * (1 - near)) == higher + same


@pytest.mark.parametrize("name", NAMES)
def test_forces_are_those_that_bear_the_load(name: str) -> None:
    """The greatest of the forces that solve J^T s = w, in every working mode."""
    machine, load = region_machine(model(name)), (Fraction(3), Fraction(-7), Fraction(2))
    found = []
    for at in at_all_modes(name):
        forces = np.linalg.solve(at.jacobian.to_numpy().T, np.array(load, dtype=float))
        found.append(Fraction(float(np.abs(forces).max())))
    signs = [(0, 0, 0)] if len(found) == 1 else list(product((1, -1), repeat=3))

    def borne(most: Fraction) -> int:
        conditions = (Conditions((), modes, load=load, most_force=most) for modes in signs)
        return sum(not fails(machine, POINTS[name], found) for found in conditions)

    near = Fraction(1, 10**7)
    for value in found:
        assert borne(value * (1 - near)) == sum(other < value * (1 - near) for other in found)
        assert borne(value * (1 + near)) == sum(other < value * (1 + near) for other in found)


@pytest.mark.parametrize("name", ["3-prr", "3-rrr"])
def test_rows_of_slides_and_cranks_are_those_of_the_jacobian(name: str) -> None:
    """|r_i| / sqrt(c_i) in ordinary coordinates, in two working modes."""
    machine = region_machine(model(name))
    x, y = POINTS[name]
    chart = Chart(("x", y, ZERO), (ONE, ZERO, ZERO, Fraction(-1, 14)), (), ("x",), ((x, x + 1),))
    weights = [float(w) ** 0.5 for w in weights_of(machine, ONE, range(3))]
    found = {}
    for modes in ((1, 1, 1), (-1, -1, -1)):
        pose, placed = placed_legs(machine, chart, Conditions((), modes))
        rows = []
        for leg, part in zip(placed, speed_rows(machine, pose, placed), strict=True):
            assert leg.root is not None
            root = float(number(leg.root(rational(x), 0, 0, 0))) ** 0.5
            at = [rational(x), *(rational(Fraction(root) if leg.place == 1 + k else ZERO) for k in range(3))]
            square = float(number(part.square(*at))) ** 0.5
            rows.append([abs(float(number(e(*at)))) * w / square for e, w in zip(part.row, weights, strict=True)])
        found[modes] = np.array(rows)
    whole = [np.abs(at.jacobian.to_numpy()) for at in at_all_modes(name)]
    for rows in found.values():
        assert min(np.abs(rows - other).max() for other in (whole[0], whole[-1])) < 1e-9
    assert np.abs(found[1, 1, 1] - found[-1, -1, -1]).max() > 1e-3


def number(value: Any) -> Fraction:
    """A rational of FLINT's."""
    return Fraction(int(value.p), int(value.q))


def transmission(name: str, region: str, conditions: str = "", answer: str = "") -> IndexRange:
    text = f"[region]\n{region}\n[conditions]\nreachable = true\n{conditions}\n[answer]\nkind = 'extremes'\n"
    machine = region_machine(model(name))
    return index_range(machine, question_from_toml(f"{text}of = 'transmission'\n{answer}\n", machine))


def test_where_the_bipod_transmits_best() -> None:
    """Stan, Maties and Balan: legs of 1/sqrt(2) of the base, where the index is 1; at a height of 1 it is 60 / 901."""
    found = transmission("bipod", "position = [30, [1, 100], 0]", answer="precision = '1/100000'")
    assert found.is_precise
    assert found.greatest.lo < 1 < found.greatest.hi < found.greatest.lo + Fraction(1, 10**4)
    ((low, high),) = found.greatest_at
    assert low < 30 < high < low + 1
    assert found.least.lo < Fraction(60, 901) < found.least.hi < found.least.lo + Fraction(1, 10**5)


def test_the_biglide_does_not_mind_its_height() -> None:
    """Chapter 14: T = 2 |k1 - k2| / (k1^2 + k2^2 + 2), independent of y; at x = 0, k = 4 / 3."""
    found = transmission("biglide", "position = [['-1/8', '1/8'], 5, 0]", "working_modes = ['-', '-']")
    assert found.greatest.lo <= Fraction(24, 25) <= found.greatest.hi < found.greatest.lo + Fraction(1, 100)


def test_a_map_of_where_an_index_is_good_and_the_load_is_borne() -> None:
    machine = region_machine(model("bipod"))
    region = "position = [[0, 60], [10, 70], 0]"
    whole = asked(machine, region, "indices = { transmission = 0.8 }", "kind = 'map'\nsteps = 12")
    assert whole.counts["inside"]
    assert whole.counts["outside"]
    assert whole.measures is not None
    count = 0
    for k in range(200):
        for j in range(200):
            x, y = 60 * (k + 0.5) / 200, 10 + 60 * (j + 0.5) / 200
            count += 60 * y / np.hypot(x, y) / np.hypot(60 - x, y) > 0.8
    assert float(whole.measures[0]) < count * 0.09 < float(whole.measures[1])
    load = "forces = { load = [0, -10, 0], most = 6 }"
    answer = asked(machine, "position = [[25, 35], [20, 60], 0]", load)
    assert answer.counterexample is not None
    assert asked(machine, "position = [[25, 35], [40, 60], 0]", load.replace("6 }", "8 }")).is_proved


def test_what_has_no_meaning_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    planar, square = region_machine(model("3-rpr-merlet-p")), "position = [[4, 6], [4, 6]]\ndegrees = 0"
    jointed, angles = region_machine(model("2-ups-u")), "position = [0, 0, 0]\nrpy_degrees = [[-9, 9], [-9, 9], 0]"
    for machine, region, conditions, said in (
        (planar, square, "indices = { transmission = 0.5 }", "conditions.length"),
        (planar, square, "indices = { beauty = 1 }", "beauty"),
        (planar, square, "indices = 3", "is not a table"),
        (planar, square, "forces = { load = [0, 0, 0], most = 1 }", "load: is 0"),
        (planar, square, "forces = { load = [1, 0], most = 1 }", "give 3"),
        (planar, square, "forces = { load = [1, 0, 0] }", "most: is missing"),
        (jointed, angles, "indices = { transmission = 0.5 }\nlength = 1", "fix coordinates"),
    ):
        with pytest.raises(InputError, match=said):
            asked(machine, region, conditions)
    question = tmp_path / "question.toml"
    lines = f"[region]\n{square}\n[conditions]\nlength = 3\nindices = {{ transmission = 0.01 }}\n[answer]\n"
    question.write_text(f"{lines}kind = 'all'\n")
    path = str(FILES["3-rpr-merlet-p"])
    assert main(["region", path, str(question)]) == 0
    assert "transmission > 0.01 in a region" in capsys.readouterr().out
    assert main(["region", path, str(question), "-o", str(tmp_path / "a.json")]) == 2
    assert "no word for bounds of indices" in capsys.readouterr().err
    assert not list(tmp_path.glob("a.json*"))


def test_a_picture_that_cannot_be_drawn_is_refused_before_the_work(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def never(*_: object, **__: object) -> None:
        pytest.fail("the region was looked at")

    pytest.importorskip("matplotlib")
    monkeypatch.setattr("pkm_exact.regions.region_solver.answered", never)
    question = tmp_path / "question.toml"
    lines = "[region]\nposition = [[0, 1], [0, 1], [700, 800]]\nrpy_degrees = [0, 0, [0, 1]]\n[conditions]\n"
    question.write_text(f"{lines}no_type_2 = true\n[answer]\nkind = 'map'\n")
    command = ["region", str(FILES["rolland-6-6"]), str(question), "--picture"]
    assert main([*command, str(tmp_path / "a.png")]) == 2
    assert "more than three variables are not drawn" in capsys.readouterr().err
    assert main([*command, str(tmp_path / "a.gif")]) == 2
    assert "no known format of pictures" in capsys.readouterr().err


def test_a_certificate_that_cannot_be_written_is_refused_before_the_work(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def never(*_: object, **__: object) -> None:
        pytest.fail("the region was looked at")

    monkeypatch.setattr("pkm_exact.regions.region_solver.answered", never)
    question = tmp_path / "question.toml"
    lines = "[region]\nposition = [[4, 6], [4, 6]]\ndegrees = 0\n[conditions]\nlength = 3\n"
    question.write_text(f"{lines}indices = {{ transmission = 0.01 }}\n[answer]\nkind = 'all'\n")
    assert main(["region", str(FILES["3-rpr-merlet-p"]), str(question), "-o", str(tmp_path / "a.json")]) == 2
    assert "no word for bounds of indices" in capsys.readouterr().err


def test_the_command_has_extremes_of_indices(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    question = tmp_path / "question.toml"
    lines = "[region]\nposition = [30, [1, 100], 0]\n[conditions]\nreachable = true\n[answer]\nkind = 'extremes'\n"
    question.write_text(f"{lines}of = 'manipulability'\n")
    assert main(["region", str(FILES["bipod"]), str(question)]) == 0
    assert "where y is between" in capsys.readouterr().out
    assert main(["region", str(FILES["bipod"]), str(question), "--format", "json"]) == 0
    content = json.loads(capsys.readouterr().out)
    assert content["of"] == "manipulability"
    assert Fraction(content["greatest"][0]) < 1 < Fraction(content["greatest"][1])
