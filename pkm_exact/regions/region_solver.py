"""Answers to questions about regions: all of it, or a map."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import chain, product
from typing import Any, Final, Protocol

from pkm_exact.errors import InputError
from pkm_exact.regions.chart import POSITIONS
from pkm_exact.regions.compiled_formula import CompiledFormula, compiled_formula
from pkm_exact.regions.formula import All, Formula, Some, atoms_of, beyond
from pkm_exact.regions.paving import (
    INSIDE,
    OUTSIDE,
    UNDECIDED,
    Front,
    Part,
    Paved,
    Places,
    depths_at,
    halving_axes,
    leaves,
    pave,
    places_of,
    spliced,
    truths_at,
)
from pkm_exact.regions.paving_tree import PavingTree
from pkm_exact.regions.region_conditions import Asked, asked_of
from pkm_exact.regions.region_legs import RegionMachine
from pkm_exact.regions.region_matrices import MOST_OF_DETERMINANT
from pkm_exact.regions.region_points import Counterexample, CounterexampleSearch, Point, PointJudge
from pkm_exact.regions.region_question import RegionQuestion

HEAD_STEPS: Final = 8
"""Halvings before the parts become jobs of their own: at most 2^8 of them."""
_LOOKED_AT: Final = 24
"""Parts of a depth, or of a job, in which a counterexample is looked for."""


class Store(Protocol):
    """What was done before an interruption."""

    records: list[dict[str, Any]]

    def add(self, record: dict[str, Any]) -> None:
        """Keep a record."""
        ...


@dataclass(frozen=True)
class RegionAnswer:
    """What was proved of a region.

    Attributes
    ----------
    question : RegionQuestion
    machine : RegionMachine
    axes : tuple of int
        Along which variable the parts of each depth were halved.
    word : str
        The paving (``paving``): of the answer "all" a part is inside if all its poses that lie in the region are good;
        of a map if all its poses lie in the region and are good.
    counterexample : Counterexample or None
        Then the answer is no.
    member : point or None
        A pose that the region has, if that had to be looked for.
    by_matrix : bool
        Whether the matrix of the constraints was proved to be regular, not its determinant to be not 0.
    """

    question: RegionQuestion
    machine: RegionMachine
    axes: tuple[int, ...]
    word: str
    counterexample: Counterexample | None = None
    member: Point | None = None
    by_matrix: bool = False

    @property
    def is_proved(self) -> bool:
        """Whether all of the region is proved to be good."""
        return self.counterexample is None and UNDECIDED not in self.word and OUTSIDE not in self.word

    @cached_property
    def counts(self) -> dict[str, int]:
        """Parts inside, outside and undecided."""
        return {name: self.word.count(letter) for letter, name in _NAMES.items()}

    @cached_property
    def shares(self) -> dict[str, Fraction]:
        """The same as shares of the box of the chart, exactly."""
        return dict(zip(_NAMES.values(), PavingTree(self.word).shares(tuple(_NAMES)), strict=True))

    @property
    def measures(self) -> tuple[Fraction, Fraction] | None:
        """Bounds of what is good: length, area or volume in rational coordinates; None if orientations vary.

        The ordinary measure is that times the square root of ``measure_square``.
        """
        chart = self.question.chart
        if not chart.has_fixed_orientation or self.question.answer.kind != "map":
            return None
        size = Fraction(1)
        for low, high in chart.box:
            size *= high - low
        return size * self.shares["inside"], size * (self.shares["inside"] + self.shares["undecided"])

    @property
    def measure_square(self) -> int:
        """The product of the metric over the variables."""
        square = 1
        for name in self.question.chart.variables:
            square *= self.machine.metric[POSITIONS.index(name)] if name in POSITIONS else 1
        return square


_NAMES: Final = {INSIDE: "inside", OUTSIDE: "outside", UNDECIDED: "undecided"}


@dataclass(frozen=True, eq=False)
class PreparedQuestion:
    """A question as formulas, exact and in doubles."""

    asked: Asked
    region: Formula
    compiled: CompiledFormula
    axes: tuple[int, ...]
    question: RegionQuestion

    @property
    def box(self) -> tuple[tuple[Fraction, Fraction], ...]:
        """That of the chart."""
        return self.question.chart.box


def prepared(machine: RegionMachine, question: RegionQuestion) -> PreparedQuestion:
    """A question made ready to be answered.

    Raises
    ------
    InputError
        If it is not one that regions know, or the robot's joints do not allow the region.
    """
    chart = question.chart
    asked = asked_of(machine, chart, question.conditions, most_of_determinant=MOST_OF_DETERMINANT)
    region = question.region(asked, machine.metric)
    if question.answer.kind == "map":
        formula: Formula = All((*region.parts, asked.formula))
    else:
        formula = Some((beyond(region), asked.formula)) if region.parts else asked.formula
    axes = axes_of(machine, chart.variables, chart.box, question.answer.steps)
    atoms = {id(atom): atom for atom in atoms_of(formula)}
    ready = compiled_formula(formula, list(atoms.values()), asked.roots, chart.box)
    return PreparedQuestion(asked, region, ready, axes, question)


def axes_of(
    machine: RegionMachine, names: Sequence[str], box: Sequence[tuple[Fraction, Fraction]], steps: int
) -> tuple[int, ...]:
    """Along which variable each halving is: of those of a chart, or others, which are turns."""
    size = max([abs(x) for leg in machine.legs for x in leg.platform] + [Fraction(0)]) or Fraction(1)
    weights = []
    for name, (low, high) in zip(names, box, strict=True):
        scale = machine.metric[POSITIONS.index(name)] if name in POSITIONS else size * size
        weights.append((high - low) ** 2 * scale)
    return halving_axes(weights, steps) if weights else ()


def points_of(box: Sequence[tuple[Fraction, Fraction]], axes: Sequence[int], part: Part) -> list[Point]:
    """The middle of a part, and its corners."""
    depths = depths_at(axes, part.depth, len(box))
    ends = [
        (low + (high - low) * Fraction(place, 1 << depth), low + (high - low) * Fraction(place + 1, 1 << depth))
        for (low, high), place, depth in zip(box, part.places, depths, strict=True)
    ]
    return [tuple((low + high) / 2 for low, high in ends), *product(*ends)]


class Pavings(Protocol):
    """Pavings of parts, in their order, as they come."""

    def __iter__(self) -> Iterator[Paved]:
        """Them."""
        ...

    def close(self) -> None:
        """Have no further ones made."""
        ...


class Run(Protocol):
    """Paves parts, in their order, here or elsewhere."""

    def begin(self, question: RegionQuestion) -> None:
        """Make ready for the parts of a question, while its first parts are paved here."""
        ...

    def paved(self, ready: PreparedQuestion, parts: Sequence[Part]) -> Pavings:
        """Pave parts; other processes begin at once."""
        ...


class InThisProcess:
    """Parts are paved one after another."""

    def begin(self, question: RegionQuestion) -> None:
        """Nothing is to be done."""

    def paved(self, ready: PreparedQuestion, parts: Sequence[Part]) -> Pavings:
        """Pave parts."""
        return (pave_part(ready, part) for part in parts)


IN_THIS_PROCESS: Final = InThisProcess()


def pave_part(ready: PreparedQuestion, part: Part) -> Paved:
    """The paving of a part that is a job of its own: it depends on nothing but the question and the part."""
    front = front_of(ready, part, part.depth, places_of(part))
    while not front.is_ended:
        front.grow(truths_at(ready.compiled, ready.axes, front.depth, front.places))
    return front.paved


def front_of(ready: PreparedQuestion, part: Part, depth: int, places: Places) -> Front:
    """Where the paving of a part has come: to these parts of it, all of a depth."""
    answer = ready.question.answer
    share = max(16, answer.boxes >> min(HEAD_STEPS, part.depth))
    return Front(ready.axes, depth, places, len(ready.axes), most=share, stop_outside=answer.kind != "map")


def answered(
    machine: RegionMachine,
    question: RegionQuestion,
    *,
    run: Run = IN_THIS_PROCESS,
    store: Store | None = None,
    progress: Callable[[Fraction], None] | None = None,
) -> RegionAnswer:
    """The answer to a question of the kinds "all" and "map".

    Parameters
    ----------
    machine : RegionMachine
    question : RegionQuestion
    run : Run
    store : Store, optional
        Gets the paving of each part; those in it are not paved again.
    progress : callable, optional
        Gets the share of the jobs that are done.

    Raises
    ------
    InputError
        As ``prepared``.
    """
    run.begin(question)
    ready = prepared(machine, question)
    search = CounterexampleSearch(PointJudge(ready.asked, ready.region), is_connected=question.is_connected)
    is_map = question.answer.kind == "map"
    member = _a_pose(ready) if question.joints and not is_map else None
    start = Part(0, (0,) * len(ready.box))
    last = min(HEAD_STEPS, len(ready.axes))
    head = pave(ready.compiled, ready.axes, start, last, most=question.answer.boxes, stop_outside=not is_map)
    result = RegionAnswer(question, machine, ready.axes, head.word, None, member, ready.asked.matrix is not None)
    is_whole = not head.open_parts or last == len(ready.axes)
    parts = [part for letter, part in leaves(head.word, ready.axes, len(ready.box)) if letter == UNDECIDED]
    stored = [record["word"] for record in store.records] if store is not None else []
    # Other processes begin while a counterexample is looked for here.
    pavings = run.paved(ready, [] if is_whole else parts[len(stored) :])
    try:
        if not is_map:
            _look(search, ready, head.word, start)
        if search.found is not None or is_whole:
            return replace(result, counterexample=search.found)
        words: list[str] = []
        rest = (paved.word for paved in pavings)
        for number, (part, word) in enumerate(zip(parts, chain(stored, rest), strict=True)):
            words.append(word)
            if store is not None and number >= len(stored):
                store.add({"part": number, "word": word})
            if progress is not None:
                progress(Fraction(number + 1, len(parts)))
            if not is_map and search.found is None:
                _look(search, ready, word, part)
        return replace(result, word=spliced(head.word, words), counterexample=search.found)
    finally:
        pavings.close()


def _a_pose(ready: PreparedQuestion) -> Point:
    """A pose of the region; joint values that no pose is shown to have are refused: all poses of nothing are good."""
    atoms = {id(atom): atom for atom in atoms_of(ready.region)}
    region = compiled_formula(ready.region, list(atoms.values()), ready.asked.roots, ready.box)
    start = Part(0, (0,) * len(ready.box))
    for last in range(0, len(ready.axes) + 1, 4):
        word = pave(region, ready.axes, start, last, most=ready.question.answer.boxes).word
        for letter, part in leaves(word, ready.axes, len(ready.box)):
            if letter == INSIDE:
                return points_of(ready.box, ready.axes, part)[0]
        if UNDECIDED not in word:
            break
    raise InputError(
        "region.joints: no pose of the shape is shown to have such joint values; give others or more steps"
    )


def _look(search: CounterexampleSearch, ready: PreparedQuestion, word: str, start: Part) -> None:
    """Look for a counterexample in parts that are not inside: first where they are outside."""
    found = leaves_below(word, ready.axes, start)
    for wanted in (OUTSIDE, UNDECIDED):
        chosen = [part for letter, part in found if letter == wanted]
        step = max(1, len(chosen) // _LOOKED_AT)
        for part in chosen[::step][: _LOOKED_AT + 1]:
            search.look_at(points_of(ready.box, ready.axes, part))
            if search.found is not None:
                return


def leaves_below(word: str, axes: Sequence[int], start: Part) -> list[tuple[str, Part]]:
    """The parts of a paving of a part."""
    return leaves(word, axes, len(start.places), start)
