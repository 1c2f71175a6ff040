"""The leg Jacobian at a certified pose: sign of its determinant, rank, singular values, all by rigorous enclosures.

Row i is (n_i, (R B_i) x n_i / L) with n_i the unit vector of the leg C + R B_i - A_i in ordinary coordinates and L a
length that makes rotations comparable to translations: the root mean square distance of the platform joints from their
centroid, rounded to a rational. The row is the derivative of the leg's length along a velocity of the platform and L
times its angular velocity. Its rank drops exactly where the pose is singular (a multiple solution).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, reduce
from math import isqrt
from typing import TypeAlias

import numpy as np
from flint import arb, arb_mat

from pkm_exact.errors import InternalContradictionError
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import CYCLIC
from pkm_exact.poses.boxes import Enclosures
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval

LEAST_PRECISION = 192
"""Bits in which Jacobians are enclosed first."""
GREATEST_PRECISION = 1 << 13
"""Bits that suffice for any Jacobian that is regular; singular ones are known beforehand, exactly."""
OUTPUT_BITS = 32
"""Significant bits of the intervals returned."""
FINEST_EXPONENT = 256
"""Intervals returned lie on the grid 2^-256 at the finest: a bound that close to 0 says enough."""


_Joints: TypeAlias = tuple[arb_mat, arb_mat]

_ZERO = Interval(Fraction(0), Fraction(0))


@dataclass(frozen=True)
class LegJacobian:
    """What is certified of the Jacobian at a pose.

    Attributes
    ----------
    det_sign : int
        Sign of the determinant, 0 if it is 0 exactly: assembly modes of different sign are separated by singularities.
    rank : int
        Exact rank; less than the number of legs at a singular pose.
    sigma_min : Interval
        Smallest singular value, exactly 0 at a singular pose.
    condition : Interval or None
        Largest singular value by the smallest; None at a singular pose.
    length : Fraction
        The scaling length L, in the robot's unit.
    """

    det_sign: int
    rank: int
    sigma_min: Interval
    condition: Interval | None
    length: Fraction


def characteristic_length(problem: ForwardProblem) -> Fraction:
    """Root mean square distance of the platform joints from their centroid, to 16 significant bits; 1 if it is 0.

    Examples
    --------
    >>> from pkm_exact.constraints.distance import Distance
    >>> zero, two = (Fraction(0),) * 3, (Fraction(2), Fraction(0), Fraction(0))
    >>> legs = tuple(Distance(zero, joint, Fraction(1)) for joint in (zero, two) * 3)
    >>> characteristic_length(ForwardProblem(legs))
    Fraction(1, 1)
    """
    count = len(problem.distances)
    square = Fraction(0)
    for axis, g in enumerate(problem.metric):
        values = [leg.platform[axis] for leg in problem.distances]
        mean = sum(values, Fraction(0)) / count
        square += g * sum(((value - mean) ** 2 for value in values), Fraction(0)) / count
    if square == 0:
        return Fraction(1)
    shift = 16 - (square.numerator.bit_length() - square.denominator.bit_length()) // 2
    scale = Fraction(2) ** shift
    scaled = square * scale * scale
    return Fraction(isqrt(scaled.numerator // scaled.denominator)) / scale


def pose_jacobians(enclosures: Enclosures, problem: ForwardProblem, ranks: Sequence[int | None]) -> list[LegJacobian]:
    """The Jacobians at the real poses; the precision rises until each is decided.

    Parameters
    ----------
    ranks : sequence of int or None
        Exact ranks where they are known (``singularity``); None at poses that are proved simple.
    """
    length, full = characteristic_length(problem), len(problem.distances)
    found: list[LegJacobian | None] = [
        None if rank is None or rank == full else LegJacobian(0, rank, _ZERO, None, length) for rank in ranks
    ]
    precision = LEAST_PRECISION
    while None in found:
        if precision > GREATEST_PRECISION:
            raise InternalContradictionError("a regular Jacobian is not confirmed by its enclosures")
        with working_precision(precision):
            left = [index for index, jacobian in enumerate(found) if jacobian is None]
            joints = _joints(problem)
            for index, values in zip(left, enclosures(precision, left), strict=True):
                found[index] = _regular_jacobian(problem, joints, values[:3], values[3:12], length)
        precision *= 2
    return [jacobian for jacobian in found if jacobian is not None]


def _regular_jacobian(
    problem: ForwardProblem, joints: _Joints, position: Sequence[arb], rotation: Sequence[arb], length: Fraction
) -> LegJacobian | None:
    """The Jacobian at an enclosed pose where it is regular; None if the enclosures are too wide to show it."""
    matrix = _matrix(problem, joints, position, [rotation[0:3], rotation[3:6], rotation[6:9]], length)
    determinant = matrix.det()
    if not (determinant > 0 or determinant < 0):
        return None
    try:
        largest, inverse = _largest_singular_value(matrix), _largest_singular_value(matrix.inv())
    except ZeroDivisionError:
        return None
    if largest is None or inverse is None:
        return None
    smallest, condition = _outward(1 / inverse), _outward(largest * inverse)
    if 2 * smallest.lo < smallest.hi:
        return None
    return LegJacobian(1 if determinant > 0 else -1, len(problem.distances), smallest, condition, length)


def _joints(problem: ForwardProblem) -> _Joints:
    """The joints of base and platform, one leg per row, in ordinary coordinates."""
    axes = [arb(g).sqrt() for g in problem.metric]
    base, platform = (
        arb_mat(
            [
                [axis * joint.numerator / joint.denominator for axis, joint in zip(axes, row, strict=True)]
                for row in side
            ]
        )
        for side in ([leg.base for leg in problem.distances], [leg.platform for leg in problem.distances])
    )
    return base, platform


def _matrix(
    problem: ForwardProblem,
    joints: _Joints,
    position: Sequence[arb],
    rotation: Sequence[Sequence[arb]],
    length: Fraction,
) -> arb_mat:
    scale = arb(length.denominator) / length.numerator
    base, arms = joints
    turned = arms * arb_mat([list(row) for row in rotation]).transpose()
    rows = []
    for arm, start in zip(turned.tolist(), base.tolist(), strict=True):
        line = [c + b - a for c, b, a in zip(position, arm, start, strict=True)]
        factor = (line[0] * line[0] + line[1] * line[1] + line[2] * line[2]).rsqrt()
        unit = [value * factor for value in line]
        turns = [(arm[j] * unit[k] - arm[k] * unit[j]) * scale for _, j, k in CYCLIC]
        rows.append([unit[0], unit[1], turns[2]] if problem.motion.is_planar else [*unit, *turns])
    return arb_mat(rows)


def _largest_singular_value(matrix: arb_mat) -> arb | None:
    """An enclosure of the largest singular value; None if the entries are too wide for one.

    With approximate singular vectors U, V, floating but exact as they stand, U^T A V is nearly diagonal: its singular
    values differ from the diagonal by the norm of the rest at most (Weyl). Those of A are these times factors between
    the extreme singular values of U^-1 and V^-1, and these are near 1: |U^T U - 1| bounds how near.
    """
    size, exponent = matrix.nrows(), _exponent(matrix)
    matrix = matrix * arb(2) ** -exponent
    middle = np.array([float(entry.mid()) for entry in matrix.entries()]).reshape(size, size)
    if not np.isfinite(middle).all():
        return None
    left, _, right = np.linalg.svd(middle)
    u, v = arb_mat(left.tolist()), arb_mat(right.T.tolist())
    entries = (u.transpose() * matrix * v).entries()
    largest = reduce(arb.max, [abs(entry) for entry in entries[:: size + 1]])
    largest += arb(0, _norm([entry for place, entry in enumerate(entries) if place % (size + 1)]))
    for basis in (u, v):
        defect = _norm((basis.transpose() * basis - _unit(size)).entries())
        if not defect < 1:
            return None
        largest /= (1 + arb(0, defect)).sqrt()
    return largest * arb(2) ** exponent if largest > 0 else None


@cache
def _unit(size: int) -> arb_mat:
    return arb_mat(size, size, [int(place % (size + 1) == 0) for place in range(size * size)])


def _exponent(matrix: arb_mat) -> int:
    """The binary exponent of the largest entry, roughly."""
    sizes = [abs(entry) for entry in matrix.entries() if entry.is_finite()]
    mantissa, power = reduce(arb.max, sizes, arb(0)).mid().man_exp()
    return int(power) + int(mantissa).bit_length() if mantissa else 0


def _norm(entries: Sequence[arb]) -> arb:
    """An upper bound of the root of the sum of squares."""
    row = arb_mat(1, len(entries), entries)
    return (row * row.transpose())[0, 0].sqrt().abs_upper()


def _outward(value: arb) -> Interval:
    """A dyadic interval around an enclosure of a number that is not negative."""
    low, high, exponent = _ends(value)
    if high <= 0:
        return Interval(Fraction(0), Fraction(0))
    shift = min(OUTPUT_BITS + 1 - (high.bit_length() + exponent), FINEST_EXPONENT)
    return Interval(
        _dyadic(max(0, _floor(low, shift + exponent)), shift), _dyadic(-_floor(-high, shift + exponent), shift)
    )


def _floor(value: int, exponent: int) -> int:
    """The integer below value times 2^exponent."""
    return value << exponent if exponent >= 0 else value >> -exponent


def _dyadic(value: int, shift: int) -> Fraction:
    """The value times 2^-shift."""
    return Fraction(value, 1 << shift) if shift >= 0 else Fraction(value << -shift)


def _ends(value: arb) -> tuple[int, int, int]:
    """The ends of an enclosure, exactly: two integers, to be multiplied by a common power of 2, and its exponent."""
    (middle, first), (radius, second) = (
        (int(mantissa), int(power)) for mantissa, power in (value.mid().man_exp(), value.rad().man_exp())
    )
    exponent = min(first, second)
    middle, radius = middle << first - exponent, radius << second - exponent
    return middle - radius, middle + radius, exponent
