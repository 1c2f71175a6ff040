"""The sign of the determinant of the Jacobian: poses of different sign are separated by singularities."""

from __future__ import annotations

from typing import Final

from pkm_exact.indices.index import EVERYWHERE, Index, Measured, Output

_SIGNS: Final = {1: "+", -1: "-", 0: "0", None: "?"}
_WORDS: Final = {1: "positive", -1: "negative", 0: "0 (singular)", None: "not decided"}


def _sign(pose: Measured) -> int | None:
    return pose.det_sign


DETERMINANT_SIGN: Final = Index(
    "det_sign",
    "det J",
    "sign of the determinant of the leg Jacobian",
    value=_sign,
    text=lambda pose: _SIGNS[pose.det_sign],
    number=_sign,
    is_integer=True,
    undecided=2,
    outputs=EVERYWHERE - {Output.CSV},
    words=lambda pose: _WORDS[pose.det_sign],
)
