"""Which freedoms must be locked to hold the platform, or the whole mechanism: all minimal sets of them, exactly.

The motions are a space of dimension k, and the speed of every freedom is a linear form on it. A set holds the mechanism
if its forms span all forms, and the platform if they span those that give the platform's twist. A minimal set is
independent, so that it is met by adding one freedom after another, in their order, as long as the set is independent
and does not hold yet; and it is minimal if it ceases to hold without any one of them.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd
from typing import Final, TypeAlias

from pkm_exact.errors import InputError
from pkm_exact.mobility.instantaneous_mobility import Instantaneous, images
from pkm_exact.screws.exact_matrix import Row, echelon, rank
from pkm_exact.screws.screw import primitive
from pkm_exact.wording import shown

Whole: TypeAlias = tuple[int, ...]

MOST_SETS: Final = 1000
MOST_WORDS: Final = 1_000_000
"""Sets that are listed, and words of numbers that eliminations take on the way; beyond, a list says it is not all."""


@dataclass(frozen=True)
class ActuatorSets:
    """Minimal sets of freedoms that hold something.

    Attributes
    ----------
    sets : tuple of tuples of str
        By size, then in the order of the freedoms.
    is_complete : bool
        Whether these are all; otherwise there were too many to look at, and some of them are listed.
    """

    sets: tuple[tuple[str, ...], ...]
    is_complete: bool


@dataclass(frozen=True)
class Actuation:
    """What given actuators do.

    Attributes
    ----------
    actuated : tuple of str
    degree : int
        Motions of the mechanism that they tell apart: the rank of their speeds on all motions.
    redundancy : int
        Actuators less the degree: so many could be left out.
    left, left_of_platform : int
        Freedoms of the mechanism and of the platform when they are locked.
    """

    actuated: tuple[str, ...]
    degree: int
    redundancy: int
    left: int
    left_of_platform: int


def forms(found: Instantaneous) -> list[Row]:
    """The speed of each freedom as a linear form on the motions."""
    count = len(found.linkage.freedoms)
    return [tuple(row[k] for row in found.speeds) for k in range(count)]


def platform_forms(found: Instantaneous) -> list[Row]:
    """The six coordinates of the platform's twist as linear forms on the motions."""
    return [tuple(row) for row in zip(*images(found.speeds, found.loops.platform), strict=True)]


def actuation(found: Instantaneous, names: Collection[str]) -> Actuation:
    """What actuators of these names do.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> from pkm_exact.mobility.instantaneous_mobility import instantaneous
    >>> found = instantaneous(read_linkage("models/chains/3-pprr.toml"))
    >>> actuation(found, ["A1", "A2", "A3"]).left_of_platform, actuation(found, ["A1", "B1"]).left_of_platform
    (1, 0)
    """
    places = places_of(found, names)
    rows, wanted, every = forms(found), platform_forms(found), found.total
    chosen = [rows[place] for place in places]
    degree = rank(chosen, every)
    left = rank([*chosen, *wanted], every) - degree
    known = tuple(found.linkage.freedoms[place] for place in places)
    return Actuation(known, degree, len(places) - degree, every - degree, left)


def sets_that_hold_the_mechanism(found: Instantaneous, among: Collection[str] | None = None) -> ActuatorSets:
    """All minimal sets of freedoms that leave no motion when they are locked."""
    units = [tuple(Fraction(int(i == j)) for j in range(found.total)) for i in range(found.total)]
    return _minimal(found, units, among)


def sets_that_hold_the_platform(found: Instantaneous, among: Collection[str] | None = None) -> ActuatorSets:
    """All minimal sets of freedoms that hold the platform when they are locked.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> from pkm_exact.mobility.instantaneous_mobility import instantaneous
    >>> found = sets_that_hold_the_platform(instantaneous(read_linkage("models/chains/3-pprr.toml")))
    >>> len(found.sets), found.sets[0]
    (9, ('A1', 'B1'))
    """
    return _minimal(found, platform_forms(found), among)


