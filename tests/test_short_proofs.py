"""Completeness without an elimination over Q: bounds, points at infinity, and what must not be concluded."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import chain
from pathlib import Path
from typing import Any

import pytest
from mechanisms import (
    cylinders,
    delta,
    h4,
    line_and_spheres,
    mixed,
    point_and_spheres,
    pssc,
    three_lines,
    three_rps,
    two_ups_u,
)

import pkm_exact
from pkm_exact.algebra.modular_elimination import Elimination
from pkm_exact.algebra.primes import primes_from
from pkm_exact.claim import CompletenessRoute
from pkm_exact.completeness import short_proof as short
from pkm_exact.completeness.closed_section import closed_section
from pkm_exact.completeness.conditions import Conditions
from pkm_exact.completeness.finite_section import is_finite, most_at_infinity
from pkm_exact.completeness.infinity import PointsAtInfinity, is_at_infinity, points_at_infinity, singular_points
from pkm_exact.completeness.modular_rank import modular_rank
from pkm_exact.completeness.pose_bound import pose_bound
from pkm_exact.completeness.rigid_motions import variety_quadrics
from pkm_exact.completeness.short_proof import short_proof
from pkm_exact.policy import Policy

ROOT = Path(__file__).parent.parent
HALF = Fraction(1, 2)
BITS = 1 << 15


def _primes() -> Any:
    return primes_from(1, 62)


def _robot(name: str) -> Conditions:
    robot = pkm_exact.read_robot(ROOT / "models" / f"{name}.toml")
    return Conditions.of(robot.problem(robot.configuration()))


@cache
def _infinity(name: str) -> PointsAtInfinity:
    found = points_at_infinity(_robot(name), _primes(), BITS)
    assert found is not None
    return found


# What the routes prove: the numbers of finite solutions are those of eliminations modulo a prime, and of msolve.


@pytest.mark.parametrize(
    ("problem", "number", "route"),
    [
        (mixed(6, 0), 40, "refined-bezout"),
        (mixed(3, 3), 40, "refined-bezout"),
        (mixed(1, 3, 2), 40, "refined-bezout"),
        (mixed(2, 4), 32, "product-bound"),
        (mixed(2, 0, 4), 32, "product-bound"),
        (mixed(1, 4, 1), 32, "product-bound"),
        (mixed(1, 5), 16, "product-bound"),
        (mixed(0, 5, 1), 16, "product-bound"),
        (mixed(0, 4, 2), 20, "product-bound"),
        (mixed(0, 3, 3), 20, "product-bound"),
        (mixed(0, 6), 8, "product-bound"),
        (three_lines(), 8, "product-bound"),
        (cylinders(), 8, "product-bound"),
        (h4(), 8, "refined-bezout"),
        (delta(), 2, "refined-bezout"),
        (point_and_spheres(), 8, "modular-rank"),
        (two_ups_u(), 8, "modular-rank"),
        (line_and_spheres(), 28, "counting-at-infinity"),
        (three_rps(), 16, "counting-at-infinity"),
        (pssc((Fraction(0), HALF, -HALF / 2)), 24, "counting-at-infinity"),
    ],
)
def test_mechanisms_close_by_their_route(problem: Any, number: int, route: str) -> None:
    conditions = Conditions.of(problem)
    counted = Elimination(closed_section(conditions).system, Policy()).image().dimension
    proof = short_proof(conditions, number, number, Policy())
    assert counted == number
    assert proof is not None
    assert proof.route == CompletenessRoute(route)
    assert short_proof(conditions, number - 1, number - 1, Policy()) is None


@pytest.mark.parametrize("name", ["hexaglide", "mssm", "ssm-exact", "ssm-rounded", "tssm", "linuxcnc-hexapod"])
def test_robots_with_symmetries_close_by_counting(name: str) -> None:
    certificate = json.loads((ROOT / "certs" / f"{name}.json").read_text())
    total = certificate["complex_solutions"]
    found = _infinity(name)
    assert total + found.multiplicity == 40
    assert is_finite(_robot(name), next(_primes()))


def test_where_no_short_way_closes() -> None:
    equal_heights = Conditions.of(pssc((Fraction(0),) * 3))
    assert short_proof(equal_heights, 24, 24, Policy()) is None
    similar = _robot("similar-planar-s")
    assert not is_finite(similar, next(_primes()))
    assert short_proof(similar, 8, 8, Policy()) is None


# Bounds


def test_bounds_see_what_forms_span_and_not_how_they_are_written() -> None:
    problem = mixed(3, 3)
    conditions = Conditions.of(problem)
    first, *others = conditions.forms
    mixed_up = [tuple(a + 3 * b for a, b in zip(first, form, strict=True)) for form in others]
    assert pose_bound(replace(conditions, forms=(first, *mixed_up))) == pose_bound(conditions)


def test_a_cylinder_doubles_the_bounds() -> None:
    conditions = Conditions.of(cylinders())
    assert [pose_bound(replace(conditions, quadrics=conditions.quadrics[:n])).degree for n in range(4)] == [2, 4, 8, 16]


def test_the_bound_of_the_mirror_image_is_not_used_with_cylinders() -> None:
    problem = mixed(1, 0, 5)
    assert pose_bound(Conditions.of(problem)).least == 16
    cylinder = cylinders().constraints[0]
    with_cylinder = replace(problem, constraints=(*problem.constraints[:5], cylinder))
    assert pose_bound(Conditions.of(with_cylinder)).least == 80


# The closed section


def test_a_platform_held_in_a_point_leaves_its_rotation() -> None:
    section = closed_section(Conditions.of(point_and_spheres()))
    assert all(index >= 7 for index in section.unknowns)
    assert len(section.unknowns) == 6


def test_contradictions_of_linear_algebra_are_empty() -> None:
    conditions = Conditions.of(delta())
    first = conditions.forms[0]
    other = conditions.with_forms([(*first[:-1], first[-1] + 1)])
    section = closed_section(other)
    assert section.is_empty
    assert modular_rank(section, next(_primes()), 40) == 0
    proof = short_proof(other, 0, 0, Policy())
    assert proof is not None
    assert proof.route == CompletenessRoute.MODULAR_RANK


def test_a_prime_at_which_a_solution_goes_to_infinity_bounds_nothing() -> None:
    # Translations with p x = 1 and two spheres: modulo p there is no finite solution, over Q there are two.
    prime = next(_primes())
    forms = ((*[0] * 4, prime, *[0] * 11, -1), (1, *[0] * 15, -3), (*[0] * 5, 1, *[0] * 11))
    conditions = Conditions(forms, (), (1, 1, 1), delta().motion)
    assert modular_rank(closed_section(conditions), prime, 40) in (2, None)
    assert modular_rank(closed_section(conditions), prime, 1) is None


# Points at infinity


@pytest.mark.parametrize(("prime", "is_found"), [(3, False), (7, False), (11, True)])
def test_a_first_prime_that_shows_other_points_ends_in_the_points_or_in_none(prime: int, is_found: bool) -> None:
    found = points_at_infinity(_robot("hexaglide"), chain([prime], _primes()), BITS)
    assert (found is not None) == is_found
    assert found is None or (found.univariate.degree, found.multiplicity) == (4, 4)


@pytest.mark.parametrize("first", [[3, 3], [3, 101, 3], [7, 7], [7, 101, 7]])
def test_unlucky_primes_are_not_asked_alone(first: list[int], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(short, "primes_from", lambda *_: chain(first, _primes()))
    proof = short_proof(_robot("hexaglide"), 36, 36, Policy())
    assert proof is not None
    assert proof.infinity is not None
    assert proof.infinity.multiplicity == 4


@pytest.mark.parametrize("name", ["hexaglide", "mssm", "ssm-exact"])
def test_the_bound_for_points_at_infinity_holds(name: str) -> None:
    points = _infinity(name).univariate.degree
    for is_quick in (False, True):
        most = most_at_infinity(_robot(name), next(_primes()), is_quick=is_quick)
        assert most is not None
        assert points <= most <= 40


@pytest.mark.parametrize("name", ["similar-planar-s", "pentapod", "micabo-h"])
def test_curves_at_infinity_have_no_bound_and_points_are_not_looked_for(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert most_at_infinity(_robot(name), next(_primes())) is None
    assert points_at_infinity(_robot(name), _primes(), BITS) is None
    monkeypatch.setattr(short, "points_at_infinity", lambda *_, **__: pytest.fail("looked for points"))
    assert short_proof(_robot(name), 12, 12, Policy()) is None


def test_too_few_points_at_infinity_are_not_looked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(short, "points_at_infinity", lambda *_, **__: pytest.fail("looked for points"))
    assert short_proof(_robot("hexaglide"), 1, 1, Policy()) is None


def test_points_at_infinity_are_verified_exactly() -> None:
    conditions, found = _robot("mssm"), _infinity("mssm")
    univariate = found.univariate
    assert is_at_infinity(found.chart, univariate, conditions)
    other = (found.chart[0] + 1, *found.chart[1:])
    assert not is_at_infinity(other, univariate, conditions)
    assert not is_at_infinity(found.chart, replace(univariate, form=other), conditions)
    first, *rest = univariate.numerators
    moved = replace(univariate, numerators=((first[0] + 1, *first[1:]), *rest))
    assert not is_at_infinity(found.chart, moved, conditions)
    h = (univariate.eliminant[0] + 1, *univariate.eliminant[1:])
    assert not is_at_infinity(found.chart, replace(univariate, eliminant=h), conditions)
    assert not is_at_infinity(found.chart, univariate, _robot("linuxcnc-hexapod"))


def test_points_count_twice_where_rigid_motions_are_singular_only() -> None:
    assert (_infinity("mssm").univariate.degree, _infinity("mssm").singular) == (12, 12)
    assert (_infinity("ssm-exact").univariate.degree, _infinity("ssm-exact").singular) == (12, 0)


@pytest.mark.parametrize("name", ["mssm", "ssm-exact", "hexaglide"])
def test_singular_points_have_a_greater_tangent_space(name: str) -> None:
    """The rank of the derivatives of all quadrics, at a root of h modulo a prime: 10 at regular points, less else."""
    from flint import nmod_mat, nmod_poly

    found, conditions = _infinity(name), _robot(name)
    h = found.univariate
    prime, root = next(
        (p, int(-factor[0] / factor[1]))
        for p in primes_from(1, 31)
        for factor, _ in nmod_poly([value % p for value in h.eliminant], p).factor()[1]
        if factor.degree() == 1
    )
    z = [sum(c * pow(root, k, prime) for k, c in enumerate(numerator)) % prime for numerator in h.numerators] + [0]
    rows = []
    for quadric in variety_quadrics(conditions.metric):
        row = [0] * 17
        for (i, j), value in quadric.items():
            row[i] += value * z[j]
            row[j] += value * z[i]
        rows += [value % prime for value in row]
    rank = nmod_mat(len(rows) // 17, 17, rows, prime).rank()
    assert (rank < 10) == (singular_points(h, conditions.metric) > 0)
