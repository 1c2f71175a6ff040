"""Krawczyk's operator over all equations it is used for, and over equations whose solutions are known."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import product
from math import isqrt
from random import Random
from typing import Any, TypeAlias

import pytest
from flint import acb_mat, arb, arb_mat
from samples import shipped

from pkm_exact.balls import Balls, ball
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import MOTIONS, SPATIAL
from pkm_exact.numeric.centred import centred_frames, centred_robot, gradients, quantities_at
from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.charts import chart_row, chart_values, in_chart
from pkm_exact.numeric.data_errors import data_errors
from pkm_exact.numeric.krawczyk_operator import Equations, around_zero, holds_one, inflated, krawczyk
from pkm_exact.numeric.linearisation import centred_jacobian, linearise
from pkm_exact.numeric.path_equations import path_equations
from pkm_exact.numeric.path_forms import PathForms
from pkm_exact.precision import working_precision

BITS = 128
Column: TypeAlias = Balls
Case: TypeAlias = tuple[Equations, Balls, Column, Callable[[Column], Balls]]
"""Equations, Y, a point, and F' at any point for one choice of the parameters, from which F follows."""
ROBOT = "3-rpr-merlet-p"


@dataclass(frozen=True)
class Square:
    """F(x) = x^2 - 2 near a point."""

    point: Fraction

    is_real = True

    @property
    def inverse(self) -> arb:
        return 1 / (2 * ball(self.point))

    @property
    def residual(self) -> arb_mat:
        return arb_mat([[self.inverse * (ball(self.point) ** 2 - 2)]])

    def jacobian(self, box: arb_mat) -> arb_mat:
        return arb_mat([[self.inverse * 2 * (ball(self.point) + box[0, 0])]])


@pytest.mark.parametrize(
    ("point", "radius", "expected"),
    [
        ("1.41", "0.01", True),
        ("-1.41", "0.01", True),
        ("1.4", "0.5", True),
        ("1.41", "0.004", False),  # the root is outside
        ("1.41421", "1.5", False),  # F' can be 0
        ("0.1", "2", False),  # both roots
        ("7", "1", False),
    ],
)
def test_boxes_around_the_root_of_two(point: str, radius: str, expected: bool) -> None:
    assert holds_one(Square(Fraction(point)), [ball(Fraction(radius))]) is expected


def test_a_box_is_found_by_enlarging_what_is_too_small() -> None:
    def twice(values: Sequence[arb]) -> list[arb]:
        return [2 * abs(value).upper() for value in values]

    near = Square(Fraction("1.4"))
    assert not holds_one(near, [arb("0.001")])
    found = inflated(near, [arb("0.001")], twice, 3)
    assert found is not None
    radii, image = found
    assert holds_one(near, radii)
    assert image.moved[0, 0].contains(arb(2).sqrt().mid() - ball(Fraction("1.4")).mid())
    assert inflated(near, [arb("0.001")], twice, 1) is None
    assert inflated(Square(Fraction("0.1")), [arb("0.001")], twice, 9) is None


# The equations of robots: for every point x of a box X the operator encloses x - Y F(x).


def _point(size: int, random: Random, kind: Any) -> Column:
    return kind(size, 1, [ball(Fraction(random.randint(-99, 99), 64)) for _ in range(size)])


def _exact_equations(random: Random) -> Case:
    problem = shipped(ROBOT)
    system = ChartSystem(problem, (3, 0, 0, -1))
    near = system.around(_point(system.size, random, arb_mat))
    assert near is not None
    return near, near.inverse, near.point, system.jacobian


def _within(tolerances: Tolerances, random: Random) -> ForwardProblem:
    """A robot within tolerance, often at its bounds."""
    problem = shipped(ROBOT)

    def off(bound: Fraction) -> Fraction:
        return bound * random.choice([-1, 1, Fraction(random.randint(-100, 100), 100)])

    def moved(joint: Vector, bound: Fraction) -> Vector:
        return joint[0] + off(bound), joint[1] + off(bound), joint[2]

    def square(leg: Distance) -> Fraction:
        """Of a length almost as wrong as it may be, if any is."""
        length = Fraction(isqrt(int(leg.length_squared * 10**8)), 10**4) if tolerances.lengths else None
        return leg.length_squared if length is None else (length + off(tolerances.lengths * Fraction(99, 100))) ** 2

    legs = [
        Distance(moved(leg.base, tolerances.base), moved(leg.platform, tolerances.platform), square(leg))
        for leg in problem.distances
    ]
    return replace(problem, constraints=tuple(legs))


def _near(tolerances: Tolerances, random: Random) -> Case:
    problem = shipped(ROBOT)
    frames = centred_frames(problem)
    nominal = centred_robot(problem, frames)
    chart = ((5, 0), (0, 0), (0, 0), (2, 0))
    near = linearise(nominal, chart, _point(nominal.size, random, acb_mat))
    assert near is not None

    robot = centred_robot(_within(tolerances, random), frames)

    def jacobian(x: Column) -> Balls:
        return centred_jacobian(robot, robot.forms, chart, gradients(x, problem.motion)[0])

    return near.with_errors(data_errors(nominal, tolerances)), near.inverse, near.centre, jacobian


