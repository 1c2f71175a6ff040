"""The largest cube or ball about a position all of whose poses are good, and the distance of singular poses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from pkm_exact.regions.region_legs import OnHinge, OwnLength, RegionMachine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.regions.region_solver import IN_THIS_PROCESS, RegionAnswer, Run, answered
from pkm_exact.roots.interval import Interval

_ENLARGED: Final = Fraction(1, 2**40)
"""Of the size of a region, by less than which it is enlarged."""


@dataclass(frozen=True)
class LargestAnswer:
    """The largest cube or ball that is proved, and the smallest size that is not.

    Attributes
    ----------
    proved : RegionAnswer or None
        Of the largest size for which all is proved; None if no size was.
    size : Fraction
        Its edge or radius; 0 if none was.
    refused : RegionAnswer or None
        Of the smallest size that was not proved; None if all were.
    refused_size : Fraction or None
    """

    proved: RegionAnswer | None
    size: Fraction
    refused: RegionAnswer | None
    refused_size: Fraction | None

    @property
    def distance(self) -> Interval | None:
        """How far from the middle the nearest singular pose of this orientation is.

        None if that was not asked, of a ball with ``no_type_2`` alone at a fixed orientation, or no ball is refuted.
        """
        if self.refused is None or self.refused_size is None or self.refused.counterexample is None:
            return None
        question, machine = self.refused.question, self.refused.machine
        is_straight = all(isinstance(leg.actuator, OwnLength | OnHinge) for leg in machine.legs)
        is_plain = question.conditions.names == ("no_type_2",) and question.chart.has_fixed_orientation
        if question.answer.shape != "ball" or not (is_straight and is_plain):
            return None
        size = max(map(abs, question.answer.about), default=Fraction(0)) + self.refused_size
        return Interval(self.size, self.refused_size + (size * _ENLARGED if question.enlarged else 0))


def largest(
    machine: RegionMachine,
    question: RegionQuestion,
    resized: Callable[[Fraction], RegionQuestion],
    *,
    run: Run = IN_THIS_PROCESS,
    progress: Callable[[Fraction, bool], None] | None = None,
) -> LargestAnswer:
    """The largest cube or ball about a pose for which all is proved, to the precision of the question.

    Parameters
    ----------
    machine : RegionMachine
    question : RegionQuestion
    resized : callable
        The question of another size.
    run : Run
    progress : callable, optional
        Gets each size and whether it was proved.
    """
    proved: RegionAnswer | None = None
    refused: RegionAnswer | None = None
    low, high = Fraction(0), None
    size = _first_size(machine)
    for _ in range(200):
        answer = answered(machine, resized(size), run=run)
        if progress is not None:
            progress(size, answer.is_proved)
        if answer.is_proved:
            proved, low = answer, size
        else:
            refused, high = answer, size
        if high is None:
            size = 2 * low
        elif low == 0:
            size = high / 2
        elif high - low <= question.answer.precision * low:
            break
        else:
            size = _between(low, high)
        if size > _first_size(machine) * 2**12 or size < _first_size(machine) / 2**40:
            break
    return LargestAnswer(proved, low, refused, high)


def _between(low: Fraction, high: Fraction) -> Fraction:
    """The middle, with few bits."""
    middle, gap = (low + high) / 2, high - low
    grid = 1
    while grid * gap < 16:
        grid *= 2
    rounded = Fraction(round(middle * grid), grid)
    return rounded if low < rounded < high else middle


def _first_size(machine: RegionMachine) -> Fraction:
    """A power of two near the size of the robot."""
    size = max([abs(x) for leg in machine.legs for x in (*leg.base, *leg.platform)] + [Fraction(0)]) or Fraction(1)
    found = Fraction(1)
    while found > size:
        found /= 2
    while 2 * found <= size:
        found *= 2
    return found
