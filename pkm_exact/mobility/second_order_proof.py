"""What proves the bounds of a finite mobility beyond the first order, piece by piece, for certificates."""

from __future__ import annotations

from dataclasses import dataclass

from pkm_exact.mobility.algebraic_curve import AlgebraicCurve
from pkm_exact.mobility.closure_series import higher_order
from pkm_exact.mobility.finite_mobility import Argument, Finite, smooth_argument
from pkm_exact.mobility.instantaneous_mobility import Instantaneous
from pkm_exact.mobility.local_ring import local_degree
from pkm_exact.mobility.second_order import (
    Obstruction,
    closing_degree,
    obstructions,
    section_vectors,
    signature,
    squares,
)
from pkm_exact.screws.exact_matrix import Row


@dataclass(frozen=True)
class SecondOrderProof:
    """Why the mobility is not greater, and not less.

    Attributes
    ----------
    dependencies : tuple of rows
        Vectors u with u M = 0 whose forms are used.
    above : str
        "rank", "cone", "definite", "order" or "local".
    section : tuple of rows
        Motions that span what the cone is cut with.
    degree : int
        In which all monomials on the section are multiples of the forms, or in the ideal; 0 without a section.
    below : str or None
        None if nothing is claimed, "indefinite", "curve", "curves", or the argument that applies with freedoms locked.
    signs : tuple of rows
        A motion at which the first form is positive, and one at which it is negative.
    series : tuple of rows
        The terms of the only curve there can be, for "order".
    curve : tuple of pairs of rows
        Numerators and denominators of the half tangents along a curve, for "curve".
    curves : tuple of AlgebraicCurve
        For "curves".
    """

    dependencies: tuple[Row, ...]
    above: str
    section: tuple[Row, ...] = ()
    degree: int = 0
    below: str | None = None
    signs: tuple[Row, ...] = ()
    series: tuple[Row, ...] = ()
    curve: tuple[tuple[Row, Row], ...] = ()
    curves: tuple[AlgebraicCurve, ...] = ()

    @property
    def is_of_second_order(self) -> bool:
        """Whether nothing beyond is used."""
        return not self.series and not self.curve and not self.is_of_the_ideal

    @property
    def is_of_the_ideal(self) -> bool:
        """Whether the local ring or curves are used."""
        return self.above == "local" or self.below == "curves"


def second_order_proof(free: Instantaneous, finite: Finite) -> SecondOrderProof | None:
    """The proof of the bounds of a finite mobility; None if they say nothing, or a smooth argument says all.

    Examples
    --------
    >>> from pkm_exact import mobility_of, read_linkage
    >>> found = mobility_of(read_linkage("models/chains/seven-link-oblique.toml"))
    >>> proof = second_order_proof(found.free, found.finite)
    >>> proof.above, proof.degree, proof.below
    ('cone', 2, 'subgroups')
    """
    smooth = finite.argument in (Argument.REGULAR, Argument.SUBGROUPS)
    if smooth or (finite.least, finite.most) == (0, free.total):
        return None
    if finite.argument in (Argument.HIGHER_ORDER, Argument.CURVE):
        return _of_higher_order(free)
    forms = obstructions(free)
    known = tuple(entry.factors for entry in forms)
    below, signs = _below(free, finite, forms)
    if finite.is_by_local_ring:
        section = section_vectors(free.total, finite.most)
        degree = local_degree(free, section)
        return SecondOrderProof((), "local", section, degree or 0, below, signs, curves=finite.curves)
    if finite.most == free.total:
        return SecondOrderProof((), "rank", below=below, curves=finite.curves)
    for entry in forms:
        if finite.most == 0 and signature(entry.form, free.total).is_definite:
            sign = 1 if squares(entry.form, free.total)[0][0] > 0 else -1
            return SecondOrderProof((tuple(sign * x for x in entry.factors),), "definite")
    degree = closing_degree(free, finite.most)
    if degree is None:  # one less than the motions, but the first form is 0 on the vector that would be looked at
        return SecondOrderProof(known, "cone", (squares(forms[0].form, free.total)[0][1],), 2, below, signs)
    section = section_vectors(free.total, finite.most)
    return SecondOrderProof(known, "cone", section, degree, below, signs, curves=finite.curves)


def _of_higher_order(free: Instantaneous) -> SecondOrderProof | None:
    found = higher_order(free)
    if found is None:
        return None
    if found.curve:
        return SecondOrderProof((), "rank", below="curve", curve=found.curve)
    return SecondOrderProof((found.factors,), "order", degree=len(found.terms) + 1, series=found.terms)


def _below(free: Instantaneous, finite: Finite, forms: list[Obstruction]) -> tuple[str | None, tuple[Row, ...]]:
    """By what the lower bound is proved, and motions at which the first form has both signs."""
    if not finite.least:
        return None, ()
    if finite.curves:
        return "curves", ()
    if finite.locked:
        return str(smooth_argument(free.linkage, finite.locked)), ()
    values = squares(forms[0].form, free.total)
    return "indefinite", tuple(next(y for value, y in values if sign * value > 0) for sign in (1, -1))
