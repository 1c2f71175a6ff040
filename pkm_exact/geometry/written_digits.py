"""How fine the decimals of a model file are written: what its numbers do not say lies below the last digit.

Integers and fractions are exact; a decimal may be a rounded one. Nothing here enters a proof or a certificate, where a
decimal is the rational number that it spells.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from fractions import Fraction

from pkm_exact.geometry.rational import NumberText

_DECIMAL = re.compile(r"[+-]?[0-9]+(?:\.(?P<decimals>[0-9]+))?(?:[eE](?P<power>[+-]?[0-9]{1,3}))?", re.ASCII)
_LABELS = ("name", "type")


def finest_digit(*values: object) -> Fraction | None:
    """The unit of the last decimal of the number that is written most finely; None if there are no decimals.

    Examples
    --------
    >>> str(finest_digit({"joints": [[NumberText("118.177"), 0], ["20.8", "1/3"]]}))
    '1/1000'
    >>> finest_digit([120, "1/3", {"name": "0.5"}]) is None
    True
    >>> str(finest_digit(NumberText("1.5e-3")))
    '1/10000'
    """
    return min((digit for value in values for digit in _digits(value)), default=None)


def _digits(value: object) -> Iterator[Fraction]:
    if isinstance(value, Mapping):
        for key, entry in value.items():
            if key not in _LABELS:
                yield from _digits(entry)
    elif isinstance(value, list | tuple):
        for entry in value:
            yield from _digits(entry)
    elif isinstance(value, str):
        found = _DECIMAL.fullmatch(value)
        if found is not None and (found["decimals"] or isinstance(value, NumberText)):
            yield Fraction(10) ** (int(found["power"] or 0) - len(found["decimals"] or ""))
