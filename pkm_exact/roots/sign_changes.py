"""All real roots of an integer polynomial by Descartes' rule of signs, in balls: quicker than all complex ones.

After a Moebius transformation that takes an interval to (0, oo), no change of sign in the coefficients proves that
there is no root in it, and one that there is one (Vincent; Collins and Akritas 1976). Coefficients are balls; where one
of their signs is not known, all is done again with twice as many bits. The roots of a polynomial in T^m are found as
m-th roots.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import gcd
from typing import Final

from flint import arb, arb_poly, fmpq, fmpz, fmpz_poly

from pkm_exact.precision import working_precision

MOST_BITS: Final = 1 << 14
"""Beyond, nothing is said."""
MOST_HALVINGS: Final = 400
_STEPS: Final = 12
"""Steps of Newton's method before an interval is halved once more."""
_ODD: Final = fmpq(1009, 1000)
"""The first interval is so much longer than a power of 2: rational roots are no ends of halves then."""


def descartes_enclosures(polynomial: fmpz_poly, bits: int) -> list[arb] | None:
    """A ball around each real root of a squarefree polynomial, increasing; None if it is not decided.

    Each ball has one root and is at most 2^-bits times as wide as an interval in which the root is isolated.

    Examples
    --------
    >>> [round(float(ball.mid()), 6) for ball in descartes_enclosures(fmpz_poly([0, -2, 0, 1]), 64)]
    [-1.414214, 0.0, 1.414214]
    """
    m = gcd(*(power for power, value in enumerate(polynomial.coeffs()) if value))
    if m > 1:
        return _roots_of(descartes_enclosures(fmpz_poly(polynomial.coeffs()[::m]), bits), m, 2 * bits)
    values = [int(value) for value in polynomial.coeffs()]
    zeros = [arb(0)] if not values[0] else []
    if zeros:
        values = values[1:]
    if len(values) < 2:
        return zeros
    reach = fmpq(2) ** _exponent(values) * _ODD
    precision = 4 * bits
    while precision <= MOST_BITS:
        with working_precision(precision):
            sides = [_positive_roots(_on_unit_interval(values, sign * reach), bits) for sign in (-1, 1)]
            if None not in sides:
                below, above = ([place * arb(reach) for place in side or ()] for side in sides)
                return [*(-place for place in reversed(below)), *zeros, *above]
        precision *= 2
    return None


def _roots_of(powers: Sequence[arb] | None, m: int, precision: int) -> list[arb] | None:
    """The real m-th roots of numbers other than 0, which increase; None if a sign is not known."""
    if powers is None or any(power.contains(0) for power in powers):
        return None
    with working_precision(precision):
        positive = [power.root(m) for power in powers if power > 0]
        others = [(-power).root(m) for power in powers if power < 0] if m % 2 else positive[::-1]
        return [*(-root for root in others), *positive]


def _exponent(values: Sequence[int]) -> int:
    """k such that all roots are below 2^k (Fujiwara)."""
    lead, degree = abs(values[-1]).bit_length() - 1, len(values) - 1
    return max(
        -((lead - abs(value).bit_length()) // (degree - place)) + 1 for place, value in enumerate(values[:-1]) if value
    )


def _on_unit_interval(values: Sequence[int], scale: fmpq) -> arb_poly:
    """The polynomial of the root divided by a number; its coefficients rounded before."""
    return arb_poly([arb(value) * 1 for value in values])(arb_poly([0, arb(scale)]))


def _positive_roots(polynomial: arb_poly, bits: int) -> list[arb] | None:
    """Balls around the roots in (0, 1), increasing."""
    degree, shift = int(polynomial.degree()), arb_poly([1, 1])
    found: list[arb] = []
    pending = [(polynomial, fmpz(0), 0)]
    while pending:
        part, place, depth = pending.pop()
        changes = _changes(_reversed(part, degree)(shift))
        if changes is None or depth > MOST_HALVINGS:
            return None
        if changes == 1:
            inner = _root(part, bits)
            if inner is None:
                return None
            found.append((arb(place) + inner) / (fmpz(1) << depth))
        elif changes:
            left = part(arb_poly([0, arb(1) / 2]))
            right = left(shift)
            if right[0].contains(0):
                return None
            pending += [(right, 2 * place + 1, depth + 1), (left, 2 * place, depth + 1)]
    return found


def _root(polynomial: arb_poly, bits: int) -> arb | None:
    """A ball around the only root in (0, 1), which is simple: found by Newton's method, proved by a change of sign."""
    slope, radius = polynomial.derivative(), arb(fmpq(1, fmpz(1) << (bits + 2)))
    start, low, high = _sign(polynomial(arb(1))), fmpq(0), fmpq(1)
    while high - low > fmpq(1, fmpz(1) << bits):
        middle = (low + high) / 2
        for guess in _newton(polynomial, slope, arb(middle), arb(low), arb(high)):
            below, above = guess - radius, guess + radius
            signs = _sign(polynomial(below)), _sign(polynomial(above))
            if below > 0 and above < 1 and signs in ((-1, 1), (1, -1)):
                return below.union(above)
        sign = _sign(polynomial(arb(middle)))
        if not sign or not start:
            return None
        low, high = (low, middle) if sign == start else (middle, high)
    return arb(low).union(arb(high))


def _newton(polynomial: arb_poly, slope: arb_poly, guess: arb, low: arb, high: arb) -> Iterator[arb]:
    """Where Newton's method comes to, if it stays inside."""
    for _ in range(_STEPS):
        divisor = slope(guess).mid()
        if not divisor:
            return
        step = polynomial(guess).mid() / divisor
        guess = (guess - step).mid()
        if not low < guess < high:
            return
    yield guess


def _sign(value: arb) -> int:
    """1 or -1; 0 where it is not known."""
    return 1 if value > 0 else -1 if value < 0 else 0


def _reversed(polynomial: arb_poly, degree: int) -> arb_poly:
    values = polynomial.coeffs()
    return arb_poly([*[arb(0)] * (degree + 1 - len(values)), *values[::-1]])


def _changes(polynomial: arb_poly) -> int | None:
    """Changes of sign in the coefficients; None if a sign is not known."""
    signs = [_sign(value) for value in polynomial.coeffs() if not value.is_zero()]
    return None if 0 in signs else sum(left != right for left, right in pairwise(signs))
