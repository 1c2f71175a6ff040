"""The real solutions of a system: their number, isolating intervals of the parameter, boxes, all computed anew."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from flint import arb, ctx

from pkm_exact.certify.checker.budget import ball_cost, charge, limbs
from pkm_exact.certify.checker.descartes import RealRoot
from pkm_exact.certify.checker.document import ListedPose
from pkm_exact.certify.checker.listed_roots import roots_by_intervals
from pkm_exact.certify.checker.realposes import Cell, box_cells, cell_ends, parameter_cells
from pkm_exact.certify.checker.solutions import primitive_part
from pkm_exact.certify.checker.system_document import Points
from pkm_exact.certify.checker.verdict import rejected


def check_real_solutions(points: Points, exponent: int, solutions: Sequence[ListedPose]) -> Iterator[str]:
    """The solutions listed are all the real ones, each with the intervals that it must have, no two in the same box."""
    h = primitive_part(points.eliminant)
    roots = roots_by_intervals(h, [solution.parameter for solution in solutions if solution.parameter is not None])
    cells, fineness = parameter_cells(h, roots)
    if len(solutions) != len(cells):
        raise rejected(f"real solutions: {len(solutions)} listed, the eliminant has {len(cells)} real roots")

    def enclose(precision: int) -> list[list[arb]]:
        return [_at_root(points, root, precision) for root in roots]

    boxes = box_cells(enclose, exponent, len(points.numerators))
    charge(2000 * len(boxes) ** 2 * len(points.numerators))
    order = sorted(range(len(boxes)), key=lambda index: [(int(low), int(high)) for low, high in boxes[index]])
    for number, (solution, root) in enumerate(zip(solutions, order, strict=True), 1):
        if solution.parameter != cell_ends(*cells[root], fineness):
            raise rejected(
                f"real solutions: number {number} does not have the isolating interval of real root {root + 1}"
            )
    yield f"real solutions: {len(solutions)}, one for each real root of the eliminant"
    yield from _check_boxes([boxes[root] for root in order], exponent, solutions)


def _check_boxes(boxes: Sequence[Sequence[Cell]], exponent: int, solutions: Sequence[ListedPose]) -> Iterator[str]:
    words = limbs(max((int(abs(end).bit_length()) for box in boxes for cell in box for end in cell), default=0))
    size = len(boxes[0]) if boxes else 0
    charge(len(boxes) * size * 2 * (10000 + words * (2000 + 10 * words)))
    for number, (solution, box) in enumerate(zip(solutions, boxes, strict=True), 1):
        if solution.box != tuple(cell_ends(low, high, exponent) for low, high in box):
            raise rejected(f"boxes: the box of solution {number} is not that of its values")
    yield f"boxes: all {size * len(solutions)} intervals are those of the values, on the grid 2^-{exponent}"
    for (i, one), (j, other) in combinations(enumerate(boxes, 1), 2):
        if not any(a[1] < b[0] or b[1] < a[0] for a, b in zip(one, other, strict=True)):
            raise rejected(f"boxes: those of solutions {i} and {j} are not disjoint")
    yield "boxes: pairwise disjoint"


def _at_root(points: Points, root: RealRoot, precision: int) -> list[arb]:
    """The values at a root."""
    place = root.ball(precision)
    words = max(limbs(int(value.height_bits())) for value in (points.eliminant, *points.numerators))
    charge((len(points.numerators) + 1) * int(points.eliminant.length()) * (ball_cost(limbs(precision)) + 3 * words))
    with ctx.workprec(precision):
        slope = points.eliminant.derivative()(place)
        return [numerator(place) / slope for numerator in points.numerators]
