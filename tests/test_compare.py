"""Numeric methods held against the certified poses, and the methods of ``solve``, through the command line."""

import csv
import io
import json
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from samples import shipped, solved

from pkm_exact.certify.check import check_bytes
from pkm_exact.claim import Claim
from pkm_exact.cli.main import main
from pkm_exact.comparison import numeric
from pkm_exact.comparison.numeric import WIDTH, compare_numeric
from pkm_exact.comparison.numeric_distance import Judge, Landing
from pkm_exact.constraints.distance import Distance
from pkm_exact.engine import solve
from pkm_exact.errors import PkmExactError
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.reader import read_robot
from pkm_exact.numeric.uncertified import UNCERTIFIED, Ending, NumericPose
from pkm_exact.poses.jacobian import characteristic_length
from pkm_exact.poses.pose import Interval, Pose

ROOT = Path(__file__).parent.parent
MODELS = ROOT / "models"
GENERAL = str(MODELS / "mourrain-l.toml")
ROLLAND = str(MODELS / "rolland-6-6.toml")
PLANAR = str(MODELS / "3-rpr-merlet-p.toml")
Capture = pytest.CaptureFixture[str]
TINY = Fraction(1, 10**40)


@pytest.fixture
def stays_empty(tmp_path: Path) -> Iterator[Path]:
    """A folder in which nothing may appear."""
    yield tmp_path
    assert list(tmp_path.iterdir()) == []


def numeric_pose(x: float, ending: Ending = Ending.CONVERGED) -> NumericPose:
    """The identity at (x, 0, 0)."""
    rows = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    return NumericPose(ending, (x, 0.0, 0.0), rows, (1.0, 0.0, 0.0, 0.0), 1, 0.0)


def certified_pose(x: Fraction, radius: Fraction = TINY) -> Pose:
    """A box around the identity at (x, 0, 0)."""

    def around(value: Fraction | int) -> Interval:
        return Interval(value - radius, value + radius)

    rotation = tuple(tuple(around(int(i == j)) for j in range(3)) for i in range(3))
    position = around(x), around(0), around(0)
    return Pose(around(x), position, rotation, (around(1), around(0), around(0), around(0)))


# Distances and what they decide


@given(seed=st.integers(0, 10**6))
def test_distances_contain_the_exact_ones(seed: int) -> None:
    random = Random(seed)
    problem = shipped("mourrain-l")
    rows = [[Fraction(random.randint(-9, 9), 8) for _ in range(4)] for _ in range(6)]
    point, box = rows[:3], rows[3:]
    pose = NumericPose(
        Ending.CONVERGED,
        tuple(float(row[3]) for row in point),
        tuple(tuple(float(x) for x in row[:3]) for row in point),
        (1.0, 0.0, 0.0, 0.0),
        0,
        0.0,
    )
    around = [[Interval(x - TINY, x + TINY) for x in row] for row in box]
    certified = Pose(
        None, tuple(row[3] for row in around), tuple(tuple(row[:3]) for row in around), (around[0][0],) * 4
    )
    change = [[a - b for a, b in zip(left, right, strict=True)] for left, right in zip(point, box, strict=True)]
    square = max(
        sum((row[3] + sum(entry * x for entry, x in zip(row, leg.platform, strict=False))) ** 2 for row in change)
        for leg in problem.distances
    )
    (distance,) = Judge(problem, [certified], Fraction(1)).distances(pose)
    assert distance.lo**2 <= square <= distance.hi**2
    assert distance.width < Fraction(1, 10**18)


def test_the_metric_enters_the_distance() -> None:
    problem = shipped("robocrane-r")
    turned = ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    pose = replace(numeric_pose(0.0), rotation=turned)
    (distance,) = Judge(problem, [certified_pose(Fraction(0))], Fraction(1)).distances(pose)
    furthest = max(leg.platform[0] ** 2 + 3 * leg.platform[1] ** 2 for leg in problem.distances)
    assert distance.lo**2 <= 2 * furthest <= distance.hi**2


