"""The hyperplanes that vectors span, exactly: primitive normals N, and N.g_k for every vector g_k.

With N the vector product of n - 1 of the vectors, N.g_k is the determinant of these and g_k. So all that is needed are
the determinants of n vectors each, which are shared; the normals follow from N.g_k for n independent g_k.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from math import gcd
from typing import TypeAlias

from flint import fmpq_mat, fmpz_mat

Integers: TypeAlias = tuple[int, ...]


def maximal_minors(vectors: Sequence[Integers]) -> dict[Integers, int]:
    """The determinants of all n vectors, under their indices in increasing order; the vectors must span the space.

    With few more vectors than dimensions from those of their kernel, which are smaller: the determinant of n vectors
    is that of the other rows of a basis of the kernel, up to a factor that is the same for all, and to the sign of the
    permutation that puts the other rows behind.

    Examples
    --------
    >>> maximal_minors(((1, 0), (0, 1), (2, 3)))
    {(0, 1): 1, (0, 2): 3, (1, 2): -2}
    """
    count, n = len(vectors), len(vectors[0])
    choices = combinations(range(count), n)
    if not 0 < count - n < n:
        return {chosen: int(fmpz_mat([vectors[k] for k in chosen]).det()) for chosen in choices}
    kernel, _ = fmpz_mat(vectors).transpose().nullspace()
    rows = [row[: count - n] for row in kernel.tolist()]
    found = {}
    for chosen in choices:
        value = int(fmpz_mat([rows[k] for k in range(count) if k not in chosen]).det())
        found[chosen] = -value if sum(chosen) % 2 else value
    places = _independent(vectors)
    factor, common = int(fmpz_mat([vectors[k] for k in places]).det()), found[places]
    return {chosen: value * factor // common for chosen, value in found.items()}


def spanned_hyperplanes(
    vectors: Sequence[Integers], minors: Mapping[Integers, int]
) -> tuple[tuple[Integers, Integers], ...]:
    """Each hyperplane once, in the order of the first n - 1 vectors that span it.

    The first entry of a normal that is not 0 is positive. The minors are those of ``maximal_minors``.

    Examples
    --------
    >>> vectors = ((1, 0), (0, 1), (0, 2))
    >>> spanned_hyperplanes(vectors, maximal_minors(vectors))
    (((0, 1), (0, 1, 2)), ((1, 0), (1, 0, 0)))
    """
    places = _independent(vectors)
    products = _products(len(vectors), len(vectors[0]), minors)
    basis = fmpz_mat([vectors[k] for k in places])
    right = fmpz_mat([[row[k] for row in products] for k in places])
    normals, _ = fmpq_mat(basis).solve(fmpq_mat(right)).transpose().numer_denom()  # integers: vector products
    found: dict[Integers, Integers] = {}
    for row, values in zip(normals.tolist(), products, strict=True):
        normal = [int(x) for x in row]
        divisor = gcd(*normal)
        if next(x for x in normal if x) < 0:
            divisor = -divisor
        primitive = tuple([x // divisor for x in normal])
        if primitive not in found:
            found[primitive] = tuple([x // divisor for x in values])
    return tuple(found.items())


def _products(count: int, n: int, minors: Mapping[Integers, int]) -> list[list[int]]:
    """N.g_k of all vectors for every n - 1 independent ones."""
    found = []
    for chosen in combinations(range(count), n - 1):
        values, before = [0] * count, 0
        for k in range(count):
            if before < n - 1 and k == chosen[before]:
                before += 1
                continue
            value = minors[(*chosen[:before], k, *chosen[before:])]
            values[k] = -value if before % 2 else value
        if any(values):
            found.append(values)
    return found


def _independent(vectors: Sequence[Integers]) -> Integers:
    """The first n independent ones."""
    rows, _, rank = fmpz_mat(vectors).transpose().rref()
    return tuple(next(j for j in range(rows.ncols()) if rows[i, j]) for i in range(rank))
