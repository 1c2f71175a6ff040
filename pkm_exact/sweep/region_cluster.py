"""Parts of a region paved by the workers of a Dask cluster: in the same order, to the same words, as by one process."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from threading import Lock
from typing import Any, Final

from pkm_exact.regions.paving import Part, Paved
from pkm_exact.regions.region_legs import RegionMachine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.regions.region_solver import PreparedQuestion, Run
from pkm_exact.regions.region_workers import paved_part
from pkm_exact.sweep.cluster import cluster_failure, connected_cluster

PARTS_PER_THREAD: Final = 4
"""Parts that are sent at the same time."""

_one_part = Lock()


def pave_one(machine: RegionMachine, question: RegionQuestion, part: Part) -> Paved:
    """What a worker does: one part at a time, as FLINT's precision belongs to a process."""
    with _one_part:
        return paved_part((machine, question, part))


@contextmanager
def cluster_run(machine: RegionMachine, address: str) -> Iterator[Run]:
    """A way to pave parts on the cluster with this scheduler.

    Raises
    ------
    InputError
        As ``connected_cluster``.
    """
    with connected_cluster(address) as (distributed, client):
        yield _Cluster(distributed, client, machine)


@dataclass(frozen=True)
class _Cluster:
    """Workers that may come and go; each makes the question ready with its first part."""

    distributed: Any
    client: Any
    machine: RegionMachine

    def begin(self, question: RegionQuestion) -> None:
        """Nothing is sent before there are parts."""

    def paved(self, ready: PreparedQuestion, parts: Sequence[Part]) -> Iterator[Paved]:
        most = PARTS_PER_THREAD * max(1, sum(self.client.nthreads().values()))
        waiting: deque[Any] = deque()
        for number, part in enumerate(parts):
            job = self.client.submit(pave_one, self.machine, ready.question, part, pure=False, priority=-number)
            waiting.append(job)
            if len(waiting) >= most:
                yield _result(self.distributed, waiting.popleft())
        while waiting:
            yield _result(self.distributed, waiting.popleft())


def _result(distributed: Any, future: Any) -> Paved:
    try:
        found: Paved = future.result()
    except (Exception, distributed.CancelledError) as error:
        raise cluster_failure(error) from None
    return found
