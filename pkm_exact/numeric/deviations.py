"""How far the pose of a robot within tolerance can be from the nominal one: guaranteed bounds, close to sharp.

With S the Jacobian between m and the robot's own solution x, x - m = - S^-1 (F(m) + E(m, p)). So a component g of the
pose changes by a product of the ball matrix Z = g' S^-1 with the errors E_i of the legs, each in an interval of its
own. The extremes of a norm of that are taken at vertices of the box of the E_i: all 2^legs are tried, upward for the
guaranteed bound, downward for one that some robot within tolerance attains.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Final

from flint import acb, arb, arb_mat, ctx

from pkm_exact.balls import ball
from pkm_exact.numeric.data_errors import DataErrors, LegErrors, leg_errors
from pkm_exact.numeric.linearisation import Linearisation, inverse_jacobians
from pkm_exact.numeric.pose_maps import interval, pose_map
from pkm_exact.roots.interval import Interval

MARGIN: Final = 1 + 2**-16
"""Bounds are a little larger than computed, so that a computation in another order confirms them."""
ROUNDING_BITS: Final = 32
"""Bounds leave room for rounding in all but so many of the bits computed with."""
POSITION_ROWS: Final = (0, 1, 2)
QUATERNION_ROWS: Final = (12, 13, 14, 15)
AXES: Final = ("x", "y", "z")


@dataclass(frozen=True)
class PoseBounds:
    """Bounds for the pose of every robot within tolerance.

    Attributes
    ----------
    components : tuple of 19 Interval
        Position, rotation matrix by rows, quaternion, and position of the centroid of the platform joints.
    position_error : Interval
        The greatest distance from the nominal position lies in it: none is greater than the upper end, and some robot
        has one as great as the lower end.
    rotation_error : Interval
        The same for the angle of the rotation from the nominal orientation, in radians.
    """

    components: tuple[Interval, ...]
    position_error: Interval
    rotation_error: Interval

    @property
    def position(self) -> tuple[Interval, ...]:
        """Of the origin of the platform's frame."""
        return self.components[:3]

    @property
    def rotation(self) -> tuple[tuple[Interval, ...], ...]:
        """Of the matrix, row by row."""
        return tuple(self.components[k : k + 3] for k in (3, 6, 9))

    @property
    def quaternion(self) -> tuple[Interval, ...]:
        """Of the unit quaternion, scalar first."""
        return self.components[12:16]

    @property
    def centroid(self) -> tuple[Interval, ...]:
        """Of the position of the centroid of the (nominal) platform joints."""
        return self.components[16:]


@dataclass(frozen=True)
class Influence:
    """A datum of a robot.

    Attributes
    ----------
    leg : int
        From 1.
    datum : {"base joint", "platform joint", "length"}
    axis : {"x", "y", "z", ""}
        In the ordinary coordinates of the joint's frame.

    Examples
    --------
    >>> print(Influence(2, "base joint", "y"), "and", Influence(3, "length", ""))
    y of base joint 2 and length of leg 3
    """

    leg: int
    datum: str
    axis: str

    def __str__(self) -> str:
        return f"{self.axis} of {self.datum} {self.leg}" if self.axis else f"length of leg {self.leg}"


def pose_bounds(near: Linearisation, errors: DataErrors, radii: Sequence[arb]) -> PoseBounds | None:
    """Bounds over all robots within tolerance, from a box in which each has exactly one pose; None if it is too wide.

    Parameters
    ----------
    near : Linearisation
        Around a real pose.
    errors : DataErrors
    radii : sequence of arb
        Of the box.
    """
    solved = inverse_jacobians(near, errors, radii)
    if solved is None:
        return None
    here = pose_map(near.robot, near.centre)
    effect = pose_map(near.robot, near.around(radii)).slopes * solved
    legs = leg_errors(near.robot, errors, near.quantities)
    first = near.robot.size - 1 - len(legs)
    effects = [[effect[k, first + i] for i in range(len(legs))] for k in range(effect.nrows())]
    offsets = (effect * arb_mat(near.robot.size, 1, [value.real for value in near.values.entries()])).entries()
    if not all(value.is_finite() for row in effects for value in row):
        return None
    bounds = [leg.total.real.abs_upper() for leg in legs]
    reach = [
        sum((row[i].abs_upper() * bounds[i] for i in range(len(legs))), offset.abs_upper())
        for row, offset in zip(effects, offsets, strict=True)
    ]
    components = tuple(interval(_widened(value, r)) for value, r in zip(here.values, reach, strict=True))
    distance = _greatest(effects, offsets, legs, POSITION_ROWS)
    chord = _greatest(effects, offsets, legs, QUATERNION_ROWS)
    if not chord < 1:
        return None
    return PoseBounds(components, _not_negative(distance), _not_negative(4 * (chord / 2).asin()))


