"""Many length vectors from a file: the answers, the bytes, interrupted and taken up again, killed, in bad company."""

from __future__ import annotations

import csv
import json
import os
import signal
import subprocess
import sys
import time
import tracemalloc
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from fractions import Fraction
from hashlib import sha256
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st
from samples import MODELS
from sweep_tools import Deadly, Quick, Unloadable

from pkm_exact import InputError, Policy, check_bytes, read_robot
from pkm_exact.batch.row_solver import TOGETHER, RowSolver
from pkm_exact.certify.build import canonical_bytes, certificate, certificate_bytes
from pkm_exact.cli.main import main
from pkm_exact.cli.sweep import _Shown
from pkm_exact.errors import PkmExactError
from pkm_exact.geometry.path_reader import joint_names
from pkm_exact.poses.pose_names import pose_names
from pkm_exact.poses.roll_pitch_yaw import roll_pitch_yaw
from pkm_exact.roots.interval import Interval, decimal
from pkm_exact.solution import Solution
from pkm_exact.sweep.job import Answer, SweepJob, sweep_job
from pkm_exact.sweep.journal import Journal
from pkm_exact.sweep.lengths import MAX_LINE, LengthRow, LengthsFile, read_lengths
from pkm_exact.sweep.local import local_workers
from pkm_exact.sweep.run import sweep

Capture = pytest.CaptureFixture[str]
WIDTH = Fraction(1, 10**9)
FILES = {path.stem: path for path in MODELS}
PLANAR = FILES["3-rpr-merlet-p"]
SPATIAL = FILES["rolland-6-6"]
GOOD = ["7.1,5.1,5", "7,5,5", "71/10,5.15,5.05", "2,2,2", "7.2e0,5,5.1"]
MIXED = ["l1,l2,l3", "", *GOOD[:2], "# a comment", "7,x,5", GOOD[2], "7,0,5", ",,", "7,5", *GOOD[3:], "1e999,5,5"]


def written(path: Path, lines: list[str]) -> Path:
    path.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
    return path


def many(count: int, seed: int = 1) -> list[str]:
    """Rows of the planar robot, one in ten of them bad."""
    random = Random(seed)
    rows = [",".join(str(Fraction(random.randint(4000, 8000), 1000)) for _ in range(3)) for _ in range(count)]
    bad = ["1,2", "1,x,1", "0,1,1", f"{'9' * 300},1,1"]
    return [random.choice(bad) if k % 10 == 9 else row for k, row in enumerate(rows)]


def records(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_bytes().splitlines()]


def run(model: Path, rows: Path, out: Path, *options: str) -> int:
    """The command with one worker; each costs a start."""
    return main(["sweep", str(model), str(rows), "-o", str(out), "--workers", "1", *options])


@dataclass
class Inline:
    """Workers in this process, which answer in any order; they may be told to fail."""

    job: SweepJob
    random: Random
    capacity: int = 5
    fail_at: int | None = None
    answered = 0

    def __post_init__(self) -> None:
        self._rows: list[LengthRow] = []

    def submit(self, row: LengthRow) -> None:
        assert len(self._rows) < self.capacity
        self._rows.append(row)

    def finished(self) -> list[Answer]:
        if self.fail_at is not None and self.answered >= self.fail_at:
            raise PkmExactError("stopped by the test")
        self.random.shuffle(self._rows)
        some = self.random.randint(1, len(self._rows))
        done, self._rows = self._rows[:some], self._rows[some:]
        self.answered += some
        return [self.job.answer(row) for row in done]


@contextmanager
def inline(job: SweepJob, seed: int = 0, fail_at: int | None = None) -> Iterator[Inline]:
    yield Inline(job, Random(seed), fail_at=fail_at)


def quick_job(lengths: LengthsFile, *, certificates: bool = False) -> SweepJob:
    robot = read_robot(PLANAR)
    return SweepJob(robot, lengths.names, Quick("exact", WIDTH, Policy()), False, certificates)


# Answers

JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4),
)


@given(JSON)
def test_certificates_are_spelled_as_json_dumps_does(value: object) -> None:
    assert canonical_bytes(value) == (json.dumps(value, indent=1) + "\n").encode("ascii")


def test_the_bytes_of_a_certificate_are_those_of_the_object() -> None:
    from samples import solved

    for name in ("3-rpr-merlet-p", "rolland-6-6"):
        robot, solution = read_robot(FILES[name]), solved(name)
        assert certificate_bytes(robot, None, solution) == canonical_bytes(certificate(robot, None, solution))


@given(st.fractions(), st.fractions(min_value=0, max_value=10**9))
def test_no_digit_of_a_decimal_is_wrong_by_more_than_one_unit(low: Fraction, width: Fraction) -> None:
    text = decimal(Interval(low, low + width))
    unit = Fraction(1, 10 ** len(text.partition(".")[2]))
    assert max(abs(Fraction(text) - low), abs(Fraction(text) - low - width)) <= max(unit, width)
    assert width == 0 or unit < 10 * max(width, Fraction(1, 10))


