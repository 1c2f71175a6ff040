"""The exact rank of the Jacobian."""

from __future__ import annotations

from typing import Final

from pkm_exact.indices.index import Index, Measured, Output


def _rank(pose: Measured) -> int | None:
    return None if pose.jacobian is None else pose.jacobian.rank


def _text(pose: Measured) -> str:
    rank = _rank(pose)
    return "?" if rank is None else str(rank)


JACOBIAN_RANK: Final = Index(
    "rank",
    "rank J",
    "rank of the leg Jacobian",
    value=_rank,
    text=_text,
    number=_rank,
    is_integer=True,
    undecided=-1,
    outputs=frozenset({Output.JSON}),
)
