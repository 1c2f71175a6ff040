"""Integer matrices modulo many primes, and back: products of a few primes come between, so that numbers of any size
cost little more than those of a few words.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from math import prod
from typing import Final

from flint import fmpz, fmpz_mat, nmod_mat

from pkm_exact.certify.checker.budget import charge, limbs

_FIRST: Final = (1 << 63) - 25
_BLOCK: Final = 16
"""Large numbers are reduced modulo the product of so many primes first."""


def primes() -> Iterator[int]:
    """Primes below 2^63, decreasing."""
    candidate = _FIRST
    while True:
        if fmpz(candidate).is_prime():
            yield candidate
        candidate -= 2


def images(matrix: fmpz_mat, moduli: Iterable[int]) -> Iterator[tuple[int, nmod_mat]]:
    """A matrix modulo one prime after the other."""
    rows, columns = matrix.nrows(), matrix.ncols()
    charge(100 * rows * columns)
    entries = matrix.entries()
    sizes = [limbs(int(entry.bit_length())) for entry in entries if entry]
    words = sum(sizes)
    source = iter(moduli)
    while block := list(islice(source, _BLOCK)):
        smaller, cost = matrix, 12 * words
        if max(sizes, default=0) > 2 * _BLOCK:
            charge(150 * rows * columns + words * _BLOCK)
            modulus = fmpz(prod(block))
            smaller = fmpz_mat(rows, columns, [entry % modulus if entry else entry for entry in entries])
            cost = 12 * _BLOCK * len(sizes)
        for p in block:
            charge(6 * rows * columns + cost)
            yield p, nmod_mat(smaller, p)


def combined(parts: Sequence[tuple[int, fmpz_mat]], factor: int) -> tuple[int, list[fmpz]]:
    """Entries times a factor, modulo the product of primes, from those modulo each; the ones that are nearest to 0."""
    size = parts[0][1].nrows() * parts[0][1].ncols()
    charge(len(parts) * (3000 + 10 * len(parts) + size * (250 + len(parts) // 2)))
    modulus = prod(p for p, _ in parts)
    terms = [(fmpz(p), part * (pow(modulus // p, -1, p) * factor % p)) for p, part in parts]
    while len(terms) > 1:
        pairs = zip(terms[::2], terms[1::2], strict=False)
        joined = [(p * q, first * q + second * p) for (p, first), (q, second) in pairs]
        terms = joined + terms[len(joined) * 2 :]
    half, odd = fmpz(modulus // 2), fmpz(modulus)
    return modulus, [(entry + half) % odd - half for entry in terms[0][1].entries()]


def centred(value: fmpz, modulus: int) -> fmpz:
    """The number nearest to 0 with the same residue."""
    residue = value % modulus
    return residue - modulus if 2 * residue > modulus else residue
