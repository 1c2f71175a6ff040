"""Polytopes in exact arithmetic, against definitions and against each other."""

from fractions import Fraction
from itertools import combinations, product
from math import gcd
from random import Random

import numpy as np
import pytest
from budgets import budget
from flint import fmpz_mat
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact.errors import InputError
from pkm_exact.polytopes.combinations_of_polytopes import hull_of
from pkm_exact.polytopes.polytope import Polytope
from pkm_exact.polytopes.slabs import Slabs
from pkm_exact.polytopes.spanned_hyperplanes import maximal_minors, spanned_hyperplanes
from pkm_exact.polytopes.zonotope import Zonotope
from pkm_exact.radicals import RootSum

ONE = Fraction(1)


def zonotope(generators: list[tuple[int, ...]]) -> Zonotope:
    count = len(generators)
    squares = (ONE,) * len(generators[0])
    return Zonotope(tuple(generators), (ONE,) * count, (-ONE,) * count, (ONE,) * count, squares)


def slabs(rows: list[tuple[int, ...]], bounds: list[object] | None = None) -> Slabs:
    high = tuple(bounds or [ONE] * len(rows))
    return Slabs(tuple(tuple(map(Fraction, row)) for row in rows), tuple(-1 * x for x in high), high)


def is_consistent(found: Polytope) -> None:
    """Every vertex satisfies all facets and lies on those that list it; each facet and vertex has enough of each."""
    for number, vertex in enumerate(found.vertices):
        assert found.contains(vertex)
        for facet in found.facets:
            value = sum((RootSum.of(a) * b for a, b in zip(facet.normal, vertex, strict=True)), RootSum())
            assert ((facet.offset - value).sign() == 0) == (number in facet.vertices)
        assert sum(number in facet.vertices for facet in found.facets) >= found.dimension
    assert all(len(facet.vertices) >= found.dimension for facet in found.facets)


@given(st.lists(st.tuples(*[st.integers(-3, 3)] * 3), min_size=3, max_size=5))
@budget(12)
def test_zonotopes_of_any_generators(generators: list[tuple[int, ...]]) -> None:
    kept = [g for g in generators if any(g)]
    if len(kept) < 3 or np.linalg.matrix_rank(np.array(kept)) < 3:
        return
    found = zonotope(kept)
    is_consistent(found.polytope())
    assert found.polytope().volume == found.volume
    ends = np.array([np.sign(signs) @ np.array(kept) for signs in product((-1, 1), repeat=len(kept))])
    for normal, offset in found.facets:
        assert max(ends @ np.array(normal)) == offset  # brute force over all 2^m sums
    direction = np.array([7, 11, 13])
    assert max(float(np.dot(direction, [float(x) for x in v])) for v in found.vertices) == max(ends @ direction)
    counted = len(found.vertices) - len(found.polytope().facets)
    assert counted % 2 == 0


@pytest.mark.parametrize("n", [1, 2, 3, 5, 6])
def test_minors_and_normals_are_those_of_the_definitions(n: int) -> None:
    """Of the kernel or of the vectors themselves, few or many of them, with dependent ones among them."""
    random = Random(n)
    for count in (n, n + 1, n + 2, 2 * n + 1):
        vectors = [tuple(random.randint(-9, 9) for _ in range(n)) for _ in range(count)]
        vectors[-1] = tuple(3 * x for x in vectors[0]) if count > n else vectors[-1]
        minors = maximal_minors(vectors)
        assert list(minors) == list(combinations(range(count), n))
        for chosen, minor in minors.items():
            assert minor == int(fmpz_mat([vectors[k] for k in chosen]).det())
        found = spanned_hyperplanes(vectors, minors)
        assert len({normal for normal, _ in found}) == len(found)
        for normal, products in found:
            assert gcd(*normal) == 1
            assert next(x for x in normal if x) > 0
            assert products == tuple(sum(a * b for a, b in zip(normal, g, strict=True)) for g in vectors)
            flat = [g for g, value in zip(vectors, products, strict=True) if value == 0]
            assert n == 1 or fmpz_mat(flat).rank() == n - 1
        ranks = [fmpz_mat(chosen).rank() if n > 1 else 0 for chosen in combinations(vectors, n - 1)]
        assert bool(found) == (n - 1 in ranks)


