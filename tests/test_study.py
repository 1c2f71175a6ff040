"""Study coordinates against plain rotation matrices: random rational poses, in two metrics."""

from collections.abc import Sequence
from fractions import Fraction

import pytest
from budgets import budget
from hypothesis import given
from hypothesis import strategies as st
from samples import METRICS

from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import integral
from pkm_exact.geometry.inverse import distance_squared, rotation_of
from pkm_exact.geometry.rotation import quaternion_norm, quaternion_products, scaled_rotation
from pkm_exact.geometry.study import (
    STUDY_CONDITION,
    evaluate,
    form_quadric,
    motion_quadrics,
    translation_coordinates,
)

Metric = tuple[int, int, int]
Vector = tuple[Fraction, Fraction, Fraction]
Quaternion = tuple[Fraction, Fraction, Fraction, Fraction]

numbers = st.fractions(min_value=-20, max_value=20, max_denominator=12)
vectors = st.tuples(numbers, numbers, numbers)
quaternions = st.tuples(numbers, numbers, numbers, numbers).filter(any)
metrics = st.sampled_from([*METRICS, (2, 3, 5)])


def _products(vector: Sequence[Fraction]) -> list[list[Fraction]]:
    return [[a * b for b in vector] for a in vector]


def leg_form(leg: Distance, metric: Metric) -> tuple[int, ...]:
    (form,) = leg.forms(metric)
    return integral(form)


def _study(quaternion: Sequence[Fraction], position: Sequence[Fraction], metric: Metric) -> list[Fraction]:
    """(e, f) of a pose."""
    translation = translation_coordinates([[c * e for e in quaternion] for c in position], metric)
    return [*quaternion, *translation]


@given(quaternions, metrics)
def test_rotations_keep_the_metric_and_orientation(quaternion: Quaternion, metric: Metric) -> None:
    r = rotation_of(quaternion, metric)
    for i in range(3):
        for j in range(3):
            assert sum(metric[k] * r[k][i] * r[k][j] for k in range(3)) == (metric[i] if i == j else 0)
    determinant = sum(
        r[0][i] * (r[1][(i + 1) % 3] * r[2][(i + 2) % 3] - r[1][(i + 2) % 3] * r[2][(i + 1) % 3]) for i in range(3)
    )
    assert determinant == 1


@given(quaternions, metrics)
def test_the_matrix_gives_the_quaternion_back(quaternion: Quaternion, metric: Metric) -> None:
    products = _products(quaternion)
    norm = quaternion_norm(products, metric)
    found = quaternion_products(rotation_of(quaternion, metric), Fraction(1), [Fraction(g) for g in metric])
    assert found == [[4 * value / norm for value in row] for row in products]


@given(quaternions, vectors, metrics)
def test_motion_quadrics_are_what_they_are_called(quaternion: Quaternion, position: Vector, metric: Metric) -> None:
    x = _study(quaternion, position, metric)
    products = _products(x)
    assert evaluate(STUDY_CONDITION, products) == 0
    values = [evaluate(quadric, products) for quadric in motion_quadrics(metric)]
    norm = quaternion_norm(_products(quaternion), metric)
    r = rotation_of(quaternion, metric)
    # u = R^-1 C = G^-1 R^T G C.
    turned = [sum(r[i][j] * metric[i] * position[i] for i in range(3)) / metric[j] for j in range(3)]
    square = sum(g * c * c for g, c in zip(metric, position, strict=True))
    expected = [square, *turned, *position, *(entry for row in r for entry in row), 1]
    assert values == [norm * value for value in expected]


@given(quaternions, vectors, vectors, vectors, metrics, numbers.filter(bool))
@budget(50)
def test_a_leg_vanishes_at_its_length_and_nowhere_else(
    quaternion: Quaternion, position: Vector, base: Vector, platform: Vector, metric: Metric, other: Fraction
) -> None:
    products = _products(_study(quaternion, position, metric))
    length = distance_squared(base, platform, position, rotation_of(quaternion, metric), metric)
    assert evaluate(form_quadric(leg_form(Distance(base, platform, length), metric), metric), products) == 0
    wrong = Distance(base, platform, length + other)
    norm = quaternion_norm(_products(quaternion), metric)
    form = leg_form(wrong, metric)
    assert evaluate(form_quadric(form, metric), products) == -other * norm * form[0]


@given(quaternions, quaternions, vectors, vectors, metrics)
@budget(50)
def test_different_poses_have_different_coordinates(
    first: Quaternion, second: Quaternion, here: Vector, there: Vector, metric: Metric
) -> None:
    same = rotation_of(first, metric) == rotation_of(second, metric) and here == there
    x, y = _study(first, here, metric), _study(second, there, metric)
    assert same == all(x[i] * y[j] == x[j] * y[i] for i in range(8) for j in range(i))


@given(quaternions, numbers.filter(bool), metrics)
def test_the_scale_of_a_quaternion_does_not_matter(quaternion: Quaternion, scale: Fraction, metric: Metric) -> None:
    scaled = tuple(scale * value for value in quaternion)
    assert rotation_of(quaternion, metric) == rotation_of(scaled, metric)


@pytest.mark.parametrize("metric", METRICS)
def test_no_turn_is_the_identity(metric: tuple[int, int, int]) -> None:
    products = _products((Fraction(2), Fraction(0), Fraction(0), Fraction(0)))
    norm = quaternion_norm(products, metric)
    matrix = scaled_rotation(products, metric)
    assert matrix == [[norm * (i == j) for j in range(3)] for i in range(3)]
