"""For which designs a question about all of a region is answered yes: boxes of parameters, each proved.

The parameters are variables of the polynomials beside those of the poses. A box of designs is good if all parts of
region times box are; it is bad if the conditions hold nowhere in one of them, or if the determinant of the constraints
is positive all over one and negative all over another: so for every design in the box there is a pose that is not good,
or two poses between which there is one, as the region is connected. Other boxes are halved.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import cycle, islice
from typing import Final

import numpy as np

from pkm_exact.geometry.limits import Pair
from pkm_exact.regions.chart import Parameter
from pkm_exact.regions.compiled_formula import CompiledFormula, View, compiled_formula
from pkm_exact.regions.formula import Atom, Sign, atoms_of
from pkm_exact.regions.paving import INSIDE, OUTSIDE, UNDECIDED, Part, depths_at, leaves, pave
from pkm_exact.regions.region_legs import RegionMachine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.regions.region_solver import axes_of, prepared

YES: Final = "yes"
NO: Final = "no"
OPEN: Final = "undecided"
MOST_BOXES: Final = 20_000
"""Of designs: where there would be more, they are halved no further."""
_FIRST_STEPS: Final = 6


@dataclass(frozen=True)
class DesignBox:
    """A box of designs.

    Attributes
    ----------
    ends : tuple of pairs of Fraction
        For each parameter.
    verdict : str
        "yes" for all designs in it, "no" for all of them, or "undecided".
    """

    ends: tuple[Pair, ...]
    verdict: str


@dataclass(frozen=True)
class Designs:
    """The set of designs for which a question is answered yes, enclosed.

    Attributes
    ----------
    keys : tuple of str
    boxes : tuple of DesignBox
        They fill the box that was asked about, in order.
    axes : tuple of int
        Along which variable the region's parts of each depth are halved.
    word : str
        The boxes and what proves their verdicts, as certificates have it (``docs/certificates-regions.md``).
    """

    keys: tuple[str, ...]
    boxes: tuple[DesignBox, ...]
    axes: tuple[int, ...] = ()
    word: str = ""

    def share(self, verdict: str) -> Fraction:
        """How large a part of the box has a verdict."""
        sizes = {box: _size(box.ends) for box in self.boxes}
        whole = sum(sizes.values(), Fraction(0))
        return sum((size for box, size in sizes.items() if box.verdict == verdict), Fraction(0)) / whole


def _size(ends: Sequence[Pair]) -> Fraction:
    size = Fraction(1)
    for low, high in ends:
        size *= high - low
    return size


def designs(
    machine: RegionMachine, question: RegionQuestion, *, progress: Callable[[int], None] | None = None
) -> Designs:
    """Boxes of designs with their verdicts, halved to the precision of the question.

    Parameters
    ----------
    machine : RegionMachine
    question : RegionQuestion
        Of the answer "designs".
    progress : callable, optional
        Gets the number of boxes that are decided, after each.

    Raises
    ------
    InputError
        If it is not one that regions know.
    """
    search = _Search(machine, question)
    level: list[Part] = [Part(0, (0,) * search.count)]
    found: list[DesignBox] = []
    words: dict[Part, str] = {}
    while level:
        undecided = []
        for part in level:
            verdict, word = search.verdict(part)
            if verdict == OPEN:
                undecided.append(part)
                continue
            words[part] = word
            found.append(DesignBox(search.ends(part), verdict))
            if progress is not None:
                progress(len(found))
        if level[0].depth == search.deepest or len(found) + 2 * len(undecided) > MOST_BOXES:
            found += [DesignBox(search.ends(part), OPEN) for part in undecided]
            words |= dict.fromkeys(undecided, "u")
            break
        level = [half for part in undecided for half in _halves(part, part.depth % search.count)]
    keys = tuple(key for key, _ in question.answer.parameters)
    word = _joined(Part(0, (0,) * search.count), words, search.count)
    return Designs(keys, tuple(sorted(found, key=lambda box: box.ends)), search.inner, word)


def _joined(part: Part, words: Mapping[Part, str], count: int) -> str:
    """The word of a box of designs, from those of the boxes in it."""
    if part in words:
        return words[part]
    return "s" + "".join(_joined(half, words, count) for half in _halves(part, part.depth % count))


def _pruned(word: str, kept: Mapping[int, str]) -> str:
    """A paving with nothing said of its leaves but of some, by their numbers."""
    found: list[str] = []
    leaf = 0
    for letter in word:
        found.append(letter if letter == "s" else kept.get(leaf, "x"))
        leaf += letter != "s"
        while found[-3:] == ["s", "x", "x"]:
            found[-3:] = ["x"]
    return "".join(found)


def widened(question: RegionQuestion) -> RegionQuestion:
    """The question with the parameters as variables of its chart."""
    chart, wanted = question.chart, question.answer
    names = tuple(f"p{k}" for k in range(1, len(wanted.parameters) + 1))
    parameters = tuple(Parameter(name, key) for name, (key, _) in zip(names, wanted.parameters, strict=True))
    boxes = (ends for _, ends in wanted.parameters)
    wide = replace(chart, variables=(*chart.variables, *names), box=(*chart.box, *boxes), parameters=parameters)
    return replace(question, chart=wide)


def _halves(part: Part, axis: int) -> list[Part]:
    return [
        Part(part.depth + 1, tuple(2 * p + side if k == axis else p for k, p in enumerate(part.places)))
        for side in (0, 1)
    ]


class _Search:
    def __init__(self, machine: RegionMachine, question: RegionQuestion) -> None:
        chart, wanted = question.chart, question.answer
        self.count = len(wanted.parameters)
        self._boxes = [ends for _, ends in wanted.parameters]
        wide_question = widened(question)
        wide, ready = wide_question.chart, prepared(machine, wide_question)
        self._compiled, self._variables = ready.compiled, len(wide.variables)
        self.inner = axes_of(machine, chart.variables, chart.box, wanted.steps)
        self._most = wanted.boxes
        self._determinants = [
            atom for atom in atoms_of(ready.asked.formula) if atom.sign is Sign.NOT_ZERO and question.is_connected
        ]
        self._region: CompiledFormula | None = None
        if atoms_of(ready.region):
            atoms = {id(atom): atom for atom in atoms_of(ready.region)}
            self._region = compiled_formula(ready.region, list(atoms.values()), ready.asked.roots, wide.box)
        halvings = 0
        while Fraction(1, 2**halvings) > wanted.precision:
            halvings += 1
        self.deepest = halvings * self.count

    def ends(self, part: Part) -> tuple[Pair, ...]:
        """The box of a part of the parameters."""
        depths = [len(range(k, part.depth, self.count)) for k in range(self.count)]
        return tuple(
            (low + (high - low) * Fraction(place, 1 << depth), low + (high - low) * Fraction(place + 1, 1 << depth))
            for (low, high), place, depth in zip(self._boxes, part.places, depths, strict=True)
        )

    def verdict(self, part: Part) -> tuple[str, str]:
        """Of all designs in a part, and the word that proves it: few halvings of the region first, then all."""
        outer = list(islice(cycle(range(self._variables - self.count, self._variables)), part.depth))
        axes = (*outer, *self.inner)
        places = (0,) * (self._variables - self.count) + part.places
        start = Part(part.depth, places)
        for last in dict.fromkeys((min(_FIRST_STEPS, len(self.inner)), len(self.inner))):
            word = pave(self._compiled, axes, start, part.depth + last, most=self._most, stop_outside=True).word
            letters = word.replace("s", "")
            if OUTSIDE in letters:
                return NO, "n" + _pruned(word, {letters.index(OUTSIDE): OUTSIDE})
            if UNDECIDED not in letters:
                return YES, "y" + word
            found = leaves(word, axes, self._variables, start)
            good = {number: leaf for number, (letter, leaf) in enumerate(found) if letter == INSIDE}
            for atom in self._determinants:
                signs = self._signs(atom, good, axes)
                if len(signs) == 2:
                    return NO, "n" + _pruned(word, {number: sign for sign, number in signs.items()})
        return OPEN, "u"

    def _signs(self, atom: Atom, parts: Mapping[int, Part], axes: Sequence[int]) -> dict[str, int]:
        """The number of a part of the region all over which the determinant is positive, and of one where negative."""
        found: dict[str, int] = {}
        polynomial, _ = self._compiled.atoms[id(atom)]
        by_depth: dict[int, list[int]] = {}
        for number, part in parts.items():
            by_depth.setdefault(part.depth, []).append(number)
        for depth, same in by_depth.items():
            places = np.array([parts[number].places for number in same], dtype=np.int64)
            view = View(depths_at(axes, depth, self._variables), places)
            low, high = view.range_of(polynomial, self._compiled.root_ends(view))
            inside = np.ones(len(same), dtype=bool) if self._region is None else self._region.truths_in(view) > 0
            for sign, holds in (("+", (low > 0) & inside), ("-", (high < 0) & inside)):
                if holds.any():
                    found.setdefault(sign, same[int(holds.argmax())])
        return found
