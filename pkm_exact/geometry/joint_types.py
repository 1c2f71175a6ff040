"""The types of joints of a mechanism of bodies: which one-freedom joints, in order, each is. One row adds a type.

A joint is the product of turns, slides and screws, from the first body to the second: a universal joint of two turns, a
cylindrical one of a turn and a slide, a spherical one of three turns about the coordinate axes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import Final, TypeAlias

from pkm_exact.constraints.form import Vector

SixCoordinates: TypeAlias = tuple[Fraction, ...]
"""A twist (w; v): angular velocity, and velocity of the body's point at the origin."""

_ZERO: Final = (Fraction(0),) * 3
_AXES: Final[tuple[Vector, ...]] = (
    (Fraction(1), Fraction(0), Fraction(0)),
    (Fraction(0), Fraction(1), Fraction(0)),
    (Fraction(0), Fraction(0), Fraction(1)),
)


@dataclass(frozen=True)
class JointGeometry:
    """Where a joint is, in the coordinates of the base: what of it its type needs."""

    point: Vector = _ZERO
    axes: tuple[Vector, ...] = ()
    pitch: Fraction = Fraction(0)
    screws: tuple[SixCoordinates, ...] = ()


@dataclass(frozen=True)
class JointType:
    """A type of joint.

    Attributes
    ----------
    name : str
        As model files name it.
    title : str
    fields : tuple of str
        Keys of its table besides name, type, bodies and actuated.
    axes : int
        How many axes it has.
    twists : callable
        The twists of its one-freedom joints, in their order.
    """

    name: str
    title: str
    fields: tuple[str, ...]
    axes: int
    twists: Callable[[JointGeometry], tuple[SixCoordinates, ...]]


def _turn(point: Vector, axis: Vector, pitch: Fraction = Fraction(0)) -> SixCoordinates:
    (x, y, z), (a, b, c) = point, axis
    return (a, b, c, y * c - z * b + pitch * a, z * a - x * c + pitch * b, x * b - y * a + pitch * c)


def _slide(axis: Vector) -> SixCoordinates:
    return (*_ZERO, *axis)


JOINT_TYPES: Final[Mapping[str, JointType]] = MappingProxyType(
    {
        joint.name: joint
        for joint in (
            JointType("R", "revolute", ("point", "axis"), 1, lambda g: (_turn(g.point, g.axes[0]),)),
            JointType("P", "prismatic", ("axis",), 1, lambda g: (_slide(g.axes[0]),)),
            JointType("H", "helical", ("point", "axis", "pitch"), 1, lambda g: (_turn(g.point, g.axes[0], g.pitch),)),
            JointType(
                "C", "cylindrical", ("point", "axis"), 1, lambda g: (_turn(g.point, g.axes[0]), _slide(g.axes[0]))
            ),
            JointType("U", "universal", ("point", "axes"), 2, lambda g: tuple(_turn(g.point, a) for a in g.axes)),
            JointType("S", "spherical", ("point",), 0, lambda g: tuple(_turn(g.point, a) for a in _AXES)),
            JointType("screw", "product of any screws", ("screws",), 0, lambda g: g.screws),
        )
    }
)
"""By name."""
