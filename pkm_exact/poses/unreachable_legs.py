"""Why a legged robot has no pose, where single legs or pairs of them already say so, and what was perhaps meant.

Two legs, the line between their base joints (b) and that between their platform joints (p) close a quadrilateral: it
exists only if no side is longer than the other three together. That gives a range for each leg from each other one.
It is necessary, not sufficient: where it holds nothing is said.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations
from math import isqrt
from typing import TYPE_CHECKING, Final

from pkm_exact.geometry.length_units import METRES
from pkm_exact.poses.other_units import factors_of, times
from pkm_exact.wording import with_unit

if TYPE_CHECKING:
    from pkm_exact.constraints.form import Vector
    from pkm_exact.geometry.problem import ForwardProblem

_BITS: Final = 80

_Ends = tuple[Fraction, Fraction]


def unreachable_notes(problem: ForwardProblem, unit: str, *, are_given: bool = True) -> tuple[str, ...]:
    """What is wrong with the lengths of a robot all of whose constraints are legs; nothing where that does not tell.

    Parameters
    ----------
    problem : ForwardProblem
    unit : str
        Of the lengths.
    are_given : bool
        Whether they are the actuated lengths of legs, which can be wrong; else they are those of the model's rods, and
        cranks or slides put their lower ends where they are.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
    >>> for note in unreachable_notes(robot.problem_at([Fraction(7), Fraction(5), Fraction(50)]), "mm"):
    ...     print(note)
    no pose: leg 3 is 50 mm long, but with the others as they are it could be at most 20.03 mm long
    """
    if not problem.has_only_distances or len(problem.distances) < 2:
        return ()
    lengths = [_root(leg.length_squared) for leg in problem.distances]
    sides = _sides(problem)
    if _fits(lengths, sides):
        return ()
    if not are_given:
        return (_worst(lengths, sides, unit, "rod"),)
    notes = [_worst(lengths, sides, unit)]
    fitting = [
        pair for pair in factors_of(unit) if _fits([(low * pair[0], high * pair[0]) for low, high in lengths], sides)
    ]
    if fitting:
        names = " or ".join(name for _, name in fitting)
        asked = f": are they in {names}, and not in {unit}, as in the model?" if unit in METRES else ""
        named = " or ".join(times(factor) for factor, _ in fitting)
        return (*notes, f"lengths {named} times these would not contradict each other{asked}")
    exchanged = [pair for pair in combinations(range(len(lengths)), 2) if _fits(_exchanged(lengths, pair), sides)]
    if exchanged:
        named = ", or ".join(f"{i + 1} and {j + 1}" for i, j in exchanged[:3])
        notes.append(f"with the lengths of legs {named} exchanged they would not contradict each other")
    return tuple(notes)


def _worst(
    lengths: Sequence[_Ends], sides: dict[tuple[int, int], tuple[_Ends, _Ends]], unit: str, what: str = "leg"
) -> str:
    """The leg that most others exclude, and the range that they leave."""
    count = len(lengths)
    against = [sum(not _closes(lengths, sides, i, j) for j in range(count) if j != i) for i in range(count)]
    leg = max(range(count), key=lambda i: (against[i], -i))
    ranges = [_range(lengths[j], sides[min(leg, j), max(leg, j)]) for j in range(count) if j != leg]
    low, high = max(low for low, _ in ranges), min(high for _, high in ranges)
    at = "" if what == "leg" else "at these joint values "
    text = f"no pose: {what} {leg + 1} is {_about(lengths[leg][0], unit)} long, but {at}with the others as they are it"
    if low > high:
        return f"no pose: {at}no length of {what} {leg + 1} fits those of all the others"
    if lengths[leg][0] > high:
        return f"{text} could be at most {_about(high, unit)} long"
    return f"{text} could be no shorter than {_about(low, unit)}"


def _range(other: _Ends, pair: tuple[_Ends, _Ends]) -> _Ends:
    """Bounds, outward, of the length that another leg of the given length leaves."""
    base, platform = pair
    most = other[1] + base[1] + platform[1]
    sides = (other, base, platform)
    least = max(side[0] - sum((rest[1] for rest in sides if rest is not side), Fraction(0)) for side in sides)
    return max(least, Fraction(0)), most


def _closes(lengths: Sequence[_Ends], sides: dict[tuple[int, int], tuple[_Ends, _Ends]], i: int, j: int) -> bool:
    low, high = _range(lengths[j], sides[min(i, j), max(i, j)])
    return lengths[i][1] >= low and lengths[i][0] <= high


def _fits(lengths: Sequence[_Ends], sides: dict[tuple[int, int], tuple[_Ends, _Ends]]) -> bool:
    return all(_closes(lengths, sides, i, j) for i, j in sides)


def _exchanged(lengths: Sequence[_Ends], pair: tuple[int, int]) -> list[_Ends]:
    found = list(lengths)
    found[pair[0]], found[pair[1]] = found[pair[1]], found[pair[0]]
    return found


def _sides(problem: ForwardProblem) -> dict[tuple[int, int], tuple[_Ends, _Ends]]:
    """For each pair of legs the distances of their base joints and of their platform joints."""
    legs, metric = problem.distances, problem.metric
    return {
        (i, j): (_distance(legs[i].base, legs[j].base, metric), _distance(legs[i].platform, legs[j].platform, metric))
        for i, j in combinations(range(len(legs)), 2)
    }


def _distance(one: Vector, other: Vector, metric: Sequence[int]) -> _Ends:
    return _root(sum((g * (a - b) ** 2 for g, a, b in zip(metric, one, other, strict=True)), Fraction(0)))


def _root(square: Fraction) -> _Ends:
    """Bounds of a square root, to 80 bits."""
    scaled = (square.numerator << 2 * _BITS) // square.denominator
    low = isqrt(scaled)
    return Fraction(low, 1 << _BITS), Fraction(low + 1, 1 << _BITS)


def _about(number: Fraction, unit: str) -> str:
    return with_unit(f"{float(number):.4g}", unit)
