"""Polynomials of a region certificate, their signs as conditions, and what arithmetic with them costs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly_ctx

from pkm_exact.certify.checker.budget import charge, polynomials_cost
from pkm_exact.certify.checker.region_document import RegionDocument


@dataclass(frozen=True, eq=False)
class Signed:
    """A polynomial and what its sign must be: "+" positive, "0+" not negative, "/" not 0."""

    polynomial: Any
    sign: str


@dataclass(frozen=True, eq=False)
class Deferred:
    """A condition whose polynomials are made when they are needed."""

    made: Callable[[], Condition]

    @cached_property
    def condition(self) -> Condition:
        """That condition."""
        return self.made()


Condition = Any
"""A ``Signed``, a ``Deferred``, or ("and", conditions) or ("or", conditions)."""


def beyond(condition: Condition) -> Condition:
    """That a condition does not hold whose tests are all that something is not negative."""
    if isinstance(condition, Signed):
        return Signed(-condition.polynomial, "+")
    word, parts = condition
    return ("or" if word == "and" else "and", [beyond(part) for part in parts])


@dataclass(frozen=True, eq=False)
class Conditions:
    """What is asked; that a pose is in the region; the parts of the shape; the D_i; the determinant."""

    asked: Condition
    region: Condition
    shape: tuple[Signed, ...]
    roots: tuple[Any, ...]
    determinant: Any


def number_words(*numbers: Fraction | int) -> int:
    """The words of 64 bits of the longest numerator or denominator.

    >>> number_words(Fraction(1, 3)), number_words(1, Fraction(1, 1 << 64))
    (1, 2)
    """
    sizes = (max(x.numerator.bit_length(), x.denominator.bit_length()) for x in numbers)
    return max(sizes, default=0) // 64 + 1


def polynomial_words(polynomial: Any) -> int:
    """The same of the coefficients of a polynomial."""
    sizes = (max(int(c.p).bit_length(), int(c.q).bit_length()) for c in polynomial.coeffs())
    return max(sizes, default=0) // 64 + 1


def size_factor(left: int, right: int) -> int:
    """By how much more numbers of so many words cost than short ones: products and common divisors, word by word.

    >>> size_factor(2, 3), size_factor(64, 64)
    (1, 256)
    """
    return max(1, left * right // 16)


@dataclass(frozen=True, eq=False)
class PlacedLeg:
    """A leg at the poses of the chart: N R B, the rod, N^2 times its square, value, D, the name of y, m of a crank."""

    arm: list[Any]
    rod: list[Any]
    square: Any
    value: tuple[Any, Any]
    root: Any
    name: str
    scale: Any = None


class RegionRing:
    """Polynomials of the variables of a chart and of y_1, y_2, ..: products are charged before they are made."""

    def __init__(self, document: RegionDocument) -> None:
        names = [*document.variables, *(f"y{k}" for k, leg in enumerate(document.legs) if leg.axes)]
        self.ring = fmpq_mpoly_ctx.get(tuple(names), Ordering.lex)
        self.named = dict(zip(names, self.ring.gens(), strict=True))
        self.g = document.metric

    def number(self, value: Fraction | int) -> Any:
        exact = Fraction(value)
        return self.ring.constant(fmpq(exact.numerator, exact.denominator))

    def entry(self, value: Fraction | str) -> Any:
        return self.named[value] if isinstance(value, str) else self.number(value)

    def powers(self, name: str, coefficients: Sequence[Fraction]) -> Any:
        """A polynomial of one variable."""
        total = self.number(0)
        for coefficient in reversed(coefficients):
            total = total * self.named[name] + self.number(coefficient)
        return total

    def times(self, left: Any, right: Any) -> Any:
        cost = polynomials_cost(max(len(left), len(right), 1), 8 * min(len(left), len(right), 64) + 1)
        charge(cost * size_factor(polynomial_words(left), polynomial_words(right)))
        return left * right

    def reduced(self, polynomial: Any, leg: PlacedLeg) -> Any:
        """With y^2 replaced by D for the y of a leg."""
        if leg.root is None:
            return polynomial
        place = list(self.named).index(leg.name)
        parts: dict[int, dict[tuple[int, ...], Any]] = {}
        for exponents, coefficient in polynomial.to_dict().items():
            power, odd = divmod(int(exponents[place]), 2)
            left = tuple(odd if k == place else int(e) for k, e in enumerate(exponents))
            parts.setdefault(power, {})[left] = coefficient
        total = self.number(0)
        for power, terms in parts.items():
            part = self.ring.from_dict(terms)
            for _ in range(power):
                part = self.times(part, leg.root)
            total += part
        return total

    def dot(self, left: Sequence[Any], right: Sequence[Any]) -> Any:
        terms = [g * self.times(a, b) for g, a, b in zip(self.g, left, right, strict=True)]
        return terms[0] + terms[1] + terms[2]
