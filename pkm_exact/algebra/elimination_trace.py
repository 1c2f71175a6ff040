"""What an elimination modulo a prime did, and which of it mattered: enough to repeat it at another prime, or over Q."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from pkm_exact.algebra.reduction import Row, reducing_rows, row_echelon, row_matrix
from pkm_exact.algebra.system import ModularPolynomial

Chooser: TypeAlias = Callable[[Sequence[Row], Sequence[ModularPolynomial], int], list[Row]]
"""Of rows, which are multiples of known polynomials modulo a prime, some with the same row space."""


@dataclass(frozen=True)
class Step:
    """One matrix: the rows that span its row space, all its leading monomials, and those of them that are new."""

    rows: tuple[Row, ...]
    leading: frozenset[int]
    new: tuple[int, ...]


@dataclass(frozen=True)
class Trace:
    """What an elimination did: enough to repeat it at another prime without a search."""

    start: tuple[int, ...]
    steps: tuple[Step, ...]
    basis: tuple[int, ...]


@dataclass(frozen=True)
class Course:
    """All that an elimination did, of which ``trace`` is what mattered.

    Attributes
    ----------
    steps : tuple of Step
        With all rows that were reduced.
    known : tuple of (packed monomials, coefficients)
        The elements that they are multiples of; those of the echelon form of the generators come first.
    generators : int
        How many these are.
    """

    steps: tuple[Step, ...]
    known: tuple[ModularPolynomial, ...]
    generators: int

    def trace(self, basis: Sequence[int], prime: int) -> Trace:
        """The first rows that mattered (one more elimination a step), for the basis elements with these indices."""
        return self._trace(basis, prime, _spanning_rows)

    def way(self, basis: Sequence[int], prime: int) -> Trace:
        """The same with those rows that are least work to follow at another prime."""
        return self._trace(basis, prime, reducing_rows)

    def _trace(self, basis: Sequence[int], prime: int, chosen: Chooser) -> Trace:
        steps = (
            Step(tuple(chosen(step.rows, self.known, prime)), step.leading, step.new) for step in self.steps if step.new
        )
        start = tuple(element[0][0] for element in self.known[: self.generators])
        return Trace(start, tuple(steps), tuple(basis))


def _spanning_rows(rows: Sequence[Row], known: Sequence[ModularPolynomial], prime: int) -> list[Row]:
    """The first rows that form a basis of the row space."""
    columns = sorted({monomial + multiplier for index, multiplier in rows for monomial in known[index][0]})
    return [rows[index] for index in row_echelon(row_matrix(rows, known, columns, prime).transpose())[1]]
