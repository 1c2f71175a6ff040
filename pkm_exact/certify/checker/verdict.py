"""What the checker answers, and the limits beyond which it does not start to work."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

MAX_BYTES: Final = 64 << 20
"""Largest certificate, in bytes."""

MAX_ENTRIES: Final = 1 << 20
"""Most commas and brackets in a certificate; bounds the work of reading it."""

MAX_DEGREE: Final = 2000
"""Largest degree of an eliminant."""

MAX_COEFFICIENT_BITS: Final = 1 << 18
"""Largest coefficient of a polynomial, in bits."""

MAX_RATIONAL_LENGTH: Final = 10_000
"""Longest rational number, in characters."""

MAX_BOX_EXPONENT: Final = 8192
"""Finest grid of boxes: 2^-8192."""

MAX_GRID_EXPONENT: Final = 2048
"""Finest grid of the boxes of Krawczyk's operator: 2^-2048."""

GREATEST_NUMBER: Final = 40
"""Degree of the variety of rigid motions: no robot has more isolated poses, real or complex."""

PLANAR_NUMBER: Final = 6
"""Degree of the variety of planar motions."""

MAX_PRECISION: Final = 1 << 14
"""Highest precision of an enclosure, in bits."""

MAX_ELIMINATION_ROWS: Final = 5000
"""Most rows of a matrix of an elimination."""

MAX_ELIMINATION_ENTRIES: Final = 1 << 22
"""Most entries of a matrix of an elimination, zeros included."""

MAX_ELIMINATION_TERMS: Final = 1 << 20
"""Most terms of all elements of an elimination, and of the products of a step."""

MAX_TEXT: Final = 10_000
"""Longest text (names, source, notes), in characters."""


class Status(StrEnum):
    """The checker's answer.

    ``ACCEPTED``: everything that the certificate claims was proved again, from the robot and the polynomials alone.
    ``REJECTED``: at least one claim could not be proved. It may be false, or the proof in the file defective.
    ``MALFORMED``: the file is not a certificate of a version that this checker knows.
    ``TOO_LARGE``: checking it would exceed a limit; neither proved nor refuted.
    """

    ACCEPTED = "accepted"
    REJECTED = "rejected"
    MALFORMED = "malformed"
    TOO_LARGE = "too-large"


@dataclass(frozen=True)
class Verdict:
    """The answer and its reasons; true only if the certificate was accepted.

    Attributes
    ----------
    status : Status
    lines : tuple of str
        One line per claim that was proved, in the order of the checks; the last one says why the certificate was not
        accepted, if it was not. No line contains free text of the file.

    Examples
    --------
    >>> print(Verdict(Status.REJECTED, ("digest: differs from the content",)))
    digest: differs from the content
    rejected
    """

    status: Status
    lines: tuple[str, ...]

    def __bool__(self) -> bool:
        return self.status is Status.ACCEPTED

    def __str__(self) -> str:
        return "\n".join((*self.lines, self.status))


class Refusal(Exception):  # noqa: N818 - not an error of the program, the end of a check
    """Ends a check; ``check_bytes`` turns it into a verdict."""

    def __init__(self, status: Status, line: str) -> None:
        super().__init__(line)
        self.status = status
        self.line = line


def rejected(line: str) -> Refusal:
    """The refusal of a claim that does not hold or is not proved."""
    return Refusal(Status.REJECTED, line)


def malformed(line: str) -> Refusal:
    """The refusal of something that is not a certificate."""
    return Refusal(Status.MALFORMED, line)


def too_large(line: str) -> Refusal:
    """The refusal to work on something that exceeds a limit."""
    return Refusal(Status.TOO_LARGE, line)
