"""Certificates made to deceive: consistent in themselves as far as possible, false in one respect."""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import pytest
from certificate_tools import check_resealed, golden, last_line
from flint import fmpq, fmpq_mat, fmpq_poly, fmpz_poly
from forged_representations import (
    coefficients,
    fit_real_poses,
    representation_through,
    set_representation,
    sliding,
    turning,
)

from pkm_exact import Robot, certificate, solve
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.check import Status
from pkm_exact.certify.checker.document import read
from pkm_exact.certify.checker.multiplicity import dependent_factors


def _assert_rejected(content: dict[str, Any], reason: str) -> None:
    answer = check_resealed(content)
    assert (answer.status, last_line(answer).partition(":")[0]) == (Status.REJECTED, reason), last_line(answer)


# Poses and claims


@pytest.mark.parametrize("name", ["mourrain-l", "robocrane-r"])
@pytest.mark.parametrize("victim", [0, 1, -1])
def test_a_pose_is_dropped_together_with_its_count(name: str, victim: int) -> None:
    content = golden(name)
    del content["poses"][victim]
    content["real_poses"] -= 1
    _assert_rejected(content, "real poses")


def test_a_pose_is_listed_twice() -> None:
    content = golden("mourrain-l")
    content["poses"].insert(1, content["poses"][0])
    content["real_poses"] += 1
    _assert_rejected(content, "real poses")


def test_poses_are_listed_in_another_order() -> None:
    content = golden("mourrain-l")
    content["poses"].reverse()
    _assert_rejected(content, "real poses")


def test_all_poses_are_dropped() -> None:
    content = golden("mourrain-l")
    content["poses"], content["real_poses"] = [], 0
    _assert_rejected(content, "real poses")


def test_two_poses_exchange_their_boxes() -> None:
    content = golden("mourrain-l")
    first, second = content["poses"][:2]
    for key in ("position", "rotation", "quaternion"):
        first[key], second[key] = second[key], first[key]
    _assert_rejected(content, "boxes")


@pytest.mark.parametrize("key", ["position", "quaternion"])
def test_a_box_is_wider_than_its_cell(key: str) -> None:
    content = golden("mourrain-l")
    low, high = (Fraction(end) for end in content["poses"][0][key][0])
    content["poses"][0][key][0] = [str(low - (high - low)), str(high)]
    _assert_rejected(content, "boxes")


def test_the_quaternion_has_the_other_sign() -> None:
    content = golden("mourrain-l")
    pose = content["poses"][0]
    pose["quaternion"] = [[str(-Fraction(high)), str(-Fraction(low))] for low, high in pose["quaternion"]]
    _assert_rejected(content, "boxes")


def test_boxes_of_different_poses_meet() -> None:
    """Two poses 2^-9 apart are in different cells of the grid 2^-10, not of the grid 1."""
    content = sliding(2, step=Fraction(1, 512), box_exponent=0)
    _assert_rejected(content, "boxes")
    assert check_resealed(sliding(2, step=Fraction(1, 512), box_exponent=10)).status is Status.ACCEPTED


@pytest.mark.parametrize("name", ["robocrane-r", "similar-planar-s"])
@pytest.mark.parametrize("route", ["refined-bezout", "exact-elimination"])
@pytest.mark.parametrize("count", [16, 40])
def test_completeness_is_claimed_without_proof(name: str, route: str, count: int) -> None:
    claimed = {"claim": "complete", "completeness_route": route, "complex_solutions": count, "elimination": None}
    _assert_rejected(golden(name) | claimed, "claim")


def test_completeness_is_claimed_by_another_route() -> None:
    _assert_rejected(golden("robocrane-r") | {"completeness_route": "refined-bezout"}, "claim")
    _assert_rejected(golden("mourrain-l") | {"completeness_route": "exact-elimination"}, "claim")


@pytest.mark.parametrize("name", ["mourrain-l", "robocrane-r"])
def test_the_claim_is_weaker_than_the_proof(name: str) -> None:
    _assert_rejected(golden(name) | {"claim": "not-proven-complete", "completeness_route": None}, "claim")


@pytest.mark.parametrize("claim", ["positive-dimensional-detected", "positive-dimensional-proved", "inconsistent"])
def test_another_claim_beside_solutions(claim: str) -> None:
    _assert_rejected(golden("robocrane-r") | {"claim": claim}, "claim")


