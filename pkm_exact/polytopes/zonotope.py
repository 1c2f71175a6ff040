"""Zonotopes, exactly: all sums of multiples c_k w_k g_k of generators, lo_k <= c_k <= hi_k, w_k > 0.

The wrenches that actuators of limited force can exert are one (Bosscher and Ebert-Uphoff, 2004; Gouttefarde and Krut,
2010). Its facets by hyperplane shifting: every n - 1 independent generators span a hyperplane, which, shifted as far as
the others reach, is one. Directions g_k are integers, so whether generators lie in a hyperplane is decided exactly, and
facets that more than n - 1 generators span are found once. Lengths w_k may be square roots: they do not change that.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import comb, lcm
from operator import add
from typing import Any, Final

from flint import fmpz_mat

from pkm_exact.errors import InputError
from pkm_exact.polytopes.enclosures import interval_of
from pkm_exact.polytopes.polytope import Facet, Polytope
from pkm_exact.polytopes.slabs import Slabs
from pkm_exact.polytopes.spanned_hyperplanes import maximal_minors, spanned_hyperplanes
from pkm_exact.radicals import RootSum
from pkm_exact.roots.interval import Interval

MOST_HYPERPLANES: Final = 200_000


@dataclass(frozen=True)
class Zonotope:
    """A zonotope.

    Attributes
    ----------
    generators : tuple of tuples of int
        g_k, none of them 0.
    weights : tuple of RootSum or Fraction
        w_k, positive.
    low, high : tuple of Fraction
    squares : tuple of Fraction
        Those of ``Polytope``.

    Examples
    --------
    >>> one = Fraction(1)
    >>> hexagon = Zonotope(((1, 0), (0, 1), (1, 1)), (one,) * 3, (-one,) * 3, (one,) * 3, (one, one))
    >>> len(hexagon.facets), len(hexagon.vertices), hexagon.volume
    (6, 6, [12])
    >>> (hexagon + hexagon).volume
    [48]
    """

    generators: tuple[tuple[int, ...], ...]
    weights: tuple[Any, ...]
    low: tuple[Fraction, ...]
    high: tuple[Fraction, ...]
    squares: tuple[Fraction, ...]

    def __add__(self, other: Zonotope) -> Zonotope:
        """The sum of Minkowski: all generators together."""
        if self.squares != other.squares:
            raise InputError("polytopes: are in different coordinates; add those of one machine")
        return Zonotope(
            self.generators + other.generators,
            self.weights + other.weights,
            self.low + other.low,
            self.high + other.high,
            self.squares,
        )

    @property
    def dimension(self) -> int:
        """Of the space."""
        return len(self.squares)

    @cached_property
    def _table(self) -> fmpz_mat:
        """The generators as columns."""
        return fmpz_mat([list(column) for column in zip(*self.generators, strict=True)])

    @cached_property
    def hyperplanes(self) -> tuple[tuple[tuple[int, ...], tuple[int, ...]], ...]:
        """The primitive normals N of all hyperplanes that generators span, and N.g_k for all of them, each once."""
        n, count = self.dimension, len(self.generators)
        if comb(count, n - 1) > MOST_HYPERPLANES:
            raise InputError(f"polytope: {count} generators in {n} dimensions are too many")
        if self._table.rank() < n:
            raise InputError("polytope: the generators do not span the space, so that it has no interior")
        return spanned_hyperplanes(self.generators, self._minors)

    @cached_property
    def _minors(self) -> dict[tuple[int, ...], int]:
        """The determinants of all n generators."""
        return maximal_minors(self.generators)

    @cached_property
    def facets(self) -> tuple[tuple[tuple[int, ...], Any], ...]:
        """Outer normals and offsets: normal.x <= offset."""
        found = []
        for normal, products in self.hyperplanes:
            low, high = self._reach(products)
            found.append((normal, high))
            found.append((tuple([-x for x in normal]), -1 * low))
        return tuple(found)

    def _reach(self, products: Sequence[int]) -> tuple[Any, Any]:
        """The least and the greatest normal.x, from normal.g_k."""
        whole = self._whole
        ends, common = (self._lengths, 1) if whole is None else whole
        least: Any = 0
        greatest: Any = 0
        for value, (low, high) in zip(products, ends, strict=True):
            if value > 0:
                least, greatest = least + value * low, greatest + value * high
            elif value:
                least, greatest = least + value * high, greatest + value * low
        return (least, greatest) if common == 1 else (Fraction(least, common), Fraction(greatest, common))

    @cached_property
    def _lengths(self) -> tuple[tuple[Any, Any], ...]:
        """By what each generator is multiplied at the least and the greatest of its range."""
        ranges = zip(self.low, self.high, self.weights, strict=True)
        return tuple((low * weight, high * weight) for low, high, weight in ranges)

    @cached_property
    def _whole(self) -> tuple[list[tuple[int, int]], int] | None:
        """The same as integers by a common denominator, if they are rational."""
        if not all(isinstance(length, Fraction | int) for pair in self._lengths for length in pair):
            return None
        common = lcm(*(Fraction(length).denominator for pair in self._lengths for length in pair))
        return [(int(low * common), int(high * common)) for low, high in self._lengths], common

    @property
    def cells(self) -> tuple[tuple[int, ...], ...]:
        """A vertex for each, as signs: -1 where a generator is at the least of its range, 1 at the greatest."""
        return self._cells

    @cached_property
    def _cells(self) -> tuple[tuple[int, ...], ...]:
        """A vertex for each, as signs: at which end of its range each generator is."""
        bits = _bits(len(self.generators))
        return tuple(tuple(1 if mask & bit else -1 for bit in bits) for mask in self._masks)

    @cached_property
    def _masks(self) -> tuple[int, ...]:
        """The cells as integers in increasing order, a bit for each generator at the greatest of its range."""
        masks: set[int] = set()
        bits = _bits(len(self.generators))
        for normal, products in self.hyperplanes:
            flat = [index for index, value in enumerate(products) if value == 0]
            up = _mask(bits, (value > 0 for value in products))
            masks.update([up | mask for mask in _masks_of(self.generators, flat, normal)])
        every = (1 << len(self.generators)) - 1
        return tuple(sorted(masks.union([every ^ mask for mask in masks])))  # it is symmetric about its middle

    @cached_property
    def vertices(self) -> tuple[tuple[Any, ...], ...]:
        """All of them."""
        if self._whole is None:
            return tuple(self._point(cell) for cell in self._cells)
        ends, common = self._whole
        both = zip(self.generators, ends, strict=True)
        steps = [(tuple([low * x for x in g]), tuple([high * x for x in g])) for g, (low, high) in both]
        half = len(steps) // 2
        middle = len(steps) - half
        first, last = _sums(steps[:middle], self.dimension), _sums(steps[middle:], self.dimension)
        rest = (1 << half) - 1
        found = [tuple(map(add, first[mask >> half], last[mask & rest])) for mask in self._masks]
        if common == 1:
            return tuple(found)
        return tuple([tuple([Fraction(value, common) for value in row]) for row in found])

    def _point(self, cell: Sequence[int]) -> tuple[Any, ...]:
        chosen = [pair[s > 0] for s, pair in zip(cell, self._lengths, strict=True)]
        return tuple(
            sum((length * g[j] for length, g in zip(chosen, self.generators, strict=True) if g[j]), Fraction(0))
            for j in range(self.dimension)
        )

    @cached_property
    def exact_volume(self) -> RootSum:
        """In the coordinates x: the sum of the parallelepipeds of n generators."""
        total = RootSum()
        if self._table.rank() < self.dimension:
            return total
        for chosen, minor in self._minors.items():
            if minor:
                part = RootSum.of(abs(minor))
                for index in chosen:
                    part = part * ((self.high[index] - self.low[index]) * self.weights[index])
                total = total + part
        return total

    @property
    def volume(self) -> Interval:
        """In ordinary coordinates."""
        scale = Fraction(1)
        for square in self.squares:
            scale *= square
        return interval_of(self.exact_volume * RootSum.root(scale))

    def section(self, fixed: Mapping[int, Any]) -> Slabs:
        """The points at which some coordinates have given values, in the others: forces at a given moment, for example.

        Raises
        ------
        InputError
            If there are none.
        """
        free = [j for j in range(self.dimension) if j not in fixed]
        rows, low, high = [], [], []
        for normal, products in self.hyperplanes:
            shift = sum((normal[j] * RootSum.of(value) for j, value in fixed.items()), RootSum())
            ends = tuple(RootSum.of(end) - shift for end in self._reach(products))
            row = tuple(Fraction(normal[j]) for j in free)
            if any(row):
                rows.append(row)
                low.append(ends[0])
                high.append(ends[1])
            elif ends[0].sign() > 0 or ends[1].sign() < 0:
                raise InputError("polytope: has no such points")
        return Slabs(tuple(rows), tuple(low), tuple(high), tuple(self.squares[j] for j in free))

    def polytope(self) -> Polytope:
        """The same by vertices and facets."""
        masks, bits, facets = self._masks, _bits(len(self.generators)), []
        for normal, products in self.hyperplanes:
            decided = _mask(bits, (value != 0 for value in products))
            low, high = self._reach(products)
            for side, offset in ((1, high), (-1, -1 * low)):
                wanted = _mask(bits, (side * value > 0 for value in products))
                on = tuple(index for index, mask in enumerate(masks) if mask & decided == wanted)
                facets.append(Facet(tuple(side * x for x in normal), offset, on))
        return Polytope(self.vertices, tuple(facets), self.squares)


def _sums(steps: Sequence[tuple[tuple[int, ...], tuple[int, ...]]], n: int) -> list[tuple[int, ...]]:
    """All sums of the first or the second vector of every pair, by masks as of ``_bits``."""
    found = [(0,) * n]
    for pair in steps:
        found = [tuple(map(add, known, vector)) for known in found for vector in pair]
    return found


def _bits(count: int) -> list[int]:
    """A bit for each generator, the first the most significant: so cells are sorted as tuples of signs are."""
    return [1 << k for k in range(count - 1, -1, -1)]


def _mask(bits: Sequence[int], chosen: Iterable[bool]) -> int:
    """The sum of the chosen bits."""
    return sum([bit for bit, wanted in zip(bits, chosen, strict=True) if wanted])


def _masks_of(generators: Sequence[tuple[int, ...]], flat: Sequence[int], normal: Sequence[int]) -> list[int]:
    """The cells of the zonotope of the generators that span the hyperplane with this normal, as bits of all."""
    n = len(normal) - 1
    every = _bits(len(generators))
    bits = [every[index] for index in flat]
    if len(flat) == n:
        found = [0]
        for bit in bits:
            found += [mask | bit for mask in found]
        return found
    dropped = next(j for j, x in enumerate(normal) if x)
    rest = tuple(generators[index][:dropped] + generators[index][dropped + 1 :] for index in flat)
    if n == 1:
        ups = _mask(bits, (g[0] > 0 for g in rest))
        return [ups, sum(bits) ^ ups]
    one, count = Fraction(1), len(rest)
    inner = Zonotope(rest, (one,) * count, (-one,) * count, (one,) * count, (one,) * n)
    own = _bits(count)
    return [_mask(bits, (mask & bit > 0 for bit in own)) for mask in inner._masks]
