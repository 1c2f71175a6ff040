"""Boxes on grids, of which Krawczyk's operator proves that they hold exactly one solution of the exact equations each.

Two exponents per box keep e and f each on a grid of its own size.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from flint import acb, acb_mat, arb, arb_mat

from pkm_exact.balls import Balls, box_around_zero
from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.krawczyk_operator import is_inside, krawczyk
from pkm_exact.poses.isolated_solutions import RADIUS, ROOM, Box
from pkm_exact.precision import working_precision

GUARD_BITS: Final = 64
"""A box on the grid 2^-k is tested with 2 k + 64 bits: enough unless the matrix is too ill-conditioned for it."""


def certified(system: ChartSystem, boxes: Sequence[Box]) -> list[bool]:
    """For each box whether Krawczyk's operator proves that it holds exactly one solution, and that N(e) is not 0 there.

    "No" means only that the proof fails with this box.
    """
    if not boxes:
        return []
    with working_precision(2 * max(max(box.exponents) for box in boxes) + GUARD_BITS):
        return [_is_proved(system, box) for box in boxes]


def _is_proved(system: ChartSystem, box: Box) -> bool:
    near = system.around(centre(system, box))
    if near is None:
        return False
    around = _moved_to_zero(system, box)
    radii = [reach / ROOM for reach in reaches(system, box)]
    return is_inside(near, krawczyk(near, around), radii) and is_motion(system, near.point + ROOM * around)


def centre(system: ChartSystem, box: Box) -> Balls:
    """The centre as a column, real if the box is, exact if the precision suffices."""
    units = [arb(2) ** -exponent for exponent in box.exponents]
    parts = [(units[index // 4], *box.centre[index]) for index in system.support]
    if box.is_real:
        return arb_mat(system.size, 1, [unit * real for unit, real, _ in parts])
    return acb_mat(system.size, 1, [acb(unit * real, unit * imaginary) for unit, real, imaginary in parts])


def enclosing_balls(system: ChartSystem, box: Box) -> Balls:
    """The box as a column of balls, which may be a little larger."""
    return centre(system, box) + _moved_to_zero(system, box)


def _moved_to_zero(system: ChartSystem, box: Box) -> Balls:
    return box_around_zero(reaches(system, box), arb_mat if box.is_real else acb_mat, real=box.is_real)


def reaches(system: ChartSystem, box: Box) -> list[arb]:
    """Half the widths of the box, exactly."""
    reaches = [RADIUS * arb(2) ** -exponent for exponent in box.exponents]
    return [reaches[index // 4] for index in system.support]


def is_motion(system: ChartSystem, around: Balls) -> bool:
    """Whether N(e) is not 0 anywhere in a column of balls."""
    metric = system.problem.metric
    norm: arb | acb = arb(0)
    for entry, index in zip(around.entries(), system.support, strict=True):
        if index < 4:
            norm += (metric[0] * metric[1] * metric[2] if index == 0 else metric[index - 1]) * entry * entry
    return not norm.contains(0)