def test_what_an_iteration_landed_on() -> None:
    problem = shipped("mourrain-l")
    judge = Judge(problem, [certified_pose(Fraction(x)) for x in (0, Fraction(1, 10**4), 5)], Fraction(1))
    judged = judge.judge(numeric_pose(5.0 + 2.0**-20))
    assert (judged.landing, judged.mode) == (Landing.MODE, 3)
    assert judged.error is not None
    assert judged.error.lo <= Fraction(1, 2**20) <= judged.error.hi
    assert judged.error.width < Fraction(1, 2**40)
    assert judge.judge(numeric_pose(1e-6)).mode == 1
    between = judge.judge(numeric_pose(5e-5))
    assert (between.landing, between.mode) == (Landing.BETWEEN, None)
    spurious = judge.judge(numeric_pose(2.0))
    assert (spurious.landing, spurious.mode) == (Landing.SPURIOUS, None)
    assert spurious.error is not None
    assert spurious.error.contains(2 - Fraction(1, 10**4))
    assert judge.judge(numeric_pose(5.0, Ending.STAGNATED)).landing is Landing.NONE
    assert judge.judge(numeric_pose(5.002)).landing is Landing.SPURIOUS
    wide = Judge(problem, [certified_pose(Fraction(5), Fraction(1))], Fraction(1))
    assert wide.judge(numeric_pose(5.0)).landing is Landing.BETWEEN
    assert Judge(problem, [], Fraction(1)).judge(numeric_pose(5.0)).landing is Landing.SPURIOUS


def test_the_order_of_the_certified_poses_only_renames_the_modes() -> None:
    problem, poses = shipped("3-rrr"), solve(shipped("3-rrr"), width=WIDTH).poses
    limits = compare_numeric(problem, starts=20).results[1].poses
    for shift in range(len(poses)):
        judge = Judge(problem, [*poses[shift:], *poses[:shift]], characteristic_length(problem))
        modes = [judge.judge(limit).mode for limit in limits]
        assert [(mode + shift - 1) % len(poses) + 1 for mode in modes if mode] == [
            mode for mode in _modes(problem, poses, limits) if mode
        ]


def _modes(problem: ForwardProblem, poses: tuple[Pose, ...], limits: tuple[NumericPose, ...]) -> list[int | None]:
    judge = Judge(problem, poses, characteristic_length(problem))
    return [judge.judge(limit).mode for limit in limits]


# The comparison


@pytest.mark.parametrize(
    "name", ["rolland-6-6", pytest.param("robocrane-r", marks=pytest.mark.slow), "3-rrr", "3-rpr-merlet-p"]
)
def test_enough_starts_find_every_pose(name: str) -> None:
    comparison = compare_numeric(shipped(name), starts=150)
    total = len(solved(name).poses)
    size = characteristic_length(shipped(name))
    for result in comparison.results:
        assert result.count(Landing.SPURIOUS) == result.count(Landing.BETWEEN) == 0
        assert sum(result.hits.values()) == sum(pose.converged for pose in result.poses)
        assert sum(result.endings.values()) == result.starts
        assert all(error.hi < size / 10**9 for error in result.errors())
        if result.starts > 1:
            assert len(result.hits) == total
            assert comparison.missed(result) == ()
    home, newton, descent, paths = comparison.results
    assert (home.starts, newton.starts, descent.starts) == (1, 150, 150)
    assert paths.starts == (6 if name.startswith("3-r") else 40)
    assert str(comparison).startswith(f"of {total} certified poses: newton, home 1, newton {total}")


def test_one_start_misses_most() -> None:
    comparison = compare_numeric(shipped("rolland-6-6"), starts=1, solution=solve(shipped("rolland-6-6"), width=WIDTH))
    newton = comparison.results[1]
    assert len(comparison.missed(newton)) == 15
    assert set(newton.hits).isdisjoint(comparison.missed(newton))


def near_double(step: Fraction) -> ForwardProblem:
    """A planar robot at a singularity, one squared length changed."""
    problem = shipped("3-rpr-double-q")
    first, *others = problem.distances
    return replace(problem, constraints=(Distance(first.base, first.platform, first.length_squared + step), *others))


def test_no_pose_is_there_but_iterations_converge() -> None:
    comparison = compare_numeric(near_double(Fraction(-1, 10**14)), starts=10)
    assert comparison.solution.claim is Claim.COMPLETE
    assert comparison.solution.poses == ()
    for result in comparison.results:
        assert result.count(Landing.SPURIOUS) >= 1
        assert result.hits == {}
        assert result.errors() == ()


def test_two_poses_that_doubles_do_not_tell_apart() -> None:
    comparison = compare_numeric(near_double(Fraction(1, 10**14)), starts=10)
    assert len(comparison.solution.poses) == 2
    assert all(result.count(Landing.BETWEEN) >= 1 for result in comparison.results)
    assert all(comparison.missed(result) == (1, 2) for result in comparison.results)


