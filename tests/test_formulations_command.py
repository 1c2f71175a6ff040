"""All formulations side by side: the counts of each, agreement by boxes, and what happens to those that do not end."""

import json
from dataclasses import replace
from fractions import Fraction
from multiprocessing import Pipe, active_children
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from pkm_exact.claim import Claim
from pkm_exact.cli.main import main
from pkm_exact.comparison import compare, worker
from pkm_exact.comparison.agreement import same_poses
from pkm_exact.comparison.measure import system_figures
from pkm_exact.comparison.row import ResultFigures, Row, Status, SystemFigures
from pkm_exact.comparison.worker import Outcome, run_apart
from pkm_exact.formulations.registry import formulation, formulation_codes
from pkm_exact.geometry.reader import read_robot
from pkm_exact.poses.pose import Interval, Pose

MODELS = Path(__file__).parent.parent / "models"
GENERAL = str(MODELS / "mourrain-l.toml")
PLANAR = str(MODELS / "similar-planar-s.toml")
Capture = pytest.CaptureFixture[str]

# Solutions for each complex pose, and for each real one on a robot whose mirror images have no real pose.
FIBRES = {"AFD1": 2, "AFD2": 2, "AFD5": 2, "AFD6": 2}


def rows_of(words: list[str], path: Path, code: int = 0) -> dict[str, dict[str, Any]]:
    assert main([*words, "--json", str(path)]) == code
    content = json.loads(path.read_text())
    assert list(content) == ["model", "configuration", "metric", "rows"]
    assert content["model"] == words[1]
    assert content["configuration"] in ("home", "forty")
    assert len({tuple(row) for row in content["rows"]}) <= 1
    return {row["code"]: row for row in content["rows"]}


@pytest.mark.parametrize(
    "codes",
    [
        pytest.param(formulation_codes(), id="all", marks=pytest.mark.slow),
        pytest.param(("SE3", "AFD3", "AFD1:zxz"), id="some"),
    ],
)
def test_formulations_on_the_planar_robot(codes: tuple[str, ...], tmp_path: Path, capsys: Capture) -> None:
    only = [] if codes == formulation_codes() else ["--only", ", ".join([*codes, codes[0]])]
    rows = rows_of(["formulations", PLANAR, *only], tmp_path / "rows.json")
    assert tuple(rows) == codes
    # A mirrored planar platform is the same robot: AFD3 meets it once more, AFP4 counts each of three joints twice.
    complex_fibres = {**FIBRES, "AFD3": 2, "AFP4": 8}
    real_fibres = {**FIBRES, "AFD3": 2}
    for name, row in rows.items():
        code = name.partition(":")[0]
        assert (row["status"], row["reason"], row["agrees"]) == ("done", None, True)
        assert row["complex_solutions"] == 16 * complex_fibres.get(code, 1)
        assert row["real_solutions"] == 8 * real_fibres.get(code, 1)
        assert row["real_poses"] == 8
        assert len(row["degrees"]) == row["equations"] >= row["unknowns"]
        assert min(row[key] for key in ("terms", "bytes", "coefficient_digits", "basis_elements", "primes")) > 0
        assert row["rur_bytes"] > 8 * 16
        assert sum(row["stages"].values()) == pytest.approx(row["seconds"], rel=0.2, abs=0.1)
    out = capsys.readouterr().out
    assert out.split("\n")[0] == "Similar planar S (6-UPS), configuration home"
    lines = [line.split() for line in out.split("\n")]
    assert ["AFD3", "12", "12", "2", "(12)"] in [line[:5] for line in lines]
    assert ["32", "16", "8", "yes"] in [line[-4:] for line in lines]


@pytest.mark.slow
@pytest.mark.parametrize(
    "counts", [{"AFD3": 80, "AFD1:zxz": 80}, {"AFP4:124": 320, "AFD1:zxz": 80}], ids=lambda counts: ",".join(counts)
)
def test_some_formulations_on_the_general_robot(counts: dict[str, int], tmp_path: Path) -> None:
    first, second = counts
    rows = rows_of(["formulations", GENERAL, "--only", f"{first}, {second},{first}"], tmp_path / "rows.json")
    assert {code: row["complex_solutions"] for code, row in rows.items()} == counts
    assert list(rows) == list(counts)
    assert [row["real_poses"] for row in rows.values()] == [4, 4]
    assert all(row["agrees"] for row in rows.values())
    assert rows["AFD1:zxz"]["real_solutions"] == 8


def test_a_formulation_that_takes_too_long_is_said(tmp_path: Path, capsys: Capture) -> None:
    words = ["formulations", GENERAL, "--only", "AFD2", "--timeout", "2"]
    (row,) = rows_of(words, tmp_path / "rows.json", 3).values()
    assert (row["code"], row["status"]) == ("AFD2", "timeout")
    assert row["reason"].startswith("it did not end within 2 seconds; it was at the stage: ")
    assert (row["complex_solutions"], row["agrees"], row["seconds"]) == (None, None, None)
    out = capsys.readouterr().out
    assert "timeout" in out
    assert f"\nAFD2: {row['reason']}\n" in out


def test_a_formulation_that_does_not_apply_is_said(collinear_model: Path, tmp_path: Path) -> None:
    words = ["formulations", str(collinear_model), "--only", "SE3,AFP1"]
    rows = rows_of(words, tmp_path / "rows.json", 3)
    assert (rows["AFP1"]["status"], rows["AFP1"]["unknowns"]) == ("not-applicable", None)
    assert "all platform joints lie on one line" in rows["AFP1"]["reason"]
    assert (rows["SE3"]["complex_solutions"], rows["SE3"]["real_poses"], rows["SE3"]["agrees"]) == (None, None, None)
    assert rows["SE3"]["reason"].startswith("its complex poses are infinitely many")


