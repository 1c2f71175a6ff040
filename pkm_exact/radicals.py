"""Sums of square roots, exactly: a ring with zero tests and signs, and no tolerance.

A number is c_1 sqrt(n_1) + .. + c_k sqrt(n_k) with rational c_i and positive integers n_i; n = 1 stands for the
rational part. Square roots of integers no two of which have a square as their product are linearly independent over the
rationals (Besicovitch, J. London Math. Soc. 15, 1940). So such a sum is 0 only if, with roots of one class put
together, every coefficient is: no integer is factored for that, and of a sum that is not 0 bounds show the sign.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, isqrt
from typing import Final, TypeAlias

from pkm_exact.errors import InputError

_SMALL: Final = 100
MOST_TERMS: Final = 256
"""Roots in one number; beyond that exact products are out of reach."""


class OutOfReachError(InputError):
    """So many different square roots that exact arithmetic with them would take too long."""


@dataclass(frozen=True)
class RootSum:
    """A sum of rational multiples of square roots.

    Attributes
    ----------
    terms : tuple of (int, Fraction)
        Radicands and coefficients, none of them 0, by increasing radicand; no two radicands are of one class.

    Examples
    --------
    >>> two, eight = RootSum.root(Fraction(2)), RootSum.root(Fraction(8))
    >>> print(two * two - 1, two + eight, two * RootSum.root(Fraction(3)))
    1 3*sqrt(2) sqrt(6)
    >>> (eight - two - two).sign(), (two - RootSum.of(Fraction(3, 2))).sign()
    (0, -1)
    """

    terms: tuple[tuple[int, Fraction], ...] = ()

    @classmethod
    def of(cls, value: Number) -> RootSum:
        """A rational number, or a sum as it is."""
        if isinstance(value, RootSum):
            return value
        return cls(((1, Fraction(value)),)) if value else _ZERO

    @classmethod
    def root(cls, square: Fraction) -> RootSum:
        """The square root of a rational number that is not negative."""
        if square < 0:
            raise ValueError(f"{square} is negative: it has no real root")
        if square == 0:
            return _ZERO
        n, factor = _reduced(square.numerator * square.denominator)
        return cls(((n, Fraction(factor, square.denominator)),))

    @property
    def is_rational(self) -> bool:
        """Whether no root is left, decided exactly."""
        return not self.terms or (len(self.terms) == 1 and self.terms[0][0] == 1)

    @property
    def rational(self) -> Fraction | None:
        """The rational number that it is, or None."""
        return None if not self.is_rational else self.terms[0][1] if self.terms else Fraction(0)

    def __add__(self, other: Number) -> RootSum:
        return _collected([*self.terms, *RootSum.of(other).terms])

    __radd__ = __add__

    def __neg__(self) -> RootSum:
        return RootSum(tuple((n, -c) for n, c in self.terms))

    def __sub__(self, other: Number) -> RootSum:
        return self + -RootSum.of(other)

    def __rsub__(self, other: Number) -> RootSum:
        return RootSum.of(other) + -self

    def __mul__(self, other: Number) -> RootSum:
        if not isinstance(other, RootSum):
            return RootSum(tuple((n, c * other) for n, c in self.terms)) if other else _ZERO
        if len(self.terms) * len(other.terms) > MOST_TERMS * 16:
            raise OutOfReachError(
                "exact products of so many different square roots are out of reach; take simpler numbers"
            )
        products = []
        for n, c in self.terms:
            for m, d in other.terms:
                common = gcd(n, m)
                products.append(((n // common) * (m // common), c * d * common))
        return _collected(products)

    __rmul__ = __mul__

    def __truediv__(self, divisor: Number) -> RootSum:
        return self * (divisor.inverse() if isinstance(divisor, RootSum) else 1 / Fraction(divisor))

    def __rtruediv__(self, dividend: Number) -> RootSum:
        return self.inverse() * dividend

    def inverse(self) -> RootSum:
        """The reciprocal, by its conjugates: each step makes one root the opposite, and leaves it out of the product.

        >>> print((RootSum.root(Fraction(2)) + 1).inverse())
        -1 + sqrt(2)
        >>> print((RootSum.root(Fraction(2)) + RootSum.root(Fraction(3)) + 1).inverse())
        1/2 + 1/4*sqrt(2) - 1/4*sqrt(6)
        """
        if len(self.terms) == 1:
            n, c = self.terms[0]
            return RootSum(((n, 1 / (c * n)),))
        if len(self.terms) != 2:
            return self._by_conjugates()
        (n, c), (m, d) = self.terms
        return RootSum(((n, c), (m, -d))) * (1 / (c * c * n - d * d * m))

    def _by_conjugates(self) -> RootSum:
        """The same of any number of terms.

        Roots of pairwise coprime integers that are no squares are independent, so that the sign of each one can be
        changed alone.
        """
        found, rest = RootSum.of(1), self
        while rest.rational is None:
            odd = next(b for b in coprime_base(n for n, _ in rest.terms) if any(_is_odd(n, b) for n, _ in rest.terms))
            conjugate = RootSum(tuple((n, -c if _is_odd(n, odd) else c) for n, c in rest.terms))
            found, rest = found * conjugate, rest * conjugate
        return found * (1 / rest.rational)

    def __abs__(self) -> RootSum:
        return -self if self.sign() < 0 else self

    def sign(self) -> int:
        """-1, 0 or 1, exactly."""
        if not self.terms:
            return 0
        signs = {c > 0 for _, c in self.terms}
        if len(signs) == 1:
            return 1 if signs.pop() else -1
        bits = 64
        while True:
            low, high = self.bounds(bits)
            if low > 0 or high < 0:
                return 1 if low > 0 else -1
            bits *= 2

    def bounds(self, bits: int = 64) -> tuple[Fraction, Fraction]:
        """Two rationals between which it lies, equal if it is rational; every root to ``bits`` bits after its first.

        >>> low, high = RootSum.root(Fraction(2)).bounds(20)
        >>> low < high, low * low < 2 < high * high
        (True, True)
        """
        low = high = Fraction(0)
        for n, c in self.terms:
            if n == 1:
                low, high = low + c, high + c
                continue
            shift = max(0, bits - n.bit_length() // 2)
            floor = isqrt(n << 2 * shift)
            ends = Fraction(floor, 1 << shift) * c, Fraction(floor + 1, 1 << shift) * c
            low, high = low + min(ends), high + max(ends)
        return low, high

    def __float__(self) -> float:
        low, high = self.bounds(128)
        return float((low + high) / 2)

    def __str__(self) -> str:
        if not self.terms:
            return "0"
        parts = []
        for n, c in self.terms:
            size = "" if abs(c) == 1 and n > 1 else str(abs(c))
            root = "" if n == 1 else f"{'*' if size else ''}sqrt({n})"
            parts.append(("-" if c < 0 else "+", size + root))
        first = ("-" if parts[0][0] == "-" else "") + parts[0][1]
        return first + "".join(f" {sign} {text}" for sign, text in parts[1:])


Number: TypeAlias = RootSum | Fraction | int
"""What sums of roots can be computed with."""

_ZERO: Final = RootSum()


def _reduced(n: int) -> tuple[int, int]:
    """The integers m and k with n = m k^2, m free of the squares that are easy to find."""
    root = isqrt(n)
    if root * root == n:
        return 1, root
    factor = 1
    for k in range(2, _SMALL):
        while n % (k * k) == 0:
            n, factor = n // (k * k), factor * k
    root = isqrt(n)
    return (1, factor * root) if root * root == n else (n, factor)


def coprime_base(numbers: Iterable[int]) -> list[int]:
    """Pairwise coprime integers above 1, of whose powers all numbers are products.

    >>> coprime_base([6, 10])
    [5, 3, 2]
    """
    found: list[int] = []
    left = [n for n in numbers if n > 1]
    while left:
        n = left.pop()
        shared = next((b for b in found if gcd(n, b) > 1), None)
        if shared is None:
            found.append(n)
            continue
        found.remove(shared)
        common = gcd(n, shared)
        left += [k for k in (common, n // common, shared // common) if k > 1]
    return found


def independent_roots(numbers: Iterable[int]) -> int:
    """How many square roots of integers generate those of all: classes modulo squares, as vectors over two elements.

    >>> independent_roots([2, 3, 6, 12, 25])
    2
    """
    chosen = [n for n in numbers if n > 1]
    base = coprime_base(chosen)
    leading: dict[int, int] = {}
    for n in chosen:
        vector = sum(1 << k for k, b in enumerate(base) if _is_odd(n, b))
        while vector and vector.bit_length() in leading:
            vector ^= leading[vector.bit_length()]
        if vector:
            leading[vector.bit_length()] = vector
    return len(leading)


def _is_odd(n: int, base: int) -> bool:
    """Whether an odd power of an element of a coprime base that is no square divides a number."""
    count = 0
    while n % base == 0:
        n, count = n // base, count + 1
    return count % 2 == 1 and isqrt(base) ** 2 != base


def _collected(terms: Iterable[tuple[int, Fraction]]) -> RootSum:
    """The sum of terms, with roots of one class put together."""
    found: dict[int, Fraction] = {}
    for n, c in terms:
        if n in found:
            found[n] += c
            continue
        reduced, factor = (1, 1) if n == 1 else _reduced(n)
        place, value = reduced, c * factor
        if reduced not in found:
            for known in found:
                product = known * reduced
                root = isqrt(product)
                if root * root == product:  # sqrt(reduced) = root / known * sqrt(known)
                    place, value = known, value * Fraction(root, known)
                    break
        found[place] = found.get(place, Fraction(0)) + value
    if len(found) > MOST_TERMS:
        raise OutOfReachError("exact sums of so many different square roots are out of reach; take simpler numbers")
    return RootSum(tuple(sorted((n, c) for n, c in found.items() if c)))
