"""Certificates of version 2, as they are built: the schema, both versions side by side, and what the checker says."""

from __future__ import annotations

import json
from fractions import Fraction
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from certificate_tools import golden
from mechanisms import cylinder_and_planes, cylinders, h4, mixed, point_and_spheres, pssc, three_rps

import pkm_exact
from pkm_exact.certify.build import canonical_bytes, certificate
from pkm_exact.certify.certified_machine import certified_machine, certified_problem, certified_squares
from pkm_exact.certify.check import check_bytes
from pkm_exact.certify.legs_view import legs_view
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.engine import solve
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.robot import Robot
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.pictures.scene import scene_of
from pkm_exact.policy import Policy
from pkm_exact.recomputation import recompute
from pkm_exact.report_page.page import report_page
from pkm_exact.solution import Solution

ROOT = Path(__file__).parent.parent
POLICY = Policy(short_proofs=True)


@cache
def _schema() -> jsonschema.Draft202012Validator:
    text = resources.files("pkm_exact.certify").joinpath("certificate-2.schema.json").read_text("utf-8")
    return jsonschema.Draft202012Validator(json.loads(text))


def _machine(problem: ForwardProblem) -> Mechanism:
    named = []
    for number, constraint in enumerate(problem.constraints, 1):
        data = {field: getattr(constraint, field) for field in constraint.fields}
        named.append(type(constraint)(**data, name=f"constraint {number}"))
    return Mechanism("mechanism", "1", "made up", tuple(named), motion=problem.motion, metric=problem.metric)


def _solved(problem: ForwardProblem) -> tuple[Mechanism, Solution]:
    machine = _machine(problem)
    return machine, solve(machine.problem(machine.configuration()))


def _accepted(content: dict[str, Any]) -> None:
    _schema().validate(content)
    verdict = check_bytes(canonical_bytes(content))
    assert verdict.status == "accepted", verdict


@pytest.mark.parametrize(
    ("problem", "route"),
    [
        (three_rps(), "counting-at-infinity"),
        (h4(), "refined-bezout"),
        (cylinders(), "product-bound"),
        (cylinder_and_planes(), "product-bound"),
        (point_and_spheres(), "modular-rank"),
        (mixed(0, 6), "product-bound"),
        (pssc((Fraction(0),) * 3), "exact-elimination"),
    ],
)
def test_mechanisms_are_certified(problem: ForwardProblem, route: str) -> None:
    machine, solution = _solved(problem)
    content = certificate(machine, "home", solution)
    assert (content["version"], content["completeness_route"]) == (2, route)
    assert (content["infinity"] is not None) == (route == "counting-at-infinity")
    assert (content["elimination"] is not None) == (route == "exact-elimination")
    _accepted(content)


def test_contradictory_constraints_are_certified() -> None:
    problem = h4()
    first = problem.constraints[0]
    machine = _machine(ForwardProblem((*problem.constraints, first), problem.metric, problem.motion))
    changed = {field: getattr(first, field) for field in first.fields} | {"length_squared": Fraction(5291)}
    wrong = Mechanism(
        "wrong",
        "1",
        "made up",
        (*machine.constraints[:-1], type(first)(**changed, name="other")),
        motion=problem.motion,
    )
    solution = solve(wrong.problem(wrong.configuration()))
    content = certificate(wrong, "home", solution)
    assert (content["claim"], content["completeness_route"]) == ("inconsistent", "modular-rank")
    _accepted(content)
    redundant = solve(machine.problem(machine.configuration()))
    content = certificate(machine, "home", redundant)
    assert (content["claim"], content["complex_solutions"]) == ("complete", 8)
    _accepted(content)


def test_a_point_in_two_parallel_planes_is_nowhere() -> None:
    # 1 is among the linear forms, and without it the others have poses.
    zero, one = Fraction(0), Fraction(1)
    planes = tuple(InPlane((zero, zero, one), offset, (zero, zero, zero), name=str(offset)) for offset in (zero, one))
    machine = Mechanism("parallel planes", "1", "made up", planes, motion=three_rps().motion)
    content = certificate(machine, "home", solve(machine.problem(machine.configuration())))
    assert (content["claim"], content["completeness_route"]) == ("inconsistent", "modular-rank")
    _accepted(content)


