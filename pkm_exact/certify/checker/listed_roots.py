"""The real roots of an integer polynomial, by intervals that a certificate lists, and which may be wrong.

If there are as many as real roots (``sturm``), no two overlap, and the polynomial changes its sign between the ends of
each, or is 0 where both are the same, then each has one root. If that is not so, or not found, the roots are isolated
without them (``descartes``): what is listed decides about the time alone. Intervals other than those that can be right
are not tried: from far too wide ones, or such with any denominators, it takes long to a root.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Final

from flint import fmpq, fmpz, fmpz_poly

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.descartes import MAX_ISOLATION, RealRoot, in_powers, real_roots, root_bound, signs_at
from pkm_exact.certify.checker.document import Ends
from pkm_exact.certify.checker.sturm import sturm_count

PARAMETER_EXPONENT: Final = 32
"""The parameter's grid is at least this fine: 2^-32."""
MOST_DIGITS: Final = 4000
"""Characters of an end that is read; those on a grid that roots are told apart on, and below 2^4096, have fewer."""


def number_of_real_roots(h: fmpz_poly) -> int:
    """The number of real roots of a squarefree polynomial of positive degree."""
    counted = _count(h)
    return len(real_roots(h)) if counted is None else counted


def roots_by_intervals(h: fmpz_poly, intervals: Sequence[Ends]) -> list[RealRoot]:
    """All real roots of a squarefree polynomial of positive degree, increasing: in these intervals, or isolated."""
    known = _read(intervals)
    if known is not None and len(known) == _count(h) and _are_apart(known):
        signs = signs_at(h, [end for ends in known for end in ends])
        found = [*zip(known, signs[::2], signs[1::2], strict=True)]
        if all(first * last == (0 if low == high else -1) for (low, high), first, last in found):
            return [RealRoot(h, *ends, first) for ends, first, _ in found]
    return real_roots(h)


def _count(h: fmpz_poly) -> int | None:
    """The number of real roots, if it is found; refuses if they are not bounded as they are where they are isolated."""
    m, powers = in_powers(h)
    root_bound(powers, m * MAX_ISOLATION)
    return sturm_count(h)


def _read(intervals: Sequence[Ends]) -> list[tuple[fmpq, fmpq]] | None:
    """The intervals, increasing, or None if they are not cells, or points, of one grid that roots are told apart on."""
    charge(20000 * len(intervals) + 1000 * sum(len(end) for ends in intervals for end in ends))
    if any(len(end) > MOST_DIGITS for ends in intervals for end in ends):
        return None
    known = sorted((_number(low), _number(high)) for low, high in intervals)
    finest = max((end.q for ends in known for end in ends), default=fmpz(1))
    is_grid = finest <= 1 << MAX_ISOLATION and not finest & finest - 1
    scale = max(finest, fmpz(1) << PARAMETER_EXPONENT)
    are_cells = all((high - low) * scale in (0, 1) and scale % low.q == 0 for low, high in known)
    return known if is_grid and are_cells else None


def _number(text: str) -> fmpq:
    numerator, _, denominator = text.partition("/")
    return fmpq(fmpz(numerator), fmpz(denominator or "1"))


def _are_apart(intervals: Sequence[tuple[fmpq, fmpq]]) -> bool:
    """Whether no two, and they are increasing, have more in common than an end."""
    return all(one[1] <= other[0] and one != other for one, other in pairwise(intervals))
