"""What a linear system of screws consists of, in words: how many translations, rotations and screws, and where.

The screws with s = 0 are the translations T of the system. The others are (s; v(s) + T), for s in the space W of their
directions. They are rotations about axes through one point p exactly if v(s) - p x s is in T for every s in W, which is
a linear system for p. If there is no such p, a basis is named screw by screw, each with v(s) perpendicular to T.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt, prod
from typing import Final, NamedTuple

from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.inverse import UNIT_METRIC, Metric
from pkm_exact.screws.exact_matrix import Row, echelon, null_space, solution
from pkm_exact.screws.screw import Screw, cross, dot, primitive
from pkm_exact.wording import counted

_AXES: Final[tuple[Row, ...]] = tuple(tuple(Fraction(int(i == j)) for j in range(3)) for i in range(3))


class Nouns(NamedTuple):
    """How screws of pitch infinity, 0 and any other are called."""

    infinite: str
    zero: str
    other: str


TWISTS: Final = Nouns("translation", "rotation", "screw motion")
WRENCHES: Final = Nouns("couple", "force", "wrench")


@dataclass(frozen=True)
class FreeMotions:
    """A linear system of screws, sorted out; as a string, in words.

    Attributes
    ----------
    translations : tuple of Vector
        A basis of those with s = 0, in integers.
    turns : tuple of Screw
        With them a basis of all.
    centre : Vector or None
        A point through which the axes of all ``turns`` go; None if there is none, or if there are no turns.
    nouns : Nouns
    metric : tuple of 3 int
        Gram diagonal: coordinates are those of a model file with this metric, and the pitch is an ordinary one.

    Examples
    --------
    >>> print(free_motions([[0, 0, 0, 0, 0, 2]]))
    1 translation along (0, 0, 1)
    >>> print(free_motions([[0, 0, 1, 0, 0, "1/2"]]))
    1 screw motion of pitch 1/2 about an axis along (0, 0, 1) through (0, 0, 0)
    """

    translations: tuple[Vector, ...]
    turns: tuple[Screw, ...]
    centre: Vector | None
    nouns: Nouns = TWISTS
    metric: Metric = UNIT_METRIC

    @property
    def number(self) -> int:
        """The dimension of the system."""
        return len(self.translations) + len(self.turns)

    def __str__(self) -> str:
        parts = []
        if self.translations:
            noun = counted(len(self.translations), self.nouns.infinite)
            parts.append(f"{noun} {_directions(self.translations)}")
        directions = [screw.direction for screw in self.turns]
        if self.centre is not None:
            noun = counted(len(self.turns), self.nouns.zero)
            axes = "an axis" if len(self.turns) == 1 else "axes"
            parts.append(f"{noun} about {axes} {_directions(directions)} through {point_text(self.centre)}")
        else:
            parts += [self._one(screw) for screw in self.turns]
        text = ", ".join(parts)
        if self.nouns is WRENCHES:
            text = text.replace("force about an axis", "force").replace("forces about axes", "forces on lines")
        return text or f"no {self.nouns.zero} and no {self.nouns.infinite}"

    def _one(self, screw: Screw) -> str:
        square = product_of(screw.direction, screw.direction, self.metric)
        pitch = dot(screw.direction, screw.moment) / square
        noun = f"1 {self.nouns.other} of pitch {_times_root(pitch, self.metric)}" if pitch else f"1 {self.nouns.zero}"
        along = [pitch * g * a for g, a in zip(self.metric, screw.direction, strict=True)]
        foot = screw.foot if self.metric == UNIT_METRIC else _on_axis(screw, along)
        where = point_text(foot or screw.direction)
        return f"{noun} about an axis along {point_text(primitive(screw.direction))} through {where}"


def point_text(point: Sequence[Fraction]) -> str:
    """A point or a direction.

    >>> point_text((Fraction(1, 2), Fraction(0), Fraction(-3)))
    '(1/2, 0, -3)'
    """
    return f"({', '.join(map(str, point))})"


def product_of(u: Sequence[Fraction], v: Sequence[Fraction], metric: Metric) -> Fraction:
    """The product of two vectors in a metric."""
    return sum((g * x * y for g, x, y in zip(metric, u, v, strict=True)), Fraction(0))


def free_motions(
    basis: Sequence[Sequence[Fraction | int]], nouns: Nouns = TWISTS, metric: Metric = UNIT_METRIC
) -> FreeMotions:
    """The screws of a linear system, sorted out.

    Parameters
    ----------
    basis : sequence of rows of 6
        That span it, as (s; s0). In a metric G a twist (w; v) is (w; G v): turns about the point p are then (w; p x w),
        as in ordinary coordinates.
    nouns : Nouns
    metric : tuple of 3 int
    """
    rows, pivots = echelon([[Fraction(value) for value in row] for row in basis], 6)
    still = [row[3:] for row, pivot in zip(rows, pivots, strict=True) if pivot >= 3]
    turning = [row for row, pivot in zip(rows, pivots, strict=True) if pivot < 3]
    translations = tuple(_vector(primitive(row)) for row in still)
    shown = tuple(_vector(primitive([x / g for x, g in zip(row, metric, strict=True)])) for row in still)
    turns = [Screw(_vector(row[:3]), _vector(_perpendicular(row[3:], translations))) for row in turning]
    centre = _centre(turns, translations) if turns else None
    if centre is not None:
        turns = [Screw.line(centre, primitive(screw.direction)) for screw in turns]
    return FreeMotions(shown, tuple(turns), centre, nouns, metric)


def _times_root(value: Fraction, metric: Metric) -> str:
    """The value times the square root of the metric's determinant."""
    square = prod(metric)
    root = isqrt(square)
    return str(value * root) if root * root == square else f"{value}*sqrt({square})"


