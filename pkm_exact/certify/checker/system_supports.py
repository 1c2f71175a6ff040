"""How many solutions the terms that occur admit: choices of two points of each support, none of them obstructed.

A_i are the exponents of the i-th polynomial and 0. An obstruction shows that some points, lifted as the certificate
says, are lowest together nowhere. The volumes of all choices of edges without such points sum to the mixed volume of
the A_i at least.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import accumulate, chain, combinations
from typing import NamedTuple

from flint import fmpz_mat

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.system_terms import Monomial, Terms
from pkm_exact.certify.checker.verdict import rejected

_Edge = tuple[int, int]


class Subdivision(NamedTuple):
    """A number for each point of each support; obstructions: support, point, weight."""

    lifting: tuple[tuple[int, ...], ...]
    obstructions: tuple[tuple[tuple[int, int, int], ...], ...]


def require_bound(polynomials: Sequence[Terms], size: int, subdivision: Subdivision, number: int) -> None:
    """Rejects unless so many regular solutions are proved to be all by the terms that occur."""
    zero = (0,) * size
    supports = [list(terms) if zero in terms else [*terms, zero] for terms in polynomials]
    if list(map(len, subdivision.lifting)) != list(map(len, supports)):
        raise rejected("subdivision: not a number for each term of the polynomials, and for 1")
    lowest = [_obstructed(entry, supports, subdivision.lifting) for entry in subdivision.obstructions]
    volume = _Cells(supports, lowest).volume(number)
    if volume > number:
        raise rejected(f"subdivision: {number} solutions, and its cells have the volume {volume}, or more")


def _obstructed(
    entry: Sequence[tuple[int, int, int]], supports: Sequence[Sequence[Monomial]], lifting: Sequence[Sequence[int]]
) -> list[tuple[int, int]]:
    """The points that are not lowest together."""
    charge(len(entry) * (3000 + 300 * len(supports)))
    if not all(i < len(supports) and k < len(supports[i]) for i, k, _ in entry):
        raise rejected("subdivision: an obstruction names a point that there is not")
    sums, direction, height = [0] * len(supports), [0] * len(supports), 0
    for i, k, weight in entry:
        sums[i] += weight
        height += weight * lifting[i][k]
        for place, exponent in enumerate(supports[i][k]):
            direction[place] += weight * exponent
    if any(sums) or any(direction) or height >= 0:
        raise rejected("subdivision: an obstruction is none")
    return [(i, k) for i, k, weight in entry if weight < 0]


class _Cells:
    """Choices of two points in each support, those with the fewest points first; points are numbered throughout."""

    def __init__(self, supports: Sequence[Sequence[Monomial]], obstructed: Sequence[Sequence[tuple[int, int]]]) -> None:
        self.supports = sorted(supports, key=len)
        self.starts = list(accumulate(map(len, self.supports), initial=0))
        order = sorted(range(len(supports)), key=lambda i: len(supports[i]))
        first = {i: self.starts[level] for level, i in enumerate(order)}
        self.ending: dict[int, list[frozenset[int]]] = {}
        """Obstructed sets of points, by the last of them."""
        for points in obstructed:
            low = frozenset(first[i] + k for i, k in points)
            self.ending.setdefault(max(low), []).append(low)

    def volume(self, most: int) -> int:
        """The sum of the volumes, as soon as it is above ``most``."""
        total = 0
        for edges in self._choices(frozenset(), ()):
            charge(10_000 + 30 * len(edges) ** 3)
            directions = zip(edges, self.supports, strict=True)
            rows = [[b - a for a, b in zip(s[k], s[j], strict=True)] for (k, j), s in directions]
            total += abs(int(fmpz_mat(rows).det()))
            if total > most:
                break
        return total

    def _choices(self, points: frozenset[int], edges: tuple[_Edge, ...]) -> Iterator[tuple[_Edge, ...]]:
        """One after another: all of them might not have room in memory."""
        level = len(edges)
        if level == len(self.supports):
            yield edges
            return
        start = self.starts[level]
        for k, j in combinations(range(len(self.supports[level])), 2):
            known = self.ending.get(start + k, ()), self.ending.get(start + j, ())
            charge(3000 + 200 * sum(map(len, known)))
            further = points | {start + k, start + j}
            if not any(map(further.issuperset, chain(*known))):
                yield from self._choices(further, (*edges, (k, j)))
