"""The sentences that a solution carries beside its claim."""

from __future__ import annotations

from pkm_exact.formulations.turned import Turn
from pkm_exact.poses.self_motion import SelfMotion, TranslationalMotion


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


def motion_note(motion: SelfMotion | TranslationalMotion) -> str:
    """Names a self-motion."""
    if isinstance(motion, TranslationalMotion):
        return (
            "self-motion: base and platform are congruent and the legs equal, so that the platform moves on a sphere "
            "without turning"
        )
    return (
        f"architecture singularity: the legs give only {6 - motion.dimension} independent conditions on rigid motions, "
        f"and the robot moves with its legs locked, in dimension {motion.dimension} at least"
    )


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
