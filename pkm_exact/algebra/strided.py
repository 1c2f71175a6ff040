"""Polynomials in T by their parts in T^0, .., T^(m - 1) times polynomials in T^m.

Systems with a symmetry have eliminants in T^m, and coordinates with one part each: products of these are shorter.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import gcd

from flint import fmpz_poly


@dataclass(frozen=True)
class Strided:
    """The sum of T^r P_r(T^m).

    Attributes
    ----------
    step : int
        m.
    parts : mapping
        P_r by r, 0 <= r < m; none for those that are 0.

    Examples
    --------
    >>> x = strided(fmpz_poly([0, 2, 0, 5]), 2)
    >>> sorted((x * x + 3 * x).parts.items())
    [(0, 25*x^3 + 20*x^2 + 4*x), (1, 15*x + 6)]
    """

    step: int
    parts: Mapping[int, fmpz_poly]

    def __add__(self, other: Strided) -> Strided:
        parts = dict(self.parts)
        for place, part in other.parts.items():
            parts[place] = parts[place] + part if place in parts else part
        return Strided(self.step, {place: part for place, part in parts.items() if part})

    def __mul__(self, other: Strided) -> Strided:
        parts: dict[int, fmpz_poly] = {}
        for left, one in self.parts.items():
            for right, two in other.parts.items():
                over, place = divmod(left + right, self.step)
                product = (one * two).left_shift(over)
                parts[place] = parts[place] + product if place in parts else product
        return Strided(self.step, {place: part for place, part in parts.items() if part})

    def __rmul__(self, factor: int) -> Strided:
        return Strided(self.step, {place: factor * part for place, part in self.parts.items()})

    def __pow__(self, exponent: int) -> Strided:
        """For exponents from 1 on."""
        result = self
        for digit in bin(exponent)[3:]:
            result = result * result * self if digit == "1" else result * result
        return result

    def is_multiple(self, modulus: fmpz_poly) -> bool:
        """Whether a primitive polynomial in T^m, as one in T^m, divides all parts, so the whole."""
        return all(divmod(part, modulus)[1].is_zero() for part in self.parts.values())


def strided(polynomial: fmpz_poly, step: int) -> Strided:
    """A polynomial by its parts."""
    coefficients = polynomial.coeffs()
    parts = {place: fmpz_poly(coefficients[place::step]) for place in range(step)}
    return Strided(step, {place: part for place, part in parts.items() if part})


def stride(polynomial: fmpz_poly) -> int:
    """The greatest m so that a polynomial is one in T^m; 1 for constants.

    Examples
    --------
    >>> stride(fmpz_poly([1, 0, 0, 2, 0, 0, 0, 0, 0, 4])), stride(fmpz_poly([1, 1]))
    (3, 1)
    """
    return gcd(*(place for place, value in enumerate(polynomial.coeffs()) if value)) or 1
