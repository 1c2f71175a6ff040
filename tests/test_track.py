"""Following a branch along a joint path: against solve and small numeric steps, at singularities, interrupted."""

from __future__ import annotations

import csv
import json
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from math import atan2, degrees, radians, tan
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from flint import arb, arb_mat, ctx
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st
from samples import MODELS
from tolerance_tools import poses_near, robots_with

from pkm_exact import InputError, read_robot
from pkm_exact.claim import Claim
from pkm_exact.cli import track as track_command
from pkm_exact.cli.main import main
from pkm_exact.cli.track_store import TrackStore
from pkm_exact.geometry.path_reader import path_from_csv, read_path
from pkm_exact.geometry.robot import Robot
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.numeric.centred import centred_frames, centred_robot
from pkm_exact.numeric.path_forms import JointRow, has_cranks, path_forms, problem_at
from pkm_exact.numeric.tracked_branch import TrackedSample, TrackingStopped, TrackPolicy
from pkm_exact.numeric.trajectory import track_branch
from pkm_exact.numeric.tube import FloatPath, predict, prove, station
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.poses.pose import Pose
from pkm_exact.solution import Solution

Capture = pytest.CaptureFixture[str]
FILES = {path.stem: path for path in MODELS}
HOMES = {
    "rolland-6-6": (Fraction(1250),) * 6,
    "mourrain-l": (Fraction(1), Fraction(1), Fraction(4, 5), Fraction(2), Fraction(2), Fraction(2)),
    "3-rpr-merlet-p": (Fraction(71, 10), Fraction(51, 10), Fraction(5)),
}


@cache
def robot(name: str) -> Robot:
    return read_robot(FILES[name])


def home(name: str) -> JointRow:
    """Joint values at which the robot has poses."""
    if name in HOMES:
        return HOMES[name]
    values = robot(name).configuration().joint_values
    return tuple(
        s / (1 + c) if isinstance(v, tuple) else v for v in values for c, s in [v if isinstance(v, tuple) else (v, v)]
    )


def walk(name: str, count: int, size: Fraction, seed: int = 1) -> list[JointRow]:
    """A random path from home; rows differ by about ``size``."""
    random = Random(seed)
    rows = [home(name)]
    for _ in range(count):
        rows.append(tuple(value + size * Fraction(random.randint(-10, 10), 10) for value in rows[-1]))
    return rows


@cache
def solved_at(name: str, row: JointRow) -> Solution:
    return solve_krawczyk(problem_at(robot(name), row))


def tracked(name: str, rows: Sequence[JointRow], number: int, **options: Any) -> list[TrackedSample]:
    poses = solved_at(name, rows[0]).poses
    return list(track_branch(robot(name), rows, poses[number - 1], poses=poses, **options))


def tracked_until_it_ends(name: str, rows: Sequence[JointRow], number: int) -> TrackingStopped | None:
    try:
        tracked(name, rows, number)
    except TrackingStopped as stop:
        return stop
    return None


def box(pose: Pose) -> tuple[Any, ...]:
    return pose.position, pose.rotation


CASES = [
    ("rolland-6-6", Fraction(5), 10),
    ("3-rpr-merlet-p", Fraction(1, 10), 1),
    ("hexa", Fraction(1, 100), 1),
    ("linapod-n", Fraction(1, 100), 1),
    ("3-rrr", Fraction(1, 50), 3),
    ("3-prr", Fraction(1, 50), 2),
]


@pytest.mark.parametrize(("name", "size", "number"), CASES)
def test_out_and_back_ends_in_the_same_box(name: str, size: Fraction, number: int) -> None:
    out = walk(name, 5, size)
    samples = tracked(name, [*out, *out[-2::-1]], number)
    assert len(samples) == 11
    assert samples[-1].pose == samples[0].pose
    assert box(samples[0].pose) == box(solved_at(name, out[0]).poses[number - 1])
    for there, back in zip(samples[:5], reversed(samples[6:]), strict=True):
        assert there.pose == back.pose
        assert there.steps == 0 or there.steps > 0 < back.steps


