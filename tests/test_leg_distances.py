"""A least distance of legs over regions: against distances of segments in doubles, and proved for whole regions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from pathlib import Path
from random import Random

import numpy as np
import pytest
from samples import MODELS, model
from test_regions import asked

from pkm_exact import InputError
from pkm_exact.cli.main import main
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.regions.chart import Chart
from pkm_exact.regions.leg_distances import share_a_joint
from pkm_exact.regions.region_conditions import Conditions, asked_of
from pkm_exact.regions.region_legs import OnCrank, OnSlide, OwnLength, RegionLeg, RegionMachine, region_machine
from pkm_exact.regions.region_points import PointJudge

FILES = {path.stem: path for path in MODELS}
ZERO, ONE = Fraction(0), Fraction(1)
ORIGIN = (ZERO, ZERO, ZERO)


def _to_segment(p: np.ndarray, a: np.ndarray, b: np.ndarray) -> float:
    share = np.clip((p - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
    return float(np.linalg.norm(p - a - share * (b - a)))


def _distance(one: Sequence[np.ndarray], other: Sequence[np.ndarray]) -> float:
    """Of two segments: at an end of one, or inside of both."""
    ends = [_to_segment(p, *other) for p in one] + [_to_segment(p, *one) for p in other]
    u, v = one[1] - one[0], other[1] - other[0]
    shares, *_ = np.linalg.lstsq(np.stack([u, -v], axis=1), other[0] - one[0], rcond=None)
    if (shares > 0).all() and (shares < 1).all():
        ends.append(float(np.linalg.norm(one[0] + shares[0] * u - other[0] - shares[1] * v)))
    return min(ends)


def _least(machine: RegionMachine, c: Sequence[Fraction], q: Sequence[Fraction], modes: Sequence[int]) -> float | None:
    """The least distance of two legs at a pose, in ordinary coordinates; None if a rod does not reach."""
    g = np.sqrt(np.array(machine.metric, dtype=float))
    turn = np.array(rotation_of(tuple(q), machine.metric), dtype=float)  # type: ignore[arg-type]
    segments = []
    for leg, mode in zip(machine.legs, modes, strict=True):
        tip = (np.array(c, dtype=float) + turn @ np.array(leg.platform, dtype=float)) * g
        foot = np.array(leg.base, dtype=float) * g
        if isinstance(leg.actuator, OnSlide):
            d, e = np.array(leg.actuator.direction, dtype=float) * g, tip - foot
            square = (d @ e) ** 2 - d @ d * (e @ e - float(leg.actuator.rod_squared))
            if square < 0:
                return None
            foot = foot + (d @ e + mode * square**0.5) / (d @ d) * d
        if isinstance(leg.actuator, OnCrank):
            u = np.array(leg.actuator.at_0, dtype=float) * g
            v = np.array(leg.actuator.at_90, dtype=float) * g / leg.actuator.weight**0.5
            e = tip - foot
            p, q = u @ e, v @ e
            cosine = (e @ e + u @ u - float(leg.actuator.rod_squared)) / 2 / np.hypot(p, q)
            if abs(cosine) > 1:
                return None
            angle = np.arctan2(q, p) + mode * np.arccos(cosine)
            foot = foot + np.cos(angle) * u + np.sin(angle) * v
        segments.append((foot, tip))
    return min(
        _distance(segments[i], segments[j])
        for i, j in combinations(range(len(segments)), 2)
        if not share_a_joint(machine.legs[i], machine.legs[j])
    )


@pytest.mark.parametrize(("name", "height"), [("mssm", 9), ("inclined-slides", 3), ("delta", -12)])
def test_distances_are_those_of_segments(name: str, height: int) -> None:
    """Of random poses, legs that cross each other among them: kept just below the distance, broken just above it."""
    machine, random, count = region_machine(model(name)), Random(7), 0
    machine = replace(machine, legs=machine.legs[:: len(machine.legs) // 3])
    if name == "delta":  # of the model's rods all end in one point
        legs = (replace(leg, platform=tuple(x / 3 for x in leg.base)) for leg in machine.legs)
        machine = replace(machine, legs=tuple(legs))
    size = max(abs(x) for leg in machine.legs for x in leg.base)
    for _ in range(60):
        modes = (-1,) * len(machine.legs)
        quaternion = (ONE, *(Fraction(random.randint(-9, 9), 12) for _ in range(3)))
        place = [size * Fraction(random.randint(-3, 3), 10) for _ in range(2)] + [size * Fraction(height, 10)]
        found = _least(machine, place, quaternion, modes)
        if found is None or found < 1e-6 * float(size):
            continue
        count += 1
        if count > 4:
            return
        chart = Chart(("x", *place[1:]), quaternion, (), ("x",), ((place[0], place[0] + 1),))
        for factor, is_kept in ((1 - 1e-6, True), (1 + 1e-6, False)):
            limited = replace(machine, leg_distance=Fraction(found * factor))
            question = asked_of(limited, chart, Conditions(("limits",), modes))
            judge = PointJudge(question, question.formula)
            assert judge.is_inside((place[0],)) is is_kept
            assert (judge.failing((place[0],)) is None) is is_kept
    raise AssertionError("no such poses")


def test_parallel_legs_are_apart_all_over_a_region() -> None:
    """Four upright legs at the corners of a square, parallel in the middle, keep nearly the length of its sides."""
    corners = [(ZERO, ZERO, ZERO), (ONE, ZERO, ZERO), (ONE, ONE, ZERO), (ZERO, ONE, ZERO)]
    legs = tuple(RegionLeg(f"leg {k}", c, c, OwnLength()) for k, c in enumerate(corners, 1))
    machine = RegionMachine("made up", "m", "made up", (1, 1, 1), "translation", (0, 1, 2), legs)
    region, conditions = "position = [[-0.1, 0.1], [-0.1, 0.1], [1, 2]]", "limits = true"
    assert asked(replace(machine, leg_distance=Fraction(99, 100)), region, conditions).is_proved
    refuted = asked(replace(machine, leg_distance=Fraction(101, 100)), region, conditions)
    assert refuted.counterexample is not None
    assert "apart from" in refuted.counterexample.reason


def test_the_command_knows_the_limit(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    robot, question = tmp_path / "robot.toml", tmp_path / "question.toml"
    robot.write_text(FILES["rolland-6-6"].read_text() + "\n[limits]\nleg_distance = 20\n")
    lines = "[region]\nposition = [[-50, 50], [-50, 50], [700, 800]]\nrpy_degrees = [0, 0, 0]\n[conditions]\n"
    question.write_text(f"{lines}limits = true\n[answer]\nkind = 'all'\n")
    assert main(["region", str(robot), str(question)]) == 0
    assert "proved: all poses of the region are good" in capsys.readouterr().out


def test_rods_along_an_axis_have_no_distance() -> None:
    arm = RegionLeg("arm", ORIGIN, ORIGIN, OnSlide((ONE, ZERO, ZERO), ONE), axis=(ZERO, ZERO, ONE))
    legs = (arm, replace(arm, name="other arm", platform=(ONE, ZERO, ZERO)))
    machine = RegionMachine("made up", "m", "x", (1, 1, 1), "translation", (0, 1, 2), legs, leg_distance=ONE)
    with pytest.raises(InputError, match=r"limits.leg_distance: arm: regions know this limit of legs"):
        asked(machine, "position = [[0, 1], 0, 1]", "limits = true\nworking_modes = ['+', '+']")


def test_rods_on_one_guide_are_compared() -> None:
    """They share a joint only where both stand still on it."""
    slide = OnSlide((ZERO, ZERO, ONE), ONE)
    one, other = (RegionLeg(name, ORIGIN, (x, ZERO, ZERO), slide) for name, x in (("a", ZERO), ("b", ONE)))
    assert not share_a_joint(one, other)
    assert share_a_joint(replace(one, actuator=OwnLength()), replace(other, actuator=OwnLength()))
    assert share_a_joint(one, replace(other, platform=one.platform))
