"""The Jacobian at a certified pose: sign of its determinant, rank, singular values, all by rigorous enclosures.

Its rows are the wrenches of the constraints (``poses.wrenches``). That of a leg is (n, (R B) x n / L) with n the unit
vector of the leg C + R B - A in ordinary coordinates and L a length that makes rotations comparable to translations:
the root mean square distance of the platform's points from their centroid, rounded to a rational. The row is the
derivative of the leg's length along a velocity of the platform and L times its angular velocity. The rank drops exactly
where the pose is singular (a multiple solution).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache, reduce
from math import isfinite, isqrt, lcm

from flint import arb, arb_mat

from pkm_exact.balls import unit_matrix
from pkm_exact.constraints.constraint import Role
from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InternalContradictionError
from pkm_exact.geometry.problem import ForwardProblem, points
from pkm_exact.poses.boxes import Enclosures
from pkm_exact.poses.leg_jacobian import LegJacobian
from pkm_exact.poses.singular_vectors import singular_vectors
from pkm_exact.poses.wrenches import BallRows
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


_ZERO = Interval(Fraction(0), Fraction(0))


def characteristic_length(problem: ForwardProblem) -> Fraction:
    """Root mean square distance of the platform's points from their centroid, to 16 significant bits.

    Of the base's points, if the platform has no two; 1 if the base has no two either.

    Examples
    --------
    >>> from pkm_exact.constraints.distance import Distance
    >>> zero, two = (Fraction(0),) * 3, (Fraction(2), Fraction(0), Fraction(0))
    >>> legs = tuple(Distance(zero, joint, Fraction(1)) for joint in (zero, two) * 3)
    >>> characteristic_length(ForwardProblem(legs))
    Fraction(1, 1)
    """
    platform, base = (points(problem, role) for role in (Role.PLATFORM_POINT, Role.BASE_POINT))
    square = _spread(tuple(platform), problem.metric) or _spread(tuple(base), problem.metric)
    if square == 0:
        return Fraction(1)
    shift = 16 - (square.numerator.bit_length() - square.denominator.bit_length()) // 2
    scale = Fraction(2) ** shift
    scaled = square * scale * scale
    return Fraction(isqrt(scaled.numerator // scaled.denominator)) / scale


@lru_cache(maxsize=8)
def _spread(joints: tuple[Vector, ...], metric: tuple[int, ...]) -> Fraction:
    """Mean square distance from the centroid."""
    if not joints or not all(isinstance(value, Fraction) for joint in joints for value in joint):
        return _spread_of_roots(joints, metric)
    # n sum x^2 - (sum x)^2, over n^2, in integers over one denominator: far fewer fractions are reduced.
    count, unit = len(joints), lcm(*(value.denominator for joint in joints for value in joint))
    total = 0
    for axis, g in enumerate(metric):
        values = [joint[axis].numerator * (unit // joint[axis].denominator) for joint in joints]
        total += g * (count * sum(value * value for value in values) - sum(values) ** 2)
    return Fraction(total, (count * unit) ** 2)


def _spread_of_roots(joints: tuple[Vector, ...], metric: tuple[int, ...]) -> Fraction:
    """The same of numbers of any kind."""
    square = Fraction(0)
    for axis, g in enumerate(metric):
        values = [joint[axis] for joint in joints]
        if values:
            mean = sum(values, Fraction(0)) / len(values)
            square += g * sum(((value - mean) ** 2 for value in values), Fraction(0)) / len(values)
    return square


def pose_jacobians(
    enclosures: Enclosures,
    problem: ForwardProblem,
    ranks: Sequence[int | None],
    known: Sequence[LegJacobian | None] | None = None,
) -> list[LegJacobian]:
    """The Jacobians at the real poses; the precision rises until each is decided.

    Parameters
    ----------
    ranks : sequence of int or None
        Exact ranks where they are known (``singularity``); None at poses that are proved simple.
    known : sequence of LegJacobian or None, optional
        Those that need not be looked for.
    """
    at_once = [jacobian for jacobian in known or () if jacobian is not None]
    if len(at_once) == len(ranks) == list(ranks).count(None):
        return at_once
    length, full = characteristic_length(problem), problem.motion.dimension
    found: list[LegJacobian | None] = [
        before if rank is None or rank == full else LegJacobian(0, rank, _ZERO, None, length)
        for rank, before in zip(ranks, known or [None] * len(ranks), strict=True)
    ]
    precision = LEAST_PRECISION
    while None in found:
        if precision > GREATEST_PRECISION:
            raise InternalContradictionError("a regular Jacobian is not confirmed by its enclosures")
        with working_precision(precision):
            left = [index for index, jacobian in enumerate(found) if jacobian is None]
            rows = BallRows(problem, length)
            for index, values in zip(left, enclosures(precision, left), strict=True):
                matrix = rows.at(values[:3], [values[3:6], values[6:9], values[9:12]])
                found[index] = _regular_jacobian(matrix, length)
        precision *= 2
    return [jacobian for jacobian in found if jacobian is not None]


def _regular_jacobian(matrix: arb_mat, length: Fraction) -> LegJacobian | None:
    """The Jacobian at an enclosed pose where it is regular; None if the enclosures are too wide to show it."""
    sign = None
    if matrix.nrows() == matrix.ncols():
        determinant = matrix.det()
        if not (determinant > 0 or determinant < 0):
            return None
        sign = 1 if determinant > 0 else -1
    try:
        largest, inverse = largest_singular_value(matrix), largest_singular_value(_left_inverse(matrix))
    except ZeroDivisionError:
        return None
    if largest is None or inverse is None:
        return None
    smallest = 1 / inverse
    if not 2 * smallest.lower() >= smallest.upper():
        return None
    return LegJacobian(sign, matrix.ncols(), _outward(smallest), _outward(largest * inverse), length)


def _left_inverse(matrix: arb_mat) -> arb_mat:
    """The inverse, or (J^T J)^-1 J^T if there are more rows than columns: its singular values are the reciprocals."""
    if matrix.nrows() == matrix.ncols():
        return matrix.inv()
    transpose = matrix.transpose()
    return (transpose * matrix).inv() * transpose


def largest_singular_value(matrix: arb_mat) -> arb | None:
    """An enclosure of the largest singular value; None if the entries are too wide for one.

    With approximate singular vectors U, V, floating but exact as they stand, U^T A V is nearly diagonal: its singular
    values differ from the diagonal by the norm of the rest at most (Weyl). Those of A are these times factors between
    the extreme singular values of U^-1 and V^-1, and these are near 1: |U^T U - 1| bounds how near.
    """
    width, exponent = matrix.ncols(), _exponent(matrix)
    matrix = matrix * arb(2) ** -exponent
    middle = [float(entry.mid()) for entry in matrix.entries()]
    if not all(map(isfinite, middle)):
        return None
    left, right = singular_vectors([middle[start : start + width] for start in range(0, len(middle), width)])
    u, v = arb_mat(left), arb_mat(right)
    entries = (u.transpose() * matrix * v).entries()
    diagonal = range(0, min(len(entries), width * width), width + 1)
    largest = reduce(arb.max, [abs(entries[place]) for place in diagonal])
    largest += arb(0, _norm([entry for place, entry in enumerate(entries) if place not in diagonal]))
    for basis in (u, v):
        defect = _norm((basis.transpose() * basis - unit_matrix(basis.nrows())).entries())
        if not defect < 1:
            return None
        largest /= (1 + arb(0, defect)).sqrt()
    return largest * arb(2) ** exponent if largest > 0 else None


def _exponent(matrix: arb_mat) -> int:
    """The binary exponent of the largest entry, roughly."""
    sizes = [abs(entry) for entry in matrix.entries() if entry.is_finite()]
    mantissa, power = reduce(arb.max, sizes, arb(0)).mid().man_exp()
    return int(power) + int(mantissa).bit_length() if mantissa else 0


def _norm(entries: Sequence[arb]) -> arb:
    """An upper bound of the root of the sum of squares."""
    row = arb_mat(1, len(entries), entries)
    # The sum of squares of balls around 0 may reach below 0, where there is no root; its upper bound does not.
    return (row * row.transpose())[0, 0].abs_upper().sqrt().abs_upper()


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
