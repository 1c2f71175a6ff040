"""Bounds for the number of isolated solutions from degrees, as a whole and in groups of variables.

The product of the n greatest degrees bounds the isolated solutions of any polynomials in n variables, and the
multihomogeneous number
those of n polynomials (Fulton, Intersection Theory, 12.3; proofs in ``docs/certificates-systems.md``).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain, groupby, islice
from math import prod
from typing import Final, TypeAlias

from pkm_exact.algebra.system import PolynomialSystem

Groups: TypeAlias = tuple[tuple[int, ...], ...]
MOST_PARTITIONS: Final = 5000
"""Partitions of the variables that are tried."""


def product_of_degrees(degrees: Sequence[int], size: int) -> int | None:
    """The product of the greatest degrees, as many as variables; None if there are fewer polynomials.

    Examples
    --------
    >>> product_of_degrees([1, 3, 2], 2), product_of_degrees([2], 2)
    (6, None)
    """
    return prod(sorted(degrees, reverse=True)[:size]) if len(degrees) >= size else None


def total_degrees(system: PolynomialSystem) -> list[int]:
    """The degrees of the polynomials."""
    return [int(polynomial.total_degree()) for polynomial in system.polynomials]


def groups_with(system: PolynomialSystem, number: int) -> Groups | None:
    """Groups of variables with a given multihomogeneous number; None if those that were tried have others.

    Examples
    --------
    >>> from pkm_exact.algebra.system import polynomial_ring
    >>> x, y = polynomial_ring(("x", "y")).gens()
    >>> groups_with(PolynomialSystem(("x", "y"), (x * y - 1, x * y + x + y)), 2)
    ((0,), (1,))
    """
    size = len(system.unknowns)
    if len(system.polynomials) != size:
        return None
    degrees = _Degrees(system)
    for _, alike in groupby(islice(partitions(size), 1, MOST_PARTITIONS), key=len):
        several = list(alike)
        ordered = [tuple(sorted(groups, key=len)) for groups in several]
        same: dict[tuple[int, ...], list[int]] = {}
        for place, groups in enumerate(ordered):
            same.setdefault(tuple(map(len, groups)), []).append(place)
        bounds = (zip(places, degrees.numbers([ordered[k] for k in places]), strict=True) for places in same.values())
        reached = [place for place, bound in chain.from_iterable(bounds) if bound == number]
        if reached:
            return several[min(reached)]
    return None


class _Degrees:
    """Degrees of a system's polynomials in groups of variables, each found once."""

    def __init__(self, system: PolynomialSystem) -> None:
        self.exponents = [[tuple(map(int, key)) for key in polynomial.to_dict()] for polynomial in system.polynomials]
        self.known: dict[tuple[int, ...], int] = {}
        self.degrees: list[list[int]] = []

    def place(self, group: tuple[int, ...]) -> int:
        """Where the degree of each polynomial in a group stands."""
        if group not in self.known:
            self.known[group] = len(self.degrees)
            self.degrees.append([max(sum(key[k] for k in group) for key in keys) for keys in self.exponents])
        return self.known[group]

    def numbers(self, several: Sequence[Groups]) -> list[float]:
        """The multihomogeneous numbers for some partitions into groups of the same sizes.

        They are coefficients of products of linear forms; arrays have their coefficients by exponents. All are sums of
        integers that are not negative: a number below 2^53 is exact, and others are above it.
        """
        import numpy as np

        sizes = tuple(map(len, several[0]))
        places = np.array([[self.place(group) for group in groups] for groups in several])
        degrees = np.array(self.degrees, dtype=float)[places]
        counts = np.zeros((len(several), *(size + 1 for size in sizes)))
        counts.reshape(len(several), -1)[:, 0] = 1
        for factor in np.moveaxis(degrees, 2, 0):
            following = np.zeros_like(counts)
            for place in range(len(sizes)):
                shifted, kept = np.moveaxis(following, place + 1, -1), np.moveaxis(counts, place + 1, -1)
                shape = (len(several), *[1] * len(sizes))
                shifted[..., 1:] += factor[:, place].reshape(shape) * kept[..., :-1]
            counts = following
        at: tuple[int | slice, ...] = (slice(None), *sizes)
        return [float(value) for value in counts[at]]


def partitions(size: int) -> Iterator[Groups]:
    """The partitions of the numbers from 0 on, those in few parts first.

    Examples
    --------
    >>> list(partitions(3))[:3]
    [((0, 1, 2),), ((0, 1), (2,)), ((0, 2), (1,))]
    """
    for count in range(1, size + 1):
        yield from _into(size, count, ())


def _into(size: int, count: int, groups: Groups) -> Iterator[Groups]:
    """Partitions into so many parts that begin with these parts."""
    number = sum(map(len, groups))
    if number == size:
        if len(groups) == count:
            yield groups
        return
    if len(groups) + size - number < count:
        return
    for place, group in enumerate(groups):
        yield from _into(size, count, (*groups[:place], (*group, number), *groups[place + 1 :]))
    if len(groups) < count:
        yield from _into(size, count, (*groups, (number,)))
