"""A screw with rational coordinates: a twist (w; v) or a wrench (force; moment).

Of a twist w is the angular velocity and v the velocity of the body's point that is at the origin; of a wrench f is the
force and m the moment about the origin. Both are (s; s0) with s0 = p x s + h s for any point p of the axis and the
pitch h; with s = 0 a twist is a translation and a wrench a couple, and the pitch is infinite. A wrench does no work on
a twist exactly if s.s0' + s0.s' = 0. Reference: Ball, "A Treatise on the Theory of Screws", Cambridge (1900).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.rational import parse_vector


def cross(u: Sequence[Fraction], v: Sequence[Fraction]) -> Vector:
    """The vector product.

    Examples
    --------
    >>> cross((1, 0, 0), (0, 1, 0))
    (0, 0, 1)
    """
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def dot(u: Sequence[Fraction], v: Sequence[Fraction]) -> Fraction:
    """The scalar product."""
    return sum((x * y for x, y in zip(u, v, strict=True)), Fraction(0))


def primitive(vector: Sequence[Fraction]) -> tuple[Fraction, ...]:
    """The positive multiple of a vector whose entries are integers without a common factor; 0 if it is 0.

    Examples
    --------
    >>> [int(x) for x in primitive((Fraction(-1, 2), Fraction(3), Fraction(0)))]
    [-1, 6, 0]
    """
    denominator = lcm(*(x.denominator for x in vector))
    whole = [int(x * denominator) for x in vector]
    factor = gcd(*whole) or 1
    return tuple(Fraction(x // factor) for x in whole)


@dataclass(frozen=True)
class Screw:
    """A twist or a wrench, exactly.

    Attributes
    ----------
    direction : tuple of 3 Fraction
        Angular velocity, or force.
    moment : tuple of 3 Fraction
        Velocity of the point at the origin, or moment about the origin.

    Examples
    --------
    >>> hinge = Screw.line((1, 0, 0), (0, 0, 1))
    >>> [int(x) for x in hinge.coordinates], int(hinge.pitch)
    ([0, 0, 1, 0, -1, 0], 0)
    >>> hinge.is_reciprocal(Screw.line((1, 5, 0), (0, 1, 0)))
    True
    """

    direction: Vector
    moment: Vector

    def __post_init__(self) -> None:
        for field in ("direction", "moment"):
            object.__setattr__(self, field, parse_vector(getattr(self, field), field))

    @classmethod
    def line(cls, point: Sequence[object], direction: Sequence[object], pitch: Fraction | int | str = 0) -> Screw:
        """A rotation about a line, or a force along it; with a pitch the screw about it.

        Raises
        ------
        InputError
            If the direction is 0 or a number is not exact.

        Examples
        --------
        >>> [str(x) for x in Screw.line((0, 1, 0), (1, 0, 0)).coordinates]
        ['1', '0', '0', '0', '0', '-1']
        """
        place, along = parse_vector(list(point), "point"), parse_vector(list(direction), "direction")
        if not any(along):
            raise InputError("direction: is 0; give one that is not")
        step = parse_vector([pitch, 0, 0], "pitch")[0]
        around = cross(place, along)
        return cls(along, (around[0] + step * along[0], around[1] + step * along[1], around[2] + step * along[2]))

    @classmethod
    def couple(cls, direction: Sequence[object]) -> Screw:
        """A translation along a direction, or a couple about it.

        Examples
        --------
        >>> [str(x) for x in Screw.couple((0, 0, 1)).coordinates]
        ['0', '0', '0', '0', '0', '1']
        """
        along = parse_vector(list(direction), "direction")
        if not any(along):
            raise InputError("direction: is 0; give one that is not")
        return cls((Fraction(0),) * 3, along)

    @classmethod
    def from_coordinates(cls, values: Sequence[Fraction]) -> Screw:
        """The screw with the six coordinates (s; s0).

        Examples
        --------
        >>> Screw.from_coordinates([Fraction(x) for x in (1, 0, 0, 2, 0, 0)]) == Screw.line((0, 0, 0), (1, 0, 0), 2)
        True
        """
        a, b, c, x, y, z = values
        return cls((a, b, c), (x, y, z))

    @property
    def coordinates(self) -> tuple[Fraction, ...]:
        """(s; s0)."""
        return (*self.direction, *self.moment)

    @property
    def pitch(self) -> Fraction | None:
        """Translation along the axis for one radian about it, s.s0 / s.s; None if s = 0."""
        square = dot(self.direction, self.direction)
        return dot(self.direction, self.moment) / square if square else None

    @property
    def foot(self) -> Vector | None:
        """The point of the axis that is next to the origin, s x s0 / s.s; None if s = 0."""
        square = dot(self.direction, self.direction)
        if not square:
            return None
        x, y, z = cross(self.direction, self.moment)
        return x / square, y / square, z / square

    def is_reciprocal(self, other: Screw) -> bool:
        """Whether a wrench on the one does no work on a twist about the other.

        Examples
        --------
        >>> Screw.line((0, 0, 0), (1, 0, 0)).is_reciprocal(Screw.line((0, 0, 0), (0, 1, 0)))
        True
        """
        return dot(self.direction, other.moment) + dot(self.moment, other.direction) == 0

    def bracket(self, other: Screw) -> Screw:
        """The Lie product: (w x w'; w x v' + v x w').

        Examples
        --------
        >>> x, y = (Screw.line((0, 0, 0), axis) for axis in ((1, 0, 0), (0, 1, 0)))
        >>> x.bracket(y) == Screw.line((0, 0, 0), (0, 0, 1))
        True
        """
        first, second = cross(self.direction, other.moment), cross(self.moment, other.direction)
        x, y, z = (a + b for a, b in zip(first, second, strict=True))
        return Screw(cross(self.direction, other.direction), (x, y, z))
