"""Monomials in the order of an elimination, by degree, then reverse lexicographically: as integers, or as tuples.

Integers: with M = 2^b, the monomial with the exponents (e_1, .., e_n) and the degree d is

    d M^n - (e_n M^(n-1) + .. + e_2 M + e_1).

The sum in brackets is below M^n while exponents are below M: numbers are ordered by the degree first, and of two
monomials of one degree the one with the smaller last exponent that differs is the larger. Products are sums. Integers
are keys, and can be chosen so that to find one takes as many steps as there are keys: longer ones that have one hash,
or those that look for their places where all others are. So all are below 2^60, with hashes of their own, and so few
that it does not matter.

Tuples: (d, -e_n, .., -e_1), where unknowns, degrees or terms are too many.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from math import prod
from operator import add, le, mul
from typing import Any, Final, TypeAlias

Monomial: TypeAlias = tuple[int, ...]
"""Exponents."""
Polynomial: TypeAlias = dict[Monomial, int]
"""Coefficients by exponents."""
Code: TypeAlias = Any
"""What stands for a monomial: an integer, or a tuple of them. They are ordered as the monomials are."""
Packed: TypeAlias = dict[Code, int]
"""A polynomial: coefficients by what stands for the monomials."""

BITS: Final = 60
"""Bits of an integer that stands for a monomial."""
FEW: Final = 2000
"""Terms that are not too many."""


def packing_for(size: int, degree: int, terms: int) -> Packing:
    """What represents monomials in so many unknowns up to a degree, or a higher one, in so many terms."""
    packing = Integers(size)
    return packing if degree <= packing.most and terms <= FEW else Tuples(size)


@dataclass(frozen=True)
class Packing(ABC):
    """Monomials in ``size`` unknowns."""

    size: int

    @abstractmethod
    def packed(self, monomial: Monomial) -> Code:
        """The monomial with these exponents."""

    @abstractmethod
    def unpacked(self, code: Code) -> Monomial:
        """The exponents."""

    @abstractmethod
    def degree(self, code: Code) -> int:
        """The sum of the exponents."""

    @abstractmethod
    def unknown_of_power(self, code: Code) -> int | None:
        """Of a power of one unknown its place; the first one's if the monomial is 1. Otherwise None."""

    @abstractmethod
    def multiple(self, polynomial: Mapping[Code, int], factors: Sequence[int]) -> dict[Code, int]:
        """The polynomial times unknowns, given by their places."""

    @abstractmethod
    def multiples(self, codes: Iterable[Code], divisors: Collection[Code]) -> set[int]:
        """The places of the monomials that one of the divisors divides."""


@dataclass(frozen=True)
class Integers(Packing):
    """Monomials as integers.

    Examples
    --------
    >>> monomials = Integers(2)
    >>> larger, smaller = monomials.packed((2, 0)), monomials.packed((1, 1))
    >>> larger > smaller, monomials.unpacked(larger + smaller), monomials.degree(larger)
    (True, (3, 1), 2)
    """

    @property
    def most(self) -> int:
        """The highest degree: one bit of each exponent stays 0."""
        return (1 << self._bits) // 2 - 1

    def packed(self, monomial: Monomial) -> int:
        """The monomial with these exponents."""
        return sum(map(mul, self._unknowns, monomial))

    def unpacked(self, code: int) -> Monomial:
        """The exponents."""
        exponents, one = self._exponents(code), (1 << self._bits) - 1
        return tuple(exponents >> place & one for place in self._places)

    def degree(self, code: int) -> int:
        """The sum of the exponents."""
        return -(-code >> self._bits * self.size)

    def unknown_of_power(self, code: int) -> int | None:
        """The place of its only unknown."""
        exponents = self._exponents(code)
        place = exponents.bit_length() // self._bits
        return place if exponents == self.degree(code) << self._bits * place else None

    def multiple(self, polynomial: Mapping[int, int], factors: Sequence[int]) -> dict[int, int]:
        """The polynomial times unknowns."""
        unknowns = self._unknowns
        shift = sum([unknowns[factor] for factor in factors])
        return {code + shift: value for code, value in polynomial.items()}

    def multiples(self, codes: Iterable[int], divisors: Collection[int]) -> set[int]:
        """The places of those that one of the divisors divides."""
        # A difference of exponents that is negative takes away the highest bit, which all have before.
        guard = sum(1 << place + self._bits - 1 for place in self._places)
        others = [self._exponents(divisor) for divisor in divisors]
        found = set()
        for place, code in enumerate(codes):
            exponents = self._exponents(code) | guard
            if any((exponents - other) & guard == guard for other in others):
                found.add(place)
        return found

    @cached_property
    def _bits(self) -> int:
        """Bits of an exponent, and of the degree."""
        return BITS // (self.size + 1)

    @cached_property
    def _places(self) -> tuple[int, ...]:
        """Where exponents begin."""
        return tuple(self._bits * place for place in range(self.size))

    @cached_property
    def _unknowns(self) -> tuple[int, ...]:
        return tuple((1 << self._bits * self.size) - (1 << place) for place in self._places)

    def _exponents(self, code: int) -> int:
        """The sum in brackets."""
        return -code & (1 << self._bits * self.size) - 1


@dataclass(frozen=True)
class Tuples(Packing):
    """Monomials as tuples.

    Examples
    --------
    >>> monomials = Tuples(2)
    >>> larger, smaller = monomials.packed((2, 0)), monomials.packed((1, 1))
    >>> larger > smaller, monomials.unpacked(larger), monomials.degree(larger)
    (True, (2, 0), 2)
    """

    def packed(self, monomial: Monomial) -> tuple[int, ...]:
        """The monomial with these exponents."""
        return (sum(monomial), *(-exponent for exponent in reversed(monomial)))

    def unpacked(self, code: tuple[int, ...]) -> Monomial:
        """The exponents."""
        return tuple(-entry for entry in code[:0:-1])

    def degree(self, code: tuple[int, ...]) -> int:
        """The sum of the exponents."""
        return code[0]

    def unknown_of_power(self, code: tuple[int, ...]) -> int | None:
        """The place of its only unknown."""
        monomial = self.unpacked(code)
        return monomial.index(code[0]) if code[0] in monomial else None

    def multiple(self, polynomial: Mapping[tuple[int, ...], int], factors: Sequence[int]) -> dict[tuple[int, ...], int]:
        """The polynomial times unknowns."""
        if not factors:
            return dict(polynomial)
        shift = self.packed(tuple(map(factors.count, range(self.size))))
        return {tuple(map(add, code, shift)): value for code, value in polynomial.items()}

    def multiples(self, codes: Iterable[tuple[int, ...]], divisors: Collection[tuple[int, ...]]) -> set[int]:
        """The places of those that one of the divisors divides."""
        others = set(map(self.unpacked, divisors))
        return {place for place, code in enumerate(codes) if _is_divisible(self.unpacked(code), others)}


def _is_divisible(monomial: Monomial, divisors: set[Monomial]) -> bool:
    """Whether one of the divisors divides a monomial: either those of the monomial are looked up, or all are tried."""
    if prod(exponent + 1 for exponent in monomial) < len(divisors):
        return not divisors.isdisjoint(product(*(range(exponent + 1) for exponent in monomial)))
    return any(all(map(le, divisor, monomial)) for divisor in divisors)
