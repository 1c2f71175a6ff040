"""What lengths were perhaps meant that are far from those of the nominal pose: a guess in floating point, no proof.

Lengths in another unit, of one leg in another unit, exchanged lengths or joints of two legs: each is tried at the
nominal pose. It is named if it leaves a third, at most, of what the lengths given are off there, and is then near.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from math import dist, sqrt
from typing import TYPE_CHECKING, Final, TypeVar

from pkm_exact.poses.other_units import factors_of, times
from pkm_exact.wording import with_unit

if TYPE_CHECKING:
    from pkm_exact.constraints.form import Vector
    from pkm_exact.geometry.nominal_pose import NominalPose
    from pkm_exact.geometry.problem import ForwardProblem

_FAR: Final = 0.1
"""Lengths that are off by less than this share of those of the nominal pose are those of a pose nearby."""
_BETTER: Final = 3.0
_SAME: Final = 1.001

_Points = Sequence[Sequence[float]]
_Any = TypeVar("_Any")


def meant_notes(problem: ForwardProblem, nominal: NominalPose, unit: str) -> tuple[str, ...]:
    """What was perhaps meant, or else, if there is no guess, which leg differs most; nothing if the lengths are near.

    Parameters
    ----------
    problem : ForwardProblem
        With legs only, whose lengths were given.
    nominal : NominalPose
    unit : str
        Of the lengths.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from pkm_exact import Robot
    >>> from pkm_exact.geometry.nominal_pose import nominal_from_numbers
    >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
    >>> meant = nominal_from_numbers([Fraction(n) for n in (5, 5, 0)], "meant", robot.motion)
    >>> (note,) = meant_notes(robot.problem_at([Fraction(x) for x in ("7.07", "5.1", "0.005")]), meant, "mm")
    >>> note[:109]
    'at the nominal pose these lengths are off by 2.884 mm; with that of leg 3 multiplied by 1000, as if it was in'
    """
    known = _at_the_nominal_pose(problem, nominal)
    if known is None:
        return ()
    given, base, platform = known
    there = _lengths(base, platform)
    off, near = _apart(given, there), _FAR * sum(there) / len(there)
    guesses = [(_apart(*pair), words) for words, *pair in _guesses(given, base, platform, unit)]
    best = min(guess for guess, _ in guesses)
    if off <= near or best > min(near, off / _BETTER):
        return ()
    words = ", or ".join(words for guess, words in guesses if guess <= best * _SAME)
    rest = f"they are off by {_about(best, unit)} (root of the mean square, in floating point): is that what is meant?"
    return (f"at the nominal pose these lengths are off by {_about(off, unit)}; {words} {rest}",)


def farthest_note(problem: ForwardProblem, nominal: NominalPose, unit: str) -> tuple[str, ...]:
    """Which leg differs most from what it is at the nominal pose, where no pair of legs says why there is no pose."""
    known = _at_the_nominal_pose(problem, nominal)
    if known is None:
        return ()
    given, there = known[0], _lengths(*known[1:])
    leg = max(range(len(given)), key=lambda i: (abs(given[i] - there[i]), -i))
    here = f"leg {leg + 1}, {_about(given[leg], unit)} long, where it would be {_about(there[leg], unit)}"
    return (f"no single leg nor pair of legs contradicts the others; the farthest from the nominal pose is {here}",)


def _at_the_nominal_pose(problem: ForwardProblem, nominal: NominalPose) -> tuple[list[float], _Points, _Points] | None:
    """The lengths given, and where joints are; None if there are not legs only, or numbers too large for doubles."""
    if not problem.has_only_distances or len(problem.distances) < 2:
        return None
    try:
        scale = [sqrt(g) for g in problem.metric]
        base = [_scaled(leg.base, scale) for leg in problem.distances]
        platform = [_placed(_scaled(leg.platform, scale), nominal) for leg in problem.distances]
        return [sqrt(leg.length_squared) for leg in problem.distances], base, platform
    except OverflowError:
        return None


def _guesses(
    given: Sequence[float], base: _Points, platform: _Points, unit: str
) -> Iterator[tuple[str, Sequence[float], Sequence[float]]]:
    """What may have been meant, in words, with the lengths given then and those at the nominal pose."""
    there, legs = _lengths(base, platform), range(len(given))
    for factor, other in factors_of(unit):
        named = f", as if they were in {other}," if other else ""
        yield f"multiplied by {times(factor)}{named}", [float(factor) * x for x in given], there
        for leg in legs:
            changed = [float(factor) * x if i == leg else x for i, x in enumerate(given)]
            yield (
                f"with that of leg {leg + 1} multiplied by {times(factor)}{named.replace('they were', 'it was')}",
                changed,
                there,
            )
    for i, j in combinations(legs, 2):
        pair = f"of legs {i + 1} and {j + 1} exchanged"
        yield f"with the lengths {pair}", _exchanged(given, i, j), there
        yield f"with the base joints {pair}", given, _lengths(_exchanged(base, i, j), platform)
        yield f"with the platform joints {pair}", given, _lengths(base, _exchanged(platform, i, j))


def _exchanged(rows: Sequence[_Any], i: int, j: int) -> list[_Any]:
    found = list(rows)
    found[i], found[j] = found[j], found[i]
    return found


def _scaled(joint: Vector, scale: Sequence[float]) -> list[float]:
    return [root * float(x) for root, x in zip(scale, joint, strict=True)]


def _placed(joint: Sequence[float], nominal: NominalPose) -> list[float]:
    rows = zip(nominal.position, nominal.rotation, strict=True)
    return [float(c) + sum(float(r) * x for r, x in zip(row, joint, strict=True)) for c, row in rows]


def _lengths(base: _Points, platform: _Points) -> list[float]:
    return [dist(a, b) for a, b in zip(base, platform, strict=True)]


def _apart(one: Sequence[float], other: Sequence[float]) -> float:
    """Root of the mean square."""
    return sqrt(sum((a - b) ** 2 for a, b in zip(one, other, strict=True)) / len(one))


def _about(number: float, unit: str) -> str:
    return with_unit(f"{number:.4g}", unit)
