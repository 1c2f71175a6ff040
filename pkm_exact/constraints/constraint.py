"""The interface that every type of constraint offers."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from typing import ClassVar, Protocol, Self

from pkm_exact.constraints.form import Form, integral, scale


class Role(StrEnum):
    """What a field of a constraint is, so that readers, checkers of input and pictures need not know its type."""

    BASE_POINT = "base point"
    BASE_DIRECTION = "base direction"
    PLATFORM_POINT = "platform point"
    PLATFORM_DIRECTION = "platform direction"
    NUMBER = "number"
    POSITIVE = "positive number"
    COEFFICIENTS = "17 coefficients"


@dataclass(frozen=True)
class SquareForm:
    """A quadric on rigid motions: it vanishes where linear = factor * root^2.

    Attributes
    ----------
    linear, root : Form
    factor : Fraction
        Positive.
    """

    linear: Form
    root: Form
    factor: Fraction

    def over_integers(self) -> tuple[tuple[int, ...], tuple[int, ...], int, int]:
        """Integers L, M, a and b for which it vanishes where a L = b M^2.

        Examples
        --------
        >>> half, zero = Fraction(1, 2), Fraction(0)
        >>> SquareForm((half, *[zero] * 16), (zero, *[half] * 16), Fraction(3)).over_integers()[2:]
        (2, 3)
        """
        linear, root = integral(self.linear), integral(self.root)
        scale, root_scale = (
            next((m / v for m, v in zip(multiple, form, strict=True) if v), Fraction(1))
            for multiple, form in ((linear, self.linear), (root, self.root))
        )
        ratio = self.factor * scale / root_scale**2
        return linear, root, ratio.denominator, ratio.numerator


class Constraint(Protocol):
    """A condition on the pose of the platform: some linear forms, or a quadric, that vanish.

    A class with these members, in a module of its own, and one row in ``constraints.constraint_types`` make a type.
    """

    type: ClassVar[str]
    """As model files and certificates name it."""
    title: ClassVar[str]
    """What it asks, in words, with its equation."""
    fields: ClassVar[Mapping[str, Role]]
    """The geometric fields and their roles, in the order of files."""
    value_field: ClassVar[str | None]
    """The field that an actuator sets; None if the type has none."""
    codimension: ClassVar[int]
    """How many freedoms it takes in general."""

    @property
    def name(self) -> str:
        """How messages and tables call it."""
        ...

    def forms(self, metric: tuple[int, int, int]) -> tuple[Form, ...]:
        """The linear forms that vanish at the poses that it admits."""
        ...

    def squares(self, metric: tuple[int, int, int]) -> tuple[SquareForm, ...]:
        """The quadrics that vanish there; of all types but the cylinder none."""
        ...

    def scales(self, metric: tuple[int, int, int], length: Fraction) -> tuple[Fraction, ...]:
        """For each form, then each quadric, the square of what its wrench is divided by to become a row of a Jacobian.

        Rows are then free of units and of the size of coefficients, for a length that measures turns.
        """
        ...

    def mirrored(self) -> Self | Constraint | None:
        """What it is when base and platform are exchanged; None if no type says that."""
        ...


class Linear(ABC):
    """What constraints that are linear forms share."""

    @abstractmethod
    def forms(self, metric: tuple[int, int, int]) -> tuple[Form, ...]:
        """The forms; every type has its own."""

    def squares(self, metric: tuple[int, int, int]) -> tuple[SquareForm, ...]:  # noqa: ARG002 - those of others use it
        """None: the constraint is linear."""
        return ()

    def scales(self, metric: tuple[int, int, int], length: Fraction) -> tuple[Fraction, ...]:
        """What the coefficients of each form tell (``form.scale``): of planes, the length of the normal."""
        return tuple(scale(form, metric, length) for form in self.forms(metric))
