"""What a polynomial system may be at most, in one object that is passed down."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class InputLimits:
    """Sizes of a system; certificates of systems have the same limits.

    Attributes
    ----------
    file_bytes : int
    variables : int
    polynomials : int
    degree : int
        Of a polynomial, and of what is multiplied on the way to one.
    terms : int
        Of all polynomials together, and of what is multiplied on the way to one.
    digits : int
        Of a coefficient, and of a number in a text.
    nesting : int
        Brackets, one inside the other.
    """

    file_bytes: int = 16 << 20
    variables: int = 64
    polynomials: int = 256
    degree: int = 64
    terms: int = 1 << 16
    digits: int = 4000
    nesting: int = 50


INPUT_LIMITS = InputLimits()
