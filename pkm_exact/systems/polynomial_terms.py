"""Polynomials as texts, in the one spelling that certificates of systems use."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpz_mpoly


def spelled_terms(polynomial: fmpz_mpoly, names: Sequence[str]) -> list[str]:
    """The terms, monomials decreasing in the degree reverse lexicographic order.

    Examples
    --------
    >>> from pkm_exact.algebra.system import polynomial_ring
    >>> x, y = polynomial_ring(("x", "y")).gens()
    >>> spelled_terms(5 - 3 * y + x**2 * y - y**3, ("x", "y"))
    ['x^2*y', '-y^3', '-3*y', '5']
    """
    return [_spelled(exponents, value, names) for exponents, value in decreasing_terms(polynomial)]


def decreasing_terms(polynomial: fmpz_mpoly) -> list[tuple[tuple[int, ...], int]]:
    """Exponents and coefficients, monomials decreasing in the degree reverse lexicographic order."""
    terms = [(tuple(map(int, exponents)), int(value)) for exponents, value in polynomial.to_dict().items()]
    return sorted(terms, key=lambda term: (sum(term[0]), *(-exponent for exponent in reversed(term[0]))), reverse=True)


def _spelled(exponents: Sequence[int], value: int, names: Sequence[str]) -> str:
    pairs = zip(names, exponents, strict=True)
    factors = [name if exponent == 1 else f"{name}^{exponent}" for name, exponent in pairs if exponent]
    if abs(value) != 1 or not factors:
        factors.insert(0, str(abs(value)))
    return ("-" if value < 0 else "") + "*".join(factors)
