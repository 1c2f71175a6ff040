"""A second count of real roots: that there is none between the intervals of those that were isolated.

Descartes' rule of signs after a Moebius transformation that takes an interval to (0, oo), with bisection (Vincent;
Collins and Akritas 1976), in ball arithmetic of a fixed precision: it decides most gaps in one step, and says so where
it does not decide. It shares nothing with the enclosures of all complex roots, from which the roots were isolated.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Final

from flint import arb, arb_poly, fmpz_poly

from pkm_exact.balls import ball
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval

PRECISION: Final = 256
DEPTH: Final = 12
"""Bisections of a gap, one inside the other."""


def roots_in_gaps(polynomial: fmpz_poly, intervals: Sequence[Interval]) -> list[bool | None]:
    """Whether a polynomial has a real root before, between and after some intervals; None where it is not decided.

    Parameters
    ----------
    polynomial : fmpz_poly
        Squarefree.
    intervals : sequence of Interval
        Disjoint, from left to right.

    Examples
    --------
    >>> place = Interval(Fraction(0), Fraction(1, 2))
    >>> roots_in_gaps(fmpz_poly([-1, 3, 0, 1]), [place]), roots_in_gaps(fmpz_poly([6, -11, 6, -1]), [place])
    ([False, False], [False, True])
    """
    with working_precision(PRECISION):
        # Rounded first: the arithmetic that follows is then one of short numbers.
        rounded = arb_poly([arb(coefficient) * 1 for coefficient in polynomial.coeffs()])
        degree = int(polynomial.degree())
        if not intervals:
            if not polynomial[0]:
                return [True]
            below = _ray(rounded, degree, Fraction(0), -1)
            return [below if below is not False else _ray(rounded, degree, Fraction(0), 1)]
        gaps = [_ray(rounded, degree, intervals[0].lo, -1)]
        for left, right in pairwise(intervals):
            low, high = ball(left.hi), ball(right.lo)
            gaps.append(_decided(rounded(arb_poly([low, high - low])), degree, DEPTH))
        gaps.append(_ray(rounded, degree, intervals[-1].hi, 1))
        return gaps


def _ray(polynomial: arb_poly, degree: int, start: Fraction, sign: int) -> bool | None:
    """The same for the numbers beyond the start: x / (1 - x) takes (0, 1) to them."""
    moved = polynomial(arb_poly([ball(start), sign]))
    changes = _changes(moved)
    if changes in (0, 1):
        return changes == 1
    return _decided(_reversed(_reversed(moved, degree)(arb_poly([-1, 1])), degree), degree, DEPTH)


def _decided(polynomial: arb_poly, degree: int, depth: int) -> bool | None:
    """Whether there is a root between 0 and 1."""
    changes = _changes(_reversed(polynomial, degree)(arb_poly([1, 1])))
    if changes in (0, 1):
        return changes == 1
    if depth == 0:
        return None
    left = polynomial(arb_poly([0, arb(1) / 2]))
    if left(arb(1)).contains(0):  # one half may be a root itself
        return None
    found = _decided(left, degree, depth - 1)
    return found if found is not False else _decided(left(arb_poly([1, 1])), degree, depth - 1)


def _reversed(polynomial: arb_poly, degree: int) -> arb_poly:
    values = polynomial.coeffs()
    return arb_poly([*[arb(0)] * (degree + 1 - len(values)), *values[::-1]])


def _changes(polynomial: arb_poly) -> int | None:
    """Changes of sign in the coefficients; None if a sign is not known."""
    signs = []
    for value in polynomial.coeffs():
        if value > 0 or value < 0:
            signs.append(bool(value > 0))
        elif not value.is_zero():
            return None
    return sum(left != right for left, right in pairwise(signs))
