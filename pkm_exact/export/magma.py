"""A script for Magma."""

from __future__ import annotations

from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.export.polynomial_text import polynomial_text, wrapped


def write(system: PolynomialSystem, heading: str) -> str:
    """A polynomial ring over Q, degree reverse lexicographic, and an ideal."""
    polynomials = (wrapped(polynomial_text(system.unknowns, polynomial)) for polynomial in system.polynomials)
    return (
        f"// {heading}.\n"
        "// Solutions with multiplicity: QuotientDimension(I);\n"
        f'P<{",".join(system.unknowns)}> := PolynomialRing(RationalField(), {len(system.unknowns)}, "grevlex");\n'
        "I := ideal<P |\n" + ",\n".join(polynomials) + ">;\n"
    )
