"""The pose from redundant sensors: chapter 7's linear solution as it should be, and Horn's quartic."""

from fractions import Fraction
from random import Random

import pytest

from pkm_exact import InputError
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.identification.linear_pose import (
    LegReading,
    LinearPose,
    line_of_leg,
    linear_pose,
    plane_of_leg,
    point_of_leg,
)

ZERO = Fraction(0)


def vector(random: Random) -> Vector:
    x, y, z = (Fraction(random.randint(-9, 9), random.randint(1, 4)) for _ in range(3))
    return x, y, z


def plus(u: Vector, v: Vector, factor: int = 1) -> Vector:
    return (u[0] + factor * v[0], u[1] + factor * v[1], u[2] + factor * v[2])


def times(rows: tuple[Vector, ...], v: Vector) -> Vector:
    x, y, z = (sum((a * b for a, b in zip(row, v, strict=True)), ZERO) for row in rows)
    return x, y, z


def cross(u: Vector, v: Vector) -> Vector:
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def layout(kinds: str, seed: int) -> tuple[list[LegReading], Vector, tuple[Vector, ...]]:
    """Exact readings at a random pose: a plane, a line or a point for each leg."""
    random = Random(seed)
    position, rotation = vector(random), rotation_of((Fraction(2), *vector(random)))
    found = []
    for kind in kinds:
        base, joint = vector(random), vector(random)
        leg = plus(plus(position, times(rotation, joint)), base, -1)
        if kind == "1":
            found.append(plane_of_leg(base, joint, cross(leg, vector(random))))
        elif kind == "2":
            found.append(line_of_leg(base, joint, leg))
        else:
            found.append(point_of_leg(base, joint, leg))
    return found, position, rotation


def gradient(readings: list[LegReading], found: LinearPose) -> list[Fraction]:
    """Of the sum of squares over position and matrix, written without any elimination."""
    slopes = [ZERO] * 12
    for r in readings:
        place = plus(plus(found.position, times(found.matrix, r.joint)), r.base, -1)
        left = plus(times(r.projection, place), r.leg, -1)
        back = times(r.projection, left)
        for i in range(3):
            slopes[i] += back[i]
            for j in range(3):
                slopes[3 + 3 * i + j] += back[i] * r.joint[j]
    return slopes


@pytest.mark.parametrize("kinds", ["333211", "222222", "333311", "3333", "332221"])
@pytest.mark.parametrize("seed", [1, 3])
def test_exact_readings_of_any_layout_give_the_pose(kinds: str, seed: int) -> None:
    readings, position, rotation = layout(kinds, seed)
    found = linear_pose(readings)
    assert (found.position, found.matrix) == (position, rotation)
    assert (found.residual, found.is_rotation) == (0, True)


def test_readings_that_do_not_fit_have_their_least_squares() -> None:
    readings, *_ = layout("333311", 3)
    random = Random(4)
    noisy = [LegReading(r.base, plus(r.joint, vector(random)), r.projection, r.leg) for r in readings]
    found = linear_pose(noisy)
    assert gradient(noisy, found) == [ZERO] * 12
    assert found.residual > 0
    assert not found.is_rotation


def printed_residual(readings: list[LegReading], rotation: tuple[Vector, ...]) -> Fraction:
    """Of equation 10.5 as printed, at the pose that the readings were made of: the last W_i is missing."""
    from pkm_exact.screws.exact_matrix import flint_matrix, rows_of

    whole = [[sum((r.projection[i][j] for r in readings), ZERO) for j in range(3)] for i in range(3)]
    inverse = rows_of(flint_matrix(whole, 3).inv())
    legs: Vector = (ZERO, ZERO, ZERO)
    offsets: Vector = (ZERO, ZERO, ZERO)
    for r in readings:
        legs = plus(legs, r.leg)
        offsets = plus(offsets, times(r.projection, plus(times(rotation, r.joint), r.base, -1)))
    found = ZERO
    for r in readings:
        left = times(r.projection, plus(times(rotation, r.joint), r.base, -1))
        left = plus(left, times(r.projection, times(inverse, offsets)), -1)  # type: ignore[arg-type]
        right = plus(r.leg, times(inverse, legs), -1)  # type: ignore[arg-type]
        found += sum((x * x for x in plus(left, right, -1)), ZERO)
    return found


def test_equation_10_5_as_printed_does_not_hold() -> None:
    mixed, _, rotation = layout("333211", 5)
    assert printed_residual(mixed, rotation) > 1
    whole, _, rotation = layout("3333", 5)
    assert printed_residual(whole, rotation) == 0, "with points alone each W_i is 1"


def test_readings_that_are_too_few_are_refused() -> None:
    with pytest.raises(InputError, match="do not determine the position"):
        linear_pose(layout("11", 1)[0])
    with pytest.raises(InputError, match="determine 6 of 9 entries"):
        linear_pose(layout("333", 1)[0])
    with pytest.raises(InputError, match="direction: is 0"):
        line_of_leg((ZERO,) * 3, (ZERO,) * 3, (ZERO,) * 3)
