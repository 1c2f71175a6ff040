"""One body for all formulations: the equations hold at a known pose, and the solution leads back to it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import product
from random import Random
from typing import Any

import pytest
from samples import METRICS, Placed, placed, random_placed, random_vector, shipped

from pkm_exact.errors import InputError
from pkm_exact.formulations.registry import formulation, formulation_codes
from pkm_exact.geometry.rotation import quaternion_norm, scaled_rotation
from pkm_exact.geometry.study import translation_coordinates
from pkm_exact.policy import Policy
from pkm_exact.poses.modular_start import StartSearch
from pkm_exact.stages import Stages

Metric = tuple[int, int, int]
Values = dict[str, Fraction]
SEEDS = range(4)

# Tangents of half the angles of an Euler rotation.
TANGENTS = [Fraction(1, 2), Fraction(-2, 3), Fraction(5, 4), Fraction(3, 7)]


def _value(polynomial: Any, values: Mapping[str, Fraction], names: tuple[str, ...]) -> Fraction:
    """A polynomial over Z or Q at a rational point."""
    total = Fraction(0)
    for exponents, coefficient in polynomial.to_dict().items():
        term = Fraction(str(coefficient))
        for name, exponent in zip(names, exponents, strict=True):
            if exponent:
                term *= values[name] ** int(exponent)
        total += term
    return total


def _unit_quaternion(random: Random, metric: Metric) -> tuple[Fraction, ...]:
    """A random rational e with N(e) = 1."""
    while True:
        e = [Fraction(random.randint(-5, 5)) for _ in range(4)]
        norm = quaternion_norm([[a * b for b in e] for a in e], metric)
        length = next((k for k in range(1, 40) if k * k == norm), 0)
        if length:
            return tuple(value / length for value in e)


def _matrix_values(robot: Placed, metric: Metric) -> Values:
    c, r = robot.position, robot.rotation
    turned = [sum(r[i][j] * metric[i] * c[i] for i in range(3)) / metric[j] for j in range(3)]
    values = {f"c{i + 1}": c[i] for i in range(3)} | {f"u{j + 1}": turned[j] for j in range(3)}
    values["s"] = sum((g * x * x for g, x in zip(metric, c, strict=True)), Fraction(0))
    return values | {f"r{i + 1}{j + 1}": r[i][j] for i in range(3) for j in range(3)}


def _point_values(robot: Placed, metric: Metric) -> Values:
    values = {}
    for number, leg in enumerate(robot.problem.distances, 1):
        for i, axis in enumerate("xyz"):
            turned = sum((a * b for a, b in zip(robot.rotation[i], leg.platform, strict=True)), Fraction(0))
            values[f"{axis}{number}"] = robot.position[i] + turned
    return values


def _at_quaternion(unknowns: Callable[[Placed, Metric], Values]) -> Callable[[Random, Metric], tuple[Placed, Values]]:
    """A robot at a random rational rotation, with the values of the unknowns there."""

    def case(random: Random, metric: Metric) -> tuple[Placed, Values]:
        e = _unit_quaternion(random, metric)
        robot = random_placed(random, e, metric)
        values = {f"{name}{k}": e[k] for name in "qe" for k in range(4)}
        f = translation_coordinates([[c * value for value in e] for c in robot.position], metric)
        values |= {f"f{k}": value for k, value in enumerate(f)}
        return robot, values | unknowns(robot, metric)

    return case


def _at_euler_angles(random: Random, metric: Metric) -> tuple[Placed, Values]:
    """A robot at a product of three rotations about z, y, x with rational half-angle tangents (times sqrt(g_j g_k))."""
    values: Values = {}
    quaternion = [Fraction(1), Fraction(0), Fraction(0), Fraction(0)]
    for number, axis in enumerate((2, 1, 0), 1):
        j, k = (axis + 1) % 3, (axis + 2) % 3
        t = random.choice(TANGENTS)
        weight = Fraction(1, metric[j] * metric[k])
        values[f"t{number}"] = t
        values[f"y{number}"] = 1 / (1 + weight * t * t)
        values[f"z{number}"] = t * values[f"y{number}"]
        values[f"cos{number}"] = 2 * values[f"y{number}"] - 1
        values[f"sin{number}"] = 2 * values[f"z{number}"]
        # Ordinary tangent t / sqrt(g_j g_k), and q = (sqrt(g1 g2 g3) e0, sqrt(g_i) e_i): e_i / e0 = t.
        factor = [Fraction(1), *(t if i == axis else Fraction(0) for i in range(3))]
        quaternion = _composed(quaternion, factor, metric)
    robot = random_placed(random, quaternion, metric)
    return robot, values | {f"c{i + 1}": robot.position[i] for i in range(3)}


def _composed(p: list[Fraction], q: list[Fraction], metric: Metric) -> list[Fraction]:
    """Quaternion product in rational coordinates, up to the factor sqrt(g1 g2 g3)."""
    g = metric
    volume = g[0] * g[1] * g[2]
    scalar = volume * p[0] * q[0] - sum(g[i] * p[i + 1] * q[i + 1] for i in range(3))
    result = [scalar / volume]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        mixed = p[0] * q[i + 1] + p[i + 1] * q[0]
        result.append(mixed + (p[j + 1] * q[k + 1] - p[k + 1] * q[j + 1]) / g[i])
    return result


_MATRIX, _POINTS = _at_quaternion(_matrix_values), _at_quaternion(_point_values)
CASES = {
    "SE3": _MATRIX,
    "AFD1": _at_euler_angles,
    "AFD2": _at_euler_angles,
    "AFD3": _MATRIX,
    "AFD4": _MATRIX,
    "AFD5": _MATRIX,
    "AFD6": _MATRIX,
    "AFP1": _POINTS,
    "AFP2": _POINTS,
    "AFP3": _POINTS,
    "AFP4": _POINTS,
}


def test_every_formulation_has_a_case() -> None:
    assert set(formulation_codes()) <= set(CASES)
    assert formulation_codes()[0] == "SE3"


@pytest.mark.parametrize("metric", METRICS, ids=str)
@pytest.mark.parametrize("code", formulation_codes())
def test_the_equations_hold_at_a_known_pose(code: str, metric: Metric) -> None:
    for seed in SEEDS:
        robot, values = CASES[code](Random(seed), metric)
        formulated = formulation(code).formulate(robot.problem)
        for equations in (formulated.system, formulated.branches[0]):
            assert len(equations.polynomials) >= len(equations.unknowns)
            for polynomial in equations.polynomials:
                assert _value(polynomial, values, equations.unknowns) == 0
        for condition in formulated.conditions:
            assert _value(condition, values, formulated.branches[0].unknowns) == 0


@pytest.mark.parametrize("metric", METRICS, ids=str)
@pytest.mark.parametrize("code", formulation_codes())
def test_the_solution_leads_back_to_the_pose(code: str, metric: Metric) -> None:
    for seed in SEEDS:
        robot, values = CASES[code](Random(seed), metric)
        formulated = formulation(code).formulate(robot.problem)
        unknowns = formulated.branches[0].unknowns
        position = tuple(_value(entry, values, unknowns) for entry in formulated.pose_map.position)
        assert position == robot.position
        products = [
            [_value(entry, values, unknowns) for entry in row] for row in formulated.pose_map.quaternion_products
        ]
        norm = quaternion_norm(products, metric)
        assert norm != 0
        rotation = tuple(tuple(entry / norm for entry in row) for row in scaled_rotation(products, metric))
        assert rotation == robot.rotation
        for k, m in product(range(4), repeat=2):
            assert products[k][m] == products[m][k]
            assert products[k][k] * products[m][m] == products[k][m] ** 2


@pytest.mark.parametrize("code", formulation_codes())
def test_another_length_is_not_met(code: str) -> None:
    _, values = CASES[code](Random(1), (1, 1, 1))
    other = random_placed(Random(2), (Fraction(1), Fraction(0), Fraction(0), Fraction(0)), (1, 1, 1))
    system = formulation(code).formulate(other.problem).system
    assert any(_value(polynomial, values, system.unknowns) != 0 for polynomial in system.polynomials)


@pytest.mark.parametrize("code", [code for code in formulation_codes() if code.startswith("AFP")])
def test_collinear_platform_joints_are_refused(code: str) -> None:
    random = Random(3)
    line = [(Fraction(k), Fraction(2 * k), Fraction(1)) for k in range(6)]
    one, zero = Fraction(1), Fraction(0)
    robot = placed([random_vector(random) for _ in line], line, (one, one, one), (one, zero, zero, one))
    with pytest.raises(InputError, match=r"platform\.joints: all platform joints lie on one line"):
        formulation(code).formulate(robot.problem)


@pytest.mark.parametrize("code", [code for code in formulation_codes() if code.startswith("AFP")])
def test_other_joints_are_taken_where_the_first_three_are_collinear(code: str) -> None:
    random = Random(4)
    platform = [(Fraction(k), Fraction(0), Fraction(0)) for k in range(3)] + [random_vector(random) for _ in range(3)]
    pose = random_vector(random)
    robot = placed([random_vector(random) for _ in platform], platform, pose, _unit_quaternion(random, (1, 1, 1)))
    formulated = formulation(code).formulate(robot.problem)
    at = _point_values(robot, (1, 1, 1))
    # Joints 1, 2 and 4 span the frame.
    values = at if code == "AFP4" else at | {f"{axis}3": at[f"{axis}4"] for axis in "xyz"}
    for polynomial in formulated.system.polynomials:
        assert _value(polynomial, values, formulated.system.unknowns) == 0
    position = tuple(_value(entry, values, formulated.branches[0].unknowns) for entry in formulated.pose_map.position)
    assert position == robot.position


def test_an_unknown_code_is_refused() -> None:
    with pytest.raises(InputError, match="is unknown; use one of SE3, "):
        formulation("AFD9")


@pytest.mark.parametrize("code", formulation_codes())
def test_lengths_that_contradict_each_other_have_no_solution(code: str) -> None:
    first, _, *others = shipped("mssm").distances
    contradicting = replace(first, length_squared=first.length_squared + 1)
    problem = replace(shipped("mssm"), constraints=(first, contradicting, *others))
    assert StartSearch(problem, code, Policy(), Stages()).started().count == 0
