"""Kinds of robot. A kind is a recipe: it turns joints and joint values into the constraints on the platform's pose."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from types import MappingProxyType
from typing import Final, TypeAlias

from pkm_exact.geometry.problem import Leg, Vector

Joints: TypeAlias = tuple[Vector, ...]
Recipe: TypeAlias = Callable[[Joints, Joints, tuple[Fraction, ...]], tuple[Leg, ...]]


def gough_legs(base: Joints, platform: Joints, lengths_squared: tuple[Fraction, ...]) -> tuple[Leg, ...]:
    """The legs of a 6-UPS robot (Gough platform): leg i joins the joints i, its length is actuated."""
    return tuple(Leg(a, b, square) for a, b, square in zip(base, platform, lengths_squared, strict=True))


KINDS: Final[Mapping[str, Recipe]] = MappingProxyType({"6-UPS": gough_legs})
"""Recipe of each kind, by the name used in model files."""
