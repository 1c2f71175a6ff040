"""What errors of a robot's data do to the equations of its legs.

Let E_i(x, p) be by how much the equation of leg i changes if its data A, B, l are off by a, b, t. With d = C + R B - A,

    E_i = N(e) (2 d.(R b - a) - 2 l t + |R b - a|^2 - t^2)

exactly. Every leg has data of its own, so at a point x the E_i fill a box independently.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import acb, arb

from pkm_exact.balls import ball
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.numeric import centred
from pkm_exact.numeric.centred import CentredRobot


@dataclass(frozen=True)
class DataErrors:
    """Bounds of the errors of the data, as balls around 0 in the centred unit; None stands for no error.

    Attributes
    ----------
    base, platform, lengths : arb
    """

    base: arb
    platform: arb
    lengths: arb


def data_errors(robot: CentredRobot, tolerances: Tolerances) -> DataErrors:
    """The tolerances in the centred unit of length."""
    unit = robot.frames.unit
    return DataErrors(
        *(_around_zero(ball(t / unit)) for t in (tolerances.base, tolerances.platform, tolerances.lengths))
    )


def _around_zero(bound: arb) -> arb:
    return arb(0, bound.abs_upper())


@dataclass(frozen=True)
class LegErrors:
    """What the errors of a leg's data do to its equation at a point.

    Attributes
    ----------
    influences : tuple of acb
        Derivatives by the data: base joint, platform joint, length.
    bounds : tuple of arb
        Of the data, in the same order: balls around 0.
    rest : acb
        Bounds for the terms of second order.
    """

    influences: tuple[acb, ...]
    bounds: tuple[arb, ...]
    rest: acb

    @property
    def linear(self) -> acb:
        """Bounds for the terms of first order."""
        terms = (value * bound for value, bound in zip(self.influences, self.bounds, strict=True))
        return sum(terms, acb(0))

    @property
    def total(self) -> acb:
        """Bounds for E_i."""
        return self.linear + self.rest


def leg_errors(robot: CentredRobot, errors: DataErrors, values: Sequence[acb]) -> list[LegErrors]:
    """The E_i at a point (or in a box), from the quantities there; they are linear in the quantities."""
    axes = range(2 if robot.problem.motion.is_planar else 3)
    norm = values[centred.NORM]
    position, turned = values[centred.POSITION : centred.ROTATION], values[centred.TURNED : centred.POSITION]
    rotation = [values[centred.ROTATION + 3 * i : centred.ROTATION + 3 * i + 3] for i in range(3)]
    square = sum((errors.base * errors.base + errors.platform * errors.platform for _ in axes), arb(0))
    mixed = sum((2 * rotation[j][k] * (errors.base * errors.platform) for j in axes for k in axes), acb(0))
    rest = norm * (square - errors.lengths * errors.lengths) - mixed
    found = []
    for a, b, length in zip(robot.legs.base, robot.legs.platform, robot.legs.lengths, strict=True):
        line = [position[j] + sum((rotation[j][k] * b[k] for k in axes), acb(0)) - a[j] * norm for j in axes]
        # N R^-1 d = N (u + B - R^-1 A)
        back = [turned[k] + b[k] * norm - sum((rotation[j][k] * a[j] for j in axes), acb(0)) for k in axes]
        influences = (*(-2 * v for v in line), *(2 * v for v in back), -2 * length * norm)
        bounds = (*(errors.base for _ in axes), *(errors.platform for _ in axes), errors.lengths)
        found.append(LegErrors(influences, bounds, rest))
    return found
