"""Path tracking: the shipped start sections, starts near a robot, and what becomes of paths without an end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from random import Random
from typing import Any

import numpy as np
import pytest
from samples import model, random_placed, shipped

from pkm_exact.constraints.distance import Distance
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import PLANAR, SPATIAL
from pkm_exact.numeric.nearby import _count, from_home, nearby_start
from pkm_exact.numeric.poses import approximations, certified_solutions
from pkm_exact.numeric.start import StartSection, find_start, generic_start
from pkm_exact.numeric.study_system import (
    leg_forms,
    motion_values,
    numeric_section,
    rational_coordinates,
    section_quadrics,
)
from pkm_exact.numeric.tracker import TrackerPolicy, polished, track

GENERAL = ["rolland-6-6", "dietmaier", "6-6p", "3-rpr-merlet-p", "3-rrr"]
"""Robots with as many solutions as robots of their kind can have."""


def residuals(start: StartSection, motion: Motion) -> Any:
    """The largest value of the equations at every solution, of norm 1."""
    quadrics = section_quadrics(start.legs, motion)
    points = start.solutions / np.linalg.norm(start.solutions, axis=1, keepdims=True)
    return np.abs(np.einsum("kij,pi,pj->pk", quadrics, points, points)).max(axis=1)


def different(points: Any) -> int:
    """Number of projective points that differ from all before them."""
    points = points / np.linalg.norm(points, axis=1, keepdims=True)
    return int((~np.triu(np.abs(points.conj() @ points.T) > 1 - 1e-9, 1).any(axis=0)).sum())


def with_lengths(problem: ForwardProblem, factors: Sequence[Fraction]) -> ForwardProblem:
    legs = [
        Distance(leg.base, leg.platform, leg.length_squared * factor)
        for leg, factor in zip(problem.distances, factors, strict=True)
    ]
    return ForwardProblem(tuple(legs), problem.metric, problem.motion)


def random_factors(problem: ForwardProblem, seed: int) -> list[Fraction]:
    random = Random(seed)
    return [1 + Fraction(random.randint(-50, 50), 1000) for _ in problem.distances]


@pytest.mark.parametrize("motion", [SPATIAL, PLANAR])
def test_shipped_starts_have_as_many_solutions_as_the_degree(motion: Motion) -> None:
    start = generic_start(motion)
    assert residuals(start, motion).max() < 1e-13
    assert different(start.solutions) == len(start.solutions) == motion.degree


def test_monodromy_finds_a_planar_start_again() -> None:
    start = find_start(3, PLANAR)
    assert residuals(start, PLANAR).max() < 1e-13
    assert different(start.solutions) == 6


@pytest.mark.parametrize("name", GENERAL)
@pytest.mark.parametrize("seed", [0, 1])
def test_all_solutions_of_known_robots_are_found(name: str, seed: int) -> None:
    problem = shipped(name)
    found = approximations(problem, seed=seed)
    assert different(found.points) == problem.solution_bound


@pytest.mark.parametrize("name", GENERAL)
def test_solutions_fulfil_the_equations_of_the_legs(name: str) -> None:
    found = approximations(shipped(name))
    values = np.abs(np.einsum("kij,pi,pj->pk", found.section.quadrics, found.points, found.points))
    assert values.max() < 1e-9


def test_a_known_pose_is_among_the_solutions() -> None:
    sample = random_placed(Random(7), [Fraction(x) for x in (1, 2, -1, 3)], (1, 3, 1))
    found = approximations(sample.problem)
    points = rational_coordinates(found.points, found.section)
    e = points[:, :4] / points[:, [0]]
    assert np.abs(e - np.array([1, 2, -1, 3])).max(axis=1).min() < 1e-6


@pytest.mark.parametrize("name", GENERAL)
def test_a_start_near_the_robot_finds_the_same_solutions(name: str) -> None:
    problem = shipped(name)
    start = nearby_start(problem)
    assert start is not None
    assert residuals(start, problem.motion).max() < 1e-9
    for seed in range(3):
        other = with_lengths(problem, random_factors(problem, seed))
        found = [approximations(other, section) for section in (start, None)]
        one, two = (rational_coordinates(part.points, part.section) for part in found)
        one, two = (points / np.linalg.norm(points, axis=1, keepdims=True) for points in (one, two))
        likeness = np.abs(one.conj() @ two.T)
        assert len(one) == len(two) == problem.solution_bound
        assert (likeness.max(axis=0) > 1 - 1e-9).all()
        assert (likeness.max(axis=1) > 1 - 1e-9).all()


def test_starts_near_a_robot_are_complex_and_keep_its_frames() -> None:
    problem = shipped("rolland-6-6")
    start, section = nearby_start(problem, 1), numeric_section(problem)
    assert start is not None
    assert start.frames is not None
    assert start.frames.unit == section.frames.unit
    assert np.array_equal(start.legs[:, :-1], section.legs[:, :-1])
    assert (np.abs(start.legs[:, -1].imag) > 0).all()
    other = nearby_start(problem, 2)
    assert other is not None
    assert not np.array_equal(other.legs, start.legs)


@pytest.mark.parametrize("name", ["mssm", "similar-planar-s", "ssm-exact"])
def test_robots_with_fewer_solutions_have_no_start_of_their_own(name: str) -> None:
    assert nearby_start(shipped(name)) is None


def test_solutions_of_neighbours_follow_from_those_at_home_or_not_at_all() -> None:
    robot, problem = model("3-rpr-merlet-p"), shipped("3-rpr-merlet-p")
    start = nearby_start(problem)
    assert start is not None
    assert start.home is not None
    squares = [leg.length_squared for leg in problem.distances]
    for factor, is_near in ((Fraction(1001, 1000), True), (Fraction(9), False)):
        other = robot.problem([squares[0] * factor, *squares[1:]])
        found = from_home(other, start)
        assert (found is not None) is is_near
        if found is None:
            continue
        values = np.einsum("kij,pi,pj->pk", found.section.quadrics, found.points, found.points)
        assert np.abs(values).max() < 1e-12
        overlaps = np.abs(found.points.conj() @ found.points.T) - np.eye(len(found.points))
        assert np.abs(overlaps).max() < 1 - 1e-6
    assert from_home(problem, replace(start, home=None)) is None


def test_a_home_with_a_solution_twice_is_of_no_use() -> None:
    problem = shipped("3-rpr-merlet-p")
    start = nearby_start(problem)
    assert start is not None
    assert start.home is not None
    twice = np.concatenate([start.home[:5], start.home[:1]])
    assert from_home(problem, replace(start, home=twice)) is None


def test_paths_to_a_double_solution_do_not_arrive() -> None:
    """From x^2 = y^2 to x^2 = 0."""
    start = np.array([[[1, 0], [0, -1]]], dtype=complex)
    target = np.array([[[1, 0], [0, 0]]], dtype=complex)
    _, arrived = track(np.array([[1, 1], [1, -1]], dtype=complex), start, target, TrackerPolicy(steps=300))
    assert not arrived.any()


def test_a_single_quadric_is_solved() -> None:
    start = np.array([[[1, 0], [0, -1]]], dtype=complex)
    target = np.array([[[1, 0], [0, 2 + 1j]]], dtype=complex)
    ends, arrived = track(np.array([[1, 1], [1, -1]], dtype=complex), start, target)
    assert arrived.all()
    ratios = (ends[:, 0] / ends[:, 1]) ** 2
    assert np.allclose(ratios, -2 - 1j)
    assert different(ends) == 2


def test_polishing_brings_points_back() -> None:
    start = generic_start(SPATIAL)
    random = np.random.default_rng(1)
    moved = start.solutions + 1e-5 * random.standard_normal(start.solutions.shape)
    points, change = polished(moved, section_quadrics(start.legs, SPATIAL))
    assert change.max() < 1e-10
    assert np.abs((points.conj() * start.solutions).sum(axis=1) / np.linalg.norm(start.solutions, axis=1)).min() > (
        1 - 1e-12
    )


def test_leg_forms_are_the_squared_distances() -> None:
    """At the identity displaced by C the form is |C + B - A|^2 - l^2."""
    base, platform, c = np.array([[1.0, 2, 3]]), np.array([[-2.0, 0, 5]]), np.array([4.0, -1, 2])
    form = leg_forms(base, platform, np.array([7.0]))[0]
    point = np.concatenate([[1, 0, 0, 0], [0, *c]]).astype(complex)
    assert form @ motion_values(point) == pytest.approx(((c + platform[0] - base[0]) ** 2).sum() - 7)


def test_numbers_beyond_floating_point_are_an_error_of_their_own() -> None:
    problem = shipped("rolland-6-6")
    huge = with_lengths(problem, [Fraction(10) ** 400] * 6)
    with pytest.raises(OverflowError):
        approximations(huge)


def test_one_of_two_conjugates_stands_for_both() -> None:
    """Solutions at home are two real ones and two pairs; a point beside its own conjugate is no pair."""
    problem = shipped("3-rpr-merlet-p")
    start = nearby_start(problem)
    assert start is not None
    assert start.home is not None
    assert len(start.home) == 4
    assert _count(start.home) == 6
    assert _count(np.concatenate([start.home, start.home.conj()])) == 0
    found = from_home(problem, start)
    assert found is not None
    assert certified_solutions(problem, found)[1].count == 6
    twice = replace(start, home=np.concatenate([start.home, start.home.conj()]))
    assert from_home(problem, twice) is None
