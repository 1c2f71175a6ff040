"""Polynomial systems over Z, and their images modulo a prime."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from flint import Ordering, fmpz_mpoly, fmpz_mpoly_ctx

from pkm_exact.algebra.monomials import MonomialRing
from pkm_exact.digests import digest

ModularPolynomial = tuple[list[int], list[int]]
"""Packed monomials in decreasing order, and their non-zero coefficients in [1, p)."""


def polynomial_ring(unknowns: Sequence[str]) -> fmpz_mpoly_ctx:
    """The ring Z[unknowns], degree reverse lexicographic."""
    return fmpz_mpoly_ctx.get(tuple(unknowns), Ordering.degrevlex)


def cleared(coefficients: Sequence[Fraction]) -> tuple[list[int], int]:
    """Integers and a positive denominator whose quotients are the given rationals.

    Examples
    --------
    >>> cleared([Fraction(1, 2), Fraction(2, 3)])
    ([3, 4], 6)
    """
    denominator = lcm(*(value.denominator for value in coefficients)) if coefficients else 1
    return [value.numerator * (denominator // value.denominator) for value in coefficients], denominator


def primitive(polynomial: fmpz_mpoly) -> fmpz_mpoly:
    """The polynomial divided by its content; the zero polynomial stays."""
    return polynomial if polynomial.is_zero() else polynomial.primitive()[1]


@dataclass(frozen=True)
class PolynomialSystem:
    """Polynomials of Z[unknowns] whose common zeros are wanted.

    Attributes
    ----------
    unknowns : tuple of str
        Names, the largest of the monomial order first.
    polynomials : tuple of fmpz_mpoly
        Elements of ``polynomial_ring(unknowns)``.
    """

    unknowns: tuple[str, ...]
    polynomials: tuple[fmpz_mpoly, ...]

    @property
    def monomials(self) -> MonomialRing:
        """The packed monomials of the ring."""
        return MonomialRing(len(self.unknowns))

    @property
    def digest(self) -> int:
        """A number that follows from the polynomials and nothing else."""
        terms = (sorted((*map(int, key), int(value)) for key, value in f.to_dict().items()) for f in self.polynomials)
        return digest(self.unknowns, terms)

    def modulo(self, prime: int) -> list[ModularPolynomial]:
        """Images of the polynomials modulo ``prime``, zero images left out."""
        images = [modular_image(polynomial, self.monomials, prime) for polynomial in self.polynomials]
        return [image for image in images if image[0]]


def modular_image(polynomial: fmpz_mpoly, ring: MonomialRing, prime: int) -> ModularPolynomial:
    """Packed image of one integer polynomial modulo ``prime``."""
    terms = polynomial.to_dict()
    residues = {ring.pack(tuple(map(int, exponents))): int(value) % prime for exponents, value in terms.items()}
    support = sorted((monomial for monomial, residue in residues.items() if residue), reverse=True)
    return support, [residues[monomial] for monomial in support]