@pytest.mark.parametrize(("problem", "count"), [(h4(), 3), (mixed(1, 1, 1), 3), (cylinders(), 2)])
def test_mechanisms_with_freedoms_are_certified_to_move(problem: ForwardProblem, count: int) -> None:
    machine, solution = _solved(ForwardProblem(problem.constraints[:count], problem.metric, problem.motion))
    content = certificate(machine, "home", solution)
    assert content["claim"] == "positive-dimensional-proved"
    assert (content["self_motion"]["cause"], content["self_motion"]["real"]) == ("dependent-forms", True)
    _accepted(content)


@pytest.mark.parametrize("name", ["hexaglide", "robocrane-r"])
def test_robots_with_shorter_proofs_need_version_2(name: str) -> None:
    robot = pkm_exact.read_robot(ROOT / "models" / f"{name}.toml")
    problem = robot.problem(robot.configuration())
    solution = solve(problem, policy=POLICY)
    content = certificate(robot, robot.configuration().name, solution)
    old = golden(name)
    assert (old["version"], content["version"]) == (1, 2)
    assert content["completeness_route"] == "counting-at-infinity"
    same = ("claim", "complex_solutions", "distinct_solutions", "poses", "representation")
    assert all(content[key] == old[key] for key in same)
    _accepted(content)


@pytest.mark.parametrize("problem", [three_rps(), mixed(0, 6)])
def test_boxes_stand_beside_exact_points_at_infinity(problem: ForwardProblem) -> None:
    machine = _machine(problem)
    solution = solve_krawczyk(machine.problem(machine.configuration()))
    content = certificate(machine, "home", solution)
    assert content["method"] == "krawczyk"
    assert content["representation"] is None
    assert content["claim"] == "complete"
    _accepted(content)


def test_boxes_of_a_robot_with_symmetries_need_no_representation() -> None:
    robot = pkm_exact.read_robot(ROOT / "models" / "hexaglide.toml")
    solution = solve_krawczyk(robot.problem(robot.configuration()), policy=POLICY)
    assert (solution.method, solution.completeness_route) == ("krawczyk", "counting-at-infinity")
    _accepted(certificate(robot, "home", solution))


def test_a_solution_of_another_mechanism_is_refused() -> None:
    machine, solution = _solved(h4())
    other = _machine(three_rps())
    with pytest.raises(ValueError, match="constraints or metric differ"):
        certificate(other, "home", solution)
    assert certificate(machine, None, solution)["configuration"] is None


@pytest.mark.parametrize("name", ["hexaglide", "robocrane-r"])
def test_robots_with_legs_are_shown_and_solved_again_from_version_2(name: str) -> None:
    robot = pkm_exact.read_robot(ROOT / "models" / f"{name}.toml")
    solution = solve(robot.problem(robot.configuration()), policy=POLICY)
    content = certificate(robot, "home", solution)
    assert content["version"] == 2
    machine = certified_machine(content)
    assert isinstance(machine, Robot)
    assert machine.problem(certified_squares(content)) == solution.problem == certified_problem(content)
    view = legs_view(content)
    old = golden(name)
    assert view["robot"] == old["robot"]
    assert view["configuration"] == old["configuration"]
    assert scene_of(content) == scene_of(old)
    assert recompute(canonical_bytes(content), policy=POLICY).outcome == "same bytes"
    assert "points at infinity" in report_page(content, ("accepted",), "cert.json")


def test_mechanisms_are_solved_again() -> None:
    machine, solution = _solved(point_and_spheres())
    content = certificate(machine, "home", solution)
    again = certified_machine(content)
    assert isinstance(again, Mechanism)
    assert again.constraints == machine.constraints
    assert recompute(canonical_bytes(content)).outcome == "same bytes"
