"""Parts of a region paved by the workers of a Dask cluster: in the same order, to the same words, as by one process."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from threading import Lock
from typing import Any, Final

from pkm_exact.regions.compiled_formula import Truth
from pkm_exact.regions.paving import Part, Paved
from pkm_exact.regions.paving_tasks import PartsInOrder, Task
from pkm_exact.regions.region_legs import RegionMachine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.regions.region_solver import Pavings, PreparedQuestion, Run
from pkm_exact.regions.region_workers import Sent, task_done
from pkm_exact.sweep.cluster import cluster_failure, connected_cluster

TASKS_PER_THREAD: Final = 4
"""Tasks that are sent at the same time."""

_one_task = Lock()


def do_one(sent: Sent, task: Task) -> list[Truth]:
    """What a worker does: one task at a time, as FLINT's precision belongs to a process."""
    with _one_task:
        return task_done(sent, task)


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
    """Workers that may come and go; each makes the question ready with its first task."""

    distributed: Any
    client: Any
    machine: RegionMachine

    def begin(self, question: RegionQuestion) -> None:
        """Nothing is sent before there are parts."""

    def paved(self, ready: PreparedQuestion, parts: Sequence[Part]) -> Pavings:
        threads = max(1, sum(self.client.nthreads().values()))
        sent = Sent.of(self.machine, ready.question)

        def submit(task: Task, number: int) -> Any:
            return self.client.submit(do_one, sent, task, pure=False, priority=-number)

        room = TASKS_PER_THREAD * threads
        return _OfCluster(ready, parts, submit, processes=threads, room=room, lost=self.distributed.CancelledError)


class _OfCluster(PartsInOrder):
    """Pavings whose failures are those of the cluster."""

    def __init__(self, *given: Any, lost: type[BaseException], **named: Any) -> None:
        self._lost = lost
        super().__init__(*given, **named)

    def __next__(self) -> Paved:
        try:
            return super().__next__()
        except StopIteration:
            raise
        except (Exception, self._lost) as error:
            raise cluster_failure(error) from None
