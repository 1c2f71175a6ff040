"""The work that a checker does on one file, counted before it is done: what would take too long is not begun.

Nothing is timed, so that a verdict never depends on how busy a machine is. Work is estimated from sizes: bits,
dimensions, degrees, numbers of terms. One operation stands for about a nanosecond; ``docs/certificates.md`` has the
table of what costs how many.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Final

from pkm_exact.certify.checker.verdict import too_large

BASE: Final = 20 * 10**9
"""Operations allowed for any file."""
PER_BYTE: Final = 60 * 10**3
"""Operations allowed besides for each byte of a file."""


class Budget:
    """The operations allowed for a file of ``size`` bytes, and those charged so far.

    Examples
    --------
    >>> budget = Budget(1000)
    >>> budget.charge(10**9)
    >>> budget.spent, budget.limit
    (1000000000, 20060000000)
    """

    def __init__(self, size: int) -> None:
        self.size = size
        self.limit = BASE + PER_BYTE * size
        self.spent = 0
        self.attempt: int | None = None

    def charge(self, operations: int) -> None:
        """Count operations that are about to be done; refuses if they exceed what is left."""
        spent = self.spent + operations
        if self.attempt is not None and spent > self.attempt:
            raise TooMuchError
        self.spent = spent
        if spent > self.limit:
            raise too_large(
                f"work: checking takes more than {self.limit} operations, all that a file of {self.size} bytes may cost"
            )


class TooMuchError(Exception):
    """The part of a budget that may be spent on one attempt is spent."""


_IN_FORCE: Final[ContextVar[Budget | None]] = ContextVar("budget", default=None)


@contextmanager
def spending(budget: Budget) -> Iterator[None]:
    """Charge all that is done meanwhile to a budget."""
    token = _IN_FORCE.set(budget)
    try:
        yield
    finally:
        _IN_FORCE.reset(token)


@contextmanager
def attempting(divisor: int) -> Iterator[None]:
    """Let what is done meanwhile cost one part of so many of what the file may cost; ``TooMuchError`` beyond it."""
    budget = _IN_FORCE.get()
    if budget is None:
        yield
        return
    budget.attempt = budget.spent + budget.limit // divisor
    try:
        yield
    finally:
        budget.attempt = None


def charge(operations: int) -> None:
    """Charge operations, about to be done, to the budget in force; if there is none, as in tests of parts, nothing."""
    budget = _IN_FORCE.get()
    if budget is not None:
        budget.charge(operations)


def limbs(bits: int) -> int:
    """The words of 64 bits that a number takes."""
    return bits // 64 + 1


def polynomials_cost(terms: int, words: int) -> int:
    """Operations for a product of polynomials over Z: terms and greatest size of the larger factor, words of both."""
    total = terms * words
    return 3000 + 20 * total * total.bit_length()


def value_cost(terms: int, words: int, place: int) -> int:
    """Operations for the exact value of a polynomial over Z at a rational number of so many words."""
    return 3000 + terms * (500 + 3 * words + 2 * place * words) + terms * terms * place * (30 + place)


def ball_cost(words: int) -> int:
    """Operations for a product or a quotient of complex balls."""
    return 300 + words * (60 + words // 3)
