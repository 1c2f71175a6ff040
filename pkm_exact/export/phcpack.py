"""The input of PHCpack's ``phc``, which has no comments.

phc misreads two things without a word, both avoided here: an unknown whose name begins with e, as that of an exponent,
unless a coefficient stands before it; and an integer of more than 18 digits, unless it is written with an exponent.
Its arithmetic is floating-point: the coefficients are exact here, and rounded when they are read.
"""

from __future__ import annotations

from flint import fmpz

from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.export.polynomial_text import polynomial_text, wrapped

LONGEST_INTEGER = 18
"""Digits that phc reads in an integer without an exponent."""


def write(system: PolynomialSystem, _heading: str) -> str:
    """The numbers of polynomials and unknowns, and the polynomials, each ended by a semicolon.

    Examples
    --------
    >>> from pkm_exact.algebra.system import polynomial_ring
    >>> x, y = polynomial_ring(("x", "y")).gens()
    >>> print(write(PolynomialSystem(("x", "y"), (x**2 - 12 * y, y - 10**20)), ""), end="")
    2 2
    1*x^2-12*y;
    1*y-1.00000000000000000000E+20;
    """
    texts = (polynomial_text(system.unknowns, each, ones=True, number=_number) for each in system.polynomials)
    lines = [f"{len(system.polynomials)} {len(system.unknowns)}", *(f"{wrapped(text)};" for text in texts)]
    return "\n".join(lines) + "\n"


def _number(value: fmpz) -> str:
    digits = str(value)
    return digits if len(digits) <= LONGEST_INTEGER else f"{digits[0]}.{digits[1:]}E+{len(digits) - 1}"
