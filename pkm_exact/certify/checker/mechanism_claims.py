"""Counts and claims of a certificate of version 2: what follows from what is listed; no more and no less is claimed."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from flint import fmpz_poly

from pkm_exact.certify.checker.claims import check_listed_multiplicities
from pkm_exact.certify.checker.document import Representation
from pkm_exact.certify.checker.elimination import Elimination, Steps
from pkm_exact.certify.checker.infinity_points import check_infinity
from pkm_exact.certify.checker.mechanism_document import Infinity, MechanismDocument
from pkm_exact.certify.checker.mechanism_forms import Mechanism
from pkm_exact.certify.checker.mechanism_section import Section, is_finite, solutions_at_most
from pkm_exact.certify.checker.mechanism_solutions import are_regular, irregular_factors
from pkm_exact.certify.checker.multiplicity import multiplicities_of
from pkm_exact.certify.checker.packed_monomials import Monomial
from pkm_exact.certify.checker.solutions import primitive_part
from pkm_exact.certify.checker.traceform import quotient_algebra
from pkm_exact.certify.checker.verdict import GREATEST_NUMBER, rejected


@dataclass(frozen=True)
class _Listed:
    """The solutions listed.

    Attributes
    ----------
    distinct : int
    representation : Representation or None
        If there is none, all are proved simple, in boxes, or there is nothing listed.
    mechanism : Mechanism
    """

    distinct: int
    representation: Representation | None
    mechanism: Mechanism

    @cached_property
    def irregular(self) -> tuple[fmpz_poly, ...]:
        """The factors of h at whose roots the constraints are dependent: there the weight is 2."""
        found, mechanism = self.representation, self.mechanism
        if found is None or are_regular(primitive_part(found.eliminant), found, mechanism):
            return ()
        return tuple(irregular_factors(found, mechanism))

    @property
    def simple(self) -> bool:
        """Whether all are proved simple."""
        return not self.irregular

    @property
    def weight(self) -> int:
        """The sum of all weights: multiplicities sum to it at least."""
        return self.distinct + sum(int(factor.degree()) for factor in self.irregular)

    @property
    def doubled(self) -> tuple[tuple[fmpz_poly, int], ...]:
        """The factors at whose roots multiplicities are 2, if they sum to the weight."""
        return tuple((factor, 2) for factor in self.irregular)


@dataclass(frozen=True)
class _Proved:
    """Claim and route that are proved, and the number with multiplicity and the multiple factors, if known."""

    claim: str
    route: str | None
    total: int | None
    multiple: tuple[tuple[fmpz_poly, int], ...] = ()


def check_mechanism_claims(document: MechanismDocument) -> Iterator[str]:
    """Claim, route, counts and multiplicities are those that can be proved."""
    if document.real_poses != len(document.poses):
        raise rejected(f"real poses: {document.real_poses} claimed, {len(document.poses)} listed")
    if document.box_exponent and not document.poses:
        raise rejected("boxes: a grid is given, but there is no pose")
    _check_parts(document)
    if document.claim == "positive-dimensional-proved":
        yield from _moving(document)
        return
    if document.self_motion is not None:
        raise rejected(f"claim: {document.claim}, but a self-motion is given")
    listed = _listed(document)
    if document.distinct_solutions != listed.distinct:
        raise rejected(f"distinct solutions: {document.distinct_solutions} claimed, {listed.distinct} proved")
    if document.isolated is not None and document.method == "exact":
        yield from _beside(document, listed)
        return
    proved = yield from _proved(document, listed)
    if (document.claim, document.route) != (proved.claim, proved.route):
        claimed = f"{document.claim} by {document.route or 'no route'}"
        raise rejected(f"claim: {claimed}, but what is proved is {proved.claim} by {proved.route or 'no route'}")
    _check_total(document, listed, proved)
    check_listed_multiplicities(document.poses, proved.total is not None, proved.multiple)
    yield _line(document, listed, proved)


def _check_parts(document: MechanismDocument) -> None:
    """What a certificate may have depends on its method and its route."""
    if document.method == "krawczyk":
        alone = document.representation is None and document.self_motion is None
        if document.isolated is None or not alone:
            raise rejected("method: krawczyk needs boxes, and neither a representation nor a self-motion")
    elif document.isolated is not None and not document.claim.startswith("positive-dimensional"):
        raise rejected("method: exact, but solutions in boxes are listed, and none of positive dimension is claimed")
    for part, route in ((document.infinity, "counting-at-infinity"), (document.elimination, "exact-elimination")):
        if (part is not None) != (document.route == route):
            raise rejected(f"claim: the route is not {route}")


def _listed(document: MechanismDocument) -> _Listed:
    representation, mechanism = document.representation, document.mechanism
    if document.isolated is not None:
        return _Listed(document.isolated.count, None, mechanism)
    if representation is None:
        if document.poses:
            raise rejected("representation: missing, but poses are listed")
        return _Listed(0, None, mechanism)
    return _Listed(int(representation.eliminant.degree()), representation, mechanism)


def _proved(document: MechanismDocument, listed: _Listed) -> Generator[str, None, _Proved]:
    """The strongest claim that the certificate proves; a generator that returns it.

    Where there is room for each solution once, all are simple: at others the constraints and the motions have a tangent
    in common.
    """
    mechanism = document.mechanism
    complete = "complete" if listed.distinct else "inconsistent"
    if document.infinity is not None:
        yield from _check_infinity(document.infinity, listed)
        return _Proved(complete, "counting-at-infinity", listed.weight, listed.doubled)
    if document.elimination is not None:
        total, multiple = _filling(document, listed)
        return _Proved(complete, "exact-elimination", total, multiple)
    if mechanism.least_bound <= listed.distinct == mechanism.bound and listed.simple:
        route = "refined-bezout" if mechanism.bound == mechanism.degree_bound else "product-bound"
        return _Proved("complete", route, listed.distinct)
    if document.route == "modular-rank":
        room = solutions_at_most(mechanism)
        if room == listed.distinct:
            return _Proved(complete, "modular-rank", room)
        if room == listed.weight:
            return _Proved(complete, "modular-rank", room, listed.doubled)
    if not listed.distinct and document.claim == "positive-dimensional-detected":
        return _Proved(document.claim, None, 0)
    return _Proved("not-proven-complete", None, listed.distinct if listed.simple else None)


def _check_infinity(infinity: Infinity, listed: _Listed) -> Iterator[str]:
    """The solutions listed and the points at infinity are as many as the degree of the motions."""
    mechanism = listed.mechanism
    if mechanism.group.dimension != 6:
        raise rejected("infinity: points at infinity are counted for spatial motions only")
    if mechanism.quadrics:
        raise rejected("infinity: points at infinity are not counted where there are cylinders")
    yield from check_infinity(infinity, mechanism)
    if listed.weight + infinity.multiplicity != GREATEST_NUMBER:
        raise rejected(
            f"infinity: {listed.weight} finite and {infinity.multiplicity} at infinity are not "
            f"{GREATEST_NUMBER}, the degree of the motions"
        )
    if not is_finite(mechanism):
        raise rejected("section: not proved finite")
    yield "section: finite, points at infinity included"


def _filling(document: MechanismDocument, listed: _Listed) -> tuple[int, tuple[tuple[fmpz_poly, int], ...]]:
    """Number of all solutions with multiplicity, and the multiple factors; those listed must fill the elimination."""
    mechanism = document.mechanism
    section = Section(mechanism)
    steps = document.elimination or ()
    if steps and section.is_empty:
        raise rejected("elimination: a step names an element that there is not")
    followed = Steps(section.elimination, steps)
    room = followed.room(2 * listed.distinct, mechanism.degree_bound)
    if room == listed.distinct:
        return room, ()
    if room == listed.weight:
        return room, listed.doubled
    basis = followed.elimination.standard(mechanism.degree_bound)
    if len(basis) == listed.weight:
        return len(basis), listed.doubled
    if listed.simple or listed.representation is None:
        raise rejected(
            f"elimination: it leaves {len(basis)} monomials, the solutions listed are proved to fill {listed.weight}"
        )
    return len(basis), _by_algebra(followed.elimination, basis, listed.representation, listed, section.free)


def _by_algebra(
    elimination: Elimination,
    basis: Sequence[Monomial],
    representation: Representation,
    listed: _Listed,
    free: Sequence[int],
) -> tuple[tuple[fmpz_poly, int], ...]:
    """The multiple factors, as the algebra that the elimination leaves tells them."""
    algebra = quotient_algebra(elimination, basis)
    if algebra is None or algebra.distinct_solutions() != listed.distinct:
        raise rejected("elimination: the solutions are not proved to fill the monomials that it leaves")
    found = multiplicities_of(algebra, representation, listed.mechanism.metric, free)
    if found is None:
        raise rejected("elimination: no form in its unknowns tells the multiple solutions apart")
    return tuple((factor, multiplicity) for factor, multiplicity in found if multiplicity > 1)


def _check_total(document: MechanismDocument, listed: _Listed, proved: _Proved) -> None:
    """The number with multiplicity is the proved one; an unproved one must at least be possible."""
    claimed = document.complex_solutions
    if proved.total is not None and claimed != proved.total:
        raise rejected(f"complex solutions: {claimed} claimed, {proved.total} proved")
    if claimed != listed.distinct and not listed.distinct < claimed <= document.mechanism.bound:
        raise rejected(f"complex solutions: {claimed} claimed, {listed.distinct} distinct ones proved")


def _line(document: MechanismDocument, listed: _Listed, proved: _Proved) -> str:
    if proved.claim == "inconsistent":
        return "inconsistent: no pose, real or complex, has what the constraints ask"
    if proved.claim == "positive-dimensional-detected":
        return "positive dimension detected: evidence found by the solver, no proof"
    if proved.claim == "complete":
        total = f"{listed.distinct} distinct, {proved.total} with multiplicity"
        return f"complete: {total}, by {document.route}; there is no other solution"
    return f"not proven complete: {listed.distinct} solutions are proved, others are not excluded"


def _beside(document: MechanismDocument, listed: _Listed) -> Iterator[str]:
    """Isolated solutions in boxes beside a set of positive dimension that was only detected."""
    alone = document.representation is None and document.route is None
    if not alone or document.claim != "positive-dimensional-detected":
        raise rejected(f"claim: {document.claim} is not proved by what is in the certificate")
    _require_isolated(document, listed.distinct)
    yield f"isolated: {listed.distinct} solutions lie on no curve of poses"
    yield "positive dimension detected: evidence found by the solver, no proof"


def _require_isolated(document: MechanismDocument, count: int) -> None:
    """The numbers are those of the boxes, which are fewer than there can be isolated solutions."""
    if (document.complex_solutions, document.distinct_solutions) != (count, count):
        raise rejected(f"complex solutions: {document.complex_solutions} claimed, {count} proved in boxes")
    if count >= document.mechanism.bound:
        raise rejected(f"claim: {document.claim}, but {count} isolated solutions are all that there are")
    if any(pose.multiplicity != 1 for pose in document.poses):
        raise rejected("multiplicity: that of a pose in a box differs from what is proved")


def _moving(document: MechanismDocument) -> Iterator[str]:
    """A set of positive dimension that is proved; isolated solutions beside it need boxes."""
    from pkm_exact.certify.checker.mechanism_motion import check_mechanism_motion  # few certificates need it

    if document.self_motion is None:
        raise rejected("claim: positive-dimensional-proved, but no self-motion is given")
    if document.route is not None:
        raise rejected("claim: beside positive dimension, completeness is claimed")
    if document.isolated is None:
        if (document.complex_solutions, document.distinct_solutions, len(document.poses)) != (0, 0, 0):
            raise rejected("claim: beside positive dimension, isolated solutions are claimed without boxes")
    else:
        _require_isolated(document, document.isolated.count)
        yield f"isolated: {document.isolated.count} solutions lie on no curve of poses"
    yield from check_mechanism_motion(document, document.self_motion)
