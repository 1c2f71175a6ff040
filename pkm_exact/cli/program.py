"""What the commands tell their caller: names of the programs, exit codes, and keys of click's context."""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum

PROGRAM = "certify-poses"
ROOTS = "certify-roots"
"""The program for polynomial systems."""
COMPLETIONS = {PROGRAM: "_CERTIFY_POSES_COMPLETE", ROOTS: "_CERTIFY_ROOTS_COMPLETE"}
"""The environment variables by which a shell's completion script asks."""
PROBLEM = "pkm_exact.problem"
"""Where a command leaves in its context which problem it is about, for the report of a failure."""


class ExitCode(IntEnum):
    """What the process tells its caller."""

    DONE = 0
    REJECTED = 1
    BAD_INPUT = 2
    WEAKER_CLAIM = 3
    NO_ANSWER = 4
    INTERRUPTED = 130
    BROKEN_PIPE = 141


def worst(codes: Sequence[ExitCode]) -> ExitCode:
    """One exit code for many files: a rejected one counts most.

    Examples
    --------
    >>> worst([ExitCode.DONE, ExitCode.NO_ANSWER, ExitCode.REJECTED])
    <ExitCode.REJECTED: 1>
    """
    return ExitCode.REJECTED if ExitCode.REJECTED in codes else max(codes)