@pytest.mark.parametrize(("name", "size", "number"), CASES)
def test_every_sample_is_a_pose_that_solve_lists(name: str, size: Fraction, number: int) -> None:
    rows = walk(name, 3, size, seed=2)
    for row, sample in zip(rows, tracked(name, rows, number), strict=True):
        same = [pose for pose in solved_at(name, row).poses if box(pose) == box(sample.pose)]
        assert len(same) == 1
        assert same[0].jacobian is not None
        assert same[0].jacobian.det_sign == sample.det_sign


@pytest.mark.parametrize("number", [1, 4, *(pytest.param(n, marks=pytest.mark.slow) for n in (7, 10, 13, 16))])
def test_small_numeric_steps_lead_to_the_same_pose(number: int) -> None:
    rows = walk("rolland-6-6", 1, Fraction(20), seed=3)
    poses = solved_at("rolland-6-6", rows[0]).poses
    try:
        last = tracked("rolland-6-6", rows, number)[-1].pose
    except TrackingStopped:
        pytest.skip("the branch ends")
    pose = poses[number - 1]
    nothing = np.zeros((1, 6, 3)), np.zeros((1, 6, 3)), np.zeros((1, 6))
    found = np.array([])
    for k in range(1, 201):
        values = tuple(a + Fraction(k, 200) * (b - a) for a, b in zip(*rows, strict=True))
        there = robots_with(problem_at(robot("rolland-6-6"), values), Tolerances.uniform(1), nothing)
        found = poses_near(there, pose)[0]
        pose = _point(found)
    bounds = [*last.position, *(entry for row in last.rotation for entry in row)]
    assert all(float(b.lo) - 1e-9 <= v <= float(b.hi) + 1e-9 for b, v in zip(bounds, found[:12], strict=True))


def _point(values: Any) -> Pose:
    from pkm_exact.roots.interval import Interval

    x = [Interval(Fraction(v), Fraction(v)) for v in values.tolist()]
    return Pose(None, (x[0], x[1], x[2]), (tuple(x[3:6]), tuple(x[6:9]), tuple(x[9:12])), (x[12], x[13], x[14], x[15]))


def test_poses_that_meet_stop_together_where_there_are_fewer_poses() -> None:
    rows = [(Fraction(71, 10), Fraction(51, 10), Fraction(5)), (Fraction(2), Fraction(2), Fraction(2))]
    poses = solved_at("3-rpr-merlet-p", rows[0]).poses
    stops = [tracked_until_it_ends("3-rpr-merlet-p", rows, number) for number in range(1, len(poses) + 1)]
    ends = [stop for stop in stops if stop is not None]
    assert len(ends) == len(poses) == 2
    assert abs(ends[0].reached - ends[1].reached) < Fraction(1, 10**9)
    assert all(0 < end.tried - end.reached <= Fraction(1, 1 << 40) for end in ends)
    margin = Fraction(1, 10**6)
    before, after = (
        tuple(a + s * (b - a) for a, b in zip(*rows, strict=True))
        for s in (ends[0].reached - margin, ends[0].reached + margin)
    )
    assert len(solved_at("3-rpr-merlet-p", before).poses) == 2
    assert len(solved_at("3-rpr-merlet-p", after).poses) == 0


def test_samples_before_the_end_are_yielded_and_the_reason_is_exact() -> None:
    rows = [
        (Fraction(71, 10), Fraction(51, 10), Fraction(5)),
        (Fraction(7), Fraction(5), Fraction(5)),
        (Fraction(2), Fraction(2), Fraction(2)),
    ]
    poses = solved_at("3-rpr-merlet-p", rows[0]).poses
    samples = track_branch(robot("3-rpr-merlet-p"), rows, poses[0])
    assert [next(samples).row, next(samples).row] == [0, 1]
    with pytest.raises(TrackingStopped, match="between rows 2 and 3") as caught:
        next(samples)
    assert "singularity" in str(caught.value)
    assert caught.value.row == 1


