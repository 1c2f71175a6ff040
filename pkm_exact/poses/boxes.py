"""Boxes of the real poses: for every coordinate the cell of a dyadic grid that holds its value.

The cell depends on the value alone, not on a precision or a library version: with x the value times 2^exponent, it is
[floor x, floor x + 1], or [g - 1, g + 1] if x lies within 2^-32 of an integer g.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from math import ceil, floor
from typing import TypeAlias

from flint import arb, arb_poly

from pkm_exact.errors import InputError, InternalContradictionError
from pkm_exact.geometry.study import evaluate, motion_quadrics
from pkm_exact.poses.leg_jacobian import LegJacobian
from pkm_exact.poses.pose import Interval, Pose
from pkm_exact.poses.pose_representation import PoseRepresentation
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import common_ends
from pkm_exact.roots.isolation import RealRoot, isolated_and_enclosed, real_root_enclosures, refined_enclosures
from pkm_exact.wording import shown

DEFAULT_WIDTH = Fraction(1, 10**9)
"""Largest width of a box if none is asked for, in every coordinate."""
NEAR_EXPONENT = 32
"""A value within 2^-32 of a grid point gets a box around that point."""
GUARD_BITS = 48
"""Values are enclosed to 2^-48 of a grid cell before their box is decided."""
NEAR_LIMIT = 1 << GUARD_BITS - NEAR_EXPONENT
"""2^-32 of a cell, in units of 2^-48."""
DOUBLINGS = 4
"""Doublings of the precision before a value that still straddles the nearness limit counts as near."""

LEAST_BITS = 192
"""Coordinates are enclosed to as many at least: boxes and Jacobians mostly ask for no more."""

Enclosures: TypeAlias = Callable[[int, Sequence[int]], Iterable[Sequence[arb]]]
"""Given a precision and indices of poses, their ordinary coordinates: position (3), rotation (9), quaternion (4)."""


def exponent_for_width(width: Fraction) -> int:
    """The smallest grid exponent, at least 0, whose boxes (two cells at most) are no wider than ``width``.

    Raises
    ------
    InputError
        If the width is no exact number greater than 0.

    Examples
    --------
    >>> exponent_for_width(Fraction(1, 1000))
    11
    """
    if not isinstance(width, Fraction | int) or width <= 0:
        raise InputError(f"width: {shown(width)} cannot be used; give a Fraction greater than 0")
    return (ceil(2 / Fraction(width)) - 1).bit_length()


@dataclass
class RootEnclosures:
    """Enclosures of the real poses, in the order of the roots of h; what was found is kept.

    Attributes
    ----------
    representation : PoseRepresentation
        Verified.
    metric : sequence of 3 int
        Gram diagonal; coordinates are ordinary ones.
    """

    representation: PoseRepresentation
    metric: Sequence[int]
    _found: dict[int, tuple[int, list[arb]]] = field(default_factory=dict, init=False, repr=False)
    _enclosed: list[arb] | None = field(default=None, init=False, repr=False)

    @cached_property
    def roots(self) -> tuple[RealRoot, ...]:
        """The real roots of h, isolated."""
        univariate = self.representation.univariate
        isolated = isolated_and_enclosed(univariate.primitive_polynomial, univariate.near)
        self._enclosed = [ball for _, ball in isolated]
        return tuple(root for root, _ in isolated)

    def __call__(self, precision: int, indices: Sequence[int]) -> Iterator[list[arb]]:
        """Position (3), rotation (9) and quaternion (4) of some poses, with about so many bits."""
        bits = max(precision, LEAST_BITS)
        wanted = [index for index in indices if self._found.get(index, (0,))[0] < bits]
        if wanted:
            roots = self._refined(bits)
            if not set(wanted) <= set(range(len(roots))):
                raise InternalContradictionError("the number of real roots changed with the precision")
            with working_precision(bits):
                univariate = self.representation.univariate
                polynomials = [
                    arb_poly(value) for value in (self.representation.denominator, *univariate.numerator_polynomials)
                ]
                for index in wanted:
                    coordinates = study_coordinates(polynomials, roots[index])
                    self._found[index] = bits, ordinary_coordinates(coordinates, self.metric)
        for index in indices:
            yield self._found[index][1]

    def _refined(self, bits: int) -> list[arb]:
        """The roots with about so many bits."""
        h = self.representation.univariate.primitive_polynomial
        refined = None if self._enclosed is None else refined_enclosures(h, self._enclosed, bits)
        self._enclosed = real_root_enclosures(h, bits) if refined is None else refined
        return self._enclosed


def pose_boxes(enclosures: RootEnclosures, width: Fraction) -> tuple[int, tuple[Pose, ...]]:
    """The grid exponent and the boxes of all real poses, pairwise disjoint, increasing in the parameter.

    Parameters
    ----------
    enclosures : RootEnclosures
    width : Fraction
        Largest width of a box in any coordinate.
    """
    roots = enclosures.roots
    exponent, cells = disjoint_cells(enclosures, len(roots), width)
    return exponent, tuple(
        pose_in_cells(row, Interval(root.lo, root.hi)) for root, row in zip(roots, cells, strict=True)
    )


def study_coordinates(polynomials: Sequence[arb_poly], root: arb) -> list[arb]:
    """(e, f) at an enclosed root of h, from h' and the numerators."""
    slope, *values = [polynomial(root) for polynomial in polynomials]
    return [value / slope for value in values]


