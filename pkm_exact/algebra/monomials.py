"""Monomials packed into integers so that the product is a sum and the order is the order of integers.

The degree reverse lexicographic order compares, for exponents (e_1, ..., e_n), the partial sums
e_1 + ... + e_n, e_1 + ... + e_{n-1}, ..., e_1 lexicographically. Packing these sums into bit fields, the full
degree on top, makes the packed product the sum of the packed factors and the order that of the integers.
"""

from __future__ import annotations

from dataclasses import dataclass

FIELD_BITS = 12
_FIELD_MASK = (1 << FIELD_BITS) - 1
_MOST_UNKNOWNS = 64
_SPARE_BITS = sum(1 << (FIELD_BITS + (FIELD_BITS + 1) * position) for position in range(_MOST_UNKNOWNS))


@dataclass(frozen=True)
class MonomialRing:
    """Packed monomials in ``size`` unknowns, degree reverse lexicographic order (first unknown largest).

    Examples
    --------
    >>> ring = MonomialRing(3)
    >>> ring.pack((1, 0, 1)) < ring.pack((0, 2, 0)) < ring.pack((1, 1, 0))
    True
    >>> ring.unpack(ring.pack((1, 0, 1)) + ring.pack((0, 2, 0)))
    (1, 2, 1)
    """

    size: int

    def pack(self, exponents: tuple[int, ...]) -> int:
        """The monomial with the given exponents (total degree below 2**12)."""
        packed = 0
        total = 0
        for position, exponent in enumerate(exponents):
            total += exponent
            packed |= total << (FIELD_BITS * position)
        if total > _FIELD_MASK:
            raise OverflowError(f"monomial of degree {total} exceeds the packing limit {_FIELD_MASK}")
        return packed

    def unpack(self, monomial: int) -> tuple[int, ...]:
        """The exponents of a packed monomial."""
        exponents = []
        previous = 0
        for _ in range(self.size):
            total = monomial & _FIELD_MASK
            exponents.append(total - previous)
            previous = total
            monomial >>= FIELD_BITS
        return tuple(exponents)

    def degree(self, monomial: int) -> int:
        """Total degree."""
        return monomial >> (FIELD_BITS * (self.size - 1))

    def unknown(self, index: int) -> int:
        """The monomial x_index."""
        return self.pack(tuple(int(position == index) for position in range(self.size)))


def exponent_fields(exponents: tuple[int, ...]) -> int:
    """The exponents side by side in one integer, for ``divides``."""
    fields = 0
    for exponent in exponents:
        fields = fields << (FIELD_BITS + 1) | exponent
    return fields


def divides(divisor: int, multiple: int) -> bool:
    """Whether no exponent of the first monomial exceeds that of the second, both by their fields.

    No field of the difference then borrows from the next: the spare bit above each stays 0.

    Examples
    --------
    >>> [divides(exponent_fields(divisor), exponent_fields((1, 2))) for divisor in ((1, 0), (0, 3))]
    [True, False]
    """
    return divisor <= multiple and not (multiple - divisor) & _SPARE_BITS
