"""In which other unit lengths may be given, where they do not fit."""

from __future__ import annotations

from fractions import Fraction
from typing import Final

from pkm_exact.geometry.length_units import METRES

NAMES: Final = {"mm": "millimetres", "cm": "centimetres", "m": "metres", "in": "inches", "ft": "feet"}
_UNKNOWN: Final = (10, Fraction(1, 10), Fraction(127, 5), Fraction(5, 127), 1000, Fraction(1, 1000))


def factors_of(unit: str) -> list[tuple[Fraction, str]]:
    """Factors by which lengths are multiplied that are in another unit, and its name, those near 1 first.

    A unit that is not known has the same factors, without a name.

    Examples
    --------
    >>> [(str(factor), name) for factor, name in factors_of("mm")]
    [('10', 'centimetres'), ('127/5', 'inches'), ('1524/5', 'feet'), ('1000', 'metres')]
    """
    if unit not in METRES:
        return [(Fraction(factor), "") for factor in _UNKNOWN]
    found = [(METRES[other] / METRES[unit], NAMES[other]) for other in METRES if other != unit]
    return sorted(found, key=lambda pair: max(pair[0], 1 / pair[0]))


def times(factor: Fraction) -> str:
    """A factor as a decimal, or as one over a decimal.

    >>> [times(Fraction(x)) for x in ("1000", "127/5", "1/1000", "5/127")]
    ['1000', '25.4', '1/1000', '1/25.4']
    """
    return f"{float(factor):.6g}" if factor >= 1 else f"1/{float(1 / factor):.6g}"