def _with_errors(base: int, platform: int, lengths: int) -> Callable[[Random], Case]:
    """Robots off by so many tenths."""
    return partial(_near, Tolerances(Fraction(base, 10), Fraction(platform, 10), Fraction(lengths, 10)))


def _path_equations(random: Random, *, vanishing: bool = False) -> Case:
    """Forms that vanish in the middle of the step are left to what the path parameter adds."""
    motion = shipped(ROBOT).motion
    size = len(motion.support)

    def matrix(rows: int, columns: int) -> arb_mat:
        return arb_mat(rows, columns, [ball(Fraction(random.randint(-99, 99), 32)) for _ in range(rows * columns)])

    zeroth, first, second = (matrix(size - 1, 18) for _ in range(3))
    m, v, a = (matrix(size, 1) for _ in range(3))
    inverse, weights, middle, half = matrix(size, size), [4, -3], Fraction(int(not vanishing), 4), Fraction(1, 8)
    zeroth *= int(not vanishing)
    near = path_equations(
        PathForms(motion, (zeroth, first, second)), weights, (m, v, a), inverse, ball(middle), ball(half)
    )
    t = half * random.choice([-1, 1, Fraction(random.randint(-100, 100), 100)])
    s = ball(middle + t)

    def jacobian(x: Column) -> Balls:
        upper = (zeroth + s * first + (s * s) * second) * gradients(x, motion)[0]
        return arb_mat(size, size, upper.entries() + chart_row(weights, motion))

    return near, inverse, m + ball(t) * v + ball(t * t) * a, jacobian


def _assert_enclosed(matrix: Balls, wanted: Balls) -> None:
    for enclosure, value in zip(matrix.entries(), wanted.entries(), strict=True):
        assert enclosure.overlaps(value)
        assert value.rad() < 1e-25


@pytest.mark.parametrize("width", [0, 1, 99, 9999])
@pytest.mark.parametrize(
    "equations",
    [
        _exact_equations,
        _with_errors(1, 1, 1),
        _with_errors(5, 0, 0),
        _with_errors(0, 5, 0),
        _with_errors(0, 0, 5),
        _path_equations,
        partial(_path_equations, vanishing=True),
    ],
)
def test_images_hold_what_single_equations_do_to_points_of_the_box(
    equations: Callable[[Random], Case], width: int
) -> None:
    with working_precision(BITS):
        for seed in range(5):
            random = Random(seed)
            near, inverse, point, jacobian = equations(random)
            radii = [ball(Fraction(random.randint(0, width), 1000)) for _ in range(point.nrows())]
            shares = [random.choice([-1, 1, Fraction(random.randint(-99, 99), 100)]) for _ in radii]
            offset = type(point)(
                len(radii), 1, [ball(Fraction(share)) * radius for share, radius in zip(shares, radii, strict=True)]
            )
            there, box = jacobian(point + offset), around_zero(near, radii)
            _assert_enclosed(near.jacobian(box), inverse * there)
            _assert_enclosed(krawczyk(near, box).moved, offset - inverse * chart_values(there, point + offset))
            _assert_enclosed(near.residual, inverse * chart_values(jacobian(point), point))


def test_a_nominal_jacobian_on_a_box_is_no_wider_than_it_must_be() -> None:
    """Every entry of Y F' is linear in x, so that a corner of the box attains its bound."""
    with working_precision(BITS):
        near, _, _, _ = _near(Tolerances.uniform("1"), Random(2))
        nominal = near.nominal
        radii = [arb(1), arb(2), arb(3), arb(4)]
        wide = nominal.jacobian(around_zero(nominal, radii)).entries()
        signs = product((-1, 1), repeat=4)
        corners = [[s * r for s, r in zip(sign, radii, strict=True)] for sign in signs]
        values = [nominal.jacobian(acb_mat(4, 1, corner)).entries() for corner in corners]
        for place, enclosure in enumerate(wide):
            highest = max(value[place].real.mid() for value in values)
            assert abs(enclosure.real.upper() - highest) < 1e-7  # radii have 30 bits


def test_errors_of_the_data_widen_images_in_proportion() -> None:
    with working_precision(BITS):
        assert max(value.rad() for value in _exact_equations(Random(1))[0].residual.entries()) < 1e-25
        one, tenth = (
            max(value.rad() for value in _near(Tolerances.uniform(t), Random(1))[0].residual.entries())
            for t in ("1/10", "1/100")
        )
        assert 8 < float(one / tenth) < 12


# Groups of motions that have as many Study coordinates


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_quantities_are_those_of_the_group_that_is_named(motion: Motion) -> None:
    random = Random(3)
    part = _point(len(motion.support), random, arb_mat)
    whole = arb_mat(8, 1, [part[motion.support.index(k), 0] if k in motion.support else 0 for k in range(8)])
    pairs = zip(quantities_at(part, motion), quantities_at(whole, SPATIAL), strict=True)
    assert all(one == other for one, other in pairs)


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_charts_ask_for_the_coordinates_of_rotations_only(motion: Motion) -> None:
    weights = [2, -3, 5, 7][: len(motion.rotation_support)]
    point = _point(len(motion.support), Random(4), arb_mat)
    product = (arb_mat([chart_row(weights, motion)]) * in_chart(point, weights))[0, 0]
    assert product.contains(1)
    assert product.rad() < 1e-12
