"""Least and greatest joint values over regions: against sampled poses and published numbers."""

from __future__ import annotations

import json
from fractions import Fraction
from math import acos, atan2, cos, degrees, hypot, pi, radians, sin, sqrt, tan
from pathlib import Path
from random import Random

import numpy as np
import pytest
from region_certificates import machine_of
from samples import MODELS, model
from test_regions import _distances, _rpy

from pkm_exact import InputError
from pkm_exact.cli.main import main
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.regions.joint_ranges import JointRange, common_range, joint_ranges
from pkm_exact.regions.question_reader import question_from_toml
from pkm_exact.regions.region_legs import OnCrank, OnSlide, RegionLeg, RegionMachine, region_machine

FILES = {path.stem: path for path in MODELS}
ZERO, ONE = Fraction(0), Fraction(1)
ORIGIN, UP = (ZERO, ZERO, ZERO), (ZERO, ZERO, ONE)
SIX = "working_modes = ['-', '-', '-', '-', '-', '-']"


def ranges(machine: RegionMachine, region: str, conditions: str = "", answer: str = "") -> tuple[JointRange, ...]:
    text = f"[region]\n{region}\n[conditions]\nreachable = true\n{conditions}\n[answer]\nkind = 'extremes'\n"
    question = question_from_toml(f"{text}of = 'joint_values'\n{answer}\n", machine)
    return joint_ranges(machine, question)


def test_the_stroke_that_the_rcid_needs_about_any_axis() -> None:
    """Lopes and Almeida, chapter 4: a ball of 10 mm, 15 degrees about any axis; 51.8006 by maximising in doubles."""
    found = ranges(
        region_machine(model("rcid")), "ball = { center = [0, 0, 120], radius = 10 }\nany_axis_degrees = 15", SIX
    )
    assert all(leg.is_precise and leg.unit == "mm" for leg in found)
    for leg in found:
        assert leg.stroke.lo < Fraction("51.8006") < leg.stroke.hi < leg.stroke.lo + Fraction(1, 5)


@pytest.mark.slow
def test_the_range_that_the_rcid_needs_about_its_own_axes() -> None:
    """Three angles within 15 degrees each: 72.12 mm, from the least value of one slide to the greatest of another."""
    base = [(80 * cos(radians(a)), 80 * sin(radians(a)) / sqrt(3)) for a in (15, 105, 135, 225, 255, 345)]
    platform = [(40 * cos(radians(a)), 40 * sin(radians(a)) / sqrt(3)) for a in (60, 60, 180, 180, 300, 300)]
    sides = [[[f"{x:.6f}", f"{y:.6f}", 0] for x, y in joints] for joints in (base, platform)]
    text = (
        'schema = 1\nname = "RCID"\nkind = "6-PUS"\nunit = "mm"\nsource = "chapter 4, table 1, in its axes"\n'
        f"metric = [1, 3, 1]\n[base]\njoints = {sides[0]}\n[platform]\njoints = {sides[1]}\n"
        f"[slides]\ndirection = [0, 0, 1]\n[rods]\nlengths_squared = {[9600] * 6}\n"
    )
    region = "ball = { center = [0, 0, 120], radius = 10 }\nrpy_degrees = [[-15, 15], [-15, 15], [-15, 15]]"
    found = ranges(region_machine(robot_from_toml(text)), region, SIX)
    common = common_range(found)
    assert common is not None
    assert common.stroke.lo < Fraction("72.1215") < common.stroke.hi < common.stroke.lo + Fraction(1, 5)


def test_lengths_over_a_ball_are_those_of_its_centre_and_the_radius() -> None:
    found = ranges(
        region_machine(model("rolland-6-6")), "ball = { center = [0, 0, 770], radius = 60 }\nquaternion = [1, 0, 0, 0]"
    )
    lengths = _distances("rolland-6-6", [0, 0, 770], np.eye(3))
    for leg, length in zip(found, lengths, strict=True):
        assert leg.least.lo - Fraction(1, 10**9) <= length - 60 <= leg.least.hi + Fraction(1, 10**9)
        assert abs(float(leg.greatest) - length - 60) < 1e-6 * length


