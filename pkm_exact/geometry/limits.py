"""Limits of a robot: how far its actuators reach, its passive joints turn, and its legs and platform may go.

What stands here is data, read and validated; ``poses.limit_checks`` compares poses with it.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Final, TypeAlias

from pkm_exact.constraints.form import Vector

Pair: TypeAlias = tuple[Fraction, Fraction]
"""Least and greatest value."""

NAMES: Final = ("lengths", "slides", "angles", "base_cones", "platform_cones", "leg_distance", "position")
"""The limits by the keys of model files, in the order of outputs."""


@dataclass(frozen=True)
class Cones:
    """How far the passive joints of one side turn: each leg lies in a cone about an axis.

    Attributes
    ----------
    axes : tuple of vectors of 3 Fraction, one per leg
        Of the base in the fixed frame, from the base joint; of the platform in its own frame, from the platform joint.
    angles : tuple of Fraction, one per leg
        Greatest angle between the leg, seen from the joint, and the axis, in degrees.
    """

    axes: tuple[Vector, ...]
    angles: tuple[Fraction, ...]


@dataclass(frozen=True)
class Limits:
    """The limits of a robot; None, or nothing, where there is none.

    Attributes
    ----------
    lengths, slides, angles : tuple of pairs of Fraction, one per actuator of that sort
        Least and greatest leg length, position of a slide (of a mechanism: offset), angle of a crank in degrees.
    base_cones, platform_cones : Cones or None
    leg_distance : Fraction or None
        Least distance between any two legs, as segments; legs that share a joint are not compared.
    position : tuple of 2 or 3 pairs of Fraction
        A box for the platform's origin, in the coordinates of the model.
    """

    lengths: tuple[Pair, ...] = ()
    slides: tuple[Pair, ...] = ()
    angles: tuple[Pair, ...] = ()
    base_cones: Cones | None = None
    platform_cones: Cones | None = None
    leg_distance: Fraction | None = None
    position: tuple[Pair, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """Which limits there are.

        Examples
        --------
        >>> Limits(leg_distance=Fraction(1)).names
        ('leg_distance',)
        """
        return tuple(name for name in NAMES if getattr(self, name) not in ((), None))