def _on_axis(screw: Screw, along: Sequence[Fraction]) -> Vector | None:
    """A point p with p x s = s0 less the part that is due to the pitch."""
    rows = [cross(screw.direction, _vector(axis)) for axis in _AXES]
    found = solution(rows, [x - y for x, y in zip(screw.moment, along, strict=True)], 3)
    return None if found is None else _vector(found)


def _vector(row: Sequence[Fraction]) -> Vector:
    x, y, z = row
    return x, y, z


def _perpendicular(vector: Sequence[Fraction], space: Sequence[Vector]) -> Row:
    """The vector less its projection to a space given by a basis."""
    products = [[dot(a, b) for b in space] for a in space]
    factors = solution(products, [dot(a, vector) for a in space], len(space)) or ()
    shift = [sum((f * a[k] for f, a in zip(factors, space, strict=True)), Fraction(0)) for k in range(3)]
    return tuple(x - y for x, y in zip(vector, shift, strict=True))


def _centre(turns: Sequence[Screw], translations: Sequence[Vector]) -> Vector | None:
    """A point p with v - p x s in T for every turn; of several the one next to the origin."""
    normals = null_space(translations, 3) if translations else _AXES
    rows, right = [], []
    for screw in turns:
        for normal in normals:
            # normal.(p x s) = p.(s x normal)
            rows.append(cross(screw.direction, _vector(normal)))
            right.append(dot(normal, screw.moment))
    found = solution(rows, right, 3)
    if found is None:
        return None
    free = [_vector(row) for row in null_space(rows, 3)]
    return _vector(_perpendicular(found, free))


def _directions(vectors: Sequence[Sequence[Fraction]]) -> str:
    """Along what, in words."""
    rows, _ = echelon(vectors, 3)
    if len(rows) == 1:
        return f"along {point_text(primitive(rows[0]))}"
    if len(rows) == 2:
        return f"perpendicular to {point_text(primitive(_vector(null_space(rows, 3)[0])))}"
    return "in all directions"