@pytest.mark.parametrize("method", ["krawczyk", "exact"])
def test_every_row_has_the_certificate_that_solve_writes(tmp_path: Path, method: str) -> None:
    rows = written(tmp_path / "lengths.csv", MIXED)
    assert run(PLANAR, rows, tmp_path / "out.jsonl", "--method", method, "--certificates", str(tmp_path / "certs")) == 3
    found = records(tmp_path / "out.jsonl")
    assert [entry["row"] for entry in found] == list(range(1, 10))
    assert [entry["line"] for entry in found] == [3, 4, 6, 7, 8, 10, 11, 12, 13]
    assert ["error" in entry for entry in found] == [False, False, True, False, True, True, False, False, True]
    for entry in found:
        path = tmp_path / "certs" / f"{entry['row']}.json"
        if "error" in entry:
            assert not path.exists()
            continue
        alone = tmp_path / "alone.json"
        words = ["solve", str(PLANAR), "--lengths", ",".join(entry["lengths"]), "--method", method, "-o", str(alone)]
        assert main(words) == 0
        assert alone.read_bytes() == path.read_bytes()
        assert sha256(path.read_bytes()).hexdigest() == entry["certificate_sha256"]
        assert check_bytes(path.read_bytes()).status == "accepted"
        assert entry["real_poses"] == len(entry["poses"]) == json.loads(path.read_bytes())["real_poses"]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["alone.json", "certs", "lengths.csv", "out.jsonl"]


@pytest.mark.parametrize("name", ["rolland-6-6", pytest.param("similar-planar-s", marks=pytest.mark.slow), "dietmaier"])
def test_spatial_rows_have_the_certificate_of_a_single_solve(tmp_path: Path, name: str) -> None:
    """Whether the near start serves (Rolland, Dietmaier) or the robot has fewer than 40 solutions (the other)."""
    robot = read_robot(FILES[name])
    squares = [float(square) for square in robot.configuration().lengths_squared]
    random = Random(4)
    lines = [",".join(f"{square**0.5 * random.uniform(0.99, 1.01):.3f}" for square in squares) for _ in range(3)]
    lengths = read_lengths(written(tmp_path / "lengths.csv", lines), robot)
    job = sweep_job(robot, lengths, method="krawczyk", width=WIDTH, policy=Policy(), squared=False, certificates=True)
    assert (job.solver.start is None) == (name == "similar-planar-s")
    for row in list(lengths.rows())[: 1 if name == "similar-planar-s" else 3]:
        problem = robot.problem([Fraction(field) ** 2 for field in row.fields])
        alone = RowSolver("krawczyk", WIDTH, Policy()).solution(problem)
        assert job.answer(row).certificate == canonical_bytes(certificate(robot, None, alone))
        assert alone.method == ("exact" if name == "similar-planar-s" else "krawczyk")


def test_decimals_are_right_to_one_unit_of_the_last_digit(tmp_path: Path) -> None:
    rows = written(tmp_path / "lengths.csv", GOOD)
    for width, digits in (("1e-9", 9), ("1e-30", 30)):
        options = ["--width", width, "--certificates", str(tmp_path / width)]
        assert run(PLANAR, rows, tmp_path / "out.jsonl", *options) == 0
        for entry in records(tmp_path / "out.jsonl"):
            content = json.loads((tmp_path / width / f"{entry['row']}.json").read_bytes())
            for pose, boxes in zip(entry["poses"], content["poses"], strict=True):
                for key in ("position", "quaternion"):
                    for text, ends in zip(pose[key], boxes[key], strict=True):
                        low, high = map(Fraction, ends)
                        if high > low:
                            assert len(text.partition(".")[2]) >= digits
                            unit = Fraction(1, 10 ** len(text.partition(".")[2]))
                            assert max(abs(Fraction(text) - low), abs(Fraction(text) - high)) <= unit


def test_squared_lengths(tmp_path: Path) -> None:
    plain = written(tmp_path / "plain.csv", ["7,5,5", "6,5,4"])
    squared = written(tmp_path / "squared.csv", ["49,25,25", "36,25,16"])
    assert run(PLANAR, plain, tmp_path / "plain.jsonl") == run(PLANAR, squared, tmp_path / "sq.jsonl", "--squared") == 0
    digests = [
        [entry["certificate_sha256"] for entry in records(tmp_path / name)] for name in ("plain.jsonl", "sq.jsonl")
    ]
    assert digests[0] == digests[1]


def test_weaker_claims_are_answers_with_exit_code_3(tmp_path: Path, collinear_model: Path, capsys: Capture) -> None:
    squares = read_robot(collinear_model).configuration().lengths_squared
    rows = written(tmp_path / "lengths.csv", [",".join(map(str, squares))])
    assert run(collinear_model, rows, tmp_path / "out.jsonl", "--squared") == 3
    (entry,) = records(tmp_path / "out.jsonl")
    assert entry["claim"].startswith("positive-dimensional")
    assert entry["notes"]
    assert entry["certificate_sha256"]
    assert "1 row, " in capsys.readouterr().err


