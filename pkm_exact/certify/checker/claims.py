"""Counts and claims: what follows from the solutions listed; a certificate must claim it, no more and no less."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from flint import fmpq, fmpz_poly

from pkm_exact.certify.checker.budget import charge, limbs, value_cost
from pkm_exact.certify.checker.document import Document, ListedPose, Representation
from pkm_exact.certify.checker.elimination import Row, eliminate
from pkm_exact.certify.checker.krawczyk import Isolated
from pkm_exact.certify.checker.multiplicity import (
    are_simple,
    dependent_factors,
    multiplicities,
)
from pkm_exact.certify.checker.selfmotion import check_self_motion
from pkm_exact.certify.checker.study_motion import PLANAR_LEGS
from pkm_exact.certify.checker.traceform import quotient_algebra
from pkm_exact.certify.checker.verdict import GREATEST_NUMBER, PLANAR_NUMBER, rejected


@dataclass(frozen=True)
class _Proved:
    """What is proved of all solutions.

    Attributes
    ----------
    claim, route : str, str or None
    total : int or None
        Their number with multiplicity, if it is known.
    multiple : tuple of (fmpz_poly, int)
        If it is known: the irreducible factors of h at whose roots they are multiple, with their multiplicities.
    """

    claim: str
    route: str | None
    total: int | None
    multiple: tuple[tuple[fmpz_poly, int], ...] = ()


def check_claims(document: Document) -> Iterator[str]:
    """The claim, its route, the counts and the multiplicities are those that can be proved."""
    if document.real_poses != len(document.poses):
        raise rejected(f"real poses: {document.real_poses} claimed, {len(document.poses)} listed")
    _check_parts(document)
    if document.isolated is not None:
        yield from _isolated_listed(document, document.isolated)
    elif document.representation is None:
        yield from _nothing_listed(document)
    elif document.claim == "positive-dimensional-proved":
        yield from check_self_motion(document, document.representation)
    else:
        yield from _solutions_listed(document, document.representation)
    if document.box_exponent and not document.poses:
        raise rejected("boxes: a grid is given, but there is no pose")


def _check_parts(document: Document) -> None:
    """What a certificate must have depends on its method and claim."""
    if document.method == "krawczyk":
        if document.isolated is None or document.representation is not None or document.elimination is not None:
            raise rejected("method: krawczyk needs boxes, and neither a representation nor an elimination")
    elif document.isolated is not None and not document.claim.startswith("positive-dimensional"):
        raise rejected("method: exact, but solutions in boxes are listed, and none of positive dimension is claimed")


def _isolated_listed(document: Document, isolated: Isolated) -> Iterator[str]:
    """Solutions in boxes that were proved: all of them, or isolated ones beside a set of positive dimension."""
    numbers = (document.complex_solutions, document.distinct_solutions)
    if numbers != (isolated.count, isolated.count):
        raise rejected(f"complex solutions: {numbers[0]}, {numbers[1]} distinct claimed, {isolated.count} proved")
    for place, pose in enumerate(document.poses, 1):
        if pose.multiplicity != 1:
            raise rejected(f"multiplicity: that of pose {place} differs from what is proved")
    degree = PLANAR_NUMBER if len(document.legs) == PLANAR_LEGS else GREATEST_NUMBER
    if document.method == "exact":
        if isolated.count == degree:
            raise rejected(f"claim: {document.claim}, but {degree} isolated solutions are all that there are")
        yield f"isolated: {isolated.count} solutions, {len(isolated.real)} of them real, lie on no curve of poses"
        alone = document.representation is None and document.elimination is None
        if document.claim == "positive-dimensional-proved" and document.representation is not None:
            yield from check_self_motion(document, document.representation)
        elif alone and (document.claim, document.route) == ("positive-dimensional-detected", None):
            yield "positive dimension detected: evidence found by the solver, no proof"
        else:
            raise rejected(f"claim: {document.claim} is not proved by what is in the certificate")
        return
    proved = ("complete", "refined-bezout") if isolated.count == degree else ("not-proven-complete", None)
    if (document.claim, document.route) != proved:
        raise rejected(f"claim: what is proved is {proved[0]} by {proved[1] or 'no route'}")
    if isolated.count == degree:
        yield f"complete: {degree} isolated solutions are the degree of the motions, there is no other"
    else:
        yield f"not proven complete: {isolated.count} solutions are proved, others are not excluded"


def _nothing_listed(document: Document) -> Iterator[str]:
    """Nothing listed: an elimination can prove that there is nothing, otherwise nothing is proved and none claimed."""
    if document.complex_solutions or document.distinct_solutions or document.poses:
        raise rejected("representation: missing, but solutions are claimed")
    proved = (document.elimination is not None, document.claim, document.route)
    if proved == (False, "not-proven-complete", None):
        yield "not proven complete: no solution is listed, and none is excluded"
    elif proved == (False, "positive-dimensional-detected", None):
        yield "positive dimension detected: evidence found by the solver, no proof"
    elif document.elimination is not None and proved[1:] == ("inconsistent", "exact-elimination"):
        eliminate(document.legs, document.metric, document.elimination).elimination.standard(0)
        yield "inconsistent: 1 = 0 follows from the leg lengths, there is no solution, real or complex"
    else:
        raise rejected(f"claim: {document.claim} is not proved by what is in the certificate")


def _solutions_listed(document: Document, representation: Representation) -> Iterator[str]:
    number = representation.eliminant.degree()
    if document.distinct_solutions != number:
        raise rejected(f"distinct solutions: {document.distinct_solutions} claimed, {number} proved")
    proved = _proved(document, representation)
    if (document.claim, document.route) != (proved.claim, proved.route):
        claimed = f"{document.claim} by {document.route or 'no route'}"
        raise rejected(f"claim: {claimed}, but what is proved is {proved.claim} by {proved.route or 'no route'}")
    _check_total(document.complex_solutions, number, proved.total)
    check_listed_multiplicities(document.poses, proved.total is not None, proved.multiple)
    yield _solutions_line(number, document.complex_solutions, proved)
    if proved.route == "refined-bezout":
        yield f"complete: {number} isolated solutions are the degree of the rigid motions, there is no other"
    elif proved.route == "exact-elimination":
        yield f"complete: polynomials over Q that vanish at all poses leave room for {proved.total}, there is no other"
    else:
        yield f"not proven complete: {number} solutions are proved, others are not excluded"


def _proved(document: Document, representation: Representation) -> _Proved:
    """The strongest claim that the certificate proves."""
    number = int(representation.eliminant.degree())
    if document.elimination is not None:
        total, multiple = _filling(document, representation, document.elimination)
        return _Proved("complete", "exact-elimination", total, multiple)
    simple = are_simple(representation, document.legs, document.metric)
    if simple and number == GREATEST_NUMBER and len(document.legs) > PLANAR_LEGS:
        return _Proved("complete", "refined-bezout", number)
    return _Proved("not-proven-complete", None, number if simple else None)


def _filling(
    document: Document, representation: Representation, steps: Sequence[Sequence[Row]]
) -> tuple[int, tuple[tuple[fmpz_poly, int], ...]]:
    """Number of all solutions with multiplicity, and the factors of h at multiple ones; those listed must be all.

    They are if they fill what the elimination leaves, simple ones once and singular ones twice; or else if the algebra
    on what is left has no more distinct solutions. It then tells the multiplicities. Where there is room for each once,
    all are simple: at one with dependent leg lines the legs and the motions have a tangent in common.
    """
    legs, metric = document.legs, document.metric
    number = int(representation.eliminant.degree())
    followed = eliminate(legs, metric, steps)
    room = followed.room(2 * number, GREATEST_NUMBER)
    if room == number:
        return number, ()
    dependent = dependent_factors(representation, legs, metric)
    weight = number + sum(int(factor.degree()) for factor in dependent)
    doubled = tuple((factor, 2) for factor in dependent)
    if room == weight:
        return room, doubled
    basis = followed.elimination.standard(GREATEST_NUMBER)
    if len(basis) == weight:
        return weight, doubled
    if not dependent:
        raise rejected(f"elimination: it leaves {len(basis)} monomials, but the {number} solutions are proved simple")
    algebra = quotient_algebra(followed.elimination, basis)
    if algebra is None or algebra.distinct_solutions() != number:
        raise rejected(f"elimination: it leaves {len(basis)} monomials, the solutions are not proved to fill them")
    found = multiplicities(algebra, representation, legs, metric)
    if found is None:
        raise rejected("elimination: no form in its unknowns tells the multiple solutions apart")
    # Not what a prime left: that bounds the number, but may be more.
    return len(basis), tuple((factor, multiplicity) for factor, multiplicity in found if multiplicity > 1)


def _check_total(claimed: int, number: int, proved: int | None) -> None:
    """The number with multiplicity is the proved one; an unproved one must at least be possible."""
    if proved is not None and claimed != proved:
        raise rejected(f"complex solutions: {claimed} claimed, {proved} proved")
    if not number <= claimed <= GREATEST_NUMBER:
        raise rejected(f"complex solutions: {claimed} claimed, {number} distinct ones proved")


def check_listed_multiplicities(
    poses: Sequence[ListedPose], known: bool, multiple: Sequence[tuple[fmpz_poly, int]]
) -> None:
    """Null if they are not all known; otherwise those that were found, by factors of h, and 1 at the others."""
    for place, pose in enumerate(poses, 1):
        here = [multiplicity for factor, multiplicity in multiple if _has_root(factor, pose)]
        expected = None if not known else here[0] if here else 1
        if pose.multiplicity != expected:
            raise rejected(f"multiplicity: that of pose {place} differs from what is proved")


def _has_root(factor: fmpz_poly, pose: ListedPose) -> bool:
    """Whether a factor of h has the root of h that the pose's parameter isolates, as ``check_real_poses`` confirms."""
    words = limbs(4 * max(map(len, pose.parameter or ("",))))
    charge(2 * value_cost(int(factor.length()), limbs(int(factor.height_bits())), words))
    low, high = (factor(fmpq(end)) for end in pose.parameter or ())
    return bool(low * high < 0 or low == 0 == high)


def _solutions_line(number: int, total: int, proved: _Proved) -> str:
    if proved.total is None:
        return (
            f"complex solutions: {number} distinct; not proved that all are simple, and the number {total} with "
            "multiplicity is not proved"
        )
    if proved.multiple:
        return f"complex solutions: {number} distinct, {total} with multiplicity"
    return f"complex solutions: {number}, each isolated and simple, its leg lines are independent"
