"""What is proved of conditions all over a part of a paving."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, Final

from pkm_exact.certify.checker.region_coefficients import Part
from pkm_exact.certify.checker.region_document import RegionDocument
from pkm_exact.certify.checker.region_regular import Regular
from pkm_exact.certify.checker.region_ring import Condition, Deferred, Signed

LETTER: Final = 40_000
"""Operations for a letter of a paving, beside the polynomials that it needs."""

Ranges = Callable[[Signed | Regular], tuple[int, int]]


def ranges_on(part: Part, document: RegionDocument, roots: Sequence[Any]) -> Ranges:
    """What gives the least and the greatest coefficient of a test on a part, times something positive.

    Of a matrix that is proved to be regular 1 and 1, of another one 0 and 0.
    """
    ends: list[tuple[Fraction, Fraction]] = []
    ranges: dict[int, tuple[int, int]] = {}

    def range_of(test: Signed | Regular) -> tuple[int, int]:
        polynomial = test if isinstance(test, Regular) else test.polynomial
        key = id(polynomial)
        if key not in ranges:
            if not ends:
                ends.extend(part.root_ends(root, document.box) for root in roots)
            ranges[key] = part.table(polynomial, document.box).range_of(ends)
        return ranges[key]

    return range_of


def is_proved(condition: Condition, range_of: Ranges, *, wanted: bool) -> bool:
    """Whether a condition is proved to hold all over a part, or if not ``wanted`` to hold nowhere in it."""
    if isinstance(condition, Regular):
        return wanted and range_of(condition) == (1, 1)
    if isinstance(condition, Signed):
        low, high = range_of(condition)
        if condition.sign == "/":
            return wanted and (low > 0 or high < 0)
        if wanted:
            return bool(low > 0 if condition.sign == "+" else low >= 0)
        return bool(high <= 0 if condition.sign == "+" else high < 0)
    if isinstance(condition, Deferred):
        return is_proved(condition.condition, range_of, wanted=wanted)
    word, parts = condition
    some = (word == "or") is wanted
    results = (is_proved(part, range_of, wanted=wanted) for part in parts)
    return any(results) if some else all(results)
