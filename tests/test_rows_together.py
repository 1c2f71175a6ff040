"""Rows that go through arrays together: what is found is what a solve of its own finds, to the bit."""

from __future__ import annotations

from fractions import Fraction
from random import Random
from typing import Any

import numpy as np
import pytest
from samples import model

from pkm_exact.batch.row_solver import RowSolver
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.double_krawczyk import DoubleEquations
from pkm_exact.numeric.rows_together import rows_together
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.policy import Policy
from pkm_exact.poses.boxes import DEFAULT_WIDTH

ROBOTS = ["3-rpr-merlet-p", *(pytest.param(n, marks=pytest.mark.slow) for n in ("mourrain-l", "rolland-6-6", "6-6pp"))]


def _problems(name: str, count: int) -> list[ForwardProblem]:
    robot, random = model(name), Random(3)
    squares = [leg.length_squared for leg in robot.problem(robot.configuration()).distances]
    factors = [[1 + Fraction(random.randint(-1000, 1000), 250000) for _ in squares] for _ in range(count)]
    return [robot.problem([s * f * f for s, f in zip(squares, row, strict=True)]) for row in factors]


@pytest.mark.parametrize("name", ROBOTS)
def test_rows_are_answered_as_if_alone(name: str) -> None:
    problems = _problems(name, 6)
    solver = RowSolver.of(problems, DEFAULT_WIDTH, Policy())
    found = solver.near(problems)
    assert sum(near is not None for near in found) > 3
    for problem, near in zip(problems, found, strict=True):
        together, alone = solver.solution(problem, near), solve_krawczyk(problem)
        assert (together.isolated, together.poses) == (alone.isolated, alone.poses)


def test_rows_that_home_does_not_lead_to_are_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    problems = _problems("3-rpr-merlet-p", 4)
    solver = RowSolver.of(problems, DEFAULT_WIDTH, Policy())
    assert solver.start is not None
    robot = model("3-rpr-merlet-p")
    far = robot.problem([Fraction(10**6), Fraction(1), Fraction(1)])
    large = robot.problem([Fraction(10**350), Fraction(1), Fraction(1)])
    assert [near is None for near in rows_together([*problems[:2], far], solver.start, DEFAULT_WIDTH)] == [
        False,
        False,
        True,
    ]
    assert rows_together([*problems[:2], large], solver.start, DEFAULT_WIDTH) == [None] * 3
    monkeypatch.setattr(DoubleEquations, "stacked", lambda _: None)
    assert rows_together(problems, solver.start, DEFAULT_WIDTH) == [None] * 4


def test_stacked_equations_are_those_of_each() -> None:
    problems = _problems("3-rpr-merlet-p", 3)
    solver = RowSolver.of(problems, DEFAULT_WIDTH, Policy())
    systems: list[Any] = [near.system for near in solver.near(problems) if near is not None]
    single = [system.in_doubles for system in systems]
    together = DoubleEquations.stacked(single)
    assert together is not None
    points = np.random.default_rng(1).standard_normal((2 * len(single), systems[0].size))
    values, off = together.forms.at(points)
    for k, equations in enumerate(single):
        rows = slice(2 * k, 2 * k + 2)
        assert (values[rows] == equations.forms.at(points[rows])[0]).all()
        assert (off[rows] == equations.forms.at(points[rows])[1]).all()
        for name in ("jacobians", "variations"):
            part, whole = getattr(equations, name)(points[rows]), getattr(together, name)(points)[rows]
            assert np.allclose(part, whole, rtol=1e-14, atol=0)
