"""Actuated chains that end in a rod of fixed length: cranks (RUS legs) and slides (PUS legs).

A chain stands between a base joint A and a platform joint. The locked actuator puts the rod's lower end, the knee K, at

    crank    K = A + cos(angle) u + sin(angle) v,    |u| = |v|, u.v = 0 in the metric
    slide    K = A + q d

and the rod is then a leg of known length from K to the platform joint. Angles enter as exact pairs (cos, sin).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Metric, dot
from pkm_exact.geometry.rational import parse_positive, parse_rational, parse_vector
from pkm_exact.wording import shown

CosSin: TypeAlias = tuple[Fraction, Fraction]
JointValue: TypeAlias = Fraction | CosSin
"""The position of a slide, or cosine and sine of a crank's angle."""


@dataclass(frozen=True)
class Crank:
    """A motor that turns a crank about the base joint, and a rod from the crank's end to the platform.

    Attributes
    ----------
    at_0, at_90 : vector of 3 Fraction
        The crank, from the base joint to the knee, at the angles 0 and 90 degrees: perpendicular, of equal length.
    rod_squared : Fraction
        Squared length of the rod.

    Examples
    --------
    >>> crank = Crank((2, 0, 0), (0, 0, 2), 25)
    >>> [str(x) for x in crank.knee((Fraction(1), Fraction(1), Fraction(0)), (Fraction(3, 5), Fraction(4, 5)))]
    ['11/5', '1', '8/5']
    """

    at_0: Vector
    at_90: Vector
    rod_squared: Fraction

    def __post_init__(self) -> None:
        object.__setattr__(self, "at_0", parse_vector(self.at_0, "at_0"))
        object.__setattr__(self, "at_90", parse_vector(self.at_90, "at_90"))
        object.__setattr__(self, "rod_squared", parse_positive(self.rod_squared, "rod_squared"))

    def is_exact(self, metric: Metric) -> bool:
        """Whether the two vectors are perpendicular and equally long in the metric."""
        squares = [dot(vector, vector, metric) for vector in (self.at_0, self.at_90)]
        return squares[0] == squares[1] and dot(self.at_0, self.at_90, metric) == 0

    def require_exact(self, metric: Metric, where: str) -> None:
        """Refuse a crank whose two vectors do not span a circle in the metric."""
        product = dot(self.at_0, self.at_90, metric)
        if product != 0:
            raise InputError(
                f"{where}: at_0 and at_90 are not perpendicular, their product in the metric is {shown(product)}; "
                "give the crank at two angles 90 degrees apart"
            )
        squares = dot(self.at_0, self.at_0, metric), dot(self.at_90, self.at_90, metric)
        if squares[0] != squares[1]:
            raise InputError(
                f"{where}: at_0 and at_90 have the squared lengths {shown(squares[0])} and {shown(squares[1])}; "
                "give the same crank at two angles"
            )
        if squares[0] == 0:
            raise InputError(f"{where}: the crank has length 0; give one of positive length")

    @property
    def is_planar(self) -> bool:
        """Whether the crank stays in the plane of the first two axes."""
        return self.at_0[2] == 0 == self.at_90[2]

    def knee(self, base: Vector, value: JointValue) -> Vector:
        """The end of the crank at an angle given by its cosine and sine."""
        if not isinstance(value, tuple):
            raise InputError(f"{shown(value)} is no pair; give a crank's angle as cosine and sine")
        c, s = value
        x, y, z = (a + c * u + s * v for a, u, v in zip(base, self.at_0, self.at_90, strict=True))
        return x, y, z


@dataclass(frozen=True)
class Slide:
    """A carriage on a line through the base joint, and a rod from the carriage to the platform.

    Attributes
    ----------
    direction : vector of 3 Fraction
        Not zero; a unit vector if positions are to be lengths.
    rod_squared : Fraction
        Squared length of the rod.

    Examples
    --------
    >>> slide = Slide((0, 0, 1), 25)
    >>> [str(x) for x in slide.knee((Fraction(1), Fraction(2), Fraction(0)), Fraction(7, 2))]
    ['1', '2', '7/2']
    """

    direction: Vector
    rod_squared: Fraction

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", parse_vector(self.direction, "direction"))
        object.__setattr__(self, "rod_squared", parse_positive(self.rod_squared, "rod_squared"))

    def require_exact(self, metric: Metric, where: str) -> None:  # noqa: ARG002 - every other direction is good
        """Refuse a slide without a direction."""
        if not any(self.direction):
            raise InputError(f"{where}: the direction is 0; give one that is not")

    @property
    def is_planar(self) -> bool:
        """Whether the slide lies in the plane of the first two axes."""
        return self.direction[2] == 0

    def knee(self, base: Vector, value: JointValue) -> Vector:
        """The carriage at a position along the slide."""
        if isinstance(value, tuple):
            raise InputError(f"{shown(value)} is no number; give a slide's position as one number")
        x, y, z = (a + value * d for a, d in zip(base, self.direction, strict=True))
        return x, y, z


Chain: TypeAlias = Crank | Slide


def cosine_and_sine(half_tangent: Fraction, weight: int = 1) -> CosSin:
    """Cosine and sine of the angle whose half has the given tangent: (1 - w t^2, 2 t) / (1 + w t^2).

    With a weight w other than 1, tangent and sine are those numbers times sqrt(w) (``geometry.planar_rotation``).

    Examples
    --------
    >>> [str(x) for x in cosine_and_sine(Fraction(1, 2))]
    ['3/5', '4/5']
    """
    square = weight * half_tangent * half_tangent
    return (1 - square) / (1 + square), 2 * half_tangent / (1 + square)


def parse_cosine_and_sine(value: object, where: str, weight: int = 1) -> CosSin:
    """Two rational numbers with c^2 + w s^2 = 1, exactly; the sine is sqrt(w) s."""
    if not isinstance(value, list | tuple) or len(value) != 2:
        raise InputError(f"{where}: {shown(value)} is not a pair; give [cosine, sine]")
    c, s = (parse_rational(number, f"{where}[{i}]") for i, number in enumerate(value, 1))
    total = c * c + weight * s * s
    if total == 1:
        return c, s
    if weight == 1:
        raise InputError(
            f"{where}: the squares of cosine and sine sum to {shown(total)}, not to 1; "
            'give exact pairs such as ["3/5", "4/5"], or half tangents'
        )
    raise InputError(
        f"{where}: c^2 + w s^2 is {shown(total)}, not 1; in this metric w is {shown(weight)}: give cos = c and "
        "sin = sqrt(w) s, or a half tangent"
    )
