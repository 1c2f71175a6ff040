"""A sweep from its first row to its last: rows to the workers, answers into the journal, in the order of the rows."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any, Final, Protocol

from pkm_exact.claim import Claim
from pkm_exact.errors import InputError
from pkm_exact.files import remove_drafts, write_whole
from pkm_exact.sweep.job import Answer, SweepJob, identity
from pkm_exact.sweep.journal import Journal
from pkm_exact.sweep.lengths import LengthRow, LengthsFile
from pkm_exact.sweep.pose_table import pose_table

AHEAD: Final = 4096
"""Most answers that are kept because an earlier row is not answered."""


class Workers(Protocol):
    """Processes that answer rows of one job, in any order."""

    @property
    def capacity(self) -> int:
        """Number of rows that they can have at the same time."""
        ...

    def submit(self, row: LengthRow) -> None:
        """Let them answer a row."""
        ...

    def finished(self) -> list[Answer]:
        """Wait until at least one of the rows that they have is answered; those that are."""
        ...


@dataclass
class Tally:
    """What has been found so far.

    Attributes
    ----------
    claims : Counter
        Number of rows by claim.
    errors : int
        Number of rows without an answer.
    first_error : str or None
        What is wrong with the first of them.
    poses : int
        Number of real poses in all rows.
    """

    claims: Counter[str] = field(default_factory=Counter)
    errors: int = 0
    first_error: str | None = None
    poses: int = 0

    def add(self, record: dict[str, Any]) -> None:
        """Count the record of one more row."""
        if "error" in record:
            self.errors += 1
            self.first_error = self.first_error or record["error"]
        else:
            self.claims[record["claim"]] += 1
            self.poses += record["real_poses"]

    @property
    def rows(self) -> int:
        """Number of rows."""
        return self.errors + self.claims.total()

    @property
    def is_complete(self) -> bool:
        """Whether every row has an answer that leaves nothing open."""
        return self.rows == self.claims[Claim.COMPLETE] + self.claims[Claim.INCONSISTENT]


def sweep(
    job: SweepJob,
    lengths: LengthsFile,
    output: Path,
    workers: Callable[[SweepJob], AbstractContextManager[Workers]],
    *,
    certificates: Path | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Tally:
    """Answer all rows of a file, or those that an interrupted run has left; write the answers to the output.

    Parameters
    ----------
    job : SweepJob
    lengths : LengthsFile
    output : Path
        Appears when all rows are answered.
    workers : callable
        Of the job, gives the processes that answer its rows.
    certificates : Path, optional
        Folder for the certificates, one file per row that has one.
    progress : callable, optional
        Gets the number of rows that are answered and of those that an earlier run had answered.

    Raises
    ------
    InputError
        If the output or the folder cannot be used, or the file of lengths is changed in the meantime.
    PkmExactError
        If the workers fail as a whole. What is answered until then is kept.
    OSError
        If the output cannot be written; the same holds.
    """
    tally = Tally()

    def keep(record: dict[str, Any]) -> bool:
        if certificates is not None and "error" not in record and not (certificates / _name(record["row"])).exists():
            return False
        tally.add(record)
        return True

    with Journal(output, identity(job, lengths, certificates), keep) as journal:
        if certificates is not None:
            _prepare(certificates, journal)
        before = journal.rows
        if progress is not None:
            progress(before, before)
        rows = islice(lengths.rows(), before, None)
        with workers(job) as processes:
            for answer in _in_order(processes, rows, certificates, before + 1):
                journal.add(answer)
                tally.add(json.loads(answer))
                if progress is not None:
                    progress(journal.rows, before)
        journal.finish(partial(pose_table, job) if job.table else None)
    return tally


def _in_order(workers: Workers, rows: Iterator[LengthRow], certificates: Path | None, first: int) -> Iterator[bytes]:
    """The lines of the rows in their order. Of each row the certificate is written before its line is yielded."""
    ready: dict[int, bytes] = {}
    busy = 0
    while True:
        while busy < workers.capacity and len(ready) < AHEAD and (row := next(rows, None)) is not None:
            workers.submit(row)
            busy += 1
        if not busy:
            return
        for answer in workers.finished():
            busy -= 1
            if answer.certificate is not None and certificates is not None:
                write_whole(certificates / _name(answer.number), answer.certificate)
            ready[answer.number] = answer.line
        while first in ready:
            yield ready.pop(first)
            first += 1


def _name(number: int) -> str:
    return f"{number}.json"


def _prepare(folder: Path, journal: Journal) -> None:
    """A folder that has certificates of this job and no others."""
    try:
        folder.mkdir(exist_ok=True)
        if journal.is_new and any(folder.iterdir()):
            journal.remove()
            raise InputError(f"{folder}: is not empty; give --certificates a new folder, or empty it")
        remove_drafts(folder)
    except OSError as error:
        if journal.is_new:
            journal.remove()
        raise InputError(f"{folder}: cannot be used ({error.strerror}); give --certificates another path") from None