def test_a_path_near_a_singularity_takes_smaller_steps() -> None:
    start = (Fraction(71, 10), Fraction(51, 10), Fraction(5))
    end = (Fraction(2), Fraction(2), Fraction(2))
    stop = tracked_until_it_ends("3-rpr-merlet-p", [start, end], 1)
    assert stop is not None

    def at(share: Fraction) -> JointRow:
        return tuple(a + share * (b - a) for a, b in zip(start, end, strict=True))

    length = stop.reached / 20
    easy = tracked("3-rpr-merlet-p", [start, at(length)], 1)[-1].steps
    close = stop.reached - Fraction(1, 10**7)
    numbers = [sample.steps for sample in tracked("3-rpr-merlet-p", [start, at(close - length), at(close)], 1)]
    assert numbers[-1] > 3 * easy


def test_a_smaller_least_step_gives_up_earlier() -> None:
    rows = [(Fraction(71, 10), Fraction(51, 10), Fraction(5)), (Fraction(2), Fraction(2), Fraction(2))]
    poses = solved_at("3-rpr-merlet-p", rows[0]).poses
    reached = []
    for least in (6, 40):
        with pytest.raises(TrackingStopped) as caught:
            list(track_branch(robot("3-rpr-merlet-p"), rows, poses[0], policy=TrackPolicy(smallest_step=least)))
        reached.append(caught.value.reached)
    assert reached[0] < reached[1]


def test_a_path_that_stands_still() -> None:
    rows = [home("rolland-6-6")] * 3
    samples = tracked("rolland-6-6", rows, 5)
    assert [sample.steps for sample in samples] == [0, 1, 1]
    assert samples[0].pose == samples[2].pose


def test_the_width_is_kept() -> None:
    rows = walk("rolland-6-6", 1, Fraction(5))
    for width in (Fraction(1, 1000), Fraction(1, 10**40)):
        last = tracked("rolland-6-6", rows, 10, width=width)[-1].pose
        assert max(bound.width for bound in (*last.position, *last.quaternion)) <= width


def test_a_singular_start_is_refused() -> None:
    from samples import shipped, solved

    solution = solved("3-rpr-double-q")
    singular = next(pose for pose in solution.poses if pose.multiplicity != 1)
    problem = shipped("3-rpr-double-q")
    rows = [tuple(Fraction(float(leg.length_squared) ** 0.5) for leg in problem.distances)] * 2
    with pytest.raises(InputError, match="singular"):
        list(track_branch(robot("3-rpr-double-q"), rows, singular))


# The equations along a path, and tubes


@hypothesis_settings(max_examples=30)
@given(st.sampled_from([case[0] for case in CASES]), st.integers(0, 10**6), st.fractions(0, 1))
def test_forms_between_rows_are_those_of_the_robot_there(name: str, seed: int, share: Fraction) -> None:
    size = next(case[1] for case in CASES if case[0] == name)
    first, last = walk(name, 1, size, seed)
    frames = centred_frames(problem_at(robot(name), first))
    values = tuple(a + share * (b - a) for a, b in zip(first, last, strict=True))
    with ctx.workprec(128):
        zeroth, once, twice = path_forms(robot(name), frames, first, last).coefficients
        s = arb(share.numerator) / share.denominator
        here = zeroth + s * once + (s * s) * twice
        wanted = centred_robot(problem_at(robot(name), values), frames).forms
        planar = here.nrows() == 3
        for i in range(here.nrows()):
            leg = i if planar else i - 1
            weight = 1 + values[leg] ** 2 if has_cranks(robot(name)) and leg >= 0 else Fraction(1)
            for j in range(here.ncols()):
                difference = here[i, j] - wanted[i, j].real * weight.numerator / weight.denominator
                assert difference.contains(0)
                assert difference.rad() < arb(2) ** -90


