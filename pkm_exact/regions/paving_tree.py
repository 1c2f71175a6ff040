"""The tree that the word of a paving spells, in arrays: its nodes are numbered as the letters."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from pkm_exact.regions.paving import SPLIT

Numbers = NDArray[np.int64]


class PavingTree:
    """Nodes, and where their halves are: the lower half of a node that is halved is the next one.

    Attributes
    ----------
    letters : array of bytes
    is_split : array of bool
    upper : array of int
        The upper half of each node that is halved; of others it says nothing.

    Examples
    --------
    >>> tree = PavingTree("ssioi")
    >>> tree.upper[tree.is_split].tolist(), tree.depths().tolist()
    ([4, 3], [0, 1, 2, 2, 1])
    """

    def __init__(self, word: str) -> None:
        self.letters = np.frombuffer(word.encode("ascii"), dtype=np.uint8)
        self.is_split = self.letters == ord(SPLIT)
        # What is open after each letter falls by one where what a node stands for ends, and not before.
        count = len(self.letters)
        opened = np.cumsum(np.where(self.is_split, 1, -1)) + 1
        order = np.argsort(opened, kind="stable")
        keys = opened[order] * count + order
        split = np.flatnonzero(self.is_split)
        ends = order[np.searchsorted(keys, (opened[split] - 1) * count + split)]
        self.upper: Numbers = np.zeros(count, dtype=np.int64)
        self.upper[split] = ends + 1

    def halves_of(self, nodes: Numbers) -> tuple[Numbers, Numbers]:
        """The lower and the upper halves of nodes; a node that is not halved is both."""
        split = self.is_split[nodes]
        return np.where(split, nodes + 1, nodes), np.where(split, self.upper[nodes], nodes)

    def depths(self) -> Numbers:
        """How deep each node is."""
        found: Numbers = np.zeros(len(self.letters), dtype=np.int64)
        nodes, depth = np.zeros(1, dtype=np.int64), 0
        while nodes.size:
            found[nodes] = depth
            nodes, depth = np.concatenate(self.halves_of(nodes[self.is_split[nodes]])), depth + 1
        return found

    def shares(self, letters: Sequence[str]) -> list[Fraction]:
        """Which share of the whole the parts with each of these letters are, exactly.

        Examples
        --------
        >>> [str(share) for share in PavingTree("ssioi").shares("io")]
        ['3/4', '1/4']
        """
        depths = self.depths()
        counts = (np.bincount(depths[self.letters == ord(letter)]).tolist() for letter in letters)
        return [sum((Fraction(count, 1 << depth) for depth, count in enumerate(row)), Fraction(0)) for row in counts]

    def touching(self, axes: Sequence[int]) -> tuple[Numbers, Numbers]:
        """All pairs of parts that share a face.

        Two nodes share one where they are the halves of a node, or where halves of such nodes are: along the axis of
        that face the nearer ones, along others both lower and both upper ones.

        Parameters
        ----------
        axes : sequence of int
            Along which variable the nodes of each depth are halved.
        """
        found: list[tuple[Numbers, Numbers]] = []
        nodes = np.zeros(1, dtype=np.int64)
        one = other = across = np.zeros(0, dtype=np.int64)
        for axis in (*axes, -1):
            ended = ~(self.is_split[one] | self.is_split[other])
            found.append((one[ended], other[ended]))
            (ones, uppers), (lowers, others) = (self.halves_of(side[~ended]) for side in (one, other))
            across = across[~ended]
            along = across == axis
            apart = ~along
            lower, upper = self.halves_of(nodes[self.is_split[nodes]])
            one = np.concatenate([uppers[along], ones[apart], uppers[apart], lower])
            other = np.concatenate([lowers[along], lowers[apart], others[apart], upper])
            new = np.full(len(lower), axis, dtype=np.int64)
            across = np.concatenate([across[along], across[apart], across[apart], new])
            nodes = np.concatenate([lower, upper])
        first, second = (np.concatenate(side) for side in zip(*found, strict=True))
        return first, second


def joined(count: int, one: Numbers, other: Numbers) -> Numbers:
    """For each of so many things the first one of its piece, where pairs of things are joined.

    Examples
    --------
    >>> joined(5, np.array([4, 1]), np.array([1, 3])).tolist()
    [0, 1, 2, 1, 1]
    """
    first: Numbers = np.arange(count)
    while True:
        ends = first[one], first[other]
        apart = ends[0] != ends[1]
        if not apart.any():
            return first
        one, other = one[apart], other[apart]
        low, high = (choose(ends[0][apart], ends[1][apart]) for choose in (np.minimum, np.maximum))
        np.minimum.at(first, high, low)
        while True:
            further = first[first]
            if (further == first).all():
                break
            first = further
