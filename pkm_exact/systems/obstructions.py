"""Points of supports that are not lowest together: why a choice of them is in no mixed cell.

Lift each point a of the supports A_1, .., A_n by a number w(a). At a point x, those of A_i are lowest at which x.a +
w(a) is least. An obstruction is integers v(a), with the sum 0 on each A_i, such that the v(a) a sum to 0 and the
v(a) w(a) to less: the points at which v is negative are lowest together at no x. By Farkas' lemma there is one wherever
points are not.

With l_i for the least value on A_i the slacks x.a + w(a) - l_i are nowhere negative: a polyhedron of all (x, l), and
points are lowest together on a face of it. The simplex method goes through its vertices in floating point; what it
finds is an obstruction over the integers, or is not used.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import gcd
from typing import TYPE_CHECKING, TypeAlias

from flint import fmpz_mat

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]

Point: TypeAlias = tuple[int, ...]
Place: TypeAlias = tuple[int, int]
"""A support, and one of its points, by their numbers."""
Obstruction: TypeAlias = tuple[tuple[Place, int], ...]

_ROUNDING = 1e-9
_PIVOTS = 200
"""In one search; a slack may then be thought 0 which is not, and no more is lost than time."""
_PIVOT_COST = 10_000
"""That of numpy, in entries of a matrix."""


class TooMuchWorkError(Exception):
    """More work than was asked for."""


@dataclass
class Work:
    """What may still be done, in entries of matrices."""

    left: int

    def spend(self, amount: int) -> None:
        """So much of it is done.

        Raises
        ------
        TooMuchWorkError
            If nothing is left.
        """
        self.left -= amount
        if self.left < 0:
            raise TooMuchWorkError


@dataclass(frozen=True)
class LiftedPoints:
    """The points of all supports, numbered one support after another.

    Attributes
    ----------
    places : sequence of Place
        By number.
    points : sequence of Point
    lifting : sequence of int
    """

    places: Sequence[Place]
    points: Sequence[Point] = field(repr=False)
    lifting: Sequence[int] = field(repr=False)

    @cached_property
    def rows(self) -> list[list[int]]:
        """For each point its coordinates, and the unit vector of its support."""
        number = 1 + max(i for i, _ in self.places)
        pairs = zip(self.places, self.points, strict=True)
        return [[*point, *(int(j == i) for j in range(number))] for (i, _), point in pairs]

    def vertex(self) -> Face | None:
        """The whole polyhedron, at one of its vertices; None if it has none: then no volume is positive.

        Examples
        --------
        >>> places = [(i, k) for i in range(2) for k in range(3)]
        >>> lifted = LiftedPoints(places, [(1, 0), (0, 1), (0, 0)] * 2, [0, 0, 5, 0, 0, 3])
        >>> work = Work(10**6)
        >>> found = lifted.vertex().where_lowest(2, work).face.where_lowest(3, work)
        >>> found.face, lifted.obstruction(found.relation, 3, [2])
        (None, (((0, 0), 1), ((0, 2), -1), ((1, 0), -1), ((1, 2), 1)))
        """
        import numpy as np

        size = len(self.points[0])
        heights = np.array(self.lifting, dtype=float)
        heights /= max(1.0, float(abs(heights).max()))
        table = np.concatenate([np.array(self.rows, dtype=float), heights[:, None]], axis=1)
        for column in range(size, len(table[0]) - 1):
            here = table[:, column] == 1
            table[here, -1] -= table[here, -1].min()
        table[:, size:-1] *= -1
        zeros = [-1] * (len(table[0]) - 1)
        for column in reversed(range(len(zeros))):
            row = _first_zero(table, table[:, column])
            row = _first_zero(table, -table[:, column]) if row is None else row
            if row is None:
                return None
            table = _exchanged(table, row, column)
            zeros[column] = row
        return Face(table, tuple(zeros))

    def obstruction(self, relation: Sequence[int], above: int, zero: Sequence[int]) -> Obstruction | None:
        """The one by points of a relation, if there is one: at none of them negative but those named last.

        Parameters
        ----------
        relation : sequence of int
            Further points.
        above : int
            The point that is not lowest where the points ``zero`` are.
        zero : sequence of int
        """
        used = [above, *zero, *relation]
        relations, number = fmpz_mat([self.rows[point] for point in used]).transpose().nullspace()
        if number != 1:
            return None
        weights = [int(relations[k, 0]) for k in range(len(used))]
        height = sum(weight * self.lifting[point] for weight, point in zip(weights, used, strict=True))
        weights = [-weight for weight in weights] if height > 0 else weights
        if not height or weights[0] >= 0 or any(weight < 0 for weight in weights[1 + len(zero) :]):
            return None
        common = gcd(*weights)
        found = {self.places[point]: weight // common for weight, point in zip(weights, used, strict=True) if weight}
        return tuple(sorted(found.items()))


@dataclass(frozen=True)
class Face:
    """A face of the polyhedron, at one of its vertices.

    Attributes
    ----------
    table : array
        Each slack as an affine function of those that are 0 at the vertex and need not be on the face; its value at the
        vertex is the last column.
    zeros : tuple of int
        Those slacks, by the numbers of their points.
    """

    table: Array
    zeros: tuple[int, ...]

    def where_lowest(self, point: int, work: Work) -> Lowest:
        """The part of the face where one more point is lowest: the simplex method on its slack.

        Raises
        ------
        TooMuchWorkError
            If no work is left.
        """
        import numpy as np

        table, zeros = self.table, list(self.zeros)
        for _ in range(_PIVOTS):
            if point in zeros:
                column = zeros.index(point)
                return Lowest(Face(np.delete(table, column, axis=1), (*zeros[:column], *zeros[column + 1 :])))
            slack = table[point]
            column = int(slack[:-1].argmin()) if zeros else -1
            if column < 0 or slack[column] > -_ROUNDING:
                if slack[-1] <= _ROUNDING:
                    break
                places = zip(zeros, slack[:-1], strict=True)
                return Lowest(None, tuple(other for other, weight in places if weight > _ROUNDING))
            row = _first_zero(table, table[:, column])
            if row is None:
                break
            work.spend(_PIVOT_COST + table.size)
            table = _exchanged(table, row, column)
            zeros[column] = row
        return Lowest(Face(table, tuple(zeros)))


@dataclass(frozen=True)
class Lowest:
    """Where one more point is lowest.

    Attributes
    ----------
    face : Face or None
        None if it is so nowhere, as far as floating point tells.
    relation : tuple of int
        The points of which an obstruction should then be made.
    """

    face: Face | None
    relation: tuple[int, ...] = ()


def _first_zero(table: Array, slope: Array) -> int | None:
    """The slack that becomes 0 first if all change with these slopes; None if none does."""
    import numpy as np

    falling = slope < -_ROUNDING
    if not falling.any():
        return None
    length = np.full(len(slope), np.inf)
    length[falling] = table[falling, -1] / -slope[falling]
    return int(length.argmin())


def _exchanged(table: Array, row: int, column: int) -> Array:
    """All slacks as functions of that of a row, instead of that of a column."""
    ratio = table[row] / table[row, column]
    ratio[column] = 1 - 1 / table[row, column]
    exchanged: Array = table - table[:, column, None] * ratio
    return exchanged
