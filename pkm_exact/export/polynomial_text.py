"""Polynomials as text: what the syntaxes of most programs have in common."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from flint import fmpz, fmpz_mpoly


def polynomial_text(
    unknowns: Sequence[str],
    polynomial: fmpz_mpoly,
    *,
    power: str = "^",
    times: str = "*",
    ones: bool = False,
    name: Callable[[str], str] = str,
    number: Callable[[fmpz], str] = str,
) -> str:
    """The polynomial, terms in decreasing order, without spaces and without a leading plus sign.

    Parameters
    ----------
    unknowns : sequence of str
    polynomial : fmpz_mpoly
    power, times : str
        Signs of a power and of a product.
    ones : bool
        Whether a coefficient 1 or -1 before an unknown is written.
    name, number : callable
        Texts of an unknown and of a positive integer.

    Examples
    --------
    >>> from pkm_exact.algebra.system import polynomial_ring
    >>> x, y = polynomial_ring(("x", "y")).gens()
    >>> polynomial_text(("x", "y"), 3 * x**2 - x * y - 7)
    '3*x^2-x*y-7'
    >>> polynomial_text(("x", "y"), x**2 - y, power="**", ones=True)
    '1*x**2-1*y'
    """
    terms = []
    for exponents, coefficient in polynomial.to_dict().items():
        powers = [(name(unknown), int(k)) for unknown, k in zip(unknowns, exponents, strict=True)]
        factors = [unknown if k == 1 else f"{unknown}{power}{k}" for unknown, k in powers if k]
        size = abs(coefficient)
        if ones or size != 1 or not factors:
            factors.insert(0, number(size))
        terms.append(("-" if coefficient < 0 else "+") + times.join(factors))
    return "".join(terms).removeprefix("+") or "0"


def wrapped(text: str, width: int = 110) -> str:
    """The text of a polynomial on several lines, broken before the sign of a term.

    Examples
    --------
    >>> wrapped("1.5E+20*x-y+7", 10).split("\\n")
    ['1.5E+20*x', '-y+7']
    """
    lines = [""]
    for term in re.split(r"(?<!E)(?=[-+])", text):
        if lines[-1] and len(lines[-1]) + len(term) > width:
            lines.append("")
        lines[-1] += term
    return "\n".join(lines)
