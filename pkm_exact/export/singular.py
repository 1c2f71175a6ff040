"""A script for Singular."""

from __future__ import annotations

from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.export.polynomial_text import polynomial_text, wrapped


def write(system: PolynomialSystem, heading: str) -> str:
    """A ring over Q, degree reverse lexicographic, and an ideal.

    Examples
    --------
    >>> from pkm_exact.algebra.system import polynomial_ring
    >>> x, y = polynomial_ring(("x", "y")).gens()
    >>> print(write(PolynomialSystem(("x", "y"), (x**2 - 3 * y, x - 1)), "two equations").split("\\n")[2:])
    ['ring Q = 0,(x,y),dp;', 'ideal I =', 'x^2-3*y,', 'x-1;', '']
    """
    polynomials = (wrapped(polynomial_text(system.unknowns, polynomial)) for polynomial in system.polynomials)
    return (
        f"// {heading}.\n"
        "// Solutions with multiplicity: vdim(std(I)); it is quicker modulo a prime, with 2147483647 for the 0 below.\n"
        f"ring Q = 0,({','.join(system.unknowns)}),dp;\n"
        "ideal I =\n" + ",\n".join(polynomials) + ";\n"
    )
