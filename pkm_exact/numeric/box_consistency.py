"""Do boxes of single solutions lie apart, and on the robot? What proves them is not repeated here."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from flint import fmpz_mat

from pkm_exact.failures.contradiction import require
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import Quadric, pose_quadrics
from pkm_exact.numeric.double_rounding import gamma
from pkm_exact.poses.isolated_solutions import RADIUS, Box

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
        _require_room_in_integers([boxes[place] for place in rest], chart, combination)


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


def _require_room_in_integers(boxes: Sequence[Box], chart: Sequence[int], combination: list[list[int]]) -> None:
    """The same exactly, in units of the finer of the two grids of each box."""
    shifts = [[max(box.exponents) - exponent for exponent in box.exponents for _ in range(4)] for box in boxes]
    pairs = list(zip(boxes, shifts, strict=True))
    # Real parts, imaginary parts, and radii.
    parts = [[[c[k] << s for c, s in zip(box.centre, shift, strict=True)] for box, shift in pairs] for k in (0, 1)]
    radii = [[RADIUS << s for s in shift] for shift in shifts]
    gradients = (fmpz_mat([*parts[0], *parts[1]]) * fmpz_mat(combination)).tolist()
    around = (fmpz_mat(radii) * fmpz_mat([[abs(value) for value in row] for row in combination])).tolist()
    for number, (box, a, b, r, p, q, wide) in enumerate(
        zip(boxes, *parts, radii, gradients[: len(boxes)], gradients[len(boxes) :], around, strict=True)
    ):
        times = 1 if box.is_real else 2
        room = sum(x * (2 * (abs(y) + abs(z)) + times * w) for x, y, z, w in zip(r, p, q, wide, strict=True))
        real = sum(w * x - y * z for w, x, y, z in zip(a, p, b, q, strict=True))
        imaginary = 2 * sum(x * y for x, y in zip(b, p, strict=True))
        has_room = abs(real) <= room and abs(imaginary) <= room
        require(has_room, "a box has no room for a solution", box=number)
        beside = sum(abs(weight) * x for weight, x in zip(chart, r[:4], strict=True))
        off = sum(weight * x for weight, x in zip(chart, a[:4], strict=True)) - (1 << max(box.exponents))
        turned = sum(weight * x for weight, x in zip(chart, b[:4], strict=True))
        require(abs(off) <= beside and abs(turned) <= beside, "a box is not in its chart", box=number)


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
