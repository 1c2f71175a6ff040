"""Loops closed by products of dual quaternions: "Closure" of ``docs/certificates-mobility.md``."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from flint import fmpq, fmpq_poly

from pkm_exact.certify.checker.budget import charge, limbs, polynomials_cost
from pkm_exact.certify.checker.mobility_document import SecondOrder
from pkm_exact.certify.checker.mobility_machine import Machine, Rows, exact
from pkm_exact.certify.checker.verdict import malformed, rejected

Half = tuple[fmpq_poly, fmpq_poly]
"""Numerator and denominator of a half tangent."""


def check_order(claim: SecondOrder, machine: Machine, dependencies: Rows, motions: Rows) -> None:
    """The only curve there can be leaves the configurations at some order."""
    if len(motions) != 1:
        raise rejected("finite.above: the mobility is not 1")
    if any(len(term) != len(machine.twists) for term in claim.series):
        raise malformed("finite.above.series: not a number for each freedom")
    terms = [[exact(x) for x in term] for term in claim.series]
    halves = [(fmpq_poly([0, *(term[k] for term in terms)]), fmpq_poly([1])) for k in range(len(machine.twists))]
    parts = _closures(machine, halves, claim.degree)
    if any(part[k] != 0 for part in parts for k in range(claim.degree)):
        raise rejected("finite.above.series: does not close the loops to its order")
    last = [part[claim.degree] for part in parts]
    if not dependencies or sum((a * b for a, b in zip(dependencies[0], last, strict=True)), fmpq(0)) == 0:
        raise rejected("finite.above: the order may have a solution")


def check_curve(claim: SecondOrder, machine: Machine) -> int:
    """Half tangents close the loops along a curve; the mobility of the platform along it, as far as its speed tells."""
    if len(claim.curve) != len(machine.twists):
        raise malformed("finite.below.curve: not a pair for each freedom")
    halves = [(_polynomial(numerator), _polynomial(denominator)) for numerator, denominator in claim.curve]
    if any(numerator[0] != 0 or denominator[0] == 0 for numerator, denominator in halves):
        raise rejected("finite.below.curve: does not begin at the configuration")
    if not any(numerator for numerator, _ in halves):
        raise rejected("finite.below.curve: does not move")
    if any(_closures(machine, halves, None)):
        raise rejected("finite.below.curve: does not close the loops")
    speeds = [numerator[1] / denominator[0] for numerator, denominator in halves]
    return int(any(sum((a * b for a, b in zip(row, speeds, strict=True)), fmpq(0)) != 0 for row in machine.platform))


def _polynomial(coefficients: Sequence[Fraction]) -> fmpq_poly:
    return fmpq_poly([exact(x) for x in coefficients])


def _closures(machine: Machine, halves: Sequence[Half], order: int | None) -> list[fmpq_poly]:
    """The six vector parts of each loop, up to an order if one is given."""
    modulus = None if order is None else fmpq_poly([0] * (order + 1) + [1])
    found = []
    for loop in machine.loops:
        product = [fmpq_poly([1]), *(fmpq_poly([0]) for _ in range(7))]
        for column, sign in machine.passed(loop):
            twist = machine.twists[column]
            if sum((a * b for a, b in zip(twist[:3], twist[3:], strict=True)), fmpq(0)) != 0:
                raise rejected("finite: a screw of a loop has a pitch")
            numerator, denominator = halves[column]
            _charge(product, numerator, denominator)
            turned = _times_twist(product, [sign * x for x in twist])
            product = [a * denominator + b * numerator for a, b in zip(product, turned, strict=True)]
            if modulus is not None:
                product = [part % modulus for part in product]
        found += [product[k] for k in (1, 2, 3, 5, 6, 7)]
    return found


def _charge(product: Sequence[fmpq_poly], numerator: fmpq_poly, denominator: fmpq_poly) -> None:
    terms = max(len(part.coeffs()) for part in (*product, numerator, denominator)) + 1
    bits = [
        max(
            (max(abs(int(x.p)).bit_length(), int(x.q).bit_length()) for part in parts for x in part.coeffs()), default=1
        )
        for parts in (product, (numerator, denominator))
    ]
    charge(100_000 + 40 * polynomials_cost(terms, 1 + limbs(sum(bits))))


def _times_twist(p: Sequence[fmpq_poly], twist: Sequence[fmpq]) -> list[fmpq_poly]:
    """(p + e q)(w + e v) = p w + e (p v + q w)."""
    w, v = twist[:3], twist[3:]
    dual = [a + b for a, b in zip(_times_vector(p[:4], v), _times_vector(p[4:], w), strict=True)]
    return [*_times_vector(p[:4], w), *dual]


def _times_vector(p: Sequence[fmpq_poly], u: Sequence[fmpq]) -> list[fmpq_poly]:
    scalar, x, y, z = p
    return [
        -(x * u[0] + y * u[1] + z * u[2]),
        scalar * u[0] + y * u[2] - z * u[1],
        scalar * u[1] + z * u[0] - x * u[2],
        scalar * u[2] + x * u[1] - y * u[0],
    ]
