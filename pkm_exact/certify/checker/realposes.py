"""The real poses: their number, isolating intervals of the parameter, boxes. Every interval is proved or computed anew.

Real solutions are those with a real parameter, since (e, f) are rational functions of t over Q and t a linear form in
(e, f). The real roots are counted and looked up in the intervals that are listed, or isolated (``listed_roots``). The
grid cell that a coordinate lies in does not depend on a precision: there is one right answer, and the certificate must
have it. But where the distance from a grid point is 2^-32 cells up to thousands of bits, it depends on what these tell;
both cells hold the value.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache, partial
from typing import Final, TypeAlias

from flint import arb, arb_poly, ctx, fmpq, fmpz, fmpz_poly

from pkm_exact.certify.checker.budget import ball_cost, charge, limbs
from pkm_exact.certify.checker.descartes import MAX_ISOLATION, RealRoot, dyadic, signs_at, value_at
from pkm_exact.certify.checker.document import Ends, ListedPose, Representation
from pkm_exact.certify.checker.krawczyk import Equations, Isolated, narrowed
from pkm_exact.certify.checker.listed_roots import PARAMETER_EXPONENT, roots_by_intervals
from pkm_exact.certify.checker.solutions import primitive_part
from pkm_exact.certify.checker.study_motion import Metric, motion
from pkm_exact.certify.checker.verdict import MAX_PRECISION, rejected, too_large

Cell: TypeAlias = tuple[fmpz, fmpz]
"""The ends of an interval, times the power of 2 of its grid."""

NEAR: Final = 32
"""A coordinate closer than 2^-32 cells to a grid point gets the two cells around it."""
ENCLOSED: Final = 40
"""Coordinates are enclosed to 2^-40 cells before their cell is decided."""
FIRST_BITS: Final = 128
"""Bits beyond those of the grid by which coordinates are enclosed at first, and twice as many then."""
DOUBLINGS: Final = 4
"""Doublings of the precision after which a coordinate not decided to be far from a grid point counts as near."""
_ONE: Final = 1 << 2 * NEAR
_FAR: Final = 1 << NEAR + 1
_CLOSE: Final = 1 << NEAR - 1
"""A cell, twice and half of what counts as near, in units of 2^-64 cells."""


def check_real_poses(
    representation: Representation, metric: Metric, exponent: int, poses: Sequence[ListedPose]
) -> Iterator[str]:
    """The poses listed are all the real ones, each with the intervals that it must have, no two in the same box."""
    h = primitive_part(representation.eliminant)
    roots = roots_by_intervals(h, [pose.parameter for pose in poses if pose.parameter is not None])
    cells, fineness = parameter_cells(h, roots)
    if len(poses) != len(cells):
        raise rejected(f"real poses: {len(poses)} listed, the eliminant has {len(cells)} real roots")
    boxes = root_boxes(representation, metric, exponent, roots)
    order = in_order(boxes)
    for number, (pose, root) in enumerate(zip(poses, order, strict=True), 1):
        if pose.parameter != cell_ends(*cells[root], fineness):
            raise rejected(f"real poses: pose {number} does not have the isolating interval of real root {root + 1}")
    yield f"real poses: {len(poses)}, one for each real root of the eliminant"
    yield from _check_boxes([boxes[root] for root in order], exponent, poses)


def root_boxes(
    representation: Representation, metric: Metric, exponent: int, roots: Sequence[RealRoot]
) -> list[list[Cell]]:
    """The boxes of the real solutions, in the order of the roots."""

    def enclose(precision: int) -> list[list[arb]]:
        polynomials = _enclosed(representation, precision)
        return [_at_root(polynomials, metric, root.ball(precision), precision) for root in roots]

    return box_cells(enclose, exponent)


def in_order(boxes: Sequence[Sequence[Cell]]) -> list[int]:
    """The indices of the boxes in the order in which their poses are listed."""
    return sorted(range(len(boxes)), key=lambda index: [(int(low), int(high)) for low, high in boxes[index][:12]])


def check_isolated_poses(
    isolated: Isolated, equations: Equations, exponent: int, poses: Sequence[ListedPose]
) -> Iterator[str]:
    """The poses listed are those in the real boxes, one after another, with the intervals that they must have."""
    if len(poses) != len(isolated.real):
        raise rejected(f"real poses: {len(poses)} listed, there are {len(isolated.real)} real boxes")
    if any(pose.parameter is not None for pose in poses):
        raise rejected("real poses: a parameter is given, but there is no eliminant")
    yield f"real poses: {len(poses)}, one in each real box"
    metric = equations.metric

    def enclose(precision: int) -> list[list[arb]] | None:
        points = [narrowed(equations, box, precision) for box in isolated.real]
        found = [point for point in points if point is not None]
        if len(found) < len(points):
            return None
        return [ordinary_coordinates(point[:4], point[4:], metric, precision) for point in found]

    boxes = box_cells(enclose, exponent)
    if in_order(boxes) != list(range(len(boxes))):
        raise rejected("real poses: not listed in the order of their boxes")
    yield from _check_boxes(boxes, exponent, poses)


def _check_boxes(boxes: Sequence[Sequence[Cell]], exponent: int, poses: Sequence[ListedPose]) -> Iterator[str]:
    """The boxes listed are these, which are in order, and disjoint."""
    words = limbs(max((int(abs(end).bit_length()) for box in boxes for cell in box for end in cell), default=0))
    charge(len(poses) * (32 * (10000 + words * (2000 + 10 * words)) + 10000 * len(poses)))
    for number, (pose, box) in enumerate(zip(poses, boxes, strict=True), 1):
        if pose.box != tuple(cell_ends(low, high, exponent) for low, high in box):
            raise rejected(f"boxes: the box of pose {number} is not that of its solution")
    yield f"boxes: all {16 * len(poses)} intervals are those of the solutions, on the grid 2^-{exponent}"
    for i, one in enumerate(boxes):
        for j in range(i + 1, len(boxes)):
            if boxes[j][0][0] > one[0][1]:  # and so of those that come after it
                break
            if not any(a[1] < b[0] or b[1] < a[0] for a, b in zip(one[:12], boxes[j][:12], strict=True)):
                raise rejected(f"boxes: those of poses {i + 1} and {j + 1} are not disjoint in position or rotation")
    yield "boxes: pairwise disjoint in position or rotation"


def cell_ends(low: fmpz, high: fmpz, exponent: int) -> Ends:
    """The ends of a cell, as texts."""
    return _spelled(low, exponent), _spelled(high, exponent)


def _spelled(number: fmpz, exponent: int) -> str:
    """The rational number number / 2^exponent in lowest terms."""
    value = int(number)
    if value & 1:
        return str(number) + _denominator(exponent)
    twos = min((value & -value).bit_length() - 1, exponent) if value else exponent
    return str(fmpz(value >> twos)) + _denominator(exponent - twos)


@lru_cache(maxsize=MAX_ISOLATION)
def _denominator(exponent: int) -> str:
    return f"/{fmpz(1) << exponent}" if exponent else ""


def parameter_cells(h: fmpz_poly, roots: Sequence[RealRoot]) -> tuple[list[Cell], int]:
    """The isolating intervals on the coarsest grid from 2^-32 on where each holds one root only, and its exponent."""
    for exponent in range(PARAMETER_EXPONENT, MAX_ISOLATION + 1):
        cells = [root.cell(exponent) for root in roots]
        if len(set(cells)) == len(cells) and all(map(partial(_holds_one_root, h, exponent), cells, roots)):
            return cells, exponent
    raise too_large(f"real poses: the roots are not told apart by a grid of 2^-{MAX_ISOLATION}")


def _holds_one_root(h: fmpz_poly, exponent: int, cell: Cell, root: RealRoot) -> bool:
    """Whether h is 0 at the only point of a root's cell, or changes its sign between its ends."""
    low, high = (fmpq(end, fmpz(1) << exponent) for end in cell)
    if low == high:
        return value_at(h, low, ()) == 0
    if root.is_known_to_change(low, high):
        return True
    first, last = signs_at(h, [low, high])
    return first * last < 0


