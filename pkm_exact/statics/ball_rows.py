"""Rows of the Jacobians at an enclosed pose, in balls and ordinary coordinates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

from flint import arb

from pkm_exact.balls import ball
from pkm_exact.constraints.constraint import SquareForm
from pkm_exact.constraints.form import ordinary, value_at, wrench
from pkm_exact.geometry.inverse import Metric
from pkm_exact.polytopes.enclosures import ball_of
from pkm_exact.statics.actuated_equations import AnyForm, Equation, Rate
from pkm_exact.statics.exact_rows import ExactRow, column_squares

BITS: Final = 256
"""Precision of the balls that exact numbers are enclosed in."""
_ORDINARY = (1, 1, 1)


@dataclass(frozen=True)
class BallRow:
    """A row of the Jacobians in ordinary coordinates.

    Attributes
    ----------
    wrench : tuple of arb
        Of unit force, or of unit moment where it has no force.
    rates : mapping from indices of actuators to arb
    """

    wrench: tuple[arb, ...]
    rates: Mapping[int, arb]


class BallPose:
    """An enclosed pose, in ordinary coordinates, at the precision in force.

    Parameters
    ----------
    position : sequence of 3 arb
    rotation : 3 rows of 3 arb
    metric : tuple of 3 int
    """

    def __init__(self, position: Sequence[arb], rotation: Sequence[Sequence[arb]], metric: Metric) -> None:
        self._position, self._rotation = position, rotation
        self._roots = [arb(g).sqrt() for g in metric]

    def row(self, equation: Equation, twist: Sequence[int]) -> BallRow:
        """The row of an equation."""
        found, size = self._derivative(equation.form), ball(equation.size_squared).rsqrt()
        rates = {rate.actuator: self._rate(rate) * size for rate in equation.rates}
        return BallRow(tuple(found[k] * size for k in twist), rates)

    def vanishes(self, equation: Equation) -> bool:
        """Whether the equation can hold: False if it is proved that it does not."""
        return bool(self._value(equation.form).contains(0))

    def _in_balls(self, form: Sequence[Any]) -> list[arb]:
        return ordinary([ball_of(value) for value in form], self._roots)

    def _at(self, form: Sequence[Any]) -> Any:
        return value_at(self._in_balls(form), self._position, self._rotation, _ORDINARY)

    def _derivative(self, form: AnyForm) -> list[arb]:
        if not isinstance(form, SquareForm):
            return wrench(self._in_balls(form), self._position, self._rotation)
        slope = 2 * ball(form.factor) * self._at(form.root)
        linear, root = (
            wrench(self._in_balls(part), self._position, self._rotation) for part in (form.linear, form.root)
        )
        return [left - slope * right for left, right in zip(linear, root, strict=True)]

    def _rate(self, rate: Rate) -> Any:
        if rate.stepped is not None:
            up, down = rate.stepped
            if isinstance(up, SquareForm) or isinstance(down, SquareForm):
                return (self._value(down) - self._value(up)) / 2
            return self._at([(b - a) / 2 for a, b in zip(up, down, strict=True)])
        return arb(1) if rate.value_squared is None else 2 * ball(rate.value_squared).sqrt()

    def _value(self, form: AnyForm) -> Any:
        if not isinstance(form, SquareForm):
            return self._at(form)
        root = self._at(form.root)
        return self._at(form.linear) - ball(form.factor) * root * root


def enclosed(row: ExactRow, metric: Metric, twist: Sequence[int]) -> BallRow:
    """An exact row in balls, at the precision in force."""
    size = ball(row.size_squared).rsqrt()
    columns = [ball(k).sqrt() for k in column_squares(metric, twist)]
    entries = tuple(ball_of(entry) * column * size for entry, column in zip(row.wrench, columns, strict=True))
    return BallRow(entries, {actuator: ball_of(rate) * size for actuator, rate in row.rates.items()})
