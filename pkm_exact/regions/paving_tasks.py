"""Parts of a region paved by many processes: in their order, and to the same words, as by one.

A part is a task until so many numbers were looked at for it. If it is not decided by then, every further level of it is
shared out in pieces, so that no part keeps one process at work while the others have nothing to do. Where a paving ends
follows from whole levels (``paving.Front``), however they were shared out.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from threading import Condition
from typing import Any, Final, Protocol

import numpy as np

from pkm_exact.regions.compiled_formula import Truth
from pkm_exact.regions.paving import Front, Part, Paved, Places, places_of, truths_at
from pkm_exact.regions.region_solver import PreparedQuestion, front_of

NUMBERS_OF_A_TASK: Final = 1 << 20
"""Coefficients that a task looks at, more or less: some hundredths of a second."""
LEAST_NUMBERS: Final = 1 << 18
"""Of a piece of a level: fewer take as long."""


class Future(Protocol):
    """Of ``concurrent.futures``, or of a cluster."""

    def result(self) -> Any:
        """What a task found."""
        ...

    def add_done_callback(self, fn: Callable[[Any], object], /) -> None:
        """Have a function called when the task is done, in any thread."""
        ...


@dataclass(frozen=True, eq=False)
class Task:
    """Parts that a process looks at.

    Attributes
    ----------
    part : Part
        Of which they are parts.
    depth : int
    places : array (n, k)
    is_whole : bool
        Whether they are all undecided ones of this depth: then the process goes on to what is below.
    """

    part: Part
    depth: int
    places: Places
    is_whole: bool


def done(ready: PreparedQuestion, task: Task) -> list[Truth]:
    """What is proved of the parts of a task, and of what is below: an array for each depth."""
    front, found, numbers = front_of(ready, task.part, task.depth, task.places), list[Truth](), 0
    while not front.is_ended and numbers < NUMBERS_OF_A_TASK:
        numbers += len(front.places) * ready.compiled.work
        found.append(truths_at(ready.compiled, ready.axes, front.depth, front.places))
        if not task.is_whole:
            break
        front.grow(found[-1])
    return found


def pieces_of(front: Front, part: Part, work: int, processes: int) -> list[Task]:
    """The next level of a paving, in tasks."""
    numbers = len(front.places) * work
    count = max(-(-numbers // NUMBERS_OF_A_TASK), min(2 * processes, numbers // LEAST_NUMBERS), 1)
    return [
        Task(part, front.depth, places, is_whole=count == 1)
        for places in np.array_split(front.places, min(count, len(front.places)))
    ]


@dataclass(eq=False)
class _Growing:
    """A part that is paved: what came of the pieces of its level, as far as it did."""

    front: Front
    found: list[list[Truth] | None] = field(default_factory=list)

    @property
    def is_complete(self) -> bool:
        return all(piece is not None for piece in self.found)

    def grow(self) -> None:
        pieces = [piece for piece in self.found if piece is not None]
        levels = pieces[0] if len(pieces) == 1 else [np.concatenate([piece[0] for piece in pieces])]
        for truths in levels:
            self.front.grow(truths)


class PartsInOrder(Iterator[Paved]):
    """Pavings of parts, in their order; work on them begins at once, on the first ones first.

    Parameters
    ----------
    ready : PreparedQuestion
    parts : sequence of Part
    submit : callable
        Gives a task to a process; gets the number of its part too.
    processes : int
    room : int
        How many tasks are with the processes at a time.
    """

    def __init__(
        self,
        ready: PreparedQuestion,
        parts: Sequence[Part],
        submit: Callable[[Task, int], Future],
        *,
        processes: int,
        room: int,
    ) -> None:
        self._ready, self._parts, self._submit = ready, parts, submit
        self._processes, self._room, self._sent = processes, room, 0
        self._changed = Condition()
        self._waiting: list[tuple[int, int, Task]] = []
        self._growing: dict[int, _Growing] = {}
        self._begun = self._given = 0
        self._paved: dict[int, Paved] = {}
        self._failure: BaseException | None = None
        self._is_closed = False
        with self._changed:
            self._fill()

    def __next__(self) -> Paved:
        if self._given == len(self._parts):
            raise StopIteration
        with self._changed:
            while self._given not in self._paved:
                if self._failure is not None:
                    raise self._failure
                self._changed.wait()
            self._given += 1
            return self._paved.pop(self._given - 1)

    def close(self) -> None:
        """Send no further tasks."""
        with self._changed:
            self._is_closed = True

    def _fill(self) -> None:
        while self._sent < self._room and not self._is_closed:
            if not self._waiting:
                if self._begun == len(self._parts):
                    return
                self._begin(self._begun)
                self._begun += 1
            number, place, task = heapq.heappop(self._waiting)
            self._sent += 1
            self._submit(task, number).add_done_callback(partial(self._take, number, place))

    def _begin(self, number: int) -> None:
        part = self._parts[number]
        self._growing[number] = _Growing(front_of(self._ready, part, part.depth, places_of(part)))
        self._share_out(number)

    def _share_out(self, number: int) -> None:
        growing = self._growing[number]
        tasks = pieces_of(growing.front, self._parts[number], self._ready.compiled.work, self._processes)
        growing.found = [None] * len(tasks)
        for place, task in enumerate(tasks):
            heapq.heappush(self._waiting, (number, place, task))

    def _take(self, number: int, place: int, future: Future) -> None:
        """What came of a task; whatever fails is said where the pavings are waited for."""
        with self._changed:
            self._sent -= 1
            if self._is_closed or self._failure is not None:
                return
            try:
                self._growing[number].found[place] = future.result()
                self._go_on(number)
                self._fill()
            except BaseException as error:  # a thread of the pool would lose it
                self._failure = error
            self._changed.notify_all()

    def _go_on(self, number: int) -> None:
        growing = self._growing[number]
        if not growing.is_complete:
            return
        growing.grow()
        if growing.front.is_ended:
            self._paved[number] = growing.front.paved
            del self._growing[number]
        else:
            self._share_out(number)