@pytest.mark.slow
def test_rows_together_take_much_less_time_than_solves_alone(tmp_path: Path) -> None:
    """0.64 of it in one run; both are certified, and written. Processor time, in turns."""
    robot, random = read_robot(SPATIAL), Random(6)
    lines = [",".join(f"{1250 + random.randint(-40, 40) / 10}" for _ in range(6)) for _ in range(64)]
    lengths = read_lengths(written(tmp_path / "lengths.csv", lines), robot)
    job = sweep_job(robot, lengths, method="krawczyk", width=WIDTH, policy=Policy(), squared=False, certificates=True)
    alone = replace(job, solver=replace(job.solver, start=None))
    rows, seconds = list(lengths.rows()), [0.0, 0.0]
    for begin in range(0, len(rows), TOGETHER):
        answers = []
        for place, one in enumerate((job, alone)):
            begun = time.process_time()
            answers.append(list(one.answers(rows[begin : begin + TOGETHER])))
            seconds[place] += time.process_time() - begun
        assert answers[0] == answers[1]
    assert seconds[0] < 0.85 * seconds[1]


# What is wrong with a row is said in its line

BAD = {
    "7,5": "2 values; give 3: l1, l2, l3",
    "7,5,5,5": "4 values; give 3: l1, l2, l3",
    "7;5;5": "1 values; give 3",
    "7,x,5": "l2: x is not a number",
    "7,,5": "l2: is empty",
    "7,0,5": "l2: 0 is not a length",
    "7,5,-1": "l3: -1 is not a length",
    "nan,5,5": "l1: nan is not a finite number",
    "inf,5,5": "l1: inf is not a finite number",
    "1/0,5,5": "l1: '1/0' has denominator 0",
    "1e99999,5,5": "l1: 1e99999 is too long",
    f"{'1' * 250},5,5": "is too long; use at most 200 digits",
    "l1,l2,l3": "is a second header; remove it",
    "l1,l3,l2": "l1: l1 is not a number",
    "7,5,5 #": "l3: 5 # is not a number",
    "7,\x1b[2J,5": "l2: \\x1b[2J is not a number",
    f"7,5,{'5' * MAX_LINE}": f"has more than {MAX_LINE} bytes",
    '"7,5,5': "1 values; give 3",
}


@pytest.mark.parametrize("line", BAD, ids=range(len(BAD)))
def test_a_bad_row_is_a_line_and_does_not_stop_the_others(tmp_path: Path, line: str) -> None:
    lengths = read_lengths(written(tmp_path / "lengths.csv", ["7,5,5", line, "7,5,5"]), read_robot(PLANAR))
    output = tmp_path / "out.jsonl"
    tally = sweep(quick_job(lengths), lengths, output, inline)
    found = records(output)
    assert ["error" in entry for entry in found] == [False, True, False]
    assert found[1]["error"].startswith("line 2")
    assert BAD[line] in found[1]["error"]
    assert found[1].keys() == {"row", "line", "lengths", "error"}
    assert (tally.errors, tally.first_error, tally.rows, tally.is_complete) == (1, found[1]["error"], 3, False)
    assert output.read_bytes().isascii()


def test_a_spreadsheet_s_semicolons_and_decimal_commas_are_read(tmp_path: Path) -> None:
    robot = read_robot(PLANAR)
    lines = ["# exported", "l1;l2;l3", "7,1;5,1;5", "7.1;26/5;5e0", '7,1;"5,2";1.000,5', "7,1,5;5;5"]
    lengths = read_lengths(written(tmp_path / "lengths.csv", lines), robot)
    assert [row.fields for row in lengths.rows()] == [
        ("7.1", "5.1", "5"),
        ("7.1", "26/5", "5e0"),
        ("7.1", "5.2", "1.000,5"),
        ("7,1,5", "5", "5"),
    ]
    output = tmp_path / "out.jsonl"
    sweep(quick_job(lengths), lengths, output, inline)
    assert ["error" in entry for entry in records(output)] == [False, False, True, True]


def test_a_line_that_is_no_text(tmp_path: Path) -> None:
    path = tmp_path / "lengths.csv"
    path.write_bytes(b"7,5,5\n7,\xff,5\n# \xff\r\n7,5\x00,5\n7,5,5")
    lengths = read_lengths(path, read_robot(PLANAR))
    sweep(quick_job(lengths), lengths, tmp_path / "out.jsonl", inline)
    found = records(tmp_path / "out.jsonl")
    assert [entry.get("error", "") for entry in found][1] == "line 2: is not UTF-8 text; save the file as UTF-8"
    assert [entry["line"] for entry in found] == [1, 2, 4, 5]
    assert found[1]["lengths"] is None
    assert ["error" in entry for entry in found] == [False, True, True, False]


