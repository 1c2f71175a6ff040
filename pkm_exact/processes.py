"""Work in a process of its own, which can be ended at any time: FLINT cannot be interrupted otherwise."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing import get_context, parent_process
from multiprocessing.connection import Connection
from threading import Thread, current_thread, main_thread
from time import monotonic, sleep
from typing import Any

LONGEST_WAIT = 3600.0
"""Seconds of one wait for a message; a system call takes no arbitrarily large number."""
PATIENCE = 2.0
"""Seconds that a process has to end what it began (``end_in_order``) before it is killed."""


@contextmanager
def process_apart(work: Callable[..., None], *arguments: Any) -> Iterator[tuple[Connection, Any]]:
    """A new process that runs ``work(sender, *arguments)``, and the end of a pipe that receives what it sends.

    It is ended when the block is left. ``work`` should begin with ``end_with_parent()``.
    """
    context = get_context("spawn")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=work, args=(sender, *arguments), daemon=True)
    with interrupts_held():
        process.start()
    sender.close()
    try:
        yield receiver, process
    finally:
        process.terminate()
        process.join(PATIENCE)
        process.kill()
        process.join()
        receiver.close()


def messages(receiver: Connection, seconds: float | None) -> Iterator[Any]:
    """What the process sends, one after the other.

    Raises
    ------
    TimeoutError
        When the time is over.
    EOFError
        When the process has ended.
    """
    end = None if seconds is None else monotonic() + seconds
    while True:
        remaining = LONGEST_WAIT if end is None else end - monotonic()
        if remaining <= 0:
            raise TimeoutError
        if receiver.poll(min(remaining, LONGEST_WAIT)):
            yield receiver.recv()


def end_with_parent() -> None:
    """Let this process end when its parent does, even if that was killed."""
    Thread(target=_wait_for_parent, daemon=True).start()


def _wait_for_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os.kill(os.getpid(), signal.SIGTERM)
        sleep(PATIENCE)
        os._exit(1)


def end_in_order() -> None:
    """Let this process, when it is to end, end the programs that it runs, and remove its temporary folders.

    Where FLINT is at work, which cannot be interrupted, there are none, and it is killed after ``PATIENCE``.
    """
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))


@contextmanager
def signals_deferred() -> Iterator[None]:
    """Signals that end this process take effect when the block is left: what it starts is known by then.

    A program is started before ``Popen`` returns; a signal in between would leave it alone.
    """
    if current_thread() is not main_thread():  # signals are handled elsewhere
        yield
        return
    caught: list[int] = []
    before = {}
    for number in (signal.SIGINT, signal.SIGTERM):
        handler = signal.getsignal(number)
        if callable(handler):
            before[number] = handler
            signal.signal(number, lambda number, _: caught.append(number))
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        for late in caught:
            signal.raise_signal(late)


@contextmanager
def interrupts_held() -> Iterator[None]:
    """A process started here never sees the interrupt of the terminal: its parent does, and ends it."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