def test_generators_in_general_position_have_the_known_counts() -> None:
    random = Random(1)
    for count, vertices, facets in ((3, 8, 6), (4, 14, 12), (6, 32, 30)):
        generators = [tuple(random.randint(-99, 99) for _ in range(3)) for _ in range(count)]
        found = zonotope(generators)
        assert (len(found.vertices), len(found.facets)) == (vertices, facets)
        assert vertices == count * count - count + 2  # not linear in the number of actuators, as chapter 6 says


def test_coplanar_generators_are_merged() -> None:
    """Six wrenches, two of each leg, whose lines meet: 30 vertices and 26 facets instead of 32 and 30."""
    random = Random(2)
    generators = [tuple(random.randint(-50, 50) for _ in range(3)) for _ in range(4)]
    flat = [*generators, tuple(a + b for a, b in zip(*generators[:2], strict=True))]
    loose, merged = zonotope([*generators, (1, 2, 77)]), zonotope(flat)
    assert len(merged.facets) == len(loose.facets) - 4
    assert len(merged.vertices) == len(loose.vertices) - 2
    is_consistent(merged.polytope())


def test_eight_cables_in_six_dimensions() -> None:
    random = Random(3)
    generators = tuple(tuple(random.randint(-1000, 1000) for _ in range(6)) for _ in range(8))
    cables = Zonotope(generators, (ONE,) * 8, (Fraction(0),) * 8, (ONE,) * 8, (ONE,) * 6)
    assert (len(cables.facets), len(cables.vertices)) == (112, 240)
    matrix = np.array(generators, dtype=float)
    for normal, offset in cables.facets[::7]:
        assert float(offset) == pytest.approx(np.maximum(matrix @ np.array(normal, dtype=float), 0).sum())


def test_a_section_of_a_box_is_no_zonotope() -> None:
    """DUAL V: an octahedron, whose faces are triangles."""
    found = slabs([(-3, -4, -8), (3, -4, -8), (3, 4, -8), (-3, 4, -8)], [Fraction(25)] * 4).polytope()
    assert sorted(map(len, (facet.vertices for facet in found.facets))) == [3] * 8
    assert set(found.vertices) == {
        tuple(Fraction(s) * x if k == j else Fraction(0) for j in range(3))
        for k, x in enumerate((Fraction(25, 3), Fraction(25, 4), Fraction(25, 8)))
        for s in (1, -1)
    }
    is_consistent(found)


@given(st.lists(st.tuples(st.integers(-3, 3), st.integers(-3, 3), st.integers(1, 4)), min_size=2, max_size=5))
@budget(12)
def test_sections_in_the_plane(sides: list[tuple[int, int, int]]) -> None:
    rows = [(a, b) for a, b, _ in sides]
    if any(row == (0, 0) for row in rows) or np.linalg.matrix_rank(np.array(rows)) < 2:
        return
    found = slabs(rows, [Fraction(bound) for _, _, bound in sides]).polytope()
    is_consistent(found)
    assert len(found.vertices) == len(found.facets)
    points = np.array([[float(x) for x in vertex] for vertex in found.vertices])
    hull = points[np.argsort(np.arctan2(points[:, 1], points[:, 0]))]
    x, y = hull.T
    area = abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2
    assert float(found.volume) == pytest.approx(area)
    least = min(bound / np.hypot(*row) for row, (_, _, bound) in zip(rows, sides, strict=True))
    assert float(found.inscribed_radius) == pytest.approx(least)
    assert float(found.greatest_norm) == pytest.approx(np.hypot(*points.T).max())


def test_bounds_may_be_square_roots() -> None:
    two = RootSum.root(Fraction(2))
    found = slabs([(1, 0), (0, 1), (1, 1)], [ONE, ONE, two]).polytope()
    assert len(found.vertices) == 6
    exact = slabs([(1, 0), (0, 1), (1, 1)], [two, two, 2 * two]).polytope()
    assert len(exact.vertices) == 4  # the third slab only touches: decided exactly
    assert Fraction(8) in exact.volume


