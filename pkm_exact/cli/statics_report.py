"""What a machine can do at a pose, as a JSON object or as tables."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from pkm_exact.errors import InputError
from pkm_exact.statics.asked_answers import StaticsAnswers
from pkm_exact.statics.at_pose import AtPose
from pkm_exact.statics.enclosed_matrix import EnclosedMatrix
from pkm_exact.statics.matrix_ranks import matrix_ranks


def as_object(at: AtPose, nearest: Fraction | None, extra: StaticsAnswers) -> dict[str, Any]:
    """The answer as a JSON object: of every enclosed number both ends, exact rationals as strings."""
    actuated = bool(at.actuated)
    forward = _forward(at)
    matrices = ("J_x", actuated), ("J_q", actuated), ("J", at.jacobian is not None), ("T", forward is not None)
    given = [name for name, there in matrices if there]
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
        "J_q": _drives(at) if actuated else None,
        "forward": None if forward is None else forward.as_object(),
        "forward_exact": None if forward is None else forward.exact,
        "wrenches": at.wrenches.as_object(),
        "rank": at.rank,
        "ranks": matrix_ranks(at),
        "structural_rank": at.kinds.structural_rank,
        "singular": list(at.singular),
        "singularities": [{"name": found.name, "constraints": list(found.constraints)} for found in at.singularities],
        "undecided": list(at.kinds.undecided),
    } | extra.as_object()


def _why_not(at: AtPose) -> str:
    return "an entry of J_q is or may be 0" if at.held.is_diagonal else "J_q is or may be singular"


def _forward(at: AtPose) -> EnclosedMatrix | None:
    """T, where the twist follows from the actuators and not they from it."""
    try:
        return at.forward
    except InputError:
        return None


def _drives(at: AtPose) -> list[Any]:
    """The diagonal of J_q; its rows if it is not diagonal."""
    rows: list[Any] = at.J_q.as_object()
    return [row[k] for k, row in enumerate(rows)] if at.held.is_diagonal else rows


def as_text(at: AtPose, nearest: Fraction | None, extra: StaticsAnswers) -> str:
    """The answer as a headline and tables."""
    lines = [f"{at.name}, {'exact pose' if at.is_exact else 'pose in a box'}, lengths in {at.unit}"]
    if nearest is not None:
        lines.append(f"the pose is off by at most {nearest} from the one given, which the metric does not have exactly")
    rank = "not decided" if at.rank is None else str(at.rank)
    lines.append(f"{len(at.equations)} constraints of rank {rank}, {at.motion.dimension} freedoms")
    own = [f"{name} {value}" for name, value in matrix_ranks(at).items() if name != "wrenches" and value is not None]
    lines += [f"ranks: {', '.join(own)}"] if own else []
    lines += [f"singular: {found}" for found in at.singularities]
    if not at.singularities and not at.kinds.undecided:
        lines.append("not singular")
    lines += [f"not decided: {name}" for name in at.kinds.undecided]
    lines += ["", "wrenches at unit force, moments about the platform's origin", str(at.wrenches)]
    if at.jacobian is not None:
        lines += ["", "J: speeds of the actuators by the twist of the platform, q' = J t", str(at.jacobian)]
    elif at.held.is_redundant:
        lines += [
            "",
            "J_x t = J_q q'; there is no J: with more actuators than constraints for them q' does not follow from t",
        ]
        lines += ["J_x:", str(at.J_x), "J_q:", str(at.J_q)]
        forward = _forward(at)
        if forward is not None:
            lines += ["", "T: the twist of the platform by the speeds of the actuators, t = T q'", str(forward)]
    elif at.actuated:
        lines += ["", f"J is not defined here: {_why_not(at)}; J_q:", str(at.J_q)]
        forward = _forward(at)
        if forward is not None:
            lines += ["", "T: the twist of the platform by the speeds of the actuators, t = T q'", str(forward)]
    else:
        lines += ["", "no constraint is known to be actuated: there is no J (of a certificate, --model says which are)"]
    lines += extra.lines()
    return "".join(f"{line}\n" for line in lines)
