"""A bounded convex polytope by its vertices and its facets, which belong to each other.

Coordinates are x_j; the ordinary ones are sqrt(s_j) x_j for given positive s_j, so that norms and volumes are those of
ordinary space while directions stay rational. Numbers are rational, sums of square roots, or balls.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from typing import Any, TypeAlias

from flint import arb, arb_mat

from pkm_exact.errors import InputError
from pkm_exact.polytopes.signs import sign
from pkm_exact.precision import working_precision
from pkm_exact.radicals import RootSum

Point: TypeAlias = tuple[Any, ...]
BITS = 256
MOST_SIMPLICES = 200_000


@dataclass(frozen=True)
class Facet:
    """A facet: normal.x <= offset, with equality on it.

    Attributes
    ----------
    normal : tuple of numbers
        Outwards; primitive integers where directions are rational.
    offset : number
    vertices : tuple of int
        Indices of the vertices on it.
    """

    normal: tuple[Any, ...]
    offset: Any
    vertices: tuple[int, ...]


@dataclass(frozen=True)
class Polytope:
    """A polytope with its interior not empty.

    Attributes
    ----------
    vertices : tuple of points
    facets : tuple of Facet
    squares : tuple of Fraction
        s_j.

    Examples
    --------
    >>> from pkm_exact.polytopes.slabs import Slabs
    >>> one, zero = Fraction(1), Fraction(0)
    >>> square = Slabs(((one, zero), (zero, one)), (-one, -one), (one, one)).polytope()
    >>> len(square.vertices), len(square.facets), square.volume, square.contains((one, one / 2))
    (4, 4, [4], True)
    >>> (square + square).volume, (square & square).volume
    ([16], [4])
    >>> square.inscribed_radius, square.greatest_norm.width < 1e-15
    ([1], True)
    """

    vertices: tuple[Point, ...]
    facets: tuple[Facet, ...]
    squares: tuple[Fraction, ...]

    @property
    def dimension(self) -> int:
        """Of the space, and of the polytope."""
        return len(self.squares)

    def __and__(self, other: Polytope) -> Polytope:
        """The intersection with another one, of rational ones (``combinations_of_polytopes``)."""
        from pkm_exact.polytopes.combinations_of_polytopes import intersection

        return intersection(self, other)

    def __add__(self, other: Polytope) -> Polytope:
        """The Minkowski sum with another one, of rational ones (``combinations_of_polytopes``)."""
        from pkm_exact.polytopes.combinations_of_polytopes import minkowski_sum

        return minkowski_sum(self, other)

    def contains(self, point: Sequence[Any]) -> bool:
        """Whether a point, in the coordinates x, lies in it or on its boundary, exactly."""
        if len(point) != self.dimension:
            raise InputError(f"point: {len(point)} coordinates; give {self.dimension}")
        return all(sign(facet.offset - _product(facet.normal, point)) >= 0 for facet in self.facets)

    @cached_property
    def volume(self) -> Any:
        """In ordinary coordinates, an interval; exact if it is rational."""
        from pkm_exact.polytopes.enclosures import interval_of

        rational = all(isinstance(value, int | Fraction) for vertex in self.vertices for value in vertex)
        total: Any = Fraction(0) if rational else arb(0)
        with working_precision(BITS):
            points = self.vertices if rational else [[_ball(value) for value in vertex] for vertex in self.vertices]
            for simplex in self._simplices():
                first, *rest = (points[index] for index in simplex)
                edges = [[b - a for a, b in zip(first, point, strict=True)] for point in rest]
                total += abs(_determinant(edges, rational=rational))
            total = total / _factorial(self.dimension)
            product = Fraction(1)
            for square in self.squares:
                product *= square
            return interval_of(total * RootSum.root(product) if rational else total * _ball(RootSum.root(product)))

    def _simplices(self) -> list[tuple[int, ...]]:
        """A triangulation without new points: each face from its first vertex, over its facets without it."""
        facets = [frozenset(facet.vertices) for facet in self.facets]
        known: dict[frozenset[int], list[tuple[int, ...]]] = {}

        def divided(face: frozenset[int], dimension: int) -> list[tuple[int, ...]]:
            if len(face) == dimension + 1:
                return [tuple(sorted(face))]
            if face not in known:
                first = min(face)
                parts = {face & facet for facet in facets if not face <= facet}
                maximal = [part for part in parts if not any(part < other for other in parts)]
                known[face] = [
                    (first, *rest) for part in maximal if first not in part for rest in divided(part, dimension - 1)
                ]
                if len(known[face]) > MOST_SIMPLICES:
                    raise InputError("the polytope has too many faces for its volume to be computed")
            return known[face]

        return divided(frozenset(range(len(self.vertices))), self.dimension)

    @cached_property
    def greatest_norm(self) -> Any:
        """The greatest ordinary norm of its points, an interval."""
        return self._extreme([self._norm_squared(vertex, self.squares) for vertex in self.vertices], greatest=True)

    @cached_property
    def inscribed_radius(self) -> Any:
        """The radius of the largest ball about the origin that it contains, 0 if the origin is not inside."""
        from pkm_exact.polytopes.enclosures import interval_of

        if any(sign(facet.offset) <= 0 for facet in self.facets):
            return interval_of(Fraction(0))
        inverse = tuple(1 / square for square in self.squares)
        ratios: list[Any] = []
        with working_precision(BITS):
            for facet in self.facets:
                square: Any = self._norm_squared(facet.normal, inverse)
                length = None if isinstance(square, arb) else RootSum.of(square).rational
                if length is None or isinstance(facet.offset, arb):
                    size = _ball(facet.offset)
                    ratios.append(size * size / _ball(square))
                else:
                    offset = RootSum.of(facet.offset)
                    ratios.append(offset * offset / length)
        return self._extreme(ratios, greatest=False)

    def _extreme(self, squares: Sequence[Any], *, greatest: bool) -> Any:
        """The root of the greatest or least of some squares, as an interval."""
        from pkm_exact.polytopes.enclosures import interval_of

        rational = [RootSum.of(value).rational for value in squares if not isinstance(value, arb)]
        if len(rational) == len(squares) and None not in rational:
            exact = [value for value in rational if value is not None]
            return interval_of(RootSum.root(max(exact) if greatest else min(exact)))
        with working_precision(BITS):
            found = _ball(squares[0])
            for value in squares[1:]:
                found = found.max(_ball(value)) if greatest else found.min(_ball(value))
            return interval_of(found.sqrt())

    @staticmethod
    def _norm_squared(vector: Sequence[Any], squares: Sequence[Fraction]) -> Any:
        if any(isinstance(value, arb) for value in vector):
            balls = [_ball(value) for value in vector]
            return sum((_ball(s) * value * value for s, value in zip(squares, balls, strict=True)), arb(0))
        sums = [RootSum.of(value) for value in vector]
        return sum((s * (value * value) for s, value in zip(squares, sums, strict=True)), RootSum())


def _product(left: Sequence[Any], right: Sequence[Any]) -> Any:
    return sum((RootSum.of(a) * b if not isinstance(a, arb) else a * _ball(b) for a, b in zip(left, right, strict=True)
                if isinstance(a, arb) or a != 0), RootSum())  # fmt: skip


def _ball(value: Any) -> arb:
    from pkm_exact.polytopes.enclosures import ball_of

    return ball_of(value)


def _determinant(rows: list[list[Any]], *, rational: bool) -> Any:
    if not rational:
        return arb_mat(rows).det()
    from flint import fmpq, fmpq_mat

    entries = [fmpq(Fraction(value).numerator, Fraction(value).denominator) for row in rows for value in row]
    found = fmpq_mat(len(rows), len(rows), entries).det()
    return Fraction(int(found.p), int(found.q))


def _factorial(number: int) -> int:
    return number * _factorial(number - 1) if number else 1


def maximal_sets(sets: Sequence[frozenset[int]]) -> list[int]:
    """Indices of those that no other one contains, the first of equal ones.

    A face that is no facet lies in one, and no facet in another: of the sets of vertices on the sides of a polytope
    these are its facets.

    >>> maximal_sets([frozenset({1, 2}), frozenset({2}), frozenset({1, 2})])
    [0]
    """
    return [
        index
        for index, one in enumerate(sets)
        if one and not any(one < other or (one == other and k < index) for k, other in enumerate(sets))
    ]


def subsets(count: int, size: int) -> list[tuple[int, ...]]:
    """All choices, in order."""
    return list(combinations(range(count), size))
