"""The interface that every formulation of the forward kinematics problem offers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from pkm_exact.formulations.base import FormulatedProblem
    from pkm_exact.geometry.problem import ForwardProblem


class Formulation(Protocol):
    """A way to write a forward kinematics problem as polynomials: a code, a title, and a function."""

    @property
    def code(self) -> str:
        """Short name, as in the literature."""
        ...

    @property
    def title(self) -> str:
        """One line that says which unknowns it uses."""
        ...

    def refusal(self, problem: ForwardProblem) -> str | None:
        """Why it cannot write a problem, by its constraints and motions alone; None if it can."""
        ...

    def formulate(self, problem: ForwardProblem) -> FormulatedProblem:
        """The problem's system in this formulation's own unknowns.

        Raises
        ------
        InputError
            If the formulation does not apply to the robot; the sentence says why.
        """
        ...
