"""Do boxes of single solutions lie apart, and on the robot? What proves them is not repeated here."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from flint import acb, acb_mat, arb, fmpz_mat

from pkm_exact.failures.contradiction import require
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import Quadric, pose_quadrics
from pkm_exact.numeric.certified_boxes import GUARD_BITS
from pkm_exact.poses.isolated_solutions import RADIUS, Box
from pkm_exact.precision import working_precision

if TYPE_CHECKING:
    from pkm_exact.poses.isolated_solutions import IsolatedSolutions


def require_sound_boxes(isolated: IsolatedSolutions, problem: ForwardProblem) -> None:
    """Real boxes are real, others meet no conjugate, no two meet, and in each the equations can be 0.

    Raises
    ------
    InternalContradictionError
    """
    require(all(box.is_real for box in isolated.real), "a box of a real solution is not real")
    for number, box in enumerate(isolated.pairs):
        require(box.is_disjoint(box.conjugate()), "a box of a complex solution meets its conjugate", box=number)
    boxes = (*isolated.real, *isolated.pairs)
    _require_apart(boxes)
    if boxes:
        _require_room(boxes, isolated.chart, problem)


def _require_apart(boxes: Sequence[Box]) -> None:
    """No box meets another or its conjugate: in the order of the real part of e0, which conjugates share."""
    finest = max((box.exponents[0] for box in boxes), default=0)
    listed = sorted((_reach(box, finest), place) for place, box in enumerate(boxes))
    for place, ((_, high), first) in enumerate(listed):
        for (low, _), second in listed[place + 1 :]:
            if low > high:
                break
            apart = boxes[first].is_disjoint(boxes[second]) and boxes[first].is_disjoint(boxes[second].conjugate())
            require(apart, "the boxes of two solutions meet", first=first, second=second)


def _reach(box: Box, finest: int) -> tuple[int, int]:
    """The ends of the box in the real part of e0, in units of the finest grid."""
    middle, shift = box.centre[0][0], finest - box.exponents[0]
    return (middle - RADIUS) << shift, (middle + RADIUS) << shift


def _require_room(boxes: Sequence[Box], chart: Sequence[int], problem: ForwardProblem) -> None:
    """A combination of legs and Study's condition, and the chart, can be satisfied in every box."""
    with working_precision(2 * max(max(box.exponents) for box in boxes) + GUARD_BITS):
        points = [_balls(box) for box in boxes]
        gradients = (acb_mat(points) * _combination(pose_quadrics(problem))).tolist()
        for number, (x, gradient) in enumerate(zip(points, gradients, strict=True)):
            value = sum((a * b for a, b in zip(x[1:], gradient[1:], strict=True)), x[0] * gradient[0])
            require(value.contains(0), "a box has no room for a solution", box=number)
            total = sum((weight * value for weight, value in zip(chart, x[:4], strict=True) if weight), acb(0))
            require(total.contains(1), "a box is not in its chart", box=number)


def _combination(quadrics: Sequence[Quadric]) -> acb_mat:
    """The symmetric matrix of a combination of the forms, to which each contributes about as much."""
    sizes = [max(map(abs, quadric.values())) for quadric in quadrics]
    rows = [[0] * 8 for _ in range(8)]
    for weight, (quadric, size) in enumerate(zip(quadrics, sizes, strict=True), len(quadrics)):
        factor = weight * (1 + max(sizes) // size)
        for (k, m), coefficient in quadric.items():
            rows[k][m] += factor * coefficient
            rows[m][k] += factor * coefficient
    return acb_mat(fmpz_mat(rows))


def _balls(box: Box) -> list[acb]:
    """The coordinates of the points of the box."""
    units = [arb(2) ** -exponent for exponent in box.exponents]
    if box.is_real:
        return [acb(arb(real, RADIUS)) * units[index // 4] for index, (real, _) in enumerate(box.centre)]
    return [
        acb(arb(real, RADIUS), arb(imaginary, RADIUS)) * units[index // 4]
        for index, (real, imaginary) in enumerate(box.centre)
    ]
