"""A script for Maple."""

from __future__ import annotations

from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.export.polynomial_text import polynomial_text, wrapped


def write(system: PolynomialSystem, heading: str) -> str:
    """A list of unknowns and a list of polynomials."""
    polynomials = (wrapped(polynomial_text(system.unknowns, polynomial)) for polynomial in system.polynomials)
    return (
        f"# {heading}.\n"
        "# Solutions with multiplicity:\n"
        "# order := tdeg(op(unknowns)): nops(Groebner:-NormalSet(Groebner:-Basis(equations, order), order)[1]);\n"
        f"unknowns := [{','.join(system.unknowns)}]:\n"
        "equations := [\n" + ",\n".join(polynomials) + "]:\n"
    )