BAD_USAGE = [
    (["--only", "SE3,AFD99"], "--only: 'AFD99' is unknown; use one of SE3, AFD1"),
    (["--only", ""], "--only: '' is unknown"),
    (["--only", "SE3:1"], "--only: SE3 takes no option"),
    (["--only", "AFP1:122"], "'122' is no triple of legs"),
    (["--timeout", "0"], "--timeout: 0 is not positive"),
    (["--timeout", "nan"], "--timeout: nan is not a finite number"),
    (["--timeout", "1e9"], "--timeout: '1e9' is out of range"),
    (["--json", str(MODELS)], "is a directory; give --json the path of a file"),
    (["--configuration", "nowhere"], "'nowhere' is unknown"),
]


@pytest.mark.parametrize(("words", "part"), BAD_USAGE, ids=range(len(BAD_USAGE)))
def test_bad_usage_is_said_before_any_work(
    words: list[str], part: str, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    monkeypatch.setattr(compare, "run_apart", None)
    assert main(["formulations", GENERAL, *words]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert part in err


def box(x: str, width: str = "1/1000") -> Pose:
    side = Interval(Fraction(x), Fraction(x) + Fraction(width))
    still = Interval(Fraction(0), Fraction(0))
    return Pose(side, (side, still, still), ((still,) * 3,) * 3, (still,) * 4)


def test_boxes_decide_whether_poses_are_the_same() -> None:
    left = (box("0"), box("1"))
    assert same_poses(left, (box("1.0001"), box("-0.0001"))) is True
    assert same_poses(left, (box("0"),)) is False
    assert same_poses(left, (box("0"), box("1.002"))) is False
    assert same_poses(left, (box("0"), box("1"), box("1.0005"))) is None
    assert same_poses((), left) is False


def done(code: str, *poses: Pose) -> Outcome:
    count = len(poses)
    figures = ResultFigures(1, 1, 1, 1, count, count, count, Claim.COMPLETE, 1.0, 1.0, {}, 0.0, ())
    return Outcome(Row(code, Status.DONE, None, None, figures), poses)


def test_agreement_is_with_the_reference_only(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    answers = {
        "SE3": done("SE3", box("0")),
        "AFD4": done("AFD4", box("0.0001")),
        "AFD5": done("AFD5", box("1")),
        "AFD6": done("AFD6", box("0"), box("0.0001")),
        "AFP1": Outcome(Row("AFP1", Status.NO_ANSWER, "a limit was met")),
        "AFP2": Outcome(replace(done("AFP2").row), None),
    }
    monkeypatch.setattr(compare, "run_apart", lambda _, code, *__: answers[code])
    words = ["formulations", GENERAL, "--only"]
    assert rows_of([*words, "AFD4"], tmp_path / "rows.json")["AFD4"]["agrees"] is True
    rows = rows_of([*words, "SE3,AFD5,AFD6,AFP1,AFP2"], tmp_path / "rows.json", 3)
    assert [row["agrees"] for row in rows.values()] == [True, False, None, None, None]
    assert "too wide" in rows["AFD6"]["reason"]
    answers["SE3"] = answers["AFP1"]
    row = rows_of([*words, "AFD4"], tmp_path / "rows.json", 3)["AFD4"]
    assert row["agrees"] is None
    assert "nothing to compare with" in row["reason"]


def test_a_process_that_dies_is_no_answer() -> None:
    receiver, sender = Pipe(duplex=False)
    sender.send(SystemFigures(1, 1, (1,), 1, 1, 1))
    sender.send("Groebner basis")
    sender.close()
    dead = SimpleNamespace(exitcode=-9, join=lambda: None)
    row = worker._outcome(receiver, dead, "SE3", None, lambda _: None).row
    assert (row.status, row.result) == (Status.NO_ANSWER, None)
    assert row.reason == "its process ended with code -9 at the stage: Groebner basis"
    assert row.system is not None


def test_stages_are_told_and_nothing_is_left_running() -> None:
    robot = read_robot(PLANAR)
    stages: list[str] = []
    problem = robot.problem(robot.configuration().lengths_squared)
    outcome = run_apart(problem, "AFP3", None, stages.append)
    assert outcome.row.status is Status.DONE
    assert "AFP3: Groebner basis" in stages
    assert active_children() == []


def test_system_figures_are_of_the_printed_polynomials() -> None:
    robot = read_robot(PLANAR)
    problem = robot.problem(robot.configuration().lengths_squared)
    figures = system_figures(formulation("AFP3").formulate(problem).system)
    assert (figures.unknowns, figures.equations, sum(figures.degrees)) == (9, 9, 15)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("model", "real"), [("rolland-6-6", 16), pytest.param("dietmaier", 40, marks=pytest.mark.largest)]
)
def test_all_formulations_on_the_published_robots(model: str, real: int, tmp_path: Path) -> None:
    rows = rows_of(["formulations", str(MODELS / f"{model}.toml")], tmp_path / "rows.json")
    assert tuple(rows) == formulation_codes()
    for code, row in rows.items():
        assert row["agrees"]
        assert row["real_poses"] == real
        assert row["complex_solutions"] == 40 * {**FIBRES, "AFD3": 2, "AFP4": 8}.get(code, 1)
        assert row["seconds"] < 60
