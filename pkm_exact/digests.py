"""A number that follows from data: what random choices start from, so that no data can be built on them.

A choice that is the same for every input, such as a prime written into the program, can be made a bad one by an input
that was built for it. A choice that follows from a digest of the input is the same whenever the input is, and changes
with every change of it.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from hashlib import sha256
from typing import TypeAlias

Data: TypeAlias = int | str | Fraction | Iterable["Data"]


def digest(*data: Data) -> int:
    """256 bits that follow from numbers, words and sequences of them, and from nothing else.

    Examples
    --------
    >>> digest(1, Fraction(1, 2)) == digest(1, Fraction(2, 4)), digest((1, 2), 3) == digest(1, (2, 3))
    (True, False)
    """
    return int.from_bytes(sha256(_spelled(data).encode()).digest(), "big")


def _spelled(data: Data) -> str:
    if type(data) is int:
        return f"{data:x}"
    if isinstance(data, str):
        return repr(data)
    if isinstance(data, Fraction):
        return f"{data.numerator:x}/{data.denominator:x}"
    if isinstance(data, int):
        return f"{data:x}"
    return f"({','.join(map(_spelled, data))})"
