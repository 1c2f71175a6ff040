"""Velocities and accelerations of rods between slides and a platform, exactly.

A rod of constant length goes from a slider at b + s u to the platform's joint h + R p. With l the vector along it and w
its derivative the slider follows from l.w = 0, and the rod, which does not spin about itself, turns by l x w / l^2
(equations 29 and 41 of chapter 12 of *Parallel Manipulators* (2008), corrected: the slider's acceleration is the second
derivative of s).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import fmpq_mat

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.screws.exact_matrix import flint_matrix, rows_of
from pkm_exact.screws.screw import cross


@dataclass(frozen=True)
class PlatformMotion:
    """How a platform moves at an instant, in one unit of length.

    Attributes
    ----------
    velocity, turning : Vector
        Of its origin, and its angular velocity.
    acceleration, turning_acceleration : Vector
        Their derivatives.
    """

    velocity: Vector
    turning: Vector
    acceleration: Vector
    turning_acceleration: Vector


@dataclass(frozen=True)
class RodMotion:
    """How a rod and its slider move.

    Attributes
    ----------
    speed, acceleration : Fraction
        First and second derivative of the slider's position, per unit of its direction.
    turning, turning_acceleration : Vector
        Angular velocity of the rod, and its derivative.
    """

    speed: Fraction
    acceleration: Fraction
    turning: Vector
    turning_acceleration: Vector


def rod_motion(motion: PlatformMotion, joint: Vector, rod: Vector, direction: Vector) -> RodMotion:
    """What a motion of the platform asks of a slider and its rod.

    Parameters
    ----------
    motion : PlatformMotion
    joint : Vector
        R p: the platform's joint from the platform's origin, in the base's directions.
    rod : Vector
        From the slider to the joint, not 0; ordinary coordinates.
    direction : Vector
        Of the slide; its length is the way per unit of the slider's position.

    Raises
    ------
    InputError
        If the rod is perpendicular to the slide: the slider's speed is then not determined.

    Examples
    --------
    >>> x, z, no = (Fraction(1), Fraction(0), Fraction(0)), (Fraction(0), Fraction(0), Fraction(1)), (Fraction(0),) * 3
    >>> found = rod_motion(PlatformMotion(x, no, no, no), no, (Fraction(3), Fraction(0), Fraction(4)), z)
    >>> print(found.speed, found.acceleration, *found.turning)
    3/4 25/64 0 1/4 0
    """
    along = _dot(rod, direction)
    if along == 0:
        raise InputError("rod: perpendicular to its slide, so that the slider's speed is not determined; move the pose")
    lever = cross(motion.turning, joint)
    velocity = _plus(motion.velocity, lever)
    speed = _dot(rod, velocity) / along
    change = _plus(velocity, direction, -speed)
    free = _plus(motion.acceleration, cross(motion.turning_acceleration, joint))
    free = _plus(free, cross(motion.turning, lever))
    acceleration = (_dot(rod, free) + _dot(change, change)) / along
    second = _plus(free, direction, -acceleration)
    square = _dot(rod, rod)
    turning, faster = (_scaled(cross(rod, x), 1 / square) for x in (change, second))
    return RodMotion(speed, acceleration, turning, faster)


@dataclass(frozen=True)
class PlacedRod:
    """A rod at a pose.

    Attributes
    ----------
    joint : Vector
        R p: what turns with the platform between its origin and the rod, in the base's directions.
    rod : Vector
        From the slider to the joint.
    direction : Vector
        Of the slide.
    """

    joint: Vector
    rod: Vector
    direction: Vector


def platform_motion(
    rods: Sequence[PlacedRod],
    speeds: Sequence[Fraction],
    accelerations: Sequence[Fraction],
    turning: Sequence[Vector],
) -> PlatformMotion:
    """How a platform moves when its sliders do, the terms of second order in the speeds included.

    Parameters
    ----------
    rods : sequence of PlacedRod
        As many as freedoms.
    speeds, accelerations : sequence of Fraction
        First and second derivatives of the sliders' positions.
    turning : sequence of Vector
        Directions about which the platform can turn: none, one, or three that are independent.

    Raises
    ------
    InputError
        If there are not as many rods as freedoms, or the pose is singular.

    Examples
    --------
    >>> e = [tuple(map(Fraction, v)) for v in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    >>> rods = [PlacedRod((Fraction(0),) * 3, axis, axis) for axis in e]
    >>> found = platform_motion(rods, [Fraction(2), Fraction(0), Fraction(0)], [Fraction(1)] * 3, [])
    >>> [str(x) for x in (*found.velocity, *found.acceleration)]
    ['2', '0', '0', '1', '-3', '-3']
    """
    if len(turning) not in (0, 1, 3) or not len(rods) == len(speeds) == len(accelerations) == 3 + len(turning):
        raise InputError(
            f"rods: {len(rods)}, with {len(speeds)} speeds, {len(accelerations)} accelerations and {len(turning)}"
            " directions to turn about; give none, one or three of these, and three of the others more"
        )
    matrix = flint_matrix([(*r.rod, *(_dot(r.rod, cross(axis, r.joint)) for axis in turning)) for r in rods], len(rods))
    if matrix.det() == 0:
        raise InputError("rods: singular here, so that the sliders do not determine the motion; move the pose")
    inverse = matrix.inv()
    first = [_dot(r.rod, r.direction) * speed for r, speed in zip(rods, speeds, strict=True)]
    velocity, omega = _split(inverse * flint_matrix([[x] for x in first], 1), turning)
    second = []
    for r, speed, acceleration in zip(rods, speeds, accelerations, strict=True):
        lever = cross(omega, r.joint)
        change = _plus(_plus(velocity, lever), r.direction, -speed)
        inward = cross(omega, lever)
        second.append(_dot(r.rod, r.direction) * acceleration - _dot(r.rod, inward) - _dot(change, change))
    return PlatformMotion(velocity, omega, *_split(inverse * flint_matrix([[x] for x in second], 1), turning))


def _split(column: fmpq_mat, turning: Sequence[Vector]) -> tuple[Vector, Vector]:
    """A velocity, and the combination of directions."""
    x, y, z, *rates = (row[0] for row in rows_of(column))
    turned: Vector = (Fraction(0), Fraction(0), Fraction(0))
    for rate, axis in zip(rates, turning, strict=True):
        turned = _plus(turned, axis, rate)
    return (x, y, z), turned


def _dot(u: Vector, v: Vector) -> Fraction:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def _plus(u: Vector, v: Vector, factor: Fraction | int = 1) -> Vector:
    return (u[0] + factor * v[0], u[1] + factor * v[1], u[2] + factor * v[2])


def _scaled(u: Vector, factor: Fraction) -> Vector:
    return (factor * u[0], factor * u[1], factor * u[2])
