"""Between which values of a number of the model the answer to a question about all of a region changes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.errors import InputError
from pkm_exact.regions.region_solver import RegionAnswer


@dataclass(frozen=True)
class Threshold:
    """Two values of a parameter, and the answers there.

    Nothing is said of other values: between these two the answer changes at least once.

    Attributes
    ----------
    low, high : Fraction
    answers : tuple of 2 RegionAnswer
        One is yes, proved, and the other no, with a counterexample.
    is_precise : bool
        Whether the values are as near as asked for.
    """

    low: Fraction
    high: Fraction
    answers: tuple[RegionAnswer, RegionAnswer]
    is_precise: bool

    @property
    def proved(self) -> RegionAnswer:
        """The answer that is yes."""
        return self.answers[0] if self.answers[0].is_proved else self.answers[1]


def threshold(
    ask: Callable[[Fraction], RegionAnswer],
    between: tuple[Fraction, ...],
    precision: Fraction,
    *,
    progress: Callable[[Fraction, RegionAnswer], None] | None = None,
) -> Threshold:
    """The interval in which the answer changes, bisected.

    Parameters
    ----------
    ask : callable
        The answer at a value.
    between : tuple of 2 Fraction
        The values to begin with.
    precision : Fraction
        Relative.

    Raises
    ------
    InputError
        If the answers at both ends are the same, or one is undecided.
    """

    def asked(value: Fraction) -> RegionAnswer:
        answer = ask(value)
        if progress is not None:
            progress(value, answer)
        return answer

    ends = list(between)
    answers = [asked(value) for value in ends]
    for value, answer in zip(ends, answers, strict=True):
        if not _is_decided(answer):
            raise InputError(
                f"answer.between: at {value} the answer is undecided; raise answer.steps, or give another value"
            )
    if answers[0].is_proved is answers[1].is_proved:
        word = "yes" if answers[0].is_proved else "no"
        raise InputError(f"answer.between: the answer is {word} at both ends; give values between which it changes")
    while ends[1] - ends[0] > precision * max(map(abs, ends)):
        middle = (ends[0] + ends[1]) / 2
        answer = asked(middle)
        if not _is_decided(answer):
            return Threshold(ends[0], ends[1], (answers[0], answers[1]), is_precise=False)
        side = 0 if answer.is_proved is answers[0].is_proved else 1
        ends[side], answers[side] = middle, answer
    return Threshold(ends[0], ends[1], (answers[0], answers[1]), is_precise=True)


def _is_decided(answer: RegionAnswer) -> bool:
    return answer.is_proved or answer.counterexample is not None
