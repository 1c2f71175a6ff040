"""Independent curves of configurations: so many dimensions there are at least.

Loops that share no freedom, and freedoms on no loop, move independently of each other: curves that move freedoms of
different loops are a family of as many dimensions.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import chain, combinations
from typing import Final

from pkm_exact.mobility.algebraic_curve import AlgebraicCurve, algebraic_curve
from pkm_exact.mobility.instantaneous_mobility import Instantaneous, instantaneous
from pkm_exact.mobility.rational_directions import rational_directions
from pkm_exact.mobility.second_order import obstructions

MOST_TRIALS: Final = 100
MOST_LOCKED_TOGETHER: Final = 2
"""Sets of freedoms that are locked on trial in a part, and how many at once."""


def independent_curves(found: Instantaneous, most: int) -> tuple[AlgebraicCurve, ...]:
    """At most so many curves of configurations, in parts of the mechanism that share no loop.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> len(independent_curves(instantaneous(read_linkage("models/chains/bennett.toml")), 1))
    1
    """
    curves: list[AlgebraicCurve] = []
    for part in _parts(found):
        if len(curves) == most:
            break
        curve = _curve_of_part(found, part)
        if curve is not None:
            curves.append(curve)
    return tuple(curves)


def _parts(found: Instantaneous) -> list[list[int]]:
    """The freedoms of loops that hang together, and freedoms on no loop, one by one."""
    parts: list[set[int]] = [{k} for k in range(len(found.linkage.freedoms))]
    for loop in found.loops.loops:
        along = {index for index, _ in loop}
        apart = [part for part in parts if not part & along]
        parts = [*apart, along.union(*(part for part in parts if part & along))]
    return sorted(sorted(part) for part in parts)


def _curve_of_part(found: Instantaneous, part: Sequence[int]) -> AlgebraicCurve | None:
    """The only motion there can be, one with freedoms locked, or a branch of a singular configuration."""
    names = found.linkage.freedoms
    if not any(index in part for loop in found.loops.loops for index, _ in loop):
        zero, one = Fraction(0), Fraction(1)
        halves = tuple((((zero, one),) if k == part[0] else ((zero,),), (one,)) for k in range(len(names)))
        return AlgebraicCurve(((zero,), (one,)), halves)
    outside = [name for k, name in enumerate(names) if k not in part]
    for _, chosen in zip(range(MOST_TRIALS), _locked_on_trial([names[k] for k in part]), strict=False):
        left = instantaneous(found.linkage, (*outside, *chosen))
        curve = algebraic_curve(left) if left.total == 1 else None
        if curve is not None:
            return curve
    free = instantaneous(found.linkage, outside)
    forms = [entry.form for entry in obstructions(free)]
    directions = rational_directions(forms, free.total) if forms else []
    branches = (algebraic_curve(free, direction) for direction in directions)
    return next((curve for curve in branches if curve is not None), None)


def _locked_on_trial(names: Sequence[str]) -> Iterator[tuple[str, ...]]:
    return chain.from_iterable(combinations(names, count) for count in range(MOST_LOCKED_TOGETHER + 1))