def box_cells(enclose: Callable[[int], list[list[arb]] | None], exponent: int, size: int = 16) -> list[list[Cell]]:
    """For each real pose the cells of its 16 ordinary coordinates, or of another number, on the grid 2^-exponent.

    ``enclose`` gives enclosures at a precision, or None if it does not suffice.
    """
    precision = first = exponent + FIRST_BITS
    doublings = 0
    fine = arb(fmpq(1, fmpz(1) << exponent + ENCLOSED))
    while precision <= MAX_PRECISION:
        values = enclose(precision)
        charge(size * len(values or ()) * (20000 + 200 * limbs(precision)))
        if values is not None and all(value.is_finite() and value.rad() < fine for row in values for value in row):
            boxes = [[_coordinate_cell(value, exponent, doublings >= DOUBLINGS) for value in row] for row in values]
            decided = [[cell for cell in box if cell is not None] for box in boxes]
            if decided == boxes:
                return decided
            doublings += precision > first
        precision = 2 * precision if precision > first else exponent + 2 * FIRST_BITS
    raise too_large(f"boxes: a coordinate is not decided by {MAX_PRECISION} bits")


def _enclosed(representation: Representation, precision: int) -> list[arb_poly]:
    """h', E and F, their coefficients enclosed."""
    numerators = (*representation.quaternion, *representation.translation)
    words = max(limbs(int(value.height_bits())) for value in (representation.eliminant, *numerators))
    charge(9 * int(representation.eliminant.length()) * (100 + 3 * words))
    with ctx.workprec(precision):
        return [arb_poly(value) for value in (representation.eliminant.derivative(), *numerators)]


