"""Balls: real and complex numbers that are known to lie within a radius of their midpoints, and matrices of them.

All is rounded outward at the precision in force (``precision``).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from typing import Any, TypeAlias

from flint import acb, acb_mat, arb, arb_mat, fmpq

Balls: TypeAlias = Any
"""An ``arb_mat`` or an ``acb_mat``, which have the same methods: real points are kept real, which takes less time."""


def ball(value: Fraction) -> arb:
    """A ball around a rational number.

    Examples
    --------
    >>> ball(Fraction(1, 4)) * 4 == 1
    True
    """
    return arb(fmpq(value.numerator, value.denominator))


def hull(low: Fraction, high: Fraction) -> arb:
    """A ball that contains an interval."""
    return ball(low).union(ball(high))


@cache
def unit_matrix(size: int) -> arb_mat:
    """The unit matrix.

    Examples
    --------
    >>> unit_matrix(2).det() == 1
    True
    """
    return arb_mat(size, size, [int(place % (size + 1) == 0) for place in range(size * size)])


@cache
def _complex_unit_matrix(size: int) -> acb_mat:
    return acb_mat(unit_matrix(size))


def unit_matrix_for(points: Balls) -> Balls:
    """The unit matrix, real or complex, that columns like these can be multiplied with."""
    return (unit_matrix if isinstance(points, arb_mat) else _complex_unit_matrix)(points.nrows())


def box_around_zero(radii: Sequence[arb], kind: Any = arb_mat, *, real: bool = True) -> Balls:
    """A column of balls around 0 with these radii, in the imaginary part too unless real.

    They may be a little larger, as Arb rounds radii upwards.
    """
    balls = [arb(0, radius) for radius in radii]
    if kind is arb_mat:
        return arb_mat(len(balls), 1, balls)
    return acb_mat(len(balls), 1, [acb(value, arb(0) if real else value) for value in balls])
