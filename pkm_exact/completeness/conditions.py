"""What a robot asks of the 17 coordinates of rigid motions, with integer coefficients: hyperplanes and quadrics."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import lcm
from types import MappingProxyType
from typing import TYPE_CHECKING

from pkm_exact.constraints.constraint import SquareForm
from pkm_exact.constraints.form import SIZE, integral
from pkm_exact.digests import digest

if TYPE_CHECKING:
    from pkm_exact.completeness.rigid_motions import Quadric
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.motions.motion import Motion


@dataclass(frozen=True)
class Conditions:
    """The hyperplanes and quadrics of a robot on (|C|^2; u; C; R; h), and where it moves.

    Attributes
    ----------
    forms : tuple of 17 int each
        Linear forms of the constraints, in their order.
    quadrics : tuple of Quadric
        Of cylinders.
    metric : tuple of 3 int
    motion : Motion
    """

    forms: tuple[tuple[int, ...], ...]
    quadrics: tuple[Quadric, ...]
    metric: tuple[int, int, int]
    motion: Motion

    @classmethod
    def of(cls, problem: ForwardProblem) -> Conditions:
        """Those of a problem."""
        metric = problem.metric
        forms = [integral(form) for constraint in problem.constraints for form in constraint.forms(metric)]
        squares = [square for constraint in problem.constraints for square in constraint.squares(metric)]
        return cls(tuple(forms), tuple(map(quadric_of, squares)), metric, problem.motion)

    @property
    def digest(self) -> int:
        """A number that follows from all of them, for choices that are not to be foreseen."""
        quadrics = [[(i, j, value) for (i, j), value in sorted(quadric.items())] for quadric in self.quadrics]
        return digest(self.forms, quadrics, self.metric, self.motion.name)

    def with_forms(self, further: Sequence[Sequence[int]]) -> Conditions:
        """The same with further linear forms."""
        return Conditions((*self.forms, *map(tuple, further)), self.quadrics, self.metric, self.motion)


def quadric_of(square: SquareForm) -> Quadric:
    """linear * h - factor * root^2, cleared of denominators.

    Examples
    --------
    >>> from fractions import Fraction
    >>> x, y = ([Fraction(int(k == place)) for k in range(17)] for place in (0, 4))
    >>> dict(quadric_of(SquareForm(tuple(x), tuple(y), Fraction(1, 2))))
    {(0, 16): 2, (4, 4): -1}
    """
    table = {(j, SIZE - 1): value for j, value in enumerate(square.linear) if value}
    for i, left in enumerate(square.root):
        for j in range(i, SIZE):
            value = square.factor * left * square.root[j] * (1 if i == j else 2)
            if value:
                table[i, j] = table.get((i, j), 0 * value) - value
    table = {key: value for key, value in table.items() if value}
    denominator = lcm(*(value.denominator for value in table.values()))
    return MappingProxyType({key: int(value * denominator) for key, value in table.items()})
