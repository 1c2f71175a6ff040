"""Certificates of polynomial systems: what was found, written down so that a program that shares nothing can replay it.

The format is described in ``docs/certificates-systems.md``; its schema is ``system-certificate-1.schema.json`` in
this folder.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from pkm_exact.certify.certificate_entries import coefficients, products_entry
from pkm_exact.certify.sealing import canonical_bytes, sealed
from pkm_exact.claim import Claim
from pkm_exact.poses.pose_spelling import ends
from pkm_exact.systems.polynomial_terms import spelled_terms

if TYPE_CHECKING:
    from pkm_exact.algebra.representation import UnivariateRepresentation
    from pkm_exact.systems.mixed_volume import Subdivision
    from pkm_exact.systems.system_solution import InfinitePoints, RealSolution, SystemSolution, Witness

FORMAT: Final = "pkm_exact system certificate"
VERSION: Final = 1


def system_certificate(solution: SystemSolution, title: str = "") -> dict[str, Any]:
    """The certificate of the solutions of a system, as a JSON object with its digest.

    Examples
    --------
    >>> from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring
    >>> from pkm_exact.systems.system_engine import solved_system
    >>> (x,) = polynomial_ring(("x",)).gens()
    >>> found = system_certificate(solved_system(PolynomialSystem(("x",), (x**2 - 4,))))
    >>> found["polynomials"], found["claim"], found["real_solutions"]
    ([['x^2', '-4']], 'complete', 2)
    """
    return sealed(_content(solution, title))


def system_certificate_bytes(solution: SystemSolution, title: str = "") -> bytes:
    """What a certificate file holds."""
    return canonical_bytes(system_certificate(solution, title))


def _content(solution: SystemSolution, title: str) -> dict[str, Any]:
    proof, witness = solution.proof, solution.witness
    found = witness.representation if witness is not None else solution.representation
    has_steps = proof is not None and proof.route == "exact-elimination"
    return {
        "format": FORMAT,
        "version": VERSION,
        "title": title,
        "variables": list(solution.variables),
        "polynomials": [spelled_terms(polynomial, solution.variables) for polynomial in solution.system.polynomials],
        "claim": str(solution.claim),
        "completeness_route": None if proof is None else str(proof.route),
        "complex_solutions": 0 if solution.claim is Claim.INCONSISTENT else solution.complex_solutions,
        "distinct_solutions": solution.distinct_solutions,
        "real_solutions": len(solution.solutions),
        "representation": None if found is None else _representation(found),
        "groups": [list(group) for group in proof.groups] if proof is not None and proof.groups else None,
        "infinity": None if proof is None or proof.infinity is None else _infinity(proof.infinity),
        "elimination": products_entry(proof.elimination) if proof is not None and has_steps else None,
        **({} if proof is None or proof.subdivision is None else {"subdivision": _subdivision(proof.subdivision)}),
        "witness": None if witness is None else _witness(witness),
        "box_exponent": solution.box_exponent if solution.solutions else 0,
        "solutions": [_solution(entry) for entry in solution.solutions],
        "notes": list(solution.notes),
    }


def _representation(found: UnivariateRepresentation) -> dict[str, Any]:
    return {
        "separating_form": list(found.form),
        "eliminant": coefficients(found.eliminant),
        "numerators": [coefficients(numerator) for numerator in found.numerators],
    }


def _infinity(points: InfinitePoints) -> dict[str, Any]:
    return {
        "chart": list(points.chart),
        "separating_form": list(points.univariate.form),
        "eliminant": coefficients(points.univariate.eliminant),
        "coordinates": [coefficients(numerator) for numerator in points.univariate.numerators],
        "multiplicity": points.multiplicity,
    }


def _subdivision(found: Subdivision) -> dict[str, Any]:
    flat = [[number for (i, k), value in each for number in (i, k, value)] for each in found.obstructions]
    return {
        "lifting": [" ".join(map(str, numbers)) for numbers in found.lifting],
        "obstructions": [" ".join(map(str, numbers)) for numbers in flat],
    }


def _witness(witness: Witness) -> dict[str, Any]:
    return {
        "cause": witness.cause,
        "forms": [list(form) for form in witness.forms],
        "slices": [
            {"constant": str(part.constant), "representation": _representation(part.representation)}
            for part in witness.slices
        ],
    }


def _solution(entry: RealSolution) -> dict[str, Any]:
    return {
        "parameter": ends(entry.parameter),
        "values": [ends(value) for value in entry.values],
        "multiplicity": entry.multiplicity,
    }
