"""Where and with what a benchmark ran."""

from __future__ import annotations

import os
import platform
from collections.abc import Iterable
from datetime import date
from importlib import metadata
from pathlib import Path

import psutil
from programs import Program

LIBRARIES = ("python-flint", "numpy", "mpmath")


def machine(contenders: Iterable[Program]) -> dict[str, object]:
    """Date, processor, memory, load, and the versions of everything compared."""
    import flint

    libraries = {name: metadata.version(name) for name in LIBRARIES}
    programs = {contender.title: contender.version or "not installed" for contender in contenders}
    return {
        "date": date.today().isoformat(),
        "processor": _processor(),
        "cores": len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count(),
        "memory": f"{psutil.virtual_memory().total / 2**30:.0f} GiB",
        "system": f"{platform.system()} {platform.release()}, {platform.machine()}",
        "load at start": round(os.getloadavg()[0], 2),
        "versions": {"Python": platform.python_version(), "FLINT": flint.__FLINT_VERSION__, **libraries, **programs},
    }


def _processor() -> str:
    information = Path("/proc/cpuinfo")
    if information.is_file():
        for line in information.read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or "unknown"
