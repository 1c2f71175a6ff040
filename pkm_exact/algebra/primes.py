"""The sequence of primes that the modular computations use."""

from __future__ import annotations

from collections.abc import Iterator

from flint import fmpz


def primes_below(bits: int) -> Iterator[int]:
    """Primes below 2^bits, largest first.

    Examples
    --------
    >>> next(primes_below(62)) == 2**62 - 57
    True
    """
    candidate = (1 << bits) - 1
    while candidate > 2:
        if fmpz(candidate).is_prime():
            yield candidate
        candidate -= 2
