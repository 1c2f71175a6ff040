"""Semi-regular hexagons and triangles: side lengths and angles hold exactly in the metric (1, 3, 1)."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.hexagons import HEXAGON_METRIC, semi_regular_hexagon
from pkm_exact.geometry.inverse import distance_squared, dot, rotation_of

lengths = st.fractions(min_value=0, max_value=9, max_denominator=11)
ORIGIN: Vector = (Fraction(0), Fraction(0), Fraction(0))
IDENTITY = rotation_of((Fraction(1), *ORIGIN), HEXAGON_METRIC)


def _difference(a: Vector, b: Vector) -> Vector:
    x, y, z = (p - q for p, q in zip(a, b, strict=True))
    return x, y, z


@given(lengths, lengths, lengths)
def test_sides_angles_and_centre(p: Fraction, q: Fraction, height: Fraction) -> None:
    if p == q == 0:
        return
    joints = semi_regular_hexagon(p, q, height)
    edges = [_difference(joints[(i + 1) % 6], joints[i]) for i in range(6)]
    for i, edge in enumerate(edges):
        assert dot(edge, edge, HEXAGON_METRIC) == (p, q)[i % 2] ** 2
        assert dot(edge, edges[(i + 1) % 6], HEXAGON_METRIC) == p * q / 2  # 60 degrees at each corner
    assert [sum(column) for column in zip(*joints, strict=True)] == [0, 0, 6 * height]
    radius = {distance_squared(joint, ORIGIN, (*ORIGIN[:2], height), IDENTITY, HEXAGON_METRIC) for joint in joints}
    assert len(radius) == 1


@given(lengths.filter(bool), st.sampled_from([0, 1]))
def test_without_one_side_it_is_a_triangle_whose_joints_are_merged_in_pairs(side: Fraction, start: int) -> None:
    joints = semi_regular_hexagon(*((0, side) if start == 0 else (side, 0)), 1)
    for k in range(3):
        assert joints[(start + 2 * k) % 6] == joints[(start + 2 * k + 1) % 6]
    corners = sorted(set(joints))
    assert len(corners) == 3
    for i in range(3):
        edge = _difference(corners[i], corners[i - 1])
        assert dot(edge, edge, HEXAGON_METRIC) == side**2


def test_defects_give_one_sentence() -> None:
    with pytest.raises(InputError, match=r"sides\[1\]: 0.5 is a binary float"):
        semi_regular_hexagon(0.5, 1)
    with pytest.raises(InputError, match="both are 0"):
        semi_regular_hexagon(0, 0)
