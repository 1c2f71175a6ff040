"""The matrix of wrenches proved to be regular without its determinant: beside that, and at single poses."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import pytest
from flint import Ordering, fmpq, fmpq_mpoly_ctx
from region_certificates import machine_of

from pkm_exact.regions import region_solver
from pkm_exact.regions.compiled_formula import View, compiled_formula
from pkm_exact.regions.formula import All, Regular
from pkm_exact.regions.paving import leaves
from pkm_exact.regions.question_reader import question_from_toml
from pkm_exact.regions.region_conditions import asked_of, placed_legs
from pkm_exact.regions.region_determinants import determinant, leg_row, wrench_rows
from pkm_exact.regions.region_legs import region_machine
from pkm_exact.regions.region_matrices import MatrixAtPoints, determinant_size, own_row, smaller_rows
from pkm_exact.regions.region_points import PointJudge
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.regions.region_solver import RegionAnswer, answered, points_of, prepared

TURNED = "position = [[-20, 20], [-20, 20], [640, 680]]\nrpy_degrees = [[-4, 4], [-4, 4], [-4, 4]]"
WIDE = "position = [[-900, 900], [-900, 900], [-400, 1300]]\nrpy_degrees = [[-30, 30], [-30, 30], [-30, 30]]"
SMALL = {
    "planar, regular": ("3-rpr-merlet-p", "position = [[4, 6], [4, 6]]\ndegrees = [-5, 5]", ""),
    "planar, singular": ("3-rpr-merlet-p", "position = [[0, 6], [0, 6]]\ndegrees = [-5, 5]", ""),
    "hexapod, fixed": ("rolland-6-6", "position = [[-9, 9], [-9, 9], [670, 870]]\nquaternion = [9, 1, 0, 0]", ""),
    "hexapod, turned": ("rolland-6-6", "position = [0, 0, 770]\nrpy_degrees = [0, [-40, 9], [-9, 9]]", ""),
    "joints beside": ("2-ups-u", "position = [0, 0, 0]\nrpy_degrees = [[-45, 45], [-45, 45], 0]", ""),
    "Schoenflies": ("h4", "position = [[-1, 1], 0, 40]\ndegrees = [-5, 5]", "----"),
    "slides": ("rcid", "position = [[-9, 9], [-9, 9], [110, 130]]\nrpy_degrees = [0, 0, 0]", "------"),
    "cranks": ("3-rrr", "position = [[0, 12], [-2, 10]]\ndegrees = 0", "++-"),
}
"""Model, region and working modes."""


def question_of(model: str, region: str, modes: str = "", more: str = "kind = 'all'") -> tuple[Any, RegionQuestion]:
    machine = region_machine(machine_of(model))
    signs = f"working_modes = {list(modes)}" if modes else ""
    text = f"[region]\n{region}\n[conditions]\nno_type_2 = true\n{signs}\n[answer]\n{more}\n"
    return machine, question_from_toml(text, machine)


def _answer(monkeypatch: pytest.MonkeyPatch, most: int, *question: str) -> RegionAnswer:
    monkeypatch.setattr(region_solver, "MOST_OF_DETERMINANT", most)
    kind = "map" if question[0] == "3-rrr" else "all"
    return answered(*question_of(*question, more=f"kind = '{kind}'\nsteps = 9"))


@pytest.mark.parametrize("name", SMALL)
def test_the_matrix_and_its_determinant_agree(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """No part is good by one and bad by the other; where one refutes, so does the other."""
    by_matrix, expanded = (_answer(monkeypatch, most, *SMALL[name]) for most in (-1, 10**9))
    assert (by_matrix.by_matrix, expanded.by_matrix) == (True, False)
    assert "i" in by_matrix.word
    if by_matrix.question.answer.kind == "map":
        shares = by_matrix.shares["inside"], expanded.shares["inside"]
        assert shares[0] <= shares[1] + expanded.shares["undecided"]
        assert shares[1] <= shares[0] + by_matrix.shares["undecided"]
        assert by_matrix.shares["outside"] == expanded.shares["outside"]  # what does not reach
    else:
        assert (by_matrix.counterexample is None) == (expanded.counterexample is None) == (name != "planar, singular")
        assert by_matrix.is_proved == expanded.is_proved == (name != "planar, singular")


def test_parts_inside_have_determinants_of_one_sign(monkeypatch: pytest.MonkeyPatch) -> None:
    answer = _answer(monkeypatch, -1, *SMALL["planar, singular"])
    ready = prepared(answer.machine, answer.question)
    judge = PointJudge(ready.asked, ready.region)
    assert answer.counts["undecided"]
    for letter, part in leaves(answer.word, answer.axes, len(ready.box)):
        signs = {judge.determinant_sign(point) for point in points_of(ready.box, answer.axes, part)}
        assert letter != "i" or (len(signs) == 1 and signs != {0})


def test_a_general_hexapod_in_boxed_orientation_is_regular() -> None:
    answer = answered(*question_of("rolland-6-6", TURNED))
    assert answer.by_matrix
    assert answer.is_proved


def test_a_box_with_a_singular_pose_is_refuted() -> None:
    answer = answered(*question_of("rolland-6-6", WIDE))
    assert answer.counterexample is not None
    rows = smaller_rows(answer.machine, *placed_legs(answer.machine, answer.question.chart, answer.question.conditions))
    signs = []
    for point in answer.counterexample.points:
        at = [fmpq(x.numerator, x.denominator) for x in point]
        matrix = np.array([[float(Fraction(str(entry(*at)))) for entry in row] for row in rows])
        signs.append(np.sign(np.linalg.det(matrix)))
    assert sorted(signs) == [-1, 1]


def test_a_determinant_that_is_zero_at_a_pose_refutes() -> None:
    machine, question = question_of("3-rpr-merlet-p", "position = [[4, 6], [4, 6]]\ndegrees = [-5, 5]")
    asked = asked_of(machine, question.chart, question.conditions, most_of_determinant=-1)
    assert asked.matrix is not None
    row = asked.matrix.rows[0]
    singular = Regular("twice the same row", (row, row, asked.matrix.rows[2]))
    judge = PointJudge(replace(asked, formula=singular, matrix=singular), All(()))
    assert judge.failing((Fraction(5), Fraction(5), Fraction(0))) == "twice the same row"


@pytest.mark.parametrize("name", ["planar, singular", "hexapod, turned", "joints beside", "cranks"])
def test_rows_are_smaller_and_their_determinant_the_same(name: str) -> None:
    model, region, modes = SMALL[name]
    machine, question = question_of(model, region, modes)
    pose, placed = placed_legs(machine, question.chart, question.conditions)
    rows, smaller = wrench_rows(machine, pose, placed), smaller_rows(machine, pose, placed)
    count = len(question.chart.variables)
    assert determinant_size(smaller, count) <= determinant_size(rows, count)
    for leg in placed:
        if leg.root is None:
            scaled = [pose.norm * x for x in own_row(leg, machine, pose)]
            assert scaled == leg_row(leg, pose, machine)
    if len(rows) > 3:
        return
    whole = determinant(smaller, pose.constant(0))
    point = tuple(low + (high - low) / 3 for low, high in question.chart.box)
    values: Any = dict(zip(question.chart.variables, (fmpq(x.numerator, x.denominator) for x in point), strict=True))
    found, expected = MatrixAtPoints(smaller, pose, len(point)).determinant_at(point), whole.subs(values)
    factor = Fraction(int(found.leading_coefficient().p), int(found.leading_coefficient().q))
    factor /= Fraction(int(expected.leading_coefficient().p), int(expected.leading_coefficient().q))
    assert factor > 0
    assert found == expected * fmpq(factor.numerator, factor.denominator)


def _is_proved(rows: Any, box: Any, roots: Any = ()) -> bool:
    formula = Regular("", rows)
    ready = compiled_formula(formula, [], roots, box)
    return bool(ready.truths_in(View([0] * len(box), np.zeros((1, len(box)), dtype=np.int64)))[0] == 1)


def test_only_regular_matrices_are_proved() -> None:
    ring = fmpq_mpoly_ctx.get(("x", "y"), Ordering.lex)
    x, _ = ring.gens()
    one, zero = ring.constant(fmpq(1)), ring.constant(fmpq(0))
    box = [(Fraction(0), Fraction(1))]
    singular = 0
    for a, b, c, d in product((-2, 0, 1, 3), repeat=4):
        rows = ((a + x, b + zero), (c + x, d - x))
        values = [(a + t) * (d - t) - b * (c + t) for t in np.linspace(0, 1, 101)]
        has_zero = min(values) <= 0 <= max(values)
        singular += has_zero
        assert not (has_zero and _is_proved(rows, box))
    assert singular > 20
    assert _is_proved(((2 + x, one), (x, one)), box)
    assert not _is_proved(((2 + x, zero), (x, zero)), box)
    assert not _is_proved(((x, one), (x, one)), box)


def test_a_row_may_have_a_root() -> None:
    """[[1, y], [1, 3]] with y^2 = x: regular for x < 9, singular at 9; the same with -y for all."""
    ring = fmpq_mpoly_ctx.get(("x", "y"), Ordering.lex)
    x, y = ring.gens()
    one = ring.constant(fmpq(1))
    for low, high, proved in ((0, 4, True), (4, 8, True), (8, 10, False), (0, 100, False), (10, 16, True)):
        box = [(Fraction(low), Fraction(high))]
        assert _is_proved(((one, y), (one, 3 * one)), box, (x,)) is proved
        assert _is_proved(((one, -y), (one, 3 * one)), [(Fraction(low), Fraction(low + 1))], (x,))
