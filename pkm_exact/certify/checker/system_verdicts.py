"""What is claimed of a system must be exactly what its certificate proves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from itertools import pairwise
from typing import Final, NamedTuple

from flint import fmpz_poly, nmod_poly

from pkm_exact.certify.checker.budget import TooMuchError, attempting, charge
from pkm_exact.certify.checker.claims import check_listed_multiplicities
from pkm_exact.certify.checker.elimination import Elimination, follow
from pkm_exact.certify.checker.multiplicity import multiplicities_by
from pkm_exact.certify.checker.solutions import modulo, primitive_part
from pkm_exact.certify.checker.system_document import Points, SystemDocument, Witness
from pkm_exact.certify.checker.system_multiplicities import multiple_solutions
from pkm_exact.certify.checker.system_points import check_at_infinity, check_points
from pkm_exact.certify.checker.system_reals import check_real_solutions
from pkm_exact.certify.checker.system_room import (
    MOST_IN_SPACE,
    MOST_SOLUTIONS,
    bezout_number,
    multihomogeneous_number,
    room,
)
from pkm_exact.certify.checker.system_supports import require_bound
from pkm_exact.certify.checker.system_terms import Terms, homogeneous, linear, top_form
from pkm_exact.certify.checker.system_weights import Weighed, weighed_at_infinity, weighed_solutions
from pkm_exact.certify.checker.traceform import quotient_algebra
from pkm_exact.certify.checker.verdict import rejected

_PART_FOR_MULTIPLICITIES: Final = 4
"""The part of the work, one of so many, after which an algebra is tried instead."""


class _Proved(NamedTuple):
    """Of a list: the claim, the number with multiplicity, the factors of h at multiple solutions, the last line."""

    claim: str
    total: int | None
    multiple: tuple[tuple[fmpz_poly, int], ...]
    line: str


def check_system(document: SystemDocument) -> Iterator[str]:
    """One line per claim; the costly ones, on completeness, last."""
    _check_parts(document)
    if document.points is not None:
        yield from check_points(document.points, document.polynomials)
        if document.witness is None:
            yield from check_real_solutions(document.points, document.box_exponent, document.solutions)
    if document.real_solutions != len(document.solutions):
        raise rejected(f"real solutions: {document.real_solutions} claimed, {len(document.solutions)} listed")
    if document.box_exponent and not document.solutions:
        raise rejected("boxes: a grid is given, but there is no real solution")
    if document.witness is not None:
        yield from _infinitely_many(document, document.witness)
    elif document.points is None:
        yield from _nothing_listed(document)
    else:
        yield from _solutions_listed(document, document.points)


def _check_parts(document: SystemDocument) -> None:
    """What a certificate must have, and may not, depends on its claim and route."""
    parts = (
        ("groups", document.groups, document.route == "multihomogeneous-bezout"),
        ("infinity", document.infinity, document.route == "counting-at-infinity"),
        ("subdivision", document.subdivision, document.route == "mixed-volume"),
        ("elimination", document.elimination, document.route == "exact-elimination"),
        ("witness", document.witness, document.claim == "positive-dimensional-proved"),
    )
    for name, value, wanted in parts:
        if (value is not None) != wanted:
            raise rejected(f"{name}: {'missing' if wanted else 'given'}, but the claim is {_claimed(document)}")
    if (document.route is None) == (document.claim in ("complete", "inconsistent")):
        raise rejected(f"claim: {_claimed(document)}")


def _claimed(document: SystemDocument) -> str:
    return f"{document.claim} by {document.route or 'no route'}"


def _nothing_listed(document: SystemDocument) -> Iterator[str]:
    """Nothing listed: it can be proved that there is nothing, otherwise nothing is proved and none claimed."""
    if document.solutions or document.distinct_solutions:
        raise rejected("representation: missing, but solutions are claimed")
    if document.complex_solutions != (0 if document.claim == "inconsistent" else None):
        raise rejected("complex solutions: not what is proved")
    if document.claim == "not-proven-complete":
        yield "not proven complete: no solution is listed, and none is excluded"
    elif document.claim == "positive-dimensional-detected":
        yield "positive dimension detected: evidence found by the solver, no proof"
    elif document.claim == "inconsistent" and _has_no_solution(document):
        yield "inconsistent: 1 = 0 follows from the polynomials, there is no solution, real or complex"
    else:
        raise rejected(f"claim: {_claimed(document)} is not proved by what is in the certificate")


def _has_no_solution(document: SystemDocument) -> bool:
    if document.elimination is not None:
        return any(not any(next(iter(element))) for element in _eliminated(document).elements)
    if document.route != "modular-rank":
        return False
    forms = [homogeneous(polynomial) for polynomial in document.polynomials]
    return room(document.size + 1, forms, MOST_IN_SPACE) is not None


def _solutions_listed(document: SystemDocument, points: Points) -> Iterator[str]:
    number = int(points.eliminant.degree())
    if document.distinct_solutions != number:
        raise rejected(f"distinct solutions: {document.distinct_solutions} claimed, {number} proved")
    weighed = weighed_solutions(points, document.polynomials)
    proved = _proved(document, points, weighed)
    if document.claim != proved.claim:
        raise rejected(f"claim: {_claimed(document)}, but what is proved is {proved.claim}")
    if document.complex_solutions != proved.total:
        raise rejected(f"complex solutions: {document.complex_solutions} claimed, {proved.total} proved")
    known = proved.total is not None or weighed.are_regular
    check_listed_multiplicities(document.solutions, known, proved.multiple)
    if weighed.are_regular:
        yield f"complex solutions: {number}, each isolated and simple"
    elif proved.total is None:
        yield f"complex solutions: {number} distinct; not proved that all are simple"
    else:
        yield f"complex solutions: {number} distinct, {proved.total} with multiplicity"
    yield proved.line


def _proved(document: SystemDocument, points: Points, weighed: Weighed) -> _Proved:
    """What the certificate proves of the solutions listed."""
    number = int(points.eliminant.degree())
    bound = bezout_number(document.polynomials, document.size)
    if weighed.are_regular and number == bound:
        if document.route != "refined-bezout":
            raise rejected(f"claim: {_claimed(document)}, but what is proved is complete by refined-bezout")
        line = f"complete: {number} isolated solutions are the product of the degrees, there is no other"
        return _Proved("complete", number, (), line)
    if document.groups is not None or document.subdivision is not None:
        return _by_terms(document, number, weighed)
    if document.infinity is not None:
        return _counted_at_infinity(document, points, weighed, bound)
    if document.elimination is not None:
        return _by_elimination(document, points, weighed)
    if document.route == "modular-rank":
        return _by_rank(document, points, weighed)
    if document.route is not None:
        raise rejected(f"claim: {_claimed(document)} is not proved by what is in the certificate")
    line = f"not proven complete: {number} solutions are proved, others are not excluded"
    return _Proved("not-proven-complete", None, (), line)


def _by_terms(document: SystemDocument, number: int, weighed: Weighed) -> _Proved:
    """The list is complete if it has as many regular solutions as the terms that occur admit."""
    if document.groups is not None:
        groups_bound = multihomogeneous_number(document.polynomials, document.groups)
        if not weighed.are_regular or number != groups_bound:
            raise rejected(f"groups: {number} solutions, the multihomogeneous Bezout number is {groups_bound}")
        line = f"complete: {number} isolated solutions are the multihomogeneous Bezout number, there is no other"
        return _Proved("complete", number, (), line)
    if document.subdivision is None or not weighed.are_regular:
        raise rejected("subdivision: not all solutions are proved isolated and simple")
    require_bound(document.polynomials, document.size, document.subdivision, number)
    line = f"complete: {number} isolated solutions are the mixed volume of the terms, there is no other"
    return _Proved("complete", number, (), line)


def _by_rank(document: SystemDocument, points: Points, weighed: Weighed) -> _Proved:
    """The list is complete if it fills what the polynomials leave, nothing being at infinity."""
    left = room(document.size, [top_form(polynomial) for polynomial in document.polynomials], MOST_SOLUTIONS)
    if left is None:
        raise rejected(f"modular rank: it leaves no known number, and {weighed.total} solutions are proved")
    filled = _filling(document, points, weighed, left)
    if filled.total != left:
        raise rejected(f"modular rank: it leaves {left}, and {filled.total} solutions are proved")
    return _Proved("complete", left, filled.factors, _left_line(left))


def _filling(document: SystemDocument, points: Points, weighed: Weighed, number: int) -> Weighed:
    """The solutions with their weights if these sum to the number that there can be; otherwise with multiplicities.

    All must be known to be isolated.
    """
    if weighed.total == number or weighed.are_regular:
        return weighed
    return multiple_solutions(points, document.polynomials, weighed)


def _left_line(number: int) -> str:
    return f"complete: polynomials that vanish at all solutions leave room for {number}, there is no other"


def _counted_at_infinity(document: SystemDocument, points: Points, weighed: Weighed, bound: int | None) -> _Proved:
    infinity = document.infinity
    if infinity is None or bound is None:
        raise rejected("infinity: there are fewer polynomials than variables")
    for _ in check_at_infinity(infinity, document.polynomials):
        pass
    there = weighed_at_infinity(infinity, document.polynomials).total
    if infinity.multiplicity != there:
        raise rejected(f"infinity: {infinity.multiplicity} claimed, the points count {there}")
    size = document.size + 1
    forms = [homogeneous(polynomial) for polynomial in document.polynomials]
    plane = {tuple(int(i == j) for j in range(size)): pow(3, 1000 + i, 65537) for i in range(size)}
    if room(size, [*forms, plane], MOST_IN_SPACE) is None:
        raise rejected("infinity: not proved that the points common to all polynomials are finitely many")
    filled = _filling(document, points, weighed, bound - there)
    if filled.total + there != bound:
        raise rejected(f"infinity: {filled.total} and {there} at infinity, but the product of the degrees is {bound}")
    line = (
        f"complete: {filled.total} solutions and {there} at infinity, with multiplicity, are the product of the "
        "degrees, there is no other"
    )
    return _Proved("complete", filled.total, filled.factors, line)


def _eliminated(document: SystemDocument) -> Elimination:
    """The elements that the steps of the certificate yield."""
    return follow(Elimination.begun(document.size, document.polynomials), document.elimination or ())


def _by_elimination(document: SystemDocument, points: Points, weighed: Weighed) -> _Proved:
    """The list is complete if it fills what the elements leave, or has as many solutions as their algebra."""
    elimination = _eliminated(document)
    tops = [top_form(element) for element in elimination.elements]
    left = room(document.size, tops, MOST_SOLUTIONS)
    if left is not None:
        with suppress(TooMuchError), attempting(_PART_FOR_MULTIPLICITIES):
            filled = _filling(document, points, weighed, left)
            if filled.total == left:
                return _Proved("complete", left, filled.factors, _left_line(left))
    algebra = quotient_algebra(elimination, elimination.standard(MOST_SOLUTIONS))
    if algebra is None or algebra.distinct_solutions() != points.eliminant.degree():
        raise rejected("elimination: the solutions are not proved to fill what it leaves")
    h0 = primitive_part(points.eliminant)

    def value(modulus: nmod_poly, weights: Sequence[int], p: int) -> nmod_poly | None:
        divisor, inverse, _ = modulo(points.eliminant.derivative(), p).xgcd(modulus)
        if divisor.degree() > 0:
            return None
        total = nmod_poly([0], p)
        for weight, numerator in zip(weights, points.numerators, strict=True):
            total += weight * modulo(numerator, p)
        return total * inverse % modulus

    found = multiplicities_by(algebra, h0, document.size, value)
    if found is None:
        raise rejected("elimination: no form in the variables tells the multiple solutions apart")
    total = len(algebra.basis)
    multiple = tuple((factor, multiplicity) for factor, multiplicity in found if multiplicity > 1)
    return _Proved("complete", total, multiple, _left_line(total))


def _infinitely_many(document: SystemDocument, witness: Witness) -> Iterator[str]:
    """A solution where polynomials are fewer than variables, or more solutions than isolated ones there can be."""
    if document.solutions or document.distinct_solutions or document.complex_solutions is not None:
        raise rejected("witness: solutions are listed, but they are infinitely many")
    polynomials = document.polynomials
    if witness.cause == "fewer-polynomials":
        if witness.forms or witness.slices or document.points is None:
            raise rejected("witness: fewer polynomials need a representation, and neither forms nor slices")
        charge(10**6)
        if len(Elimination.begun(document.size, polynomials).packed) >= document.size:
            raise rejected("witness: the polynomials are not fewer than the variables")
    else:
        yield from _more_than_bound(document, witness)
    yield "positive dimension: complex solutions are infinitely many; that real ones are is not proved"


def _more_than_bound(document: SystemDocument, witness: Witness) -> Iterator[str]:
    if document.points is not None or not witness.forms or not all(any(form[:-1]) for form in witness.forms):
        raise rejected("witness: more solutions than the bound need forms that are not constant, and no representation")
    *fixed, last = witness.forms
    system = [*document.polynomials, *map(linear, fixed)]
    bound = bezout_number(system, document.size)
    constants = [constant for constant, _ in witness.slices]
    if bound is None or any(a >= b for a, b in pairwise(constants)):
        raise rejected("witness: too few polynomials, or constants that do not increase")
    total = 0
    for number, (constant, points) in enumerate(witness.slices, 1):
        yield from check_points(
            points, [*system, _minus(last, constant.numerator, constant.denominator)], f"slice {number}: "
        )
        total += int(points.eliminant.degree())
    if total <= bound:
        raise rejected(f"witness: {total} solutions, and {bound} can be isolated")
    yield f"witness: {total} solutions, of which {bound} at most are isolated"


def _minus(form: Sequence[int], numerator: int, denominator: int) -> Terms:
    """A multiple of the form with a rational number subtracted."""
    *coefficients, constant = form
    return linear([*(value * denominator for value in coefficients), constant * denominator - numerator])
