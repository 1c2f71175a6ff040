"""One formulation in a process of its own, which can be ended when its time is over."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import get_context, parent_process
from multiprocessing.connection import Connection
from threading import Thread
from time import monotonic
from typing import Any

from pkm_exact.comparison.measure import measure
from pkm_exact.comparison.row import ResultFigures, Row, Status, SystemFigures
from pkm_exact.errors import InputError, PkmExactError
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.poses.pose import Pose

LONGEST_WAIT = 3600.0
"""Seconds of one wait for a message; a system call takes no arbitrarily large number."""


@dataclass(frozen=True)
class Outcome:
    """A row whose agreement is not decided yet, and the real poses that decide it; None if they cannot be compared."""

    row: Row
    poses: tuple[Pose, ...] | None = None


def run_apart(
    problem: ForwardProblem, code: str, seconds: float | None, progress: Callable[[str], None] | None = None
) -> Outcome:
    """The outcome of one formulation, measured in a new process that is killed after the given time."""
    context = get_context("spawn")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_work, args=(sender, problem, code), daemon=True)
    with _interrupts_held():
        process.start()
    sender.close()
    try:
        return _outcome(receiver, process, code, seconds, progress or (lambda _: None))
    finally:
        process.kill()
        process.join()
        receiver.close()


def _outcome(
    receiver: Connection, process: Any, code: str, seconds: float | None, progress: Callable[[str], None]
) -> Outcome:
    system: SystemFigures | None = None
    stage = "start"
    end = None if seconds is None else monotonic() + seconds
    while True:
        remaining = LONGEST_WAIT if end is None else end - monotonic()
        if remaining <= 0:
            reason = f"it did not end within {seconds:g} seconds; it was at the stage: {stage}"
            return Outcome(Row(code, Status.TIMEOUT, reason, system))
        if not receiver.poll(min(remaining, LONGEST_WAIT)):
            continue
        try:
            message = receiver.recv()
        except EOFError:
            process.join()
            reason = f"its process ended with code {process.exitcode} at the stage: {stage}"
            return Outcome(Row(code, Status.NO_ANSWER, reason, system))
        match message:
            case SystemFigures():
                system = message
            case str():
                stage = message
                progress(f"{code}: {stage}")
            case Status() as status, str(reason):
                return Outcome(Row(code, status, reason, system))
            case ResultFigures() as figures, tuple() as poses:
                compared = None if figures.real_poses is None else poses
                return Outcome(Row(code, Status.DONE, None, system, figures), compared)


def _work(sender: Connection, problem: ForwardProblem, code: str) -> None:
    """What the process does: messages on the way, and at the end figures and poses or a sentence."""
    Thread(target=_end_with_parent, daemon=True).start()
    try:
        sender.send(measure(problem, code, written=sender.send, progress=sender.send))
    except InputError as error:
        sender.send((Status.NOT_APPLICABLE, str(error)))
    except PkmExactError as error:
        sender.send((Status.NO_ANSWER, str(error)))
    except MemoryError:
        sender.send((Status.NO_ANSWER, "the memory is exhausted"))


def _end_with_parent() -> None:
    """Leave nothing running behind a parent that was killed."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


@contextmanager
def _interrupts_held() -> Iterator[None]:
    """A process started here never sees the interrupt of the terminal: its parent does, and ends it."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