# Eliminations


def test_without_its_proof_a_list_is_not_proven_complete() -> None:
    weaker = {"claim": "not-proven-complete", "completeness_route": None, "elimination": None}
    assert check_resealed(golden("robocrane-r") | weaker).status is Status.ACCEPTED


@pytest.mark.parametrize("name", ["robocrane-r", "similar-planar-s"])
def test_an_elimination_stops_early(name: str) -> None:
    content = golden(name)
    content["elimination"].pop()
    _assert_rejected(content, "elimination")
    _assert_rejected(content | {"elimination": []}, "elimination")


@pytest.mark.parametrize("product", ["999 0", "0 10", "100000"])
def test_an_elimination_uses_what_there_is_not(product: str) -> None:
    content = golden("similar-planar-s")
    content["elimination"][0][0] = product
    _assert_rejected(content, "elimination")


def test_the_elimination_is_that_of_another_robot() -> None:
    content = golden("robocrane-r")
    content["elimination"] = golden("similar-planar-s")["elimination"]
    _assert_rejected(content, "elimination")


def test_solutions_are_counted_as_double_that_are_not() -> None:
    content = golden("robocrane-r")
    for pose in content["poses"]:
        pose["multiplicity"] = 2
    _assert_rejected(content, "multiplicity")
    _assert_rejected(content | {"complex_solutions": 32}, "complex solutions")


def test_a_robot_with_poses_is_called_inconsistent() -> None:
    content = golden("robocrane-r") | {"claim": "inconsistent", "representation": None, "poses": []}
    content |= {"complex_solutions": 0, "distinct_solutions": 0, "real_poses": 0}
    _assert_rejected(content, "elimination")
    _assert_rejected(content | {"elimination": None}, "claim")
    _assert_rejected(content | {"completeness_route": None}, "claim")


def test_a_robot_without_poses_is_inconsistent() -> None:
    """Two legs between the same joints, of different lengths: the echelon form of the legs says 1 = 0."""
    content = golden("robocrane-r") | {"claim": "inconsistent", "representation": None, "poses": [], "elimination": []}
    content["box_exponent"] = 0
    content |= {"complex_solutions": 0, "distinct_solutions": 0, "real_poses": 0}
    for side in ("base", "platform"):
        content["robot"][side][1] = content["robot"][side][0]
    answer = check_resealed(content)
    assert answer.status is Status.ACCEPTED
    assert "inconsistent" in last_line(answer)


# Polynomials


def test_the_polynomials_are_those_of_another_robot() -> None:
    content, other = golden("mourrain-l"), golden("dietmaier")
    for key in ("representation", "poses", "real_poses", "box_exponent"):
        content[key] = other[key]
    _assert_rejected(content, "legs")


def test_the_joint_of_one_leg_is_another() -> None:
    content = golden("mourrain-l")
    content["robot"]["base"][5] = ["3", "0", "0"]
    _assert_rejected(content, "legs")


@pytest.mark.parametrize("metric", [["1", "1", "1"], ["2", "6", "2"], ["3", "1", "1"]])
def test_the_metric_is_another(metric: list[str]) -> None:
    content = golden("robocrane-r")
    content["robot"]["metric"] = metric
    _assert_rejected(content, "legs")


def test_the_eliminant_is_squared() -> None:
    content = golden("robocrane-r")
    part = content["representation"]
    h = fmpz_poly([int(c, 16) for c in part["eliminant"]])
    for key in ("quaternion", "translation"):
        part[key] = [coefficients((2 * h * fmpz_poly([int(c, 16) for c in row])).coeffs()) for row in part[key]]
    part["eliminant"] = coefficients((h * h).coeffs())
    content["distinct_solutions"] = content["complex_solutions"] = 32
    _assert_rejected(content, "eliminant")


def test_the_eliminant_is_multiplied_by_a_factor() -> None:
    content = golden("robocrane-r")
    h = fmpz_poly([int(c, 16) for c in content["representation"]["eliminant"]])
    content["representation"]["eliminant"] = coefficients((h * fmpz_poly([-5, 1])).coeffs())
    content["distinct_solutions"] = content["complex_solutions"] = 17
    _assert_rejected(content, "chart")


