"""How many pieces a map has, as far as its parts tell.

Parts that are proved to be outside are closed and belong to no piece. So a path inside of what is good leads from part
to part through common faces: where it passes a corner or an edge, no part around that is outside, and those around it
are joined by faces. Parts inside that no chain of parts inside or undecided joins are in different pieces.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pkm_exact.regions.paving import INSIDE, OUTSIDE, SPLIT

if TYPE_CHECKING:
    from pkm_exact.regions.region_solver import RegionAnswer


@dataclass(frozen=True)
class Components:
    """Pieces of a map.

    Attributes
    ----------
    separated : int
        At least so many pieces has what is good: no path through undecided parts joins the parts inside.
    connected : int
        So many pieces do the parts inside form by themselves.
    """

    separated: int
    connected: int


class _Tree:
    """The nodes of a paving, numbered as the letters of its word."""

    def __init__(self, word: str) -> None:
        self.word = word
        self.upper = [0] * len(word)
        open_nodes: list[tuple[int, int]] = []
        for node in range(len(word)):
            if word[node] == SPLIT:
                open_nodes.append((node, 0))
                continue
            while open_nodes:
                parent, done = open_nodes.pop()
                if not done:
                    self.upper[parent] = node + 1
                    open_nodes.append((parent, 1))
                    break

    def halves(self, node: int) -> tuple[int, int]:
        """The lower and the upper half of a node that is halved."""
        return node + 1, self.upper[node]


def touching(word: str, axes: Sequence[int]) -> Iterator[tuple[int, int]]:
    """All pairs of parts that share a face, as places in the word.

    Examples
    --------
    >>> sorted(touching("ssioi", (0, 1)))
    [(2, 3), (2, 4), (3, 4)]
    """
    tree = _Tree(word)
    waiting = [(0, 0)]
    while waiting:
        node, depth = waiting.pop()
        if word[node] == SPLIT:
            low, high = tree.halves(node)
            waiting += [(low, depth + 1), (high, depth + 1)]
            yield from _faces(tree, axes, low, high, depth + 1, axes[depth])


def _faces(tree: _Tree, axes: Sequence[int], low: int, high: int, depth: int, axis: int) -> Iterator[tuple[int, int]]:
    """Pairs of parts, below two nodes that share a face."""
    waiting = [(low, high, depth)]
    while waiting:
        one, other, level = waiting.pop()
        split = tree.word[one] == SPLIT, tree.word[other] == SPLIT
        if not any(split):
            yield one, other
            continue
        ones = tree.halves(one) if split[0] else (one, one)
        others = tree.halves(other) if split[1] else (other, other)
        if axes[level] == axis:
            waiting.append((ones[1], others[0], level + 1))
        else:
            waiting += [(ones[0], others[0], level + 1), (ones[1], others[1], level + 1)]


def components(answer: RegionAnswer) -> Components:
    """The pieces of a map, counted from its parts."""
    word = answer.word
    joined, inside = list(range(len(word))), list(range(len(word)))
    for one, other in touching(word, answer.axes):
        letters = word[one] + word[other]
        if OUTSIDE not in letters:
            _join(joined, one, other)
        if letters == INSIDE * 2:
            _join(inside, one, other)
    places = [k for k, letter in enumerate(word) if letter == INSIDE]
    return Components(len({_root(joined, k) for k in places}), len({_root(inside, k) for k in places}))


def _root(parents: list[int], k: int) -> int:
    while parents[k] != k:
        parents[k] = parents[parents[k]]
        k = parents[k]
    return k


def _join(parents: list[int], one: int, other: int) -> None:
    parents[_root(parents, one)] = _root(parents, other)
