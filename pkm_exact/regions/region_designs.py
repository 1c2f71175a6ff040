"""For which designs a question about all of a region is answered yes: boxes of parameters, each proved.

The parameters are variables of the polynomials beside those of the poses. A box of designs is good if all parts of
region times box are; it is bad if the conditions hold nowhere in one of them, or if the determinant of the constraints
is positive all over one and negative all over another: so for every design in the box there is a pose that is not good,
or two poses between which there is one, as the region is connected. Other boxes are halved.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
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
    """

    keys: tuple[str, ...]
    boxes: tuple[DesignBox, ...]

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
    while level:
        undecided = []
        for part in level:
            verdict = search.verdict(part)
            if verdict == OPEN:
                undecided.append(part)
                continue
            found.append(DesignBox(search.ends(part), verdict))
            if progress is not None:
                progress(len(found))
        if level[0].depth == search.deepest or len(found) + 2 * len(undecided) > MOST_BOXES:
            found += [DesignBox(search.ends(part), OPEN) for part in undecided]
            break
        level = [half for part in undecided for half in _halves(part, part.depth % search.count)]
    keys = tuple(key for key, _ in question.answer.parameters)
    return Designs(keys, tuple(sorted(found, key=lambda box: box.ends)))


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
        names = tuple(f"p{k}" for k in range(1, self.count + 1))
        parameters = tuple(Parameter(name, key) for name, (key, _) in zip(names, wanted.parameters, strict=True))
        wide = replace(
            chart, variables=(*chart.variables, *names), box=(*chart.box, *self._boxes), parameters=parameters
        )
        ready = prepared(machine, replace(question, chart=wide))
        self._compiled, self._variables = ready.compiled, len(wide.variables)
        self._inner = axes_of(machine, chart.variables, chart.box, wanted.steps)
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

    def verdict(self, part: Part) -> str:
        """Of all designs in a part: first with few halvings of the region, then with all that are allowed."""
        outer = list(islice(cycle(range(self._variables - self.count, self._variables)), part.depth))
        axes = (*outer, *self._inner)
        places = (0,) * (self._variables - self.count) + part.places
        start = Part(part.depth, places)
        for last in dict.fromkeys((min(_FIRST_STEPS, len(self._inner)), len(self._inner))):
            word = pave(self._compiled, axes, start, part.depth + last, most=self._most, stop_outside=True).word
            if OUTSIDE in word:
                return NO
            if UNDECIDED not in word:
                return YES
            good = [leaf for letter, leaf in leaves(word, axes, self._variables, start) if letter == INSIDE]
            if self._changes_sign(good, axes):
                return NO
        return OPEN

    def _changes_sign(self, parts: Sequence[Part], axes: Sequence[int]) -> bool:
        """Whether the determinant is positive all over one part of the region, and negative all over another."""
        return any(len(self._signs(atom, parts, axes)) == 2 for atom in self._determinants)

    def _signs(self, atom: Atom, parts: Sequence[Part], axes: Sequence[int]) -> set[int]:
        found: set[int] = set()
        polynomial, _ = self._compiled.atoms[id(atom)]
        by_depth: dict[int, list[Part]] = {}
        for part in parts:
            by_depth.setdefault(part.depth, []).append(part)
        for depth, same in by_depth.items():
            view = View(
                depths_at(axes, depth, self._variables), np.array([part.places for part in same], dtype=np.int64)
            )
            low, high = view.range_of(polynomial, self._compiled.root_ends(view))
            inside = np.ones(len(same), dtype=bool) if self._region is None else self._region.truths_in(view) > 0
            found |= {1} if bool(((low > 0) & inside).any()) else set()
            found |= {-1} if bool(((high < 0) & inside).any()) else set()
        return found
