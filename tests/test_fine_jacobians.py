"""Jacobians from pairs of doubles: entries within their bounds, and answers as by ball arithmetic."""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from random import Random
from typing import Any

import numpy as np
import pytest
from flint import arb, arb_mat
from samples import shipped
from test_numeric_krawczyk import random_robot

from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.geometry.inverse import distance_squared, rotation_of
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.double_jacobians import decided
from pkm_exact.numeric.double_krawczyk import DoubleSolution
from pkm_exact.numeric.double_poses import study_points
from pkm_exact.numeric.fine_jacobians import _entries, _forms, _of_each, _product, _values, fine_jacobians
from pkm_exact.numeric.poses import approximations, box_enclosures, certified_solutions
from pkm_exact.numeric.seeds import has_seeds, seeds
from pkm_exact.poses.jacobian import _regular_jacobian, characteristic_length, pose_jacobians
from pkm_exact.poses.wrenches import BallRows
from pkm_exact.precision import working_precision

CASES = ["mourrain-l", "h4", "3-rrr", "planes", pytest.param("dietmaier", marks=pytest.mark.slow)]


def _problem(name: str) -> ForwardProblem:
    """A shipped one, or legs and points in planes, at a pose."""
    if name != "planes":
        return shipped(name)
    random, place = np.random.default_rng(3), np.array([Fraction(1), Fraction(2), Fraction(7, 2)])
    turn = rotation_of((Fraction(3), Fraction(1), Fraction(-1), Fraction(2)))
    points = np.array([[Fraction(value) for value in row] for row in random.integers(-9, 10, (12, 3)).tolist()])
    legs = [
        Distance(tuple(a), tuple(b), distance_squared(a, b, place, turn))
        for a, b in zip(points[:4].tolist(), points[4:8].tolist(), strict=True)
    ]
    moved = points[10:] @ np.array(turn).T + place
    planes = [InPlane(tuple(n), n @ at, tuple(b)) for n, b, at in zip(points[8:10], points[10:], moved, strict=True)]
    return ForwardProblem((*legs, *planes))


def _real(problem: ForwardProblem) -> tuple[Any, list[DoubleSolution], list[Any]]:
    found = seeds(problem) if has_seeds(problem) else approximations(problem)
    system, isolated = certified_solutions(problem, found)
    boxes = [box for box in isolated.real if box in system.double_solutions]
    return system, [system.double_solutions[box] for box in boxes], boxes


@pytest.mark.parametrize("name", CASES)
def test_entries_are_within_their_bounds(name: str) -> None:
    problem = _problem(name)
    system, solutions, boxes = _real(problem)
    length, twist = characteristic_length(problem), list(problem.motion.twist)
    values = _values(study_points(solutions, system.support))
    head, tail, bound = _entries(_of_each([problem], length), values, twist)
    with working_precision(300):
        norms = [(arb(a) + arb(b), c) for a, b, c in zip(*(part[:, 0].tolist() for part in values), strict=True)]
        rows = BallRows(problem, length)
        for number, enclosed in enumerate(box_enclosures(system, boxes)(250, range(len(boxes)))):
            exact = rows.at(enclosed[:3], [enclosed[3:6], enclosed[6:9], enclosed[9:12]])
            norm, off = norms[number]
            for i in range(len(head[number])):
                for j in range(len(twist)):
                    found = arb(head[number, i, j]) + arb(tail[number, i, j])
                    room = arb(bound[number, i, j]) + abs(exact[i, j]) * off
                    assert abs(found - exact[i, j] * norm) <= room
                    assert room < 1e-17 * max(1.0, float(abs(head[number]).max()))


