"""The words for a claim: table, JSON, notebook, page, picture and message all take them from here.

``docs/guarantees.md`` defines each claim and quotes its sentence; the tests hold one against the other. What a claim is
about, legs with lengths or constraints of several types, is a ``Subject``, for whose words the sentences have places. A
robot is said to move only where a real motion is proved (``RealMotion``): that the complex poses form a curve does not
say that a real one lies on it. The checkers share nothing with this package: their sentences stand in
``docs/certificates.md``.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Final

from pkm_exact.claim import Claim, RealMotion

INFINITE: Final = (Claim.POSITIVE_DIMENSIONAL_DETECTED, Claim.POSITIVE_DIMENSIONAL_PROVED)


@dataclass(frozen=True)
class Subject:
    """What the sentences call a robot, what is locked, what its equations are of, and what a pose does with them.

    Attributes
    ----------
    robot, locked, equation : str
        A noun each, the second in the plural.
    meets : str
        What a pose does.
    given : str
        Adverbial: with what the question was asked.
    """

    robot: str
    locked: str
    equation: str
    meets: str
    given: str

    def says(self, sentence: str) -> str:
        """A sentence about it."""
        return sentence.format(**asdict(self))


LEGS: Final = Subject("robot", "legs", "leg", "has these leg lengths", "with these leg lengths")
"""Of a robot all of whose constraints are legs of known length."""
CONSTRAINTS: Final = Subject(
    "mechanism", "actuators", "constraint", "meets all these constraints", "under these constraints"
)
"""Of any other."""


def subject(*, of_legs: bool) -> Subject:
    """What is spoken of: whether all constraints are legs of known length says it."""
    return LEGS if of_legs else CONSTRAINTS


_OF_LISTS: Final = {
    Claim.COMPLETE: "complete: it is proved that there is no other",
    Claim.NOT_PROVEN_COMPLETE: "not proven complete: each pose is certified, but others are not excluded",
    Claim.POSITIVE_DIMENSIONAL_DETECTED: (
        "infinitely many solutions detected, not proved; whether the {robot} can move with locked {locked} is not known"
    ),
    Claim.INCONSISTENT: "inconsistent: no pose {meets}, not even a complex one",
}
_OF_MOTIONS: Final = {
    RealMotion.PROVED: "infinitely many real poses, proved: the {robot} moves with locked {locked}",
    RealMotion.OPEN: "infinitely many complex poses, proved; a real motion is neither proved nor excluded",
    RealMotion.NO_REAL_POSE: "infinitely many complex poses, proved; that none of them is real is proved as well",
}
REAL_MOTION: Final = {
    RealMotion.PROVED: "real ones among them are proved, along which the {robot} moves with its {locked} locked",
    RealMotion.OPEN: "that one of them is real, and that the {robot} moves, is neither proved nor excluded",
    RealMotion.NO_REAL_POSE: "no real pose {meets}, which is proved too",
}
"""What is known of real motions on a set of complex poses, after its cause and its dimension."""

PARALLEL: Final = (
    "self-motion: base and platform are congruent and the legs equal, so that the platform moves on {path} without "
    "turning"
)
"""The motion that every certificate of it proves to be real."""
OF_CERTIFICATE: Final = "Infinitely many complex poses, proved."
OF_CERTIFICATE_MEANING: Final = (
    "The equations of the {equation}s have curves or surfaces of solutions. Whether real poses are among them, so that "
    "the {robot} moves with its {locked} locked, is proved by this certificate only if the last line of what was "
    "checked, below, says so."
)
"""What a certificate says of a set of positive dimension: its proof is one of complex poses."""
OF_EVIDENCE: Final = "Infinitely many solutions were detected, not proved; whether the {robot} can move is not known."
OF_EVIDENCE_MEANING: Final = (
    "Modulo two primes the solutions are infinitely many. This is evidence, not a proof, and does not tell real "
    "solutions from others."
)
DETECTED_NOTE: Final = (
    "the solutions form a set of positive dimension at two primes, which is evidence and no proof: there is a curve of "
    "poses, real or complex, or solutions run together at infinity"
)
INCONSISTENT_NOTE: Final = "no pose, real or complex, {meets}"
NO_SOLUTION_NOTE: Final = (
    "there is no solution, real or complex, modulo two primes; that there is none over Q is not proved"
)

DIGITS: Final = (
    "{poses}: the condition number times the last digit written in the model, {digit}, is more than the size of the "
    "robot, so that the answer rests on digits that the data do not have; it is proved for the decimals as they stand"
)
"""What is proved says little of the robot whose rounded numbers a model file has."""
NEARBY: Final = "to within a few of these digits {facts}"
NEARBY_SINGULAR: Final = (
    "; of the robot of which that is exactly true the leg equations are dependent in every pose (an architecture "
    "singularity)"
)
NEARBY_MOVES: Final = ", and it moves with its legs locked"


def meaning(claim: Claim, motion: RealMotion | None, of: Subject = LEGS) -> str:
    """The sentence for a claim; of a set of positive dimension that is proved, with what is known of real motions.

    Examples
    --------
    >>> meaning(Claim.COMPLETE, None)
    'complete: it is proved that there is no other'
    >>> meaning(Claim.POSITIVE_DIMENSIONAL_PROVED, RealMotion.OPEN)
    'infinitely many complex poses, proved; a real motion is neither proved nor excluded'
    >>> meaning(Claim.INCONSISTENT, None, CONSTRAINTS)
    'inconsistent: no pose meets all these constraints, not even a complex one'
    """
    if claim is Claim.POSITIVE_DIMENSIONAL_PROVED:
        return of.says(_OF_MOTIONS[motion or RealMotion.OPEN])
    return of.says(_OF_LISTS[claim])


def without_a_list(claim: Claim) -> str:
    """Why there is no list of all poses, where their set has a positive dimension, or seems to have one."""
    if claim is Claim.POSITIVE_DIMENSIONAL_PROVED:
        return "its complex poses are infinitely many, which is proved"
    return "its solutions are infinitely many modulo two primes, which is evidence and no proof"
