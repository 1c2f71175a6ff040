"""Signs of numbers of any kind that polytopes are made of: rational numbers, sums of square roots, balls."""

from __future__ import annotations

from typing import Any

from flint import arb

from pkm_exact.errors import PkmExactError
from pkm_exact.radicals import RootSum


class UndecidedError(PkmExactError):
    """An enclosure is too wide to tell the sign of a number: the polytope may be degenerate there."""


def sign(value: Any) -> int:
    """-1, 0 or 1: exactly, or proved of every number in a ball.

    Examples
    --------
    >>> from flint import arb
    >>> sign(RootSum.root(2) - RootSum.root(2)), sign(arb(3, 1))
    (0, 1)

    Raises
    ------
    UndecidedError
        If a ball has numbers of both signs.
    """
    if isinstance(value, RootSum):
        return value.sign()
    if isinstance(value, arb):
        if value > 0 or value < 0:
            return 1 if value > 0 else -1
        if value == 0:
            return 0
        raise UndecidedError("the pose is not enclosed narrowly enough to tell which faces the polytope has")
    return int(value > 0) - int(value < 0)
