"""Parts of a region paved by several processes: in the same order, and to the same words, as by one."""

from __future__ import annotations

import signal
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_all_start_methods, get_context
from typing import Any, Final, NamedTuple

from pkm_exact.processes import end_with_parent, interrupts_held
from pkm_exact.regions.compiled_formula import Truth
from pkm_exact.regions.paving import Part
from pkm_exact.regions.paving_tasks import PartsInOrder, Task, done
from pkm_exact.regions.region_legs import RegionMachine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.regions.region_solver import IN_THIS_PROCESS, Pavings, PreparedQuestion, Run, prepared

_AHEAD: Final = 2
"""Tasks for each process that are with the pool at a time: the next one is there before the last is fetched."""
_KEPT: dict[str, PreparedQuestion] = {}


@contextmanager
def workers(machine: RegionMachine, count: int) -> Iterator[Run]:
    """A way to pave parts with so many processes; with one, in this process.

    Parameters
    ----------
    machine : RegionMachine
    count : int
    """
    if count <= 1:
        yield IN_THIS_PROCESS
        return
    pool = ProcessPoolExecutor(count, mp_context=_context(), initializer=_begin)
    try:
        yield _Pool(pool, machine, count)
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def _context() -> Any:
    """Where there is a server of processes, it imports what they need, once for all."""
    if "forkserver" not in get_all_start_methods():
        return get_context("spawn")
    context = get_context("forkserver")
    context.set_forkserver_preload(["__main__", __name__])
    return context


class _Pool:
    """Processes of this machine; one that has nothing to do yet starts, and makes the question ready."""

    def __init__(self, processes: ProcessPoolExecutor, machine: RegionMachine, count: int) -> None:
        self._processes, self._machine, self._count = processes, machine, count

    def begin(self, question: RegionQuestion) -> None:
        sent = Sent.of(self._machine, question)
        with interrupts_held():
            for _ in range(self._count):
                self._processes.submit(_ready, sent)

    def paved(self, ready: PreparedQuestion, parts: Sequence[Part]) -> Pavings:
        sent = Sent.of(self._machine, ready.question)

        def submit(task: Task, _: int) -> Future[list[Truth]]:
            return self._processes.submit(task_done, sent, task)

        return PartsInOrder(ready, parts, submit, processes=self._count, room=_AHEAD * self._count + 1)


def _begin() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent ends this process
    end_with_parent()


class Sent(NamedTuple):
    """A question about a robot, as processes get it with every task, and what tells it from others."""

    key: str
    machine: RegionMachine
    question: RegionQuestion

    @classmethod
    def of(cls, machine: RegionMachine, question: RegionQuestion) -> Sent:
        """With its key."""
        return cls(repr((machine, question)), machine, question)


def task_done(sent: Sent, task: Task) -> list[Truth]:
    """What is proved in a task; what is ready for the question is kept for the next one."""
    return done(_KEPT[_ready(sent)], task)


def _ready(sent: Sent) -> str:
    """Make a question ready, if the last one was another; the key by which it is kept."""
    if sent.key not in _KEPT:
        _KEPT.clear()
        _KEPT[sent.key] = prepared(sent.machine, sent.question)
    return sent.key
