"""Answers that rest on digits which rounded data do not have are said to, and the exact robot nearby is named."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from random import Random

import pytest
from samples import MODELS, boxed, solved

from pkm_exact import solve_many
from pkm_exact.cli.main import main
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.hexagons import semi_regular_hexagon
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.reader import read_robot, robot_from_toml
from pkm_exact.geometry.working_modes import platform_point
from pkm_exact.interactive.answer_notes import answer_notes, digit_notes, written_digit
from pkm_exact.interactive.display import solution_html
from pkm_exact.numeric.path_forms import problem_at
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.poses.nearby_shape import PAIRINGS, nearby_shape
from pkm_exact.sweep.lengths import LengthRow
from pkm_exact.sweep.record import solution_line

ROUNDED = Path(__file__).parent / "cases" / "c04-66-rot.toml"
"""Regular hexagons, turned and rounded to a micron: exactly, the leg equations are dependent."""
DIGIT = Fraction(1, 1000)
FILES = {path.stem: path for path in MODELS}
Capture = pytest.CaptureFixture[str]


def test_a_singularity_hidden_by_rounding_is_named(capsys: Capture) -> None:
    assert main(["solve", str(ROUNDED), "--format", "json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    doubt, name = answer["notes"]
    assert doubt.startswith("all 12 poses: the condition number times the last digit written in the model, 0.001, is")
    assert "digits that the data do not have" in doubt
    assert "base and platform are regular hexagons and all legs are equal" in name
    assert "the leg equations are dependent in every pose (an architecture singularity), and it moves" in name


def test_the_note_is_none_of_the_solution_and_in_no_certificate() -> None:
    """A certificate has the same bytes however the decimals of its model were written."""
    text = FILES["dietmaier"].read_text()
    robot = robot_from_toml(text)
    assert robot.written_digit == Fraction(1, 10**6)
    solution = boxed("dietmaier")
    assert answer_notes(robot, "forty", solution) == solution.notes, "74,000 micro-units are less than its size"
    locked = tuple(replace(entry, written_digit=None) for entry in robot.configurations)
    coarse = replace(robot, written_digit=Fraction(1, 10**4), configurations=locked)
    assert coarse == robot
    assert "the data do not have" in answer_notes(coarse, "forty", solution)[-1]
    assert "the data do not have" not in " ".join(solution.notes)


@pytest.mark.parametrize("name", [name for name in FILES if name not in ("hexaglide", "ssm-rounded")])
def test_no_shipped_robot_rests_on_digits_that_it_does_not_have(name: str) -> None:
    robot = read_robot(FILES[name])
    solution = solved(name) if name.startswith("3-") else boxed(name)
    assert digit_notes(solution.problem, solution.poses, written_digit(robot, robot.configurations[0].name)) == ()


def test_integers_and_fractions_have_all_their_digits() -> None:
    text = FILES["3-rpr-double-q"].read_text()
    robot = robot_from_toml(text)
    solution = solved("3-rpr-double-q")
    assert any(pose.condition is None for pose in solution.poses)
    assert written_digit(robot, robot.configurations[0].name) is None
    assert digit_notes(solution.problem, solution.poses, None) == ()
    (note,) = digit_notes(solution.problem, solution.poses, DIGIT)
    assert note.startswith("pose 1: "), "a pose that is singular by decimals only"
    decimal = replace(robot, written_digit=DIGIT)
    assert "the data do not have" in solution_html(solution, decimal, None)
    assert "the data do not have" not in solution_html(solution, robot, None)


def test_the_reader_remembers_the_finest_decimal() -> None:
    text = """schema = 1
