"""The writers by the names of the programs they write for. Importing this module is cheap."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import TYPE_CHECKING, Final, cast

from pkm_exact.errors import InputError
from pkm_exact.wording import printable

if TYPE_CHECKING:
    from pkm_exact.algebra.system import PolynomialSystem

Writer = Callable[["PolynomialSystem", str], str]

TARGETS: Final = ("msolve", "singular", "magma", "maple", "phcpack", "sympy", "latex")
"""Programs that can be written for: a module of this package each, with a function ``write(system, heading)``."""


def export(system: PolynomialSystem, target: str, heading: str = "") -> str:
    """The system as a complete input file of another program, coefficients exact.

    Parameters
    ----------
    system : PolynomialSystem
    target : str
        One of ``TARGETS``.
    heading : str
        One line for a comment, where the syntax has comments.

    Raises
    ------
    InputError
        If the target is unknown.

    Examples
    --------
    >>> from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring
    >>> x, y = polynomial_ring(("x", "y")).gens()
    >>> print(export(PolynomialSystem(("x", "y"), (x**2 - 3 * y, x - 1)), "msolve"), end="")
    x,y
    0
    1*x^2-3*y,
    1*x-1
    """
    if target not in TARGETS:
        raise InputError(f"target: {target[:40]!r} is unknown; use one of {', '.join(TARGETS)}")
    writer = cast(Writer, import_module(f"pkm_exact.export.{target}").write)
    return writer(system, ascii(printable(heading))[1:-1] if heading else "a polynomial system")
