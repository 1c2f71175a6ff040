"""The sign of the determinant of the Jacobian: poses of different sign are separated by singularities."""

from __future__ import annotations

from typing import Final

from pkm_exact.indices.index import EVERYWHERE, Index, Measured, Output

_SIGNS: Final = {1: "+", -1: "-", 0: "0", None: "?"}
_WORDS: Final = {1: "positive", -1: "negative", 0: "0 (singular)", None: "not decided"}
_NONE: Final = "none, as there are more constraints than freedoms"


def _sign(pose: Measured) -> int | None:
    return pose.det_sign


def _has_none(pose: Measured) -> bool:
    """Whether there is a Jacobian without a determinant: it has more rows than columns."""
    return pose.det_sign is None and pose.jacobian is not None


DETERMINANT_SIGN: Final = Index(
    "det_sign",
    "det J",
    "sign of the determinant of the leg Jacobian",
    value=_sign,
    text=lambda pose: "none" if _has_none(pose) else _SIGNS[pose.det_sign],
    number=_sign,
    is_integer=True,
    undecided=2,
    outputs=EVERYWHERE - {Output.CSV},
    words=lambda pose: _NONE if _has_none(pose) else _WORDS[pose.det_sign],
)
