"""Tolerances: boxes that hold for every robot, against sampled robots, worst cases, and tampered certificates."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import product
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from budgets import budget
from certificate_tools import at, both, both_resealed, check_resealed, last_line, tolerant_certificate, with_entry
from flint import arb, arb_mat
from hypothesis import given
from hypothesis import strategies as st
from samples import MODELS, boxed, random_placed, shipped, solved, tolerant
from tolerance_tools import errors_of, exact_robot, poses_near, robots_with

from pkm_exact import InputError, read_robot, solve
from pkm_exact.certify.build import canonical_bytes
from pkm_exact.certify.check import check_bytes
from pkm_exact.certify.tolerance_build import tolerance_certificate
from pkm_exact.cli.main import main
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.numeric.centred import centred_robot
from pkm_exact.numeric.data_errors import data_errors
from pkm_exact.numeric.krawczyk_operator import around_zero, contraction
from pkm_exact.numeric.linearisation import sum_of_powers
from pkm_exact.numeric.nominal import certified_pose
from pkm_exact.numeric.tolerance import tolerance_boxes
from pkm_exact.numeric.tolerance_result import ToleranceResult
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.precision import working_precision
from pkm_exact.solution import Solution

ROLLAND = MODELS[[path.stem for path in MODELS].index("rolland-6-6")]
PLANAR = MODELS[[path.stem for path in MODELS].index("3-rrr")]
NEGLIGIBLE = 1e-10
"""Rounding errors of the sampled poses, in times the size of a robot."""


def require_samples_inside(result: ToleranceResult, solution: Solution, count: int, seed: int) -> None:
    """Sampled robots have their poses in the boxes, at distances within the greatest errors."""
    robots = robots_with(result.problem, result.tolerances, errors_of(result.problem, count, seed))
    slack = NEGLIGIBLE * float(np.abs(robots.lengths).max())
    for box, pose in zip(result.boxes, solution.poses, strict=True):
        if box.bounds is None:
            continue
        found = poses_near(robots, pose)
        found = np.concatenate([found, _centroids(result, found)], axis=1)
        low = np.array([float(bound.lo) for bound in box.bounds.components])
        high = np.array([float(bound.hi) for bound in box.bounds.components])
        assert ((low - slack <= found) & (found <= high + slack)).all()
        nominal = np.array([float(x.midpoint) for x in pose.position])
        distances = np.linalg.norm(found[:, :3] - nominal, axis=1)
        assert distances.max() <= float(box.bounds.position_error.hi) + slack


def _centroids(result: ToleranceResult, poses: Any) -> Any:
    """Positions of the centroid of the nominal platform joints."""
    middle = np.array([float(x) for x in result.frames.platform]) * np.sqrt(result.problem.metric)
    return poses[:, :3] + poses[:, 3:12].reshape(-1, 3, 3) @ middle


def test_what_is_proved_for_a_tolerance_is_proved_for_less() -> None:
    solution = solved("rolland-6-6")
    for tolerance in ("0.01", "0.008", "0.006", "0.003"):
        result = tolerance_boxes(solution.problem, Tolerances.uniform(tolerance), solution, asked=[6, 12])
        assert [(box.pose, box.is_proved) for box in result.boxes] == [(6, True), (12, True)]


def test_a_micrometre_on_the_reference_robot() -> None:
    result = tolerant("rolland-6-6", "0.001")
    assert [box.pose for box in result.boxes] == list(range(1, 17))
    assert result.is_proved
    for box in result.boxes:
        assert box.bounds is not None
        assert box.fraction == 1
        assert box.bounds.position_error.hi < Fraction(1, 4)
        assert box.bounds.position_error.hi < Fraction(6, 5) * box.bounds.position_error.lo
    require_samples_inside(result, boxed("rolland-6-6"), 60, 1)


@pytest.mark.slow
def test_ten_thousand_robots_have_their_poses_in_the_boxes() -> None:
    require_samples_inside(tolerant("rolland-6-6", "0.001"), boxed("rolland-6-6"), 10_000, 2)


@pytest.mark.parametrize(
    ("name", "tolerance"),
    [("ssm-exact", "0.001"), ("mssm", "0.01"), ("hexa", "0.01"), ("3-rrr", "0.0002"), ("3-prr", "0.0001")],
)
def test_robots_within_tolerance_have_their_poses_in_the_boxes(name: str, tolerance: str) -> None:
    solution = solved(name) if name in ("ssm-exact", "mssm") else boxed(name)
    result = tolerance_boxes(shipped(name), Tolerances.uniform(tolerance), solution)
    assert result.is_proved
    require_samples_inside(result, solution, 100, 3)


@pytest.mark.largest
@budget(5)
@given(st.integers(0, 10**6), st.sampled_from([(1, 1, 1), (1, 3, 1)]), st.integers(3, 7))
def test_random_robots(seed: int, metric: tuple[int, int, int], digits: int) -> None:
    random = Random(seed)
    placed = random_placed(random, [Fraction(random.randint(1, 5)) for _ in range(4)], metric)
    solution = solve_krawczyk(placed.problem)
    base, platform, lengths = (Fraction(random.randint(0, 9), 10**digits) for _ in range(3))
    tolerances = Tolerances(base, platform, lengths + Fraction(1, 10**digits))
    result = tolerance_boxes(placed.problem, tolerances, solution)
    assert [box.pose for box in result.boxes] == list(range(1, len(solution.poses) + 1))
    require_samples_inside(result, solution, 40, seed)


@pytest.mark.parametrize(("name", "tolerance"), [("rolland-6-6", "0.001"), ("3-rrr", "0.0001")])
def test_the_greatest_error_is_attained(name: str, tolerance: str) -> None:
    """The robots that move the pose most, to first order, come as far as the lower bound says, and no farther."""
    result, solution = tolerant(name, tolerance), boxed(name)
    problem = result.problem
    for box, pose in list(zip(result.boxes, solution.poses, strict=True))[:4]:
        assert box.bounds is not None
        robots = robots_with(problem, result.tolerances, _extreme_errors(problem, pose))
        found = poses_near(robots, pose)[:, :3] - [float(x.midpoint) for x in pose.position]
        greatest = float(np.linalg.norm(found, axis=1).max())
        bounds = box.bounds.position_error
        assert float(bounds.lo) * (1 - 1e-5) <= greatest <= float(bounds.hi)
        assert greatest > 0.8 * float(bounds.hi)


def _extreme_errors(problem: ForwardProblem, pose: Any) -> tuple[Any, Any, Any]:
    """Every combination of legs that are as long or as short as their data can make them."""
    scales = np.sqrt(np.array(problem.metric, dtype=float))
    c = np.array([float(x.midpoint) for x in pose.position])
    rotation = np.array([[float(x.midpoint) for x in row] for row in pose.rotation])
    legs = len(problem.distances)
    signs = np.array(list(product((1, -1), repeat=legs)), dtype=float)
    base, platform = np.zeros((len(signs), legs, 3)), np.zeros((len(signs), legs, 3))
    for k, leg in enumerate(problem.distances):
        a, b = (np.array([float(x) for x in joint]) * scales for joint in (leg.base, leg.platform))
        line = c + rotation @ b - a
        base[:, k], platform[:, k] = -np.sign(line) * signs[:, k, None], np.sign(rotation.T @ line) * signs[:, k, None]
    return base, platform, -signs


def test_completeness_holds_for_sampled_robots() -> None:
    result = tolerant("3-rrr", "0.0001")
    assert result.is_complete
    assert result.proved_solutions == 6
    for seed in range(5):
        robot = exact_robot(result.problem, result.tolerances, errors_of(result.problem, 1, seed))
        poses = solve_krawczyk(robot).poses
        assert len(poses) == len(result.boxes)
        for box in result.boxes:
            assert box.bounds is not None
            inside = [
                pose
                for pose in poses
                if all(
                    bound.contains(value.midpoint)
                    for bound, value in zip(box.bounds.components[:3], pose.position, strict=True)
                )
            ]
            assert len(inside) == 1


def test_completeness_of_a_spatial_robot() -> None:
    assert tolerant("dietmaier", "1/10000000000000").is_complete
    assert not tolerant("rolland-6-6", "0.001").is_complete
    assert tolerant("rolland-6-6", "1/1000000000000000").is_complete


def test_a_tolerance_too_large_is_not_proved_but_a_fraction_is() -> None:
    result = tolerant("3-rrr", "0.02")
    assert not result.is_complete
    failed = [box for box in result.boxes if not box.is_proved]
    assert failed
    for box in failed:
        assert 0 < box.fraction < 1
        assert box.dominant is not None
        again = tolerance_boxes(result.problem, result.tolerances.scaled(box.fraction), boxed("3-rrr"))
        assert again.boxes[box.pose - 1].is_proved


@cache
def _measured(tolerance: str) -> tuple[dict[str, Any], ToleranceResult, Solution]:
    """A hexapod whose joints were measured to a micrometre, with legs of 222.5 mm."""
    robot = read_robot(Path(__file__).parent / "cases" / "cad3.toml")
    problem = robot.problem(robot.configuration("home"))
    solution = solve_krawczyk(problem)
    result = tolerance_boxes(problem, Tolerances.uniform(tolerance), solution)
    return tolerance_certificate(robot, "home", result), result, solution


def test_a_tenth_of_a_millimetre_in_all_data_of_a_hexapod() -> None:
    content, result, solution = _measured("0.1")
    assert len(result.boxes) == 8
    assert result.is_proved
    assert both(canonical_bytes(content)).status == "accepted"
    require_samples_inside(result, solution, 100, 5)


@pytest.mark.parametrize(("name", "tolerance"), [("3-rrr", "0.01"), ("3-rpr-merlet-p", "0.0079")])
def test_solutions_are_sought_in_narrower_boxes_where_jacobians_may_be_singular(name: str, tolerance: str) -> None:
    """The box that all bounds of a pose are in is too wide for a regular Jacobian, and what it can hold is not."""
    result = tolerant(name, tolerance)
    proved = [box for box in result.boxes if box.is_proved]
    assert proved
    content = tolerant_certificate(name, tolerance)
    assert both(canonical_bytes(content)).status == "accepted"
    wide = next(k for k, box in enumerate(content["boxes"]) if not _is_regular(name, box, tolerance))
    path = ("boxes", wide, "outer")
    verdict = both_resealed(with_entry(content, path, [hex(2 * int(r, 16)) for r in at(content, path)]))
    assert "at most one solution" in last_line(verdict)


def _is_regular(name: str, box: dict[str, Any], tolerance: str) -> bool:
    """Whether Jacobians are proved regular all over the outer box of an entry."""
    problem, result = shipped(name), tolerant(name, tolerance)
    exponent = result.exponent
    with working_precision(2 * exponent):
        robot = centred_robot(problem, result.frames)
        near = certified_pose(robot, boxed(name).poses[box["pose"] - 1], boxed(name).poses, exponent)
        assert near is not None
        radii = [arb(int(radius, 16)) / arb(2) ** exponent for radius in box["outer"]]
        equations = near.with_errors(data_errors(robot, result.tolerances))
        left = contraction(equations, around_zero(near, radii))
        return sum_of_powers(arb_mat([[v.abs_upper() for v in row] for row in left.tolist()])) is not None


@pytest.mark.parametrize("tolerance", ["0.01", "0.003"])
def test_what_is_proved_is_proved_for_smaller_tolerances(tolerance: str) -> None:
    assert _measured(tolerance)[1].is_proved


@pytest.mark.parametrize(
    ("key", "factor", "reason"),
    [
        ("outer", Fraction(40), "at most one solution"),
        ("inner", Fraction(1, 2), "the inner box is not proved to hold a solution"),
    ],
)
def test_boxes_too_wide_or_too_narrow_are_refused(key: str, factor: Fraction, reason: str) -> None:
    content, path = _measured("0.1")[0], ("boxes", 0, key)
    radii = [hex(int(int(value, 16) * factor)) for value in at(content, path)]
    verdict = both_resealed(with_entry(content, path, radii))
    assert verdict.status == "rejected"
    assert reason in last_line(verdict)


def test_a_singular_pose_has_no_box() -> None:
    solution = solved("3-rpr-double-q")
    result = tolerance_boxes(shipped("3-rpr-double-q"), Tolerances.uniform("1/1000000000"), solution)
    singular = [k for k, pose in enumerate(solution.poses) if pose.multiplicity != 1]
    assert singular
    for k in singular:
        assert result.boxes[k].fraction == 0
        assert not result.boxes[k].is_proved


def test_the_dominant_datum_moves_the_pose_most() -> None:
    result, solution = tolerant("3-prr", "0.0001"), boxed("3-prr")
    problem, legs = result.problem, len(result.problem.distances)
    for box, pose in zip(result.boxes, solution.poses, strict=True):
        moves: dict[str, float] = {}
        for k in range(legs):
            for name, place in (("length", 2), ("base joint", 0), ("platform joint", 1)):
                for axis in range(1 if place == 2 else 2):
                    errors = np.zeros((1, legs, 3)), np.zeros((1, legs, 3)), np.zeros((1, legs))
                    errors[place][(0, k) if place == 2 else (0, k, axis)] = 1
                    found = poses_near(robots_with(problem, result.tolerances, errors), pose)[0]
                    nominal = [float(x.midpoint) for x in (*pose.position, *pose.quaternion)]
                    change = np.concatenate([found[:3], found[12:16]]) - nominal
                    change[:3] /= float(result.frames.unit)
                    label = f"length of leg {k + 1}" if place == 2 else f"{'xy'[axis]} of {name} {k + 1}"
                    moves[label] = float(np.linalg.norm(change))
        assert moves[str(box.dominant)] > 0.99 * max(moves.values())


def test_smaller_tolerances_have_smaller_boxes() -> None:
    wide, narrow = tolerant("rolland-6-6", "0.001"), tolerant("rolland-6-6", "0.0005")
    for a, b in zip(wide.boxes, narrow.boxes, strict=True):
        assert a.bounds is not None
        assert b.bounds is not None
        assert 2 * b.bounds.position_error.hi < a.bounds.position_error.hi * Fraction(101, 100)
        assert all(x.lo < y.lo < y.hi < x.hi for x, y in zip(a.bounds.components, b.bounds.components, strict=True))


def test_the_solution_must_be_that_of_the_problem() -> None:
    with pytest.raises(ValueError, match="not one of this problem"):
        tolerance_boxes(shipped("3-prr"), Tolerances.uniform(1), boxed("3-rrr"))


# Certificates


@cache
def certificate_of(path: Path, tolerance: str) -> dict[str, Any]:
    robot = read_robot(path)
    return tolerance_certificate(robot, robot.configuration().name, tolerant(path.stem, tolerance))


@pytest.mark.parametrize(
    ("path", "tolerance"), [(ROLLAND, "0.001"), (ROLLAND, "1/1000000000000000"), (PLANAR, "0.001"), (PLANAR, "0.0001")]
)
def test_certificates_are_accepted(path: Path, tolerance: str) -> None:
    content = certificate_of(path, tolerance)
    verdict = check_bytes(canonical_bytes(content))
    assert verdict.status == "accepted", str(verdict)
    assert any(line.startswith("complete:") for line in verdict.lines) is content["complete"]


def test_the_same_input_gives_the_same_bytes() -> None:
    robot = read_robot(PLANAR)
    again = tolerance_boxes(shipped("3-rrr"), Tolerances.uniform("0.0001"), solve_krawczyk(shipped("3-rrr")))
    content = tolerance_certificate(robot, robot.configuration().name, again)
    assert canonical_bytes(content) == canonical_bytes(certificate_of(PLANAR, "0.0001"))


def _shrunk(value: str) -> str:
    return str(Fraction(value) * Fraction(9, 10))


def _frauds() -> Iterator[tuple[str, tuple[str | int, ...], Any]]:
    yield "joint", ("robot", "base", 0, 0), "1"
    yield "joint", ("robot", "platform", 2, 1), "7"
    yield "length", ("configuration", "lengths_squared", 1), "41"
    yield "tolerance", ("tolerances", "lengths"), "1/500"
    yield "tolerance", ("tolerances", "base"), "1/500"
    yield "tolerance", ("tolerances", "platform"), "-1/500"
    yield "metric", ("robot", "metric", 0), "2"
    yield "origin", ("frames", "base", 0), "10"
    yield "unit", ("frames", "unit"), "1/4"
    yield "out of the plane", ("frames", "base", 2), "1"
    yield "grid", ("exponent",), 90
    yield "number of a pose", ("boxes", 0, "pose"), 2
    yield "error", ("boxes", 0, "position_error"), _shrunk
    yield "error", ("boxes", 1, "rotation_error"), _shrunk
    yield "inner box", ("boxes", 0, "inner", 1), "0x1"
    yield "outer box", ("boxes", 0, "outer", 2), "0x1"
    yield "centre", ("boxes", 0, "centre", 0, 0), "0x12345"
    yield "chart", ("boxes", 2, "chart", 0, 0), 0
    yield "not real", ("boxes", 2, "chart", 0, 1), 1
    yield "unproved", ("unproved",), [7]
    yield "incomplete", ("boxes",), lambda boxes: boxes[1:]
    yield "repeated", ("boxes",), lambda boxes: [*boxes[:5], {**boxes[4], "pose": 6}]
    yield (
        "pair",
        ("pairs",),
        lambda _: [{k: certificate_of(PLANAR, "0.0001")["boxes"][0][k] for k in ("chart", "centre", "outer")}],
    )


@pytest.mark.parametrize(("path", "value"), [fraud[1:] for fraud in _frauds()])
def test_what_is_changed_is_not_accepted(path: tuple[str | int, ...], value: Any) -> None:
    content = certificate_of(PLANAR, "0.0001")
    new = value(at(content, path)) if callable(value) else value
    verdict = check_resealed(with_entry(content, path, new))
    assert verdict.status in ("rejected", "malformed"), str(verdict)


@pytest.mark.parametrize("side", [0, 1])
@pytest.mark.parametrize("place", ["centroid", "quaternion"])
def test_bounds_cannot_be_narrowed_or_far_widened(place: str, side: int) -> None:
    content = certificate_of(ROLLAND, "0.001")
    low, high = map(Fraction, at(content, ("boxes", 0, place, 1)))
    width = high - low
    for amount, reason in ((-width / 20, "bound of the pose"), (40 * width, "beyond the outer box")):
        ends = [str(low - amount), str(high)] if side == 0 else [str(low), str(high + amount)]
        verdict = check_resealed(with_entry(content, ("boxes", 0, place, 1), ends))
        assert verdict.status == "rejected"
        assert reason in last_line(verdict)


def test_bounds_of_position_and_rotation_cannot_be_narrowed() -> None:
    content = certificate_of(ROLLAND, "0.001")
    for path in (("boxes", 3, "position", 2), ("boxes", 3, "rotation", 1, 2)):
        low, high = map(Fraction, at(content, path))
        verdict = check_resealed(with_entry(content, path, [str(low), str(high - (high - low) / 20)]))
        assert "bound of the pose" in last_line(verdict)


def test_far_frames_do_not_matter() -> None:
    """Where the frames of the model are is no property of the robot."""
    robot, far = read_robot(ROLLAND), (Fraction(10**6), Fraction(-(10**6)), Fraction(5))

    def moved(joints: Any) -> Any:
        return tuple(tuple(x + o for x, o in zip(joint, far, strict=True)) for joint in joints)

    there = replace(robot, base_joints=moved(robot.base_joints), platform_joints=moved(robot.platform_joints))
    problem = there.problem([1250**2] * 6)
    solution = solve_krawczyk(problem)
    result = tolerance_boxes(problem, Tolerances.uniform("0.001"), solution)
    assert result.is_proved
    errors = sorted(box.bounds.rotation_error.hi for box in result.boxes if box.bounds)
    near = sorted(box.bounds.rotation_error.hi for box in tolerant("rolland-6-6", "0.001").boxes if box.bounds)
    assert all(abs(a / b - 1) < Fraction(1, 1000) for a, b in zip(errors, near, strict=True))
    assert check_bytes(canonical_bytes(tolerance_certificate(there, None, result))).status == "accepted"


def test_completeness_cannot_be_claimed_without_proof() -> None:
    content = certificate_of(ROLLAND, "0.001")
    assert check_resealed({**content, "complete": True}).status == "rejected"
    content = certificate_of(ROLLAND, "1/1000000000000000")
    assert check_resealed({**content, "complete": False}).status == "rejected"
    doubled = [content["pairs"][0], *content["pairs"][:-1]]
    assert "not proved distinct" in last_line(check_resealed({**content, "pairs": doubled}))


# Model files and the command


def model_with(lines: str) -> str:
    return PLANAR.read_text().replace("[[configurations]]", f"[tolerances]\n{lines}\n\n[[configurations]]", 1)


def test_tolerances_of_a_model_file() -> None:
    robot = robot_from_toml(model_with('joints = 0.001\nlengths = "1/500"'))
    assert robot.tolerances == Tolerances(Fraction(1, 1000), Fraction(1, 1000), Fraction(1, 500))
    robot = robot_from_toml(model_with("base = 0.002\nplatform = 0.001"))
    assert robot.tolerances == Tolerances(Fraction(1, 500), Fraction(1, 1000), Fraction(0))
    assert read_robot(PLANAR).tolerances is None


@pytest.mark.parametrize(
    ("lines", "part"),
    [
        ("joints = -0.001", "tolerances.base: -1/1000 is negative"),
        ("joints = nan", "not a finite number"),
        ("lengths = 0", "all are 0"),
        ("joints = 1\nbase = 1", "joints and base given"),
        ("legs = 1", "unknown key 'legs'"),
        ("lengths = [1]", "tolerances.lengths"),
    ],
)
def test_bad_tolerances_are_refused(lines: str, part: str) -> None:
    with pytest.raises(InputError, match="tolerances") as caught:
        robot_from_toml(model_with(lines))
    assert part in str(caught.value)


Capture = pytest.CaptureFixture[str]


def test_the_command(tmp_path: Path, capsys: Capture) -> None:
    model, output = tmp_path / "robot.toml", tmp_path / "tolerance.json"
    model.write_text(model_with("joints = 0.0001\nlengths = 0.0001"))
    assert main(["solve", str(model), "--method", "krawczyk", "--tolerance", "-o", str(output)]) == 0
    text = capsys.readouterr().out
    assert "complete: every robot within tolerance has exactly 6 poses" in text
    assert "dominated by" in text
    assert main(["check", str(output)]) == 0
    assert "accepted" in capsys.readouterr().out
    assert main(["solve", str(model), "--method", "krawczyk", "--tolerance", "1e-4", "--format", "json"]) == 0
    content = json.loads(capsys.readouterr().out)["tolerance"]
    assert content["complete"] is True
    assert [box["proved"] for box in content["boxes"]] == [True] * 6
    low, high = map(Fraction, content["boxes"][0]["position_error"])
    assert 0 < low < high


def test_the_command_says_what_is_not_proved(capsys: Capture) -> None:
    assert main(["solve", "models/3-rpr-merlet-p.toml", "--tolerance", "0.06"]) == 3
    text = capsys.readouterr().out
    assert "with a box, and followed for" in text
    assert "without a singularity, not for all of it: beyond, a singularity is neither found nor excluded" in text
    assert "what moves the platform most is the length of leg" in text


def test_only_the_nearest_pose_is_asked_about(tmp_path: Path, capsys: Capture) -> None:
    path, words = tmp_path / "one.json", ["solve", str(PLANAR), "--method", "krawczyk", "--tolerance", "0.01"]
    assert main([*words, "--near", "6.2,-3.8,-8", "--nearest", "-o", str(path)]) == 0
    text = capsys.readouterr().out
    assert "1 of 1 pose has a box for every robot within tolerance; 5 other poses were not asked about" in text
    content = json.loads(path.read_text())
    assert [box["pose"] for box in content["boxes"]] == [3]
    assert content["unproved"] == [1, 2, 4, 5, 6]
    assert both(path.read_bytes()).status == "accepted"
    assert main(["check", str(path), "--recompute"]) == 0
    capsys.readouterr()
    assert main([*words, "--nearest"]) == 2
    assert "--nearest: nearest to what? give --near" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("key", "numbers"), [("z", "123456"), ("y", "136542"), ("condition", "132564"), ("nearest", "3")]
)
def test_poses_are_sorted_and_keep_their_numbers(key: str, numbers: str, capsys: Capture) -> None:
    words = ["solve", str(PLANAR), "--method", "krawczyk", "--format", "csv", "--near", "6.2,-3.8,-8", "--sort", key]
    assert main(words) == 0
    found = [line.split(",")[0] for line in capsys.readouterr().out.splitlines()[1:]]
    assert "".join(found).startswith(numbers)


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["--tolerance"], "tolerances: is missing"),
        (["--tolerance", "0"], "not positive"),
        (["--tolerance", "x"], "is not a number"),
        (["--tolerance", "1e-3", "--format", "csv"], "no csv"),
        (["--tolerance", "1e-3", "--method", "newton"], "newton"),
    ],
)
def test_the_command_refuses(words: list[str], part: str, tmp_path: Path, capsys: Capture) -> None:
    assert main(["solve", str(PLANAR), *words]) == 2
    captured = capsys.readouterr()
    assert part in captured.err
    assert captured.err.count("\n") == 1
    assert not captured.out


@pytest.mark.parametrize("tolerance", ["1e-40", "1e-60", "1e-150"])
def test_certificates_of_tiny_tolerances_are_accepted(tolerance: str, tmp_path: Path) -> None:
    """Bounds of what hardly changes, such as the third column of a planar rotation, are confirmed by other rounding."""
    model, target = Path(__file__).parent.parent / "models" / "3-rpr-merlet-p.toml", tmp_path / "tolerance.json"
    assert main(["solve", str(model), "--tolerance", tolerance, "-o", str(target)]) == 0
    assert main(["check", str(target)]) == 0


def test_solutions_with_coordinates_that_are_0_are_found(tmp_path: Path) -> None:
    """Of a symmetric robot: such a coordinate has no small error in proportion to itself, at any precision."""
    model = tmp_path / "symmetric.toml"
    words = ["new", "--kind", "6-6", "--base-sides", "400,200", "--platform-sides", "100,300", "--height", "500"]
    assert main([*words, "--exact", "-o", str(model)]) == 0
    robot = read_robot(model)
    problem = robot.problem(robot.configuration())
    result = tolerance_boxes(problem, Tolerances.uniform("1/100"), solve(problem))
    bounds = [box.bounds for box in result.boxes if box.bounds is not None]
    assert bounds
    assert all(0 <= each.position_error.lo <= each.position_error.hi for each in bounds)
    assert all(0 <= each.rotation_error.lo <= each.rotation_error.hi for each in bounds)
