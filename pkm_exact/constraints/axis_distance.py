"""A platform point at a known distance from an axis of the base: a cylinder, and no hyperplane.

With P = C + R B and the line X + t v:   |P - X|^2 - (v.(P - X))^2 / |v|^2 = r^2,  a linear form minus a square.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import ClassVar

from pkm_exact.constraints.constraint import Role, SquareForm
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Form, Vector
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.radicals import RootSum


@dataclass(frozen=True)
class AxisDistance:
    """A platform point on a cylinder about an axis of the base.

    Attributes
    ----------
    point, direction : tuple of 3 Fraction
        X and v of the axis X + t v, in the fixed frame; v not 0.
    platform : tuple of 3 Fraction
        B, in the mobile frame.
    radius_squared : Fraction
        r^2, positive.
    name : str
        Its label; may be empty.

    Examples
    --------
    >>> zero, one = Fraction(0), Fraction(1)
    >>> cylinder = AxisDistance((zero,) * 3, (zero, zero, Fraction(2)), (one, zero, zero), one)
    >>> len(cylinder.forms((1, 1, 1))), cylinder.squares((1, 1, 1))[0].factor
    (0, Fraction(1, 4))
    """

    point: Vector
    direction: Vector
    platform: Vector
    radius_squared: Fraction
    name: str = ""

    type: ClassVar[str] = "axis-distance"
    title: ClassVar[str] = "distance of a platform point from an axis of the base"
    fields: ClassVar[Mapping[str, Role]] = MappingProxyType(
        {
            "point": Role.BASE_POINT,
            "direction": Role.BASE_DIRECTION,
            "platform": Role.PLATFORM_POINT,
            "radius_squared": Role.POSITIVE,
        }
    )
    value_field: ClassVar[str | None] = "radius_squared"
    codimension: ClassVar[int] = 1

    def forms(self, metric: tuple[int, int, int]) -> tuple[Form, ...]:  # noqa: ARG002 - other types need it
        """None: a cylinder is no hyperplane."""
        return ()

    def squares(self, metric: tuple[int, int, int]) -> tuple[SquareForm, ...]:
        """The sphere about X, less the square of the part along the axis."""
        v = self.direction
        along = sum((g * x * n for g, x, n in zip(metric, self.point, v, strict=True)), Fraction(0))
        norm = sum((g * n * n for g, n in zip(metric, v, strict=True)), Fraction(0))
        sphere = Distance(self.point, self.platform, self.radius_squared).forms(metric)[0]
        plane = InPlane(v, along, self.platform).forms(metric)[0]
        # Of a direction in square roots that is turned, the norm is rational.
        norm = norm if isinstance(norm, Fraction) else RootSum.of(norm).rational or norm
        return (SquareForm(sphere, plane, 1 / norm),)

    def scales(self, metric: tuple[int, int, int], length: Fraction) -> tuple[Fraction, ...]:  # noqa: ARG002
        """(2 r)^2: the row is then the derivative of the distance."""
        return (4 * self.radius_squared,)

    def mirrored(self) -> None:
        """No type says that a base point keeps its distance from an axis of the platform."""
