"""Bounds for the number of isolated solutions from degrees, as a whole and in groups of variables.

The product of the n greatest degrees bounds the isolated solutions of any polynomials in n variables, and the
multihomogeneous number
those of n polynomials (Fulton, Intersection Theory, 12.3; proofs in ``docs/certificates-systems.md``).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
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


def multihomogeneous_number(system: PolynomialSystem, groups: Groups) -> int:
    """The number for as many polynomials as variables.

    Examples
    --------
    >>> from pkm_exact.algebra.system import polynomial_ring
    >>> x, y = polynomial_ring(("x", "y")).gens()
    >>> multihomogeneous_number(PolynomialSystem(("x", "y"), (x * y - 1, x * y + x + y)), ((0,), (1,)))
    2
    """
    return _Degrees(system).number(groups)


class _Degrees:
    """Degrees of a system's polynomials in groups of variables, each found once."""

    def __init__(self, system: PolynomialSystem) -> None:
        self.exponents = [[tuple(map(int, key)) for key in polynomial.to_dict()] for polynomial in system.polynomials]
        self.known: dict[tuple[int, ...], list[int]] = {}

    def of(self, group: tuple[int, ...]) -> list[int]:
        """The degree of each polynomial in a group."""
        if group not in self.known:
            self.known[group] = [max(sum(key[k] for k in group) for key in keys) for keys in self.exponents]
        return self.known[group]

    def number(self, groups: Groups) -> int:
        """The multihomogeneous number."""
        sizes = tuple(map(len, groups))
        counts = {(0,) * len(groups): 1}
        for degrees in zip(*map(self.of, groups), strict=True):
            counts = _joined(counts, degrees, sizes)
        return counts.get(sizes, 0)


def _joined(
    counts: dict[tuple[int, ...], int], degrees: Sequence[int], sizes: Sequence[int]
) -> dict[tuple[int, ...], int]:
    """A product of linear forms, by exponents, times one more; powers above ``sizes`` are left out."""
    following: dict[tuple[int, ...], int] = {}
    for key, value in counts.items():
        for place, degree in enumerate(degrees):
            if degree and key[place] < sizes[place]:
                larger = (*key[:place], key[place] + 1, *key[place + 1 :])
                following[larger] = following.get(larger, 0) + value * degree
    return following


def groups_with(system: PolynomialSystem, number: int) -> Groups | None:
    """Groups of variables with a given multihomogeneous number; None if those that were tried have others."""
    size = len(system.unknowns)
    if len(system.polynomials) != size:
        return None
    degrees = _Degrees(system)
    for groups in islice(partitions(size), MOST_PARTITIONS):
        if len(groups) > 1 and degrees.number(groups) == number:
            return groups
    return None


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
