"""Self-motions that the joints alone tell: collinear and coincident joints, dependent legs, parallelograms."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from random import Random
from typing import Any

import pytest
from budgets import budget
from certificate_tools import check_resealed, last_line
from hypothesis import given
from hypothesis import strategies as st
from samples import placed, random_vector

from pkm_exact import Robot, certificate
from pkm_exact.certify.check import Status
from pkm_exact.claim import Claim
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.engine import solve
from pkm_exact.geometry.chains import cosine_and_sine
from pkm_exact.geometry.inverse import Metric, distance_squared
from pkm_exact.geometry.planar_rotation import turn_of, weight
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.working_modes import platform_point
from pkm_exact.motions.motion_groups import PLANAR
from pkm_exact.poses.self_motion import Cause, SelfMotion, TranslationalMotion, form_rank, mobility
from pkm_exact.solution import Solution

ORIGIN = (Fraction(0), Fraction(0), Fraction(0))
METRICS = [(1, 1, 1), (1, 3, 1), (2, 5, 7)]
STEPS = tuple(Fraction(n, 3) for n in (0, 3, 7, -6, 8, 14))
seeds = st.integers(0, 10**9)


def _line(random: Random, steps: Sequence[Fraction] = STEPS) -> list[Vector]:
    start, along = random_vector(random), random_vector(random, 4)
    along = along if any(along) else (Fraction(1), Fraction(0), Fraction(2))
    return [(start[0] + k * along[0], start[1] + k * along[1], start[2] + k * along[2]) for k in steps]


def _spatial(random: Random, shape: str, metric: Metric) -> ForwardProblem:
    base, platform = ([random_vector(random) for _ in range(6)] for _ in range(2))
    if "platform line" in shape:
        platform = _line(random)
    if "base line" in shape:
        base = _line(random)
    if "platform point" in shape:
        platform = [random_vector(random)] * 6
    quaternion = [Fraction(random.randint(-4, 4)) for _ in range(3)]
    return placed(base, platform, random_vector(random), [Fraction(1), *quaternion], metric).problem


def _flat(random: Random, size: int = 9) -> Vector:
    x, y, _ = random_vector(random, size)
    return x, y, Fraction(0)


def _planar(random: Random, shape: str, metric: Metric) -> ForwardProblem:
    base, platform = ([_flat(random) for _ in range(3)] for _ in range(2))
    if "platform point" in shape:
        platform = [_flat(random)] * 3
    if "base line" in shape:
        base = [(x, y, Fraction(0)) for x, y, _ in _line(random, STEPS[:3])]
    rotation = turn_of(cosine_and_sine(Fraction(random.randint(-9, 9), 4), weight(metric)), metric)
    if shape == "congruent":
        base = [platform_point(joint, _flat(random, 0), rotation) for joint in platform]
        return ForwardProblem(tuple(map(Distance, base, platform, [Fraction(7, 3)] * 3)), metric, motion=PLANAR)
    position = _flat(random)
    squares = [distance_squared(a, b, position, rotation, metric) for a, b in zip(base, platform, strict=True)]
    return ForwardProblem(tuple(map(Distance, base, platform, squares)), metric, motion=PLANAR)


def _is_sound(problem: ForwardProblem) -> bool:
    """Whether a robot may have these legs: lengths that are not 0, and no two legs between the same points."""
    pairs = {(leg.base, leg.platform) for leg in problem.distances}
    return len(pairs) == len(problem.distances) and all(leg.length_squared for leg in problem.distances)


def _certificate(problem: ForwardProblem, solution: Solution) -> dict[str, Any]:
    base, platform = zip(*((leg.base, leg.platform) for leg in problem.distances), strict=True)
    kind = "3-RPR" if problem.motion.is_planar else "6-UPS"
    return certificate(Robot("moving", kind, "m", "made up", base, platform, problem.metric), None, solution)


def _is_accepted(problem: ForwardProblem, solution: Solution, line: str) -> dict[str, Any]:
    content = _certificate(problem, solution)
    answer = check_resealed(content)
    assert answer.status is Status.ACCEPTED, answer
    assert line in last_line(answer)
    return content


IN_SPACE = {
    "platform line": (1, (Cause.PLATFORM_LINE,), "dimension 1"),
    "base line": (1, (Cause.BASE_LINE,), "dimension 1"),
    "platform line, base line": (3, (Cause.PLATFORM_LINE, Cause.BASE_LINE, Cause.DEPENDENT_LEGS), "rank 3"),
    "platform point": (3, (Cause.PLATFORM_POINT, Cause.DEPENDENT_LEGS), "dimension 3"),
    "platform point, base line": (4, (Cause.PLATFORM_POINT, Cause.BASE_LINE, Cause.DEPENDENT_LEGS), "rank 2"),
}


@pytest.mark.parametrize("shape", IN_SPACE)
@budget(2)
@given(seed=seeds, metric=st.sampled_from(METRICS))
def test_collinear_and_coincident_joints_move(shape: str, seed: int, metric: Metric) -> None:
    dimension, causes, line = IN_SPACE[shape]
    problem = _spatial(Random(seed), shape, metric)
    solution = solve(problem)
    assert solution.claim is Claim.POSITIVE_DIMENSIONAL_PROVED
    assert isinstance(solution.self_motion, SelfMotion)
    found = solution.self_motion.mobility
    assert (found.dimension, found.causes) == (dimension, causes)
    (note,) = solution.notes
    assert ("collinear" in note) == ("line" in shape)
    if _is_sound(problem):
        _is_accepted(problem, solution, line)


IN_THE_PLANE = {"platform point": "dimension 1", "platform point, base line": "dimension 1", "congruent": "circle"}


@pytest.mark.parametrize("shape", IN_THE_PLANE)
@budget(5)
@given(seed=seeds, metric=st.sampled_from(METRICS))
def test_planar_robots_move(shape: str, seed: int, metric: Metric) -> None:
    problem = _planar(Random(seed), shape, metric)
    solution = solve(problem)
    assert solution.claim is Claim.POSITIVE_DIMENSIONAL_PROVED
    assert isinstance(solution.self_motion, TranslationalMotion) == (shape == "congruent")
    if _is_sound(problem):
        _is_accepted(problem, solution, IN_THE_PLANE[shape])


@pytest.mark.parametrize("shape", ["platform line", "base line", "platform point"])
@given(seed=seeds)
@budget(1)
def test_lengths_that_contradict_each_other_are_still_inconsistent(shape: str, seed: int) -> None:
    """Six lengths are one too many for five freedoms of a line; a wrong one leaves no pose, and that is proved."""
    problem = _spatial(Random(seed), shape, (1, 1, 1))
    first = replace(problem.distances[0], length_squared=problem.distances[0].length_squared + 1)
    problem = replace(problem, constraints=(first, *problem.distances[1:]))
    solution = solve(problem)
    assert solution.claim is Claim.INCONSISTENT
    if _is_sound(problem):
        assert check_resealed(_certificate(problem, solution)).status is Status.ACCEPTED


def test_a_planar_rank_counts_planar_motions_only() -> None:
    """General legs are independent; legs from a line to one point are not, though their 17 spatial coefficients are."""
    random = Random(4)
    assert form_rank(_planar(random, "general", (1, 3, 1))) == 3
    assert form_rank(_planar(random, "platform point, base line", (1, 3, 1))) == 2
    assert mobility(_planar(random, "general", (2, 5, 7))) is None
    line = [(x, y, Fraction(0)) for x, y, _ in _line(random, STEPS[:3])]
    legs = tuple(Distance(a, b, Fraction(9)) for a, b in zip(line, line[::-1], strict=True))
    assert mobility(ForwardProblem(legs, motion=PLANAR)) is None, "in the plane nothing turns about a line"


@pytest.mark.parametrize("factor", [Fraction(1, 2), Fraction(3, 2)])
def test_similar_hexagons_on_a_conic_are_named(factor: Fraction) -> None:
    circle = ((3, 4, 5), (5, 0, 5), (-3, 4, 5), (-5, 0, 5), (5, -12, 13), (-4, -3, 5))
    base = [(Fraction(x, r), Fraction(y, r), Fraction(0)) for x, y, r in circle]
    platform = [(factor * x, -factor * y, Fraction(1)) for x, y, _ in base]
    robot = placed(base, platform, (Fraction(1), Fraction(0), Fraction(3)), [Fraction(n) for n in (3, 1, 0, 1)])
    found = mobility(robot.problem)
    assert found is not None
    assert (found.rank, found.causes) == (5, (Cause.SIMILAR_ON_CONIC,))
    solution = solve(robot.problem)
    assert solution.claim is Claim.POSITIVE_DIMENSIONAL_PROVED
    assert "conic" in solution.notes[0]
    off = [(base[0][0] + 1, *base[0][1:]), *base[1:]]
    twin = [(factor * x, -factor * y, Fraction(1)) for x, y, _ in off]
    squares = [Fraction(9)] * 6
    assert mobility(ForwardProblem(tuple(map(Distance, off, twin, squares)))) is None


def _rejected(content: dict[str, Any], reason: str) -> None:
    answer = check_resealed(content)
    assert (answer.status, last_line(answer).partition(":")[0]) == (Status.REJECTED, reason), answer


@pytest.mark.parametrize("shape", ["platform point", "congruent"])
def test_a_planar_self_motion_cannot_be_forged(shape: str) -> None:
    problem = _planar(Random(1), shape, (1, 3, 1))
    content = _certificate(problem, solve(problem))
    assert check_resealed(content).status is Status.ACCEPTED
    reason = "claim" if content["krawczyk"] is None else "complex solutions"
    _rejected(content | {"distinct_solutions": 1}, reason)
    _rejected(content | {"elimination": []}, "claim")
    content["robot"]["platform"][1] = ["41", "7/3", "0"]
    _rejected(content, "legs")


def test_witnesses_of_a_planar_robot_that_does_not_move_are_rejected() -> None:
    problem = _planar(Random(2), "general", (1, 1, 1))
    none: dict[str, Any] = {"poses": [], "real_poses": 0, "complex_solutions": 0, "distinct_solutions": 0}
    none |= {"completeness_route": None, "elimination": None, "claim": "positive-dimensional-proved"}
    _rejected(_certificate(problem, solve(problem)) | none, "claim")


def test_a_platform_line_is_no_self_motion_of_a_planar_robot() -> None:
    """In the plane a platform with collinear joints has finitely many poses; the checker must not take it to turn."""
    random = Random(3)
    platform = [(x, y, Fraction(0)) for x, y, _ in _line(random, STEPS[:3])]
    base = [_flat(random) for _ in range(3)]
    straight = turn_of((Fraction(1), Fraction(0)), (1, 1, 1))
    squares = [distance_squared(a, b, ORIGIN, straight) for a, b in zip(base, platform, strict=True)]
    problem = ForwardProblem(tuple(map(Distance, base, platform, squares)), motion=PLANAR)
    solution = solve(problem)
    assert (solution.claim, solution.complex_solutions) == (Claim.COMPLETE, 6)
    none: dict[str, Any] = {"poses": [], "real_poses": 0, "complex_solutions": 0, "distinct_solutions": 0}
    none |= {"completeness_route": None, "elimination": None, "claim": "positive-dimensional-proved"}
    _rejected(_certificate(problem, solution) | none, "claim")
