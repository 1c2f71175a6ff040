"""Kinds of robot. A kind is a recipe: it turns joints and joint values into the constraints on the platform's pose.

Every kind ends in six legs of known length between a base joint and a platform joint. Where the actuators are cranks
or slides (``geometry.chains``), the legs are the rods, and the base joints are the knees.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import Final, TypeAlias

from pkm_exact.geometry.chains import Chain, Crank, JointValue, Slide
from pkm_exact.geometry.problem import Leg, Vector

Joints: TypeAlias = tuple[Vector, ...]


@dataclass(frozen=True)
class Kind:
    """What the legs of a robot are made of.

    Attributes
    ----------
    chain : type or None
        Class of the actuated chains; None if the legs themselves are actuated.
    chain_table : str
        The table of a model file that describes the chains; empty if there are none.
    joint_keys : tuple of str
        The keys that give joint values in a configuration.
    """

    chain: type[Crank] | type[Slide] | None
    chain_table: str
    joint_keys: tuple[str, ...]


KINDS: Final[Mapping[str, Kind]] = MappingProxyType(
    {
        "6-UPS": Kind(None, "", ("lengths", "lengths_squared", "pose")),
        "6-RUS": Kind(Crank, "cranks", ("half_tangents", "cos_sin")),
        "6-PUS": Kind(Slide, "slides", ("slides",)),
    }
)
"""The kinds by the names used in model files."""


def gough_legs(base: Joints, platform: Joints, lengths_squared: tuple[Fraction, ...]) -> tuple[Leg, ...]:
    """The legs of a 6-UPS robot (Gough platform): leg i joins the joints i, its length is actuated."""
    return tuple(Leg(a, b, square) for a, b, square in zip(base, platform, lengths_squared, strict=True))


def knees(base: Joints, chains: tuple[Chain, ...], values: tuple[JointValue, ...]) -> Joints:
    """Where the actuators put the lower ends of the rods.

    Examples
    --------
    >>> zero = (Fraction(0),) * 3
    >>> [str(x) for x in knees((zero,), (Slide((0, 0, 1), 1),), (Fraction(2),))[0]]
    ['0', '0', '2']
    """
    return tuple(chain.knee(joint, value) for joint, chain, value in zip(base, chains, values, strict=True))
