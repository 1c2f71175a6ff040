"""Cranks written in decimals: made exact within the last digit, said so, and refused where they are no cranks."""

import json
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact.cli.main import main
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import Crank
from pkm_exact.geometry.exact_cranks import exact_crank
from pkm_exact.geometry.inverse import UNIT_METRIC
from pkm_exact.geometry.reader import read_robot, robot_from_toml

CASES = Path(__file__).parent / "cases"
MODELS = Path(__file__).parent.parent / "models"
Capture = pytest.CaptureFixture[str]
coordinates = st.integers(-60, 60).map(Fraction)
vectors = st.tuples(coordinates, coordinates, coordinates)


@given(vectors.filter(any), vectors.filter(any), st.integers(2, 5))
def test_rounded_cranks_become_exact_ones_within_the_last_digit(
    first: tuple[Fraction, ...], second: tuple[Fraction, ...], digits: int
) -> None:
    digit = Fraction(1, 10**digits)
    norms = [float(sum(x * x for x in v)) ** 0.5 for v in (first, second)]
    u = [float(x) / norms[0] for x in first]
    across = [
        float(x) - sum(a * float(b) for a, b in zip(u, second, strict=True)) * y for x, y in zip(second, u, strict=True)
    ]
    size = sum(x * x for x in across) ** 0.5
    if size < 1e-6 * norms[1]:
        return
    at_0 = tuple(round(Fraction(20 * x) / digit) * digit for x in u)
    at_90 = tuple(round(Fraction(20 * x / size) / digit) * digit for x in across)
    made = exact_crank(at_0, at_90, 3 * digit)  # type: ignore[arg-type]
    assert made is not None
    crank = Crank(made[0], made[1], Fraction(1))
    assert crank.is_exact(UNIT_METRIC)
    assert made[2] <= 3 * digit


def test_vectors_that_are_no_crank_are_not_made_one() -> None:
    one, zero = Fraction(1), Fraction(0)
    assert exact_crank((one, zero, zero), (one, one, zero), Fraction(1, 100)) is None
    assert exact_crank((one, zero, zero), (zero, 2 * one, zero), Fraction(1, 100)) is None
    assert exact_crank((one, zero, zero), (one, zero, zero), Fraction(1, 100)) is None
    assert exact_crank((zero, zero, zero), (one, zero, zero), Fraction(1, 100)) is None
    assert exact_crank((zero, zero, zero), (zero, zero, zero), Fraction(1, 100)) is None


@pytest.mark.parametrize("name", ["servo1", "c02-cranks-6digits"])
def test_servo_arms_in_decimals_are_taken_and_the_answer_says_what_stands_in(name: str, capsys: Capture) -> None:
    path = CASES / f"{name}.toml"
    robot = read_robot(path)
    digit = Fraction(1, 1000) if name == "servo1" else Fraction(1, 10**6)
    assert len(robot.stand_ins) == 1  # type: ignore[union-attr]
    for crank in robot.chains:  # type: ignore[union-attr]
        assert crank.is_exact(UNIT_METRIC)
        size = sum(x * x for x in crank.at_0)
        assert size in (625, Fraction(1, 625))
    text = path.read_text()
    assert "21.651" in text or "0.034641" in text
    assert main(["solve", str(path), "--format", "json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["claim"] == "complete"
    assert any("exact vectors stand in for them" in note for note in answer["notes"])
    assert float(digit) > 0


def test_exact_cranks_stay_as_they_are_written() -> None:
    robot = read_robot(MODELS / "hexa.toml")
    assert robot.stand_ins == ()  # type: ignore[union-attr]


def test_what_is_no_crank_is_refused_as_before() -> None:
    text = (CASES / "servo1.toml").read_text().replace("[21.651, 12.500, 0.000]", "[21.9, 12.500, 0.000]")
    with pytest.raises(InputError, match="cranks, leg 3: at_0 and at_90 have the squared lengths"):
        robot_from_toml(text)


def test_angles_are_printed_in_degrees(capsys: Capture) -> None:
    words = ["legs", str(CASES / "servo1.toml"), "--position", "0,0,118", "--rpy", "0,0,0"]
    assert main(words) == 0
    lines = capsys.readouterr().out.splitlines()
    head = next(line for line in lines if "half tangent" in line)
    assert "angle [degrees]" in head
    first = lines[lines.index(head) + 1].split()
    assert -180 <= float(first[1]) <= 180