def test_lengths_over_a_box_and_angles_hold_all_samples() -> None:
    random, machine = Random(5), region_machine(model("rolland-6-6"))
    found = ranges(machine, "position = [[-50, 50], 0, [700, 800]]\nrpy_degrees = [0, [-10, 10], 0]")
    samples = []
    for k in range(300):
        x, z, pitch = (
            [random.choice((-1, 1)) for _ in range(3)] if k < 60 else [random.uniform(-1, 1) for _ in range(3)]
        )
        samples.append(_distances("rolland-6-6", [50 * x, 0, 750 + 50 * z], _rpy(0, 10 * pitch, 0)))
    for leg, least, greatest in zip(found, np.min(samples, axis=0), np.max(samples, axis=0), strict=True):
        assert leg.least.lo <= least
        assert greatest <= leg.greatest.hi
        assert leg.greatest.hi < 1.02 * greatest
        assert least < 1.02 * float(leg.least.lo)


def test_angles_of_cranks_hold_all_samples() -> None:
    """A Delta: angles by inverse kinematics, mode by mode, in the plane of each crank."""
    random, machine = Random(2), region_machine(model("delta"))
    for mode in ("+", "-"):
        region = "position = [[-0.2, 0.2], 0, [-3, -2.5]]"
        found = ranges(machine, region, f"working_modes = {[mode] * 3}", "precision = '1/50'")
        for k, leg in enumerate(found):
            assert leg.unit == "deg"
            turn = radians(120 * k)
            angles = []
            for _ in range(40):
                x, y, z = random.choice((-0.2, 0, 0.2)), 0, random.choice((-3, -2.8, -2.5))
                along, side = x * cos(turn) + y * sin(turn) - 1.74, -x * sin(turn) + y * cos(turn)
                far = hypot(along, z)
                bend = acos((far * far + side * side + 1.73**2 - 2.66**2) / (2 * 1.73 * far))
                middle = atan2(-z, along)
                angle = middle + (bend if mode == "+" else -bend)
                angles.append(degrees(angle % (2 * pi)))
            assert leg.least.lo <= min(angles) <= max(angles) <= leg.greatest.hi
            assert leg.stroke.hi < 1.3 * (max(angles) - min(angles))


def test_limits_cut_the_poses_that_are_asked() -> None:
    """With a leg that is at most 5 long, over the good poses its greatest length is 5."""
    limits = "[limits]\nlengths = [[3, 5], [0, 99], [0, 99]]\n"
    machine = region_machine(machine_of("3-rpr-merlet-p", limits))
    found = ranges(
        machine, "position = [[-6, 6], [-6, 6]]\ndegrees = 0", "limits = true", "precision = '1/50'\nsteps = 40"
    )
    assert found[0].greatest.lo <= 5 <= found[0].greatest.hi
    assert found[0].least.lo <= 3 <= found[0].least.hi
    assert found[0].stroke.hi < Fraction(22, 10)


def test_a_ball_that_is_not_reached_is_refused() -> None:
    machine = region_machine(model("rcid"))
    with pytest.raises(InputError, match=r"region\.ball: that leg 1 reaches all of it is not proved"):
        ranges(machine, "ball = { center = [30, 0, 120], radius = 25 }\nany_axis_degrees = 15", SIX)
    with pytest.raises(InputError, match="leg 1 has two working modes"):
        ranges(machine, "ball = { center = [0, 0, 120], radius = 5 }\nany_axis_degrees = 15")
    with pytest.raises(InputError, match="reaches 180 degrees"):
        ranges(machine, "ball = { center = [0, 0, 120], radius = 5 }\nany_axis_degrees = 180", SIX)
    with pytest.raises(InputError, match="is for the answer extremes"):
        ranges(region_machine(model("3-rrr")), "position = [0, [0, 1]]\nany_axis_degrees = 20")


def test_turns_about_any_axis_hold_all_samples() -> None:
    """Slides at a fixed place, turned about random axes by up to 30 degrees; the cap is reached to its rim."""
    random, machine = Random(4), region_machine(model("rcid"))
    found = ranges(machine, "ball = { center = [0, 0, 120], radius = '1/1000' }\nany_axis_degrees = 20", SIX)
    leg, values = machine.legs[2], []
    root = sqrt(3)
    p = np.array([float(leg.platform[0]), root * float(leg.platform[1]), 0])
    a = np.array([float(leg.base[0]), root * float(leg.base[1])])
    for _ in range(4000):
        axis = np.array([random.gauss(0, 1) for _ in range(3)])
        axis *= tan(radians(random.choice((20, random.uniform(0, 20))) / 2)) / np.linalg.norm(axis)
        w = 1 + axis @ axis
        v = ((1 - axis @ axis) * p + 2 * np.cross(axis, p) + 2 * (axis @ p) * axis) / w
        values.append(120 + v[2] - sqrt(9600 - (v[0] - a[0]) ** 2 - (v[1] - a[1]) ** 2))
    assert found[2].least.lo <= min(values) <= max(values) <= found[2].greatest.hi
    assert found[2].stroke.hi < 1.02 * (max(values) - min(values)) + Fraction(1, 10)


