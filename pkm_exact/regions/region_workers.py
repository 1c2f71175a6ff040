"""Parts of a region paved by several processes: in the same order, and to the same words, as by one."""

from __future__ import annotations

import signal
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context

from pkm_exact.processes import end_with_parent
from pkm_exact.regions.paving import Part, Paved
from pkm_exact.regions.region_legs import RegionMachine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.regions.region_solver import PreparedQuestion, Run, in_this_process, pave_part, prepared

_PARTS_AT_ONCE = 4
_READY: dict[str, PreparedQuestion] = {}


@contextmanager
def workers(machine: RegionMachine, count: int) -> Iterator[Run]:
    """A way to pave parts with so many processes; with one, in this process.

    Parameters
    ----------
    machine : RegionMachine
    count : int
    """
    if count <= 1:
        yield in_this_process
        return
    pool = ProcessPoolExecutor(count, mp_context=get_context("spawn"), initializer=_begin)

    def run(ready: PreparedQuestion, parts: Sequence[Part]) -> Iterator[Paved]:
        return pool.map(paved_part, [(machine, ready.question, part) for part in parts], chunksize=_PARTS_AT_ONCE)

    try:
        yield run
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def _begin() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent ends this process
    end_with_parent()


def paved_part(job: tuple[RegionMachine, RegionQuestion, Part]) -> Paved:
    """The paving of a part of a question about a robot; what is ready for the question is kept for the next part."""
    machine, question, part = job
    key = repr((machine, question))
    if key not in _READY:
        _READY.clear()
        _READY[key] = prepared(machine, question)
    return pave_part(_READY[key], part)
