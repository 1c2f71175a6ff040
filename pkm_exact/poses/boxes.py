"""Boxes of the real poses: for every coordinate the cell of a dyadic grid that holds its value.

The cell depends on the value alone, not on a precision or a library version: with x the value times 2^exponent, it is
[floor x, floor x + 1], or [g - 1, g + 1] if x lies within 2^-32 of an integer g.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from flint import arb, arb_poly, ctx, fmpz_poly

from pkm_exact.errors import InternalContradictionError
from pkm_exact.geometry.study import evaluate, motion_quadrics
from pkm_exact.poses.pose import Interval, Pose
from pkm_exact.poses.representation import PoseRepresentation
from pkm_exact.roots.isolation import isolate_real_roots, real_root_enclosures

NEAR_EXPONENT = 32
"""A value within 2^-32 of a grid point gets a box around that point."""
GUARD_BITS = 48
"""Values are enclosed to 2^-48 of a grid cell before their box is decided."""
DOUBLINGS = 4
"""Doublings of the precision before a value that still straddles the nearness limit counts as near."""


def exponent_for_width(width: Fraction) -> int:
    """The smallest grid exponent, at least 0, whose boxes (two cells at most) are no wider than ``width``.

    Examples
    --------
    >>> exponent_for_width(Fraction(1, 1000))
    11
    """
    exponent = 0
    while Fraction(2, 1 << exponent) > width:
        exponent += 1
    return exponent


def pose_boxes(
    representation: PoseRepresentation, metric: Sequence[int], width: Fraction
) -> tuple[int, tuple[Pose, ...]]:
    """The grid exponent and the boxes of all real poses, pairwise disjoint, increasing in the parameter.

    Parameters
    ----------
    representation : PoseRepresentation
        Verified.
    metric : sequence of 3 int
        Gram diagonal; boxes are in ordinary coordinates.
    width : Fraction
        Largest width of a box in any coordinate.
    """
    h = representation.univariate.primitive_polynomial
    roots = isolate_real_roots(h)
    exponent = exponent_for_width(width)
    while True:
        cells = _cells(representation, metric, exponent, len(roots))
        poses = tuple(_pose(Interval(root.lo, root.hi), row) for root, row in zip(roots, cells, strict=True))
        if _are_disjoint(poses):
            return exponent, poses
        exponent += 8


def _cells(
    representation: PoseRepresentation, metric: Sequence[int], exponent: int, count: int
) -> list[list[Interval]]:
    """Position (3), rotation (9) and quaternion (4) of every real pose as grid intervals."""
    h = representation.univariate.primitive_polynomial
    precision = exponent + 128
    decided: list[list[Interval | None]] = [[None] * 16 for _ in range(count)]
    late = 0
    while True:
        enclosures = real_root_enclosures(h, precision)
        if len(enclosures) != count:
            raise InternalContradictionError("the number of real roots changed with the precision")
        fine = True
        with ctx.workprec(precision):
            for row, root in zip(decided, enclosures, strict=True):
                if None not in row:
                    continue
                values = ordinary_coordinates(representation, metric, root)
                for index, value in enumerate(values):
                    if row[index] is None:
                        fine = fine and _radius_fits(value, exponent)
                        row[index] = _grid_interval(value, exponent, near_if_undecided=late > DOUBLINGS)
        if all(entry is not None for row in decided for entry in row):
            return [[entry for entry in row if entry is not None] for row in decided]
        late += fine
        precision *= 2


def ordinary_coordinates(representation: PoseRepresentation, metric: Sequence[int], root: arb) -> list[arb]:
    """Position, rotation matrix and unit quaternion, in ordinary coordinates, at an enclosed root of h."""
    slope = _at(representation.denominator, root)
    x = [_at(numerator, root) / slope for numerator in representation.univariate.numerator_polynomials]
    products = [[left * right for right in x] for left in x]
    quadrics = [evaluate(quadric, products) for quadric in motion_quadrics(metric)]
    norm = quadrics[-1]
    c = [value / norm for value in quadrics[4:7]]
    rotation = [value / norm for value in quadrics[7:16]]
    scales = [arb(g).sqrt() for g in metric]
    length = norm.sqrt()
    values = [scale * value for scale, value in zip(scales, c, strict=True)]
    values += [rotation[3 * i + j] * scales[i] / scales[j] for i in range(3) for j in range(3)]
    values.append(arb(metric[0] * metric[1] * metric[2]).sqrt() * x[0] / length)
    values += [scales[i] * x[i + 1] / length for i in range(3)]
    return values


def _at(polynomial: fmpz_poly, point: arb) -> arb:
    return arb_poly(polynomial)(point)


def _radius_fits(value: arb, exponent: int) -> bool:
    return bool(value.is_finite() and value.rad() * arb(2) ** (exponent + GUARD_BITS) < 1)


def _grid_interval(value: arb, exponent: int, *, near_if_undecided: bool) -> Interval | None:
    """The grid interval of an enclosed value, or None if the enclosure does not decide it."""
    if not _radius_fits(value, exponent):
        return None
    mantissa, power = value.mid().man_exp()
    middle = Fraction(int(mantissa)) * Fraction(2) ** (int(power) + exponent)
    mantissa, power = value.rad().man_exp()
    radius = Fraction(int(mantissa)) * Fraction(2) ** (int(power) + exponent)
    nearest = (middle + Fraction(1, 2)).__floor__()
    distance = abs(middle - nearest)
    limit = Fraction(1, 1 << NEAR_EXPONENT)
    scale = 1 << exponent
    if distance + radius < limit or (near_if_undecided and distance - radius <= limit):
        return Interval(Fraction(nearest - 1, scale), Fraction(nearest + 1, scale))
    if distance - radius > limit:
        cell = middle.__floor__()
        return Interval(Fraction(cell, scale), Fraction(cell + 1, scale))
    return None


def _pose(parameter: Interval, row: Sequence[Interval]) -> Pose:
    return Pose(
        parameter,
        (row[0], row[1], row[2]),
        tuple(tuple(row[3 + 3 * i : 6 + 3 * i]) for i in range(3)),
        (row[12], row[13], row[14], row[15]),
    )


def _are_disjoint(poses: Sequence[Pose]) -> bool:
    vectors = [[*pose.position, *(entry for row in pose.rotation for entry in row)] for pose in poses]
    return all(
        any(not a.overlaps(b) for a, b in zip(vectors[i], vectors[j], strict=True))
        for i in range(len(vectors))
        for j in range(i)
    )
