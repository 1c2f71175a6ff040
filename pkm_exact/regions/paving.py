"""Branch and bound: a box halved again and again, until a formula is decided on every part or the parts are small.

All parts of one depth are halved along the same variable, so that a paving is the sequence of these variables, and a
word in the letters

    s  halved: the lower half follows, then the upper one
    i  inside: the formula holds all over the part
    o  outside: it holds nowhere in it
    u  undecided

No part can be left out and none can overlap another, whatever the word says.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.regions.compiled_formula import CompiledFormula, Truth

SPLIT: Final = "s"
INSIDE: Final = "i"
OUTSIDE: Final = "o"
UNDECIDED: Final = "u"
_LETTERS: Final = np.array([UNDECIDED, INSIDE, OUTSIDE])
MOST_HALVINGS: Final = 52
"""Of one variable."""
_NUMBERS_AT_ONCE: Final = 1 << 22
"""Coefficients of a batch: what is in memory at a time."""

Places = NDArray[np.int64]


@dataclass(frozen=True)
class Part:
    """A part of the box of a chart: its depth in the halving, and where it lies along each variable.

    Attributes
    ----------
    depth : int
    places : tuple of int
        Of 2^(halvings of the variable) equal parts, from 0.
    """

    depth: int
    places: tuple[int, ...]


def halving_axes(weights: Sequence[Fraction], steps: int) -> tuple[int, ...]:
    """Along which variable each halving is: the one that is longest, the first of equal ones.

    They end before a variable would be halved more than 52 times: ends of parts are numbers that doubles hold exactly.

    Parameters
    ----------
    weights : sequence of Fraction
        Squares of the lengths of the sides, in one unit.
    steps : int

    Examples
    --------
    >>> halving_axes([Fraction(16), Fraction(1)], 5)
    (0, 0, 0, 1, 0)
    """
    lengths, found = list(weights), list[int]()
    for _ in range(steps):
        axis = max(range(len(lengths)), key=lambda k: (lengths[k], -k))
        if found.count(axis) == MOST_HALVINGS:
            break
        lengths[axis] /= 4
        found.append(axis)
    return tuple(found)


def depths_at(axes: Sequence[int], depth: int, variables: int) -> list[int]:
    """How often each variable is halved after so many steps."""
    return [sum(axis == k for axis in axes[:depth]) for k in range(variables)]


@dataclass(frozen=True)
class Paved:
    """A paving of a part.

    Attributes
    ----------
    word : str
    open_parts : tuple of Part
        What is undecided at the greatest depth, in the order of the word; empty if it was not asked for.
    """

    word: str
    open_parts: tuple[Part, ...] = ()


class Front:
    """A paving that grows level by level: what is undecided at one depth is halved, and looked at again.

    Whoever decides the parts of a level, at once or in pieces, here or elsewhere, the paving is the same.

    Parameters
    ----------
    axes : sequence of int
        Along which variable the parts of each depth are halved.
    depth : int
    places : array (n, k)
        Of the first parts, all of this depth.
    last : int
        Parts of this depth are not halved.
    most : int
        Nor are parts of a depth at which more are undecided.
    stop_outside : bool
        Whether to go no deeper once a part is outside: the question is answered.
    """

    def __init__(
        self, axes: Sequence[int], depth: int, places: Places, last: int, *, most: int, stop_outside: bool
    ) -> None:
        self.depth, self.places, self.is_ended = depth, places, False
        self._axes, self._last, self._most, self._stop_outside = axes, last, most, stop_outside
        self._levels: list[NDArray[np.str_]] = []

    def grow(self, truths: Truth) -> None:
        """Go on, as far as what is proved of the parts at ``places`` says."""
        letters, undecided = _LETTERS[truths], truths == 0
        count = int(undecided.sum())
        self.is_ended = self.depth >= self._last or not count or count > self._most
        self.is_ended = self.is_ended or (self._stop_outside and bool((truths < 0).any()))
        if self.is_ended:
            self._levels.append(letters)
            self.places = self.places[undecided]
            return
        self._levels.append(np.where(undecided, SPLIT, letters))
        lower = np.repeat(self.places[undecided], 2, axis=0)
        axis = self._axes[self.depth]
        lower[:, axis] *= 2
        lower[1::2, axis] += 1
        self.places, self.depth = lower, self.depth + 1

    @property
    def paved(self) -> Paved:
        """The paving, once it has ended, of one first part."""
        return Paved(_word(self._levels), tuple(Part(self.depth, tuple(map(int, place))) for place in self.places))


def pave(
    formula: CompiledFormula,
    axes: Sequence[int],
    start: Part,
    last: int,
    *,
    most: int = 1 << 40,
    stop_outside: bool = False,
) -> Paved:
    """The paving of a part down to a depth.

    Parameters
    ----------
    formula : CompiledFormula
    axes, last, most, stop_outside
        As of ``Front``.
    start : Part
    """
    front = Front(axes, start.depth, places_of(start), last, most=most, stop_outside=stop_outside)
    while not front.is_ended:
        front.grow(truths_at(formula, axes, front.depth, front.places))
    return front.paved


def places_of(part: Part) -> Places:
    """A part as an array of one."""
    return np.array([part.places], dtype=np.int64)


def truths_at(formula: CompiledFormula, axes: Sequence[int], depth: int, places: Places) -> Truth:
    """What is proved of the parts of a depth: of each by itself, whichever others there are."""
    depths = depths_at(axes, depth, formula.variables)
    found: Truth = np.concatenate([formula.truths(depths, batch) for batch in _batches(formula, places)])
    return found


def _batches(formula: CompiledFormula, places: Places) -> list[Places]:
    size = max(1, _NUMBERS_AT_ONCE // formula.numbers)
    return [places[k : k + size] for k in range(0, len(places), size)]


def _word(levels: Sequence[NDArray[np.str_]]) -> str:
    """The word of a tree whose levels are given: the halves of the k-th halved part are 2 k and 2 k + 1 below."""
    below: list[str] = []
    for letters in reversed(levels):
        halves = iter(below)
        below = [letter if letter != SPLIT else f"{SPLIT}{next(halves)}{next(halves)}" for letter in letters.tolist()]
    return below[0]


def spliced(word: str, words: Sequence[str]) -> str:
    """A word with its undecided parts, in their order, replaced by words of their own.

    Examples
    --------
    >>> spliced("siu", ["sii"])
    'sisii'
    """
    pieces = word.split(UNDECIDED)
    return "".join(piece + inner for piece, inner in zip(pieces, [*words, ""], strict=True))


def leaves(word: str, axes: Sequence[int], variables: int, start: Part | None = None) -> list[tuple[str, Part]]:
    """The parts of a paving with their letters, in the order of the word.

    Examples
    --------
    >>> leaves("sio", [0], 1)
    [('i', Part(depth=1, places=(0,))), ('o', Part(depth=1, places=(1,)))]
    """
    found = []
    waiting = [start or Part(0, (0,) * variables)]
    for letter in word:
        part = waiting.pop()
        if letter != SPLIT:
            found.append((letter, part))
            continue
        axis = axes[part.depth]
        halves = [
            Part(part.depth + 1, tuple(2 * p + side if k == axis else p for k, p in enumerate(part.places)))
            for side in (1, 0)
        ]
        waiting += halves
    return found
