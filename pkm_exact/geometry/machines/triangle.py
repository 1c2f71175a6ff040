"""Directions at 0, 120 and 240 degrees, rational in the metric (1, 3, 1): the ordinary y is sqrt(3) times that y.

``RADIAL`` are unit vectors. ``TANGENTIAL`` are perpendicular to them, of squared length 3.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Final

from pkm_exact.constraints.form import Vector

METRIC: Final = (1, 3, 1)
_HALF: Final = Fraction(1, 2)
_ZERO: Final = Fraction(0)
_ONE: Final = Fraction(1)

UP: Final[Vector] = (_ZERO, _ZERO, _ONE)
ORIGIN: Final[Vector] = (_ZERO, _ZERO, _ZERO)
RADIAL: Final[tuple[Vector, ...]] = ((_ONE, _ZERO, _ZERO), (-_HALF, _HALF, _ZERO), (-_HALF, -_HALF, _ZERO))
TANGENTIAL: Final[tuple[Vector, ...]] = (
    (_ZERO, _ONE, _ZERO),
    (-3 * _HALF, -_HALF, _ZERO),
    (3 * _HALF, -_HALF, _ZERO),
)


def along(*parts: tuple[Fraction | int, Vector]) -> Vector:
    """The sum of multiples of vectors.

    Examples
    --------
    >>> [str(x) for x in along((2, RADIAL[1]), (Fraction(1, 3), UP))]
    ['-1', '1', '1/3']
    """
    x, y, z = (sum((factor * vector[i] for factor, vector in parts), Fraction(0)) for i in range(3))
    return x, y, z
