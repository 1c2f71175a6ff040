"""A point of one body in a plane of the other: two types of constraints that mirror each other.

A platform point in a plane of the base: n.(C + R B) = d. A base point in a plane of the platform:
m.R^-1 (A - C) = d, that is  A.(R m) - m.u = d.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import ClassVar

from pkm_exact.constraints.constraint import Linear, Role
from pkm_exact.constraints.form import Form, Vector, form, outer, scaled


@dataclass(frozen=True)
class InPlane(Linear):
    """A platform point that stays in a plane of the base.

    Attributes
    ----------
    normal : tuple of 3 Fraction
        n, not 0, in the fixed frame.
    offset : Fraction
        d.
    platform : tuple of 3 Fraction
        B, in the mobile frame.
    name : str
        Its label; may be empty.

    Examples
    --------
    >>> zero, one = Fraction(0), Fraction(1)
    >>> [str(x) for x in InPlane((zero, zero, one), Fraction(2), (one, zero, zero)).forms((1, 1, 1))[0][6:]]
    ['1', '0', '0', '0', '0', '0', '0', '1', '0', '0', '-2']
    """

    normal: Vector
    offset: Fraction
    platform: Vector
    name: str = ""

    type: ClassVar[str] = "in-plane"
    title: ClassVar[str] = "platform point in a plane of the base: n.(C + R B) = d"
    fields: ClassVar[Mapping[str, Role]] = MappingProxyType(
        {"normal": Role.BASE_DIRECTION, "offset": Role.NUMBER, "platform": Role.PLATFORM_POINT}
    )
    value_field: ClassVar[str | None] = "offset"
    codimension: ClassVar[int] = 1

    def forms(self, metric: tuple[int, int, int]) -> tuple[Form, ...]:
        """The hyperplane."""
        return (
            form(
                position=scaled(metric, self.normal),
                rotation=outer(metric, self.normal, self.platform),
                constant=-self.offset,
            ),
        )

    def mirrored(self) -> Carries:
        """A base point in a plane of the platform."""
        return Carries(self.normal, self.offset, self.platform, self.name)


@dataclass(frozen=True)
class Carries(Linear):
    """A plane of the platform that carries a point of the base.

    Attributes
    ----------
    normal : tuple of 3 Fraction
        m, not 0, in the mobile frame.
    offset : Fraction
        d.
    base : tuple of 3 Fraction
        A, in the fixed frame.
    name : str
        Its label; may be empty.

    Examples
    --------
    >>> zero, one = Fraction(0), Fraction(1)
    >>> [str(x) for x in Carries((zero, zero, one), Fraction(2), (one, zero, zero)).forms((1, 1, 1))[0][3:10]]
    ['-1', '0', '0', '0', '0', '0', '1']
    """

    normal: Vector
    offset: Fraction
    base: Vector
    name: str = ""

    type: ClassVar[str] = "carries"
    title: ClassVar[str] = "base point in a plane of the platform: m.R^-1 (A - C) = d"
    fields: ClassVar[Mapping[str, Role]] = MappingProxyType(
        {"normal": Role.PLATFORM_DIRECTION, "offset": Role.NUMBER, "base": Role.BASE_POINT}
    )
    value_field: ClassVar[str | None] = "offset"
    codimension: ClassVar[int] = 1

    def forms(self, metric: tuple[int, int, int]) -> tuple[Form, ...]:
        """The hyperplane."""
        return (
            form(
                turned=scaled(metric, self.normal, -1),
                rotation=outer(metric, self.base, self.normal),
                constant=-self.offset,
            ),
        )

    def mirrored(self) -> InPlane:
        """A platform point in a plane of the base."""
        return InPlane(self.normal, self.offset, self.base, self.name)