def test_the_eliminant_has_degree_above_forty() -> None:
    content = golden("mourrain-l")
    h = fmpz_poly([int(c, 16) for c in content["representation"]["eliminant"]])
    content["representation"]["eliminant"] = coefficients((h * fmpz_poly([-5, 1])).coeffs())
    _assert_rejected(content, "eliminant")


@pytest.mark.parametrize("factor", [-1, 2, 3 * 2**62 + 1])
def test_all_polynomials_are_multiplied_by_a_number(factor: int) -> None:
    content = golden("robocrane-r")
    part = content["representation"]
    part["eliminant"] = [hex(factor * int(c, 16)) for c in part["eliminant"]]
    for key in ("quaternion", "translation"):
        part[key] = [[hex(factor * int(c, 16)) for c in row] for row in part[key]]
    _assert_rejected(content, "eliminant")


def test_a_numerator_is_changed_by_a_multiple_of_the_eliminant() -> None:
    content = golden("robocrane-r")
    part = content["representation"]
    h = fmpz_poly([int(c, 16) for c in part["eliminant"]])
    part["translation"][0] = coefficients((h + fmpz_poly([int(c, 16) for c in part["translation"][0]])).coeffs())
    _assert_rejected(content, "representation")


def test_the_eliminant_is_replaced_by_a_factor() -> None:
    """Some of the solutions, represented correctly, are fewer; they cannot be counted as all, or as complete."""
    content, some = golden("similar-planar-s"), golden("similar-planar-s")
    part = content["representation"]
    h, *numerators = (
        fmpq_poly([int(c, 16) for c in row]) for row in (part["eliminant"], *part["quaternion"], *part["translation"])
    )
    factor = min((factor for factor, _ in fmpz_poly([int(c, 16) for c in part["eliminant"]]).factor()[1]), key=len)
    g = fmpq_poly(factor)
    assert 0 < g.degree() < h.degree()
    _, inverse, _ = (h.derivative() % g).xgcd(g)
    smaller = [numerator * inverse % g * g.derivative() % g for numerator in numerators]
    set_representation(some, [g, *smaller], part["separating_form"])
    fit_real_poses(some, 1)
    assert check_resealed(some).status is Status.ACCEPTED
    _assert_rejected(some | {"distinct_solutions": 16}, "distinct solutions")
    _assert_rejected(some | {"complex_solutions": 16}, "complex solutions")
    _assert_rejected(some | {"claim": "complete", "completeness_route": "refined-bezout"}, "claim")
    _assert_rejected(some | {"poses": content["poses"], "real_poses": content["real_poses"]}, "real poses")
    part["eliminant"] = coefficients(factor.coeffs())
    _assert_rejected(content, "representation")


def test_one_pose_is_listed_under_forty_parameters() -> None:
    """A rational pose is a solution at every root of any h; only the separating form shows that it is one pose."""
    content = golden("similar-planar-s")
    e = (Fraction(1), Fraction(1, 5), Fraction(-2, 5), Fraction(1, 5))
    c = (Fraction(1, 2), Fraction(-1, 3), Fraction(7, 4))
    f = (
        -(c[0] * e[1] + c[1] * e[2] + c[2] * e[3]),
        c[0] + c[1] * e[3] - c[2] * e[2],
        c[1] + c[2] * e[1] - c[0] * e[3],
        c[2] + c[0] * e[2] - c[1] * e[1],
    )
    alone = representation_through([Fraction(1, 5)], [(e, f)])
    set_representation(content, alone, (0, 1, 0, 0, 0, 0, 0, 0))
    fit_real_poses(content, 1)
    assert check_resealed(content).status is Status.ACCEPTED
    forty = representation_through([Fraction(n) for n in range(40)], [(e, f)] * 40)
    set_representation(content, forty, (0, 1, 0, 0, 0, 0, 0, 0))
    content |= {"claim": "complete", "completeness_route": "refined-bezout"}
    _assert_rejected(content, "separating form")


def test_e_and_f_are_no_motion() -> None:
    """The translation coordinates of a sliding platform, with f0 = 1 where it must be 0."""
    content = sliding(1)
    content["representation"]["translation"][0] = ["0x1"]
    _assert_rejected(content, "motion")