def test_what_an_engine_raises_is_the_answer_of_its_row(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    lengths = read_lengths(written(tmp_path / "lengths.csv", GOOD[:4]), read_robot(PLANAR))
    raised = iter([PkmExactError("out of reach"), MemoryError(), ZeroDivisionError("1/0"), InputError("too large")])

    def fail(*_: object) -> Solution:
        raise next(raised)

    monkeypatch.setattr(Quick, "solution", fail)
    answers = [json.loads(quick_job(lengths).answer(row).line)["error"] for row in lengths.rows()]
    assert answers == [
        "line 1: no answer: out of reach",
        "line 2: no answer: the memory is exhausted; solve this row by itself",
        "line 3: no answer: internal error: ZeroDivisionError: 1/0; solve this row by itself for a report to send",
        "line 4: too large",
    ]


@pytest.mark.parametrize(
    "header", ["l1,l2,l3", "L1, L2 ,L3", '"l1","l2","l3"', "\ufeffl1,l2,l3", "\n# names\nl1,l2,l3"]
)
def test_headers_and_line_ends(tmp_path: Path, header: str) -> None:
    for end in ("\n", "\r\n"):
        path = tmp_path / "lengths.csv"
        path.write_bytes(f'{header}\n7,5,5\n \n"6", 5,4'.replace("\n", end).encode())
        rows = list(read_lengths(path, read_robot(PLANAR)).rows())
        assert [row.fields for row in rows] == [("7", "5", "5"), ("6", "5", "4")]
        assert [row.number for row in rows] == [1, 2]
        assert rows[1].line == rows[0].line + 2


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"l1,l1,l3\n7,5,5\n", r"lengths\.csv: line 1: two columns are called 'l1'; name them l1,l2,l3"),
        (b"\nl2,l1,l3\n7,5,5\n", r"lengths\.csv: line 2: the columns are 'l2,l1,l3'; name them l1,l2,l3"),
        (b"time,l1,l2,l3\n0,7,5,5\n", "line 1: the columns are"),
        (b"", "has no rows; give one row of 3 lengths"),
        (b"# nothing\n\n", "has no rows"),
        (b"l1,l2,l3\n", "has no rows"),
    ],
)
def test_files_that_are_refused(tmp_path: Path, content: bytes, sentence: str) -> None:
    (tmp_path / "lengths.csv").write_bytes(content)
    with pytest.raises(InputError, match=sentence):
        read_lengths(tmp_path / "lengths.csv", read_robot(PLANAR))


def test_cranks_are_swept_by_joint_values(tmp_path: Path, capsys: Capture) -> None:
    rows = written(tmp_path / "joints.csv", ["h1,h2,h3", "30deg,0deg,-20deg", "1/2,0,1/3", "1,x,1"])
    out, model, certificates = tmp_path / "out.jsonl", FILES["3-rrr"], tmp_path / "certificates"
    assert run(model, rows, out, "--joints", "--certificates", str(certificates), "--workers", "1") == 3
    first, second, third = map(json.loads, out.read_text().splitlines())
    assert third["error"].startswith("line 4, h2: x is not a number")
    assert second["real_poses"] == 2
    assert [note for note in second["notes"] if "line" in note] == []
    assert "line 2, leg 1 was given as 30 degrees, whose cosine and sine are not both rational" in first["notes"][-2]
    one = tmp_path / "one.json"
    words = ["solve", str(model), "--joints", "30deg,0deg,-20deg", "--method", "krawczyk", "-o", str(one)]
    assert main(words) == 0
    assert (certificates / "1.json").read_bytes() == one.read_bytes()
    assert first["certificate_sha256"] == sha256(one.read_bytes()).hexdigest()
    assert run(model, rows, tmp_path / "other.jsonl", "--joints", "--squared") == 2
    assert "exclude each other" in capsys.readouterr().err


def test_the_pose_that_is_meant_is_marked(tmp_path: Path) -> None:
    model = tmp_path / "meant.toml"
    model.write_text(FILES["3-rpr-merlet-p"].read_text() + "\n[nominal]\nposition = [5, 5]\ndegrees = 0\n")
    rows = written(tmp_path / "rows.csv", ["7.1,5.1,5", "7.2,5.1,5.1", "1,1,1"])
    assert [run(model, rows, tmp_path / out) for out in ("out.jsonl", "out.csv")] == [0, 0]
    assert [record["nearest_to_nominal"] for record in records(tmp_path / "out.jsonl")] == [[2], [2], []]
    with (tmp_path / "out.csv").open(newline="", encoding="utf-8") as stream:
        table = [(line["row"], line["pose"], line["nearest"]) for line in csv.DictReader(stream)]
    assert table == [("1", "1", ""), ("1", "2", "yes"), ("2", "1", ""), ("2", "2", "yes"), ("3", "", "")]


