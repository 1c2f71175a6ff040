"""Redundant axes under strokes of legs: closed intervals with exact ends."""

from fractions import Fraction
from functools import cache
from itertools import pairwise
from math import prod

import pytest
from budgets import budget
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact import InputError
from pkm_exact.constraints.distance import Distance
from pkm_exact.geometry.feasible_axes import feasible_positions
from pkm_exact.geometry.inverse import distance_squared, rotation_of
from pkm_exact.geometry.machines.machine_kinds import MACHINES
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.quadratic_ranges import ranges_of
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.regions.feasible_set import FeasibleSet, feasible_set
from pkm_exact.templates.machine_text import given_dimensions, machine_text

numbers = st.fractions(-6, 6, max_denominator=4)
POSE = (Fraction(1), Fraction(2), Fraction(6)), rotation_of((Fraction(9), Fraction(1), Fraction(-1), Fraction(2)))
AXES: dict[str, Fraction] = {"X": Fraction(1), "Y": Fraction(2), "tilt": Fraction(1, 3)}


@budget(40)
@given(st.lists(st.tuples(numbers, numbers, numbers), max_size=3), numbers)
def test_a_number_is_in_the_ranges_exactly_if_no_polynomial_is_negative_there(
    conditions: list[tuple[Fraction, Fraction, Fraction]], x: Fraction
) -> None:
    found = ranges_of(conditions, Fraction(-5), Fraction(5))
    inside = any((x - low).sign() >= 0 and (high - x).sign() >= 0 for low, high in found)
    assert inside == (-5 <= x <= 5 and all(a * x * x + b * x + c >= 0 for a, b, c in conditions))
    assert all((low - end).sign() > 0 for (_, end), (low, _) in pairwise(found))


def test_ranges_may_be_points() -> None:
    one, zero = Fraction(1), Fraction(0)
    (point,) = ranges_of([(-one, zero, zero)], -one, one)
    assert point[0].sign() == point[1].sign() == 0
    assert len(ranges_of([(one, zero, zero)], -one, one)) == 1, "a double root divides nothing"
    assert ranges_of([(one, zero, one)], one, -one) == ()


def carriage(heading: str = "0") -> Mechanism:
    kind = MACHINES["carriage-hexapod"]
    robot = robot_from_toml(machine_text(kind, "r", "m", given_dimensions(kind, [f'heading="{heading}"'])))
    assert isinstance(robot, Mechanism)
    return robot


def lengths_squared(robot: Mechanism, axes: dict[str, Fraction]) -> list[Fraction]:
    """Of all legs at the pose, by the locked mechanism."""
    t = axes["tilt"]
    crank = ((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t))
    legs = robot.locked([*[Fraction(1)] * 6, axes["X"], axes["Y"], crank], "here")
    assert all(isinstance(leg, Distance) for leg in legs)
    return [distance_squared(leg.base, leg.platform, *POSE) for leg in legs]  # type: ignore[attr-defined]


@pytest.mark.parametrize("heading", ["0", "90"])
@pytest.mark.parametrize("axis", ["X", "Y", "tilt"])
def test_the_feasible_set_of_each_redundant_axis(axis: str, heading: str) -> None:
    """At every sampled position the legs are within their strokes exactly if it is in an interval."""
    robot = carriage(heading)
    legs = Fraction(2), Fraction(12)
    t = AXES["tilt"]
    others: dict[str, object] = {**AXES, "tilt": ((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t))}
    del others[axis]
    found = feasible_positions(robot, axis, others, POSE, legs, (Fraction(-20), Fraction(20)))  # type: ignore[arg-type]
    assert found
    seen = set()
    for k in range(-80, 81):
        x = Fraction(k, 4)
        inside = any((x - low).sign() >= 0 and (high - x).sign() >= 0 for low, high in found)
        squares = lengths_squared(robot, {**AXES, axis: x})
        assert inside == all(legs[0] ** 2 <= square <= legs[1] ** 2 for square in squares)
        seen.add(inside)
    assert seen == {True, False}
    for end in (end for both in found for end in both):
        low, high = (lengths_squared(robot, {**AXES, axis: x}) for x in end.bounds(80))
        limits = [Fraction(20)] if end.rational and abs(end.rational) == 20 else []
        near = [min(abs(s - bound**2) for s in (*low, *high) for bound in legs)]
        assert limits or near[0] < Fraction(1, 10**12)


