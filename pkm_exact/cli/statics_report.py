"""What a machine can do at a pose, as a JSON object or as tables."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from pkm_exact.statics.asked_answers import StaticsAnswers
from pkm_exact.statics.at_pose import AtPose


def as_object(at: AtPose, nearest: Fraction | None, extra: StaticsAnswers) -> dict[str, Any]:
    """The answer as a JSON object: of every enclosed number both ends, exact rationals as strings."""
    actuated = bool(at.actuated)
    given = [name for name, there in (("J_x", actuated), ("J_q", actuated), ("J", at.jacobian is not None)) if there]
    return {
        "robot": {"name": at.name, "unit": at.unit, "motion": at.motion.name},
        "exact": at.is_exact,
        "nearest": None if nearest is None else str(nearest),
        "twist": list(at.twist),
        "constraints": [equation.name for equation in at.equations],
        "actuated": list(at.actuated),
        "given": given,
        "jacobian": None if at.jacobian is None else at.jacobian.as_object(),
        "jacobian_exact": None if at.jacobian is None or at.jacobian.exact is None else at.jacobian.exact,
        "J_x": at.J_x.as_object() if actuated else None,
        "J_q": [row[k] for k, row in enumerate(at.J_q.as_object())] if actuated else None,
        "wrenches": at.wrenches.as_object(),
        "rank": at.rank,
        "structural_rank": at.kinds.structural_rank,
        "singular": list(at.singular),
        "singularities": [{"name": found.name, "constraints": list(found.constraints)} for found in at.singularities],
        "undecided": list(at.kinds.undecided),
    } | extra.as_object()


def as_text(at: AtPose, nearest: Fraction | None, extra: StaticsAnswers) -> str:
    """The answer as a headline and tables."""
    lines = [f"{at.name}, {'exact pose' if at.is_exact else 'pose in a box'}, lengths in {at.unit}"]
    if nearest is not None:
        lines.append(f"the pose is off by at most {nearest} from the one given, which the metric does not have exactly")
    rank = "not decided" if at.rank is None else str(at.rank)
    lines.append(f"{len(at.equations)} constraints of rank {rank}, {at.motion.dimension} freedoms")
    lines += [f"singular: {found}" for found in at.singularities]
    if not at.singularities and not at.kinds.undecided:
        lines.append("not singular")
    lines += [f"not decided: {name}" for name in at.kinds.undecided]
    lines += ["", "wrenches at unit force, moments about the platform's origin", str(at.wrenches)]
    if at.jacobian is not None:
        lines += ["", "J: speeds of the actuators by the twist of the platform, q' = J t", str(at.jacobian)]
    elif at.actuated:
        lines += ["", "J is not defined here: an entry of J_q is or may be 0; J_q:", str(at.J_q)]
    else:
        lines += ["", "no constraint is known to be actuated: there is no J (of a certificate, --model says which are)"]
    lines += extra.lines()
    return "".join(f"{line}\n" for line in lines)
