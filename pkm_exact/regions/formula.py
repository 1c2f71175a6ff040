"""Conditions on a pose as signs of polynomials, joined by and and or.

The variables are those of a chart, and one for each square root: y_i >= 0 with y_i^2 = D_i, a polynomial of the chart's
variables. No polynomial has a square of a y_i. Where a D_i is negative the conditions do not hold, whatever the signs.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from pkm_exact.regions.chart import Polynomial


class Sign(StrEnum):
    """What an atom asks of its polynomial."""

    POSITIVE = "positive"
    NOT_NEGATIVE = "not-negative"
    NOT_ZERO = "not-zero"


@dataclass(frozen=True, eq=False)
class Atom:
    """A condition on the sign of a polynomial.

    Attributes
    ----------
    name : str
        What it is about, for messages.
    polynomial : fmpq_mpoly
        Where it has the sign, the condition holds.
    sign : Sign
    loose : fmpq_mpoly or None
        Where it has not the sign, the condition does not hold; the polynomial itself if None. They differ where the
        condition has irrational numbers in it.
    """

    name: str
    polynomial: Polynomial
    sign: Sign = Sign.NOT_NEGATIVE
    loose: Polynomial | None = None


@dataclass(frozen=True, eq=False)
class Regular:
    """That a matrix is regular. Each root is in one row only. Nothing proves that it is so nowhere in a box.

    Attributes
    ----------
    name : str
    rows : tuple of tuples of fmpq_mpoly
        Square.
    """

    name: str
    rows: tuple[tuple[Polynomial, ...], ...]


@dataclass(frozen=True, eq=False)
class All:
    """All of the parts hold."""

    parts: tuple[Formula, ...]


@dataclass(frozen=True, eq=False)
class Some:
    """At least one of the parts holds."""

    parts: tuple[Formula, ...]


Formula: TypeAlias = Atom | Regular | All | Some


def atoms_of(formula: Formula) -> list[Atom]:
    """The atoms that are signs of polynomials, from left to right."""
    return [part for part in _leaves(formula) if isinstance(part, Atom)]


def matrices_of(formula: Formula) -> list[Regular]:
    """The matrices, from left to right."""
    return [part for part in _leaves(formula) if isinstance(part, Regular)]


def _leaves(formula: Formula) -> list[Atom | Regular]:
    if isinstance(formula, Atom | Regular):
        return [formula]
    return [leaf for part in formula.parts for leaf in _leaves(part)]


def beyond(region: Formula) -> Formula:
    """That a point is not in a region, whose atoms are all that something is not negative.

    Examples
    --------
    >>> from flint import Ordering, fmpq_mpoly_ctx
    >>> (x,) = fmpq_mpoly_ctx.get(("x",), Ordering.lex).gens()
    >>> atom = beyond(Atom("in it", x))
    >>> print(atom.polynomial, atom.sign)
    -x positive
    """
    if isinstance(region, Atom):
        loose = region.polynomial if region.loose is None else region.loose
        return Atom("beyond the region", -loose, Sign.POSITIVE, None if region.loose is None else -region.polynomial)
    if isinstance(region, Regular):
        raise TypeError("no region is made of matrices")
    parts = tuple(beyond(part) for part in region.parts)
    return Some(parts) if isinstance(region, All) else All(parts)
