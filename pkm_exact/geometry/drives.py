"""Actuators of a mechanism that move a part of a constraint: a carriage on a slide, the end of a crank, a turned plane.

A locked drive adds to fields of constraints what is linear in its value:

    slide    q d
    crank    c u + s v,    c = cos(angle),  s = sin(angle) / sqrt(w),  c^2 + w s^2 = 1

with vectors d, u and v where the field is a point or a direction, numbers where it is an offset. In the metric (1, 1,
1) the weight w is 1; where the ordinary y is sqrt(3) times the rational one, a crank turns in the plane with w = 3.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, Final, TypeAlias

from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import JointValue, cosine_and_sine, parse_cosine_and_sine
from pkm_exact.geometry.rational import MAX_COMPUTED_DIGITS, bounded, parse_rational
from pkm_exact.wording import shown

Axis: TypeAlias = Vector | Fraction
"""What one unit of a value adds to a field."""

STRAIGHT: Final = 0
"""The weight of a drive that does not turn."""


@dataclass(frozen=True)
class Part:
    """A field of a constraint that a drive moves.

    Attributes
    ----------
    constraint : str
        Its name.
    field : str
        A point, a direction or a number.
    axes : tuple
        d of a slide; u and v of a crank.
    """

    constraint: str
    field: str
    axes: tuple[Axis, ...]

    def added(self, constraint: Constraint, coefficients: Sequence[Fraction], where: str) -> Constraint:
        """The constraint with what the drive adds to the field."""
        changed: Any = constraint
        old: Any = getattr(constraint, self.field)
        axes: Any = self.axes
        if isinstance(old, Fraction):
            new: Any = _sum(old, coefficients, axes, where)
        else:
            new = tuple(_sum(first, coefficients, rest, where) for first, *rest in zip(old, *axes, strict=True))
        found: Constraint = replace(changed, **{self.field: new})
        return found


@dataclass(frozen=True)
class Drive:
    """An actuator that moves parts of constraints.

    Attributes
    ----------
    name : str
        How configurations and tables call it.
    parts : tuple of Part
        What it moves; inverse kinematics is that of the first.
    weight : int
        w of a crank; ``STRAIGHT`` for a slide.

    Examples
    --------
    >>> from pkm_exact.constraints.distance import Distance
    >>> zero, one = Fraction(0), Fraction(1)
    >>> rod = Distance((zero,) * 3, (zero,) * 3, one, "rod")
    >>> slide = Drive("slide", (Part("rod", "base", ((zero, zero, one),)),))
    >>> [str(x) for x in slide.moved({"rod": rod}, Fraction(3, 2), "here")["rod"].base]
    ['0', '0', '3/2']
    """

    name: str
    parts: tuple[Part, ...]
    weight: int = STRAIGHT

    @property
    def is_crank(self) -> bool:
        """Whether its value is an angle, given as cosine and sine."""
        return self.weight != STRAIGHT

    def parsed(self, value: object, where: str) -> JointValue:
        """The value of a locked drive, exactly: a number, or cosine and sine of a crank."""
        if self.is_crank:
            return parse_cosine_and_sine(value, where, self.weight)
        if isinstance(value, tuple | list):
            raise InputError(f"{where}: {shown(value)} is no number; give a slide's position as one number")
        return parse_rational(value, where)

    def from_number(self, number: Fraction) -> JointValue:
        """The value for one number as users give it: of a crank the half tangent, divided by sqrt(w)."""
        return cosine_and_sine(number, self.weight) if self.is_crank else number

    def recovered(self, before: Constraint, after: Constraint) -> JointValue | None:
        """The value that makes the first part of one constraint another one; None if there is none.

        Examples
        --------
        >>> from pkm_exact.constraints.distance import Distance
        >>> zero, one = Fraction(0), Fraction(1)
        >>> rod = Distance((zero,) * 3, (zero,) * 3, one, "rod")
        >>> crank = Drive("crank", (Part("rod", "base", ((one, zero, zero), (zero, zero, one))),), weight=1)
        >>> value = crank.parsed(("3/5", "4/5"), "here")
        >>> crank.recovered(rod, crank.moved({"rod": rod}, value, "here")["rod"]) == value
        True
        """
        part = self.parts[0]
        old, new = (_numbers(getattr(found, part.field, None)) for found in (before, after))
        if len(old) != len(new):
            return None
        axes = [_numbers(axis) for axis in part.axes]
        gained = [b - a for a, b in zip(old, new, strict=True)]
        if not self.is_crank:
            return next((total / step for total, step in zip(gained, axes[0], strict=True) if step), None)
        u, v = axes
        for i in range(len(gained)):
            for j in range(i):
                minor = u[i] * v[j] - u[j] * v[i]
                if minor:
                    first = (gained[i] * v[j] - gained[j] * v[i]) / minor
                    second = (u[i] * gained[j] - u[j] * gained[i]) / minor
                    return (first, second) if first**2 + self.weight * second**2 == 1 else None
        return None

    def moved(self, constraints: Mapping[str, Constraint], value: JointValue, where: str) -> dict[str, Constraint]:
        """All constraints, by their names, once the drive is locked at a value."""
        changed = dict(constraints)
        for part in self.parts:
            changed[part.constraint] = part.added(changed[part.constraint], coefficients(value), where)
        return changed


def coefficients(value: JointValue) -> tuple[Fraction, ...]:
    """By what the axes of a drive are multiplied."""
    return value if isinstance(value, tuple) else (value,)


def _sum(start: Fraction, factors: Sequence[Fraction], summands: Sequence[Fraction], where: str) -> Fraction:
    total = start + sum((k * x for k, x in zip(factors, summands, strict=True)), Fraction(0))
    return bounded(total, total, where, MAX_COMPUTED_DIGITS)


def _numbers(field: Any) -> tuple[Fraction, ...]:
    """A number or a vector as a tuple."""
    return (field,) if isinstance(field, Fraction) else tuple(field or ())
