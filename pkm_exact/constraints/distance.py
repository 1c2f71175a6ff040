"""A leg of known length: the distance between a base point and a platform point.

    |C + R B - A|^2 = l^2,  that is  |C|^2 + 2 B.u - 2 A.C - 2 A.(R B) + |A|^2 + |B|^2 - l^2 = 0

The sphere is a hyperplane on rigid motions (Gallet, Nawratil and Schicho, J. Geometry 106, 2015, section 2).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import lcm
from types import MappingProxyType
from typing import ClassVar

from pkm_exact.constraints.constraint import Linear, Role
from pkm_exact.constraints.form import Form, Vector, form, outer, scaled


@dataclass(frozen=True)
class _Joints:
    """What the form of a leg follows from, but for its length."""

    metric: tuple[int, int, int]
    base: Vector
    platform: Vector

    def __hash__(self) -> int:
        # To hash fractions takes time: where two numbers do not tell legs apart, comparing them does.
        return hash((self.base[0], self.platform[1]))


@lru_cache(maxsize=64)
def _form_of_joints(joints: _Joints) -> Form:
    """The form without the length: many robots differ in that alone."""
    metric, base, platform = joints.metric, joints.base, joints.platform
    values = (*base, *platform)
    if not all(type(value) is Fraction for value in values):  # knees may be sums of square roots
        squares = sum((g * (a * a + b * b) for g, a, b in zip(metric, base, platform, strict=True)), Fraction(0))
        coefficients = scaled(metric, platform, 2), scaled(metric, base, -2), outer(metric, base, platform, -2)
        return form(Fraction(1), *coefficients, squares)
    # In integers, over one denominator: far fewer fractions are reduced.
    unit = lcm(*(value.denominator for value in values))
    a, b = ([value.numerator * (unit // value.denominator) for value in side] for side in (base, platform))
    area = unit * unit
    return form(
        Fraction(1),
        [Fraction(2 * g * n, unit) for g, n in zip(metric, b, strict=True)],
        [Fraction(-2 * g * m, unit) for g, m in zip(metric, a, strict=True)],
        [Fraction(-2 * g * m * n, area) for g, m in zip(metric, a, strict=True) for n in b],
        Fraction(sum(g * (m * m + n * n) for g, m, n in zip(metric, a, b, strict=True)), area),
    )


@dataclass(frozen=True)
class Distance(Linear):
    """A leg of known length between base joint ``base`` and platform joint ``platform``.

    Attributes
    ----------
    base : tuple of 3 Fraction
        Joint centre A in the fixed frame.
    platform : tuple of 3 Fraction
        Joint centre B in the mobile frame.
    length_squared : Fraction
        Square of the distance between A and C + R B, in squared units of length.
    name : str
        Its label; may be empty.

    Examples
    --------
    >>> half, zero = Fraction(1, 2), Fraction(0)
    >>> [str(x) for x in Distance((half, zero, zero), (zero, zero, zero), Fraction(1)).forms((1, 1, 1))[0][::4]]
    ['1', '-1', '0', '0', '-3/4']
    """

    base: Vector
    platform: Vector
    length_squared: Fraction
    name: str = ""

    type: ClassVar[str] = "distance"
    title: ClassVar[str] = "distance of a platform point from a base point: |C + R B - A| = l"
    fields: ClassVar[Mapping[str, Role]] = MappingProxyType(
        {"base": Role.BASE_POINT, "platform": Role.PLATFORM_POINT, "length_squared": Role.POSITIVE}
    )
    value_field: ClassVar[str | None] = "length_squared"
    codimension: ClassVar[int] = 1

    def forms(self, metric: tuple[int, int, int]) -> tuple[Form, ...]:
        """The hyperplane of the leg."""
        without_length = _form_of_joints(_Joints(metric, self.base, self.platform))
        return ((*without_length[:-1], without_length[-1] - self.length_squared),)

    def scales(self, metric: tuple[int, int, int], length: Fraction) -> tuple[Fraction, ...]:  # noqa: ARG002
        """(2 l)^2: the row is then the derivative of the length."""
        return (4 * self.length_squared,)

    def mirrored(self) -> Distance:
        """The same leg, seen from the platform."""
        return Distance(self.platform, self.base, self.length_squared, self.name)