@pytest.mark.parametrize(
    ("name", "given"), [("3-rpr-merlet-p", ["7.1", "5.1", "5"]), ("3-rps", ["13/10", "4/3", "1.25"])]
)
def test_a_table_has_a_line_for_each_pose(tmp_path: Path, name: str, given: list[str]) -> None:
    robot = read_robot(FILES[name])
    names = joint_names(robot)
    values = dict(zip(names, given, strict=True))
    lines = [names, given, [*given[1:], "1000000"], ["x", *given[1:]]]
    rows = written(tmp_path / "rows.csv", [",".join(line) for line in lines])
    assert [run(FILES[name], rows, tmp_path / out) for out in ("out.jsonl", "out.CSV")] == [3, 3]
    assert {path.name for path in tmp_path.iterdir()} == {"rows.csv", "out.jsonl", "out.CSV"}
    with (tmp_path / "out.CSV").open(newline="", encoding="utf-8") as stream:
        table = list(csv.DictReader(stream))
    expected, empty, wrong = records(tmp_path / "out.jsonl")
    poses = [line for line in table if line["row"] == "1"]
    assert [line["pose"] for line in poses] == [str(k + 1) for k in range(expected["real_poses"])] != []
    for line, pose, box in zip(
        poses, expected["poses"], robot.solve(lengths=given, method="krawczyk").poses, strict=True
    ):
        assert {key: float(line[f"joint_{key}"]) for key in names} == {k: float(Fraction(v)) for k, v in values.items()}
        planar = robot.motion.is_planar
        assert [line[key] for key in ("x", "y", "z") if key in line] == pose["position"][: 2 if planar else 3]
        assert [line[f"q{k}"] for k in range(4) if not planar] == ([] if planar else pose["quaternion"])
        angles = ["degrees"] if planar else ["roll", "pitch", "yaw"]
        for key, angle in zip(angles, roll_pitch_yaw(box)[2 if planar else 0 :], strict=True):
            assert angle is not None
            unit = Fraction(1, 10 ** len(line[key].partition(".")[2]))
            assert angle.lo - unit <= Fraction(line[key]) <= angle.hi + unit
        assert (line["det_sign"], line["multiplicity"]) == (str(pose["det_sign"]), str(pose["multiplicity"]))
    found = robot.solve(lengths=given, method="krawczyk")
    assert [line["name"] for line in poses] == list(pose_names(found.poses, robot.motion))
    assert {line["nearest"] for line in table} == {""}
    (without,) = [line for line in table if line["row"] == "2"]
    assert (without["claim"], without["real_poses"], without["pose"], without["x"]) == (empty["claim"], "0", "", "")
    (refused,) = [line for line in table if line["row"] == "3"]
    assert (refused["notes"], refused["claim"], refused[f"joint_{names[0]}"]) == (wrong["error"], "", "x")


def test_what_is_no_file_of_lengths_is_one_sentence(tmp_path: Path, capsys: Capture) -> None:
    rows = written(tmp_path / "lengths.csv", GOOD)
    os.mkfifo(tmp_path / "pipe")
    for arguments, sentence in {
        (PLANAR, tmp_path / "none.csv"): "none.csv: does not exist",
        (PLANAR, tmp_path): "is not a regular file",
        (PLANAR, tmp_path / "pipe"): "is not a regular file",
        (
            FILES["3-rrr"],
            rows,
        ): "the rods of a 3-RRR robot have fixed lengths; give joint values in its rows, and --joints",
        (tmp_path / "none.toml", rows): "none.toml",
    }.items():
        assert run(*arguments, tmp_path / "out.jsonl") == 2
        assert sentence in capsys.readouterr().err
    for options, sentence in {
        ("-o", str(rows)): "is the file of the lengths itself",
        ("-o", str(tmp_path)): "is a directory",
        ("-o", str(tmp_path / "no" / "out.jsonl")): "does not exist",
        ("-o", str(tmp_path / "out"), "--certificates", str(rows)): "is not a folder",
        ("-o", str(tmp_path / "out"), "--certificates", str(tmp_path / "a" / "b")): "does not exist",
        ("-o", str(tmp_path / "out"), "--certificates", str(tmp_path)): "is not empty",
        ("-o", str(tmp_path / "out"), "--workers", "1", "--scheduler", "tcp://127.0.0.1:1"): "exclude each other",
        ("-o", str(tmp_path / "out"), "--workers", "0"): "--workers",
        ("-o", str(tmp_path / "out"), "--method", "newton"): "--method",
        ("-o", str(tmp_path / "out"), "--width", "0"): "--width",
    }.items():
        assert main(["sweep", str(PLANAR), str(rows), *options]) == 2
        assert sentence in capsys.readouterr().err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["lengths.csv", "pipe"]


def test_a_large_file_takes_no_memory(tmp_path: Path) -> None:
    path = tmp_path / "lengths.csv"
    path.write_text("7.125,5.25,5.5\n" * 10_000)
    robot = read_robot(PLANAR)
    tracemalloc.start()
    try:
        lengths = read_lengths(path, robot)
        count = sum(row.fields == ("7.125", "5.25", "5.5") for row in lengths.rows())
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert count == lengths.count == 10_000
    assert peak < 500_000


def test_a_file_that_is_changed_meanwhile_is_noticed(tmp_path: Path) -> None:
    path = written(tmp_path / "lengths.csv", GOOD)
    lengths = read_lengths(path, read_robot(PLANAR))
    written(path, GOOD[::-1])
    with pytest.raises(InputError, match="was changed while it was read"):
        sweep(quick_job(lengths), lengths, tmp_path / "out.jsonl", inline)
    assert not (tmp_path / "out.jsonl").exists()


# The same bytes


