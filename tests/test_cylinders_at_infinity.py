"""How often points at infinity count where a constraint is a cylinder, on sections made through such points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from random import Random

import pytest
from flint import fmpq, fmpq_mat
from mechanisms import three_rps, vector

from pkm_exact.algebra.modular_elimination import Elimination
from pkm_exact.completeness.closed_section import closed_section
from pkm_exact.completeness.conditions import Conditions
from pkm_exact.completeness.finite_section import is_finite
from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.linear import LinearForm
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.policy import Policy

DEGREE = 40
PRIME = (1 << 31) - 1
ISOTROPIC = (1, 1j, 0)
SQUARE = [a * b for a in ISOTROPIC for b in ISOTROPIC]
SMOOTH = [5, *ISOTROPIC, *ISOTROPIC, *SQUARE]
SINGULAR = {
    "2 C u^T = s R": [2, *ISOTROPIC, *ISOTROPIC, *SQUARE],
    "R = 0": [0, *ISOTROPIC, *ISOTROPIC, *[0] * 9],
}
"""s, u, C, R."""


def _forms(point: Sequence[complex], number: int) -> list[Constraint]:
    """Forms at random that vanish at a point and its conjugate."""
    rows = [[int(complex(z).real) for z in point], [int(complex(z).imag) for z in point]]
    solved, rank = fmpq_mat(rows).rref()
    pivots = {next(j for j in range(16) if solved[i, j] != 0): i for i in range(rank)}
    random, found = Random(5), []
    for _ in range(number):
        form = {j: fmpq(random.randint(-5, 5)) for j in range(16) if j not in pivots}
        form |= {pivot: -sum((solved[i, j] * form[j] for j in form), fmpq(0)) for pivot, i in pivots.items()}
        values = [Fraction(int(form[j].p), int(form[j].q)) for j in range(16)]
        found.append(LinearForm((*values, Fraction(random.randint(1, 5)))))
    return found


def _cylinders(number: int) -> list[Constraint]:
    """At the points above v.(C + R B) is 0: of the first one for its direction, of the second one for its joint."""
    data = [((1, 2, 0), (0, 0, 1), (2, -1, 3)), ((3, -1, 0), (1, 2, -1), (-1, 0, 7))]
    return [AxisDistance(vector(*x), vector(*v), vector(*b), Fraction(9, 4)) for x, v, b in data[:number]]


def _at_infinity(problem: ForwardProblem) -> int:
    """What is left of 40 or 80 or 160 for the points at infinity, beside all poses with multiplicity."""
    conditions = Conditions.of(problem)
    assert is_finite(conditions, PRIME)
    most = DEGREE << len(conditions.quadrics)
    algebra = Elimination(closed_section(conditions).system, Policy(dimension_limit=most)).image().algebra
    assert algebra is not None
    return most - algebra.dimension


def _of(point: Sequence[complex], cylinders: int) -> int:
    """For a point and its conjugate, through which all conditions go."""
    return _at_infinity(ForwardProblem((*_forms(point, 6 - cylinders), *_cylinders(cylinders))))


def test_a_smooth_point_counts_twice_beside_a_cylinder() -> None:
    """It would be counted once: the sum is less than 80."""
    assert _of(SMOOTH, 0) == 2 * 1
    assert _of(SMOOTH, 1) == 2 * 2


@pytest.mark.parametrize("name", SINGULAR)
def test_singular_points_may_count_twice_beside_a_cylinder_too(name: str) -> None:
    """As they would be counted: here the sum is 80."""
    assert _of(SINGULAR[name], 0) == 2 * 2
    assert _of(SINGULAR[name], 1) == 2 * 2


@pytest.mark.parametrize("point", [SMOOTH, pytest.param(SINGULAR["2 C u^T = s R"], marks=pytest.mark.slow)])
def test_points_count_four_times_beside_two_cylinders(point: list[complex]) -> None:
    assert _of(point, 2) == 2 * 4


def test_singular_points_of_a_mechanism_count_more_beside_a_cylinder() -> None:
    """Twelve, in a 3-RPS; in place of one of its planes a cylinder along the normal, which they are on as well."""
    problem = three_rps()
    plane = problem.constraints[1]
    assert isinstance(plane, InPlane)
    cylinder = AxisDistance(vector(1, 2, -3), plane.normal, plane.platform, Fraction(9, 4))
    others = problem.constraints[:1] + problem.constraints[2:]
    assert _at_infinity(problem) == 12 * 2
    assert _at_infinity(replace(problem, constraints=(*others, cylinder))) == 12 * 4