def test_intersections_and_sums() -> None:
    square, diamond = slabs([(1, 0), (0, 1)]), slabs([(1, 1), (1, -1)], [Fraction(3, 2)] * 2)
    both = (square & diamond).polytope()
    assert (len(both.vertices), both.volume.lo) == (8, Fraction(7, 2))
    first, second = zonotope([(1, 0), (0, 1)]), zonotope([(1, 1), (1, -1)])
    assert len((first + second).vertices) == 8
    assert (first + first).volume.lo == 16
    with pytest.raises(InputError, match="different coordinates"):
        first + zonotope([(1, 0, 0), (0, 1, 0), (0, 0, 1)])


def test_what_has_no_interior_or_no_bounds_is_refused() -> None:
    with pytest.raises(InputError, match="do not span"):
        zonotope([(1, 0), (2, 0)]).facets  # noqa: B018
    with pytest.raises(InputError, match="leave some direction free"):
        slabs([(1, 0), (2, 0)]).polytope()


def general(points: list[tuple[int, ...]]) -> Polytope | None:
    """The hull of some points; None if they lie in a hyperplane."""
    spread = np.array(points) - np.array(points[0])
    if np.linalg.matrix_rank(spread) < len(points[0]):
        return None
    return hull_of(sorted({tuple(map(Fraction, point)) for point in points}), (ONE,) * len(points[0]))


def are_combined_rightly(points: list[tuple[int, ...]], others: list[tuple[int, ...]]) -> None:
    """By definition, in a few directions and at all points of a grid."""
    left, right = general(points), general(others)
    if left is None or right is None:
        return
    for found, corners in ((left, points), (right, others)):
        is_consistent(found)
        assert all(found.contains(point) for point in corners)
        assert {tuple(map(int, vertex)) for vertex in found.vertices} <= set(corners)
    total = left + right
    is_consistent(total)
    for direction in ((7, 11, 13), (-3, 5, 1), (1, 0, 0)):
        aim = direction[: total.dimension]
        reach = [max(sum(a * x for a, x in zip(aim, v, strict=True)) for v in p.vertices) for p in (total, left, right)]
        assert reach[0] == reach[1] + reach[2]
    try:
        common = left & right
    except InputError:
        return  # no interior in common: the next test has such ones
    is_consistent(common)
    for point in product(range(-3, 4), repeat=common.dimension):
        assert common.contains(point) == (left.contains(point) and right.contains(point))
    assert (common & left).volume == common.volume


clouds = st.lists(st.tuples(st.integers(-3, 3), st.integers(-3, 3)), min_size=3, max_size=5)


@given(clouds, clouds)
@budget(12)
def test_sums_and_intersections_of_any_polygons(points: list[tuple[int, ...]], others: list[tuple[int, ...]]) -> None:
    are_combined_rightly(points, others)


def test_sums_and_intersections_in_space() -> None:
    simplex = [(0, 0, 0), (2, 0, 0), (0, 3, 0), (0, 0, 2)]
    are_combined_rightly(simplex, [(-1, 1, 0), (1, 1, 1), (1, -1, 0), (0, 0, 3)])


def test_polytopes_that_cannot_be_combined_are_refused() -> None:
    unit = slabs([(1, 0), (0, 1)]).polytope()
    far = hull_of([(ONE * 5, ONE), (ONE * 6, ONE), (ONE * 5, ONE * 2)], (ONE, ONE))
    touching = hull_of([(ONE, -ONE), (ONE, ONE), (ONE * 2, ONE)], (ONE, ONE))
    for other in (far, touching):
        with pytest.raises(InputError, match=r"no point satisfies all bounds|no interior"):
            unit & other
    assert (unit + far).volume.lo == Fraction(17, 2)  # 4 + 1/2, and the mixed one: 2 h(unit) over the sides of far
    with pytest.raises(InputError, match="different coordinates"):
        unit + slabs([(1, 0, 0), (0, 1, 0), (0, 0, 1)]).polytope()
    with pytest.raises(InputError, match="not rational"):
        unit & slabs([(1, 0), (0, 1)], [RootSum.root(Fraction(2)), ONE]).polytope()
