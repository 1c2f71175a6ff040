"""The condition number of the Jacobian, its largest singular value by the smallest."""

from __future__ import annotations

from decimal import Decimal
from math import inf
from typing import Final

from pkm_exact.indices.index import EVERYWHERE, Index, Measured, Output
from pkm_exact.roots.interval import Interval


def _condition(pose: Measured) -> Interval | None:
    return None if pose.jacobian is None else pose.jacobian.condition


def _text(pose: Measured) -> str:
    """The midpoint, to four digits."""
    condition = _condition(pose)
    if condition is None:
        return "singular" if pose.det_sign == 0 else "?"
    middle = condition.midpoint
    return f"{Decimal(middle.numerator) / middle.denominator:.4g}"


def _number(pose: Measured) -> float | None:
    """The midpoint; infinite at a singular pose."""
    condition = _condition(pose)
    if condition is None:
        return inf if pose.det_sign == 0 else None
    return float(condition)


JACOBIAN_CONDITION: Final = Index(
    "condition",
    "cond J",
    "condition number of the leg Jacobian",
    value=_condition,
    text=_text,
    number=_number,
    outputs=EVERYWHERE - {Output.CSV, Output.SWEEP},
)
