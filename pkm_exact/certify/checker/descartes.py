"""The real roots of an integer polynomial, each in an interval of its own, by the rule of Descartes: all exact.

The number of roots of a polynomial q of degree D between 0 and 1 is at most the number of changes of sign in the
coefficients of (1 + x)^D q(1 / (1 + x)), and differs from it by an even number. So 0 and 1 are certain; intervals with
more are halved (Collins and Akritas 1976). Halving ends if no root is multiple. An interval with one root is narrowed
by exact signs beside where Newton's method leads to from its middle; where that leads nowhere, by Newton's operator in
ball arithmetic, X -> c - h(c) / h'(X), which loses no root, and by further signs.

The roots of a polynomial in T^m are the m-th roots of those of a polynomial whose degree is m times smaller.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import gcd
from typing import Final

from flint import arb, arb_poly, ctx, fmpq, fmpz, fmpz_poly

from pkm_exact.certify.checker.budget import ball_cost, charge, limbs, value_cost
from pkm_exact.certify.checker.verdict import too_large

MAX_ISOLATION: Final = 1 << 12
"""Roots that are not apart on the grid of this exponent are too close; those above 2 to it, too large."""
MAX_WORK: Final = 1 << 41
"""Squares of the degree times bits of coefficients, over all intervals that are looked at."""
SHIFT: Final = fmpz_poly([1, 1])
GUARD: Final = 64
"""Bits beyond those asked for that Newton's operator begins with."""

FIRST_STEP: Final = 3
LAST_STEP: Final = 48
"""Exponents of how much narrower an interval is tried to be made at once."""
NEARLY: Final = 256
"""Times by which an interval is too wide from which on Newton's method is followed from its middle."""
MOST_STEPS: Final = 16
"""Steps of Newton's method that are tried before anything else."""


