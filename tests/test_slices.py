"""More poses than can be isolated: a proof that the poses are infinitely many, and when a real motion is one."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest
from mechanisms import mixed

import pkm_exact
from pkm_exact.certify.build import canonical_bytes, certificate
from pkm_exact.certify.check import check_bytes
from pkm_exact.claim import Claim, RealMotion
from pkm_exact.completeness.conditions import Conditions
from pkm_exact.completeness.pose_bound import pose_bound
from pkm_exact.completeness.pose_slices import MorePoses
from pkm_exact.completeness.slices import more_poses
from pkm_exact.engine import solve
from pkm_exact.errors import InternalContradictionError
from pkm_exact.final_checks import consistent
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.policy import Policy
from pkm_exact.solution import Solution

POLICY = Policy(short_proofs=True)
MODEL = Path(__file__).parent / "cases" / "exchanged-hexagons.toml"


def _problem(name: str) -> ForwardProblem:
    robot = pkm_exact.read_robot(MODEL)
    return robot.problem(robot.configuration(name))


@cache
def _heave() -> Solution:
    return solve(_problem("heave"), policy=POLICY)


def _motion() -> MorePoses:
    motion = _heave().self_motion
    assert isinstance(motion, MorePoses)
    return motion


@pytest.mark.parametrize("name", ["surge", "surge and sway"])
def test_the_exchanged_hexagons_move(name: str) -> None:
    motion = more_poses(_problem(name), POLICY)
    assert motion is not None
    assert motion.count > motion.bound == 40
    assert motion.real is RealMotion.PROVED


def test_poses_of_slices_are_exact_and_distinct() -> None:
    motion, problem = _motion(), _problem("heave")
    constants = [found.constant for found in motion.slices]
    assert constants == sorted(set(constants))
    for found in motion.slices:
        assert found.representation.is_verified(motion.problem_of(problem, found))
        assert found.representation.is_verified(problem)


def test_the_claim_is_proved_and_says_why() -> None:
    solution = _heave()
    assert solution.claim is Claim.POSITIVE_DIMENSIONAL_PROVED
    assert solution.real_motion is RealMotion.PROVED
    assert "more than the 40 that can be isolated" in solution.notes[0]
    content = certificate(pkm_exact.read_robot(MODEL), "heave", solution)
    assert content["version"] == 2
    assert check_bytes(canonical_bytes(content)).status == "accepted"


def test_no_more_slices_than_needed_are_kept() -> None:
    motion = _motion()
    for number in range(len(motion.slices)):
        fewer = replace(motion, slices=motion.slices[:number] + motion.slices[number + 1 :])
        assert fewer.real is RealMotion.OPEN


def test_as_many_poses_as_the_bound_prove_nothing() -> None:
    motion = _motion()
    few = replace(motion, slices=motion.slices[: motion.bound // 12])
    assert few.count <= few.bound
    with pytest.raises(InternalContradictionError):
        consistent(replace(_heave(), self_motion=few))


def test_slices_twice_are_a_contradiction() -> None:
    motion = _motion()
    twice = replace(motion, slices=motion.slices + motion.slices[:1])
    with pytest.raises(InternalContradictionError):
        consistent(replace(_heave(), self_motion=twice))


def test_robots_with_finitely_many_poses_have_no_slices() -> None:
    assert more_poses(_problem("yaw"), POLICY) is None


@pytest.mark.slow
def test_surfaces_are_cut_by_a_fixed_form_first() -> None:
    problem = mixed(2, 2)
    motion = more_poses(problem, POLICY)
    assert motion is not None
    assert len(motion.forms) == 2
    fixed = replace(problem, constraints=motion.problem_of(problem, motion.slices[0]).constraints[:5])
    assert motion.bound == pose_bound(Conditions.of(fixed)).least
    assert motion.count > motion.bound
