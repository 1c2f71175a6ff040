"""The file that a failure leaves: everything needed to repeat it, and nothing about whose machine it was.

It has the robot exactly, how it was solved, the facts, the places in the program, the words of the command and the
versions; no environment variables, times, machine names or folders. The same failure gives the same file.
"""

from __future__ import annotations

import json
import platform
import sys
import tempfile
import traceback
from collections.abc import Sequence
from contextlib import suppress
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, Final

import pkm_exact
from pkm_exact.errors import InternalContradictionError, InternalError, UnexpectedError
from pkm_exact.failures.contradiction import CIRCUMSTANCES
from pkm_exact.files import write_whole

FORMAT: Final = "pkm_exact report"
_LIBRARIES: Final = ("python-flint", "numpy", "mpmath", "sympy", "click", "rich", "scipy")
_LONGEST_FACT: Final = 2000
_DIGITS: Final = 16
_FRAMES: Final = 40


def reported(error: BaseException, arguments: Sequence[str] = ()) -> str:
    """Write the report of a failure, and say in one sentence what happened and what to do with the file.

    Parameters
    ----------
    error : BaseException
    arguments : sequence of str
        The words of the command.
    """
    internal = internal_error(error)
    path = write_report(internal, arguments)
    kind = "two steps contradict each other" if isinstance(internal, InternalContradictionError) else "internal error"
    facts = ", ".join(f"{name} = {value}" for name, value in internal.facts.items()) or "none"
    remedy = (
        f"please attach the file {path} to a bug report"
        if path is not None
        else f"no report could be written, so please report this line, the command and the robot; facts: {facts}"
    )
    return f"{kind}: {internal}; {remedy}"


def internal_error(error: BaseException) -> InternalError:
    """The exception as one that can be sent from one process to another, with all that the report says.

    Examples
    --------
    >>> str(internal_error(ZeroDivisionError("division by zero")))
    'ZeroDivisionError: division by zero'
    """
    internal = error
    if not isinstance(internal, InternalError):
        detail = " ".join(_without_folders(str(error)).split())
        internal = UnexpectedError(f"{type(error).__name__}: {detail}" if detail else type(error).__name__)
    internal.facts = {name: _text(value) for name, value in internal.facts.items()}
    known = {"frames": _frames(error), **getattr(error, CIRCUMSTANCES, {})}
    setattr(internal, CIRCUMSTANCES, known)
    return internal


def write_report(error: InternalError, arguments: Sequence[str]) -> Path | None:
    """Write the report to the current folder, or to that for temporary files; None if neither can be written."""
    data = (json.dumps(report(error, arguments), indent=1) + "\n").encode("ascii")
    name = f"pkm_exact-report-{sha256(data).hexdigest()[:_DIGITS]}.json"
    for folder in (Path(), Path(tempfile.gettempdir())):
        try:
            write_whole(folder / name, data)
        except OSError:
            continue
        return folder / name
    return None


def report(error: InternalError, arguments: Sequence[str]) -> dict[str, Any]:
    """What the file says, as a JSON object."""
    known = getattr(error, CIRCUMSTANCES, {})
    return {
        "format": FORMAT,
        "version": 1,
        "kind": "contradiction" if isinstance(error, InternalContradictionError) else "unexpected",
        "sentence": str(error),
        "facts": error.facts,
        "stage": known.get("stage"),
        "problem": known.get("problem"),
        "options": known.get("options", {}),
        "frames": known.get("frames", []),
        "command": [_word(word) for word in arguments],
        "versions": _versions(),
    }


def _text(value: object) -> str:
    text = _without_folders(str(value))
    return text if len(text) <= _LONGEST_FACT else f"{text[:_LONGEST_FACT]}... ({len(text)} characters)"


def _word(word: str) -> str:
    """A word of the command; of an absolute path its last part only."""
    return Path(word).name if Path(word).is_absolute() else _without_folders(word)


def _without_folders(text: str) -> str:
    """The text without the names of folders that say who and where somebody is."""
    for find in (Path.cwd, Path.home, lambda: sys.prefix, tempfile.gettempdir):
        try:
            folder = str(find())
        except (OSError, RuntimeError):  # there may be none
            continue
        if len(folder) > 1:
            text = text.replace(folder, "...")
    return text


def _frames(error: BaseException) -> list[str]:
    """Where the exception came from: modules, lines and functions, without the folders they are in."""
    frames = traceback.extract_tb(error.__traceback__)[-_FRAMES:]
    return [f"{_module_path(frame.filename)}:{frame.lineno} in {frame.name}" for frame in frames]


def _module_path(name: str) -> str:
    """The path of a source file from its package on."""
    path = Path(name)
    for root in (Path(pkm_exact.__file__).parent.parent, *map(Path, sys.path)):
        if root.is_absolute() and path.is_relative_to(root):
            return path.relative_to(root).as_posix()
    return path.name


def _versions() -> dict[str, str]:
    found = {
        "pkm_exact": pkm_exact.__version__,
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        "system": f"{platform.system()} {platform.machine()}",
    }
    for library in _LIBRARIES:
        with suppress(PackageNotFoundError):
            found[library] = version(library)
    return found
