"""Workers on a Dask cluster, by its scheduler's address. The package distributed is imported here only.

Rows are sent some at a time, so that they go through arrays together. FLINT's working precision belongs to a process: a
process answers one after another, however many threads it has.
"""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from threading import Lock
from time import monotonic
from typing import Any, Final

import pkm_exact
from pkm_exact.batch.row_solver import TOGETHER
from pkm_exact.errors import InputError, PkmExactError
from pkm_exact.sweep.job import Answer, SweepJob
from pkm_exact.sweep.lengths import LengthRow
from pkm_exact.sweep.record import error_line
from pkm_exact.wording import printable

SECONDS: Final = 15
"""For the scheduler to answer, and as long again for its first worker."""
SENT_PER_THREAD: Final = 2
"""So many times some rows are sent: what comes next is there before an answer is fetched."""
SECONDS_WITHOUT_WORKERS: Final = 60

_one_row = Lock()


def solve_rows(job: SweepJob, rows: Sequence[LengthRow]) -> list[Answer]:
    """What a worker does."""
    with _one_row:
        return list(job.answers(rows))


def version() -> str:
    """The version of the package that a worker has."""
    return pkm_exact.__version__


@contextmanager
def cluster_workers(job: SweepJob, address: str) -> Iterator[ClusterWorkers]:
    """The workers of a cluster; rows that they still have are cancelled when the block is left.

    Raises
    ------
    InputError
        As ``connected_cluster``.
    PkmExactError
        If the cluster fails.
    """
    with connected_cluster(address) as (distributed, client):
        yield ClusterWorkers(distributed, client, job)


@contextmanager
def connected_cluster(address: str) -> Iterator[tuple[Any, Any]]:
    """The package distributed, and a client of the cluster; what it still has to do is cancelled at the end.

    Raises
    ------
    InputError
        If distributed is not installed, the scheduler cannot be reached, or it has no worker with this version.
    """
    try:
        import distributed
    except ImportError:
        raise InputError(
            "--scheduler: distributed is not installed; install it, for instance with pip install "
            '"pkm_exact[distributed]", or leave --scheduler out'
        ) from None
    disabled = logging.root.manager.disable
    logging.disable()  # what matters is said by exceptions
    try:
        client = _connected(distributed, address)
        try:
            _require_same_version(client, address)
            yield distributed, client
        finally:
            client.close(timeout=SECONDS)
    finally:
        logging.disable(disabled)


def _connected(distributed: Any, address: str) -> Any:
    try:
        return distributed.Client(address, timeout=SECONDS)
    except Exception as error:  # of any kind: after a client that failed, its loop may end in an assertion
        raise InputError(
            f"--scheduler {printable(address)}: cannot be reached within {SECONDS} seconds "
            f"({_reason(error)}); give the address that the scheduler prints, such as tcp://127.0.0.1:8786"
        ) from None


def _require_same_version(client: Any, address: str) -> None:
    """Other versions may give other bytes."""
    name = f"--scheduler {printable(address)}"
    try:
        client.wait_for_workers(1, timeout=SECONDS)
    except TimeoutError:
        raise InputError(f"{name}: has no workers; start some with: dask worker {printable(address)}") from None
    remedy = f"install pkm_exact {pkm_exact.__version__} there"
    try:
        versions: dict[str, str] = client.run(version)
    except Exception as error:
        raise InputError(f"{name}: a worker cannot load pkm_exact ({_reason(error)}); {remedy}") from None
    for worker, found in sorted(versions.items()):
        if found != pkm_exact.__version__:
            raise InputError(f"{name}: worker {worker} has pkm_exact {found}; {remedy}")


class ClusterWorkers:
    """The workers of a cluster that is connected."""

    def __init__(self, distributed: Any, client: Any, job: SweepJob) -> None:
        self._distributed, self._client, self._job = distributed, client, job
        self._rows: dict[Any, list[LengthRow]] = {}
        self._waiting: deque[LengthRow] = deque()
        self._most = SENT_PER_THREAD * max(1, sum(client.nthreads().values()))
        self.capacity = TOGETHER * self._most

    def submit(self, row: LengthRow) -> None:
        """Let them answer a row."""
        self._waiting.append(row)

    def _send(self) -> None:
        """All rows that wait, as many at a time as there are for each that can be sent."""
        while self._waiting:
            share = -(-len(self._waiting) // max(1, self._most - len(self._rows)))
            self._start([self._waiting.popleft() for _ in range(min(TOGETHER, share))])

    def _start(self, rows: list[LengthRow]) -> None:
        # The job is sent each time, 10 kB: what is scattered once is lost with the worker that has it.
        self._rows[self._client.submit(solve_rows, self._job, rows, pure=False, priority=-rows[0].number)] = rows

    def finished(self) -> list[Answer]:
        """Wait until at least one of the rows that they have is answered; those that are."""
        idle_since = None
        while True:
            self._send()
            answers = self._answers()
            if answers:
                return answers
            idle_since = None if self._client.nthreads() else idle_since or monotonic()
            if idle_since is not None and monotonic() - idle_since > SECONDS_WITHOUT_WORKERS:
                raise PkmExactError("the cluster has no workers any more; the same command goes on from here")

    def _answers(self) -> list[Answer]:
        """Those that are there or come soon."""
        try:
            done = self._distributed.wait(list(self._rows), timeout=SECONDS, return_when="FIRST_COMPLETED").done
            found = [(future, self._answers_of(future)) for future in done]
        except TimeoutError:
            return []
        except (Exception, self._distributed.CancelledError) as error:
            raise cluster_failure(error) from None
        for future, _ in found:
            del self._rows[future]
        return [answer for _, answers in found for answer in answers]

    def _answers_of(self, future: Any) -> list[Answer]:
        """The answers; a worker that has them and is killed before they are fetched costs time only."""
        try:
            answers: list[Answer] = future.result(timeout=SECONDS)
        except self._distributed.KilledWorker:
            first, *others = rows = self._rows[future]
            if others:
                for row in rows:
                    self._start([row])
                return []
            killed = "every worker of the cluster that tried it was killed"
            sentence = f"no answer: {killed}; perhaps the memory does not suffice"
            return [Answer(first.number, error_line(first, sentence))]
        return answers


def cluster_failure(error: BaseException) -> PkmExactError:
    return PkmExactError(f"the cluster failed ({_reason(error)}); the same command goes on from here")


def _reason(error: BaseException) -> str:
    lines = str(error).splitlines()
    return printable(lines[0]) if lines else type(error).__name__
