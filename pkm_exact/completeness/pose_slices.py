"""What a proof by slices consists of: poses at constant values of linear forms, more of them than can be isolated."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING

from pkm_exact.claim import RealMotion

if TYPE_CHECKING:
    from pkm_exact.constraints.form import Form
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.poses.pose_representation import PoseRepresentation


@dataclass(frozen=True)
class Slice:
    """The poses at which the last further form has a value.

    Attributes
    ----------
    constant : Fraction
        That value.
    representation : PoseRepresentation
        Complex poses, verified.
    real : int
        Number of real ones; 0 if not all are proved to be simple.
    """

    constant: Fraction
    representation: PoseRepresentation
    real: int

    @property
    def count(self) -> int:
        """Number of distinct complex poses."""
        return self.representation.univariate.degree


@dataclass(frozen=True)
class MorePoses:
    """A proof that the poses form a set of positive dimension.

    Attributes
    ----------
    forms : tuple of Form
        Further linear forms that are 0; the last one has the constants of the slices as values.
    slices : tuple of Slice
        By increasing constant.
    bound : int
        The most isolated poses of the robot with all further forms but the last.
    """

    forms: tuple[Form, ...]
    slices: tuple[Slice, ...]
    bound: int

    @property
    def count(self) -> int:
        """Number of distinct poses."""
        return sum(found.count for found in self.slices)

    @property
    def real(self) -> RealMotion:
        """Proved if there are more real poses, simple in their slices, than the bound."""
        return RealMotion.PROVED if sum(found.real for found in self.slices) > self.bound else RealMotion.OPEN

    def problem_of(self, problem: ForwardProblem, found: Slice) -> ForwardProblem:
        """The robot with the forms of a slice as further constraints."""
        return with_forms(problem, (*self.forms[:-1], shifted(self.forms[-1], found.constant)))


def shifted(form: Form, constant: Fraction) -> Form:
    """The form less a constant."""
    return (*form[:-1], form[-1] - constant)


def with_forms(problem: ForwardProblem, forms: Sequence[Form]) -> ForwardProblem:
    """The robot with linear forms as further constraints."""
    from pkm_exact.constraints.linear import LinearForm

    return replace(problem, constraints=(*problem.constraints, *map(LinearForm, forms)))
