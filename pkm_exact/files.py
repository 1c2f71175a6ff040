"""Files that appear whole or not at all."""

from __future__ import annotations

import errno
import os
import re
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
    name = os.fsdecode(path)
    if "\0" in name:
        raise OSError(errno.EINVAL, "embedded null byte", name)
    target = Path(os.path.realpath(name))
    if target.exists() and not target.is_file():
        raise OSError(errno.EINVAL, "not a regular file", str(target))
    draft = target.with_name(f".{target.name[:100]}.{token_hex(8)}.tmp")
    try:
        with draft.open("xb") as stream:
            stream.write(data)
            stream.flush()
            os.fsync(stream.fileno())
        draft.replace(target)
    finally:
        draft.unlink(missing_ok=True)


def remove_drafts(folder: Path) -> None:
    """Remove what a killed ``write_whole`` left in a folder to which nobody else writes."""
    for path in folder.iterdir():
        if _DRAFT.fullmatch(path.name):
            path.unlink(missing_ok=True)
