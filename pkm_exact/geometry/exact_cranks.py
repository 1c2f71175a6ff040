"""Cranks that were written in decimals: two vectors that are nearly perpendicular and equally long, made exactly so.

A vector whose length is rational stays as it is. The other is turned into the plane across it, and its angle there is
that of a rational half tangent. If neither length is rational, the second vector is first replaced by one that has the
rounded length, in a rational direction.
"""

from __future__ import annotations

from fractions import Fraction
from math import isqrt
from typing import Final

from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.chains import cosine_and_sine
from pkm_exact.geometry.rational import rational_root

DENOMINATOR: Final = 10**6
"""Greatest one of half tangents: an angle is off by 10^-12 or so."""
_BITS: Final = 120


def exact_crank(at_0: Vector, at_90: Vector, digit: Fraction) -> tuple[Vector, Vector, Fraction] | None:
    """Two vectors that are exactly perpendicular and equally long, next to those given, and by how much they differ.

    Parameters
    ----------
    at_0, at_90 : vector of 3 Fraction
        In ordinary coordinates.
    digit : Fraction
        The unit of the last decimal: no coordinate may differ by more.

    Returns
    -------
    tuple or None
        Both vectors and the greatest difference of a coordinate; None if the vectors are not that near to such.

    Examples
    --------
    >>> given = [tuple(Fraction(x) for x in row) for row in (("21.651", "12.5", "0"), ("0", "0", "25"))]
    >>> first, second, off = exact_crank(*given, Fraction(1, 1000))
    >>> [float(round(x, 6)) for x in first], second == given[1], sum(x * x for x in first), float(round(off, 6))
    ([21.650726, 12.499842, 0.0], True, Fraction(625, 1), 0.000274)
    """
    kept, other = at_90, at_0
    length = rational_root(_dot(at_90, at_90))
    if length is None and rational_root(_dot(at_0, at_0)) is not None:
        kept, other, length = at_0, at_90, rational_root(_dot(at_0, at_0))
    if length is None:
        root = _root(_dot(at_90, at_90))
        length = round(root / digit) * digit
        if length == 0:
            return None
        x, y, z = (length * entry for entry in _unit(at_90, root))
        kept = (x, y, z)
    if length == 0:
        return None
    turned = _across(kept, other, length)
    if turned is None:
        return None
    pair = (kept, turned) if other is at_90 else (turned, kept)
    off = max(abs(x - y) for new, old in zip(pair, (at_0, at_90), strict=True) for x, y in zip(new, old, strict=True))
    return (*pair, off) if off <= digit else None


def _across(kept: Vector, other: Vector, length: Fraction) -> Vector | None:
    """A vector of the given length across another, next to a third; both are rational."""
    axis = (kept[0] / length, kept[1] / length, kept[2] / length)
    first, second = _across_axes(axis)
    along = _dot(other, first), _dot(other, second)
    norm = _root(_dot2(along))
    if norm == 0:
        return None
    cosine, sine = along
    flipped = cosine < 0
    if flipped:
        cosine, sine = -cosine, -sine
    c, s = cosine_and_sine((sine / (norm + cosine)).limit_denominator(DENOMINATOR))
    if flipped:
        c, s = -c, -s
    x, y, z = (length * (c * u + s * v) for u, v in zip(first, second, strict=True))
    return x, y, z


def _across_axes(axis: Vector) -> tuple[Vector, Vector]:
    """Two rational unit vectors across a rational unit vector: the images of two axes in a mirror."""
    place = max(range(3), key=lambda k: (abs(axis[k]), -k))
    sign = -1 if axis[place] > 0 else 1
    normal = [axis[k] - (sign if k == place else 0) for k in range(3)]
    square = sum((x * x for x in normal), Fraction(0))
    rows: list[Vector] = []
    for k in range(3):
        if k != place:
            x, y, z = (Fraction(int(i == k)) - 2 * normal[k] * normal[i] / square for i in range(3))
            rows.append((x, y, z))
    return rows[0], rows[1]


def _unit(vector: Vector, norm: Fraction) -> Vector:
    """A rational unit vector next to a direction, by stereographic projection."""
    place = max(range(3), key=lambda k: (abs(vector[k]), -k))
    sign = 1 if vector[place] > 0 else -1
    rest = [(vector[k] / (norm + abs(vector[place]))).limit_denominator(DENOMINATOR) for k in range(3) if k != place]
    square = sum((t * t for t in rest), Fraction(0))
    entries = [2 * t / (1 + square) for t in rest]
    entries.insert(place, sign * (1 - square) / (1 + square))
    return entries[0], entries[1], entries[2]


def _dot(a: Vector, b: Vector) -> Fraction:
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


def _dot2(pair: tuple[Fraction, Fraction]) -> Fraction:
    return pair[0] * pair[0] + pair[1] * pair[1]


def _root(square: Fraction) -> Fraction:
    return Fraction(isqrt((square.numerator << 2 * _BITS) // square.denominator), 1 << _BITS)
