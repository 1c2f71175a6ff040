"""Motions that no constraint notices: displacements of the platform in its own frame, or in the fixed one.

A one-parameter group of displacements, applied to the platform's frame (R becomes R exp(t W)) or to the fixed frame,
acts linearly on the 17 coordinates (|C|^2; u; C; R; 1), so that the derivative D F of a linear form along it is a
linear form. If it maps the span of the forms of all constraints into itself, modulo what vanishes on all motions, poses
go to poses: each lies on an orbit of poses, of as many dimensions as there are independent such groups, because
displacements act freely. Of a quadric L - k M^2 it suffices that D M is a constant c, and D L = 2 k c M, modulo the
same forms.

Platform joints on a line are an example: turns about the line. Planes with one common direction are another.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import TypeAlias

from flint import fmpq, fmpq_mat

from pkm_exact.constraints.form import SIZE, Form
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import CYCLIC
from pkm_exact.geometry.study import STUDY_CONDITION, motion_quadrics

Twist: TypeAlias = tuple[Sequence[Fraction], Sequence[Sequence[Fraction]]]
"""A velocity v, and a matrix W with G W antisymmetric."""
_ZERO, _ONE = Fraction(0), Fraction(1)


def platform_freedom(problem: ForwardProblem) -> int:
    """How many independent displacements in the platform's frame keep all constraints.

    Examples
    --------
    >>> from pkm_exact.constraints.at_point import AtPoint
    >>> platform_freedom(ForwardProblem((AtPoint((_ZERO,) * 3, (_ZERO, _ZERO, _ONE)),)))
    3
    """
    return _freedom(problem, _in_platform_frame)


def base_freedom(problem: ForwardProblem) -> int:
    """How many independent displacements in the fixed frame keep all constraints."""
    return _freedom(problem, _in_fixed_frame)


def _freedom(problem: ForwardProblem, derivative: Callable[[Form, Twist, Sequence[int]], Form]) -> int:
    """The dimension of the space of twists whose derivatives stay in the span of the forms.

    Unknowns are the coefficients of the twists, and the constant c of every quadric: what they must combine to 0 are
    the remainders modulo the span.
    """
    metric, remainders = problem.metric, _Remainders(problem)
    constant: Form = (*[_ZERO] * (SIZE - 1), _ONE)
    twists = [_twists(metric)[k] for k in problem.motion.twist]
    forms = [*problem.forms, *(form for square in problem.squares for form in (square.root, square.linear))]
    columns = [[remainders.of(derivative(form, twist, metric)) for form in forms] for twist in twists]
    for place, square in enumerate(problem.squares):
        column = [remainders.of((_ZERO,) * SIZE) for _ in forms]
        root = len(problem.forms) + 2 * place
        column[root] = remainders.of(tuple(-value for value in constant))
        column[root + 1] = remainders.of(tuple(-2 * square.factor * value for value in square.root))
        columns.append(column)
    rows = fmpq_mat([[value for remainder in column for value in remainder] for column in columns])
    # A quadric's constant alone, without a twist, is no solution unless M is 0 on all motions.
    return len(twists) - (int(rows.rank()) - len(problem.squares)) if forms else len(twists)


class _Remainders:
    """Linear forms as quadratic forms on the Study coordinates of the motions, modulo those of all constraints."""

    def __init__(self, problem: ForwardProblem) -> None:
        kept = set(problem.motion.support)
        quadrics = [*motion_quadrics(problem.metric), STUDY_CONDITION]
        places = sorted({key for quadric in quadrics for key in quadric if set(key) <= kept})
        self._quadrics = fmpq_mat([[fmpq(quadric.get(key, 0)) for key in places] for quadric in quadrics])
        rows = [[*_rational(form), fmpq(0)] for form in problem.forms]
        rows.append([fmpq(0)] * SIZE + [fmpq(1)])
        echelon, rank = (fmpq_mat(rows) * self._quadrics).rref()
        table = echelon.table()[:rank]
        self._pivots = [next(k for k, value in enumerate(row) if value) for row in table]
        self._rows = table

    def of(self, form: Form) -> list[fmpq]:
        """What is left of a form."""
        (values,) = (fmpq_mat([[*_rational(form), fmpq(0)]]) * self._quadrics).table()
        for pivot, row in zip(self._pivots, self._rows, strict=True):
            factor = values[pivot]
            if factor:
                values = [value - factor * other for value, other in zip(values, row, strict=True)]
        return list(values)


def _rational(form: Form) -> list[fmpq]:
    return [fmpq(value.numerator, value.denominator) for value in form]


def _twists(metric: Sequence[int]) -> list[Twist]:
    """Three translations along, and three turns about, the axes of coordinates."""
    still = [[_ZERO] * 3 for _ in range(3)]
    found: list[Twist] = [([_ONE if i == j else _ZERO for j in range(3)], still) for i in range(3)]
    for _, j, k in CYCLIC:
        turn = [[_ZERO] * 3 for _ in range(3)]
        turn[j][k], turn[k][j] = Fraction(-1, metric[j]), Fraction(1, metric[k])
        found.append(([_ZERO] * 3, turn))
    return found


def _in_platform_frame(form: Form, twist: Twist, metric: Sequence[int]) -> Form:
    """The derivative along C + t R v, R (1 + t W): those of |C|^2, u, C and R are 2 u.v, v - W u, R v and R W."""
    (velocity, turn), g = twist, metric
    square, turned, position, rotation = form[0], form[1:4], form[4:7], form[7:16]
    of_turned = [
        2 * square * g[j] * velocity[j] - sum((turned[i] * turn[i][j] for i in range(3)), _ZERO) for j in range(3)
    ]
    of_rotation = [
        position[i] * velocity[j] + sum((rotation[3 * i + k] * turn[j][k] for k in range(3)), _ZERO)
        for i in range(3)
        for j in range(3)
    ]
    constant = sum((value * v for value, v in zip(turned, velocity, strict=True)), _ZERO)
    return (_ZERO, *of_turned, *[_ZERO] * 3, *of_rotation, constant)


def _in_fixed_frame(form: Form, twist: Twist, metric: Sequence[int]) -> Form:
    """The derivative along C + t (v + W C), (1 + t W) R: those of |C|^2, u, C and R are 2 C.v, R^-1 v, v + W C, W R."""
    (velocity, turn), g = twist, metric
    square, turned, position, rotation = form[0], form[1:4], form[4:7], form[7:16]
    of_position = [
        2 * square * g[j] * velocity[j] + sum((position[i] * turn[i][j] for i in range(3)), _ZERO) for j in range(3)
    ]
    of_rotation = [
        turned[j] * g[i] * velocity[i] / g[j] + sum((rotation[3 * k + j] * turn[k][i] for k in range(3)), _ZERO)
        for i in range(3)
        for j in range(3)
    ]
    constant = sum((value * v for value, v in zip(position, velocity, strict=True)), _ZERO)
    return (_ZERO, *[_ZERO] * 3, *of_position, *of_rotation, constant)