def _tube_data(name: str, rows: Sequence[JointRow], number: int) -> tuple[FloatPath, Any]:
    """The first piece of a path, and a pose at its beginning in floating point."""
    from pkm_exact.numeric.nominal import pose_point
    from pkm_exact.numeric.tube import floats

    frames = centred_frames(problem_at(robot(name), rows[0]))
    path = FloatPath.of(path_forms(robot(name), frames, rows[0], rows[1]))
    point = pose_point(
        centred_robot(problem_at(robot(name), rows[0]), frames), solved_at(name, rows[0]).poses[number - 1]
    )
    return path, floats(arb_mat([[value.real] for value in point.entries()]))[:, 0]


def test_a_tube_is_not_proved_for_the_box_of_another_pose() -> None:
    rows = walk("rolland-6-6", 1, Fraction(5))
    with ctx.workprec(96):
        path, near = _tube_data("rolland-6-6", rows, 10)
        other = _tube_data("rolland-6-6", rows, 5)[1]
        half = Fraction(1, 4)
        entering = [station(path, predict(path, point, 0.0), Fraction(0)) for point in (near, other)]  # type: ignore[arg-type]
        middle = predict(path, near, float(half))
        assert middle is not None
        assert entering[0] is not None
        assert entering[1] is not None
        assert prove(path, middle, entering[0], half, half) is not None
        assert prove(path, middle, entering[1], half, half) is None


def test_a_tube_is_not_proved_across_a_fold() -> None:
    rows = [(Fraction(71, 10), Fraction(51, 10), Fraction(5)), (Fraction(2), Fraction(2), Fraction(2))]
    stop = tracked_until_it_ends("3-rpr-merlet-p", rows, 1)
    assert stop is not None
    with ctx.workprec(96):
        path, near = _tube_data("3-rpr-merlet-p", rows, 1)
        middle = predict(path, near, float(stop.reached * Fraction(9, 10)))
        assert middle is not None
        centre = Fraction(float(stop.reached * Fraction(9, 10)))
        inside = station(path, middle, centre)
        assert inside is not None
        # Wide enough in the parameter to reach over the fold: no entering box, so that only the tube itself can fail.
        assert prove(path, middle, inside, centre, stop.reached - centre + Fraction(1, 1000)) is None


# Files


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("", "has no rows"),
        ("# nothing\n\n", "has no rows"),
        ("1,2\n", "line 1: 2 values; give 3 (l1, l2, l3), or time before them"),
        ("1,2,3\n1,2\n", "line 2: 2 values; give 3"),
        ("1,2,3\n1,,3\n", "line 2, l2: is empty"),
        ("1,2,3\n1,x2,3\n", "line 2, l2: x2 is not a number"),
        ("1,2,nan\n", "line 1, l3: nan is not a finite number"),
        ("1,2,3\n\n1,-2,3\n", "line 3, l2: -2 is not a length"),
        ("1,2,0\n", "line 1, l3: 0 is not a length"),
        ("time,l1,l2,l3\n0,1,2,3\n0,1,2,3\n", "line 3, time: 0 is not after 0"),
        ("l1,l3,l2\n1,2,3\n", "name them [time,]l1,l2,l3"),
        ("1,2,3\n1;2;3\n", "line 2: 1 values"),
        ("1,2," + "9" * 500 + "\n", "too long"),
    ],
)
def test_bad_rows_name_line_column_and_remedy(text: str, part: str, tmp_path: Path) -> None:
    path = tmp_path / "path.csv"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        read_path(path, robot("3-rpr-merlet-p"))
    assert str(caught.value).startswith(str(path))
    assert part in str(caught.value)
    assert "\n" not in str(caught.value)


