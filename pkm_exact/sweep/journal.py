"""What a sweep has found so far, in two files beside its output: an interrupted run goes on from there.

OUT.partial has the lines of the output and becomes the output when it is complete, by being renamed; a table is made of
it. OUT.journal says to which job they belong, and has for every line a digest of all lines up to it: a line that was
cut off or changed, and what follows it, is dropped and answered again. Both only grow. As long as a run lasts, it holds
a lock on the journal.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Iterable
from hashlib import sha256
from pathlib import Path
from time import monotonic
from types import TracebackType
from typing import BinaryIO, Final

from pkm_exact.errors import InputError
from pkm_exact.files import write_parts
from pkm_exact.sweep.lock import lock
from pkm_exact.wording import printable

FORMAT: Final = "pkm_exact interrupted sweep"
DIGITS: Final = 16
"""Hexadecimal digits of a line's digest."""
SECONDS_PER_SYNC: Final = 2.0


class Journal:
    """The finished rows of a job, in their order.

    Parameters
    ----------
    output : Path
        The file that appears when all rows are there.
    job : str
        A digest of everything that the output depends on.
    keep : callable
        Gets every line of earlier runs, as a JSON object; where it says no, lines are dropped from there on.

    Attributes
    ----------
    rows : int
        Number of rows that are finished.
    is_new : bool
        Whether there was no earlier run.

    Raises
    ------
    InputError
        If there are rows of another job, another run is at work, or the files cannot be used.
    """

    def __init__(self, output: Path, job: str, keep: Callable[[dict[str, object]], bool]) -> None:
        self.output = output = Path(os.path.realpath(output))  # a link stays one, and leads to the finished file
        self.rows_path = output.with_name(f"{output.name}.partial")
        self.journal_path = output.with_name(f"{output.name}.journal")
        self.rows = 0
        self._digest = b""
        self._synced = monotonic()
        if output.exists() and not output.is_file():
            raise InputError(f"{output}: is not a regular file; give -o the path of one")
        try:
            self._journal = self._locked()
            try:
                self.is_new = not self._belongs(json.dumps({"format": FORMAT, "job": job}).encode("ascii") + b"\n")
                self._lines = self.rows_path.open("r+b" if self.rows_path.exists() else "w+b")
                self._go_on(keep)
            except BaseException:
                self._journal.close()
                raise
        except OSError as error:
            raise InputError(f"{self.journal_path}: cannot be used ({error.strerror}); give -o another path") from None

    def __enter__(self) -> Journal:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._lines.close()
        self._journal.close()

    def _locked(self) -> BinaryIO:
        """The journal, which no other run has; not one that was removed in the meantime."""
        while True:
            descriptor = os.open(self.journal_path, os.O_RDWR | os.O_CREAT | getattr(os, "O_BINARY", 0), 0o666)
            stream = os.fdopen(descriptor, "r+b")
            if not lock(descriptor):
                stream.close()
                raise InputError(
                    f"{printable(str(self.output))}: another run is writing it; wait for that, or give -o another path"
                )
            if self.journal_path.exists() and os.path.samestat(os.fstat(descriptor), self.journal_path.stat()):
                return stream
            stream.close()

    def _belongs(self, header: bytes) -> bool:
        """Whether the journal has a header, which must be this one; otherwise it is written."""
        found = self._journal.readline(1 << 12)
        if found == header:
            return True
        if header.startswith(found) and not self.rows_path.exists():
            self._journal.seek(0)
            self._journal.truncate()
            self._write(self._journal, header)
            return False
        if not found and self.rows_path.exists():
            # Not to be taken for a journal later: it was made by the attempt to lock it.
            self.journal_path.unlink()
            raise InputError(f"{self.rows_path}: is in the way and no interrupted run; move it or give -o another path")
        if b'"format": "' + FORMAT.encode() not in found:
            raise InputError(f"{self.journal_path}: is no interrupted run; move it away or give -o another path")
        raise InputError(
            f"{self.journal_path}: belongs to an interrupted run of another model, file of lengths, option or version; "
            f"finish that, or remove this file and {self.rows_path.name}, or give -o another path"
        )

    def _go_on(self, keep: Callable[[dict[str, object]], bool]) -> None:
        """Find the lines that are good, and drop what comes after them."""
        kept, entries = 0, self._journal.tell()
        while True:
            line, entry = self._lines.readline(), self._journal.readline(2 * DIGITS)
            digest = _chained(self._digest, line)
            if not line.endswith(b"\n") or entry != digest or not keep(json.loads(line)):
                break
            self._digest = digest
            self.rows += 1
            kept, entries = kept + len(line), entries + len(entry)
        for stream, size in ((self._lines, kept), (self._journal, entries)):
            stream.truncate(size)
            stream.seek(size)

    def add(self, line: bytes) -> None:
        """Keep the line of the next row."""
        self._digest = _chained(self._digest, line)
        self._write(self._lines, line)
        self._write(self._journal, self._digest)
        self.rows += 1
        if monotonic() - self._synced > SECONDS_PER_SYNC:
            self._sync()

    def _write(self, stream: BinaryIO, data: bytes) -> None:
        stream.write(data)
        stream.flush()

    def _sync(self) -> None:
        """See to it that the rows survive a loss of power."""
        for stream in (self._lines, self._journal):
            os.fsync(stream.fileno())
        self._synced = monotonic()

    def finish(self, spelled: Callable[[Iterable[bytes]], Iterable[bytes]] | None = None) -> None:
        """The rows are complete: they become the output, or it is made of them."""
        self._sync()
        if spelled is not None:
            self._lines.seek(0)
            write_parts(self.output, spelled(self._lines))
        self._lines.close()
        if spelled is None:
            self.rows_path.replace(self.output)
        self.remove()

    def remove(self) -> None:
        """Remove what is beside the output."""
        self._lines.close()
        self.rows_path.unlink(missing_ok=True)
        if sys.platform == "win32":  # where an open file cannot be removed; elsewhere the lock is held until it is gone
            self._journal.close()
        self.journal_path.unlink(missing_ok=True)


def _chained(before: bytes, line: bytes) -> bytes:
    """The entry of a line in the journal."""
    return sha256(before + line).hexdigest()[:DIGITS].encode("ascii") + b"\n"
