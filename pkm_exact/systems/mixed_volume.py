"""Bounds for the number of solutions from the terms that occur: mixed volumes (Bernstein 1975, Li and Wang 1996).

As many polynomials as variables, with the exponents A_1, .., A_n and 0, have as many isolated solutions at most as the
mixed volume of A_1, .., A_n. It is the sum of the volumes of mixed cells: of the choices of two points in each A_i
that are lowest together, lifted by some numbers. All choices count here that are not obstructed. What that proves, and
why, is in ``docs/certificates-systems.md``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate
from random import Random
from typing import Final, TypeAlias

from flint import fmpz_mat

from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.policy import Policy
from pkm_exact.systems.obstructions import Face, LiftedPoints, Obstruction, Point, TooMuchWorkError, Work
from pkm_exact.systems.polynomial_terms import decreasing_terms

MOST_VARIABLES: Final = 12
"""Beyond which the search is not begun."""
MOST_POINTS: Final = 1000
"""The same: of all supports together."""
MOST_WORK: Final = 3 * 10**8
"""Entries of matrices, and other work in their measure: a second or two."""
_LOOK: Final = 1000
"""Work of looking at one or two points."""
_LIFTED: Final = 1 << 16

Supports: TypeAlias = list[list[Point]]
_Pair: TypeAlias = tuple[int, int]


@dataclass(frozen=True)
class Subdivision:
    """Liftings of the points of the supports, and obstructions that leave as many cells as the mixed volume.

    Attributes
    ----------
    lifting : tuple of tuple of int
        For each polynomial: of its terms in their order, then of 1 if that is none of them.
    obstructions : tuple of Obstruction
    """

    lifting: tuple[tuple[int, ...], ...]
    obstructions: tuple[Obstruction, ...]


def subdivision_for(system: PolynomialSystem, number: int, policy: Policy) -> Subdivision | None:
    """The proof that no other solutions are possible than so many regular ones; None if it is not found.

    Examples
    --------
    >>> from pkm_exact.algebra.system import polynomial_ring
    >>> x, y = polynomial_ring(("x", "y")).gens()
    >>> system = PolynomialSystem(("x", "y"), (x * y**2 - 1, x * y + y - 3))
    >>> subdivision_for(system, 2, Policy()) is not None, subdivision_for(system, 1, Policy()) is None
    (True, True)
    """
    size = len(system.unknowns)
    if len(system.polynomials) != size or size > MOST_VARIABLES:
        return None
    terms = [[key for key, _ in decreasing_terms(polynomial)] for polynomial in system.polynomials]
    if any(len(keys) < 2 for keys in terms):
        return None
    supports = [keys if not any(keys[-1]) else [*keys, (0,) * size] for keys in terms]
    if sum(map(len, supports)) > MOST_POINTS:
        return None
    random = Random(policy.seed_for(system.digest, "mixed volume"))
    lifting = [[random.randrange(_LIFTED) for _ in support] for support in supports]
    search = _Search(supports, lifting, number)
    try:
        if search.volume() != number:
            return None
        return Subdivision(tuple(map(tuple, lifting)), search.obstructions())
    except TooMuchWorkError:
        return None


@dataclass(frozen=True)
class _Part:
    """Where some points, by their numbers, are lowest together."""

    face: Face
    points: frozenset[int]


class _Search:
    """The choices of two points in each support, supports with few points first, but for those that are obstructed."""

    def __init__(self, supports: Supports, lifting: Sequence[Sequence[int]], most: int) -> None:
        self.supports, self.most = supports, most
        self.order = sorted(range(len(supports)), key=lambda i: len(supports[i]))
        places = [(i, k) for i in self.order for k in range(len(supports[i]))]
        self.lifted = LiftedPoints(places, [supports[i][k] for i, k in places], [lifting[i][k] for i, k in places])
        self.starts = list(accumulate((len(supports[i]) for i in self.order), initial=0))
        self.work = Work(MOST_WORK)
        self.known: dict[int, list[frozenset[int]]] = {}
        """Points that are not lowest together, by the last of them."""
        self.found: list[tuple[frozenset[int], Obstruction]] = []

    def volume(self) -> int:
        """The sum of the volumes, as soon as it is above the number wanted.

        Raises
        ------
        TooMuchWorkError
            If that takes too long.
        """
        whole, total = self.lifted.vertex(), 0
        if whole is None:
            return 0
        for pairs in self._cells((), _Part(whole, frozenset())):
            total += abs(int(fmpz_mat([self._direction(first, second) for first, second in pairs]).det()))
            if total > self.most:
                break
        return total

    def obstructions(self) -> tuple[Obstruction, ...]:
        """Those found but for those that tell less than another, in the order in which they were."""
        smallest: list[frozenset[int]] = []
        for low, _ in sorted(self.found, key=lambda entry: len(entry[0])):
            self.work.spend(_LOOK + len(smallest))
            if not any(other <= low for other in smallest):
                smallest.append(low)
        kept = set(smallest)
        return tuple(entry for low, entry in self.found if low in kept)

    def _cells(self, pairs: tuple[_Pair, ...], part: _Part) -> Iterator[tuple[_Pair, ...]]:
        level = len(pairs)
        if level == len(self.order):
            yield pairs
            return
        points = range(self.starts[level], self.starts[level + 1])
        parts = [(point, found) for point in points if (found := self._with(part, point)) is not None]
        for place, (first, with_first) in enumerate(parts):
            for second, _ in parts[place + 1 :]:
                both = self._with(with_first, second)
                if both is not None:
                    yield from self._cells((*pairs, (first, second)), both)

    def _with(self, part: _Part, point: int) -> _Part | None:
        """The part where one more point is lowest; None if it is obstructed."""
        points = part.points | {point}
        known = self.known.get(point, ())
        self.work.spend(_LOOK + 50 * len(known))
        if any(low <= points for low in known):
            return None
        lowest = part.face.where_lowest(point, self.work)
        if lowest.face is not None:
            return _Part(lowest.face, points)
        reason = self.lifted.obstruction(lowest.relation, point, sorted(part.points))
        if reason is None:
            return _Part(part.face, points)
        weights = dict(reason)
        low = frozenset(number for number in points if weights.get(self.lifted.places[number], 0) < 0)
        self.known.setdefault(point, []).append(low)
        self.found.append((low, reason))
        return None

    def _direction(self, first: int, second: int) -> list[int]:
        points = self.lifted.points
        return [b - a for a, b in zip(points[first], points[second], strict=True)]
