"""The input of msolve, which has no comments."""

from __future__ import annotations

from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.backends.msolve_program import msolve_input


def write(system: PolynomialSystem, _heading: str) -> str:
    """Unknowns, characteristic 0, and polynomials separated by commas."""
    return msolve_input(system)