class RealRoot:
    """A root of a squarefree h: ``low`` itself if that is ``high``, otherwise the only one strictly between them.

    ``sign`` is that of h at ``low``, and at ``high`` it is the other, where both are known and neither is 0.
    """

    def __init__(self, h: fmpz_poly, low: fmpq, high: fmpq, sign: int = 0) -> None:
        self.low = low
        self.high = high
        self._h = h
        self._size = int(h.length()), limbs(int(h.height_bits()))
        self._slope = h.derivative()
        self._change = (low, high) if sign else None
        self._rises = (sign or signs_at(h, [low])[0] or signs_at(self._slope, [low])[0]) < 0
        self._bits = GUARD
        self._guess = (low + high) / 2
        self._step = FIRST_STEP

    def is_known_to_change(self, low: fmpq, high: fmpq) -> bool:
        """Whether it was said that h changes its sign between these."""
        return self._change == (low, high)

    def narrow(self, bits: int) -> None:
        """Make the interval no wider than 2^-bits."""
        width = fmpq(1, fmpz(1) << bits)
        self._bits = max(self._bits, bits + GUARD)
        if self.high - self.low > NEARLY * width:  # a few bits are found sooner from an end
            self._follow(bits)
        while self.high - self.low > width:
            if not self._newton():
                self._approach()

    def _follow(self, bits: int) -> None:
        """Cut where Newton's method leads from the middle, or in halves where it leads out, and at last closely."""
        terms, words = self._size
        cost = 20000 + 3 * terms * (ball_cost(limbs(self._bits)) + 3 * words)
        with ctx.workprec(self._bits):
            there = arb((self.low + self.high) / 2).mid()
            near = arb((self.high - self.low) / NEARLY)
            small = arb(fmpq(1, fmpz(1) << bits // 2 + 2))
            for _ in range(MOST_STEPS):
                charge(cost)
                value = self._h(there)
                step = value / self._slope(there)
                image = (there - step).mid()
                if abs(step) < small:
                    there = image
                    break
                if not abs(step) < near:  # otherwise it is cut closely at last
                    place = fmpq(*dyadic(there))
                    if self.low < place < self.high and not value.contains(0):
                        self._cut(place, value)
                    if not (image.is_finite() and self.low < fmpq(*dyadic(image)) < self.high):
                        image = arb((self.low + self.high) / 2).mid()
                there = image
        self._guess = fmpq(*dyadic(there))
        self._step = int(((self.high - self.low) * (fmpz(1) << bits + 2)).floor()).bit_length()
        self._approach()

    def _approach(self) -> None:
        """Cut closely around where Newton's method points to, more closely each time it is right; or else in halves."""
        before = self.high - self.low
        reach = before / (1 << self._step)
        for place in (self._guess - reach, self._guess + reach):
            if self.low < place < self.high:
                self._split(place)
        if 2 * (self.high - self.low) <= before:
            self._step = min(2 * self._step, LAST_STEP)
        else:
            self._step = FIRST_STEP
            self._split((self.low + self.high) / 2)

    def ball(self, bits: int) -> arb:
        """An enclosure with a radius of about 2^-bits."""
        self.narrow(bits)
        with ctx.workprec(2 * self._bits):
            return arb(self.low).union(arb(self.high))

    def cell(self, exponent: int) -> tuple[fmpz, fmpz]:
        """(m, m) if the root is m / 2^exponent, else (m, m + 1) where it lies between m and m + 1, over 2^exponent."""
        charge(15000 + 100 * limbs(exponent))
        scale = fmpz(1) << exponent
        first = (self.low * scale).floor()
        if self.low < self.high <= fmpq(first + 1, scale):
            return first, first + 1
        self.narrow(exponent + 1)
        point = (self.high * scale).floor()
        if self.low * scale < point < self.high * scale:
            self._split(fmpq(point, scale))
        first = (self.low * scale).floor()
        return first, first + (self.low != self.high or first != self.low * scale)

    def _newton(self) -> bool:
        """Whether Newton's operator made the interval half as wide, or narrower."""
        terms, words = self._size
        charge(50000 + 3 * terms * (ball_cost(limbs(self._bits)) + 3 * words))
        with ctx.workprec(self._bits):
            place = arb(self.low).union(arb(self.high))
            middle, slope = place.mid(), self._slope(place)
            value, there = self._h(middle), self._slope(middle)
            steepness = abs(there)
            self._guess = fmpq(*dyadic((middle if there.contains(0) else middle - value / there).mid()))
            if not 16 * value.rad() < steepness * place.rad():  # rounding, not the width, is in the way
                self._bits *= 2
            if slope.contains(0):
                return False
            image = middle - value / slope
        centre, reach = fmpq(*dyadic(image.mid())), 2 * fmpq(*dyadic(image.rad()))
        if 4 * reach > self.high - self.low:
            return False
        self.low, self.high = max(self.low, centre - reach), min(self.high, centre + reach)
        return True

    def _split(self, place: fmpq) -> None:
        """Cut the interval at a place within it."""
        self._cut(place, value_at(self._h, place, (self._bits, 2 * self._bits, 4 * self._bits)))

    def _cut(self, place: fmpq, value: arb | fmpq) -> None:
        """Cut the interval at a place within it, with the value there or an enclosure of it without 0."""
        if value == 0:
            self.low = self.high = place
        elif (value < 0) == self._rises:
            self.low = place
        else:
            self.high = place


def value_at(h: fmpz_poly, place: fmpq, precisions: Sequence[int]) -> arb | fmpq:
    """An enclosure, without 0, of the value of a polynomial at a place, by one of the precisions; or the value."""
    terms, words = int(h.length()), limbs(int(h.height_bits()))
    for bits in precisions:
        charge(20000 + terms * (ball_cost(limbs(bits)) + 3 * words))
        with ctx.workprec(bits):
            value = h(arb(place))
        if not value.contains(0):
            return value
    charge(value_cost(terms, words, _words(place)))
    return h(place)


def signs_at(h: fmpz_poly, places: Sequence[fmpq]) -> list[int]:
    """The signs of the values of a polynomial at some places, each -1, 0, or 1."""
    terms, words = int(h.length()), limbs(int(h.height_bits()))
    charge(20000 + 3 * terms * words + len(places) * (5000 + terms * ball_cost(limbs(GUARD))))
    with ctx.workprec(GUARD):
        enclosed = arb_poly(h)
        values = [enclosed(arb(place)) for place in places]
    known = (
        value_at(h, place, [4 * GUARD]) if value.contains(0) else value
        for place, value in zip(places, values, strict=True)
    )
    return [int(value > 0) - int(value < 0) for value in known]


def _words(value: fmpq) -> int:
    return limbs(int(value.height_bits()))


def dyadic(value: arb, shift: int = 0) -> tuple[fmpz, fmpz]:
    """Numerator and denominator of an exact dyadic number times a power of 2."""
    mantissa, exponent = value.man_exp()
    power = int(exponent) + shift
    return (mantissa << power, fmpz(1)) if power >= 0 else (mantissa, fmpz(1) << -power)


def in_powers(h: fmpz_poly) -> tuple[int, fmpz_poly]:
    """The largest m so that a polynomial of positive degree is one in T^m, and that polynomial."""
    m = gcd(*(power for power, value in enumerate(h.coeffs()) if value))
    return m, fmpz_poly(h.coeffs()[::m])


def real_roots(h: fmpz_poly) -> list[RealRoot]:
    """All real roots of a squarefree polynomial of positive degree, increasing."""
    m, powers = in_powers(h)
    isolated = (RealRoot(powers, *ends) for ends in _isolated(powers, m * MAX_ISOLATION))
    known = sorted(isolated, key=lambda root: (root.low, root.high))
    if m == 1:
        return known
    ends = _ends_of_roots([root for root in known if m % 2 or root.low >= 0], m)
    mirrored = [(-high, -low) for low, high in reversed(ends)] if m % 2 == 0 else []
    return [RealRoot(h, low, high) for low, high in (*mirrored, *ends)]


def _ends_of_roots(powers: Sequence[RealRoot], m: int) -> list[tuple[fmpq, fmpq]]:
    """Isolating intervals of the real m-th roots (positive ones, if m is even) of numbers that are given, increasing.

    Each interval has the root for whose sake it is there. If no two have more than an end in common, it has no other.
    """
    bits = GUARD
    while bits <= m * MAX_ISOLATION:
        ends = [(_rounded_root(power.low, m, bits), -_rounded_root(-power.high, m, bits)) for power in powers]
        if all(one[1] <= other[0] for one, other in pairwise(ends)):
            return ends
        bits *= 2
        for power in powers:
            power.narrow(bits)
    raise too_large(f"real poses: the roots are not told apart by {MAX_ISOLATION} bits")


def _rounded_root(value: fmpq, m: int, bits: int) -> fmpq:
    """The m-th root of a number, with the sign of the number, rounded down to the grid 2^-bits."""
    words = limbs(m * bits + int(value.height_bits()))
    charge(20000 + 50 * words * (30 + words // 8))
    number = (value * fmpz(2) ** (m * bits)).floor()
    return fmpq(number.root(m) if number >= 0 else -1 - (-1 - number).root(m), fmpz(1) << bits)


def _isolated(h: fmpz_poly, finest: int) -> Iterator[tuple[fmpq, fmpq]]:
    """The ends of an interval around each root, in any order; both are the root if it was met at an end."""
    bound = root_bound(h, finest)
    if h[0] == 0:
        yield fmpq(0), fmpq(0)
    # (m, k, q) stands for the interval (m, m + 1) / 2^k, and h on it for q on (0, 1), up to a factor.
    pending = [(m, -bound, h(fmpz_poly([m << bound, 1 << bound]))) for m in (-1, 0)]
    work = 0
    while pending:
        m, k, q = pending.pop()
        terms, bits = int(q.length()), int(q.height_bits())
        charge(30000 + terms * (1000 + limbs(bits) * (8 + terms // 3)))
        work += int(q.degree()) ** 2 * bits
        if work > MAX_WORK:
            raise too_large("real poses: to tell the roots apart takes too long")
        changes = _changes(q)
        if changes == 1:
            yield _grid(m, k), _grid(m + 1, k)
        elif changes:
            if k >= finest:
                raise too_large(f"real poses: the roots are not told apart by {MAX_ISOLATION} bits")
            left = fmpz_poly([value << place for place, value in enumerate(reversed(q.coeffs()))][::-1])
            right = left(SHIFT)
            if right[0] == 0:
                yield _grid(2 * m + 1, k + 1), _grid(2 * m + 1, k + 1)
            pending += [(2 * m, k + 1, left), (2 * m + 1, k + 1, right)]


def root_bound(h: fmpz_poly, most: int) -> int:
    """An exponent of 2 above all roots (Fujiwara 1916); refuses if it is more than so much."""
    *lower, lead = (int(abs(value)).bit_length() for value in h.coeffs())
    degree = len(lower)
    bound = max([0, *(2 + (size - (lead - 1)) // (degree - power) for power, size in enumerate(lower))])
    if bound > most:
        raise too_large(f"real poses: a root of the eliminant is above 2^{MAX_ISOLATION}")
    return bound


def _changes(q: fmpz_poly) -> int:
    """The changes of sign that bound the number of roots between 0 and 1."""
    signs = [value > 0 for value in fmpz_poly(q.coeffs()[::-1])(SHIFT).coeffs() if value != 0]
    return sum(one != other for one, other in pairwise(signs))


def _grid(m: int, k: int) -> fmpq:
    return fmpq(m, fmpz(1) << k) if k >= 0 else fmpq(fmpz(m) << -k)
