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
from math import isqrt

import mpmath
from flint import arb, arb_mat, ctx

from pkm_exact.errors import InternalContradictionError
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import CYCLIC
from pkm_exact.poses.boxes import ordinary_coordinates
from pkm_exact.poses.representation import PoseRepresentation
from pkm_exact.roots.interval import Interval
from pkm_exact.roots.isolation import real_root_enclosures

LEAST_PRECISION = 192
"""Bits in which Jacobians are enclosed first."""
GREATEST_PRECISION = 1 << 13
"""Bits that suffice for any Jacobian that is regular; singular ones are known beforehand, exactly."""
OUTPUT_BITS = 40
"""Significant bits of the intervals returned."""
FINEST_EXPONENT = 256
"""Intervals returned lie on the grid 2^-256 at the finest: a bound that close to 0 says enough."""


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
    >>> from pkm_exact.geometry.problem import Leg
    >>> zero, two = (Fraction(0),) * 3, (Fraction(2), Fraction(0), Fraction(0))
    >>> legs = tuple(Leg(zero, joint, Fraction(1)) for joint in (zero, two) * 3)
    >>> characteristic_length(ForwardProblem(legs))
    Fraction(1, 1)
    """
    count = len(problem.legs)
    square = Fraction(0)
    for axis, g in enumerate(problem.metric):
        values = [leg.platform[axis] for leg in problem.legs]
        mean = sum(values, Fraction(0)) / count
        square += g * sum(((value - mean) ** 2 for value in values), Fraction(0)) / count
    if square == 0:
        return Fraction(1)
    shift = 16 - (square.numerator.bit_length() - square.denominator.bit_length()) // 2
    scale = Fraction(2) ** shift
    scaled = square * scale * scale
    return Fraction(isqrt(scaled.numerator // scaled.denominator)) / scale


def pose_jacobians(
    representation: PoseRepresentation, problem: ForwardProblem, ranks: Sequence[int | None]
) -> list[LegJacobian]:
    """The Jacobians at the real poses, in the order of the roots of h; the precision rises until each is decided.

    Parameters
    ----------
    ranks : sequence of int or None
        Exact ranks where they are known (``singularity``); None at poses that are proved simple.
    """
    length, full = characteristic_length(problem), len(problem.legs)
    found: list[LegJacobian | None] = [
        None if rank is None or rank == full else LegJacobian(0, rank, _ZERO, None, length) for rank in ranks
    ]
    precision = LEAST_PRECISION
    while None in found:
        if precision > GREATEST_PRECISION:
            raise InternalContradictionError("a regular Jacobian is not confirmed by its enclosures")
        roots = real_root_enclosures(representation.univariate.primitive_polynomial, precision)
        with ctx.workprec(precision):
            for index, root in enumerate(roots):
                if found[index] is None:
                    values = ordinary_coordinates(representation, problem.metric, root)
                    found[index] = _regular_jacobian(problem, values[:3], values[3:12], length)
        precision *= 2
    return [jacobian for jacobian in found if jacobian is not None]


def _regular_jacobian(
    problem: ForwardProblem, position: Sequence[arb], rotation: Sequence[arb], length: Fraction
) -> LegJacobian | None:
    """The Jacobian at an enclosed pose where it is regular; None if the enclosures are too wide to show it."""
    matrix = _matrix(problem, position, [rotation[0:3], rotation[3:6], rotation[6:9]], length)
    bounds, determinant = _extreme_singular_values(matrix), matrix.det()
    if bounds is None or not (bounds[0] > 0 and (determinant > 0 or determinant < 0)):
        return None
    smallest, condition = _outward(bounds[0]), _outward(bounds[1] / bounds[0])
    if 2 * smallest.lo < smallest.hi:
        return None
    return LegJacobian(1 if determinant > 0 else -1, len(problem.legs), smallest, condition, length)


def _matrix(
    problem: ForwardProblem, position: Sequence[arb], rotation: Sequence[Sequence[arb]], length: Fraction
) -> arb_mat:
    axes = [arb(g).sqrt() for g in problem.metric]
    scale = arb(length.numerator) / length.denominator
    rows = []
    for leg in problem.legs:
        base = [axis * value.numerator / value.denominator for axis, value in zip(axes, leg.base, strict=True)]
        joint = [axis * value.numerator / value.denominator for axis, value in zip(axes, leg.platform, strict=True)]
        arm = [sum((r * b for r, b in zip(row, joint, strict=True)), arb(0)) for row in rotation]
        line = [c + b - a for c, b, a in zip(position, arm, base, strict=True)]
        norm = sum((value * value for value in line), arb(0)).sqrt()
        unit = [value / norm for value in line]
        if problem.planar:
            rows.append([unit[0], unit[1], (arm[0] * unit[1] - arm[1] * unit[0]) / scale])
            continue
        rows.append([*unit, *((arm[j] * unit[k] - arm[k] * unit[j]) / scale for _, j, k in CYCLIC)])
    return arb_mat(rows)


def _extreme_singular_values(matrix: arb_mat) -> tuple[arb, arb] | None:
    """Enclosures of the smallest and the largest singular value; None if the entries are too wide for any bound.

    With an approximate eigenvector matrix V of J^T J, floating but exact as it stands, V^-1 (J^T J) V is similar to it
    and nearly diagonal: all eigenvalues lie in its Gershgorin discs. Rayleigh quotients bound the extreme ones from
    inside. Eigenvalues need not be told apart.
    """
    symmetric = matrix.transpose() * matrix
    size = symmetric.nrows()
    if not all(entry.is_finite() for entry in symmetric.entries()):
        return None
    with mpmath.workprec(ctx.prec):
        middle = mpmath.matrix([[mpmath.mpf(symmetric[i, j].mid()._mpf_) for j in range(size)] for i in range(size)])
        vectors = mpmath.eigsy((middle + middle.T) / 2)[1]
        basis = arb_mat([[arb(vectors[i, j]) for j in range(size)] for i in range(size)])
    similar = basis.inv() * symmetric * basis
    discs = []
    for i in range(size):
        radius = sum((abs(similar[i, j]) for j in range(size) if j != i), arb(0))
        discs.append((similar[i, i] - radius, similar[i, i] + radius))
    if not all(end.is_finite() for disc in discs for end in disc):
        return None
    columns = [arb_mat(size, 1, [basis[i, j] for i in range(size)]) for j in range(size)]
    quotients = [
        (column.transpose() * symmetric * column)[0, 0] / (column.transpose() * column)[0, 0] for column in columns
    ]
    low = min(_ends(disc[0])[0] for disc in discs)
    high = max(_ends(disc[1])[1] for disc in discs)
    smallest = _hull(max(Fraction(0), low), min(_ends(value)[1] for value in quotients))
    largest = _hull(max(_ends(value)[0] for value in quotients), high)
    return smallest.nonnegative_part().sqrt(), largest.sqrt()


def _hull(low: Fraction, high: Fraction) -> arb:
    """A ball that contains both ends."""
    ends = [arb(end.numerator) / end.denominator for end in (low, max(low, high))]
    return ends[0].union(ends[1])


def _outward(value: arb) -> Interval:
    """A dyadic interval around an enclosure of a number that is not negative."""
    low, high = _ends(value)
    if high <= 0:
        return Interval(Fraction(0), Fraction(0))
    shift = min(OUTPUT_BITS - (high.numerator.bit_length() - high.denominator.bit_length()), FINEST_EXPONENT)
    scale = Fraction(2) ** shift
    return Interval(max(Fraction(0), (low * scale).__floor__() / scale), -((-high * scale).__floor__() / scale))


def _ends(value: arb) -> tuple[Fraction, Fraction]:
    """Exact ends of an enclosure."""
    middle, radius = (
        Fraction(int(mantissa)) * Fraction(2) ** int(power)
        for mantissa, power in (value.mid().man_exp(), value.rad().man_exp())
    )
    return middle - radius, middle + radius
