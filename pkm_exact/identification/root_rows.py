"""What rows with square roots determine of parameters, exactly: for lengths that are irrational at the measured poses.

A rational change x of the parameters is shown by no row if it is shown by no part of a row: the rational part, and the
coefficients of each root, which are independent over the rationals (``radicals``). So the rational null space N is that
of the parts. Changes with real coefficients may be more: their space has n - rank dimensions. The rank is at least r if
elimination in ball arithmetic finds r pivots that are not 0. Where r + dim N = n, both are exact: the null space is
spanned by N, and what is determined are the rational combinations that the parts determine.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations, islice
from typing import Final, TypeAlias

import numpy as np
from flint import arb

from pkm_exact.balls import hull
from pkm_exact.errors import InputError
from pkm_exact.identification.observation import MOST_PLANS, Identification, Plan, identify, minimal_plan
from pkm_exact.precision import working_precision
from pkm_exact.radicals import Number, RootSum
from pkm_exact.screws.exact_matrix import Row

RootRow: TypeAlias = Sequence[Number]
PRECISION: Final = 1024
"""Bits of the elimination in balls."""


def parts(row: RootRow) -> tuple[Row, ...]:
    """The rational part of a row, and the coefficients of each of its roots; those of them that are not 0.

    Examples
    --------
    >>> two = RootSum.root(Fraction(2))
    >>> [[str(x) for x in row] for row in parts([Fraction(1), two * 3, two + 5])]
    [['1', '0', '5'], ['0', '3', '1']]
    """
    found: dict[int, list[Fraction]] = {}
    for k, value in enumerate(row):
        for n, c in RootSum.of(value).terms:
            root = RootSum.root(Fraction(n))
            # A root of a class that is there already is a multiple of the one that stands for the class.
            known, factor = next(
                ((m, ratio) for m in found if (ratio := (root / RootSum.root(Fraction(m))).rational) is not None),
                (n, Fraction(1)),
            )
            found.setdefault(known, [Fraction(0)] * len(row))[k] += c * factor
    return tuple(tuple(found[n]) for n in sorted(found))


def identify_by_roots(rows: Sequence[RootRow], names: Sequence[str]) -> Identification:
    """What rows with roots determine.

    Raises
    ------
    InputError
        If what they determine has irrational coefficients, or the rank is not decided.

    Examples
    --------
    >>> two, three = RootSum.root(Fraction(2)), RootSum.root(Fraction(3))
    >>> found = identify_by_roots([[1, two, 0], [1, three, 0]], ["a", "b", "c"])
    >>> found.rank, found.seen_alone, found.unseen
    (2, ('a', 'b'), ('c',))
    """
    found = identify([part for row in rows for part in parts(row)], names)
    least = least_rank(rows)
    if least < found.rank:
        known = f"rank {least}, as many as equations" if least == len(rows) else f"rank {least} at least"
        raise InputError(
            f"lengths are irrational at the poses, and what is determined has irrational coefficients ({known}, of "
            f"{len(names)} parameters); give more poses, poses with rational lengths, or leave --zeros out"
        )
    return found


def identified_with_plan(groups: Sequence[Sequence[RootRow]], names: Sequence[str]) -> tuple[Identification, Plan]:
    """What groups of rows determine together, and the fewest groups that determine as much; rational rows or not.

    Raises
    ------
    InputError
        As ``identify_by_roots``.

    Examples
    --------
    >>> found, fewest = identified_with_plan([[[1, 0]], [[RootSum.root(Fraction(2)), 1]], [[2, 0]]], ["a", "b"])
    >>> found.rank, fewest.chosen
    (2, (0, 1))
    """
    rational = [[[RootSum.of(value).rational for value in row] for row in rows] for rows in groups]
    exact = [[[x for x in row if x is not None] for row in rows] for rows in rational]
    if exact == rational:
        return identify([row for rows in exact for row in rows], names), minimal_plan(exact, len(names))
    found = identify_by_roots([row for rows in groups for row in rows], names)
    return found, plan_by_roots(groups, found.rank)


def least_rank(rows: Sequence[RootRow]) -> int:
    """A rank that the rows have at least: as many pivots as are proved not to be 0.

    Examples
    --------
    >>> two = RootSum.root(Fraction(2))
    >>> least_rank([[1, two], [two, 2]]), least_rank([[1, two], [two, 3]])
    (1, 2)
    """
    with working_precision(PRECISION):
        left = [[hull(*RootSum.of(value).bounds(PRECISION)) for value in row] for row in rows]
        count = 0
        while (place := _largest(left)) is not None:
            i, k = place
            pivot = left.pop(i)
            left = [
                row if row[k] == 0 else [x - row[k] / pivot[k] * y for x, y in zip(row, pivot, strict=True)]
                for row in left
            ]
            for row in left:
                row[k] = arb(0)
            count += 1
        return count


def _largest(rows: Sequence[Sequence[arb]]) -> tuple[int, int] | None:
    """The place of the entry that is farthest from 0, if one is proved not to be 0."""
    best, place = arb(0), None
    for i, row in enumerate(rows):
        for k, value in enumerate(row):
            if value != 0 and value.abs_lower() > best:
                best, place = value.abs_lower(), (i, k)
    return place


def plan_by_roots(groups: Sequence[Sequence[RootRow]], rank: int) -> Plan:
    """A choice of poses that determines as much as all, whose rank is given; the fewest where that can be said.

    Floating point says which choices are worth a proof. That no fewer do is proved only where fewer have too few
    equations.

    Examples
    --------
    >>> two = RootSum.root(Fraction(2))
    >>> plan_by_roots([[[1, two]], [[two, 2]], [[0, 1]]], 2)
    Plan(chosen=(0, 2), rank=2, is_smallest=True)
    """
    sizes = sorted((len(rows) for rows in groups), reverse=True)
    for some in _choices(groups, rank):
        if least_rank([row for k in some for row in groups[k]]) == rank:
            return Plan(some, rank, is_smallest=sum(sizes[: len(some) - 1]) < rank)
    return Plan(tuple(range(len(groups))), rank, is_smallest=sum(sizes[: len(groups) - 1]) < rank)


def _choices(groups: Sequence[Sequence[RootRow]], rank: int) -> Iterator[tuple[int, ...]]:
    """Choices that seem to have the rank, small ones first."""
    floats = [np.array([[float(value) for value in row] for row in rows]) for rows in groups]
    for size in range(1, len(groups) + 1):
        for some in islice(combinations(range(len(groups)), size), MOST_PLANS):
            matrix = np.concatenate([floats[k] for k in some])
            if len(matrix) >= rank and np.linalg.matrix_rank(matrix) >= rank:
                yield some
