"""The sentences that a solution carries beside its claim."""

from __future__ import annotations

from collections.abc import Sequence

from pkm_exact.claim_wording import INCONSISTENT_NOTE, PARALLEL, REAL_MOTION, Subject, subject
from pkm_exact.completeness.pose_slices import MorePoses
from pkm_exact.formulations.turned import Turn
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.poses.self_motion import Cause, SelfMotion, TranslationalMotion
from pkm_exact.poses.singularity import Singularity


def turn_notes(turn: Turn, attempt: int) -> tuple[str, ...]:
    """Says that the platform frame was turned, if it was not the first that was tried."""
    if attempt == 0:
        return ()
    words = ", ".join(map(str, turn))
    note = (
        "in the given frame of the platform some pose has no finite coordinates in this formulation; it was solved in "
        f"the frame turned by the quaternion ({words}), and the poses were turned back"
    )
    return (note,)


_CAUSES = {
    Cause.PLATFORM_LINE: "the platform joints are collinear, and turning about their line leads from pose to pose",
    Cause.BASE_LINE: "the base joints are collinear, and turning about their line leads from pose to pose",
    Cause.PLATFORM_POINT: "all platform joints coincide, and turning about that point leads from pose to pose",
    Cause.BASE_POINT: "all base joints coincide, and turning about that point leads from pose to pose",
    Cause.DEPENDENT_LEGS: "the {leg} forms are dependent, of rank {rank} (an architecture singularity)",
    Cause.FEW: "there are fewer constraints than freedoms, of rank {rank}",
    Cause.PLATFORM_MOTION: "moving about axes fixed in the platform, or along them, leads from pose to pose",
    Cause.BASE_MOTION: "moving about axes fixed in the base, or along them, leads from pose to pose",
    Cause.SIMILAR_ON_CONIC: (
        "base and platform are similar and their joints lie on a conic, so that the leg forms are dependent, of rank "
        "{rank} (an architecture singularity)"
    ),
}


def motion_note(motion: SelfMotion | TranslationalMotion | MorePoses, problem: ForwardProblem) -> str:
    """Says why the poses form a set of positive dimension, and what is known of real ones."""
    if isinstance(motion, TranslationalMotion):
        return PARALLEL.format(path="a circle" if problem.motion.is_planar else "a sphere")
    words = _subject(problem)
    real = words.says(REAL_MOTION[motion.real])
    if isinstance(motion, MorePoses):
        return (
            f"{motion.count} distinct complex poses are certified, more than the {motion.bound} that can be isolated; "
            f"so the complex poses form a set of dimension 1 at least; {real}"
        )
    bound = motion.mobility
    causes = "; ".join(_CAUSES[cause].format(rank=bound.rank, leg=words.equation) for cause in bound.causes)
    return f"{causes}; the complex poses form a set of dimension {bound.dimension} at least; {real}"


def inconsistent_note(problem: ForwardProblem) -> str:
    """Says that there is no pose."""
    return _subject(problem).says(INCONSISTENT_NOTE)


def _subject(problem: ForwardProblem) -> Subject:
    return subject(of_legs=problem.has_only_distances)


def singular_notes(found: Sequence[Singularity | None], problem: ForwardProblem) -> tuple[str, ...]:
    """Says of singular poses how many degrees of freedom are not held there, and why, equal ones together.

    Parameters
    ----------
    found : sequence of Singularity or None
        In the order of the poses; None at a pose that is not singular.
    problem : ForwardProblem

    Examples
    --------
    >>> singular_notes([None, Singularity(4)], ForwardProblem(()))
    ('pose 2 is singular, rank 4 of 6: the legs lose control of 2 degrees of freedom, which the platform gains',)
    """
    full, constraints = problem.motion.dimension, f"{_subject(problem).equation}s"
    places: dict[Singularity, list[int]] = {}
    for place, singularity in enumerate(found, 1):
        if singularity is not None and singularity.rank < full:
            places.setdefault(singularity, []).append(place)
    notes = []
    for singularity, numbers in places.items():
        poses = f"pose {numbers[0]} is" if len(numbers) == 1 else f"poses {', '.join(map(str, numbers))} are"
        gained = full - singularity.rank
        freedom = "1 degree of freedom" if gained == 1 else f"{gained} degrees of freedom"
        reasons = "".join(f"; {special}" for special in singularity.special)
        notes.append(
            f"{poses} singular, rank {singularity.rank} of {full}: the {constraints} lose control of {freedom}, which "
            f"the platform gains{reasons}"
        )
    return tuple(notes)


def isolated_note(count: int) -> str:
    """Says what is listed beside a set of positive dimension."""
    solutions = "1 complex solution is" if count == 1 else f"{count} complex solutions are"
    return f"beside it {solutions} certified to be isolated, the real ones are listed; others are not excluded"


def open_question(count: int, distinct: int) -> str:
    """Says what is not proved about a list of poses."""
    if distinct < count:
        return (
            f"{count} complex solutions with multiplicity, {distinct} distinct; multiple ones are not certified as "
            "such, and that there is no other is not proved"
        )
    return (
        f"{count} finite solutions were found; each one listed is certified, but that there is no other is not proved"
    )
