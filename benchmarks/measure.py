"""One command as a whole process: wall clock, processor time and peak memory, within a time limit.

The command is started by a bare Python, this very file, because a process inherits the peak memory of the one that
starts it: what is below some 10 MB cannot be told.
"""

from __future__ import annotations

import json
import os
import resource
import signal
import sys
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

SAMPLING = 0.02
"""Seconds between two looks at the memory of a family of processes."""
UNIT = 1 if sys.platform == "darwin" else 1024
"""Bytes in the unit of ``ru_maxrss``."""


@dataclass(frozen=True)
class Run:
    """What one run of a command took.

    Attributes
    ----------
    seconds, processor : float
        Wall clock, and processor time of user and system.
    memory : int
        Peak resident memory in bytes: of the largest process, or summed over the family if that was asked for.
    code : int or None
        Exit code; None if the time limit ended it.
    output : str
        What it printed, errors too.
    """

    seconds: float
    processor: float
    memory: int
    code: int | None
    output: str


def run(command: Sequence[str], limit: float, folder: Path, *, source: Path | None = None, family: bool = False) -> Run:
    """Run a command in a folder, with a file as its input; measure its children with it if they are a family."""
    import subprocess

    launcher = [sys.executable, "-E", *([] if family else ["-S"]), __file__, str(limit), str(int(family))]
    with (folder / "stdout").open("w+b") as output, (source or folder / os.devnull).open("rb") as given:
        done = subprocess.run(
            [*launcher, *command], cwd=folder, stdin=given, stdout=output, stderr=subprocess.PIPE, check=True
        )
        output.seek(0)
        text = output.read().decode(errors="replace")
    return Run(**json.loads(done.stderr.splitlines()[-1]), output=text)


def main(arguments: Sequence[str]) -> int:
    """Start the command, wait for it, and write what it took to stderr."""
    limit, family, command = float(arguments[0]), arguments[1] == "1", arguments[2:]
    before = time.perf_counter()
    child = os.fork()
    if child == 0:
        os.setsid()
        os.dup2(1, 2)
        os.execvp(command[0], command)
    is_over: list[bool] = []

    def end() -> None:
        is_over.append(True)
        os.killpg(child, signal.SIGKILL)

    timer = threading.Timer(limit, end)
    timer.start()
    peaks = [0]
    if family:
        threading.Thread(target=_watch, args=(child, peaks), daemon=True).start()
    _, status, usage = os.wait4(child, 0)
    seconds = time.perf_counter() - before
    timer.cancel()
    memory = max(usage.ru_maxrss * UNIT, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * UNIT, *peaks)
    code = None if is_over else os.waitstatus_to_exitcode(status)
    taken = {"seconds": seconds, "processor": usage.ru_utime + usage.ru_stime, "memory": memory, "code": code}
    sys.stderr.write("\n" + json.dumps(taken) + "\n")
    return 0


def _watch(child: int, peaks: list[int]) -> None:
    """Keep the greatest sum of the resident memory of a process and its descendants."""
    import psutil

    while True:
        try:
            parent = psutil.Process(child)
            peaks.append(max(peaks.pop(), sum(_resident(each) for each in (parent, *parent.children(recursive=True)))))
        except psutil.NoSuchProcess:
            return
        time.sleep(SAMPLING)


def _resident(process: object) -> int:
    import psutil

    try:
        return int(process.memory_info().rss)  # type: ignore[attr-defined]
    except psutil.Error:
        return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
