r"""A LaTeX document. Equations are set in running text, which breaks them into lines."""

from __future__ import annotations

import re

from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.export.polynomial_text import polynomial_text, wrapped

_NAME = re.compile(r"([a-zA-Z]+)([0-9]*)")


def write(system: PolynomialSystem, heading: str) -> str:
    r"""A document with a numbered list of equations.

    Examples
    --------
    >>> from pkm_exact.algebra.system import polynomial_ring
    >>> c1, r12 = polynomial_ring(("c1", "r12")).gens()
    >>> text = write(PolynomialSystem(("c1", "r12"), (c1**2 - 3 * c1 * r12,)), "one equation")
    >>> text.split("\n")[6]
    '\\item $c_{1}^{2}-3\\,c_{1}\\,r_{12}=0$'
    """
    items = []
    for polynomial in system.polynomials:
        text = polynomial_text(system.unknowns, polynomial, power="^", times=r"\,", name=symbol)
        braced = re.sub(r"\^([0-9]+)", r"^{\1}", text)
        items.append(rf"\item ${wrapped(braced)}=0$")
    unknowns = ", ".join(map(symbol, system.unknowns))
    return "\n".join(
        [
            f"% {heading}.",
            r"\documentclass{article}",
            r"\begin{document}",
            r"\raggedright",
            rf"Unknowns: ${unknowns}$.",
            r"\begin{enumerate}",
            *items,
            r"\end{enumerate}",
            r"\end{document}",
            "",
        ]
    )


def symbol(name: str) -> str:
    r"""A name in letters and digits as a symbol with an index.

    >>> symbol("r12"), symbol("cos1")
    ('r_{12}', '\\mathrm{cos}_{1}')
    """
    match = _NAME.fullmatch(name)
    if match is None:
        raise ValueError(f"{name!r} is not letters followed by digits")
    letters, digits = match.groups()
    base = letters if len(letters) == 1 else rf"\mathrm{{{letters}}}"
    return f"{base}_{{{digits}}}" if digits else base
