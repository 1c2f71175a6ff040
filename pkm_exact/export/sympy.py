"""A Python module for SymPy. SymPy itself is not needed to write it."""

from __future__ import annotations

from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.export.polynomial_text import polynomial_text, wrapped


def write(system: PolynomialSystem, heading: str) -> str:
    """The names ``unknowns`` and ``equations``: symbols, and polynomials in them.

    Examples
    --------
    >>> from pkm_exact.algebra.system import polynomial_ring
    >>> x, y = polynomial_ring(("x", "y")).gens()
    >>> print(write(PolynomialSystem(("x", "y"), (x**2 - 3 * y, x - 1)), "two equations"), end="")
    from sympy import symbols
    <BLANKLINE>
    # two equations.
    x, y = unknowns = symbols("x y")
    equations = [
        x**2-3*y,
        x-1,
    ]
    """
    lines = []
    for polynomial in system.polynomials:
        text = wrapped(polynomial_text(system.unknowns, polynomial, power="**"))
        lines.append("    " + text.replace("\n", "\n    ") + ",\n")
    return (
        # Not in the first line, where Python looks for a codec in comments.
        "from sympy import symbols\n\n"
        f"# {heading}.\n"
        f'{", ".join(system.unknowns)} = unknowns = symbols("{" ".join(system.unknowns)}")\n'
        "equations = [\n" + "".join(lines) + "]\n"
    )
