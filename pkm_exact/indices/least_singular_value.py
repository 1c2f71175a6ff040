"""The least singular value of the Jacobian, which is 0 where the pose is singular."""

from __future__ import annotations

from typing import Final

from pkm_exact.indices.index import Index, Measured, Output
from pkm_exact.roots.interval import Interval, decimal


def _least(pose: Measured) -> Interval | None:
    return None if pose.jacobian is None else pose.jacobian.sigma_min


def _text(pose: Measured) -> str:
    least = _least(pose)
    return "?" if least is None else decimal(least)


def _number(pose: Measured) -> float | None:
    least = _least(pose)
    return None if least is None else float(least)


LEAST_SINGULAR_VALUE: Final = Index(
    "sigma_min",
    "sigma min",
    "least singular value of the leg Jacobian",
    value=_least,
    text=_text,
    number=_number,
    outputs=frozenset({Output.JSON}),
)
