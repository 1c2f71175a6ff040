"""Bounds for the number of solutions from the terms that occur: mixed volumes (Bernstein 1975, Li and Wang 1996).

As many polynomials as variables, with the exponents A_1, .., A_n and 0, have as many isolated solutions at most as the
mixed volume of A_1, .., A_n. It is the sum of the volumes of mixed cells: of the choices of two points in each A_i
that are lowest together, lifted by some numbers. All choices count here that are not obstructed. What that proves, and
why, is in ``docs/certificates-systems.md``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from random import Random
from typing import Final, TypeAlias

from flint import fmpz_mat

from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.policy import Policy
from pkm_exact.systems.obstructions import Edge, Obstruction, Point, obstruction
from pkm_exact.systems.polynomial_terms import decreasing_terms

MOST_VARIABLES: Final = 12
"""Beyond which the search is not begun."""
MOST_SEARCHES: Final = 6000
"""Obstructions that are looked for."""
_LIFTED: Final = 1 << 16

Supports: TypeAlias = list[list[Point]]


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
    random = Random(policy.seed_for(system.digest, "mixed volume"))
    lifting = [[random.randrange(_LIFTED) for _ in support] for support in supports]
    search = _Search(supports, lifting, number)
    if search.volume() != number:
        return None
    return Subdivision(tuple(map(tuple, lifting)), tuple(search.found))


class _Search:
    """The choices of an edge in each support, fewest points first, but for those that are obstructed."""

    def __init__(self, supports: Supports, lifting: list[list[int]], most: int) -> None:
        self.supports, self.lifting, self.most = supports, lifting, most
        self.order = sorted(range(len(supports)), key=lambda i: len(supports[i]))
        self.level = {i: level for level, i in enumerate(self.order)}
        self.searches = 0
        self.found: list[Obstruction] = []
        self.known: dict[tuple[int, int], list[frozenset[tuple[int, int]]]] = {}
        """Points that are not lowest together, by one of them in the last support in which there are some."""

    def volume(self) -> int | None:
        """The sum of the volumes; None if it is above the number wanted, or if that takes too long."""
        total = 0
        for edges in self._cells((), frozenset()):
            total += abs(int(fmpz_mat([_direction(self.supports, edge) for edge in edges]).det()))
            if total > self.most:
                return None
        return total if self.searches <= MOST_SEARCHES else None

    def _cells(self, edges: tuple[Edge, ...], points: frozenset[tuple[int, int]]) -> Iterator[tuple[Edge, ...]]:
        level = len(edges)
        if level == len(self.order):
            yield edges
            return
        i = self.order[level]
        for first, second in combinations(range(len(self.supports[i])), 2):
            ends = ((i, first), (i, second))
            further = points.union(ends)
            if any(some <= further for end in ends for some in self.known.get(end, ())):
                continue
            chosen = (*edges, (i, first, second))
            self.searches += 1
            if self.searches > MOST_SEARCHES:
                return
            reason = obstruction(self.supports, self.lifting, chosen)
            if reason is None:
                yield from self._cells(chosen, further)
            elif self._last(reason) < level:
                return

    def _last(self, reason: Obstruction) -> int:
        """Keep an obstruction; the level of the last support that it needs."""
        lowest = frozenset(place for place, value in reason if value < 0)
        last = max(lowest, key=lambda place: self.level[place[0]])
        self.found.append(reason)
        self.known.setdefault(last, []).append(lowest)
        return self.level[last[0]]


def _direction(supports: Supports, edge: Edge) -> list[int]:
    i, first, second = edge
    return [b - a for a, b in zip(supports[i][first], supports[i][second], strict=True)]