def test_bytes_do_not_depend_on_workers_order_or_start(tmp_path: Path) -> None:
    robot = read_robot(SPATIAL)
    random = Random(2)
    rows = [",".join(f"{1250 + random.randint(-300, 300) / 10}" for _ in range(6)) for _ in range(3)]
    lengths = read_lengths(written(tmp_path / "lengths.csv", rows), robot)
    job = sweep_job(robot, lengths, method="krawczyk", width=WIDTH, policy=Policy(), squared=False, certificates=True)
    other = sweep_job(
        robot, lengths, method="krawczyk", width=WIDTH, policy=Policy(seed=7), squared=False, certificates=True
    )
    assert job.solver.start is not None
    assert other.solver.start is not None
    assert (job.solver.start.legs != other.solver.start.legs).any()
    starts = [job.solver.start, other.solver.start, None]
    jobs = [replace(job, solver=replace(job.solver, start=start)) for start in starts]
    outputs = []
    for number, changed in enumerate(jobs):
        sweep(changed, lengths, tmp_path / f"{number}.jsonl", lambda job, seed=number: inline(job, seed))
        outputs.append((tmp_path / f"{number}.jsonl").read_bytes())
    for workers in ("1", "3"):
        words = [
            "sweep",
            str(SPATIAL),
            str(tmp_path / "lengths.csv"),
            "-o",
            str(tmp_path / "out"),
            "--workers",
            workers,
        ]
        assert main(words) == 0
        outputs.append((tmp_path / "out").read_bytes())
    assert len(set(outputs)) == 1
    assert outputs[0].count(b"krawczyk") == 3


@given(st.integers(0, 10**6), st.integers(1, 9), st.lists(st.integers(0, 25), max_size=3))
@hypothesis_settings(max_examples=12)
def test_any_order_and_any_interruption_give_the_same_bytes(
    tmp_path_factory: pytest.TempPathFactory, seed: int, capacity: int, stops: list[int]
) -> None:
    folder = tmp_path_factory.mktemp("sweep")
    lengths = read_lengths(written(folder / "lengths.csv", many(25)), read_robot(PLANAR))
    job = quick_job(lengths, certificates=True)
    whole, parts = folder / "whole.jsonl", folder / "parts.jsonl"
    sweep(job, lengths, whole, inline, certificates=folder / "whole")
    for stop in stops:
        try:
            sweep(job, lengths, parts, lambda job, s=stop: inline(job, seed, s), certificates=folder / "parts")
        except PkmExactError as error:
            assert str(error) == "stopped by the test"
            assert not parts.exists()
        else:
            break
    else:
        sweep(job, lengths, parts, lambda job: inline(job, seed), certificates=folder / "parts")
    assert whole.read_bytes() == parts.read_bytes()
    assert contents(folder / "whole") == contents(folder / "parts")
    assert len([path for path in folder.iterdir() if path.is_file()]) == 3


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def interrupted(folder: Path, stop: int = 12, **options: Any) -> tuple[SweepJob, LengthsFile, Path]:
    """A sweep of 25 rows that was stopped after some."""
    lengths = read_lengths(written(folder / "lengths.csv", many(25)), read_robot(PLANAR))
    job, output = quick_job(lengths, certificates="certificates" in options), folder / "out.jsonl"
    with pytest.raises(PkmExactError, match="stopped by the test"):
        sweep(job, lengths, output, lambda job: inline(job, 3, stop), **options)
    return job, lengths, output


