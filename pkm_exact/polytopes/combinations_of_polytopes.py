"""Intersection and sum of any two polytopes over the rational numbers, by vertices and facets.

The intersection satisfies the inequalities of both; its vertices are found by intersecting them. The sum is the convex
hull of the sums of vertices. Facets of a hull are found by polarity: with an interior point as origin, a.x <= 1 is a
facet of the hull of points p_i exactly where a is a vertex of {a : p_i.a <= 1}.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from pkm_exact.errors import InputError
from pkm_exact.polytopes.polytope import Facet, Polytope
from pkm_exact.polytopes.slabs import Slabs
from pkm_exact.radicals import RootSum

_Row = tuple[Fraction, ...]


def intersection(left: Polytope, right: Polytope) -> Polytope:
    """The points of both.

    Raises
    ------
    InputError
        If they are in different coordinates or not rational, or have no interior in common.
    """
    facets = [facet for polytope in _checked(left, right) for facet in polytope.facets]
    rows = tuple(_rational(facet.normal) for facet in facets)
    return Slabs(rows, (None,) * len(rows), _rational([facet.offset for facet in facets]), left.squares).polytope()


def minkowski_sum(left: Polytope, right: Polytope) -> Polytope:
    """All sums of a point of one and a point of the other.

    Raises
    ------
    InputError
        If they are in different coordinates or not rational, or have too many vertices.
    """
    first, second = ([_rational(vertex) for vertex in polytope.vertices] for polytope in _checked(left, right))
    points = sorted({tuple(a + b for a, b in zip(p, q, strict=True)) for p in first for q in second})
    return hull_of(points, left.squares)


def hull_of(points: Sequence[_Row], squares: tuple[Fraction, ...]) -> Polytope:
    """The convex hull of rational points that are not all in one hyperplane.

    Examples
    --------
    >>> corners = [tuple(map(Fraction, point)) for point in ((0, 0), (2, 0), (0, 2), (1, 1), (1, 0))]
    >>> found = hull_of(corners, (Fraction(1),) * 2)
    >>> len(found.vertices), len(found.facets), found.volume
    (3, 3, [2])
    """
    middle = tuple(sum(values, Fraction(0)) / len(points) for values in zip(*points, strict=True))
    moved = tuple(tuple(x - m for x, m in zip(point, middle, strict=True)) for point in points)
    polar = Slabs(moved, (None,) * len(moved), (Fraction(1),) * len(moved)).polytope()
    # Where a point touches only faces of the polar that are no facets, it is no vertex; facets name the others.
    vertices = [tuple(x + m for x, m in zip(_rational(facet.normal), middle, strict=True)) for facet in polar.facets]
    facets = []
    for number, normal in enumerate(polar.vertices):
        offset = Fraction(1) + sum((a * m for a, m in zip(normal, middle, strict=True)), Fraction(0))
        on = tuple(k for k, facet in enumerate(polar.facets) if number in facet.vertices)
        facets.append(Facet(normal, offset, on))
    return Polytope(tuple(vertices), tuple(facets), squares)


def _checked(left: Polytope, right: Polytope) -> tuple[Polytope, Polytope]:
    if left.squares != right.squares:
        raise InputError("polytopes: are in different coordinates; combine those of one machine")
    return left, right


def _rational(values: Sequence[Any]) -> _Row:
    found = []
    for value in values:
        if isinstance(value, int | Fraction):
            found.append(Fraction(value))
            continue
        rational = value.rational if isinstance(value, RootSum) else None
        if rational is None:
            raise InputError(
                "polytopes: have numbers that are not rational; combine rational ones, or Slabs, or Zonotopes"
            )
        found.append(rational)
    return tuple(found)
