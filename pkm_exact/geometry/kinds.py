"""Kinds of robot. A kind is a recipe: it turns joints and joint values into the constraints on the platform's pose.

Every kind ends in legs of known length between a base joint and a platform joint: six, or three if the platform moves
in a plane. Where the actuators are cranks or slides (``geometry.chains``), the legs are the rods, and the base joints
are the knees.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import Final, TypeAlias

from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.chains import Chain, Crank, JointValue, Slide
from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import PLANAR, SPATIAL

Joints: TypeAlias = tuple[Vector, ...]


@dataclass(frozen=True)
class Kind:
    """What the legs of a robot are made of.

    Attributes
    ----------
    description : str
        In a few words.
    chain : type or None
        Class of the actuated chains; None if the legs themselves are actuated.
    chain_table : str
        The table of a model file that describes the chains; empty if there are none.
    joint_keys : tuple of str
        The keys that give joint values in a configuration.
    gough : str
        The kind with the same number of legs whose legs themselves are actuated.
    motion : Motion
        What the platform is capable of.
    """

    description: str
    chain: type[Crank] | type[Slide] | None
    chain_table: str
    joint_keys: tuple[str, ...]
    gough: str = "6-UPS"
    motion: Motion = SPATIAL

    @property
    def dimension(self) -> int:
        """Number of coordinates of a joint: 3, or 2 if the robot is planar."""
        return 2 if self.motion.is_planar else 3

    @property
    def legs(self) -> int:
        """How many legs a robot of this kind has: as many as its platform has freedoms."""
        return self.motion.dimension


_LEG_KEYS: Final = ("lengths", "lengths_squared", "pose")
_CRANK_KEYS: Final = ("half_tangents", "cos_sin", "degrees")
_SLIDE_KEYS: Final = ("slides",)

KINDS: Final[Mapping[str, Kind]] = MappingProxyType(
    {
        "6-UPS": Kind("six legs of actuated length", None, "", _LEG_KEYS),
        "6-RUS": Kind("six rods of fixed length on cranks", Crank, "cranks", _CRANK_KEYS),
        "6-PUS": Kind("six rods of fixed length on slides", Slide, "slides", _SLIDE_KEYS),
        "3-RPR": Kind("planar: three legs of actuated length", None, "", _LEG_KEYS, "3-RPR", PLANAR),
        "3-RRR": Kind("planar: three rods of fixed length on cranks", Crank, "cranks", _CRANK_KEYS, "3-RPR", PLANAR),
        "3-PRR": Kind("planar: three rods of fixed length on slides", Slide, "slides", _SLIDE_KEYS, "3-RPR", PLANAR),
    }
)
"""The kinds by the names used in model files."""


def gough_legs(base: Joints, platform: Joints, lengths_squared: tuple[Fraction, ...]) -> tuple[Distance, ...]:
    """The legs of a 6-UPS robot (Gough platform) or a 3-RPR one: leg i joins the joints i, its length is actuated."""
    return tuple(Distance(*leg) for leg in zip(base, platform, lengths_squared, strict=True))


def knees(base: Joints, chains: tuple[Chain, ...], values: tuple[JointValue, ...]) -> Joints:
    """Where the actuators put the lower ends of the rods.

    Examples
    --------
    >>> zero = (Fraction(0),) * 3
    >>> [str(x) for x in knees((zero,), (Slide((0, 0, 1), 1),), (Fraction(2),))[0]]
    ['0', '0', '2']
    """
    return tuple(chain.knee(joint, value) for joint, chain, value in zip(base, chains, values, strict=True))
