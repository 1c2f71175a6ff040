"""The certificate checker: does a file prove what it claims? It shares nothing with the solver.

Everything is recomputed from the robot's joints, the leg lengths and the polynomials of the univariate representation;
counts, verdicts and boxes in the file are compared with what was recomputed, never used. The mathematics of every
check, with proofs, is in ``docs/certificates.md``.
"""

from __future__ import annotations

from pkm_exact.certify.checker.budget import Budget, spending
from pkm_exact.certify.checker.certificate_kinds import checks_of
from pkm_exact.certify.checker.spelling import read_sealed
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
            checks = checks_of(read_sealed(data))
            lines.append("digest: that of the content")
            for line in checks:
                lines.append(line)  # noqa: PERF402 - the lines before a refusal stay
    except Refusal as refusal:
        return Verdict(refusal.status, (*lines, refusal.line)), budget
    return Verdict(Status.ACCEPTED, tuple(lines)), budget
