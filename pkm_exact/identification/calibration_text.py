"""A calibrated robot as a model, and its covariance as TOML."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from math import isqrt
from typing import TYPE_CHECKING

from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.robot import Configuration, Robot

if TYPE_CHECKING:
    from pkm_exact.identification.calibration_fit import LegFit

_ZERO = Fraction(0)


def calibrated_robot(robot: Robot, fits: Sequence[LegFit], digits: int) -> Robot:
    """The robot with fitted joints, and with the lengths of its configurations longer by the offsets; all rounded."""
    size = 2 if robot.motion.is_planar else 3

    def joint(values: Sequence[float]) -> Vector:
        x, y, z = (*(_rounded(Fraction(value), digits) for value in values), *[_ZERO] * (3 - size))
        return x, y, z

    base = tuple(joint(fit.values[:size]) for fit in fits)
    platform = tuple(joint(fit.values[size : 2 * size]) for fit in fits)
    offsets = [Fraction(fit.values[2 * size]) if len(fit.values) > 2 * size else _ZERO for fit in fits]
    configurations = tuple(
        Configuration(
            configuration.name,
            tuple(
                _rounded(_root(square, digits) + offset, digits) ** 2
                for square, offset in zip(configuration.lengths_squared, offsets, strict=True)
            ),
        )
        for configuration in robot.configurations
    )
    return replace(robot, base_joints=base, platform_joints=platform, configurations=configurations)


def _rounded(value: Fraction, digits: int) -> Fraction:
    return Fraction(round(value * 10**digits), 10**digits)


def _root(square: Fraction, digits: int) -> Fraction:
    """The square root to some digits more."""
    unit = 10 ** (digits + 6)
    return Fraction(isqrt(square.numerator * unit * unit // square.denominator), unit)


def model_values(robot: Robot, leg: int, count: int) -> list[Fraction]:
    """The parameters of a leg in the model: base joint, platform joint, and 0 for an offset."""
    size = 2 if robot.motion.is_planar else 3
    values = [*robot.base_joints[leg][:size], *robot.platform_joints[leg][:size], _ZERO]
    return values[:count]


def covariance_text(unit: str, fits: Sequence[LegFit]) -> str:
    """The fit as TOML: a table for each leg; nothing correlates parameters of different legs.

    Examples
    --------
    >>> from pkm_exact.identification.calibration_fit import LegFit
    >>> print(covariance_text("mm", [LegFit(("A1x",), (1.5,), ((0.25,),), (0.1,), (0.0,))]).splitlines()[4])
    parameters = ["A1x"]
    """
    lines = [
        "# Values, covariance and residuals of a calibration by least squares: floating point, nothing is certified.",
        f"unit = {json.dumps(unit, ensure_ascii=False)}",
        "",
    ]
    for leg, fit in enumerate(fits, 1):
        lines += _leg(leg, fit)
    return "\n".join(lines).rstrip("\n") + "\n"


def _leg(leg: int, fit: LegFit) -> Iterator[str]:
    yield f"[leg{leg}]"
    yield f"parameters = {json.dumps(list(fit.names))}"
    yield f"values = {_list(fit.values)}"
    yield f"standard_deviations = {_list([max(row[k], 0.0) ** 0.5 for k, row in enumerate(fit.covariance)])}"
    yield "covariance = ["
    yield from (f"    {_list(row)}," for row in fit.covariance)
    yield "]"
    yield f"residuals_of_the_model = {_list(fit.before)}"
    yield f"residuals = {_list(fit.after)}"
    yield ""


def _list(values: Sequence[float]) -> str:
    return f"[{', '.join(f'{value:.9g}' if value else '0.0' for value in values)}]"
