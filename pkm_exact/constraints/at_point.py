"""A platform point at a base point: C + R B = X, three planes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import ClassVar

from pkm_exact.constraints.constraint import Linear, Role
from pkm_exact.constraints.form import Form, Vector
from pkm_exact.constraints.point_in_plane import InPlane


@dataclass(frozen=True)
class AtPoint(Linear):
    """A ball joint: a platform point that stays at a base point.

    Attributes
    ----------
    point : tuple of 3 Fraction
        X, in the fixed frame.
    platform : tuple of 3 Fraction
        B, in the mobile frame.
    name : str
        Its label; may be empty.

    Examples
    --------
    >>> zero, one = Fraction(0), Fraction(1)
    >>> len(AtPoint((one, zero, zero), (zero, zero, one)).forms((1, 1, 1)))
    3
    """

    point: Vector
    platform: Vector
    name: str = ""

    type: ClassVar[str] = "at-point"
    title: ClassVar[str] = "platform point at a base point: C + R B = X"
    fields: ClassVar[Mapping[str, Role]] = MappingProxyType({"point": Role.BASE_POINT, "platform": Role.PLATFORM_POINT})
    value_field: ClassVar[str | None] = None
    codimension: ClassVar[int] = 3

    def forms(self, metric: tuple[int, int, int]) -> tuple[Form, ...]:
        """The planes through the point along the axes of coordinates."""
        zero, one = Fraction(0), Fraction(1)
        axes = ((one, zero, zero), (zero, one, zero), (zero, zero, one))
        planes = (InPlane(n, g * x, self.platform) for n, g, x in zip(axes, metric, self.point, strict=True))
        return tuple(found for plane in planes for found in plane.forms(metric))

    def mirrored(self) -> AtPoint:
        """The same joint, seen from the platform."""
        return AtPoint(self.platform, self.point, self.name)
