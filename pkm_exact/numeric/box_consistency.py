"""Do boxes of single solutions lie apart, and on the robot? What proves them is not repeated here."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from flint import acb, acb_mat, arb, fmpz_mat

from pkm_exact.failures.contradiction import require
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import Quadric, pose_quadrics
from pkm_exact.numeric.certified_boxes import GUARD_BITS
from pkm_exact.numeric.double_rounding import gamma
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
        is_apart = any(abs(imaginary) > RADIUS for _, imaginary in box.centre)
        require(is_apart, "a box of a complex solution meets its conjugate", box=number)
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
    combination = _combination(pose_quadrics(problem))
    decided = _have_room(boxes, chart, combination)
    rest = [place for place, has_room in enumerate(decided) if not has_room]
    if rest:
        _require_room_in_balls([boxes[place] for place in rest], chart, combination)


def _have_room(boxes: Sequence[Box], chart: Sequence[int], combination: list[list[int]]) -> list[bool]:
    """Where doubles tell that both can be satisfied, with what is lost by rounding.

    A term of x^T M x has three factors, and data that are rounded: it is off by at most gamma(80) of itself in all, and
    complex numbers count by the sum of their parts.
    """
    try:
        matrix = np.array(combination, dtype=np.float64)
        numbers = np.array([box.centre for box in boxes], dtype=np.float64)
    except OverflowError:
        return [False] * len(boxes)
    units = np.ldexp(1.0, -np.array([box.exponents for box in boxes])).repeat(4, axis=1)
    is_real = np.array([box.is_real for box in boxes])[:, None]
    x, radii = (numbers[..., 0] + 1j * numbers[..., 1]) * units, RADIUS * units
    parts = np.where(is_real, 1, 2)
    with np.errstate(all="ignore"):
        gradients, sizes = x @ matrix, np.abs(x.real) + np.abs(x.imag)
        slopes = np.abs(gradients.real) + np.abs(gradients.imag)
        around = np.abs(matrix)
        values = (x * gradients).sum(axis=1)
        room = ((2 * slopes + parts * (radii @ around)) * radii).sum(axis=1)
        lost = gamma(80) * ((sizes @ around) * (sizes + radii)).sum(axis=1)
        at = x[:, :4] @ np.array(chart) - 1
        beside = np.abs(np.array(chart)) @ radii[:, :4].T
        are_small = lost < room / 4
        also = gamma(80) * (1 + sizes[:, :4] @ np.abs(np.array(chart)))
        fits = (np.abs(values.real) + lost <= room) & (np.abs(values.imag) + lost <= room)
        fits &= (np.abs(at.real) + also <= beside) & (np.abs(at.imag) + also <= beside)
        is_exact = (np.abs(numbers) < 2.0**53).all(axis=(1, 2))
    found: list[bool] = (fits & are_small & is_exact).tolist()
    return found


def _require_room_in_balls(boxes: Sequence[Box], chart: Sequence[int], combination: list[list[int]]) -> None:
    with working_precision(2 * max(max(box.exponents) for box in boxes) + GUARD_BITS):
        points = [_balls(box) for box in boxes]
        gradients = (acb_mat(points) * acb_mat(fmpz_mat(combination))).tolist()
        for number, (x, gradient) in enumerate(zip(points, gradients, strict=True)):
            value = sum((a * b for a, b in zip(x[1:], gradient[1:], strict=True)), x[0] * gradient[0])
            require(value.contains(0), "a box has no room for a solution", box=number)
            total = sum((weight * value for weight, value in zip(chart, x[:4], strict=True) if weight), acb(0))
            require(total.contains(1), "a box is not in its chart", box=number)


def _combination(quadrics: Sequence[Quadric]) -> list[list[int]]:
    """The symmetric matrix of a combination of the forms, to which each contributes about as much."""
    sizes = [max(map(abs, quadric.values())) for quadric in quadrics]
    rows = [[0] * 8 for _ in range(8)]
    for weight, (quadric, size) in enumerate(zip(quadrics, sizes, strict=True), len(quadrics)):
        factor = weight * (1 + max(sizes) // size)
        for (k, m), coefficient in quadric.items():
            rows[k][m] += factor * coefficient
            rows[m][k] += factor * coefficient
    return rows


def _balls(box: Box) -> list[acb]:
    """The coordinates of the points of the box."""
    units = [arb(2) ** -exponent for exponent in box.exponents]
    if box.is_real:
        return [acb(arb(real, RADIUS)) * units[index // 4] for index, (real, _) in enumerate(box.centre)]
    return [
        acb(arb(real, RADIUS), arb(imaginary, RADIUS)) * units[index // 4]
        for index, (real, imaginary) in enumerate(box.centre)
    ]
