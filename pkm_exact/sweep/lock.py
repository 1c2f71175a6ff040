"""A lock on an open file that ends with the process, however that ends."""

from __future__ import annotations

import sys
from typing import Final

_FAR_AWAY: Final = 1 << 40
"""Where a byte is locked that the file does not have, so that others may read the file."""

if sys.platform == "win32":
    import msvcrt
    import os

    def lock(descriptor: int) -> bool:
        """Lock an open file; False if another process has locked it."""
        os.lseek(descriptor, _FAR_AWAY, os.SEEK_SET)
        try:
            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        except OSError:
            return False
        finally:
            os.lseek(descriptor, 0, os.SEEK_SET)
        return True

else:
    import fcntl

    def lock(descriptor: int) -> bool:
        """Lock an open file; False if another process has locked it."""
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True
