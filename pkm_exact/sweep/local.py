"""Worker processes on this machine, each with some rows at a time, of which it finds at once what can be.

A worker that is killed, because memory ran out perhaps, takes down the row that it is at, and no other: when all other
rows are finished this one is tried once more alone, and then given up.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from typing import Any, cast

from pkm_exact.batch.row_solver import TOGETHER
from pkm_exact.errors import PkmExactError
from pkm_exact.processes import end_with_parent, process_apart
from pkm_exact.sweep.job import Answer, SweepJob
from pkm_exact.sweep.lengths import LengthRow
from pkm_exact.sweep.record import error_line


@contextmanager
def local_workers(job: SweepJob, count: int) -> Iterator[LocalWorkers]:
    """Processes that answer rows of a job; they are killed when the block is left."""
    workers = LocalWorkers(job, count)
    try:
        yield workers
    finally:
        workers.close()


class LocalWorkers:
    """Up to ``count`` processes, started when there is work for them."""

    def __init__(self, job: SweepJob, count: int) -> None:
        self._job, self._count = job, count
        self._idle: list[_Worker] = []
        self._busy: dict[Connection, tuple[_Worker, deque[LengthRow]]] = {}
        self._waiting: deque[LengthRow] = deque()
        self._suspects: deque[LengthRow] = deque()
        self._alone: LengthRow | None = None

    @property
    def capacity(self) -> int:
        """Number of rows that they can have at the same time: those of each, and as many that wait for it."""
        return 2 * TOGETHER * self._count

    def submit(self, row: LengthRow) -> None:
        """Let them answer a row."""
        self._waiting.append(row)

    def finished(self) -> list[Answer]:
        """Wait until at least one of the rows that they have is answered; those that are."""
        answers: list[Answer] = []
        while not answers:
            self._assign()
            for ready in wait(list(self._busy)):
                answer = self._received(cast(Connection, ready))
                if answer is not None:
                    answers.append(answer)
        self._assign()
        return answers

    def _received(self, ready: Connection) -> Answer | None:
        """The answer of a worker that has sent something, or has come to an end."""
        worker, rows = self._busy[ready]
        message = worker.receive()
        if message is True:
            return None
        row = rows.popleft()
        if isinstance(message, Answer):
            if not rows:
                del self._busy[ready]
                self._alone = None
                self._idle.append(worker)
            return message
        del self._busy[ready]
        is_alone, self._alone = row is self._alone, None
        if is_alone:
            return _given_up(row, worker)
        self._suspects.append(row)
        self._waiting.extendleft(reversed(rows))
        return None

    def _assign(self) -> None:
        """Give rows to workers that have none; a suspect gets the machine for itself."""
        if self._suspects:
            if not self._busy:
                self._alone = self._suspects.popleft()
                self._start([self._alone])
            return
        while self._waiting and self._alone is None and len(self._busy) < self._count:
            share = -(-len(self._waiting) // (self._count - len(self._busy)))
            self._start([self._waiting.popleft() for _ in range(min(TOGETHER, share))])

    def _start(self, rows: list[LengthRow]) -> None:
        worker = self._idle.pop() if self._idle else _Worker(self._job)
        self._busy[worker.receiver] = worker, deque(rows)
        worker.send(rows)

    def close(self) -> None:
        """End all processes."""
        for worker in (*self._idle, *(worker for worker, _ in self._busy.values())):
            worker.close()


class _Worker:
    """One process, and the two pipes to it."""

    def __init__(self, job: SweepJob) -> None:
        self._stack = ExitStack()
        theirs, self._sender = get_context("spawn").Pipe(duplex=False)
        self._stack.callback(self._sender.close)
        self.receiver, self._process = self._stack.enter_context(process_apart(_serve, theirs, job))
        theirs.close()
        self._is_ready = False

    def send(self, rows: list[LengthRow]) -> None:
        """Give it some rows; if it is not there any more, ``receive`` will tell."""
        with suppress(BrokenPipeError):
            self._sender.send(rows)

    def receive(self) -> Answer | bool:
        """What it sent: True when it is there, then answers; False if it has come to an end."""
        try:
            message: Answer | bool = self.receiver.recv()
        except (EOFError, ConnectionResetError):
            self._process.join()
            self.close()
            if self._is_ready:
                return False
            raise PkmExactError(
                f"a worker process ended with code {self.code} before it began; the same command goes on from here"
            ) from None
        self._is_ready = True
        return message

    @property
    def code(self) -> Any:
        """The exit code of the process, when it has ended."""
        return self._process.exitcode

    def close(self) -> None:
        """End the process."""
        self._stack.close()


def _given_up(row: LengthRow, worker: _Worker) -> Answer:
    sentence = (
        f"no answer: its process was killed twice (code {worker.code}), the second time with no other row at work; "
        "perhaps the memory does not suffice"
    )
    return Answer(row.number, error_line(row, sentence))


def _serve(sender: Connection, receiver: Connection, job: SweepJob) -> None:
    """What a process does: a sign that it is there, then an answer for every row."""
    end_with_parent()
    sender.send(True)
    while True:
        try:
            rows: list[LengthRow] = receiver.recv()
        except EOFError:
            return
        for answer in job.answers(rows):
            sender.send(answer)
