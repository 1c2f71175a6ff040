"""Tolerance certificates: boxes that hold exactly one pose of every robot within tolerance, replayed from the file.

What is believed of the file: the robot, its lengths and its tolerances, for these are the question. Frames, centres and
radii are where to look; everything that they should prove is computed. See ``docs/tolerances.md``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Any, Final

from flint import acb, acb_mat, arb, ctx

from pkm_exact.certify.checker.budget import ball_cost, charge, limbs
from pkm_exact.certify.checker.parametric import (
    SHRINKINGS,
    Expansion,
    Robot,
    ball,
    box_around,
    changes_of_pose,
    components,
    expand,
    greatest_length,
    holds_a_solution,
    holds_at_most_one,
    is_contraction,
    is_regular,
    is_within,
    points_of_box,
    robot_of,
    slopes,
    values,
)
from pkm_exact.certify.checker.tolerance_document import DEGREES, Place, PoseBox, ToleranceDocument
from pkm_exact.certify.checker.verdict import rejected

GUARD_BITS: Final = 128
"""Bits beyond those of the grid, and beyond half as many: no more are lost, as Y is at most 2^(k/2) by the core."""
_PRODUCTS: Final = 30000
"""More than the products of balls for one solution."""
_SHRUNK: Final = 10000
"""More than those for a narrower box that holds the same solutions."""
NEAREST: Final = arb(1) / 2 + arb(2) ** -20
"""A centre is no farther from the nominal solution than this, in units of the grid."""


def check_tolerances(document: ToleranceDocument) -> Iterator[str]:
    """One line per claim that is proved."""
    labels, others = [box.pose for box in document.boxes], list(document.unproved)
    numbers = list(range(1, len(labels) + len(others) + 1))
    if sorted([*labels, *others]) != numbers or labels != sorted(labels) or others != sorted(others):
        raise rejected("boxes: poses are not numbered from 1, each once, in order")
    with ctx.workprec(document.exponent + document.exponent // 2 + GUARD_BITS + 2 * _bits_of_integers(document)):
        robot = robot_of(document.legs, document.metric, document.origins, document.unit, document.tolerances)
        cores = []
        for box in document.boxes:
            expansion = _expansion(robot, document, box.place, f"box of pose {box.pose}")
            _check_box(expansion, document, box)
            cores.append(_core(expansion, document))
        for (one, left), (other, right) in combinations(zip(document.boxes, cores, strict=True), 2):
            if not _are_distinct(left, right):
                raise rejected(f"boxes: the poses {one.pose} and {other.pose} are not proved distinct")
        yield (
            f"boxes: {len(cores)} poses, in the box of each there is exactly one pose of every robot within tolerance, "
            "its errors are not greater than claimed"
        )
        if document.unproved:
            yield f"boxes: for {len(document.unproved)} poses nothing is claimed"
        yield from _completeness(robot, document, cores)


def _bits_of_integers(document: ToleranceDocument) -> int:
    """Before the point, of the longest coordinate of a centre: balls have so many more, and products twice as many."""
    places = [*(box.place for box in document.boxes), *document.pairs]
    longest = max((abs(part).bit_length() for place in places for pair in place.centre for part in pair), default=0)
    return max(longest - document.exponent, 0)


def _expansion(robot: Robot, document: ToleranceDocument, place: Place, name: str) -> Expansion:
    """The equations around a centre, if the nominal robot has exactly one solution in its core."""
    planar = robot.planar
    numbers = (*place.outer, *(part for pair in place.centre for part in pair))
    charge(_PRODUCTS * ball_cost(limbs(ctx.prec + max(abs(number).bit_length() for number in numbers))))
    chart = [place.chart[0], place.chart[3]] if planar else place.chart
    centre = acb_mat(len(place.centre), 1, [acb(_on_grid(a, document), _on_grid(b, document)) for a, b in place.centre])
    expansion = expand(robot, [acb(*pair) for pair in chart], centre)
    if expansion is None:
        raise rejected(f"{name}: the Jacobian at its centre seems singular")
    return expansion


def _on_grid(number: int, document: ToleranceDocument) -> arb:
    with ctx.workprec(max(ctx.prec, number.bit_length() + 1)):
        return arb(number) * arb(2) ** -document.exponent


def _core_radius(document: ToleranceDocument) -> int:
    """Half the width of the box in which the nominal solution is proved, in units of the grid."""
    return 1 << (document.exponent - document.exponent // 2)


def _core(expansion: Expansion, document: ToleranceDocument) -> list[acb]:
    """The quantities of the nominal solution over N(e), in the new frames: functions of the pose."""
    real = _is_real(expansion)
    radii = [_on_grid(_core_radius(document), document)] * expansion.centre.nrows()
    x = expansion.centre + box_around(radii, real=real)
    at = values(slopes(x, planar=expansion.robot.planar), x)
    return [value / at[0] for value in at]


def _are_distinct(left: Sequence[acb], right: Sequence[acb]) -> bool:
    return any(not a.overlaps(b) for a, b in zip(left, right, strict=True))


def _is_real(expansion: Expansion) -> bool:
    return all(v.imag == 0 for v in (*expansion.centre.entries(), *expansion.weights))


def _check_place(expansion: Expansion, document: ToleranceDocument, place: Place, name: str) -> None:
    """At most one solution of every robot in the box, and the nominal one in its core, which lies in the box."""
    real = _is_real(expansion)
    core = _core_radius(document)
    if min(place.outer) < core:
        raise rejected(f"{name}: smaller than the core of the nominal solution")
    outer = [_on_grid(r, document) for r in place.outer]
    cores = [_on_grid(core, document)] * len(outer)
    if not is_contraction(expansion, cores, real=real):
        raise rejected(f"{name}: not proved to hold a solution of the nominal robot")
    if not is_within(expansion, cores, NEAREST * _on_grid(1, document), real=real):
        raise rejected(f"{name}: its centre is not the grid point nearest to the nominal solution")
    if is_regular(expansion, outer, real=real):
        return
    charge(SHRINKINGS * _SHRUNK * ball_cost(limbs(ctx.prec)))
    if not holds_at_most_one(expansion, outer, real=real):
        raise rejected(f"{name}: not proved to hold at most one solution of every robot within tolerance")


def _check_box(expansion: Expansion, document: ToleranceDocument, box: PoseBox) -> None:
    name = f"box of pose {box.pose}"
    if not _is_real(expansion):
        raise rejected(f"{name}: not real")
    _check_place(expansion, document, box.place, name)
    inner = [_on_grid(r, document) for r in box.inner]
    if any(a > b for a, b in zip(box.inner, box.place.outer, strict=True)):
        raise rejected(f"{name}: the inner box is not contained in the outer one")
    if not holds_a_solution(expansion, inner, real=True):
        raise rejected(f"{name}: the inner box is not proved to hold a solution of every robot within tolerance")
    changes = changes_of_pose(expansion, inner)
    if changes is None:
        raise rejected(f"{name}: the Jacobian is not proved regular in it")
    effect, offset = changes
    bounds = [change.real.abs_upper() for change in expansion.changes]
    at_centre = components(expansion.robot, expansion.centre)[0]
    for k, (value, (low, high)) in enumerate(zip(at_centre, box.components, strict=True)):
        reach = sum((effect[k, i].abs_upper() * b for i, b in enumerate(bounds)), offset[k, 0].abs_upper())
        if not (value - reach >= ball(low) and value + reach <= ball(high)):
            raise rejected(f"{name}: a bound of the pose is not proved")
    _check_contained(expansion, box, [_on_grid(r, document) for r in box.place.outer], name)
    _check_errors(box, effect, offset, bounds, name)


def _check_contained(expansion: Expansion, box: PoseBox, outer: Sequence[arb], name: str) -> None:
    """All poses with these bounds of centroid and quaternion lie in the outer box: there is only one."""
    sides = [ball(low).union(ball(high)) for low, high in box.components]
    points = points_of_box(expansion.robot, expansion.weights, sides[16:], sides[12:16])
    for point, centre, radius in zip(points, expansion.centre.entries(), outer, strict=True):
        if not abs(point.real - centre.real) <= radius:
            raise rejected(f"{name}: the bounds of the pose reach beyond the outer box")


def _check_errors(box: PoseBox, effect: Any, offset: Any, bounds: Sequence[arb], name: str) -> None:
    """Distance and angle from the nominal pose: that at the centre, but for an offset that counts twice."""
    for places, claimed, is_angle in (
        ((0, 1, 2), box.position_error, False),
        ((12, 13, 14, 15), box.rotation_error, True),
    ):
        length = greatest_length(effect, bounds, places)
        length += sum((2 * offset[k, 0].abs_upper() for k in places), arb(0))
        if is_angle:
            length = 4 * (length / 2).asin()  # a chord 2 sin(angle / 4) of unit quaternions; not a number if above 2
        if not length <= ball(claimed):
            raise rejected(f"{name}: its {'rotation' if is_angle else 'position'} error is not proved")


def _completeness(robot: Robot, document: ToleranceDocument, cores: list[list[acb]]) -> Iterator[str]:
    if not document.complete:
        if document.pairs:
            raise rejected("pairs: listed, though completeness is not claimed")
        yield "not proven complete: further poses of robots within tolerance are not excluded"
        return
    if document.unproved:
        raise rejected("complete: claimed, though poses are not proved")
    if list(document.pairs) != sorted(document.pairs, key=lambda place: (place.chart, place.centre)):
        raise rejected("pairs: not listed in their order")
    for number, place in enumerate(document.pairs, 1):
        name = f"pair {number}"
        expansion = _expansion(robot, document, place, name)
        _check_place(expansion, document, place, name)
        if not holds_a_solution(expansion, [_on_grid(r, document) for r in place.outer], real=_is_real(expansion)):
            raise rejected(f"{name}: not proved to hold a solution of every robot within tolerance")
        core = _core(expansion, document)
        cores += [core, [value.conjugate() for value in core]]
    degree = DEGREES[robot.planar]
    if len(cores) != degree:
        raise rejected(f"complete: claimed, but {len(cores)} of {degree} solutions are proved")
    if not all(_are_distinct(left, right) for left, right in combinations(cores, 2)):
        raise rejected("complete: claimed, but two nominal solutions are not proved distinct")
    yield (
        f"complete: {degree} solutions of every robot within tolerance, isolated and distinct, are the degree of the "
        f"motions; {len(document.boxes)} of them are real, there is no other pose"
    )