def places_of(found: Instantaneous, names: Collection[str]) -> list[int]:
    """The indices of freedoms, in their order."""
    known = found.linkage.freedoms
    for name in names:
        if name not in known:
            raise InputError(f"freedoms: {shown(name)} is not one of the mechanism; use some of: {', '.join(known)}")
    return [place for place, name in enumerate(known) if name in set(names)]


def _minimal(found: Instantaneous, wanted: Sequence[Row], among: Collection[str] | None) -> ActuatorSets:
    names = found.linkage.freedoms
    places = places_of(found, names if among is None else among)
    search = _Search([(place, row) for place, row in enumerate(forms(found)) if place in places and any(row)], wanted)
    sets = list(search.minimal_sets())
    sets.sort(key=lambda chosen: (len(chosen), chosen))
    return ActuatorSets(tuple(tuple(names[place] for place in chosen) for chosen in sets), search.is_complete)


class _Search:
    """The search through independent sets, in whole numbers; eliminated rows have a place that later ones are 0 at."""

    def __init__(self, elements: Sequence[tuple[int, Row]], wanted: Sequence[Row]) -> None:
        self._elements = [(place, whole(row)) for place, row in elements]
        self._wanted = [whole(row) for row in echelon(wanted, len(wanted[0]))[0]] if wanted and wanted[0] else []
        self._rows = dict(self._elements)
        self._words, self._found = 0, 0

    @property
    def is_complete(self) -> bool:
        """Whether nothing was left out."""
        return self._words <= MOST_WORDS and self._found <= MOST_SETS

    def minimal_sets(self) -> Iterator[tuple[int, ...]]:
        """One after another, in the order of their places."""
        yield from self._extended((), [], 0, self._wanted)

    def _extended(
        self, chosen: tuple[int, ...], basis: list[tuple[int, Whole]], start: int, rest: Sequence[Whole]
    ) -> Iterator[tuple[int, ...]]:
        if not self.is_complete:
            return
        if not rest:
            if self._is_minimal(chosen):
                self._found += 1
                if self.is_complete:
                    yield chosen
            return
        for position in range(start, len(self._elements)):
            if self._words > MOST_WORDS:
                return
            place, row = self._elements[position]
            reduced = self._charged(_reduced(row, basis), len(basis))
            pivot = next((k for k, value in enumerate(reduced) if value), None)
            if pivot is None:
                continue
            new = (pivot, reduced)
            remaining = [left for left in (self._charged(_reduced(row, [new]), 1) for row in rest) if any(left)]
            yield from self._extended((*chosen, place), [*basis, new], position + 1, remaining)

    def _charged(self, row: Whole, times: int) -> Whole:
        """The row, and the words of so many eliminations of it counted."""
        self._words += (1 + times) * len(row) * (1 + max(value.bit_length() for value in row) // 64)
        return row

    def _is_minimal(self, chosen: tuple[int, ...]) -> bool:
        if len(chosen) == len(self._wanted):
            return True
        self._words += 50 * len(chosen) ** 2 * len(self._wanted)
        return all(not self._holds([place for place in chosen if place != left]) for left in chosen)

    def _holds(self, places: Sequence[int]) -> bool:
        rows = [self._rows[place] for place in places]
        width = len(self._elements[0][1])
        return rank([*rows, *self._wanted], width) == rank(rows, width)


def whole(row: Sequence[Fraction]) -> Whole:
    """A positive multiple of a row, in integers."""
    return tuple(int(value) for value in primitive(row))


def _reduced(row: Whole, basis: Sequence[tuple[int, Whole]]) -> Whole:
    """A multiple of the row less multiples of the basis, so that it is 0 at their pivots."""
    for pivot, eliminated in basis:
        factor = row[pivot]
        if factor:
            lead = eliminated[pivot]
            row = tuple(lead * value - factor * other for value, other in zip(row, eliminated, strict=True))
            divisor = gcd(*row)
            if divisor > 1:
                row = tuple(value // divisor for value in row)
    return row