@given(st.data())
@hypothesis_settings(max_examples=30)
def test_lines_that_are_cut_off_or_changed_are_answered_again(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    folder = tmp_path_factory.mktemp("sweep")
    job, lengths, output = interrupted(folder)
    path = folder / data.draw(st.sampled_from(["out.jsonl.partial", "out.jsonl.journal"]))
    content = path.read_bytes()
    header = content.index(b"\n") + 1 if path.suffix == ".journal" else 0
    place = data.draw(st.integers(header, len(content) - 1))
    change = data.draw(st.sampled_from(["cut", "zero", "flip", "more"]))
    changed = {
        "cut": content[:place],
        "zero": content[:place] + bytes(len(content) - place),
        "flip": content[:place] + bytes([content[place] ^ 1]) + content[place + 1 :],
        "more": content + b'{"row":13}\n',
    }
    path.write_bytes(changed[change])
    sweep(job, lengths, output, inline)
    sweep(job, lengths, folder / "whole.jsonl", inline)
    assert output.read_bytes() == (folder / "whole.jsonl").read_bytes()
    assert {path.name for path in folder.iterdir()} == {"lengths.csv", "out.jsonl", "whole.jsonl"}


def test_killed_just_before_the_journal_is_removed(tmp_path: Path) -> None:
    job, lengths, output = interrupted(tmp_path)
    journal = (tmp_path / "out.jsonl.journal").read_bytes()
    sweep(job, lengths, output, inline)
    before = contents(tmp_path)
    (tmp_path / "out.jsonl.journal").write_bytes(journal)
    sweep(job, lengths, output, inline)
    assert contents(tmp_path) == before


def test_rows_that_are_finished_are_not_answered_again(tmp_path: Path) -> None:
    job, lengths, output = interrupted(tmp_path)
    seen: list[tuple[int, int]] = []
    sweep(job, lengths, output, inline, progress=lambda rows, before: seen.append((rows, before)))
    before = seen[0][0]
    assert 0 < before < 25
    assert seen == [(rows, before) for rows in range(before, 26)]


def test_a_certificate_that_was_removed_is_written_again(tmp_path: Path) -> None:
    folder = tmp_path / "certs"
    job, lengths, output = interrupted(tmp_path, certificates=folder)
    before = contents(folder)
    (folder / min(before)).unlink()
    (folder / ".7.json.0123456789abcdef.tmp").write_text("a draft that a killed run left")
    sweep(job, lengths, output, inline, certificates=folder)
    sweep(job, lengths, tmp_path / "whole.jsonl", inline, certificates=tmp_path / "whole")
    assert contents(folder) == contents(tmp_path / "whole")
    assert before.items() <= contents(folder).items()


def test_a_certificate_is_there_before_its_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    lengths = read_lengths(written(tmp_path / "lengths.csv", GOOD), read_robot(PLANAR))
    job, folder = quick_job(lengths, certificates=True), tmp_path / "certs"
    add = Journal.add

    def checked(journal: Journal, line: bytes) -> None:
        entry = json.loads(line)
        assert sha256((folder / f"{entry['row']}.json").read_bytes()).hexdigest() == entry["certificate_sha256"]
        if entry["row"] == 3:
            raise KeyboardInterrupt
        add(journal, line)

    monkeypatch.setattr(Journal, "add", checked)
    with pytest.raises(KeyboardInterrupt):
        sweep(job, lengths, tmp_path / "out.jsonl", inline, certificates=folder)
    assert (folder / "3.json").exists()
    monkeypatch.setattr(Journal, "add", add)
    sweep(job, lengths, tmp_path / "out.jsonl", inline, certificates=folder)
    assert len(records(tmp_path / "out.jsonl")) == len(contents(folder)) == 5


# Other runs


def test_two_runs_at_once_are_refused(tmp_path: Path, capsys: Capture) -> None:
    rows = written(tmp_path / "lengths.csv", GOOD)
    output = tmp_path / "out.jsonl"
    with Journal(output, "job", lambda _: True):
        assert run(PLANAR, rows, output) == 2
        assert "out.jsonl: another run is writing it; wait for that, or give -o another path" in capsys.readouterr().err
    (tmp_path / "out.jsonl.journal").unlink()
    (tmp_path / "out.jsonl.partial").unlink()
    assert run(PLANAR, rows, output) == 0


def test_the_rows_of_another_job_are_left_alone(tmp_path: Path, capsys: Capture) -> None:
    interrupted(tmp_path)
    before = contents(tmp_path)
    for options in ([], ["--method", "exact", "--width", "1e-3"], ["--certificates", str(tmp_path / "new")]):
        assert run(PLANAR, tmp_path / "lengths.csv", tmp_path / "out.jsonl", *options) == 2
        assert "belongs to an interrupted run of another model, file of lengths, option" in capsys.readouterr().err
    assert contents(tmp_path) == before


@pytest.mark.parametrize("name", ["out.jsonl.partial", "out.jsonl.journal"])
@pytest.mark.parametrize("content", [b"mine", b"mine\n", b'{"format": "mine"}\n{}\n'])
def test_files_of_others_are_left_alone(tmp_path: Path, name: str, content: bytes, capsys: Capture) -> None:
    rows = written(tmp_path / "lengths.csv", GOOD)
    (tmp_path / name).write_bytes(content)
    assert run(PLANAR, rows, tmp_path / "out.jsonl") == 2
    assert "no interrupted run" in capsys.readouterr().err
    assert contents(tmp_path) == {"lengths.csv": rows.read_bytes(), name: content}


# Real processes, really killed


class Command:
    """The command in a process of its own."""

    def __init__(self, *words: str) -> None:
        arguments = [sys.executable, "-m", "pkm_exact.cli.main", "sweep", *words]
        self.process = subprocess.Popen(arguments, stderr=subprocess.PIPE, text=True)

    def children(self) -> list[int]:
        listed = Path(f"/proc/{self.process.pid}/task/{self.process.pid}/children").read_text().split()
        found = [pid for pid in map(int, listed) if b"spawn_main" in _command_line(pid)]
        assert all(pid > 1 for pid in found)
        return found

    def wait_for_rows(self, partial: Path, count: int) -> bool:
        """Wait until some rows are finished; False if the command has ended before."""
        while self.process.poll() is None:
            if partial.exists() and partial.read_bytes().count(b"\n") >= count:
                return True
            time.sleep(0.002)
        return False

    def end(self) -> tuple[int, str]:
        error = self.process.communicate(timeout=120)[1]
        return self.process.returncode, error


def _command_line(pid: int) -> bytes:
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        return b""


needs_proc = pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="needs /proc")


