"""Paths of robots: from one locked robot to another of the same make, straight in their data.

Of a leg of known length all data may move: both joints and the squared length run linearly with s, 0 <= s <= 1, and so
its form, in which products of two of them occur, is of degree 2 in s. Of other constraints only the value moves (a
squared length, an offset, a product), which stands in the constant term alone. Three exact values of s determine the
equations, as of joint paths (``path_forms``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from flint import arb

from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import in_frames
from pkm_exact.errors import InputError
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.centred import CentredFrames, centred_form, centred_leg, form_size
from pkm_exact.numeric.path_forms import (
    STATIONS,
    JointRow,
    PathForms,
    path_forms,
    problem_at,
    quadratic,
    require_quadratic,
)
from pkm_exact.wording import shown


@dataclass(frozen=True)
class RobotRows:
    """A robot at rows of joint values, straight in these between two rows.

    Attributes
    ----------
    robot : Machine
    rows : sequence of tuples of Fraction
    """

    robot: Machine
    rows: Sequence[JointRow]

    def __len__(self) -> int:
        return len(self.rows)

    def problem(self, row: int) -> ForwardProblem:
        """The locked robot at a row, from 0.

        Raises
        ------
        InputError
            If the row has values that the robot cannot have.
        """
        return problem_at(self.robot, self.rows[row])

    def forms(self, frames: CentredFrames, row: int) -> PathForms:
        """The equations from a row to the next."""
        return path_forms(self.robot, frames, self.rows[row], self.rows[row + 1])

    def require(self) -> None:
        """Refuse a robot whose equations are not of degree 2 along the path."""
        require_quadratic(self.robot)


@dataclass(frozen=True)
class ProblemPath:
    """Locked robots of one make, straight in their data between one and the next.

    Attributes
    ----------
    problems : sequence of ForwardProblem
    """

    problems: Sequence[ForwardProblem]

    def __len__(self) -> int:
        return len(self.problems)

    def problem(self, row: int) -> ForwardProblem:
        """The robot at a row, from 0."""
        return self.problems[row]

    def forms(self, frames: CentredFrames, row: int) -> PathForms:
        """The equations from a robot to the next."""
        first, last = self.problems[row], self.problems[row + 1]
        sizes = [
            form_size(in_frames(form, frames.base, frames.platform, frames.unit, first.metric)) for form in first.forms
        ]
        found = [_rows(blended(first, last, share), frames, sizes) for share in STATIONS]
        return quadratic(first.motion, found)

    def require(self) -> None:
        """Refuse robots that are not of one make.

        Raises
        ------
        InputError
            If motion, metric, or number, types or names of constraints differ; or more of a constraint than its value.
        """
        first = self.problems[0]
        for other in self.problems[1:]:
            blended(first, other, Fraction(0))


def _rows(problem: ForwardProblem, frames: CentredFrames, sizes: Sequence[Fraction]) -> list[list[arb]]:
    if problem.has_only_distances:
        return [centred_leg(leg, frames, problem.metric) for leg in problem.distances]
    return [centred_form(form, frames, problem.metric, size) for form, size in zip(problem.forms, sizes, strict=True)]


def blended(first: ForwardProblem, last: ForwardProblem, share: Fraction) -> ForwardProblem:
    """The robot at a share of the way from one to another.

    Raises
    ------
    InputError
        If they are not of one make.

    Examples
    --------
    >>> from pkm_exact import read_robot
    >>> robot = read_robot("models/3-rpr-merlet-p.toml")
    >>> one, other = (robot.problem([Fraction(n)] * 3) for n in (40, 50))
    >>> [str(leg.length_squared) for leg in blended(one, other, Fraction(1, 2)).distances]
    ['45', '45', '45']
    """
    if (first.motion, first.metric, len(first.constraints)) != (last.motion, last.metric, len(last.constraints)):
        raise InputError("robot: the motions, the metric or the number of constraints differ")
    pairs = zip(first.constraints, last.constraints, strict=True)
    return ForwardProblem(tuple(_between(*pair, share) for pair in pairs), first.metric, first.motion)


def _between(one: Constraint, other: Constraint, share: Fraction) -> Constraint:
    if type(one) is not type(other) or one.name != other.name:
        raise InputError("robot: the types or names of the constraints differ")
    moving = tuple(one.fields) if isinstance(one, Distance) else (one.value_field,)
    names = [name for name in moving if name is not None]
    if _with(one, {name: getattr(other, name) for name in names}) != other:
        raise InputError(f"robot: constraint {shown(one.name)} differs in more than its value")
    return _with(one, {name: _mixed(getattr(one, name), getattr(other, name), share) for name in names})


def _with(constraint: Constraint, values: dict[str, Any]) -> Constraint:
    data: Any = constraint
    found: Constraint = replace(data, **values)
    return found


def _mixed(one: Any, other: Any, share: Fraction) -> Any:
    if isinstance(one, tuple):
        return tuple(_mixed(x, y, share) for x, y in zip(one, other, strict=True))
    return one + share * (other - one)
