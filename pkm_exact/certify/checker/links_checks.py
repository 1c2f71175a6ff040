"""What a certificate of a mechanism with passive bodies claims must be proved by its system, or by its box."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from flint import arb, arb_mat, ctx

from pkm_exact.certify.checker.budget import ball_cost, charge, limbs
from pkm_exact.certify.checker.links_document import Box, LinksDocument, Unknowns
from pkm_exact.certify.checker.links_polynomials import polynomials_of
from pkm_exact.certify.checker.system_document import SystemDocument
from pkm_exact.certify.checker.system_terms import Terms, derivative
from pkm_exact.certify.checker.system_verdicts import check_system
from pkm_exact.certify.checker.verdict import MAX_PRECISION, rejected

_GUARD = 64


def check_links(document: LinksDocument) -> Iterator[str]:
    """One line per claim."""
    if document.system is not None:
        yield from _check_system(document, document.system)
    if document.box is not None:
        yield from _check_box(document, document.box)


def _check_system(document: LinksDocument, system: SystemDocument) -> Iterator[str]:
    if document.variables != tuple(document.names):
        raise rejected("system: its variables are not the unknowns of the bodies")
    if list(system.polynomials) != polynomials_of(document, spare=True):
        raise rejected("system: its polynomials are not those of the mechanism")
    number = len(system.polynomials)
    yield f"mechanism: the system has its {number} polynomials in the {len(document.names)} unknowns of its bodies"
    yield from check_system(system)


def _check_box(document: LinksDocument, box: Box) -> Iterator[str]:
    polynomials = polynomials_of(document, spare=False)
    size = len(document.names)
    if len(polynomials) != size:
        raise rejected(f"box: {len(polynomials)} polynomials in {size} unknowns, not as many")
    slopes = [derivative(polynomial, place) for polynomial in polynomials for place in range(size)]
    if not any(_holds_one(polynomials, slopes, box, bits) for bits in _precisions(box)):
        raise rejected("box: that it holds exactly one pose is not proved")
    for number, body in enumerate(document.bodies, 1):
        if body.rotation and not _is_proper(body, document.names, box):
            raise rejected(f"box: that body {number} is turned and not mirrored is not proved")
    yield f"box: it holds exactly one pose of all bodies, {size} unknowns, and it is regular"
    yield "not proven complete: one pose is proved, others are not excluded"


def _precisions(box: Box) -> Iterator[int]:
    bits = 2 * box.exponent + _GUARD
    while bits <= MAX_PRECISION + 4 * box.exponent:
        yield bits
        bits *= 2


def _holds_one(polynomials: Sequence[Terms], slopes: Sequence[Terms], box: Box, bits: int) -> bool:
    """Whether Krawczyk's image of the box, moved to 0, lies in its interior."""
    size, terms = len(box.centre), sum(map(len, slopes))
    charge(ball_cost(limbs(bits)) * (4 * size**3 + 16 * terms))
    before, ctx.prec = ctx.prec, bits
    try:
        unit = arb(2) ** -box.exponent
        radius = box.radius * unit
        m = [value * unit for value in box.centre]
        x = [value + arb(0, radius) for value in m]
        at_m = arb_mat(size, size, [_value(terms, m) for terms in slopes])
        one = arb_mat(size, size, [int(i == j) for i in range(size) for j in range(size)])
        y = at_m.solve(one, algorithm="approx")
        moved = y * arb_mat(size, 1, [_value(terms, m) for terms in polynomials])
        rest = one - y * arb_mat(size, size, [_value(terms, x) for terms in slopes])
        image = rest * arb_mat(size, 1, [arb(0, radius)] * size) - moved
        return all(abs(value) < radius for value in image.entries())
    except ZeroDivisionError:
        return False
    finally:
        ctx.prec = before


def _value(polynomial: Terms, x: Sequence[arb]) -> arb:
    total = arb(0)
    for monomial, coefficient in polynomial.items():
        product = arb(coefficient)
        for value, exponent in zip(x, monomial, strict=True):
            for _ in range(exponent):
                product *= value
        total += product
    return total


def _is_proper(body: Unknowns, names: Sequence[str], box: Box) -> bool:
    """Whether the determinant of R is positive all over the box."""
    before, ctx.prec = ctx.prec, 2 * box.exponent + _GUARD
    try:
        unit = arb(2) ** -box.exponent
        places = [names.index(name) for row in body.rotation for name in row]
        entries = [box.centre[place] * unit + arb(0, box.radius * unit) for place in places]
        return bool(arb_mat(3, 3, entries).det() > 0)
    finally:
        ctx.prec = before