def killed_at_random(tmp_path: Path, rows: int, kills: int) -> None:
    """Kill the command after random delays, then let it end; compare with a run that was left alone."""
    lines = written(tmp_path / "lengths.csv", many(rows))
    expected = tmp_path / "whole.jsonl"
    assert run(PLANAR, lines, expected, "--certificates", str(tmp_path / "whole")) == 3
    output, folder = tmp_path / "out.jsonl", tmp_path / "certs"
    partial, random = tmp_path / "out.jsonl.partial", Random(rows)
    words = [str(PLANAR), str(lines), "-o", str(output), "--certificates", str(folder), "--workers", "2"]
    orphans: list[int] = []
    for kill in range(kills):
        command = Command(*words)
        if command.wait_for_rows(partial, kill * rows // (kills + 1)):
            time.sleep(random.uniform(0, 0.02))
            orphans += command.children()
            command.process.send_signal(signal.SIGKILL)
            assert command.end()[0] in (-signal.SIGKILL, 3)
            assert not output.exists() or kill == kills - 1
    if not output.exists():
        command = Command(*words)
        code, error = command.end()
        assert code == 3, error
        assert f"{rows} rows, " in error
    assert output.read_bytes() == expected.read_bytes()
    assert contents(folder) == contents(tmp_path / "whole")
    assert {path.name for path in tmp_path.iterdir()} == {"lengths.csv", "whole.jsonl", "whole", "out.jsonl", "certs"}
    end = time.monotonic() + 30
    while any(b"spawn_main" in _command_line(pid) for pid in orphans):
        assert time.monotonic() < end, "workers outlive their parent"
        time.sleep(0.05)


@needs_proc
@pytest.mark.slow
def test_killed_at_any_point_the_same_command_goes_on(tmp_path: Path) -> None:
    killed_at_random(tmp_path, rows=30, kills=1)


@needs_proc
@pytest.mark.slow
def test_killed_again_and_again(tmp_path: Path) -> None:
    killed_at_random(tmp_path, rows=400, kills=15)


@needs_proc
def test_an_interrupt_ends_promptly_and_can_be_taken_up(tmp_path: Path) -> None:
    lines = written(tmp_path / "lengths.csv", many(150))
    output = tmp_path / "out.jsonl"
    command = Command(str(PLANAR), str(lines), "-o", str(output), "--workers", "2")
    assert command.wait_for_rows(tmp_path / "out.jsonl.partial", 5)
    command.process.send_signal(signal.SIGINT)
    code, error = command.end()
    assert code == 130
    assert "interrupted after" in error
    assert "of 150 rows; the same command goes on from there" in error
    assert "Traceback" not in error
    assert not output.exists()
    assert run(PLANAR, lines, output) == 3
    assert [entry["row"] for entry in records(output)] == list(range(1, 151))


@needs_proc
@pytest.mark.slow
def test_rows_of_killed_workers_are_answered_all_the_same(tmp_path: Path) -> None:
    lines = written(tmp_path / "lengths.csv", many(50))
    assert run(PLANAR, lines, tmp_path / "whole.jsonl") == 3
    command = Command(str(PLANAR), str(lines), "-o", str(tmp_path / "out.jsonl"), "--workers", "2")
    assert command.wait_for_rows(tmp_path / "out.jsonl.partial", 10)
    for pid in command.children()[:1]:
        os.kill(pid, signal.SIGKILL)
    code, error = command.end()
    assert code == 3, error
    assert (tmp_path / "out.jsonl").read_bytes() == (tmp_path / "whole.jsonl").read_bytes()


def test_a_row_that_kills_its_process_twice_is_given_up(tmp_path: Path) -> None:
    rows = ["7,5,5", "13,5,5", "7,5,4", "11,5,5", "7,5,3", "7,4,4"]
    lengths = read_lengths(written(tmp_path / "lengths.csv", rows), read_robot(PLANAR))
    job = replace(quick_job(lengths), solver=Deadly("exact", WIDTH, Policy(), folder=str(tmp_path)))
    sweep(job, lengths, tmp_path / "out.jsonl", lambda job: local_workers(job, 2))
    found = records(tmp_path / "out.jsonl")
    assert ["error" in entry for entry in found] == [False, True, False, False, False, False]
    assert found[1]["error"].startswith("line 2: no answer: its process was killed twice (code -9)")


def test_workers_that_cannot_begin_are_an_error_of_the_run(tmp_path: Path) -> None:
    lengths = read_lengths(written(tmp_path / "lengths.csv", GOOD), read_robot(PLANAR))
    job = replace(quick_job(lengths), solver=Unloadable("exact", WIDTH, Policy()))
    with pytest.raises(PkmExactError, match="a worker process ended with code 7 before it began"):
        sweep(job, lengths, tmp_path / "out.jsonl", lambda job: local_workers(job, 2))


def test_progress_tells_rows_rate_and_the_time_left(monkeypatch: pytest.MonkeyPatch) -> None:
    said: list[str] = []
    clock = iter([0.0, 0.1, 0.15, 10.0, 10.1])
    monkeypatch.setattr(time, "monotonic", lambda: next(clock))
    shown = _Shown(said.append, 1000)  # type: ignore[arg-type]
    for rows in (100, 101, 200, 201):
        shown(rows, 100)
    assert said == ["200 of 1000 rows (20.0 %), 10 rows/s, 0:01:20 left"]


def test_nothing_but_the_summary_is_said_without_a_terminal(tmp_path: Path, capsys: Capture) -> None:
    rows = written(tmp_path / "lengths.csv", ["7,5,5", "x,5,5", "2,2,2"])
    assert run(PLANAR, rows, tmp_path / "out.jsonl") == 3
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err == (
        "3 rows, 2 real poses; 2 complete, 1 without an answer, the first: line 2, l1: x is not a number; "
        'write a decimal or a string such as "3/4"\n'
    )
