"""What indices, polytopes and pictures take from a machine whose twist follows from its actuators, not they from it.

The interface is that of ``Freedom`` and ``Measures``, which are about q' = J t. Of singular values those of the speeds
of least norm are meant, q' = T^+ t: the reciprocals of those of T. What asks for J has no meaning here and is refused.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any, Final, NoReturn

from flint import arb, arb_mat

from pkm_exact.polytopes.enclosures import ball_of
from pkm_exact.precision import working_precision
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.eigenvalues import eigenvalues
from pkm_exact.statics.forward_map import ForwardMap
from pkm_exact.statics.free_components import FreeComponents
from pkm_exact.statics.freedom import Freedom
from pkm_exact.statics.measures import Measures, RefusedError

_NO_J: Final = (
    "is about q' = J t, and speeds of the actuators do not follow from the twist here; the polytopes say what can be "
    "done"
)


@dataclass(frozen=True, eq=False)
class RedundantFreedom(Freedom):
    """A machine with more actuators than equations for them, at a pose: t = T q'."""

    def __post_init__(self) -> None:
        self.forward  # noqa: B018  a refusal where there is none

    @cached_property
    def forward(self) -> ForwardMap:
        """T."""
        return ForwardMap(self.at)

    @cached_property
    def free(self) -> FreeComponents:
        """All components of a twist."""
        count = len(self.at.twist)
        unit = tuple(tuple(Fraction(int(i == k)) for i in range(count)) for k in range(count))
        return FreeComponents(tuple(range(count)), unit)

    @property
    def ball_jacobian(self) -> arb_mat:
        """Refused."""
        raise RefusedError(_NO_J)

    def scaled(self, length: Fraction | None, speeds: Sequence[Fraction] | None = None) -> arb_mat:
        """Rows a with |a x| <= 1 in the velocity polytope, turns times the length: one for two facets."""
        if speeds is None:
            raise RefusedError(_NO_J)
        polytope = self.forward.velocity_polytope(speeds)
        with working_precision(BITS):
            roots = [ball_of(1 / square).sqrt() for square in polytope.squares]
            factors = [root / factor for root, factor in zip(roots, self._factors(length), strict=True)]
            return arb_mat(
                [
                    [
                        ball_of(x) * factor / ball_of(facet.offset)
                        for x, factor in zip(facet.normal, factors, strict=True)
                    ]
                    for facet in polytope.facets[::2]  # opposite ones are neighbours
                ]
            )


@dataclass(frozen=True, eq=False)
class RedundantMeasures(Measures):
    """Numbers from T that indices share."""

    @cached_property
    def singular_values(self) -> list[arb]:
        """Of T^+, in increasing order: turns times the length, speeds by the greatest where their units differ."""
        self.require_norms()
        freedom: Any = self.freedom
        speeds = self.limits.speeds if len(freedom.units) > 1 else None
        with working_precision(BITS):
            factors = freedom._factors(self.limits.length)
            columns = [ball_of(x) for x in speeds] if speeds is not None else [arb(1)] * len(freedom.at.actuated)
            rows = [
                [x * factor * column for x, column in zip(row, columns, strict=True)]
                for row, factor in zip(freedom.forward.balls.tolist(), factors, strict=True)
            ]
            matrix = arb_mat(rows)
            if matrix.nrows() > matrix.ncols():
                raise RefusedError("has no meaning with fewer actuators than freedoms")
            found = eigenvalues(matrix * matrix.transpose())
            if found is None or not found[0] > 0:
                raise RefusedError("is not decided: T has dependent rows, or the pose is not enclosed narrowly enough")
            return [1 / value.sqrt() for value in reversed(found)]

    def isotropic_speed(self, *_: Any) -> NoReturn:
        """Refused."""
        raise RefusedError(_NO_J)

    def isotropic_force(self, *_: Any) -> NoReturn:
        """Refused."""
        raise RefusedError(_NO_J)


def measures_of(at: Any, limits: Any) -> Measures:
    """What indices of a machine at a pose are computed from.

    Raises
    ------
    InputError
        If there is neither J nor T.
    """
    if at.is_forward:
        return RedundantMeasures(RedundantFreedom(at), limits)
    return Measures(Freedom(at), limits)
