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
from pkm_exact.claim import Claim
from pkm_exact.completeness import infinity
from pkm_exact.completeness.conditions import Conditions
from pkm_exact.completeness.shared_boundary import SharedBoundary
from pkm_exact.completeness.shared_rows import SharedRows
from pkm_exact.engine import solve, solve_row, solve_without_elimination
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric import proposed_representation as module
from pkm_exact.numeric.proposed_representation import proposed_representation
from pkm_exact.numeric.refined_solutions import refined_solutions
from pkm_exact.policy import Policy
from pkm_exact.poses.boxes import DEFAULT_WIDTH
from pkm_exact.poses.pose_denominators import PoseDenominators
from pkm_exact.poses.skipped_choices import are_passed_over
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


def test_a_solve_has_no_elimination_then_unless_it_is_asked_for() -> None:
    name = "carriage-hexapod"
    other = solve(shipped(name), policy=Policy(eliminate=True))
    assert not solved(name).statistics.primes
    assert "formulation" not in solved(name).statistics.seconds
    assert other.statistics.primes
    bytes_of = [canonical_bytes(certificate(model(name), None, solution)) for solution in (solved(name), other)]
    assert bytes_of[0] == bytes_of[1]


def test_rows_have_an_elimination_if_it_is_asked_for() -> None:
    problem = shipped("carriage-hexapod")
    assert not solve_row(problem).statistics.primes
    assert solve_row(problem, policy=Policy(eliminate=True)).statistics.primes


def test_rows_that_need_an_elimination_are_tried_without_one_no_more(monkeypatch: Patch) -> None:
    tried: list[object] = []
    monkeypatch.setattr(engine, "_proposed_poses", lambda *given: tried.append(given))
    shared = SharedRows()
    for _ in range(3):
        assert solve_row(shipped("carriage-hexapod"), shared=shared).statistics.primes
    assert len(tried) == 2


def test_another_formulation_has_its_basis() -> None:
    assert solve(shipped("carriage-hexapod"), formulation="AFP3").statistics.primes


@pytest.mark.parametrize("wrong", ["poses", "no proof"])
def test_what_is_not_proved_without_an_elimination_has_one(wrong: str, monkeypatch: Patch) -> None:
    name = "carriage-hexapod"
    right = solved(name)
    assert right.representation is not None
    first, *others = right.representation.univariate.eliminant
    poses = replace(
        right.representation, univariate=replace(right.representation.univariate, eliminant=(first + 1, *others))
    )
    target = "_proposed_poses" if wrong == "poses" else "prove_shortly"
    monkeypatch.setattr(engine, target, lambda *_: poses if wrong == "poses" else None)
    found = solve(shipped(name))
    assert found.statistics.primes
    assert found.representation == right.representation


def _row(name: str, number: int) -> ForwardProblem:
    problem = shipped(name)
    constraints = (replace(leg, length_squared=leg.length_squared + number) for leg in problem.distances)
    return replace(problem, constraints=tuple(constraints))


def test_rows_share_denominators_and_need_no_lattice_for_them(monkeypatch: Patch) -> None:
    name, shared = "carriage-hexapod", SharedRows()
    first, second = (_row(name, number) for number in (0, 3))
    solve_row(first, shared=shared)
    before = replace(shared.denominators)
    assert before.boundary is not None
    alone = solve_without_elimination(second)
    assert alone is not None
    monkeypatch.setattr(module, "_relation", lambda *_: pytest.fail("a lattice for what is known"))
    together = solve_row(second, shared=shared)
    assert shared.denominators == before
    assert together.representation == alone.representation
    assert (together.poses, together.notes) == (alone.poses, alone.notes)


def test_denominators_of_another_robot_do_no_harm() -> None:
    found = solve_row(shipped("carriage-hexapod"), shared=SharedRows(PoseDenominators(Fraction(1, 7**90), 11**50)))
    assert found.representation == solved("carriage-hexapod").representation


