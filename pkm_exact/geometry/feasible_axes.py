"""How far redundant axes may go while a platform stands still: strokes of legs as conditions on one slide or crank.

A machine with more axes than freedoms holds its platform at a pose with legs of actuated length, while slides or cranks
move their feet. The square of a leg's length is a quadratic polynomial in a slide's position, and in the half tangent t
of a crank after multiplication by 1 + t^2. So with strokes of all legs, the positions that are allowed are finitely
many closed intervals whose ends are exact.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Final

from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import JointValue
from pkm_exact.geometry.inverse import Matrix, distance_squared
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.quadratic_ranges import Quadratic, Range, ranges_of
from pkm_exact.wording import shown

Stroke = tuple[Fraction, Fraction]
"""Least and greatest value."""


def feasible_positions(
    robot: Mechanism,
    axis: str,
    others: dict[str, JointValue],
    pose: tuple[Vector, Matrix],
    legs: Stroke,
    stroke: Stroke,
) -> tuple[Range, ...]:
    """Positions of one axis at which all legs of actuated length are within their stroke, the platform at a pose.

    Parameters
    ----------
    robot : Mechanism
    axis : str
        Name of a slide or a crank that moves legs' feet.
    others : dict
        Values of the other slides and cranks.
    pose : tuple
        Position and rotation matrix of the platform, in the metric of the robot.
    legs : tuple of Fraction
        Least and greatest length of every leg.
    stroke : tuple of Fraction
        Of the axis: positions of a slide, half tangents of a crank; half a turn is not among these.

    Returns
    -------
    tuple of pairs of RootSum
        Closed intervals in increasing order; none if there is no such position.

    Raises
    ------
    InputError
        If there is no such axis, the stroke of the legs is not one of lengths, or squares of lengths do not depend on
        the axis as said above.

    Examples
    --------
    >>> from pkm_exact.geometry.drives import Drive, Part
    >>> from pkm_exact.motions.motion_groups import SPATIAL
    >>> no, one, two = Fraction(0), Fraction(1), Fraction(2)
    >>> leg = Distance((no, no, one), (no, no, no), two, "leg")
    >>> robot = Mechanism(
    ...     name="r", kind="constraints", unit="m", source="", metric=(1, 1, 1), motion=SPATIAL, constraints=(leg,),
    ...     actuated=("leg", "x"), configurations=(), drives=(Drive("x", (Part("leg", "base", ((one, no, no),)),)),))
    >>> still = ((one, no, no), (no, one, no), (no, no, one))
    >>> found = feasible_positions(robot, "x", {}, ((no, no, no), still), (one, two), (-one, 3 * one))
    >>> [(str(start), str(end)) for start, end in found]
    [('-1', 'sqrt(3)')]
    """
    drive = robot.drive(axis)
    if drive is None:
        raise InputError(f"axis: {shown(axis)} is not a slide or a crank of this robot; name one that is")
    low, high = legs
    if not 0 <= low <= high:
        raise InputError("legs: not a stroke of lengths; give the least and the greatest, neither below 0")
    if drive.is_crank and drive.weight != 1:
        raise InputError(f"axis: {shown(axis)} turns in a metric; give the robot in ordinary coordinates")
    at: list[JointValue] = [*_TURNS] if drive.is_crank else [*_WAYS]
    squares = [_squares(robot, {**others, axis: value}, pose) for value in at]
    conditions: list[Quadratic] = []
    for values in zip(*squares, strict=True):
        a, b, c = _quadratic(values, is_crank=drive.is_crank)
        w = int(drive.is_crank)
        for t, value in zip(_CHECKS, values[3:], strict=False):
            if a * t * t + b * t + c != value * (1 + w * t * t):
                raise InputError(f"axis: {shown(axis)} does not move feet along a line or a circle; ask one that does")
        conditions.append((a - w * low**2, b, c - low**2))
        conditions.append((w * high**2 - a, -b, high**2 - c))
    return ranges_of(conditions, *stroke)


_TURNS: Final = tuple((Fraction(x, 5), Fraction(y, 5)) for x, y in ((5, 0), (0, 5), (-5, 0), (3, 4), (4, 3)))
"""Cosines and sines. The last two show whether the square of the length is linear in them."""
_CHECKS: Final = (Fraction(1, 2), Fraction(1, 3))
"""Half tangents of the last two."""
_WAYS: Final = (Fraction(0), Fraction(1), Fraction(-1))


def _quadratic(values: Sequence[Fraction], *, is_crank: bool) -> Quadratic:
    """Through values at 0, 1 and -1; or of 1 + t^2 times a function with these at 0, 90 and 180 degrees."""
    first, second, third = values[:3]
    if is_crank:
        return third, 2 * second - first - third, first
    return (second + third) / 2 - first, (second - third) / 2, first


def _squares(robot: Mechanism, drives: dict[str, JointValue], pose: tuple[Vector, Matrix]) -> list[Fraction]:
    """Of the lengths that the legs have at the pose."""
    values: list[JointValue] = [
        Fraction(1) if robot.drive(name) is None else _given(drives, name) for name in robot.actuated
    ]
    legs = [leg for leg in robot.locked(values, "others") if leg.name in robot.actuated and isinstance(leg, Distance)]
    return [distance_squared(leg.base, leg.platform, *pose, robot.metric) for leg in legs]


def _given(drives: dict[str, JointValue], name: str) -> JointValue:
    if name not in drives:
        raise InputError(f"others: no value of {shown(name)}; give one for every slide and crank but the axis")
    return drives[name]
