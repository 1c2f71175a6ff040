"""Progress of a solve on stderr: only on a terminal, one line that is overwritten, or one per stage if verbose."""

from __future__ import annotations

import sys
import time
from types import TracebackType

from pkm_exact.wording import printable

_ERASE = "\r\x1b[K"


class Progress:
    """A callable that shows the stage a solve is in; leaves nothing behind unless verbose.

    Examples
    --------
    >>> with Progress(verbose=False) as progress:
    ...     progress("lifting")
    """

    def __init__(self, *, verbose: bool) -> None:
        self._visible = sys.stderr.isatty()
        self._verbose = verbose
        self._start = time.monotonic()

    def __enter__(self) -> Progress:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._visible and not self._verbose:
            sys.stderr.write(_ERASE)
            sys.stderr.flush()

    def __call__(self, stage: str) -> None:
        """Show one stage."""
        if not self._visible:
            return
        line = f"{time.monotonic() - self._start:6.1f} s  {printable(stage)}"
        sys.stderr.write(f"{line}\n" if self._verbose else f"{_ERASE}{line[:78]}")
        sys.stderr.flush()
