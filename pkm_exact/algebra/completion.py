"""Coordinates that follow linearly from others: found modulo many primes instead of lifted.

Once h and the numerators of some coordinates are known over Q, coordinates that solve a linear system over these are
found modulo one word-sized prime after another, in (Z/p)[T] / h, where arithmetic is fast, and joined by the Chinese
remainder theorem. The eliminant and the first coordinates then need no more precision than their own, often smaller,
coefficients ask for.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

from flint import fmpz, fmpz_mat, fmpz_poly, nmod_poly

from pkm_exact.algebra.primes import primes_from
from pkm_exact.algebra.reconstruction import common_fraction
from pkm_exact.digests import digest

FIRST_LENGTH = 2.25
"""Bits of modulus tried first, in lengths of h; general robots need a little less."""
GROWTH = 1.25
"""Growth of the modulus from one attempt to the next."""
ATTEMPTS = 3
"""Primes tried before a completion counts as impossible."""


class Completion(Protocol):
    """How the last coordinates follow from the first ones."""

    @property
    def known(self) -> int:
        """Number of first coordinates that are needed."""
        ...

    def modulo(self, eliminant: nmod_poly, numerators: Sequence[nmod_poly]) -> list[nmod_poly] | None:
        """Numerators over h' of the others from those of the first; None if the prime does not tell."""
        ...


@dataclass(frozen=True)
class CommonFractions:
    """h = eliminant / denominator, monic, and numerators over h' as numerators / scale; lowest degree first."""

    eliminant: Sequence[int]
    denominator: int
    numerators: Sequence[Sequence[int]]
    scale: int


def complete(
    found: CommonFractions, completion: Completion, start: tuple[int, Sequence[int]], limit_bits: int
) -> CommonFractions | None:
    """All coordinates from the first ones; None if primes do not tell or ``limit_bits`` do not suffice.

    Parameters
    ----------
    found : CommonFractions
        Of the first coordinates.
    completion : Completion
    start : (int, sequence of int)
        A modulus, and modulo it the coefficients of the missing numerators over h', each padded to the degree.
    limit_bits : int
    """
    length = max(value.bit_length() for values in (found.eliminant, *found.numerators) for value in values)
    target = FIRST_LENGTH * length
    moduli, residues = [start[0]], [start[1]]
    modulus = start[0]
    for prime, vector in _images(found, completion, start[0]):
        moduli.append(prime)
        residues.append(vector)
        modulus *= prime
        if modulus.bit_length() > limit_bits:
            break
        if modulus.bit_length() < target:
            continue
        target *= GROWTH
        fractions = common_fraction(_joined(residues, moduli, modulus), modulus, found.scale, length)
        if fractions is not None:
            values, scale = fractions
            width = len(found.eliminant) - 1
            factor = scale // found.scale
            first = [[value * factor for value in numerator] for numerator in found.numerators]
            last = [values[index : index + width] for index in range(0, len(values), width)]
            return CommonFractions(found.eliminant, found.denominator, first + last, scale)
    return None


def _images(found: CommonFractions, completion: Completion, modulus: int) -> Iterator[tuple[int, list[int]]]:
    """Primes with the coefficients of the missing numerators modulo each; ends if too few primes tell."""
    eliminant = fmpz_poly(list(found.eliminant))
    numerators = [fmpz_poly(list(numerator)) for numerator in found.numerators]
    width = len(found.eliminant) - 1
    failures = 0
    for prime in primes_from(digest(modulus, found.eliminant), 62):
        if not (modulus % prime and found.scale % prime):
            continue
        inverse = pow(found.scale, -1, prime)
        h = nmod_poly(eliminant, prime) * pow(found.denominator, -1, prime)
        last = completion.modulo(h, [nmod_poly(numerator, prime) * inverse for numerator in numerators])
        if last is not None:
            yield prime, [value for numerator in last for value in padded(numerator, width)]
            continue
        failures += 1
        if failures == ATTEMPTS:
            return


def padded(polynomial: nmod_poly, size: int) -> list[int]:
    """Coefficients, lowest degree first, with zeros up to the given number."""
    values = [int(value) for value in polynomial.coeffs()]
    return values + [0] * (size - len(values))


def _joined(residues: Sequence[Sequence[int]], moduli: Sequence[int], modulus: int) -> list[fmpz]:
    """Integers modulo the product of coprime moduli from their residues, one list of them for every modulus."""
    cofactors = [modulus // part for part in moduli]
    units = [[pow(cofactor % part, -1, part) * cofactor] for cofactor, part in zip(cofactors, moduli, strict=True)]
    joined = fmpz_mat([list(row) for row in residues]).transpose() * fmpz_mat(units)
    return joined.entries()