def test_cranks_move_between_angles_in_degrees(tmp_path: Path, capsys: Capture) -> None:
    arms, target = robot("3-rrr"), tmp_path / "out.csv"
    path = path_from_csv("0,90deg,1/2\n37deg,0deg,6\n", arms)
    assert path.rows[0] == (0, 1, Fraction(1, 2))
    assert path.rows[1][1] == 0
    assert abs(float(path.rows[1][0]) - tan(radians(37 / 2))) < 1e-15
    said = list(map(str, path.stand_ins))
    assert said[0].startswith("line 2, h1 was given as 37 degrees")
    assert said[1].startswith("line 2, h3: 6 is taken as a half tangent, an angle of 161.1 degrees")
    for text, part in (
        ("0,0,180deg\n", "line 1, h3: 180 degrees; give an angle between -180 and 180"),
        ("0,0,deg", "h3"),
    ):
        with pytest.raises(InputError, match=part):
            path_from_csv(text, arms)
    with pytest.raises(InputError, match="l1"):
        path_from_csv("7deg,5,5\n", robot("3-rpr-merlet-p"))
    (tmp_path / "path.csv").write_text("h1,h2,h3\n0deg,0,0\n1deg,0,0\n")
    words = ["track", str(FILES["3-rrr"]), str(tmp_path / "path.csv"), "--start", "1", "-o", str(target)]
    assert main(words) == 0
    assert "line 3, h1 was given as 1 degrees" in capsys.readouterr().err
    assert target.read_text().count("\n") == 3


def test_paths_are_exact() -> None:
    text = "\ufeff# a comment\r\nTime, L1, L2, L3\r\n0, 7.1, 51/10, 5\r\n1e-1, 7, 5e0, 5\r\n"
    path = path_from_csv(text.removeprefix("\ufeff"), robot("3-rpr-merlet-p"))
    assert path.rows == ((Fraction(71, 10), Fraction(51, 10), 5), (7, 5, 5))
    assert path.times == (0, Fraction(1, 10))
    assert path.lines == (3, 4)


def write_path(file: Path, rows: Sequence[JointRow], *, times: bool = True) -> Path:
    lines = [",".join(map(str, ([Fraction(k, 10)] if times else []) + list(row))) for k, row in enumerate(rows)]
    file.write_text("\n".join(lines) + "\n")
    return file


@pytest.fixture
def words(tmp_path: Path) -> list[str]:
    """A command that follows a planar robot over 31 rows."""
    path = write_path(tmp_path / "path.csv", walk("3-rrr", 30, Fraction(1, 50)))
    return ["track", str(FILES["3-rrr"]), str(path), "--start", "3", "-o"]


def test_the_command_writes_csv_and_json(words: list[str], tmp_path: Path, capsys: Capture) -> None:
    assert main([*words, str(tmp_path / "out.csv"), "--exact"]) == 0
    assert "31 of 31 rows" in capsys.readouterr().out
    assert main([*words, str(tmp_path / "decimals.csv")]) == 0
    decimals = list(csv.DictReader((tmp_path / "decimals.csv").read_text().splitlines()))
    assert main([*words, str(tmp_path / "out.json")]) == 0
    rows = list(csv.DictReader((tmp_path / "out.csv").read_text().splitlines()))
    content = json.loads((tmp_path / "out.json").read_text())
    samples = tracked("3-rrr", walk("3-rrr", 30, Fraction(1, 50)), 3)
    assert content["stopped"] is None
    for row, entry, sample in zip(rows, content["samples"], samples, strict=True):
        bounds = sample.pose.position[0]
        assert [row["x_lo"], row["x_hi"]] == entry["position"][0] == [str(bounds.lo), str(bounds.hi)]
        assert int(row["steps"]) == entry["steps"] == sample.steps
        plain = decimals[int(row["row"]) - 1]
        digits = len(plain["x"].partition(".")[2])
        assert abs(Fraction(plain["x"]) - bounds.midpoint) <= Fraction(1, 10**digits)
        turned = atan2(float(sample.pose.rotation[1][0].midpoint), float(sample.pose.rotation[0][0].midpoint))
        assert float(plain["degrees"]) == pytest.approx(degrees(turned), abs=1e-6)
        assert int(row["det_sign"]) == entry["det_sign"] == sample.det_sign
        assert int(row["row"]) == entry["row"] == sample.row + 1
        assert row["time"] == entry["time"]
    assert not list(tmp_path.glob("*.partial"))


