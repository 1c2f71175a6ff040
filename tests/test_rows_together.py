"""Rows that go through arrays together: what is found is what a solve of its own finds, to the bit."""

from __future__ import annotations

import gc
import pickle
import platform
import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from random import Random
from typing import Any

import numpy as np
import pytest
from samples import model

from pkm_exact.batch.row_solver import RowSolver
from pkm_exact.errors import InternalContradictionError
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import pose_quadrics
from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.double_jacobians import forms_of_each
from pkm_exact.numeric.double_krawczyk import DoubleEquations
from pkm_exact.numeric.poses import poses_in_doubles
from pkm_exact.numeric.rows_together import rows_together
from pkm_exact.numeric_engine import solve_krawczyk, with_answers
from pkm_exact.policy import Policy
from pkm_exact.poses.boxes import DEFAULT_WIDTH
from pkm_exact.poses.isolated_solutions import Box

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


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="of other C libraries nothing is known")
def test_memory_that_arrays_took_is_kept_for_the_next() -> None:
    lines = [
        "import resource",
        "import numpy as np",
        "from pkm_exact.batch.row_solver import keep_freed_memory",
        "keep_freed_memory()",
        "for time in range(9):",
        "    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt",
        "    arrays = [np.ones(100_000) for _ in range(8)]",
        "    del arrays",
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)",
    ]
    done = subprocess.run([sys.executable, "-c", "\n".join(lines)], capture_output=True, text=True, check=True)
    assert int(done.stdout) < 100  # of the 1,600 pages of eight arrays


def test_the_collector_of_cycles_waits_for_rows_and_is_left_as_it_was(monkeypatch: pytest.MonkeyPatch) -> None:
    problems = _problems("3-rpr-merlet-p", 3)
    solver = RowSolver.of(problems, DEFAULT_WIDTH, Policy())
    seen: list[bool] = []

    def looks(*_arguments: object) -> list[None]:
        seen.append(gc.isenabled())
        raise OverflowError

    monkeypatch.setattr("pkm_exact.batch.row_solver.rows_together", looks)
    with pytest.raises(OverflowError):
        solver.near(problems)
    assert seen == [False]
    assert gc.isenabled()
    gc.disable()
    try:
        with pytest.raises(OverflowError):
            solver.near(problems)
        assert not gc.isenabled()
    finally:
        gc.enable()


def test_boxes_know_whether_they_are_real() -> None:
    centre = ((3, 0), *[(k, 0) for k in range(7)])
    real, other = Box((31, 31), centre), Box((31, 31), (*centre[:-1], (6, -1)))
    assert (real.is_real, other.is_real, replace(other, centre=centre)) == (True, False, real)
    assert {real: 1, other: 2}[pickle.loads(pickle.dumps(other))] == 2  # noqa: S301


def test_robots_with_the_same_lengths_are_told_apart() -> None:
    """A problem is looked up by its lengths, a leg by two numbers: others must not be taken for them."""
    problem = _problems("3-rpr-merlet-p", 1)[0]
    first, *legs = problem.distances
    moved = replace(first, platform=(first.platform[0] + 1, *first.platform[1:]))
    other = ForwardProblem((moved, *legs), problem.metric, problem.motion)
    assert (hash(other), other == problem) == (hash(problem), False)
    assert [pose_quadrics(entry)[0] == pose_quadrics(problem)[0] for entry in (problem, other)] == [True, False]
    assert moved.forms(problem.metric) != first.forms(problem.metric)


def test_of_rows_that_contradict_themselves_none_is_answered_at_once() -> None:
    """Each is solved by itself then, and the one that is wrong says so."""
    problems = _problems("3-rpr-merlet-p", 4)
    solver = RowSolver.of(problems, DEFAULT_WIDTH, Policy())
    rows: list[Any] = solver.near(problems)
    assert [row.answer is not None for row in rows] == [True] * 4
    assert solver.solution(problems[1], rows[1]) is rows[1].answer
    # Poses of another row: they are not on this robot.
    wrong = [replace(rows[0], answer=None), replace(rows[1], poses=rows[0].poses, answer=None)]
    left: list[Any] = with_answers(wrong, DEFAULT_WIDTH, Policy())
    assert [row.answer for row in left] == [None, None]
    assert solver.solution(problems[0], left[0]).poses == rows[0].answer.poses
    with pytest.raises(InternalContradictionError):
        solver.solution(problems[1], left[1])
    assert with_answers([None, wrong[0]], DEFAULT_WIDTH, Policy())[0] is None


def test_forms_of_each_are_those_of_each_alone() -> None:
    problems = [*_problems("mourrain-l", 3), *_problems("rolland-6-6", 2)]
    together = forms_of_each([problems[0], *problems, problems[4]], Fraction(2))
    alone = [forms_of_each([problem], Fraction(2))[0] for problem in problems]
    assert (together == np.stack([alone[0], *alone, alone[4]])).all()


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


@pytest.mark.parametrize("name", [pytest.param("mourrain-l", marks=pytest.mark.slow), "3-rpr-merlet-p"])
def test_rows_keep_what_doubles_tell_of_their_own_poses(name: str) -> None:
    """Jacobians depend on the lengths of the row."""
    problems = _problems(name, 3)
    solver = RowSolver.of(problems, DEFAULT_WIDTH, Policy())
    rows: list[Any] = solver.near(problems)
    alone = [poses_in_doubles([(row.system, row.isolated)], DEFAULT_WIDTH)[0] for row in rows]
    assert [row.poses.jacobians for row in rows] == [found.jacobians for found in alone]
    assert [row.poses.cells for row in rows] == [found.cells for found in alone]
    assert rows[0].poses.jacobians != rows[1].poses.jacobians


@pytest.mark.slow
def test_rows_of_a_robot_near_singular_poses_are_seeded_by_the_template() -> None:
    problems = _problems("dietmaier", 5)
    solver = RowSolver.of(problems, DEFAULT_WIDTH, Policy())
    assert solver.start is not None
    assert solver.start.home is None
    rows = solver.near(problems)
    assert None not in rows
    for problem, row in zip(problems, rows, strict=True):
        together, alone = solver.solution(problem, row), solve_krawczyk(problem)
        assert (together.isolated, together.poses) == (alone.isolated, alone.poses)


def test_points_of_several_problems_are_chosen_in_equal_numbers() -> None:
    problems = _problems("3-rpr-merlet-p", 3)
    single = [ChartSystem(problem, (3, -1, 2, 1)).in_doubles for problem in problems]
    together = DoubleEquations.stacked([equations for equations in single if equations is not None])
    assert together is not None
    chosen = np.array([0, 2, 9])
    assert together.places(chosen, 12).tolist() == [0, 2, 4, 5, 9, 8]
    assert single[0] is not None
    assert single[0].places(chosen, 12).tolist() == [0, 2, 9]
