"""Regions of joint values: the poses of a box whose joint values lie between others."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import product
from math import cos, hypot, radians, sin
from pathlib import Path

import pytest
from samples import MODELS, model
from test_regions import asked

from pkm_exact import InputError
from pkm_exact.cli.main import main
from pkm_exact.regions.question_reader import question_from_toml
from pkm_exact.regions.region_conditions import Conditions, asked_of
from pkm_exact.regions.region_legs import region_machine
from pkm_exact.regions.region_points import PointJudge

FILES = {path.stem: path for path in MODELS}
TAIL = "\n[conditions]\nreachable = true\n{0}[answer]\nkind = 'all'\n"


def test_poses_are_those_with_these_lengths() -> None:
    machine = region_machine(model("3-rpr-merlet-p"))
    reach = [(5, 8), (3, 6), (2, 5)]
    region = f"position = [[0, 8], [0, 8]]\ndegrees = [-40, 40]\njoints = {[list(pair) for pair in reach]}"
    question = question_from_toml(f"[region]\n{region}{TAIL.format('')}", machine)
    found = asked_of(machine, question.chart, question.conditions)
    judge, seen = PointJudge(found, question.region(found, machine.metric)), set()
    for x, y, angle in product(range(9), range(9), (-30, 0, 20)):
        t = Fraction(sin(radians(angle) / 2) / cos(radians(angle) / 2))
        lengths = [
            hypot(
                float(x + cos(radians(angle)) * b[0] - sin(radians(angle)) * b[1] - a[0]),
                float(y + sin(radians(angle)) * b[0] + cos(radians(angle)) * b[1] - a[1]),
            )
            for a, b in ((leg.base, [float(c) for c in leg.platform]) for leg in machine.legs)
        ]
        gaps = [min(length - low, high - length) for length, (low, high) in zip(lengths, reach, strict=True)]
        if abs(min(gaps)) > 1e-9:
            assert judge.is_inside((Fraction(x), Fraction(y), t)) is (min(gaps) > 0)
            seen.add(min(gaps) > 0)
    assert seen == {True, False}


def test_cranks_are_within_these_angles_as_limits_say() -> None:
    machine, modes = region_machine(model("3-rrr")), "working_modes = ['+', '-', '-']\n"
    reach, seen = [(-120, 120), (20, 340), (-150, 150)], set()
    region = f"position = [[-9, 9], [-9, 9]]\ndegrees = 0\njoints = {[list(pair) for pair in reach]}"
    question = question_from_toml(f"[region]\n{region}{TAIL.format(modes)}", machine)
    limited = replace(
        machine,
        legs=tuple(
            replace(leg, reach=(Fraction(low), Fraction(high)))
            for leg, (low, high) in zip(machine.legs, reach, strict=True)
        ),
    )
    found = asked_of(machine, question.chart, question.conditions)
    other = asked_of(limited, question.chart, Conditions(("limits",), question.conditions.modes))
    region_judge = PointJudge(found, question.region(found, machine.metric))
    limit_judge = PointJudge(other, other.formula)
    for x, y in product(range(-9, 10, 3), repeat=2):
        point = Fraction(x), Fraction(y)
        assert region_judge.is_inside(point) is limit_judge.is_inside(point)
        seen.add(limit_judge.is_inside(point))
    assert seen == {True, False}


def test_what_lies_between_joint_values_is_proved_though_the_box_is_not() -> None:
    """At y = 5 and the angle 0 the robot is singular at x = 2.2, where leg 1 is 5.4626 long; no pose refutes pieces."""
    machine, line = region_machine(model("3-rpr-merlet-p")), "position = [[1, 4], 5]\ndegrees = 0\n"
    assert asked(machine, line, "no_type_2 = true").counterexample is not None
    assert asked(machine, f"{line}joints = [['5.5', 9], [0, 99], [0, 99]]", "no_type_2 = true").is_proved
    assert asked(machine, f"{line}joints = [[0, '5.4'], [0, 99], [0, 99]]", "no_type_2 = true").is_proved
    whole = asked(
        machine, f"{line}joints = [[0, 99], [0, 99], [0, 99]]", "no_type_2 = true", "kind = 'all'\nsteps = 20"
    )
    assert (whole.is_proved, whole.counterexample) == (False, None)


def test_joint_values_that_no_pose_has_prove_nothing() -> None:
    machine, line = region_machine(model("3-rpr-merlet-p")), "position = [[1, 4], 5]\ndegrees = 0\n"
    for joints in ("[[7, 8], [0, 99], [0, 99]]", "[['5.5', 6], [9, 10], [0, 99]]"):
        with pytest.raises(InputError, match="no pose of the shape is shown to have such joint values"):
            asked(machine, f"{line}joints = {joints}", "no_type_2 = true")


def test_a_map_has_the_poses_of_these_joint_values(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of a leg from the origin between 3 and 4: a quarter of a ring, of area 7 pi / 4."""
    machine = region_machine(model("3-rpr-merlet-p"))
    region = "position = [[0, 5], [0, 5]]\ndegrees = 0\njoints = [[3, 4], [0, 99], [0, 99]]"
    answer = asked(machine, region, "reachable = true", "kind = 'map'\nsteps = 13")
    assert answer.measures is not None
    assert answer.measures[0] < Fraction("5.4977871") < answer.measures[1] < answer.measures[0] + 2
    question = tmp_path / "question.toml"
    question.write_text(f"[region]\n{region}{TAIL.format('')}")
    command = ["region", str(FILES["3-rpr-merlet-p"]), str(question)]
    assert main(command) == 0
    assert main([*command, "-o", str(tmp_path / "a.json")]) == 0
    assert main(["check", str(tmp_path / "a.json")]) == 0


@pytest.mark.parametrize(
    ("name", "joints", "answer", "said"),
    [
        ("3-rpr-merlet-p", "[[1, 2]]", "'all'", "1 pairs; give one for each of 3 legs"),
        ("3-rpr-merlet-p", "[[2, 1], [1, 2], [1, 2]]", "'all'", r"joints\[1\]: 2 is not less than 1"),
        ("3-rpr-merlet-p", "[[-1, 1], [1, 2], [1, 2]]", "'all'", "a length is 0 or more"),
        ("3-rpr-merlet-p", "[[0, 1], [1, 2], [1, 2]]", "'locus'", "does not go with the answer locus"),
        ("3-rrr", "[[0, 1], [1, 2], [1, 2]]", "'all'", "region.joints depends on them"),
        ("3-rpr-turned", "[[0, 1], [1, 2], [1, 2]]", "'all'", "driven at its hinge"),
        ("3-rpr-merlet-p", "[[0, 1], [1, 2], [1, 2]]", "'largest'", "has a shape of its own"),
    ],
)
def test_joint_values_that_do_not_fit_are_refused(name: str, joints: str, answer: str, said: str) -> None:
    more = "shape = 'ball'\nabout = [0, 0]" if answer == "'largest'" else ""
    shape = "" if more else "position = [[0, 1], 5]\n"
    text = f"[region]\n{shape}degrees = 0\njoints = {joints}{TAIL.format('')}{more}".replace("'all'", answer)
    with pytest.raises(InputError, match=said):
        question_from_toml(text, region_machine(model(name)))