@pytest.mark.parametrize("name", ["mssm", pytest.param("6-6pp", marks=pytest.mark.slow)])
def test_points_at_infinity_and_other_forms_need_no_elimination(name: str) -> None:
    """Opposite poses of the 6-6pp have the same first coordinate."""
    found, other = solve_without_elimination(shipped(name)), solved(name)
    assert found is not None
    assert found.representation is not None
    assert other.representation is not None
    assert found.representation.separating_form == other.representation.separating_form
    bytes_of = [canonical_bytes(certificate(model(name), None, solution)) for solution in (found, other)]
    assert bytes_of[0] == bytes_of[1]


def test_rows_share_what_is_at_infinity(monkeypatch: Patch) -> None:
    shared, at = SharedRows(), infinity._Section.at
    for _ in range(2):
        found = solve_row(shipped("mssm"), shared=shared)
        monkeypatch.setattr(infinity._Section, "at", lambda *_: pytest.fail("found before"))
    assert found.completeness == solved("mssm").completeness
    monkeypatch.setattr(infinity._Section, "at", at)
    other = _row("mssm", 1)
    assert solve_row(other, shared=shared).completeness == solve(other).completeness


def test_other_conditions_at_infinity_begin_anew() -> None:
    shared = SharedBoundary()
    conditions = Conditions.of(shipped("mssm"))
    shared.of(conditions).bounds.append(5)
    assert shared.of(Conditions.of(_row("mssm", 1))).bounds == [5]
    assert not shared.of(Conditions.of(shipped("tssm"))).bounds


def test_lifting_otherwise_needs_an_elimination() -> None:
    assert solve_without_elimination(shipped("mssm"), policy=Policy(lifting="newton")) is None


def test_rows_that_need_an_elimination_are_soon_not_tried_without(monkeypatch: Patch) -> None:
    tried: list[object] = []
    monkeypatch.setattr(engine, "solve_without_elimination", lambda problem, **_: tried.append(problem))
    shared = SharedRows()
    for _ in range(3):
        solve_row(shipped("3-rpr-merlet-p"), shared=shared)
    assert len(tried) == 2


@pytest.mark.parametrize("kind", ["charts", "forms"])
def test_what_the_search_by_primes_would_take_is_not_passed_over(kind: str) -> None:
    found = solved("mssm").representation
    assert found is not None
    charts, forms = ([found.chart], []) if kind == "charts" else ([], [found.separating_form])
    assert not are_passed_over(found, charts, forms)
    assert are_passed_over(found, [], [(0, 0, 0, 0, 0, 0, 0, 0)])
    assert are_passed_over(found, [], [])


def test_rows_of_a_robot_that_needs_an_elimination_have_one() -> None:
    name = "3-rpr-merlet-p"
    rows = RowSolver.of([shipped(name)], DEFAULT_WIDTH, Policy(), "exact")
    assert rows.solution(shipped(name)).statistics.primes == solved(name).statistics.primes


@pytest.mark.slow
@pytest.mark.parametrize(
    "lengths",
    [
        "3121651/2 3142153/2 1564585 3109421/2 1561494 3136555/2",
        "1565625 1563500 15576911/10 1568631 1561617 3129357/2",
    ],
)
def test_guesses_on_the_boundary_of_rigid_motions_propose_nothing(lengths: str, monkeypatch: Patch) -> None:
    """The template finds points with N(e) = 0 beside the poses of these rows: root of a product that is 0 or nearly."""
    base, shared = shipped("mssm"), SharedRows()
    assert solve_row(base, shared=shared).claim is Claim.COMPLETE
    squares = map(Fraction, lengths.split())
    legs = [replace(leg, length_squared=square) for leg, square in zip(base.distances, squares, strict=True)]
    row = replace(base, constraints=tuple(legs))
    monkeypatch.setattr(module._Refinement, "has", lambda *_: pytest.fail("bits are spent on what cannot be verified"))
    answered = solve_row(row, shared=shared)
    assert (answered.claim, answered.poses) == (Claim.COMPLETE, solve(row).poses)


def test_a_wrong_proposal_without_an_elimination_is_no_answer(monkeypatch: Patch) -> None:
    found = solved("carriage-hexapod").representation
    assert found is not None
    first, *others = found.univariate.eliminant
    wrong = replace(found, univariate=replace(found.univariate, eliminant=(first + 1, *others)))
    monkeypatch.setattr(engine, "_proposed_poses", lambda *_: wrong)
    assert solve_without_elimination(shipped("carriage-hexapod")) is None
