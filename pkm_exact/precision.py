"""FLINT's working precision, of which a process has one for all its threads: they take turns.

Without turns, what a thread encloses at many bits could be computed at the few bits of another: right, but wider, so
that a proof fails or a certificate has other bytes. Nothing is lost by them: FLINT lets no other thread run meanwhile.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from threading import RLock

from flint import ctx

_turn = RLock()


@contextmanager
def working_precision(bits: int | None = None) -> Iterator[None]:
    """A block in which FLINT computes with so many bits, and in which no other thread changes that.

    Parameters
    ----------
    bits : int, optional
        By default those that it has; blocks inside may have others.

    Examples
    --------
    >>> from flint import arb
    >>> with working_precision(100):
    ...     (arb(1) / 3).rel_accuracy_bits() > 90
    True
    """
    with _turn, ctx.workprec(ctx.prec if bits is None else bits):
        yield


def _renew() -> None:
    """A process that was forked has only the thread that did it: nobody else would ever give the turn back."""
    global _turn
    _turn = RLock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_renew)
