"""The certificate checker: does a file prove what it claims? It shares nothing with the solver.

Everything is recomputed from the robot's joints, the leg lengths and the polynomials of the univariate representation;
counts, verdicts and boxes in the file are compared with what was recomputed, never used. The mathematics of every
check, with proofs, is in ``docs/certificates.md``.
"""

from __future__ import annotations

from collections.abc import Iterator

from pkm_exact.certify.checker.budget import Budget, spending
from pkm_exact.certify.checker.claims import check_claims
from pkm_exact.certify.checker.document import FORMAT, Document, read_document
from pkm_exact.certify.checker.krawczyk import Equations, check_isolated
from pkm_exact.certify.checker.mechanism_boxes import MechanismEquations
from pkm_exact.certify.checker.mechanism_claims import check_mechanism_claims
from pkm_exact.certify.checker.mechanism_document import VERSION as MECHANISM_VERSION
from pkm_exact.certify.checker.mechanism_document import MechanismDocument, read_mechanism_document
from pkm_exact.certify.checker.mechanism_solutions import check_solutions
from pkm_exact.certify.checker.realposes import check_isolated_poses, check_real_poses
from pkm_exact.certify.checker.solutions import check_distinct, check_eliminant, check_poses
from pkm_exact.certify.checker.spelling import read_sealed
from pkm_exact.certify.checker.tolerance_checks import check_tolerances
from pkm_exact.certify.checker.tolerance_document import OPENING, read_tolerances
from pkm_exact.certify.checker.verdict import Refusal, Status, Verdict

__all__ = ["Status", "Verdict", "check_bytes"]


def check_bytes(data: bytes) -> Verdict:
    r"""The verdict on the content of a certificate file.

    Never raises on account of the data, and does a bounded amount of work on it.

    Examples
    --------
    >>> print(check_bytes(b"{}\n"))
    file: not a JSON object with a digest
    malformed
    """
    return check_counted(data)[0]


def check_counted(data: bytes) -> tuple[Verdict, Budget]:
    """The verdict, and the work that was charged for it."""
    lines: list[str] = []
    budget = Budget(len(data))
    try:
        with spending(budget):
            checks = _checks_of(data)
            lines.append("digest: that of the content")
            for line in checks:
                lines.append(line)  # noqa: PERF402 - the lines before a refusal stay
    except Refusal as refusal:
        return Verdict(refusal.status, (*lines, refusal.line)), budget
    return Verdict(Status.ACCEPTED, tuple(lines)), budget


def _checks_of(data: bytes) -> Iterator[str]:
    """The content, read at once, and its checks, one after another."""
    if data.startswith(OPENING):
        return check_tolerances(read_tolerances(data))
    body = read_sealed(data)
    if body.get("format") == FORMAT and body.get("version") == MECHANISM_VERSION and type(body["version"]) is int:
        return _mechanism_checks(read_mechanism_document(body))
    return _checks(read_document(body))


def _checks(document: Document) -> Iterator[str]:
    """One line per claim; the costly ones, on completeness, last."""
    if document.representation is not None:
        yield from check_eliminant(document.representation)
        yield from check_distinct(document.representation)
        yield from check_poses(document.representation, document.legs, document.metric)
        if document.claim != "positive-dimensional-proved":
            yield from check_real_poses(document.representation, document.metric, document.box_exponent, document.poses)
    if document.isolated is not None:
        equations = Equations(document.legs, document.metric, document.isolated.chart)
        yield from check_isolated(document.isolated, equations)
        yield from check_isolated_poses(document.isolated, equations, document.box_exponent, document.poses)
    yield from check_claims(document)


def _mechanism_checks(document: MechanismDocument) -> Iterator[str]:
    """The same for version 2; witnesses of a self-motion are checked with the claim."""
    mechanism, exponent = document.mechanism, document.box_exponent
    if document.representation is not None and document.claim != "positive-dimensional-proved":
        yield from check_solutions(document.representation, mechanism)
        yield from check_real_poses(document.representation, mechanism.metric, exponent, document.poses)
    if document.isolated is not None:
        equations = MechanismEquations(mechanism, document.isolated.chart)
        yield from check_isolated(document.isolated, equations)
        yield from check_isolated_poses(document.isolated, equations, exponent, document.poses)
    yield from check_mechanism_claims(document)