def _not_negative(length: arb) -> Interval:
    """The ball as an interval, without what its rounding puts below 0."""
    bounds = interval(length)
    return Interval(max(bounds.lo, Fraction(0)), bounds.hi)


def _widened(value: arb, reach: arb) -> arb:
    """The value and what it can change by, with room for the rounding of another program that computes both."""
    if reach == 0 and value.is_exact():
        return value
    rounding = arb(2) ** (ROUNDING_BITS - ctx.prec) * (1 + abs(value))
    return value + arb(0, (MARGIN * reach + rounding).upper())


def _real(entries: Sequence[acb], size: int) -> arb_mat:
    return arb_mat(size, size, [entry.real for entry in entries])


def _greatest(
    effects: Sequence[Sequence[arb]], offsets: Sequence[arb], legs: Sequence[LegErrors], rows: Sequence[int]
) -> arb:
    """A ball with the greatest length that the change of these components can have."""
    chosen = arb_mat([effects[k] for k in rows])
    offset = sum((2 * offsets[k].abs_upper() for k in rows), arb(0)).upper()
    outer = [leg.total.real.abs_upper() for leg in legs]
    inner = [leg.linear.real.abs_upper() + leg.rest.real for leg in legs]
    high, low = arb(0), arb(0)
    for signs in product((1, -1), repeat=len(legs) - 1):
        for bounds in (outer, inner):
            vertex = [bounds[0], *(s * b for s, b in zip(signs, bounds[1:], strict=True))]
            change = (chosen * arb_mat(len(legs), 1, vertex)).entries()
            length = sum((value * value for value in change), arb(0)).nonnegative_part().sqrt()
            if bounds is outer:
                high = high.max(length.upper())
            else:
                low = low.max(length.lower())
    return (low - offset).lower().max(arb(0)).union(MARGIN * (high + offset))


def dominant_influence(near: Linearisation, errors: DataErrors) -> Influence:
    """The datum whose tolerance moves the platform most, to first order: position (unit of size) and quaternion."""
    effect = pose_map(near.robot, near.centre).slopes * _real(near.inverse.entries(), near.robot.size)
    legs = leg_errors(near.robot, errors, near.quantities)
    first = near.robot.size - 1 - len(legs)
    unit = ball(near.robot.frames.unit)
    best, found = arb(-1), Influence(1, "length", "")
    for i, leg in enumerate(legs):
        column = [effect[k, first + i] for k in range(effect.nrows())]
        parts = [*(column[k] / unit for k in POSITION_ROWS), *(column[k] for k in QUATERNION_ROWS)]
        size = sum((part * part for part in parts), arb(0)).nonnegative_part().sqrt()
        for datum, value, bound in zip(_data(leg), leg.influences, leg.bounds, strict=True):
            contribution = (size * (value * bound).real.abs_upper()).mid()
            if contribution > best:
                best, found = contribution, Influence(i + 1, *datum)
    return found


def _data(leg: LegErrors) -> list[tuple[str, str]]:
    """Names of the data of a leg, in the order of ``LegErrors.influences``."""
    axes = AXES[: len(leg.influences) // 2]
    return [*(("base joint", axis) for axis in axes), *(("platform joint", axis) for axis in axes), ("length", "")]