@pytest.mark.parametrize("name", CASES)
def test_answers_are_those_of_ball_arithmetic(name: str) -> None:
    problem = _problem(name)
    system, solutions, boxes = _real(problem)
    found = fine_jacobians(problem, solutions, system.support, characteristic_length(problem))
    exact = pose_jacobians(box_enclosures(system, boxes), problem, [None] * len(boxes))
    decided = [pair for pair in zip(found, exact, strict=True) if pair[0] is not None]
    assert 2 * len(decided) > len(boxes)
    assert all(one == other for one, other in decided)


def test_what_the_form_of_a_product_is() -> None:
    """f d e* + e d f* is 2 N C x (R d) where Study's condition holds, at a rational pose."""
    random = Random(4)
    values = [Fraction(random.randint(-99, 99), 50) for _ in range(8)]
    e, f = values[:4], values[4:]
    dot, norm = (sum((a * b for a, b in zip(e, other, strict=True)), Fraction(0)) for other in (f, e))
    x = [*e, *(b - dot / norm * a for a, b in zip(e, f, strict=True))]
    table = _forms()[1]
    half = [sum((Fraction(t[i, j]) * x[i] * x[j] / 2 for i in range(8) for j in range(8)), Fraction(0)) for t in table]
    position, rotation = half[1:4], [half[4:7], half[7:10], half[10:13]]
    for k in range(3):
        d = [rotation[i][k] for i in range(3)]
        for i in range(3):
            a, b = (i + 1) % 3, (i + 2) % 3
            assert half[13 + 3 * i + k] * half[0] == 2 * (position[a] * d[b] - position[b] * d[a])


def test_near_a_singular_pose_the_smallest_singular_value_is_known() -> None:
    """Matrices with a smallest singular value of 1e-11, known to far more digits than as doubles."""
    random = np.random.default_rng(8)
    for _ in range(5):
        left, right = (np.linalg.qr(random.standard_normal((6, 6)))[0] for _ in range(2))
        head = left @ np.diag([3.0, 2.0, 1.5, 1.0, 0.5, 1e-11]) @ right
        tail, bound = head * 2.0**-54 * random.uniform(-1, 1, (6, 6)), np.full((6, 6), 1e-30)
        u, _, v = np.linalg.svd(head)
        value, off = _product((head[None], tail[None], bound[None]), u[None, :, -1], v[None, -1])
        with working_precision(300):
            exact = arb(0)
            for i in range(6):
                for j in range(6):
                    exact += arb(u[i, 5]) * arb(v[5, j]) * (arb(head[i, j]) + arb(tail[i, j]))
            assert abs(exact - arb(value[0])) <= arb(off[0])
            assert off[0] < 1e-25
            jacobian = _regular_jacobian(arb_mat(head.tolist()), Fraction(1))
        zero = np.zeros((1, 6, 6))
        found = decided(head[None], zero, Fraction(1), partial(_product, (head[None], zero, zero)))
        assert jacobian is not None
        assert found == [jacobian]


def test_what_it_is_not_for() -> None:
    problem = shipped("mourrain-l")
    system, solutions, _ = _real(problem)
    length = characteristic_length(problem)
    other = ForwardProblem(problem.constraints, (1, 3, 1), problem.motion)
    assert fine_jacobians(problem, [], system.support, length) == []
    assert fine_jacobians(other, solutions, system.support, length) == [None] * len(solutions)
    tiny = Fraction(1, 10**80)
    assert fine_jacobians(problem, solutions, system.support, 1 / tiny) == [None] * len(solutions)
    lost = [DoubleSolution(found.point, found.step, found.error + 1) for found in solutions]
    assert fine_jacobians(problem, lost, system.support, length) == [None] * len(solutions)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2, 60))
def test_random_robots(seed: int) -> None:
    problem = random_robot(seed)
    system, solutions, boxes = _real(problem)
    found = fine_jacobians(problem, solutions, system.support, characteristic_length(problem))
    exact = pose_jacobians(box_enclosures(system, boxes), problem, [None] * len(boxes))
    assert all(one in (None, other) for one, other in zip(found, exact, strict=True))
