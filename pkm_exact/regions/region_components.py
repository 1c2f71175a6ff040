"""How many pieces a map has, as far as its parts tell.

Parts that are proved to be outside are closed and belong to no piece. So a path inside of what is good leads from part
to part through common faces: where it passes a corner or an edge, no part around that is outside, and those around it
are joined by faces. Parts inside that no chain of parts inside or undecided joins are in different pieces.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from pkm_exact.regions.paving import INSIDE, OUTSIDE
from pkm_exact.regions.paving_tree import PavingTree, joined

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


def touching(word: str, axes: Sequence[int]) -> Iterator[tuple[int, int]]:
    """All pairs of parts that share a face, as places in the word.

    Examples
    --------
    >>> sorted(touching("ssioi", (0, 1)))
    [(2, 3), (2, 4), (3, 4)]
    """
    one, other = PavingTree(word).touching(axes)
    return zip(one.tolist(), other.tolist(), strict=True)


def components(answer: RegionAnswer) -> Components:
    """The pieces of a map, counted from its parts."""
    tree = PavingTree(answer.word)
    one, other = tree.touching(answer.axes)
    is_inside, is_good = tree.letters == ord(INSIDE), tree.letters != ord(OUTSIDE)
    counts = []
    for taken in (is_good, is_inside):
        both = taken[one] & taken[other]
        counts.append(len(np.unique(joined(len(taken), one[both], other[both])[is_inside])))
    return Components(*counts)
