"""Rows of the Jacobians at a rational pose, exactly: sums of square roots, in rational coordinates of the metric."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from pkm_exact.constraints.constraint import SquareForm
from pkm_exact.constraints.form import Vector, rational_wrench, value_at
from pkm_exact.geometry.inverse import Matrix, Metric
from pkm_exact.radicals import RootSum
from pkm_exact.statics.actuated_equations import AnyForm, Equation, Rate


@dataclass(frozen=True)
class ExactRow:
    """A row of the Jacobians, exactly.

    Attributes
    ----------
    wrench : tuple of numbers
        W, a component for every freedom of the motion, in rational coordinates; of ordinary ones it is W_j sqrt(k_j)
        (``column_squares``).
    size_squared : Fraction
        Square of what W is divided by to have unit force.
    rates : mapping from indices of actuators to RootSum
        W y is the sum of rate q'.
    """

    wrench: tuple[Any, ...]
    size_squared: Fraction
    rates: Mapping[int, RootSum]


def column_squares(metric: Metric, twist: Sequence[int], length: Fraction = Fraction(1)) -> list[Fraction]:
    """k_j: an ordinary wrench is the rational one times sqrt(k_j), moments divided by the length.

    An ordinary twist is the rational one divided by sqrt(k_j), and turns are multiplied by the length.

    Examples
    --------
    >>> [str(k) for k in column_squares((1, 3, 1), (0, 1, 5))]
    ['1', '1/3', '1/3']
    """
    g1, g2, g3 = metric
    squares = [Fraction(1, g) for g in metric]
    squares += [1 / (g * length * length) for g in (g2 * g3, g3 * g1, g1 * g2)]
    return [squares[k] for k in twist]


def exact_row(equation: Equation, position: Vector, rotation: Matrix, metric: Metric, twist: Sequence[int]) -> ExactRow:
    """The row of an equation at a pose, both in rational coordinates."""
    where = position, rotation, metric
    found = _derivative(equation.form, *where)
    rates = {rate.actuator: _rate(rate, *where) for rate in equation.rates}
    return ExactRow(tuple(found[k] for k in twist), equation.size_squared, rates)


def _derivative(form: AnyForm, position: Vector, rotation: Matrix, metric: Metric) -> list[Any]:
    if not isinstance(form, SquareForm):
        return rational_wrench(form, position, rotation, metric)
    slope = 2 * form.factor * value_at(form.root, position, rotation, metric)
    linear, root = (rational_wrench(part, position, rotation, metric) for part in (form.linear, form.root))
    return [left - slope * right for left, right in zip(linear, root, strict=True)]


def _rate(rate: Rate, position: Vector, rotation: Matrix, metric: Metric) -> RootSum:
    if rate.stepped is not None:
        up, down = (_value(form, position, rotation, metric) for form in rate.stepped)
        return RootSum.of((down - up) / 2)
    return RootSum.of(1) if rate.value_squared is None else 2 * RootSum.root(rate.value_squared)


def _value(form: AnyForm, position: Vector, rotation: Matrix, metric: Metric) -> Any:
    if not isinstance(form, SquareForm):
        return value_at(form, position, rotation, metric)
    linear, root = (value_at(part, position, rotation, metric) for part in (form.linear, form.root))
    return linear - form.factor * root * root
