"""Any linear form on rigid motions, for sensors and oddities that have no name of their own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import ClassVar

from pkm_exact.constraints.constraint import Linear, Role
from pkm_exact.constraints.form import Form


@dataclass(frozen=True)
class LinearForm(Linear):
    """A linear form that vanishes.

    Attributes
    ----------
    coefficients : tuple of 17 Fraction
        On |C|^2, u = R^-1 C (3), C (3), R by rows (9) and 1, in the coordinates of the file; |C|^2 in the metric.
    name : str
        Its label; may be empty.

    Examples
    --------
    >>> from fractions import Fraction
    >>> height = LinearForm((*[Fraction(0)] * 6, Fraction(1), *[Fraction(0)] * 9, Fraction(-5)))
    >>> len(height.forms((1, 1, 1))[0])
    17
    """

    coefficients: Form
    name: str = ""

    type: ClassVar[str] = "linear"
    title: ClassVar[str] = "a linear form on |C|^2, R^-1 C, C, R and 1 that is 0"
    fields: ClassVar[Mapping[str, Role]] = MappingProxyType({"coefficients": Role.COEFFICIENTS})
    value_field: ClassVar[str | None] = None
    codimension: ClassVar[int] = 1

    def forms(self, metric: tuple[int, int, int]) -> tuple[Form, ...]:  # noqa: ARG002 - other types need it
        """The form as it is given."""
        return (self.coefficients,)

    def mirrored(self) -> LinearForm:
        """Of the inverse motion: C becomes -u, u becomes -C, and R its inverse; for the metric 1 only."""
        c = self.coefficients
        turned, position = tuple(-x for x in c[4:7]), tuple(-x for x in c[1:4])
        rotation = tuple(c[7 + 3 * j + i] for i in range(3) for j in range(3))
        return LinearForm((c[0], *turned, *position, *rotation, c[16]), self.name)
