"""Progress on stderr: only where somebody looks at it, on one line that is overwritten, after the first second.

The line is written when a stage begins or tells how far it is, and now and then by a thread of its own, so that the
time goes on and a stage that says nothing is seen. FLINT lets no other thread run while it computes: during a long
step the line stands still.
"""

from __future__ import annotations

import sys
import threading
import time
from io import StringIO
from types import TracebackType
from typing import Final, TextIO

from pkm_exact.stages import Amount
from pkm_exact.wording import printable

PATIENCE: Final = 1.0
"""Seconds before anything is shown."""
_REFRESH: Final = 0.2
_WIDTH: Final = 78
_BAR: Final = 20
_ERASE: Final = "\r\x1b[K"
_BLANK: Final = f"\r{' ' * _WIDTH}\r"


class Progress:
    """A callable that shows the stage a solve is in, and how far it is; leaves nothing behind unless verbose.

    Parameters
    ----------
    verbose : bool
        Leave one line per stage.
    notebook : bool
        Show it in a notebook too, and not only on a terminal.

    Examples
    --------
    >>> with Progress(verbose=False) as progress:
    ...     progress("lifting")
    ...     progress.amount(Amount(1200, 5300, "bits", "about"))
    """

    def __init__(self, *, verbose: bool, notebook: bool = False) -> None:
        self._stream: TextIO = sys.stderr or StringIO()  # there is none in a program without a console
        terminal = self._stream.isatty()
        self._visible = terminal or (notebook and "ipykernel" in sys.modules)
        self._erase = _ERASE if terminal else _BLANK
        self._verbose = verbose
        self._start = time.monotonic()
        self._stage, self._amount = "", ""
        self._shown = False
        self._last = 0.0
        self._lock = threading.Lock()
        self._ended = threading.Event()

    def __enter__(self) -> Progress:
        if self._visible:
            threading.Thread(target=self._refresh, daemon=True).start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._ended.set()
        self.clear()

    def __call__(self, stage: str) -> None:
        """Show one stage."""
        if not self._visible:
            return
        with self._lock:
            self._stage, self._amount = printable(stage), ""
            if self._verbose:
                self._wipe()
                self._stream.write(f"{self._line()}\n")
                self._stream.flush()
        self._show()

    def amount(self, amount: Amount) -> None:
        """Show how much of the stage is done."""
        if not self._visible:
            return
        with self._lock:
            self._amount = f": {_bar(amount)}{printable(str(amount))}"
        self._show()

    def clear(self) -> None:
        """Take the line away, before something else is printed; the next stage or amount brings it back."""
        with self._lock:
            self._stage, self._amount = "", ""
            self._wipe()
            if self._visible:
                self._stream.flush()

    def _refresh(self) -> None:
        while not self._ended.wait(_REFRESH):
            self._show()

    def _show(self) -> None:
        with self._lock:
            now = time.monotonic()
            early = now - self._start < PATIENCE or now - self._last < _REFRESH / 4
            if early or self._ended.is_set() or not self._stage or (self._verbose and not self._amount):
                return
            self._last = now
            self._stream.write(f"{self._erase}{self._line()[:_WIDTH]}")
            self._stream.flush()
            self._shown = True

    def _wipe(self) -> None:
        if self._shown:
            self._stream.write(self._erase)
            self._shown = False

    def _line(self) -> str:
        return f"{time.monotonic() - self._start:6.1f} s  {self._stage}{self._amount}"


def _bar(amount: Amount) -> str:
    """A bar, where it is known how much there is to do.

    >>> _bar(Amount(10, 40, "paths"))
    '[=====               ] '
    """
    if not amount.total or amount.bound:
        return ""
    return f"[{'=' * (_BAR * min(amount.done, amount.total) // amount.total):<{_BAR}}] "
