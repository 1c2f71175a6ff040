"""The kinds of certificates that the checker knows. One row adds a kind, or a version of one.

Modules are loaded for the kind at hand only: that takes longer than checking a small certificate.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Final

from pkm_exact.certify.checker.verdict import malformed

POSES: Final = "pkm_exact certificate"
TOLERANCES: Final = "pkm_exact tolerance certificate"
SYSTEMS: Final = "pkm_exact system certificate"
MOBILITY: Final = "pkm_exact mobility certificate"
REGIONS: Final = "pkm_exact region certificate"
PLATFORM: Final = "pkm_exact platform certificate"
LINKS: Final = "pkm_exact links certificate"
STATICS: Final = "pkm_exact statics certificate"


@dataclass(frozen=True)
class CertificateKind:
    """A kind of certificate, in one version.

    Attributes
    ----------
    format : str
        What stands under the key of that name.
    version : int
    checks : callable
        Reads the content at once, or refuses it; then the lines of its checks, one after another.
    """

    format: str
    version: int
    checks: Callable[[dict[str, Any]], Iterator[str]]


def checks_of(body: dict[str, Any]) -> Iterator[str]:
    """The checks of a certificate whose digest has been looked at; a refusal if it is of no known kind."""
    named = [kind for kind in KINDS if kind.format == body.get("format")]
    for kind in named:
        if type(body.get("version")) is int and body["version"] == kind.version:
            return kind.checks(body)
    known = named or [kind for kind in KINDS if kind.format == POSES]
    versions = " or ".join(str(kind.version) for kind in known)
    raise malformed(f"format: not a {known[0].format}, version {versions}")


def _poses(body: dict[str, Any]) -> Iterator[str]:
    """One line per claim; the costly ones, on completeness, last."""
    from pkm_exact.certify.checker.claims import check_claims
    from pkm_exact.certify.checker.document import read_document
    from pkm_exact.certify.checker.realposes import check_isolated_poses, check_real_poses
    from pkm_exact.certify.checker.solutions import check_distinct, check_eliminant, check_poses

    document = read_document(body)

    def lines() -> Iterator[str]:
        if document.representation is not None:
            yield from check_eliminant(document.representation)
            yield from check_distinct(document.representation)
            yield from check_poses(document.representation, document.legs, document.metric)
            if document.claim != "positive-dimensional-proved":
                exponent = document.box_exponent
                yield from check_real_poses(document.representation, document.metric, exponent, document.poses)
        if document.isolated is not None:
            from pkm_exact.certify.checker.krawczyk import Equations, check_isolated

            equations = Equations(document.legs, document.metric, document.isolated.chart)
            yield from check_isolated(document.isolated, equations)
            yield from check_isolated_poses(document.isolated, equations, document.box_exponent, document.poses)
        yield from check_claims(document)

    return lines()


def _mechanism(body: dict[str, Any]) -> Iterator[str]:
    """The same for version 2; witnesses of a self-motion are checked with the claim."""
    from pkm_exact.certify.checker.mechanism_claims import check_mechanism_claims
    from pkm_exact.certify.checker.mechanism_document import read_mechanism_document
    from pkm_exact.certify.checker.mechanism_solutions import check_solutions
    from pkm_exact.certify.checker.realposes import check_isolated_poses, check_real_poses

    document = read_mechanism_document(body)
    mechanism, exponent = document.mechanism, document.box_exponent

    def lines() -> Iterator[str]:
        if document.representation is not None and document.claim != "positive-dimensional-proved":
            yield from check_solutions(document.representation, mechanism)
            yield from check_real_poses(document.representation, mechanism.metric, exponent, document.poses)
        if document.isolated is not None:
            from pkm_exact.certify.checker.krawczyk import check_isolated
            from pkm_exact.certify.checker.mechanism_boxes import MechanismEquations

            equations = MechanismEquations(mechanism, document.isolated.chart)
            yield from check_isolated(document.isolated, equations)
            yield from check_isolated_poses(document.isolated, equations, exponent, document.poses)
        yield from check_mechanism_claims(document)

    return lines()


def _tolerances(body: dict[str, Any]) -> Iterator[str]:
    from pkm_exact.certify.checker.tolerance_checks import check_tolerances
    from pkm_exact.certify.checker.tolerance_document import read_tolerances

    return check_tolerances(read_tolerances(body))


def _system(body: dict[str, Any]) -> Iterator[str]:
    from pkm_exact.certify.checker.system_document import read_system_document
    from pkm_exact.certify.checker.system_verdicts import check_system

    return check_system(read_system_document(body))


def _mobility(body: dict[str, Any]) -> Iterator[str]:
    from pkm_exact.certify.checker.mobility_checks import check_mobility
    from pkm_exact.certify.checker.mobility_document import read_mobility

    return check_mobility(read_mobility(body))


def _platform(body: dict[str, Any]) -> Iterator[str]:
    from pkm_exact.certify.checker.platform_checks import check_platform
    from pkm_exact.certify.checker.platform_document import read_platform

    return check_platform(read_platform(body))


def _region(body: dict[str, Any]) -> Iterator[str]:
    from pkm_exact.certify.checker.region_document import read_region
    from pkm_exact.certify.checker.region_paving_check import check_region

    return check_region(read_region(body))


def _region_2(body: dict[str, Any]) -> Iterator[str]:
    from pkm_exact.certify.checker.region_document_2 import read_region_2
    from pkm_exact.certify.checker.region_paving_check import check_region

    return check_region(read_region_2(body))


def _links(body: dict[str, Any]) -> Iterator[str]:
    from pkm_exact.certify.checker.links_checks import check_links
    from pkm_exact.certify.checker.links_document import read_links

    return check_links(read_links(body))


def _statics(body: dict[str, Any]) -> Iterator[str]:
    from pkm_exact.certify.checker.statics_checks import check_statics
    from pkm_exact.certify.checker.statics_document import read_statics

    return check_statics(read_statics(body))


def _driven_statics(body: dict[str, Any]) -> Iterator[str]:
    from pkm_exact.certify.checker.statics_checks import check_statics
    from pkm_exact.certify.checker.statics_document import read_statics

    return check_statics(read_statics(body, is_driven=True))


def _equation_statics(body: dict[str, Any]) -> Iterator[str]:
    from pkm_exact.certify.checker.statics_equations_checks import check_equation_statics
    from pkm_exact.certify.checker.statics_equations_document import read_equation_statics

    return check_equation_statics(read_equation_statics(body))


def _box_statics(body: dict[str, Any]) -> Iterator[str]:
    from pkm_exact.certify.checker.statics_box_checks import check_box_statics
    from pkm_exact.certify.checker.statics_box_document import read_box_statics

    return check_box_statics(read_box_statics(body))


KINDS: Final = (
    CertificateKind(POSES, 1, _poses),
    CertificateKind(POSES, 2, _mechanism),
    CertificateKind(TOLERANCES, 1, _tolerances),
    CertificateKind(SYSTEMS, 1, _system),
    *(CertificateKind(MOBILITY, version, _mobility) for version in (1, 2, 3)),
    CertificateKind(PLATFORM, 1, _platform),
    CertificateKind(REGIONS, 1, _region),
    CertificateKind(REGIONS, 2, _region_2),
    CertificateKind(LINKS, 1, _links),
    CertificateKind(LINKS, 2, _links),
    CertificateKind(STATICS, 1, _statics),
    CertificateKind(STATICS, 2, _box_statics),
    CertificateKind(STATICS, 3, _driven_statics),
    CertificateKind(STATICS, 4, _equation_statics),
)
