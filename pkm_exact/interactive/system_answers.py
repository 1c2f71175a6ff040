"""The door for polynomial systems: ``solve_system``, and what it returns, which certifies, checks and saves itself."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields
from fractions import Fraction
from functools import partial
from html import escape
from typing import TYPE_CHECKING, Any, Final

import pkm_exact.systems.system_solution as system_solutions
from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.errors import InputError
from pkm_exact.policy import Policy
from pkm_exact.poses.boxes import DEFAULT_WIDTH
from pkm_exact.stages import Progress
from pkm_exact.systems.system_engine import Proposal, solved_system
from pkm_exact.systems.system_sources import polynomial_system
from pkm_exact.wording import TOO_LARGE, shown

if TYPE_CHECKING:
    from pkm_exact.certify.certificate import Certificate
    from pkm_exact.certify.checker.verdict import Verdict

ORACLES = ("internal", "msolve")
LEAST_IN_DOUBT: Final = Fraction(1, 400)
"""Real roots times degree times bits of an eliminant, for each operation that checkers allow: no certificate below was
ever too large."""


@dataclass(frozen=True, repr=False)
class SystemSolution(system_solutions.SystemSolution):
    __doc__ = system_solutions.SystemSolution.__doc__

    def certificate(self, title: str = "") -> Certificate:
        """What was found, in a form that a program checks which shares nothing with the solver."""
        from pkm_exact.certify.certificate import Certificate
        from pkm_exact.certify.system_build import system_certificate_bytes

        return Certificate(system_certificate_bytes(self, title))

    def check(self) -> Verdict:
        """The verdict of the checker on the certificate.

        Examples
        --------
        >>> str(solve_system(["x^2 = 2"]).check().status)
        'accepted'
        """
        return self.certificate().check()

    def save(self, path: str | os.PathLike[str], title: str = "") -> None:
        """Write the certificate to a file, which appears whole or not at all.

        Raises
        ------
        InputError
            If the file cannot be written.

        Warns
        -----
        UserWarning
            If to check it takes more work than checkers allow.
        """
        certificate = self.certificate(title)
        certificate.save(path)
        if is_beyond_checkers(self, certificate.data):
            warnings.warn(f"{os.fspath(path)}: {TOO_LARGE}", stacklevel=2)

    def _repr_html_(self) -> str:
        return f"<p>{escape(str(self))}</p>"


def is_beyond_checkers(solution: system_solutions.SystemSolution, data: bytes) -> bool:
    """Whether checkers call its certificate too-large: asked of them if the eliminant is long, with many real roots."""
    if solution.representation is None:
        return False
    from pkm_exact.certify.check import check_bytes
    from pkm_exact.certify.checker.budget import Budget
    from pkm_exact.certify.checker.verdict import Status

    eliminant = solution.representation.primitive_polynomial
    size = solution.real_solutions * int(eliminant.degree()) * int(eliminant.height_bits())
    return size >= LEAST_IN_DOUBT * Budget(len(data)).limit and check_bytes(data).status is Status.TOO_LARGE


def solve_system(
    polynomials: Iterable[Any] | PolynomialSystem,
    variables: Sequence[Any] | None = None,
    *,
    width: Fraction = DEFAULT_WIDTH,
    policy: Policy | None = None,
    oracle: str = "internal",
    progress: Progress | None = None,
) -> SystemSolution:
    """All solutions of a system of polynomial equations with rational coefficients, and what is proved about them.

    Parameters
    ----------
    polynomials : iterable
        Texts such as ``"x^2 + y^2 = 1"``, which are parsed and never evaluated; polynomials of python-flint; or SymPy
        expressions or equations. Coefficients are exact: binary floats are refused.
    variables : sequence, optional
        Their names, or SymPy symbols, in the order wanted. By default those that appear.
    width : Fraction
        Greatest width of a box, for each variable.
    policy : Policy, optional
        Limits and random choices.
    oracle : {"internal", "msolve"}
        Who finds the solutions. What msolve says is verified; it must be installed.
    progress : callable, optional
        Gets the name of each stage when it starts.

    Raises
    ------
    InputError
        If one of the polynomials is none, or the system exceeds a limit.
    PkmExactError
        If a limit of the policy is met, or an oracle does not answer or is wrong.

    Examples
    --------
    >>> found = solve_system(["x^2 + y^2 = 4", "x*y = 1"])
    >>> print(found)
    4 complex solutions, 4 real; complete: it is proved that there is no other
    >>> found.completeness_route, found.solutions[0].multiplicity
    (<SystemRoute.REFINED_BEZOUT: 'refined-bezout'>, 1)
    >>> print(found.solutions[0].values[0])
    -1.931851653
    >>> print(found.check().status)
    accepted
    """
    system = polynomials if isinstance(polynomials, PolynomialSystem) else polynomial_system(polynomials, variables)
    found = solved_system(system, width=width, policy=policy, progress=progress, propose=_proposal(oracle))
    return SystemSolution(**{entry.name: getattr(found, entry.name) for entry in fields(found)})


def _proposal(oracle: str) -> Proposal | None:
    if oracle not in ORACLES:
        raise InputError(f"oracle: {shown(oracle)} is not known; give one of {', '.join(ORACLES)}")
    if oracle == "internal":
        return None
    from pkm_exact.backends.msolve_oracle import msolve_proposal

    return partial(msolve_proposal)