@pytest.mark.parametrize("complete", [True, False])
def test_the_command_says_whether_the_start_is_proved(
    complete: bool, words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    """In a list that is not complete, another pose may stand in the box of the one that was asked for."""
    solution = solved_at("3-rrr", home("3-rrr"))
    assert solution.claim is Claim.COMPLETE
    if not complete:
        solution = replace(solution, claim=Claim.NOT_PROVEN_COMPLETE, completeness=None)
    monkeypatch.setattr(track_command, "_solution", lambda *_: solution)
    interrupted(words, tmp_path / "out.json", 2)
    monkeypatch.setattr(track_command, "_solution", None)  # the store knows it
    assert main([*words, str(tmp_path / "out.json")]) == 0
    out = capsys.readouterr().out
    assert out.startswith("start: ")
    assert ("list, which is complete" in out) is complete
    assert ("list is not proved complete" in out) is not complete
    assert json.loads((tmp_path / "out.json").read_text())["start_proved"] is complete


def test_the_sign_is_that_of_the_branch_and_not_of_the_list() -> None:
    rows = walk("3-rrr", 1, Fraction(1, 50))
    poses = solved_at("3-rrr", rows[0]).poses
    assert poses[0].jacobian is not None
    sign = poses[0].jacobian.det_sign
    wrong = replace(poses[0], jacobian=replace(poses[0].jacobian, det_sign=-sign))
    assert [sample.det_sign for sample in track_branch(robot("3-rrr"), rows, wrong)] == [sign, sign]


def test_the_command_stops_before_a_singularity(tmp_path: Path, capsys: Capture) -> None:
    rows = [(Fraction(71, 10), Fraction(51, 10), Fraction(5)), (Fraction(2), Fraction(2), Fraction(2))]
    path = write_path(tmp_path / "path.csv", rows)
    output = tmp_path / "out.json"
    assert main(["track", str(FILES["3-rpr-merlet-p"]), str(path), "--start", "1", "-o", str(output)]) == 3
    text = capsys.readouterr().out
    assert "1 of 2 rows" in text
    assert "the branch ends between rows 1 and 2" in text
    stopped = json.loads(output.read_text())["stopped"]
    low, high = Fraction(stopped["certified_to"]), Fraction(stopped["not_certified_to"])
    assert 0 < low < high < 1
    assert [Fraction(value) for value in stopped["time"]] == [low / 10, high / 10]
    assert stopped["lines"] == [1, 2]


@pytest.mark.parametrize(
    ("change", "part"),
    [
        ({3: "--start", 4: "9"}, "--start 9: the first row has"),
        ({2: "missing.csv"}, "missing.csv: cannot be read"),
        ({6: "out.txt"}, "ends neither in .csv nor in .json"),
        ({6: "missing/out.csv"}, "does not exist"),
    ],
)
def test_the_command_refuses(
    change: dict[int, str],
    part: str,
    words: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: Capture,
) -> None:
    monkeypatch.chdir(tmp_path)
    changed = [change.get(k, word) for k, word in enumerate([*words, "out.csv"])]
    assert main(changed) == 2
    captured = capsys.readouterr()
    assert part in captured.err
    assert captured.err.count("\n") == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["path.csv"]


def test_the_path_is_not_overwritten(words: list[str], capsys: Capture) -> None:
    before = Path(words[2]).read_bytes()
    assert main([*words, words[2]]) == 2
    assert Path(words[2]).read_bytes() == before


# Interrupted runs


class _Interrupting:
    """Makes the store raise after so many records."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, count: int) -> None:
        self._left = count
        self._add = TrackStore.add
        monkeypatch.setattr(TrackStore, "add", lambda store, record: self(store, record))

    def __call__(self, store: TrackStore, record: dict[str, Any]) -> None:
        if self._left == 0:
            raise KeyboardInterrupt
        self._left -= 1
        self._add(store, record)


def interrupted(words: list[str], output: Path, count: int) -> Path:
    """Run the command until so many rows are kept; return the file that holds them."""
    with pytest.MonkeyPatch.context() as monkeypatch:
        _Interrupting(monkeypatch, count)
        assert main([*words, str(output)]) == 130
    assert not output.exists()
    return output.with_name(output.name + ".partial")


@pytest.mark.parametrize("suffix", ["csv", "json"])
@pytest.mark.parametrize("counts", [pytest.param((1,), marks=pytest.mark.slow), (7, 11), (30,), (0, 1, 2)])
def test_interrupted_runs_go_on_and_give_the_same_bytes(
    suffix: str, counts: tuple[int, ...], words: list[str], tmp_path: Path, capsys: Capture
) -> None:
    whole, output = tmp_path / f"whole.{suffix}", tmp_path / f"out.{suffix}"
    assert main([*words, str(whole)]) == 0
    kept = 0
    for count in counts:
        if kept + count > 30:
            break
        partial = interrupted(words, output, count)
        kept += count
        assert len(partial.read_bytes().splitlines()) == 1 + kept
    assert main([*words, str(output)]) == 0
    assert output.read_bytes() == whole.read_bytes()
    assert not list(tmp_path.glob("*.partial"))


def test_an_interrupted_run_computes_nothing_twice(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    interrupted(words, tmp_path / "out.csv", 20)
    counter = _Interrupting(monkeypatch, 11)
    assert main([*words, str(tmp_path / "out.csv")]) == 0
    assert counter._left == 0


def _cut(data: bytes) -> Iterator[bytes]:
    """A file as it may be found after a crash, or after someone's hand was in it."""
    lines = data.splitlines(keepends=True)
    yield data[:-1]
    yield data[:-40]
    yield data + b'{"row": 22'
    yield data + b"\x00" * 100
    yield b"".join([*lines[:5], lines[5].replace(b'"steps": ', b'"steps": 1'), *lines[6:]])
    yield b"".join([*lines[:5], *lines[6:]])
    yield b"".join([*lines[:6], lines[5], *lines[6:]])
    yield lines[0]
    yield b""


def test_a_damaged_file_is_used_as_far_as_it_is_good(words: list[str], tmp_path: Path) -> None:
    whole, output = tmp_path / "whole.csv", tmp_path / "out.csv"
    assert main([*words, str(whole)]) == 0
    partial = interrupted(words, output, 12)
    data = partial.read_bytes()
    for damaged in _cut(data):
        partial.write_bytes(damaged)
        assert main([*words, str(output)]) == 0
        assert output.read_bytes() == whole.read_bytes()
        output.unlink()


def test_the_run_of_another_job_is_not_touched(words: list[str], tmp_path: Path, capsys: Capture) -> None:
    partial = interrupted(words, tmp_path / "out.csv", 5)
    data = partial.read_bytes()
    other = [*words]
    other[4] = "2"
    assert main([*other, str(tmp_path / "out.csv")]) == 2
    assert "belongs to an interrupted run of another" in capsys.readouterr().err
    assert partial.read_bytes() == data
    partial.write_text("my notes\n")
    assert main([*words, str(tmp_path / "out.csv")]) == 2
    assert "is no interrupted run" in capsys.readouterr().err
    assert partial.read_text() == "my notes\n"


@pytest.mark.slow
def test_killed_runs_go_on_and_give_the_same_bytes(tmp_path: Path) -> None:
    path = write_path(tmp_path / "path.csv", walk("rolland-6-6", 400, Fraction(2)))
    words = ["track", str(FILES["rolland-6-6"]), str(path), "--start", "10", "-o"]
    assert main([*words, str(tmp_path / "whole.csv")]) == 0
    output = tmp_path / "out.csv"
    command = [sys.executable, "-m", "pkm_exact.cli.main", *words, str(output)]
    kept = 0
    for _ in range(3):
        process = subprocess.Popen(command)
        time.sleep(1.5)
        process.send_signal(signal.SIGKILL)
        process.wait()
        partial = tmp_path / "out.csv.partial"
        if not partial.exists():
            break
        lines = len(partial.read_bytes().splitlines())
        assert lines >= kept
        kept = lines
    assert subprocess.run(command, check=False).returncode == 0
    assert output.read_bytes() == (tmp_path / "whole.csv").read_bytes()
