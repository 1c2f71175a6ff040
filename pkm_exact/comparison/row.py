"""What is reported of one formulation on one robot."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from enum import StrEnum
from typing import Any

from pkm_exact.claim import Claim


class Status(StrEnum):
    """How the work on a formulation ended.

    ``NOT_APPLICABLE``: the formulation cannot express the robot. ``NO_ANSWER``: a limit of the engine was met, or the
    process that did the work came to an end.
    """

    DONE = "done"
    TIMEOUT = "timeout"
    NOT_APPLICABLE = "not-applicable"
    NO_ANSWER = "no-answer"


@dataclass(frozen=True)
class SystemFigures:
    """Size of a polynomial system.

    Attributes
    ----------
    unknowns, equations : int
    degrees : tuple of int
        Total degree of every equation, in their order.
    terms : int
        Terms of all equations.
    bytes : int
        Length of the equations as printed text, such as ``x^2-3*x*y``, with a separator after each.
    coefficient_digits : int
        Decimal digits of the largest coefficient; the equations are primitive polynomials over Z.
    """

    unknowns: int
    equations: int
    degrees: tuple[int, ...]
    terms: int
    bytes: int
    coefficient_digits: int


@dataclass(frozen=True)
class ResultFigures:
    """What solving a formulation gave, and what it cost.

    Attributes
    ----------
    basis_elements : int
        Elements of the Groebner basis, known modulo a prime only.
    rur_bytes, rur_bits : int or None
        Length of all coefficients of the rational univariate representation of the poses as decimal text, and bits of
        the largest. The representation is of the poses, in Study coordinates, whatever the formulation's unknowns.
    primes : int
        Primes at which the system was eliminated.
    complex_solutions : int or None
        Solutions of the formulation's equations with multiplicity, those included that are no poses; None if there are
        infinitely many, modulo a prime at least. For AFD2 those with 1 + t_j^2 = 0, which are infinitely many, are left
        out.
    real_solutions : int or None
        Distinct real solutions of the same.
    real_poses : int or None
        None if poses form a set of positive dimension, or seem to; there may be none, or infinitely many.
    claim : Claim
        What is proved about the list of poses.
    seconds : float
        From the formulation to the boxes of the poses, by the clock on the wall.
    processor_seconds : float
        The same by the processor, which tells formulations apart better where other programs run.
    stages : dict of str to float
        The same by stages.
    counting_seconds : float
        Time spent beside that on solutions that are no poses.
    notes : tuple of str
        What the engine did to represent all poses, and what it leaves open.
    """

    basis_elements: int
    rur_bytes: int | None
    rur_bits: int | None
    primes: int
    complex_solutions: int | None
    real_solutions: int | None
    real_poses: int | None
    claim: Claim
    seconds: float
    processor_seconds: float
    stages: dict[str, float]
    counting_seconds: float
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Row:
    """One line of the comparison.

    Attributes
    ----------
    code : str
        Code of the formulation, with its option if any.
    status : Status
    reason : str or None
        Why there is no result, or why ``agrees`` is None: a sentence.
    system : SystemFigures or None
        None if the formulation does not apply, or was not even written down in time.
    result : ResultFigures or None
        None unless the status is "done".
    agrees : bool or None
        Whether the real poses are those of the reference formulation; None if that was not decided.
    """

    code: str
    status: Status
    reason: str | None = None
    system: SystemFigures | None = None
    result: ResultFigures | None = field(default=None)
    agrees: bool | None = None

    def as_object(self) -> dict[str, Any]:
        """The row as JSON has it: one level, every key in every row.

        Examples
        --------
        >>> row = Row("AFD2", Status.TIMEOUT, "it did not end within 5 seconds").as_object()
        >>> row["status"], row["real_poses"]
        ('timeout', None)
        """
        return {
            "code": self.code,
            "status": self.status.value,
            "reason": self.reason,
            **_figures(SystemFigures, self.system),
            **_figures(ResultFigures, self.result),
            "agrees": self.agrees,
        }


def _figures(kind: type[SystemFigures] | type[ResultFigures], figures: SystemFigures | ResultFigures | None) -> Any:
    return dict.fromkeys(kind.__dataclass_fields__) if figures is None else asdict(figures)