def test_what_cannot_be_asked_is_refused() -> None:
    robot, stroke = carriage(), (Fraction(-1), Fraction(1))
    with pytest.raises(InputError, match="axis: 'Z' is not a slide or a crank"):
        feasible_positions(robot, "Z", {}, POSE, stroke, stroke)
    with pytest.raises(InputError, match="axis: 'leg 1' is not"):
        feasible_positions(robot, "leg 1", {}, POSE, stroke, stroke)
    with pytest.raises(InputError, match="legs: not a stroke"):
        feasible_positions(robot, "X", {}, POSE, stroke, stroke)
    with pytest.raises(InputError, match="others: no value of 'Y'"):
        feasible_positions(robot, "X", {}, POSE, (Fraction(0), Fraction(1)), stroke)


# Several axes together

STROKES = {"X": (Fraction(-8), Fraction(8)), "Y": (Fraction(-16), Fraction(8)), "tilt": (Fraction(-1), Fraction(3))}
LEGS = Fraction(2), Fraction(14)


@cache
def found(heading: str, names: tuple[str, ...], most_parts: int = 120) -> FeasibleSet:
    t = AXES["tilt"]
    others = {**AXES, "tilt": ((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t))}
    axes = {name: STROKES[name] for name in names}
    rest = {name: value for name, value in others.items() if name not in names}
    return feasible_set(carriage(heading), axes, rest, POSE, LEGS, most_parts=most_parts)  # type: ignore[arg-type]


def volume(part: tuple[tuple[Fraction, Fraction], ...]) -> Fraction:
    return prod((high - low for low, high in part), start=Fraction(1))


@pytest.mark.parametrize(("heading", "names"), [("0", ("X", "Y")), ("-90", ("tilt", "X")), ("90", ("X", "Y", "tilt"))])
def test_parts_cover_the_axes_and_say_what_is_true(heading: str, names: tuple[str, ...]) -> None:
    """At corners and in the middle of every part that is decided, by the lengths of the locked mechanism."""
    answer, robot = found(heading, names), carriage(heading)
    parts = (*answer.inside, *answer.outside, *answer.undecided)
    assert sum(map(volume, parts)) == volume(tuple(STROKES[name] for name in names))
    assert len(parts) <= 120
    assert answer.inside
    assert answer.outside
    for part, expected in [(p, True) for p in answer.inside] + [(p, False) for p in answer.outside]:
        middle = tuple((low + high) / 2 for low, high in part)
        for point in (middle, tuple(low for low, _ in part), tuple(high for _, high in part)):
            squares = lengths_squared(robot, {**AXES, **dict(zip(names, point, strict=True))})
            assert all(LEGS[0] ** 2 <= square <= LEGS[1] ** 2 for square in squares) is expected


def test_parts_are_those_of_the_exact_intervals_of_one_axis() -> None:
    """On the lines along X through the middles of parts."""
    answer, robot = found("0", ("X", "Y")), carriage()
    t = AXES["tilt"]
    tilt = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    for _, (low, high) in (answer.inside[0], answer.inside[-1], answer.outside[-1]):
        y = (low + high) / 2
        exact = feasible_positions(robot, "X", {"Y": y, "tilt": tilt}, POSE, LEGS, STROKES["X"])  # type: ignore[dict-item]
        for parts, expected in ((answer.inside, True), (answer.outside, False)):
            for (start, end), (below, above) in parts:
                if below <= y <= above:
                    meets = [(a - end).sign() <= 0 and (b - start).sign() >= 0 for a, b in exact]
                    holds = [(a - start).sign() <= 0 and (b - end).sign() >= 0 for a, b in exact]
                    assert any(holds) if expected else not any(meets)


def test_more_parts_say_more() -> None:
    few, many = (found("0", ("X", "Y"), most).volume for most in (40, 120))
    assert few[0] <= many[0] <= many[1] <= few[1]
    assert few != many


@pytest.mark.parametrize(
    ("axes", "others", "legs", "words"),
    [
        ({}, {}, LEGS, "axes: none given"),
        ({"Z": LEGS}, {}, LEGS, "'Z' is not a slide or a crank"),
        ({"X": (Fraction(1), Fraction(1))}, {}, LEGS, "axes, 'X': not a stroke"),
        ({"X": LEGS}, {"Y": Fraction(0)}, LEGS, "others: no value of 'tilt'"),
        ({"X": LEGS}, {}, LEGS[::-1], "legs: not a stroke of lengths"),
    ],
)
def test_what_is_no_question_about_axes_is_refused(axes: object, others: object, legs: object, words: str) -> None:
    with pytest.raises(InputError, match=words):
        feasible_set(carriage(), axes, others, POSE, legs)  # type: ignore[arg-type]


def test_legs_without_stroke_are_none() -> None:
    robot = robot_from_toml(machine_text(MACHINES["delta"], "r", "m"))
    assert isinstance(robot, Mechanism)
    arms = {f"arm {k}": (Fraction(0), Fraction(1)) for k in (1, 2, 3)}
    with pytest.raises(InputError, match="has no legs of actuated length"):
        feasible_set(robot, arms, {}, POSE, LEGS)
