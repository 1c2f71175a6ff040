"""The ring (Z/p^k)[T] / q(T), in which a whole set of conjugate solutions is computed with at once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

from flint import fmpz_mod_ctx, fmpz_mod_poly, fmpz_mod_poly_ctx, fmpz_poly


@lru_cache(maxsize=8)
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

    def reduce(self, value: fmpz_mod_poly) -> fmpz_mod_poly:
        """The remainder modulo q."""
        return value % self.relation

    def multiply(self, left: fmpz_mod_poly, right: fmpz_mod_poly) -> fmpz_mod_poly:
        """The reduced product."""
        return left * right % self.relation


def coefficients(value: fmpz_mod_poly) -> list[int]:
    """Coefficients as integers in [0, modulus), lowest degree first."""
    return [int(coefficient) for coefficient in value.coeffs()]


def integer_polynomial(value: fmpz_mod_poly) -> fmpz_poly:
    """The polynomial over Z with coefficients in [0, modulus)."""
    return fmpz_poly(coefficients(value))


def combination(scalars: Sequence[int], values: Sequence[fmpz_mod_poly]) -> fmpz_mod_poly:
    """Integer linear combination; at least one value must be given."""
    total = values[0] * scalars[0]
    for scalar, value in zip(scalars[1:], values[1:], strict=True):
        if scalar:
            total += value * scalar
    return total
