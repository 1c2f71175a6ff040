"""Do boxes of single solutions lie apart, and on the robot? What proves them is not repeated here."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain, islice
from operator import mul
from typing import TYPE_CHECKING

import numpy as np
from flint import fmpz_mat

from pkm_exact.failures.contradiction import require
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import Quadric, pose_quadrics
from pkm_exact.numeric.double_krawczyk import products
from pkm_exact.numeric.double_rounding import gamma
from pkm_exact.poses.isolated_solutions import RADIUS, Box

if TYPE_CHECKING:
    from pkm_exact.poses.isolated_solutions import IsolatedSolutions


def require_sound_boxes(
    isolated: IsolatedSolutions, problem: ForwardProblem, decided: Sequence[bool] | None = None
) -> None:
    """Real boxes are real, others meet no conjugate, no two meet, and in each the equations can be 0.

    Parameters
    ----------
    isolated : IsolatedSolutions
    problem : ForwardProblem
    decided : sequence of bool, optional
        What ``boxes_have_room`` says of real boxes and of the others, if it is known already.

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
        _require_room(boxes, isolated.chart, problem, decided)


def boxes_have_room(several: Sequence[tuple[IsolatedSolutions, ForwardProblem]]) -> list[list[bool]]:
    """In which boxes, real ones first, doubles tell that the equations can be 0: of many robots at once."""
    boxes = [(*isolated.real, *isolated.pairs) for isolated, _ in several]
    combinations = [_combination(pose_quadrics(problem)) for _, problem in several]
    return _have_room(boxes, [isolated.chart for isolated, _ in several], combinations)


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


def _require_room(
    boxes: Sequence[Box], chart: Sequence[int], problem: ForwardProblem, decided: Sequence[bool] | None = None
) -> None:
    """A combination of legs and Study's condition, and the chart, can be satisfied in every box."""
    combination = None
    if decided is None:
        combination = _combination(pose_quadrics(problem))
        (decided,) = _have_room([boxes], [chart], [combination])
    rest = [box for box, has_room in zip(boxes, decided, strict=True) if not has_room]
    if rest:
        _require_room_in_integers(rest, chart, combination or _combination(pose_quadrics(problem)))


def _have_room(
    several: Sequence[Sequence[Box]], charts: Sequence[Sequence[int]], combinations: Sequence[list[list[int]]]
) -> list[list[bool]]:
    """Where doubles tell that both can be satisfied, with what is lost by rounding: of each robot its boxes.

    A term of x^T M x has three factors, and data that are rounded: it is off by at most gamma(80) of itself in all, and
    complex numbers count by the sum of their parts.
    """
    counts = [len(boxes) for boxes in several]
    together = [box for boxes in several for box in boxes]
    if not together:
        return [[] for _ in several]
    each = np.arange(len(several)).repeat(counts)
    try:
        matrices = np.array(combinations, dtype=np.float64)[each]
        parts = chain.from_iterable(box.centre for box in together)
        numbers = np.fromiter(chain.from_iterable(parts), np.float64).reshape(-1, 8, 2)
    except OverflowError:
        return [[False] * count for count in counts]
    weights = np.array(charts, dtype=np.float64)[each]
    units = np.ldexp(1.0, -np.array([box.exponents for box in together])).repeat(4, axis=1)
    is_real = np.array([box.is_real for box in together])[:, None]
    x, radii = (numbers[..., 0] + 1j * numbers[..., 1]) * units, RADIUS * units
    times = np.where(is_real, 1, 2)
    with np.errstate(all="ignore"):
        gradients, sizes = products(matrices, x), np.abs(x.real) + np.abs(x.imag)
        slopes = np.abs(gradients.real) + np.abs(gradients.imag)
        around = np.abs(matrices)
        values = (x * gradients).sum(axis=1)
        room = ((2 * slopes + times * products(around, radii)) * radii).sum(axis=1)
        lost = gamma(80) * (products(around, sizes) * (sizes + radii)).sum(axis=1)
        at = (x[:, :4] * weights).sum(axis=1) - 1
        beside = (np.abs(weights) * radii[:, :4]).sum(axis=1)
        are_small = lost < room / 4
        also = gamma(80) * (1 + (sizes[:, :4] * np.abs(weights)).sum(axis=1))
        fits = (np.abs(values.real) + lost <= room) & (np.abs(values.imag) + lost <= room)
        fits &= (np.abs(at.real) + also <= beside) & (np.abs(at.imag) + also <= beside)
        is_exact = (np.abs(numbers) < 2.0**53).all(axis=(1, 2))
    found = iter((fits & are_small & is_exact).tolist())
    return [list(islice(found, count)) for count in counts]


def _require_room_in_integers(boxes: Sequence[Box], chart: Sequence[int], combination: list[list[int]]) -> None:
    """The same exactly, in units of the finer of the two grids of each box."""
    shifts = [[max(box.exponents) - exponent for exponent in box.exponents for _ in range(4)] for box in boxes]
    pairs = list(zip(boxes, shifts, strict=True))
    # Real parts, then imaginary parts, and radii.
    points = fmpz_mat(
        [[c[k] << s for c, s in zip(box.centre, shift, strict=True)] for k in (0, 1) for box, shift in pairs]
    )
    radii = fmpz_mat([[RADIUS << s for s in shift] for shift in shifts])
    gradients = (points * fmpz_mat(combination)).tolist()
    around = (radii * fmpz_mat([[abs(value) for value in row] for row in combination])).tolist()
    halves = slice(len(boxes)), slice(len(boxes), None)
    parts = (table[half] for table in (points.tolist(), gradients) for half in halves)
    rows = zip(boxes, *parts, radii.tolist(), around, strict=True)
    for number, (box, a, b, p, q, r, wide) in enumerate(rows):
        times = 1 if box.is_real else 2
        slopes = [2 * (abs(y) + abs(z)) + times * w for y, z, w in zip(p, q, wide, strict=True)]
        room = sum(map(mul, r, slopes))
        real, imaginary = sum(map(mul, a, p)) - sum(map(mul, b, q)), 2 * sum(map(mul, b, p))
        has_room = abs(real) <= room and abs(imaginary) <= room
        require(has_room, "a box has no room for a solution", box=number)
        beside = sum(map(mul, map(abs, chart), r[:4]))
        off, turned = sum(map(mul, chart, a[:4])) - (1 << max(box.exponents)), sum(map(mul, chart, b[:4]))
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