def test_n_of_e_is_zero() -> None:
    """e = (1, i, 0, 0), f = 0 makes every form of a leg without metric vanish at a joint in the origin."""
    content = sliding(2)
    content["robot"]["platform"] = content["robot"]["base"] = [["0", "0", "0"]] * 6
    h = fmpq_poly([1, 0, 1])
    slope = fmpq_poly([0, 2])
    zero = fmpq_poly()
    set_representation(content, [h, slope, fmpq_poly([-2]), zero, zero, zero, zero, zero, zero], (0, 1, *[0] * 6))
    _assert_rejected(content, "motion")


# Self-motions


def test_forty_points_of_a_self_motion_are_not_all() -> None:
    content = sliding(40)
    answer = check_resealed(content)
    assert answer.status is Status.ACCEPTED
    assert "not proven complete: 40 solutions are proved, others are not excluded" in answer.lines
    assert any("not proved that all are simple" in line for line in answer.lines)
    claimed = {"claim": "complete", "completeness_route": "refined-bezout"}
    _assert_rejected(content | claimed, "claim")
    for pose in content["poses"]:
        pose["multiplicity"] = 1
    _assert_rejected(content, "multiplicity")
    _assert_rejected(content | claimed, "claim")


def _moving(kind: str) -> dict[str, Any]:
    """The certificate of a robot that is proved to move: a solver's, of congruent halves or of similar hexagons."""
    circle = ((3, 4, 5), (5, 0, 5), (-3, 4, 5), (-5, 0, 5), (5, -12, 13), (-4, -3, 5))
    base = tuple((Fraction(x, r), Fraction(y, r), Fraction(0)) for x, y, r in circle)
    if kind == "congruent":
        robot = Robot("moving", "6-UPS", "1", "made up", base, tuple((-x, -y, z) for x, y, z in base), (1, 3, 1))
        return certificate(robot, None, solve(robot.problem([Fraction(5)] * 6)))
    robot = Robot("moving", "6-UPS", "1", "made up", base, tuple((x / 2, y / 2, z) for x, y, z in base))
    squares = [  # at C = (0, 0, 2) and R by the angle with cosine 4/5 about the third axis
        (Fraction(2, 5) * x - Fraction(3, 10) * y - x) ** 2 + (Fraction(3, 10) * x + Fraction(2, 5) * y - y) ** 2 + 4
        for x, y, _ in base
    ]
    return certificate(robot, None, solve(robot.problem(squares)))


@pytest.mark.parametrize("kind", ["congruent", "similar"])
def test_self_motions_are_certified(kind: str) -> None:
    content = _moving(kind)
    assert content["claim"] == "positive-dimensional-proved"
    answer = check_resealed(content)
    assert answer.status is Status.ACCEPTED
    assert last_line(answer).startswith("positive dimension: ")
    _assert_rejected(content | {"distinct_solutions": 2}, "claim")
    _assert_rejected(content | {"elimination": []}, "claim")
    _assert_rejected(content | {"completeness_route": "refined-bezout"}, "claim")
    _assert_rejected(content | {"claim": "inconsistent", "elimination": []}, "real poses")
    content["configuration"]["lengths_squared"][0] = "6"
    _assert_rejected(content, "legs")


def test_witnesses_of_a_robot_that_does_not_move() -> None:
    none = {"poses": [], "real_poses": 0, "complex_solutions": 0, "distinct_solutions": 0, "completeness_route": None}
    content = golden("mourrain-l") | none | {"claim": "positive-dimensional-proved"}
    _assert_rejected(content, "claim")
    _assert_rejected(content | {"representation": None}, "claim")


@pytest.mark.parametrize("count", [39, 41])
def test_the_number_with_multiplicity_is_not_less_than_distinct_and_at_most_forty(count: int) -> None:
    _assert_rejected(sliding(40) | {"complex_solutions": count}, "complex solutions")


# Multiple solutions