def test_what_a_slide_needs_is_asked_of_poses_that_all_legs_reach() -> None:
    """A rod of 5 on a vertical slide; one of 9 on a crank, which reaches what is at most 10 from (0, 0, 20).

    The lowest pose of the ball is out of reach of the crank: the slide need not go there.
    """
    legs = (
        RegionLeg("slide", ORIGIN, ORIGIN, OnSlide(UP, Fraction(25))),
        RegionLeg(
            "crank", (ZERO, ZERO, Fraction(20)), ORIGIN, OnCrank((ONE, ZERO, ZERO), (ZERO, ZERO, ONE), 1, Fraction(81))
        ),
    )
    machine = RegionMachine("made up", "m", "made up", (1, 1, 1), "translation", (0, 1, 2), legs)
    region = "ball = { center = [0, 0, 10], radius = 1 }"
    least = ranges(machine, region, "working_modes = ['-', '+']", "precision = '1/10'\nsteps = 14")[0].least
    assert Fraction(9, 2) < least.lo <= 5 <= least.hi


def test_conditions_and_joints_hold_for_joint_values_of_legs_by_themselves() -> None:
    mssm, ball = region_machine(model("mssm")), "ball = { center = [1, 2, 3], radius = 1 }\nquaternion = [1, 0, 0, 0]"
    load = "forces = { load = [0, 0, 1, 0, 0, 0], most = '1/10000000' }"
    with pytest.raises(InputError, match="no pose is shown to be good"):
        ranges(mssm, ball, load)
    turned = "position = [0, 0, 120]\nany_axis_degrees = 5"
    with pytest.raises(InputError, match="goes with the condition reachable alone"):
        ranges(mssm, turned, "length = 1\nindices = { transmission = 0.9 }")
    with pytest.raises(InputError, match="not all among those that the joints of the mechanism allow"):
        ranges(region_machine(model("2-ups-u")), "position = [1, 2, 3]\nany_axis_degrees = 10")
    with pytest.raises(InputError, match="region: that leg 1 reaches all of it is not proved"):
        ranges(region_machine(model("rcid")), "position = [[50, 51], 0, 120]\nany_axis_degrees = 15", SIX)
    text = f"[region]\n{turned}\n[conditions]\nreachable = true\nlength = 1\n[answer]\nkind = 'extremes'\n"
    with pytest.raises(InputError, match="is for the answer extremes, of joint_values"):
        question_from_toml(f"{text}of = 'transmission'\n", mssm)


def test_the_command_says_what_is_needed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    question = tmp_path / "needed.toml"
    lines = "[region]\nposition = [[4, 6], [4, 6]]\ndegrees = 0\n[conditions]\nreachable = true\n[answer]\n"
    question.write_text(f"{lines}kind = 'extremes'\nof = 'joint_values'\n")
    path = str(FILES["3-rpr-merlet-p"])
    assert main(["region", path, str(question)]) == 0
    assert "one range for all: as long as between" in capsys.readouterr().out
    assert main(["region", path, str(question), "--format", "json"]) == 0
    content = json.loads(capsys.readouterr().out)
    assert len(content["joint_values"]) == 3
    least, most = (Fraction(x) for x in content["common"]["stroke"])
    assert 0 < least <= most
    assert main(["region", path, str(question), "-o", str(tmp_path / "a.json")]) == 2
    assert not (tmp_path / "a.json").exists()
    question.write_text(f"{lines}kind = 'extremes'\nof = 'joint_values'\nsteps = 1\n")
    assert main(["region", path, str(question)]) in (2, 3)
    question.write_text(f"{lines}kind = 'extremes'\nof = 'beauty'\n")
    assert main(["region", path, str(question)]) == 2
    assert "'beauty' is unknown" in capsys.readouterr().err
    question.write_text(f"{lines}kind = 'all'\nof = 'joint_values'\n")
    assert main(["region", path, str(question)]) == 2
