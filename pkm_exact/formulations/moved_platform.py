"""A robot whose platform coordinates are turned or reflected: every constraint on it, whatever its type."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from pkm_exact.constraints.constraint import Constraint, Role
from pkm_exact.constraints.form import Form, Vector
from pkm_exact.geometry.problem import ForwardProblem

Matrix = Sequence[Sequence[Fraction]]


def moved_platform(problem: ForwardProblem, matrix: Matrix) -> ForwardProblem:
    """The robot with platform points and directions Q B, for a matrix Q that keeps the metric.

    The pose (C, R) of the robot is the pose (C, R Q^-1) of this one.

    Examples
    --------
    >>> from pkm_exact.constraints.distance import Distance
    >>> one, zero = Fraction(1), Fraction(0)
    >>> problem = ForwardProblem((Distance((zero,) * 3, (one, zero, zero), one),))
    >>> turn = ((zero, -one, zero), (one, zero, zero), (zero, zero, one))
    >>> [str(x) for x in moved_platform(problem, turn).distances[0].platform]
    ['0', '1', '0']
    """
    moved = tuple(_moved(found, matrix, problem.metric) for found in problem.constraints)
    return replace(problem, constraints=moved)


def _moved(constraint: Constraint, matrix: Matrix, metric: Sequence[int]) -> Constraint:
    changes: dict[str, Any] = {}
    for name, role in constraint.fields.items():
        value = getattr(constraint, name)
        if role in (Role.PLATFORM_POINT, Role.PLATFORM_DIRECTION):
            changes[name] = _image(matrix, value)
        elif role == Role.COEFFICIENTS:
            changes[name] = _moved_form(value, matrix, metric)
    moved: Constraint = replace(constraint, **changes)  # type: ignore[type-var]
    return moved


def _image(matrix: Matrix, vector: Vector) -> Vector:
    x, y, z = (sum((r * b for r, b in zip(row, vector, strict=True)), Fraction(0)) for row in matrix)
    return x, y, z


def _moved_form(form: Form, matrix: Matrix, metric: Sequence[int]) -> Form:
    """The form on the new coordinates: R = R' Q, and u = Q^-1 u' with Q^-1 = G^-1 Q^T G."""
    turned = [
        sum((form[1 + j] * metric[k] * matrix[k][j] / metric[j] for j in range(3)), Fraction(0)) for k in range(3)
    ]
    rotation = [
        sum((form[7 + 3 * i + j] * matrix[k][j] for j in range(3)), Fraction(0)) for i in range(3) for k in range(3)
    ]
    return (form[0], *turned, *form[4:7], *rotation, form[16])
