"""Sections of boxes: the points x with lo_i <= R_i x <= hi_i, all rows R_i of a matrix with independent columns.

If actuators are redundant, m rows for n < m unknowns, these are the twists whose actuator speeds lie in a box: the box
cut by the range of J, which is not a zonotope in general (an octahedron in the exact case of DUAL V). The vertices are
among the solutions of n independent equations R_i x = lo_i or hi_i (Krut et al., Robotica 22 (2004), equations 53 to
55, who count 2 m of them; there may be more). A vertex x is linear in the bounds: R_k x is compared with them exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, product
from math import comb
from typing import Any, Final

from flint import arb, arb_mat, fmpq

from pkm_exact.errors import InputError
from pkm_exact.polytopes.polytope import Facet, Polytope, maximal_sets
from pkm_exact.polytopes.rationals import as_fraction, rational_matrix
from pkm_exact.polytopes.signs import UndecidedError, sign
from pkm_exact.radicals import RootSum

MOST_CANDIDATES: Final = 200_000
"""Systems of equations that are solved."""


@dataclass(frozen=True)
class Slabs:
    """An intersection of slabs.

    Attributes
    ----------
    rows : tuple of rows of Fraction, or of arb
    low, high : tuple of numbers, one each row
        A low one may be None: the row is bounded above only.
    squares : tuple of Fraction, optional
        Those of ``Polytope``, by default 1.

    Examples
    --------
    >>> one = Fraction(1)
    >>> rows = tuple(tuple(map(Fraction, row)) for row in ((1, 0), (0, 1), (1, 1)))
    >>> len(Slabs(rows, (-one,) * 3, (one,) * 3).polytope().vertices)
    6
    >>> len((Slabs(rows[:2], (-one,) * 2, (one,) * 2) & Slabs(rows[2:], (-one,), (one,))).polytope().facets)
    6
    """

    rows: tuple[tuple[Any, ...], ...]
    low: tuple[Any, ...]
    high: tuple[Any, ...]
    squares: tuple[Fraction, ...] = ()

    @property
    def dimension(self) -> int:
        """Number of unknowns."""
        return len(self.rows[0])

    def __and__(self, other: Slabs) -> Slabs:
        """The intersection."""
        if self.dimension != other.dimension or self._squares != other._squares:
            raise InputError("polytopes: are in different coordinates; intersect those of one machine")
        return Slabs(self.rows + other.rows, self.low + other.low, self.high + other.high, self.squares)

    def polytope(self) -> Polytope:
        """The same by vertices and facets.

        Raises
        ------
        InputError
            If it is not bounded, has no interior, or has too many candidates for vertices.
        UndecidedError
            If balls are too wide to tell.
        """
        n, found = self.dimension, self.corners()
        keys = sorted(found)
        facets = [
            Facet(*self._half_space(*side), tuple(k for k, key in enumerate(keys) if side in key))
            for side in outer_sides(keys)
        ]
        if len(facets) <= n:
            raise InputError("polytope: has no interior, or is not bounded")
        return Polytope(tuple(found[key] for key in keys), tuple(facets), self._squares)

    def corners(self) -> dict[tuple[tuple[int, int], ...], tuple[Any, ...]]:
        """All vertices, each under the sides on which it lies: an index of a row, and -1 or 1 for its bounds."""
        count, n = len(self.rows), self.dimension
        if comb(count, n) * (1 if self._is_one_sided else 2**n) > MOST_CANDIDATES:
            raise InputError(f"polytope: {count} rows in {n} dimensions are too many to be intersected one by one")
        found: dict[tuple[tuple[int, int], ...], tuple[Any, ...]] = {}
        for chosen in combinations(range(count), n):
            ratios = self._ratios(chosen)
            if ratios is not None:
                self._collect(chosen, *ratios, found)
        if not found:
            raise InputError("polytope: no point satisfies all bounds, or they leave some direction free")
        return found

    @property
    def _squares(self) -> tuple[Fraction, ...]:
        return self.squares or (Fraction(1),) * self.dimension

    @property
    def _is_one_sided(self) -> bool:
        """Whether no row is bounded below."""
        return all(value is None for value in self.low)

    @property
    def _is_exact(self) -> bool:
        return not any(isinstance(value, arb) for row in (*self.rows, self.low, self.high) for value in row)

    def _ratios(self, chosen: Sequence[int]) -> tuple[list[list[Any]], list[list[Any]]] | None:
        """The inverse of the chosen rows, and all rows times it; None if they are dependent."""
        n = len(chosen)
        if self._is_exact:
            matrix = rational_matrix([self.rows[index] for index in chosen])
            if matrix.det() == 0:
                return None
            inverse = matrix.inv()
            every = rational_matrix(self.rows) * inverse
            return _table(inverse), _table(every)
        balls = arb_mat([list(self.rows[index]) for index in chosen])
        if balls.det().contains(0):
            raise UndecidedError("the pose is not enclosed narrowly enough to tell which faces the polytope has")
        back = balls.inv()
        all_rows = arb_mat([list(row) for row in self.rows]) * back
        return (
            [[back[i, j] for j in range(n)] for i in range(n)],
            [[all_rows[i, j] for j in range(n)] for i in range(len(self.rows))],
        )

    def _collect(
        self,
        chosen: Sequence[int],
        inverse: list[list[Any]],
        every: list[list[Any]],
        found: dict[tuple[tuple[int, int], ...], tuple[Any, ...]],
    ) -> None:
        """The vertices at the chosen rows."""
        others = [index for index in range(len(self.rows)) if index not in chosen]
        for signs in product(*((1,) if self.low[i] is None else (-1, 1) for i in chosen)):
            bounds = [self.high[i] if s > 0 else self.low[i] for i, s in zip(chosen, signs, strict=True)]
            tight = list(zip(chosen, signs, strict=True))
            for index in others:
                value = _sum(every[index], bounds)
                below = 1 if self.low[index] is None else sign(value - self.low[index])
                above = sign(self.high[index] - value)
                if below < 0 or above < 0:
                    break
                tight += [(index, -1)] * (below == 0) + [(index, 1)] * (above == 0)
            else:
                key = tuple(sorted(tight))
                if key not in found:
                    found[key] = tuple(_sum(row, bounds) for row in inverse)

    def _half_space(self, index: int, side: int) -> tuple[tuple[Any, ...], Any]:
        row = self.rows[index]
        if side > 0:
            return row, self.high[index]
        return tuple(-value for value in row), -1 * self.low[index]


def outer_sides(keys: Sequence[tuple[tuple[int, int], ...]]) -> list[tuple[int, int]]:
    """The sides that are facets, of those on which vertices lie; of equal ones the first."""
    sides = sorted({side for key in keys for side in key})
    sets = [frozenset(k for k, key in enumerate(keys) if side in key) for side in sides]
    return [sides[index] for index in maximal_sets(sets)]


def _sum(factors: Sequence[Any], values: Sequence[Any]) -> Any:
    pairs = zip(factors, values, strict=True)
    if any(isinstance(value, arb) for value in (*factors, *values)):
        from pkm_exact.polytopes.enclosures import ball_of

        return sum((ball_of(k) * ball_of(x) for k, x in pairs), arb(0))
    if any(isinstance(value, RootSum) for value in values):
        return sum((RootSum.of(x) * k for k, x in pairs if k), RootSum())
    return sum((k * x for k, x in pairs), Fraction(0))


def _table(matrix: Any) -> list[list[Fraction]]:
    return [[as_fraction(fmpq(value)) for value in row] for row in matrix.table()]
