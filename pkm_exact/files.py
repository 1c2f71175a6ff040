"""Files that appear whole or not at all."""

from __future__ import annotations

import errno
import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from secrets import token_hex
from typing import Final

_DRAFT: Final = re.compile(r"\..*\.[0-9a-f]{16}\.tmp")


def write_whole(path: str | os.PathLike[str], data: bytes) -> None:
    """Write a file through a draft beside it, so that no reader ever sees half of it.

    Raises
    ------
    OSError
        If the file cannot be written; what stood there before is then untouched.
    """
    write_parts(path, (data,))


def write_parts(path: str | os.PathLike[str], parts: Iterable[bytes]) -> None:
    """The same of what comes in parts, which need not be in memory together.

    Raises
    ------
    OSError
        As ``write_whole``.
    """
    name = os.fsdecode(path)
    if "\0" in name:
        raise OSError(errno.EINVAL, "embedded null byte", name)
    target = Path(os.path.realpath(name))
    if target.exists() and not target.is_file():
        raise OSError(errno.EINVAL, "not a regular file", str(target))
    draft = target.with_name(f".{target.name[:100]}.{token_hex(8)}.tmp")
    try:
        with draft.open("xb") as stream:
            stream.writelines(parts)
            stream.flush()
            os.fsync(stream.fileno())
        draft.replace(target)
    finally:
        draft.unlink(missing_ok=True)


def write_all(folder: Path, files: Mapping[str, bytes]) -> None:
    """Write several files into a folder, made if it is not there: all of them, or none.

    Raises
    ------
    OSError
        If one cannot be written; what stood there before is then untouched.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as name:
    ...     write_all(Path(name) / "new", {"a": b"1", "b": b"2"})
    ...     sorted(path.name for path in (Path(name) / "new").iterdir())
    ['a', 'b']
    """
    missing = [path for path in (folder, *folder.parents) if not path.exists()]
    drafts: dict[Path, Path] = {}
    before: dict[Path, bytes | None] = {}
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, data in files.items():
            target = folder / name
            if target.exists() and not target.is_file():
                raise OSError(errno.EISDIR, os.strerror(errno.EISDIR), str(target))
            drafts[target] = folder / f".{name[:100]}.{token_hex(8)}.tmp"
            drafts[target].write_bytes(data)
        for target, draft in drafts.items():
            before[target] = target.read_bytes() if target.exists() else None
            draft.replace(target)
    except BaseException:
        for target, old in before.items():
            _put_back(target, old)
        for draft in drafts.values():
            draft.unlink(missing_ok=True)
        for path in missing:
            if path.is_dir():
                path.rmdir()
        raise


def _put_back(target: Path, data: bytes | None) -> None:
    if data is None:
        target.unlink(missing_ok=True)
    else:
        write_whole(target, data)


def remove_drafts(folder: Path) -> None:
    """Remove what a killed ``write_whole`` left in a folder to which nobody else writes."""
    for path in folder.iterdir():
        if _DRAFT.fullmatch(path.name):
            path.unlink(missing_ok=True)
