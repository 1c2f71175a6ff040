"""A platform point on a line of the base: two planes through the line."""

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
class OnLine(Linear):
    """A platform point that stays on a line of the base.

    Attributes
    ----------
    point, direction : tuple of 3 Fraction
        X and v of the line X + t v, in the fixed frame; v not 0.
    platform : tuple of 3 Fraction
        B, in the mobile frame.
    name : str
        Its label; may be empty.

    Examples
    --------
    >>> zero, one = Fraction(0), Fraction(1)
    >>> [plane.normal[2] for plane in OnLine((zero,) * 3, (zero, zero, one), (one, zero, zero)).planes((1, 1, 1))]
    [Fraction(0, 1), Fraction(0, 1)]
    """

    point: Vector
    direction: Vector
    platform: Vector
    name: str = ""

    type: ClassVar[str] = "on-line"
    title: ClassVar[str] = "platform point on a line of the base: C + R B = X + t v"
    fields: ClassVar[Mapping[str, Role]] = MappingProxyType(
        {"point": Role.BASE_POINT, "direction": Role.BASE_DIRECTION, "platform": Role.PLATFORM_POINT}
    )
    value_field: ClassVar[str | None] = None
    codimension: ClassVar[int] = 2

    def planes(self, metric: tuple[int, int, int]) -> tuple[InPlane, InPlane]:
        """Two planes through the line, both along an axis of coordinates on which the direction is largest."""
        v = self.direction
        k = max(range(3), key=lambda axis: (metric[axis] * v[axis] ** 2, -axis))
        found = []
        for i in ((k + 1) % 3, (k + 2) % 3):
            normal = [Fraction(0)] * 3
            normal[i], normal[k] = v[k] / metric[i], -v[i] / metric[k]
            offset = sum((g * n * x for g, n, x in zip(metric, normal, self.point, strict=True)), Fraction(0))
            found.append(InPlane((normal[0], normal[1], normal[2]), offset, self.platform))
        return found[0], found[1]

    def forms(self, metric: tuple[int, int, int]) -> tuple[Form, ...]:
        """The two planes."""
        return tuple(found for plane in self.planes(metric) for found in plane.forms(metric))

    def mirrored(self) -> None:
        """No type says that a line of the platform passes through a base point."""
