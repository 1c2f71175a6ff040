"""What ``track`` has found so far, in a file beside its output: an interrupted run goes on from there.

One line per row of the path. Each carries a digest of all lines up to it, so that a line that was cut off or changed,
and what follows it, is dropped and computed again. The first line says which job the file belongs to.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from types import TracebackType
from typing import Any, Final

from pkm_exact.errors import InputError

FORMAT: Final = "pkm_exact interrupted track"
SUFFIX: Final = ".partial"


class TrackStore:
    """The records of a job, in the order of the rows; ``records`` are those of earlier runs and of this one.

    Parameters
    ----------
    output : Path
        The file that the job will write; records stand in a file of the same name with ``.partial`` after it.
    job : str
        Everything that the result depends on.

    Raises
    ------
    InputError
        If there are records of another job, or the file cannot be used.
    """

    def __init__(self, output: Path, job: str) -> None:
        self.path = output.with_name(output.name + SUFFIX)
        self.records: list[dict[str, Any]] = []
        self._digest = _chained("", {"format": FORMAT, "job": sha256(job.encode()).hexdigest()})
        header = {"format": FORMAT, "digest": self._digest}
        try:
            kept = self._read(header)
            self._stream = self.path.open("r+b" if kept else "wb")
            if kept:
                self._stream.truncate(kept)
                self._stream.seek(kept)
            else:
                self._write(header)
        except OSError as error:
            raise InputError(f"{self.path}: cannot be used ({error.strerror}); give -o another path") from None

    def __enter__(self) -> TrackStore:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stream.close()

    def _read(self, header: Mapping[str, Any]) -> int:
        """Read the records; return the number of bytes that are good."""
        if not self.path.exists():
            return 0
        lines = self.path.read_bytes().split(b"\n")[:-1]  # what follows the last line feed was cut off
        first = _parsed(lines[0]) if lines else None
        if first is None or first.get("format") != FORMAT:
            if any(lines):
                raise InputError(f"{self.path}: is no interrupted run; move it away or give -o another path")
            return 0
        if first != header:
            raise InputError(
                f"{self.path}: belongs to an interrupted run of another model, path or option; finish that, or remove "
                "the file, or give -o another path"
            )
        kept = len(lines[0]) + 1
        for line in lines[1:]:
            record = _parsed(line)
            digest = None if record is None else record.pop("digest", None)
            if record is None or digest != _chained(self._digest, record):
                break
            self._digest = digest
            self.records.append(record)
            kept += len(line) + 1
        return kept

    def add(self, record: dict[str, Any]) -> None:
        """Keep a record."""
        self._digest = _chained(self._digest, record)
        self._write({**record, "digest": self._digest})
        self.records.append(record)

    def _write(self, content: Mapping[str, Any]) -> None:
        self._stream.write(json.dumps(content).encode("ascii") + b"\n")
        self._stream.flush()

    def remove(self) -> None:
        """Remove the file: the output is written."""
        self._stream.close()
        self.path.unlink(missing_ok=True)

    def sync(self) -> None:
        """See to it that the records survive a loss of power."""
        os.fsync(self._stream.fileno())


def _parsed(line: bytes) -> dict[str, Any] | None:
    try:
        content = json.loads(line)
    except ValueError:
        return None
    return content if isinstance(content, dict) else None


def _chained(before: str, record: Mapping[str, Any]) -> str:
    return sha256(f"{before}\n{json.dumps(record)}".encode("ascii")).hexdigest()[:32]
