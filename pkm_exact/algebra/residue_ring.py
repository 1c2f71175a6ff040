"""The ring (Z/p^k)[T] / q(T), in which a whole set of conjugate solutions is computed with at once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Final, TypeVar

from flint import fmpz, fmpz_mod_ctx, fmpz_mod_poly, fmpz_mod_poly_ctx, fmpz_poly

Polynomial = TypeVar("Polynomial", fmpz_poly, fmpz_mod_poly)

_LEAST_DEGREE: Final = 16
_LEAST_SIZE: Final = 28000
"""Bits of an element from which a reduction by products is quicker."""


@lru_cache(maxsize=32)
def _polynomials_modulo(modulus: int) -> fmpz_mod_poly_ctx:
    """Kept, because FLINT tests the modulus for primality each time that a context is made."""
    return fmpz_mod_poly_ctx(fmpz_mod_ctx(modulus))


@dataclass(frozen=True)
class ResidueRing:
    """Elements are polynomials of degree below deg q with coefficients modulo ``modulus``; q is monic.

    Sums and integer multiples are those of the polynomials. Products may be summed unreduced before one ``reduce``.
    """

    modulus: int
    relation_coefficients: tuple[int, ...]

    @cached_property
    def polynomials(self) -> fmpz_mod_poly_ctx:
        """The polynomial ring over the integers modulo ``modulus``."""
        return _polynomials_modulo(self.modulus)

    @cached_property
    def relation(self) -> fmpz_mod_poly:
        """The monic polynomial q."""
        return self.polynomials(list(self.relation_coefficients))

    @property
    def one(self) -> fmpz_mod_poly:
        """The element 1."""
        return self.polynomials([1])

    def convert(self, coefficients: Iterable[int]) -> fmpz_mod_poly:
        """The polynomial with the given coefficients, lowest degree first."""
        return self.polynomials([int(value) for value in coefficients])

    @cached_property
    def _inverse(self) -> tuple[fmpz_mod_poly, fmpz_mod_poly]:
        """The power series 1 / (q reversed), and q without its leading term."""
        size = len(self.relation_coefficients) - 1
        return self.relation.reverse().inverse_series_trunc(size - 1), self.relation.truncate(size)

    def reduce(self, value: fmpz_mod_poly) -> fmpz_mod_poly:
        """The remainder modulo q."""
        return self.divided(value)[1] if value.degree() >= len(self.relation_coefficients) - 1 else value

    def divided(self, value: fmpz_mod_poly) -> tuple[fmpz_mod_poly, fmpz_mod_poly]:
        """Quotient and remainder by q.

        The quotient by q reversed is that of power series: for long numbers two products are less than a division.
        """
        size = len(self.relation_coefficients) - 1
        excess = int(value.degree()) - size
        if not 0 <= excess <= size - 2 or size < _LEAST_DEGREE or size * self.modulus.bit_length() < _LEAST_SIZE:
            return divmod(value, self.relation)
        inverse, low = self._inverse
        high = value.right_shift(size).reverse(degree=size - 2)
        quotient = high.mul_low(inverse, size - 1).reverse(degree=size - 2)
        return quotient, value.truncate(size) - quotient.mul_low(low, size)

    def multiply(self, left: fmpz_mod_poly, right: fmpz_mod_poly) -> fmpz_mod_poly:
        """The reduced product."""
        return self.reduce(left * right)


def coefficients(value: fmpz_mod_poly) -> list[int]:
    """Coefficients as integers in [0, modulus), lowest degree first."""
    return [int(coefficient) for coefficient in value.coeffs()]


def integer_polynomial(value: fmpz_mod_poly) -> fmpz_poly:
    """The polynomial over Z with coefficients in [0, modulus)."""
    return fmpz_poly(coefficients(value))


def combination(scalars: Sequence[int | fmpz], values: Sequence[Polynomial]) -> Polynomial:
    """Integer linear combination; at least one value must be given."""
    total = values[0] * scalars[0]
    for scalar, value in zip(scalars[1:], values[1:], strict=True):
        if scalar:
            total += value * scalar
    return total