def test_a_seed_gives_the_same_ends() -> None:
    same = [compare_numeric(shipped("3-rrr"), starts=5, seed=seed) for seed in (1, 1, 2)]
    assert same[0] == same[1]
    assert same[0].results[1] != same[2].results[1]


# The command compare


def compared(words: list[str], path: Path, code: int = 0) -> dict[str, Any]:
    assert main(["compare", *words, "--json", str(path)]) == code
    content: dict[str, Any] = json.loads(path.read_text())
    return content


def test_compare_prints_methods_and_modes(capsys: Capture) -> None:
    assert main(["compare", PLANAR, "--starts", "30"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    lines = out.split("\n")
    assert lines[0] == "Merlet 3-RPR (3-RPR), configuration home; random starts: seed 20081125"
    assert lines[1].startswith("certified: 6 complex solutions, 2 real poses; complete: ")
    cells = {" ".join(line.split()[:2]): line.split() for line in lines}
    assert cells["newton 30"][1:7] == ["30", "30", "2", "0", "0", "0"]
    assert cells["newton, home"][2:8] == ["1", "1", "1", "1", "0", "0"]
    assert cells["path tracking"][2:8] == ["6", "2", "2", "0", "0", "0"]
    assert cells["2 5"][:4] == ["2", "5", "5", "0"]
    assert "path tracking: not converged: not real 4" in lines


def test_compare_writes_where_every_start_ended(tmp_path: Path, capsys: Capture) -> None:
    content = compared([GENERAL, "--configuration", "home", "--starts", "40"], tmp_path / "rows.json")
    assert (content["claim"], content["real_poses"], content["starts"]) == ("complete", 4, 40)
    assert content["configuration"]["lengths_squared"] == ["1", "1", "16/25", "4", "4", "4"]
    assert [len(pose["position"]) for pose in content["poses"]] == [3] * 4
    home, newton, descent, paths = content["engines"]
    assert (home["starts"], newton["starts"], descent["starts"], paths["starts"]) == (1, 40, 40, 40)
    assert home["endings"] == {"stagnated": 1}
    assert home["missed"] == [1, 2, 3, 4]
    assert paths["endings"] == {"not real": 36, "converged": 4}
    for engine in content["engines"]:
        assert sum(engine["landings"].values()) == len(engine["limits"])
        assert sum(engine["hits"].values()) == engine["landings"]["mode"]
        for limit in engine["limits"]:
            assert (limit["mode"] is not None) == (limit["landing"] == "mode")
            if limit["mode"] is not None:
                low, high = map(Fraction, limit["error"])
                assert 0 <= low <= high < Fraction(1, 10**9)
    again = compared([GENERAL, "--lengths", "1,1,0.8,2,2,2", "--starts", "40"], tmp_path / "again.json")
    assert again["configuration"]["name"] is None
    for left, right in zip(content["engines"], again["engines"], strict=True):
        assert left["limits"] == right["limits"]
    assert "given leg lengths" in capsys.readouterr().out


def test_a_robot_without_real_poses_is_compared_too(capsys: Capture) -> None:
    assert main(["compare", PLANAR, "--lengths", "1,1,1", "--starts", "5"]) == 0
    out = capsys.readouterr().out
    assert "0 real poses; complete" in out
    assert "certified poses (assembly modes)" not in out


def test_compare_of_a_list_that_is_not_complete_has_exit_code_3(
    monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    weaker = replace(solved("3-rpr-merlet-p"), claim=Claim.NOT_PROVEN_COMPLETE, completeness=None, notes=("open",))
    monkeypatch.setattr(numeric, "solve", lambda *_, **__: weaker)
    assert main(["compare", PLANAR, "--starts", "5"]) == 3
    assert "note: open" in capsys.readouterr().out


def test_infinitely_many_poses_are_not_compared(collinear_model: Path, capsys: Capture) -> None:
    assert main(["compare", str(collinear_model)]) == 3
    out, err = capsys.readouterr()
    assert err == ""
    *_, last = out.splitlines()
    assert last.startswith("nothing was compared: the robot has no list of poses to compare with: its complex poses")


BAD_USAGE = [
    (["compare"], "missing argument 'MODEL'"),
    (["compare", "missing.toml"], "missing.toml: no such file"),
    (["compare", GENERAL, "--starts", "0"], "--starts: 0 is out of range; give a whole number from 1 to"),
    (["compare", GENERAL, "--starts", "10001"], "--starts: 10001 is out of range"),
    (["compare", GENERAL, "--starts", "ten"], "--starts: 'ten' is not a whole number; give one from 1 to"),
    (["compare", GENERAL, "--configuration", "nowhere"], "'nowhere' is unknown; use one of: home"),
    (["compare", GENERAL, "--lengths", "1,1,1"], "3 values; give 6"),
    (["compare", GENERAL, "--lengths", "1,1,1,1,1,1", "--configuration", "home"], "exclude each other"),
    (["compare", GENERAL, "--lengths", ",".join(["1" * 150] * 6)], "out of reach of floating point"),
    (["compare", GENERAL, "--json", str(ROOT)], "is a directory; give --json the path of a file"),
    (["compare", GENERAL, "--json", str(ROOT / "nowhere" / "c.json")], "does not exist; create it"),
    (["compare", GENERAL, "--json", GENERAL], "is the model file itself"),
    (["solve", GENERAL, "--method", "guess"], "'guess' is not one of 'exact', 'krawczyk', 'newton'"),
    (["solve", GENERAL, "--start", "0,0,1,1,0,0,0"], "--start: belongs to the method newton; leave it out"),
    (["solve", GENERAL, "--method", "krawczyk", "--start", "0,0,1,1,0,0,0"], "--start: belongs to the method newton"),
    (["solve", GENERAL, "--method", "krawczyk", "--formulation", "SE3"], "--formulation: belongs to the method exact"),
    (["solve", GENERAL, "--method", "newton", "--formulation", "AFD4"], "--formulation: belongs to the method exact"),
    (["solve", GENERAL, "--method", "newton", "--width", "1e-9"], "--width: a pose of the method newton is a point"),
    (["solve", GENERAL, "--method", "newton", "--time-limit", "1"], "--time-limit: belongs to the methods exact and"),
    (["solve", GENERAL, "--method", "newton", "-o", "c.json"], "-o: a pose of the method newton is uncertified"),
    (["solve", GENERAL, "--method", "newton", "--start", "0,0,1,1"], "--start: 4 numbers given, seven are needed"),
    (
        ["solve", GENERAL, "--method", "newton", "--start", "0,0,90"],
        "3 numbers, but the robot is not planar; give X,Y,Z",
    ),
    (
        ["solve", PLANAR, "--method", "newton", "--start", "0,0,1,1,0,0,0"],
        "7 numbers, but the robot is planar; give X",
    ),
    (["solve", GENERAL, "--method", "newton", "--start", "0,0,1,1,0,0,nan"], "--start, number 7: nan is not a finite"),
    (["solve", GENERAL, "--method", "newton", "--start", "0,0,1,0,0,0,0"], "all four numbers of the quaternion are 0"),
    (["solve", GENERAL, "--method", "newton", "--start", "0,0,1e99,1,0,0,0"], "over a million times the robot's size"),
    (["solve", GENERAL, "--time-limit", "0"], "--time-limit: 0 is not positive"),
    (["solve", GENERAL, "--time-limit", "soon"], "--time-limit: soon is not a number"),
    (["solve", GENERAL, "--time-limit", "1e9"], "--time-limit: '1e9' is out of range"),
    (["solve", GENERAL, "--time-limit", "1", "--lengths", ",".join(["1" * 150] * 6)], "out of reach of floating point"),
]


@pytest.mark.parametrize(("words", "part"), BAD_USAGE, ids=range(len(BAD_USAGE)))
def test_bad_usage_gives_one_sentence_and_exit_code_2(words: list[str], part: str, capsys: Capture) -> None:
    model = Path(GENERAL).read_text()
    assert main(words) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert err.startswith("certify-poses: error: ")
    assert part in err
    assert Path(GENERAL).read_text() == model


# The methods of solve


def test_newton_prints_one_uncertified_pose(capsys: Capture) -> None:
    assert main(["solve", ROLLAND, "--method", "newton", "-v"]) == 3
    out, err = capsys.readouterr()
    assert err == ""
    lines = out.split("\n")
    assert lines[0] == "Rolland 6-6 (6-UPS), configuration home, method newton"
    assert lines[1].startswith("1 pose found; uncertified: nothing is proved")
    assert any(line.startswith("note: started from the home pose (") for line in lines)
    assert any(line.startswith("squared leg lengths: 1562500, ") for line in lines)
    assert lines[-2].split()[:4] == ["1", "0.138694238644", "-0.237038690703", "770.552445789"]


def test_the_start_chooses_the_pose(capsys: Capture) -> None:
    heights = []
    for height in ("800", "-1600"):
        words = ["solve", ROLLAND, "--method", "newton", "--start", f"0,0,{height},1,0,0,0", "--format", "json"]
        assert main(words) == 3
        answer = json.loads(capsys.readouterr().out)
        assert (answer["method"], answer["claim"], answer["real_poses"]) == ("newton", "uncertified", 1)
        assert "completeness_route" not in answer
        (pose,) = answer["poses"]
        assert pose["residual"] < 1e-9
        assert [len(row) for row in pose["rotation"]] == [3, 3, 3]
        heights.append(pose["position"][2])
    assert heights == pytest.approx([770.552445789, -1600.692375481])


@pytest.mark.parametrize("angle", ["0", "360", "-1/2"])
def test_a_planar_start_has_an_angle(angle: str, capsys: Capture) -> None:
    words = ["solve", PLANAR, "--method", "newton", "--start", f"5,4.9,{angle}"]
    assert main([*words, "--format", "csv"]) == 3
    (row,) = csv.DictReader(io.StringIO(capsys.readouterr().out))
    assert row["claim"] == "uncertified"
    assert [float(row[name]) for name in ("x", "y", "r11")] == pytest.approx([5, 5, 1])
    assert main(words) == 3
    out = capsys.readouterr().out
    assert out.split("\n")[-3].split() == ["x", "y", "theta", "residual", "iterations"]


def test_newton_that_does_not_converge_is_no_answer(capsys: Capture) -> None:
    assert main(["solve", GENERAL, "--method", "newton"]) == 4
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert "no answer: Newton's method does not converge from the home pose (stagnated; iterations: " in err


def test_over_the_time_limit_the_answer_is_uncertified(stays_empty: Path, capsys: Capture) -> None:
    words = ["solve", GENERAL, "--time-limit", "1/100", "-o", str(stays_empty / "cert.json")]
    assert main(words) == 3
    out, err = capsys.readouterr()
    lines = out.split("\n")
    assert lines[0].endswith("method levenberg-marquardt")
    assert lines[1].startswith("4 poses found; uncertified: ")
    assert lines[2].startswith("note: the certified engine did not end within the time limit of 0.01 seconds")
    assert err == f"certify-poses: no certificate written to {stays_empty / 'cert.json'}: the poses are uncertified\n"
    assert main([*words, "--format", "json"]) == 3
    answer = json.loads(capsys.readouterr().out)
    assert (answer["claim"], answer["real_poses"], len(answer["notes"])) == ("uncertified", 4, 2)


@pytest.mark.parametrize("method", ["exact", "krawczyk"])
def test_within_the_time_limit_nothing_changes(method: str, tmp_path: Path, capsys: Capture) -> None:
    printed, written = [], []
    for number, limit in enumerate(([], ["--time-limit", "300"])):
        path = tmp_path / f"{number}.json"
        assert main(["solve", PLANAR, "--method", method, "-o", str(path), *limit]) == 0
        printed.append(capsys.readouterr())
        written.append(path.read_bytes())
    assert printed[0] == printed[1]
    assert written[0] == written[1]


def test_methods_agree_on_the_poses(capsys: Capture) -> None:
    answers = []
    for method in ("exact", "krawczyk"):
        assert main(["solve", GENERAL, "--method", method, "--format", "json"]) == 0
        answers.append(json.loads(capsys.readouterr().out))
    assert [answer["method"] for answer in answers] == ["exact", "krawczyk"]
    boxes = [[(pose["position"], pose["rotation"]) for pose in answer["poses"]] for answer in answers]
    assert boxes[0] == boxes[1]


def test_no_certificate_may_say_uncertified(tmp_path: Path) -> None:
    assert UNCERTIFIED not in list(Claim)
    document = json.loads((ROOT / "certs" / "3-rpr-merlet-p.json").read_text())
    assert document["claim"] == "complete"
    document["claim"] = UNCERTIFIED
    assert check_bytes(json.dumps(document).encode()).status != "accepted"


def test_an_uncertified_solution_cannot_become_a_certificate() -> None:
    from pkm_exact.certify.build import certificate
    from pkm_exact.numeric.newton_iteration import solve_newton

    with pytest.raises((AttributeError, TypeError, PkmExactError)):
        certificate(read_robot(ROLLAND), "home", solve_newton(shipped("rolland-6-6")))  # type: ignore[arg-type]
