"""A fixed angle between a direction of the base and one of the platform: n.(R m) = c."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import ClassVar

from pkm_exact.constraints.constraint import Linear, Role
from pkm_exact.constraints.form import Form, Vector, form, outer


@dataclass(frozen=True)
class Angle(Linear):
    """Two directions, one of the base and one of the platform, whose product is known.

    Attributes
    ----------
    base, platform : tuple of 3 Fraction
        n and m, not 0, of any length.
    product : Fraction
        c; the cosine of the angle, if both directions have length 1.
    name : str
        Its label; may be empty.

    Examples
    --------
    >>> zero, one = Fraction(0), Fraction(1)
    >>> [str(x) for x in Angle((zero, zero, one), (one, zero, zero), Fraction(1, 2)).forms((1, 1, 1))[0][13:]]
    ['1', '0', '0', '-1/2']
    """

    base: Vector
    platform: Vector
    product: Fraction
    name: str = ""

    type: ClassVar[str] = "angle"
    title: ClassVar[str] = "product of a direction of the base and one of the platform: n.(R m) = c"
    fields: ClassVar[Mapping[str, Role]] = MappingProxyType(
        {"base": Role.BASE_DIRECTION, "platform": Role.PLATFORM_DIRECTION, "product": Role.NUMBER}
    )
    value_field: ClassVar[str | None] = "product"
    codimension: ClassVar[int] = 1

    def forms(self, metric: tuple[int, int, int]) -> tuple[Form, ...]:
        """The hyperplane."""
        return (form(rotation=outer(metric, self.base, self.platform), constant=-self.product),)

    def mirrored(self) -> Angle:
        """The same angle, seen from the platform."""
        return Angle(self.platform, self.base, self.product, self.name)