def _singular_robot() -> Robot:
    """Mourrain's robot with another base joint 6: at C = 0, R = 1 its sixth leg lies in the complex of the others."""
    base = [(0, 0, 0), (1, -1, -2), (3, -1, -2), (3, 1, -2), (Fraction(2, 3), 1, -2)]
    platform = [(0, 0, 2), (2, 0, 2), (0, 2, 2), (-2, 0, 2), (0, -2, 0), (2, 2, 2)]
    legs = [[y - x for x, y in zip(a, b, strict=True)] for a, b in zip(base, platform, strict=False)]
    rows = [[*d, *_cross(b, d)] for d, b in zip(legs, platform, strict=False)]
    turn = _null_vector(rows)
    normal = [x + y for x, y in zip(turn[:3], _cross(turn[3:], platform[5]), strict=True)]
    leg = _cross(normal, (1, 2, 5))
    size = max(map(abs, leg))
    base.append(tuple(b - 2 * x / size for b, x in zip(platform[5], leg, strict=True)))
    return Robot("singular", "6-UPS", "1", "made up", tuple(base), tuple(platform))


def _cross(u: Sequence[Any], v: Sequence[Any]) -> list[Any]:
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def _null_vector(rows: Sequence[Sequence[Any]]) -> list[Fraction]:
    """The vector that a 5 x 6 matrix of rank 5 takes to 0, last entry 1."""
    entries = [fmpq(Fraction(x).numerator, Fraction(x).denominator) for row in rows for x in row]
    matrix = fmpq_mat(5, 6, entries)
    left = fmpq_mat(5, 5, [matrix[i, j] for i in range(5) for j in range(5)])
    right = fmpq_mat(5, 1, [-matrix[i, 5] for i in range(5)])
    solution = left.solve(right)
    return [Fraction(int(solution[i, 0].p), int(solution[i, 0].q)) for i in range(5)] + [Fraction(1)]


def _at_identity(robot: Robot) -> list[Fraction]:
    return [
        sum(((y - x) ** 2 for x, y in zip(a, b, strict=True)), Fraction(0))
        for a, b in zip(robot.base_joints, robot.platform_joints, strict=True)
    ]


def test_a_singular_pose_is_not_simple() -> None:
    robot = _singular_robot()
    content = golden("mourrain-l")
    content["robot"]["base"] = [[str(x) for x in joint] for joint in robot.base_joints]
    content["robot"]["platform"] = [[str(x) for x in joint] for joint in robot.platform_joints]
    content["configuration"]["lengths_squared"] = [str(x) for x in _at_identity(robot)]
    unit = (Fraction(1), Fraction(0), Fraction(0), Fraction(0))
    identity = representation_through([Fraction(1)], [(unit, (Fraction(0),) * 4)])
    set_representation(content, identity, (1, 0, 0, 0, 0, 0, 0, 0))
    fit_real_poses(content, None)
    assert check_resealed(content).status is Status.ACCEPTED
    assert check_resealed(content | {"complex_solutions": 40}).status is Status.ACCEPTED
    for multiplicity in (1, 2):
        fit_real_poses(content, multiplicity)
        _assert_rejected(content, "multiplicity")
    document = read(canonical_bytes(sealed(content)))
    assert document.representation is not None
    (factor,) = dependent_factors(document.representation, document.legs, document.metric)
    assert factor == document.representation.eliminant


@pytest.mark.slow
def test_a_double_solution_is_certified_as_double() -> None:
    robot = _singular_robot()
    content = certificate(robot, None, solve(robot.problem(_at_identity(robot))))
    assert (content["claim"], content["complex_solutions"], content["distinct_solutions"]) == ("complete", 40, 39)
    assert sorted(pose["multiplicity"] for pose in content["poses"]) == [1, 1, 2]
    answer = check_resealed(content)
    assert answer.status is Status.ACCEPTED
    assert any("39 distinct, 40 with multiplicity" in line for line in answer.lines)
    _assert_rejected(content | {"complex_solutions": 39}, "complex solutions")
    for pose in content["poses"]:
        pose["multiplicity"] = 1
    _assert_rejected(content, "multiplicity")


def test_roots_too_close_to_tell_apart_are_given_up() -> None:
    """A platform free to turn about an axis is at any angle; 12 of them, two 2^-24000 apart, cost no endless work."""
    answer = check_resealed(turning(fmpz_poly([0] * 12 + [1]) - 2 * fmpz_poly([-1, 3 * 2**4000]) ** 2))
    assert answer.status is Status.TOO_LARGE
    assert last_line(answer) == "real poses: the roots are not told apart by 4096 bits"
