"""How long several workers would take for a question about a region, computed from the processor time of each task.

    python benchmarks/region_schedule.py [WORKERS] [DEGREES] [PRECISION]

The question of ``bench_region_workers.py``. Every task is done here, one after another, and given to the worker that is
free first, and costs a delay besides. What only the main process can do (make ready, the first parts) is added. Its
search for counterexamples goes on beside the tasks: there are as many cores as workers.
"""

from __future__ import annotations

import heapq
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from typing import Any

from bench_region_workers import MODEL, QUESTION

from pkm_exact import Robot
from pkm_exact.regions.largest_region import largest
from pkm_exact.regions.paving import Part, Paved, pave
from pkm_exact.regions.paving_tasks import PartsInOrder, Task, done
from pkm_exact.regions.question_reader import of_size, question_from_toml
from pkm_exact.regions.region_legs import region_machine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.regions.region_solver import HEAD_STEPS, PreparedQuestion, answered, prepared

DELAY = 0.0005
"""Seconds between two tasks of a worker."""


class Sent:
    """A task, and what is called when it is done."""

    def __init__(self, task: Task) -> None:
        self.task, self.found = task, list[Any]()
        self.call: Callable[[Any], object]

    def result(self) -> Any:
        """What the task found."""
        return self.found

    def add_done_callback(self, fn: Callable[[Any], object], /) -> None:
        """Remember it."""
        self.call = fn


class Schedule(Iterator[Paved]):
    """The pavings of a question's parts, by workers with a clock of their own.

    Attributes
    ----------
    clock : float
        When the last task is done.
    work, longest : float
        Processor time of all tasks, and of the longest.
    tasks : int
    """

    def __init__(self, workers: int, ready: PreparedQuestion, parts: Sequence[Part]) -> None:
        self.workers, self.ready, self.queue = workers, ready, list[Sent]()
        self.clock = self.work = self.longest = 0.0
        self.tasks = 0
        self.pavings = PartsInOrder(ready, parts, self.submit, processes=workers, room=2 * workers + 1)

    def submit(self, task: Task, _: int) -> Sent:
        """Put a task into the queue."""
        self.queue.append(Sent(task))
        return self.queue[-1]

    def __next__(self) -> Paved:
        self.do_all()
        return next(self.pavings)

    def do_all(self) -> None:
        """Do all tasks, each by the worker that is free first."""
        running: list[tuple[float, int, Sent]] = []
        while self.queue or running:
            while self.queue and len(running) < self.workers:
                sent, start = self.queue.pop(0), time.process_time()
                sent.found = done(self.ready, sent.task)
                used = time.process_time() - start
                self.tasks, self.work, self.longest = self.tasks + 1, self.work + used, max(self.longest, used)
                heapq.heappush(running, (self.clock + used + DELAY, self.tasks, sent))
            self.clock, _, sent = heapq.heappop(running)
            sent.call(sent)

    def close(self) -> None:
        """A counterexample was found among the first parts: what was not asked for is not done."""
        self.pavings.close()


class Run:
    """Makes schedules, and remembers the last one."""

    def __init__(self, workers: int) -> None:
        self.workers = workers
        self.last: Schedule | None = None

    def begin(self, _: RegionQuestion) -> None:
        """A new size: no schedule yet."""
        self.last = None

    def paved(self, ready: PreparedQuestion, parts: Sequence[Part]) -> Schedule:
        """A new schedule."""
        self.last = Schedule(self.workers, ready, parts)
        return self.last


def main() -> None:
    """Ask for each size that was asked for, and print what it takes."""
    given = sys.argv[1:4]
    workers, degrees, precision = (*given, *("2", "10", "1/1000")[len(given) :])
    machine, run = region_machine(Robot.load(MODEL)), Run(int(workers))
    asked = question_from_toml(QUESTION.format(degrees, precision), machine)
    sizes: list[Fraction] = []
    largest(machine, asked, lambda size: of_size(asked, machine, size), progress=lambda size, _: sizes.append(size))
    one = several = 0.0
    for size in sizes:
        question = of_size(asked, machine, size)
        start = time.process_time()
        ready = prepared(machine, question)
        pave(ready.compiled, ready.axes, Part(0, (0,) * len(ready.box)), HEAD_STEPS, most=question.answer.boxes)
        alone = time.process_time() - start
        answered(machine, question, run=run)
        here = time.process_time() - start - alone  # with all tasks
        last = run.last
        assert last is not None
        shared = max(last.clock, (here - alone) / run.workers)
        one, several = one + here, several + alone + shared
        print(
            f"edge {float(size):.1f}: {last.tasks} tasks, {last.work:.2f} s, the longest {last.longest:.3f} s, "
            f"schedule {last.clock:.2f} s; main process {here - last.work:.2f} s, of which {alone:.2f} s alone",
            flush=True,
        )
    print(f"one worker {one:.2f} s, {workers} workers {several:.2f} s, share {several / one:.3f}")


if __name__ == "__main__":
    main()
