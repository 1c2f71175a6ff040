"""One row adds an index to every output; every row says what it is in each."""

import json
import sys
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from pkm_exact import Robot, solve_many
from pkm_exact.certify.build import certificate
from pkm_exact.cli.feasible_poses import ShownPoses
from pkm_exact.cli.report import as_object, as_rows
from pkm_exact.indices.index import EVERYWHERE, Index, Output
from pkm_exact.indices.pose_indices import INDICES, shown_in
from pkm_exact.interactive.answers import Solution
from pkm_exact.interactive.display import pose_cells, pose_header, solution_html
from pkm_exact.pictures.scene import scene_of
from pkm_exact.poses.arrays import arrays_of
from pkm_exact.report_page.rows import certified_rows
from pkm_exact.roots.interval import Interval
from pkm_exact.sweep.lengths import LengthRow
from pkm_exact.sweep.record import solution_line

THIRD = Interval(Fraction(1, 3), Fraction(1, 3))
MADE_UP = Index("made_up", "made up", "a third", lambda _: THIRD, lambda _: "a third", lambda _: 1 / 3)
COUNT = Index("count", "count", "seven", lambda _: 7, lambda _: "7", lambda _: 7, is_integer=True, undecided=-1)


@pytest.fixture(scope="module")
def robot() -> Robot:
    return Robot.load("models/3-rpr-merlet-p.toml")


@pytest.fixture(scope="module")
def solution(robot: Robot) -> Solution:
    return robot.solve()


def _table(solution: Solution, _: Robot) -> str:
    motion = solution.problem.motion
    return " ".join([*pose_header(motion), *pose_cells(1, solution.poses[0], motion)])


def _page(solution: Solution, robot: Robot) -> str:
    document = certificate(robot, "home", solution)
    rows = certified_rows(document, scene_of(document, robot))
    return " ".join(
        [*(c.title for c in rows.columns), *(c.text for c in rows.rows[0].cells), *rows.plain, *rows.rows[0].plain]
    )


def _sweep(solution: Solution, robot: Robot) -> str:
    return solution_line(LengthRow(1, 2, ("1", "1", "1")), robot, None, solution, b"").decode()


SHOWN: dict[Output, Callable[[Solution, Robot], str]] = {
    Output.TABLE: lambda solution, robot: _table(solution, robot) + solution_html(solution, robot, "home"),
    Output.JSON: lambda solution, robot: json.dumps(as_object(robot, "home", solution)),
    Output.CSV: lambda solution, robot: " ".join(
        field for row in as_rows(solution, ShownPoses.of(robot, "home", solution)) for field in row
    ),
    Output.PAGE: _page,
    Output.ARRAYS: lambda solution, _: f"{arrays_of(solution.poses).indices} {solution.to_frame().to_dict()}",
    Output.SWEEP: _sweep,
}
KEYS = {Output.TABLE: ("made up", "a third", "count"), Output.PAGE: ("made up", "a third", "made_up", "count", "7")}


@pytest.mark.parametrize("output", Output)
def test_one_row_adds_an_index_to_every_output(
    output: Output, solution: Solution, robot: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = SHOWN[output](solution, robot)
    for index in (MADE_UP, COUNT):
        monkeypatch.setattr("pkm_exact.indices.pose_indices.INDICES", [*INDICES, MADE_UP, COUNT])
        after = SHOWN[output](solution, robot)
        for key in KEYS.get(output, (index.name,)):
            assert key in after
            assert after.count(key) > before.count(key)


def test_rows_of_many_have_it_too(robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pkm_exact.indices.pose_indices.INDICES", [*INDICES, MADE_UP, COUNT])
    poses = solve_many(robot, [["12", "15", "12"]]).poses
    assert set(poses["count"]) <= {7}
    assert {"made_up", "condition", "det_sign"} < set(poses.dtype.names)


@pytest.mark.parametrize("index", INDICES, ids=lambda index: index.name)
def test_an_index_has_a_value_of_its_kind_and_words(index: Index, solution: Solution) -> None:
    assert index.outputs <= EVERYWHERE
    assert index.meaning
    for pose in solution:
        value = index.value(pose)
        assert isinstance(value, int if index.is_integer else Interval)
        number = index.number(pose)
        assert number is not None
        assert number == value if isinstance(value, int) else value.lo <= Fraction(number) <= value.hi
        assert index.text(pose) != "?"
        assert index.in_words(pose)
        assert len(index.fields(pose)) == len(index.columns)


@pytest.mark.parametrize("index", INDICES, ids=lambda index: index.name)
def test_an_index_says_where_nothing_is_certified(index: Index) -> None:
    class Unknown:
        det_sign = None
        jacobian = None

    assert index.exact(Unknown()) is None
    assert index.text(Unknown()) == "?"
    assert index.number(Unknown()) is None
    assert index.fields(Unknown()) == [""] * len(index.columns)
    assert (index.undecided is not None) == index.is_integer


def test_names_are_unique() -> None:
    for output in Output:
        names = [index.name for index in shown_in(output)]
        assert len(set(names)) == len(names)
    assert np.unique([index.heading for index in INDICES]).size == len(INDICES)


@pytest.mark.parametrize("index", [index for index in INDICES if not index.is_integer], ids=lambda index: index.name)
def test_an_index_beyond_all_doubles_is_a_number_and_not_infinite(index: Index, solution: Solution) -> None:
    beyond = Interval(Fraction(10**400), Fraction(10**400 + 1))
    assert solution.poses[0].jacobian is not None
    huge = replace(solution.poses[0].jacobian, sigma_min=beyond, condition=beyond)
    pose = replace(solution.poses[0], jacobian=huge)
    assert index.number(pose) == sys.float_info.max
    assert float(Interval(-beyond.hi, -beyond.lo)) == -sys.float_info.max
    assert "e+400" in index.text(pose) or index.text(pose).startswith("1000")
    with pytest.raises(OverflowError):
        beyond.ball()
