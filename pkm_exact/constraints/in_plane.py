"""A platform point in a plane of the base: n.(C + R B) = d."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import TYPE_CHECKING, ClassVar

from pkm_exact.constraints.constraint import Linear, Role
from pkm_exact.constraints.form import Form, Vector, form, outer, scaled

if TYPE_CHECKING:
    from pkm_exact.constraints.carries import Carries


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
        from pkm_exact.constraints.carries import Carries

        return Carries(self.normal, self.offset, self.platform, self.name)
