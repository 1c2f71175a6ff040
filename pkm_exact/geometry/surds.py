"""Roots of quadratic equations over the rationals, exactly: p + q sqrt(n)."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Final

_SMALL_SQUARES: Final = 1000


@dataclass(frozen=True)
class Surd:
    """The real number p + q sqrt(n), with rational p and q and an integer n; n = 0 if the number is rational.

    Examples
    --------
    >>> print(Surd.root_of(Fraction(3, 4)))
    1/2*sqrt(3)
    >>> print(Surd.root_of(Fraction(9, 4)))
    3/2
    """

    p: Fraction
    q: Fraction = Fraction(0)
    n: int = 0

    @classmethod
    def root_of(cls, square: Fraction) -> Surd:
        """The square root of a rational that is not negative."""
        numerator, denominator = isqrt(square.numerator), isqrt(square.denominator)
        if Fraction(numerator, denominator) ** 2 == square:
            return cls(Fraction(numerator, denominator))
        n, q = square.numerator * square.denominator, Fraction(1, square.denominator)
        for k in range(2, _SMALL_SQUARES):
            while n % (k * k) == 0:
                n, q = n // (k * k), q * k
        return cls(Fraction(0), q, n)

    def scaled(self, factor: Fraction) -> Surd:
        """The number times a rational."""
        return Surd(self.p * factor, self.q * factor, self.n) if factor else Surd(Fraction(0))

    def plus(self, summand: Fraction) -> Surd:
        """The number plus a rational."""
        return Surd(self.p + summand, self.q, self.n)

    @property
    def is_rational(self) -> bool:
        """Whether the number is known to be rational; decided exactly."""
        return self.n == 0

    def enclosure(self, width: Fraction) -> tuple[Fraction, Fraction]:
        """Two rationals, at most ``width`` apart, between which the number lies; equal if it is rational.

        Examples
        --------
        >>> [str(end) for end in Surd(Fraction(1), Fraction(-1), 2).enclosure(Fraction(1, 8))]
        ['-1/2', '-3/8']
        """
        if self.n == 0:
            return self.p, self.p
        scale = 1
        while abs(self.q) > width * scale:
            scale *= 2
        floor = isqrt(self.n * scale * scale)
        ends = sorted(self.p + self.q * Fraction(value, scale) for value in (floor, floor + 1))
        return ends[0], ends[1]

    def __str__(self) -> str:
        if self.n == 0:
            return str(self.p)
        size = abs(self.q)
        root = f"sqrt({self.n})" if size == 1 else f"{size}*sqrt({self.n})"
        if self.p == 0:
            return root if self.q > 0 else f"-{root}"
        return f"{self.p} {'+' if self.q > 0 else '-'} {root}"


def quadratic_roots(a: Fraction, b: Fraction, c: Fraction) -> tuple[Surd, ...]:
    """The distinct real roots x of a x^2 + 2 b x + c = 0, a not 0, in increasing order.

    Examples
    --------
    >>> [str(x) for x in quadratic_roots(Fraction(1), Fraction(-1), Fraction(-1))]
    ['1 - sqrt(2)', '1 + sqrt(2)']
    >>> quadratic_roots(Fraction(1), Fraction(0), Fraction(1))
    ()
    """
    discriminant = b * b - a * c
    if discriminant < 0:
        return ()
    if discriminant == 0:
        return (Surd(-b / a),)
    root = Surd.root_of(discriminant)
    step = root.scaled(1 / abs(a))
    return step.scaled(Fraction(-1)).plus(-b / a), step.plus(-b / a)