def disjoint_cells(
    enclosures: Enclosures,
    count: int,
    width: Fraction,
    *,
    size: int = 16,
    apart: int = 12,
    known: Callable[[int], list[list[Interval | None]]] | None = None,
) -> tuple[int, list[list[Interval]]]:
    """The grid exponent and the cells of all coordinates of the poses; no two poses have overlapping boxes.

    Points of another ``size`` serve as well; the boxes differ in one of the first ``apart`` coordinates. Cells that are
    ``known`` on a grid, given by its exponent, are not looked for.
    """
    exponent = exponent_for_width(width)
    while True:
        decided: list[list[Interval | None]] = [[None] * size for _ in range(count)]
        cells = _cells(enclosures, exponent, decided if known is None else known(exponent))
        if not any(meeting_boxes([row[:apart] for row in cells])):
            return exponent, cells
        exponent += 8


def _cells(enclosures: Enclosures, exponent: int, decided: list[list[Interval | None]]) -> list[list[Interval]]:
    """Position (3), rotation (9) and quaternion (4) of every real pose as grid intervals; some are decided before."""
    precision, late = exponent + 128, 0
    # Intervals are true; to compare each with None takes ten times as long.
    while left := [index for index, row in enumerate(decided) if not all(row)]:
        fine = True
        with working_precision(precision):
            for index, values in zip(left, enclosures(precision, left), strict=True):
                row = decided[index]
                for place, value in enumerate(values):
                    if row[place] is None:
                        fine = fine and _radius_fits(value, exponent)
                        row[place] = _grid_interval(value, exponent, near_if_undecided=late > DOUBLINGS)
        late += fine
        precision *= 2
    return [[entry for entry in row if entry is not None] for row in decided]


def ordinary_coordinates(x: Sequence[arb], metric: Sequence[int]) -> list[arb]:
    """Position, rotation matrix and unit quaternion, in ordinary coordinates, of a pose (e, f)."""
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


def _radius_fits(value: arb, exponent: int) -> bool:
    return bool(value.is_finite() and value.rad() * arb(2) ** (exponent + GUARD_BITS) < 1)


def _grid_interval(value: arb, exponent: int, *, near_if_undecided: bool) -> Interval | None:
    """The grid interval of an enclosed value, or None if the enclosure does not decide it."""
    if not _radius_fits(value, exponent):
        return None
    fine = exponent + GUARD_BITS
    mantissa, power = value.mid().man_exp()
    middle = _shifted(int(mantissa), int(power) + fine)
    nearest = (middle + (1 << GUARD_BITS - 1)) >> GUARD_BITS
    distance = abs(middle - (nearest << GUARD_BITS))
    # Of the three units one is the radius, and one each may have been lost by rounding and by the distance.
    if distance + 3 < NEAR_LIMIT:
        return _cell(nearest - 1, nearest + 1, exponent)
    if distance - 3 > NEAR_LIMIT:
        return _cell(middle >> GUARD_BITS, (middle >> GUARD_BITS) + 1, exponent)
    return _at_limit(value, exponent, nearest, near_if_undecided=near_if_undecided)


def _at_limit(value: arb, exponent: int, nearest: int, *, near_if_undecided: bool) -> Interval | None:
    """The same where units of 2^-48 do not tell: by the whole enclosure."""
    middle, radius = (_exact(end) * (1 << exponent) for end in (value.mid(), value.rad()))
    distance, limit = abs(middle - nearest), Fraction(1, 1 << NEAR_EXPONENT)
    if distance + radius < limit or (near_if_undecided and distance - radius <= limit):
        return _cell(nearest - 1, nearest + 1, exponent)
    if distance - radius > limit:
        return _cell(floor(middle), floor(middle) + 1, exponent)
    return None


def _exact(value: arb) -> Fraction:
    mantissa, power = map(int, value.man_exp())
    return Fraction(mantissa) * (Fraction(1 << power) if power >= 0 else Fraction(1, 1 << -power))


def _shifted(mantissa: int, shift: int) -> int:
    return mantissa << shift if shift >= 0 else mantissa >> -shift


def _cell(low: int, high: int, exponent: int) -> Interval:
    return Interval.on_grid(low, high, exponent)


def pose_in_cells(row: Sequence[Interval], parameter: Interval | None, jacobian: LegJacobian | None = None) -> Pose:
    """The pose with these intervals of position, rotation and quaternion."""
    return Pose(
        parameter,
        (row[0], row[1], row[2]),
        (tuple(row[3:6]), tuple(row[6:9]), tuple(row[9:12])),
        (row[12], row[13], row[14], row[15]),
        jacobian=jacobian,
    )


def in_order(poses: Iterable[Pose]) -> tuple[Pose, ...]:
    """The poses as they are listed: by the boxes of position and rotation, from left to right.

    The order is the same whatever method found them.
    """
    listed = list(poses)
    return tuple(listed[place] for place in order_of([pose.box for pose in listed]))


def order_of(boxes: Sequence[Sequence[Interval]]) -> list[int]:
    """The places of boxes from left to right."""
    keys, _ = common_ends([box[:1] for box in boxes])
    if len({first for (first,) in keys}) < len(keys):  # else the first coordinate tells
        keys, _ = common_ends(boxes)
    return sorted(range(len(keys)), key=keys.__getitem__)


def meeting_boxes(boxes: Sequence[Sequence[Interval]]) -> Iterator[tuple[int, int]]:
    """Which boxes meet: in the order of the first coordinate, where mostly neighbours alone may.

    Examples
    --------
    >>> unit, next_one, far = ([Interval.on_grid(a, a + 1, 0)] for a in (0, 1, 3))
    >>> list(meeting_boxes([far, unit, next_one]))
    [(1, 2)]
    """
    ends, _ = common_ends([box[:1] for box in boxes])
    listed = sorted((low, high, place) for place, ((low, high),) in enumerate(ends))
    for number, (_, high, first) in enumerate(listed):
        for low, _, second in listed[number + 1 :]:
            if low > high:
                break
            if all(a.overlaps(b) for a, b in zip(boxes[first], boxes[second], strict=True)):
                yield first, second
