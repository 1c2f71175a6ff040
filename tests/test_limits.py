"""Limits: read from model files, compared with certified poses, and shown wherever poses are."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from fractions import Fraction
from math import acos, degrees
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from samples import MODELS, model, shipped, solved

from pkm_exact import InputError, Mechanism, Robot
from pkm_exact.cli.main import main
from pkm_exact.geometry.limits import Cones, Limits
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.poses.limit_checks import LimitVerdict, limit_verdicts, nearest_shares
from pkm_exact.poses.pose import Interval, Pose

Capture = pytest.CaptureFixture[str]
FILES = {path.stem: path for path in MODELS}
LIMITS = """
[limits]
lengths = [[4, 8], [4, 8], [1, 6]]
base_cones = { axes = [[1, 1], [0, 1], [0, -1]], angle = 60 }
platform_cones = { axes = [[-1, -1], [0, -1], [0, 1]], angle = 60 }
position = [[0, 6], [0, 11]]
"""


def limited(name: str, table: str) -> str:
    """The text of a shipped model with a table of limits."""
    return FILES[name].read_text().replace("[[configurations]]", table + "\n[[configurations]]", 1)


@pytest.fixture
def planar(tmp_path: Path) -> Path:
    path = tmp_path / "limited.toml"
    path.write_text(limited("3-rpr-merlet-p", LIMITS))
    return path


@pytest.mark.parametrize(
    ("name", "line", "said"),
    [
        ("3-rpr-merlet-p", "", "is empty"),
        ("3-rpr-merlet-p", "length = [1, 2]", "unknown key 'length'"),
        ("3-rpr-merlet-p", "lengths = 3", "limits.lengths: 3 is not a list"),
        ("3-rpr-merlet-p", "lengths = [3]", "limits.lengths: a list of 1 is not a pair"),
        ("3-rpr-merlet-p", "lengths = [[1, 2], [1, 2]]", "limits.lengths: 2 pairs; give one for all, or 3"),
        ("3-rpr-merlet-p", "lengths = [2, 1]", "2 is greater than 1"),
        ("3-rpr-merlet-p", "lengths = [-1, 1]", "-1 is negative"),
        ("3-rpr-merlet-p", "slides = [0, 1]", "limits.slides: the robot has no actuated slide"),
        ("3-rpr-merlet-p", "angles = [0, 1]", "limits.angles: the robot has no actuated crank angle"),
        ("3-rpr-merlet-p", "leg_distance = 1", "parallel planes"),
        ("3-rpr-merlet-p", "position = [[0, 1]]", "limits.position: 1 pairs; give 2"),
        ("3-rpr-merlet-p", "base_cones = 30", "limits.base_cones: 30 is not a table"),
        ("3-rpr-merlet-p", "base_cones = { axes = [0, 0], angle = 9 }", "axes[1]: is 0"),
        ("3-rpr-merlet-p", "base_cones = { axes = [0, 1], angle = 181 }", "181 is out of range"),
        ("3-rpr-merlet-p", "base_cones = { axes = [0, 1], angle = [9, 9] }", "2 angles; give one for all, or 3"),
        ("3-rpr-merlet-p", "base_cones = { axes = [0, 1, 2], angle = 9 }", "a list of 3; give a list of 2"),
        (
            "3-rpr-merlet-p",
            "base_cones = { axes = [[0, 1]], angle = 9 }",
            "1 vector; give 3, or one for all without the outer brackets, as [0, 1]",
        ),
        ("3-rrr", "base_cones = { axes = [0, 1], angle = 9 }", "the rods stand on cranks"),
        ("mssm", "leg_distance = 0", "0 is not positive"),
        ("delta", "lengths = [1, 2]", "limits.lengths: the robot has no actuated leg length"),
    ],
)
def test_what_is_no_limit_of_the_robot_is_refused_in_one_sentence(name: str, line: str, said: str) -> None:
    text = limited(name, f"[limits]\n{line}\n") if name != "delta" else FILES[name].read_text() + f"[limits]\n{line}\n"
    with pytest.raises(InputError) as error:
        robot_from_toml(text)
    assert said in str(error.value)


def test_one_pair_and_one_axis_are_those_of_all() -> None:
    table = '[limits]\nlengths = [1, "9/2"]\nplatform_cones = { axes = [0, 1], angle = [10, 20, "45/2"] }\n'
    limits = robot_from_toml(limited("3-rpr-merlet-p", table)).limits
    assert limits is not None
    assert limits.lengths == ((Fraction(1), Fraction(9, 2)),) * 3
    assert limits.platform_cones == Cones(
        ((Fraction(0), Fraction(1), Fraction(0)),) * 3, (Fraction(10), Fraction(20), Fraction(45, 2))
    )


def verdicts(name: str, limits: Limits) -> list[dict[str, LimitVerdict]]:
    robot = replace(model(name), limits=limits)
    return limit_verdicts(robot, robot.configuration(), shipped(name), solved(name).poses)


def _legs(name: str, pose: Pose) -> list[tuple[Any, Any]]:
    """Both ends of every leg, in floating point and ordinary coordinates."""
    problem = shipped(name)
    axes = np.sqrt(np.array(problem.metric, dtype=float))
    c, r = (np.array([float(x) for x in pose.position]), np.array([[float(x) for x in row] for row in pose.rotation]))
    return [
        (np.array(leg.base, dtype=float) * axes, c + r @ (np.array(leg.platform, dtype=float) * axes))
        for leg in problem.distances
    ]


@pytest.mark.parametrize("name", ["3-rpr-merlet-p", "mssm", "robocrane-r"])
def test_cones_agree_with_angles_in_floating_point(name: str) -> None:
    """Just above the greatest angle of a side all legs are in their cones, just below it one is not."""
    axis = np.array([0.0, 1.0, 0.0])
    exact = (Fraction(0), Fraction(1), Fraction(0))
    count = len(shipped(name).distances)
    for place, pose in enumerate(solved(name).poses):
        rotation = np.array([[float(x) for x in row] for row in pose.rotation])
        for key, towards, direction in (("base_cones", 1, axis), ("platform_cones", -1, rotation @ axis)):
            legs = [towards * (tip - foot) for foot, tip in _legs(name, pose)]
            greatest = max(degrees(acos(direction @ leg / np.linalg.norm(leg))) for leg in legs)
            for change, verdict in ((1e-3, "yes"), (-1e-3, "no")):
                angle = Fraction(min(180.0, greatest + change)).limit_denominator(10**6)
                limits = Limits(**{key: Cones((exact,) * count, (angle,) * count)})
                assert verdicts(name, limits)[place] == {key: verdict}


def test_the_distance_of_legs_is_that_of_segments() -> None:
    """The least distance over many points of two segments is hardly less than what is decided."""
    name = "robocrane-r"
    pose = solved(name).poses[0]
    legs, shares = _legs(name, pose), np.linspace(0, 1, 201)
    problem, least = shipped(name), np.inf
    for i, (a, b) in enumerate(legs):
        for j, (c, d) in enumerate(legs[:i]):
            one, other = problem.distances[i], problem.distances[j]
            if one.base != other.base and one.platform != other.platform:
                first, second = a + np.outer(shares, b - a), c + np.outer(shares, d - c)
                least = min(least, np.linalg.norm(first[:, None] - second[None], axis=2).min())
    below, above = Fraction(least * 0.97).limit_denominator(1000), Fraction(least * 1.001).limit_denominator(1000)
    assert verdicts(name, Limits(leg_distance=below))[0] == {"leg_distance": "yes"}
    assert verdicts(name, Limits(leg_distance=above))[0] == {"leg_distance": "no"}


def test_nearest_points_of_random_segments() -> None:
    random = Random(5)
    for _ in range(40):
        a, b, c, d = (np.array([random.uniform(-1, 1) for _ in range(3)]) for _ in range(4))
        s, t = nearest_shares((a, b), (c, d)) or (0.0, 0.0)
        found = np.linalg.norm(a + s * (b - a) - c - t * (d - c))
        near = [min(1, max(0, s + e)) for e in (-0.02, 0, 0.02)], [min(1, max(0, t + e)) for e in (-0.02, 0, 0.02)]
        assert all(np.linalg.norm(a + u * (b - a) - c - v * (d - c)) >= found - 1e-12 for u in near[0] for v in near[1])


@pytest.mark.parametrize(
    ("pair", "verdict"),
    [
        ((0, 90), "yes"),
        ((90, 180), "yes"),
        ((91, 180), "no"),
        ((-10, 80), "no"),
        ((450, 450), "yes"),
        ((270, 270), "no"),
        ((-90, 90), "yes"),
        ((180, 300), "no"),
        ((100, 440), "no"),
        ((100, 450), "yes"),
        ((0, 360), "yes"),
        ((-80, 100), "yes"),
        ((100, 280), "no"),
    ],
)
def test_angles_of_cranks_are_compared_exactly_whole_turns_aside(pair: tuple[int, int], verdict: str) -> None:
    robot = model("3-rrr")
    upright = robot.lock("upright", [(Fraction(0), Fraction(1))] * 3)
    found = replace(robot, limits=Limits(angles=((Fraction(pair[0]), Fraction(pair[1])),) * 3))
    assert limit_verdicts(found, upright, robot.problem(upright), solved("3-rrr").poses[:1]) == [{"angles": verdict}]


def test_rods_whose_slides_meet_do_not_share_a_joint() -> None:
    """Rods 1 and 2 on one guide, at one place: they touch there."""
    robot = model("inclined-slides")
    assert robot.chains is not None
    twice = replace(
        robot,
        base_joints=(robot.base_joints[0], *robot.base_joints[:1], *robot.base_joints[2:]),
        chains=(robot.chains[0], *robot.chains[:1], *robot.chains[2:]),
        configurations=(),
        limits=Limits(leg_distance=Fraction(1, 10**6)),
    )
    one, zero, high = (Interval(Fraction(x), Fraction(x)) for x in (1, 0, "1/4"))
    pose = Pose(None, (zero, zero, high), ((one, zero, zero), (zero, one, zero), (zero, zero, one)), (one, *[zero] * 3))
    for places, verdict in (
        ([Fraction(1, 8)] * 6, "no"),
        ([Fraction(1, 8), Fraction(1, 6), *[Fraction(1, 8)] * 4], "yes"),
    ):
        locked = twice.lock("there", places)
        assert limit_verdicts(twice, locked, twice.problem(locked), [pose]) == [{"leg_distance": verdict}]


def test_slides_of_robots_and_lengths_of_mechanisms_are_compared_exactly() -> None:
    slides = model("3-prr").configuration().joint_values
    pairs = tuple((value, value) for value in slides)
    assert verdicts("3-prr", Limits(slides=pairs))[0] == {"slides": "yes"}
    assert verdicts("3-prr", Limits(slides=((slides[0] + 1, slides[0] + 2), *pairs[1:])))[0] == {"slides": "no"}
    mechanism = robot_from_toml(limited("3-rps", "[limits]\nlengths = [1, 2]\n"))
    problem = mechanism.problem_at([Fraction(3, 2), Fraction(3, 2), Fraction(2)])
    origin = Interval(Fraction(0), Fraction(0))
    pose = Pose(None, (origin,) * 3, ((origin,) * 3,) * 3, (origin,) * 4)
    assert limit_verdicts(mechanism, None, problem, [pose]) == [{"lengths": "yes"}]
    assert limit_verdicts(mechanism, None, mechanism.problem_at([Fraction(3)] * 3), [pose]) == [{"lengths": "no"}]


def test_a_limit_that_the_box_meets_is_undecided(planar: Path) -> None:
    robot = Robot.load(planar)
    solution = robot.solve()
    assert robot.limits is not None
    on = replace(robot, limits=replace(robot.limits, position=((Fraction(0), Fraction(5)), (Fraction(0), Fraction(9)))))
    pose = solution.poses[1]
    wide = replace(pose, position=(Interval(Fraction(4), Fraction(6)), *pose.position[1:]))
    (found,) = limit_verdicts(on, None, solution.problem, [wide])
    assert found["position"] == "undecided"
    assert found["lengths"] == "yes"


def test_solve_says_at_each_pose_which_limits_hold(planar: Path, capsys: Capture) -> None:
    assert main(["solve", str(planar)]) == 0
    table = capsys.readouterr().out.splitlines()
    assert table[-3].split()[-1] == "limits"
    assert [line.split()[7:] for line in table[-2:]] == [["no", "(platform_cones)"], ["yes"]]
    assert main(["solve", str(planar), "--format", "json"]) == 0
    content = json.loads(capsys.readouterr().out)
    assert [(pose["number"], pose["feasible"]) for pose in content["poses"]] == [(1, "no"), (2, "yes")]
    assert content["poses"][0]["limits"] == {
        "lengths": "yes",
        "base_cones": "yes",
        "platform_cones": "no",
        "position": "yes",
    }
    assert main(["solve", str(planar), "--format", "csv"]) == 0
    rows = list(csv.DictReader(capsys.readouterr().out.splitlines()))
    assert [row["limit_platform_cones"] for row in rows] == ["no", "yes"]


def test_only_feasible_poses_are_listed_on_demand(planar: Path, capsys: Capture) -> None:
    assert main(["solve", str(planar), "--feasible"]) == 0
    out = capsys.readouterr().out
    assert "note: not listed: 1 pose that breaks a limit" in out
    assert "assembly modes: 1 pose with det J > 0 (2)\n" in out
    assert out.splitlines()[-1].split()[0] == "2"
    assert main(["solve", str(planar), "--feasible", "--format", "json"]) == 0
    content = json.loads(capsys.readouterr().out)
    assert ([pose["number"] for pose in content["poses"]], content["real_poses"]) == ([2], 2)
    assert main(["solve", str(FILES["3-rpr-merlet-p"]), "--feasible"]) == 2
    assert "the model has no limits" in capsys.readouterr().err


def test_track_says_it_at_every_row(planar: Path, tmp_path: Path) -> None:
    path = tmp_path / "path.csv"
    path.write_text("l1,l2,l3\n7.1,5.1,5\n8.1,5.1,5\n")
    for suffix in ("json", "csv"):
        assert main(["track", str(planar), str(path), "--start", "2", "-o", str(tmp_path / f"out.{suffix}")]) == 0
    samples = json.loads((tmp_path / "out.json").read_text())["samples"]
    rows = list(csv.DictReader((tmp_path / "out.csv").read_text().splitlines()))
    assert [sample["limits"]["lengths"] for sample in samples] == ["yes", "no"]
    assert [row["limit_lengths"] for row in rows] == ["yes", "no"]
    assert [row["feasible"] for row in rows] == [sample["feasible"] for sample in samples]


def test_report_and_plot_say_it_with_the_model(planar: Path, tmp_path: Path, capsys: Capture) -> None:
    certificate = tmp_path / "certificate.json"
    assert main(["solve", str(planar), "-o", str(certificate)]) == 0
    page = tmp_path / "page.html"
    assert main(["report", str(certificate), "--model", str(planar), "-o", str(page)]) == 0
    assert '"limits of the model kept","no (platform_cones)"' in page.read_text()
    pytest.importorskip("matplotlib")
    picture = tmp_path / "picture.svg"
    assert main(["plot", str(certificate), "--model", str(planar), "-o", str(picture)]) == 0
    assert picture.stat().st_size > 0
    assert main(["plot", str(certificate), "-o", str(picture), "--model", str(FILES["delta"])]) == 2


def test_a_mechanism_is_recognised_by_its_certificate(tmp_path: Path, capsys: Capture) -> None:
    path, certificate, page = tmp_path / "delta.toml", tmp_path / "delta.json", tmp_path / "page.html"
    path.write_text(
        FILES["delta"].read_text() + "\n[limits]\nleg_distance = '1/100'\nposition = [[-1, 1], [-1, 1], [-9, 0]]\n"
    )
    assert Mechanism.load(path).limits is not None
    assert main(["solve", str(path), "-o", str(certificate)]) == 0
    assert main(["report", str(certificate), "--model", str(path), "-o", str(page)]) == 0
    assert '"limits of the model kept","yes"' in page.read_text()
    path.write_text(FILES["h4"].read_text())
    assert main(["report", str(certificate), "--model", str(path), "-o", str(page)]) == 2
    assert "the certificate is not one of the model" in capsys.readouterr().err


def test_an_answer_knows_the_limits_of_its_robot(planar: Path) -> None:
    solution = Robot.load(planar).solve()
    assert [{str(v) for v in found.values()} for found in solution.limits()] == [{"yes", "no"}, {"yes"}]
