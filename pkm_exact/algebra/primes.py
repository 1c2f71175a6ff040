"""The primes that the modular computations use: they follow from a digest of the data (``digests``)."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count

from flint import fmpz

from pkm_exact.digests import digest


def primes_from(seed: int, bits: int) -> Iterator[int]:
    """All primes of the given size, each once, in an order that follows from the seed.

    Examples
    --------
    >>> sorted(primes_from(1, 5)), next(primes_from(1, 62)).bit_length()
    ([17, 19, 23, 29, 31], 62)
    """
    seen: set[int] = set()
    for number in count():
        prime = _next_prime(drawn(seed, number, bits), bits, seen)
        if prime is None:
            return
        seen.add(prime)
        yield prime


def drawn(seed: int, number: int, bits: int) -> int:
    """Where the search for a prime begins: a number of the given size."""
    return (1 << bits - 1) + digest(seed, number) % (1 << bits - 1)


def _next_prime(start: int, bits: int, seen: set[int]) -> int | None:
    """The first prime of the size from a number on that is not among those seen; after the largest comes the least."""
    low = 1 << bits - 1
    for step in range(low):
        candidate = low + (start - low + step) % low
        if candidate not in seen and fmpz(candidate).is_prime():
            return candidate
    return None