def _at_root(polynomials: Sequence[arb_poly], metric: Metric, root: arb, precision: int) -> list[arb]:
    """The ordinary coordinates at an enclosed root, by h', E and F."""
    charge(9 * len(polynomials[0]) * ball_cost(limbs(precision)))
    with ctx.workprec(precision):
        slope, *values = (polynomial(root) for polynomial in polynomials)
        x = [value / slope for value in values]
    return ordinary_coordinates(x[:4], x[4:], metric, precision)


def ordinary_coordinates(e: Sequence[arb], f: Sequence[arb], metric: Metric, precision: int) -> list[arb]:
    """Position, rotation matrix by rows and unit quaternion (its sign that of e with w.e = 1) of a real (e, f)."""
    charge(300 * ball_cost(limbs(precision) + limbs(max(metric).bit_length())))
    with ctx.workprec(precision):
        placed = motion(e, f, metric)
        axes = [arb(g).sqrt() for g in metric]
        length = placed.norm.sqrt()
        position = [axis * value / placed.norm for axis, value in zip(axes, placed.position, strict=True)]
        rotation = [axes[i] * placed.rotation[i][j] / (axes[j] * placed.norm) for i in range(3) for j in range(3)]
        scalar = axes[0] * axes[1] * axes[2] * e[0] / length
        return [*position, *rotation, scalar, *(axis * value / length for axis, value in zip(axes, e[1:], strict=True))]


def _coordinate_cell(value: arb, exponent: int, late: bool) -> Cell | None:
    """The cell around a finely enclosed value, two cells if it is near a grid point; None if not decided yet."""
    mantissa, power = value.mid().man_exp()
    shift = int(power) + exponent + 2 * NEAR
    units = mantissa << shift if shift >= 0 else mantissa >> -shift  # of 2^-64 cells, as many as are whole
    cell, part = units >> 2 * NEAR, int(units & _ONE - 1)
    if _FAR <= part < _ONE - _FAR:  # the radius is less than 2^-40 cells
        return cell, cell + 1
    if part < _CLOSE:
        return cell - 1, cell + 1
    if part >= _ONE - _CLOSE:
        return cell, cell + 2
    middle, radius = (fmpq(*dyadic(part, exponent)) for part in (value.mid(), value.rad()))
    nearest = (middle + fmpq(1, 2)).floor()
    distance, limit = abs(middle - nearest), fmpq(1, fmpz(1) << NEAR)
    if distance + radius < limit or (late and distance - radius <= limit):
        return nearest - 1, nearest + 1
    if distance - radius > limit:
        return middle.floor(), middle.floor() + 1
    return None
