"""What numerical solutions propose is what lifting finds; what is wrong is refused, and lifted after all."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from samples import model, shipped, solved

from pkm_exact import engine
from pkm_exact.algebra.representation import UnivariateRepresentation
from pkm_exact.batch.row_solver import RowSolver
from pkm_exact.certify.build import canonical_bytes, certificate
from pkm_exact.engine import solve, solve_row, solve_without_elimination
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric import proposed_representation as module
from pkm_exact.numeric.proposed_representation import proposed_representation
from pkm_exact.numeric.refined_solutions import refined_solutions
from pkm_exact.policy import Policy
from pkm_exact.poses.boxes import DEFAULT_WIDTH
from pkm_exact.poses.pose_denominators import PoseDenominators
from pkm_exact.poses.study_equations import free_coordinates

Patch = pytest.MonkeyPatch
LIMIT = 1 << 17


def _known(name: str) -> UnivariateRepresentation:
    """The representation on the free coordinates."""
    found = solved(name).representation
    assert found is not None
    free = free_coordinates(found.chart, shipped(name))
    whole = found.univariate
    return UnivariateRepresentation(
        tuple(whole.form[k] for k in free), whole.eliminant, tuple(whole.numerators[k] for k in free)
    )


def _proposed(name: str, limit: int = LIMIT, watch: Any = None, factor: int = 1) -> UnivariateRepresentation | None:
    found = solved(name).representation
    assert found is not None
    degree = found.univariate.degree * factor
    return proposed_representation(shipped(name), found.chart, found.separating_form, degree, limit, watch)


@pytest.mark.parametrize(
    "name", ["mssm", "carriage-hexapod", *(pytest.param(n, marks=pytest.mark.slow) for n in ("6-6pp", "hexa"))]
)
def test_it_is_the_one_that_is_verified(name: str) -> None:
    bits: list[int] = []
    assert _proposed(name, watch=bits.append) == _known(name)
    assert bits == sorted(bits)
    assert "p-adic lifting" not in solved(name).statistics.seconds


def test_lifting_finds_the_same() -> None:
    lifted = solve(shipped("mssm"), policy=Policy(lifting="newton"))
    assert "numeric lifting" not in lifted.statistics.seconds
    assert lifted.representation == solved("mssm").representation


def test_nothing_is_proposed_beyond_the_limit() -> None:
    assert _proposed("mssm", limit=600) is None
    assert _proposed("carriage-hexapod", limit=1750) is None


def test_nothing_is_proposed_of_other_robots_nor_other_numbers_of_solutions() -> None:
    assert _proposed("3-rpr-merlet-p") is None
    assert _proposed("mssm", factor=2) is None


def test_nothing_is_proposed_where_floating_point_overflows(monkeypatch: Patch) -> None:
    def overflow(_: object) -> None:
        raise OverflowError

    monkeypatch.setattr(module, "seeds", overflow)
    assert _proposed("mssm") is None


def _points(name: str) -> tuple[Any, Any]:
    found = solved(name).representation
    assert found is not None
    given = module.seeds(shipped(name))
    points = module.rational_coordinates(given.points, given.section)
    return found.chart, points / (points[:, :4] @ np.array(found.chart, dtype=float))[:, None]


def test_solutions_without_their_conjugates_are_not_refined() -> None:
    chart, points = _points("carriage-hexapod")
    problem = shipped("carriage-hexapod")
    found = refined_solutions(problem, chart, points)
    assert found is not None
    assert 2 * len(found.points) - found.count == 40
    upper = points[points.imag.max(axis=1) > 1e-3]
    assert refined_solutions(problem, chart, np.concatenate([upper, upper.conj()[1:]])) is None


def test_points_that_newton_does_not_settle_on_are_not_refined() -> None:
    chart, points = _points("mssm")
    assert refined_solutions(shipped("mssm"), chart, points * (1 + 1e5 * np.arange(8))) is None
    assert refined_solutions(shipped("mssm"), chart, points * 0) is None


def test_a_solution_that_is_there_twice_fits_no_denominator(monkeypatch: Patch) -> None:
    real = module.seeds

    def doubled(problem: Any) -> Any:
        found = real(problem)
        order = np.argsort(np.abs(found.points.imag).max(axis=1))
        points = found.points[order].copy()
        points[0] = points[1] * np.exp(1e-7)
        return replace(found, points=points)

    monkeypatch.setattr(module, "seeds", doubled)
    assert _proposed("mssm") is None


@pytest.mark.parametrize("place", ["eliminant", "numerators"])
def test_a_wrong_proposal_is_lifted_after_all(place: str, monkeypatch: Patch) -> None:
    right = _known("mssm")
    first, *others = right.numerators
    wrong = {
        "eliminant": replace(right, eliminant=(right.eliminant[0] + 1, *right.eliminant[1:])),
        "numerators": replace(right, numerators=((first[0] + 1, *first[1:]), *others)),
    }
    monkeypatch.setattr(engine, "_proposal", lambda *_: wrong[place])
    solution = solve(shipped("mssm"))
    assert solution.representation == solved("mssm").representation
    assert {"numeric lifting", "p-adic lifting"} <= set(solution.statistics.seconds)


def test_a_proposal_that_is_wrong_at_other_primes_only_is_lifted_after_all(monkeypatch: Patch) -> None:
    right, prime = _known("mssm"), solved("mssm").statistics.primes[0]
    wrong = replace(right, eliminant=(right.eliminant[0] + prime, *right.eliminant[1:]))
    monkeypatch.setattr(engine, "_proposal", lambda *_: wrong)
    solution = solve(shipped("mssm"))
    assert solution.representation == solved("mssm").representation
    assert "p-adic lifting" in solution.statistics.seconds


def test_as_many_poses_as_there_can_be_need_no_elimination() -> None:
    name = "carriage-hexapod"
    found = solve_without_elimination(shipped(name))
    assert found is not None
    assert not found.statistics.primes
    bytes_of = [canonical_bytes(certificate(model(name), None, solution)) for solution in (found, solved(name))]
    assert bytes_of[0] == bytes_of[1]


def _row(name: str, number: int) -> ForwardProblem:
    problem = shipped(name)
    constraints = (replace(leg, length_squared=leg.length_squared + number) for leg in problem.distances)
    return replace(problem, constraints=tuple(constraints))


def test_rows_share_denominators_and_need_no_lattice_for_them(monkeypatch: Patch) -> None:
    name, shared = "carriage-hexapod", PoseDenominators()
    first, second = (_row(name, number) for number in (0, 3))
    solve_row(first, shared=shared)
    assert shared.boundary is not None
    before = replace(shared)
    alone = solve_without_elimination(second)
    assert alone is not None
    monkeypatch.setattr(module, "_relation", lambda *_: pytest.fail("a lattice for what is known"))
    together = solve_row(second, shared=shared)
    assert shared == before
    assert together.representation == alone.representation
    assert (together.poses, together.notes) == (alone.poses, alone.notes)


def test_denominators_of_another_robot_do_no_harm() -> None:
    found = solve_row(shipped("carriage-hexapod"), shared=PoseDenominators(Fraction(1, 7**90), 11**50))
    assert found.representation == solved("carriage-hexapod").representation


def test_fewer_poses_or_another_form_need_an_elimination() -> None:
    assert solve_without_elimination(shipped("mssm")) is None
    assert solve_without_elimination(shipped("6-6pp")) is None  # opposite poses have the same first coordinate
    assert solve_without_elimination(shipped("carriage-hexapod"), policy=Policy(lifting="newton")) is None


def test_rows_of_a_robot_that_needs_an_elimination_have_one() -> None:
    rows = RowSolver.of([shipped("mssm")], DEFAULT_WIDTH, Policy(), "exact")
    assert rows.solution(shipped("mssm")).statistics.primes == solved("mssm").statistics.primes


def test_a_wrong_proposal_without_an_elimination_is_no_answer(monkeypatch: Patch) -> None:
    found = solved("carriage-hexapod").representation
    assert found is not None
    first, *others = found.univariate.eliminant
    wrong = replace(found, univariate=replace(found.univariate, eliminant=(first + 1, *others)))
    monkeypatch.setattr(engine, "_proposed_poses", lambda *_: wrong)
    assert solve_without_elimination(shipped("carriage-hexapod")) is None
