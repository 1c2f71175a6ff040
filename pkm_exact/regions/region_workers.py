"""Parts of a region paved by several processes: in the same order, and to the same words, as by one."""

from __future__ import annotations

import signal
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import get_context

from pkm_exact.processes import end_with_parent
from pkm_exact.regions.paving import Part, Paved
from pkm_exact.regions.region_legs import RegionMachine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.regions.region_solver import IN_THIS_PROCESS, PreparedQuestion, Run, pave_part, prepared

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
    pool = ProcessPoolExecutor(count, mp_context=get_context("spawn"), initializer=_begin)
    try:
        yield _Pool(pool, machine, count)
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


@dataclass(frozen=True)
class _Pool:
    """Processes of this machine; one that has nothing to do yet starts, and makes the question ready."""

    processes: ProcessPoolExecutor
    machine: RegionMachine
    count: int

    def begin(self, question: RegionQuestion) -> None:
        for _ in range(self.count):
            self.processes.submit(_ready, self.machine, question)

    def paved(self, ready: PreparedQuestion, parts: Sequence[Part]) -> Iterator[Paved]:
        jobs = [(self.machine, ready.question, part) for part in parts]
        return self.processes.map(paved_part, jobs, chunksize=1)


def _begin() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent ends this process
    end_with_parent()


def paved_part(job: tuple[RegionMachine, RegionQuestion, Part]) -> Paved:
    """The paving of a part of a question about a robot; what is ready for the question is kept for the next part."""
    machine, question, part = job
    return pave_part(_KEPT[_ready(machine, question)], part)


def _ready(machine: RegionMachine, question: RegionQuestion) -> str:
    """Make a question ready, if the last one was another; the key by which it is kept."""
    key = repr((machine, question))
    if key not in _KEPT:
        _KEPT.clear()
        _KEPT[key] = prepared(machine, question)
    return key