name = "v1.25"
kind = "3-RPR"
unit = "m"
source = "1.123456"
[base]
joints = [[0, 0], [1e-3, "1/3"], ["0.25", 5.0]]
[platform]
joints = [[0, 0], [4, 0], [2, 2]]
[[configurations]]
name = "0.00001"
lengths = [5, 5.0625, 4]
[[configurations]]
name = "whole"
lengths = [5, 5, 4]
"""
    robot = robot_from_toml(text)
    assert robot.written_digit == Fraction(1, 1000)
    assert [entry.written_digit for entry in robot.configurations] == [Fraction(1, 10**4), None]
    assert written_digit(robot, "0.00001") == Fraction(1, 10**4)
    assert written_digit(robot, "whole") == written_digit(robot, None) == Fraction(1, 1000)
    exact = robot_from_toml(text.replace("1e-3", "1").replace('"0.25", 5.0', "1, 5"))
    assert exact.written_digit is None


# The exact robot nearby


def rounded_robot(
    base: tuple[Fraction, Fraction], platform: tuple[Fraction, Fraction], order: list[int], seed: int
) -> ForwardProblem:
    """Exact hexagons, moved anywhere, in ordinary coordinates rounded to a micron; all legs 150 long."""
    random = Random(seed)
    sides = []
    for given, places in ((base, range(6)), (platform, order)):
        turn = rotation_of((Fraction(7), *(Fraction(random.randint(-4, 4)) for _ in range(3))))  # type: ignore[arg-type]
        shift = tuple(Fraction(random.randint(-90, 90)) for _ in range(3))
        corners = semi_regular_hexagon(*given)
        sides.append([_rounded(platform_point(_ordinary(corners[k]), shift, turn)) for k in places])  # type: ignore[arg-type]
    return ForwardProblem(tuple(Distance(a, b, Fraction(22500)) for a, b in zip(*sides, strict=True)))


def _ordinary(corner: Vector) -> Vector:
    return corner[0], corner[1] * Fraction(1732050807568877, 10**15), corner[2]


def _rounded(point: Vector) -> Vector:
    x, y, z = (round(value / DIGIT) * DIGIT for value in point)
    return x, y, z


SIX = Fraction(120), Fraction(120)
IN_ORDER = list(range(6))


@pytest.mark.parametrize(
    ("base", "platform", "order", "facts", "singular", "moves"),
    [
        (SIX, (Fraction(70), Fraction(70)), IN_ORDER, "base and platform are regular hexagons", True, True),
        (SIX, (Fraction(70), Fraction(70)), IN_ORDER[::-1], "base and platform are regular hexagons", True, True),
        (SIX, (Fraction(30), Fraction(90)), IN_ORDER, "the base is a regular hexagon", False, False),
        ((Fraction(20), Fraction(90)), (Fraction(40), Fraction(180)), IN_ORDER, "hexagons of equal angles", True, True),
        (
            (Fraction(20), Fraction(90)),
            (Fraction(90), Fraction(20)),
            IN_ORDER,
            "hexagons of equal angles",
            False,
            False,
        ),
    ],
)
def test_hexagons_are_found_wherever_they_stand(
    base: tuple[Fraction, Fraction],
    platform: tuple[Fraction, Fraction],
    order: list[int],
    facts: str,
    singular: bool,
    moves: bool,
) -> None:
    for seed in range(3):
        found = nearby_shape(rounded_robot(base, platform, order, seed), DIGIT)
        assert facts in " and ".join(found.facts)
        assert found.facts[-1] == "all legs are equal"
        assert (found.is_singular, found.moves) == (singular, moves)


def test_parallel_chords_are_named_and_general_robots_are_not() -> None:
    assert len(set(PAIRINGS)) == 15
    legs = solved("mourrain-l").problem.distances
    assert nearby_shape(ForwardProblem(legs), DIGIT).facts == ()
    base = [(3, 1), (-3, 1), (5, 4), (2, -6), (-2, -6), (-5, 4)]
    platform = [(2, 2), (-2, 2), (3, 1), (1, -1), (-1, -1), (-3, 1)]
    sides = [
        [(Fraction(x), Fraction(y) + Fraction(k, 2000), Fraction(0)) for k, (x, y) in enumerate(side)]
        for side in (base, platform)
    ]
    lengths = [Fraction(90 + k) for k in range(6)]
    mirrored = ForwardProblem(tuple(map(Distance, *sides, lengths)))
    assert nearby_shape(mirrored, DIGIT).facts == ("the chords 1-2, 3-6, 4-5 of base and platform are parallel",)
    assert nearby_shape(mirrored, DIGIT / 100).facts == ()


def test_rows_of_a_batch_say_it_too() -> None:
    robot = robot_from_toml(FILES["3-rpr-merlet-p"].read_text())
    row = ["7", "5", "5"]
    plain = solve_many(replace(robot, written_digit=None), [row])
    doubted = solve_many(replace(robot, written_digit=Fraction(1)), [row])
    assert "the data do not have" in str(doubted.rows["note"][0])
    assert "the data do not have" not in str(plain.rows["note"][0])
    solution = solve_krawczyk(problem_at(robot, tuple(map(Fraction, row))))
    read = LengthRow(1, 1, tuple(row), None)
    notes = [
        json.loads(solution_line(read, replace(robot, written_digit=digit), None, solution, b""))["notes"]
        for digit in (None, Fraction(1))
    ]
    assert "the data do not have" in " ".join(notes[1])
    assert notes[0] == list(solution.notes)
