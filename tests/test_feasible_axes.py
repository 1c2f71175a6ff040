"""Redundant axes under strokes of legs: closed intervals with exact ends."""

from fractions import Fraction
from itertools import pairwise

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
