"""Echelon forms, of matrices too that have others modulo the prime by which their work is estimated."""

from fractions import Fraction
from math import gcd
from random import Random

import pytest
from flint import fmpq, fmpq_mat

from pkm_exact.certify.checker import echelon
from pkm_exact.certify.checker.budget import Budget, limbs, spending
from pkm_exact.certify.checker.echelon import Echelon, echelon_form, reduced_rows

FIRST = (1 << 63) - 25


def _chained(value: int) -> list[list[int]]:
    """Entries of 33 bits, of whose echelon form the first entry is a value of 64, beside zeros."""
    high, low = divmod(value, 1 << 32)
    return [[1, -(1 << 32), low, 0], [0, 1, high, 0]]


def _rational(table: list[list[int]]) -> list[list[Fraction]]:
    """The same form by rational arithmetic."""
    reduced, rank = fmpq_mat([[fmpq(value) for value in row] for row in table]).rref()
    return [[Fraction(int(value.p), int(value.q)) for value in row] for row in reduced.tolist()[:rank]]


def _whole(form: Echelon) -> list[list[Fraction]]:
    """All entries of a form."""
    rows = []
    for pivot, numerators in zip(form.pivots, form.numerators, strict=True):
        row = [Fraction(0)] * (len(form.pivots) + len(form.others))
        row[pivot] = Fraction(1)
        for column, value in zip(form.others, numerators, strict=True):
            row[column] = Fraction(value, form.denominator)
        rows.append(row)
    return rows


@pytest.mark.parametrize(
    "table",
    [
        [[1, FIRST + 3]],
        [[1, FIRST // 2 + 1], [0, FIRST]],
        _chained(FIRST + 3),
        _chained(3 * FIRST + 1),
        [[FIRST]],
        [[FIRST, 1], [0, FIRST]],
        [[FIRST, 1, 0], [1, 0, 1], [FIRST + 1, 1, 1]],
        [[3 * FIRST, 7]],
        [[2, 4, 6], [1, 2, 4]],
        [[5, 0, 1], [0, 0, 0]],
        [[0, 0, 4]],
    ],
)
def test_forms_that_are_others_modulo_a_prime(table: list[list[int]], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(echelon, "count", lambda _: [FIRST])
    assert _whole(echelon_form(table)) == _rational(table)


def _charged(table: list[list[int]]) -> int:
    budget = Budget(10**9)
    with spending(budget):
        echelon_form(table)
    return budget.spent


def test_no_matrix_takes_far_more_than_is_counted() -> None:
    """Neither one that is small modulo some prime, nor columns which cancel with some weights."""
    size, random = 14, Random(5)
    table = [[random.getrandbits(300) for _ in range(size + 2)] for _ in range(size)]
    common = [random.getrandbits(60) for _ in range(size + 2)]
    one_row_modulo = [[FIRST * x + y for x, y in zip(row, common, strict=True)] for row in table]
    cancelling = [[*row[:-2], row[-1] * (1 + (size + 1) ** 2), -row[-1] * (1 + size * size)] for row in table]
    for other in (one_row_modulo, cancelling):
        assert _charged(other) >= _charged(table)


def test_minors_are_counted_though_the_result_is_small() -> None:
    random, rows, rank, columns, bits = Random(6), 24, 6, 12, 1000
    high = [[random.getrandbits(bits) for _ in range(rank)] for _ in range(rows)]
    flat = [[random.randint(1, 9) for _ in range(columns)] for _ in range(rank)]
    table = [[sum(x * row[k] for x, row in zip(line, flat, strict=True)) for k in range(columns)] for line in high]
    assert _charged(table) > rank * rows * columns * limbs(rank * bits) * 10


def test_what_entries_have_in_common_is_counted() -> None:
    common = 3**40000
    budget = Budget(10**6)
    with spending(budget):
        reduced_rows([{0: 2 * common, 1: 1}, {0: 5 * common, 2: 1}])
    assert budget.spent > common.bit_length() ** 2 // 1000


def test_few_long_rows_are_not_taken_for_dense_ones() -> None:
    """They have nothing to do with each other: as a dense matrix they took a minute's work, and a second."""
    random, budget = Random(7), Budget(10**9)
    rows = [{k: random.getrandbits(60_000) | 1, 10 + k: random.getrandbits(60_000) | 1} for k in range(10)]
    with spending(budget):
        found = reduced_rows(rows)
    assert sorted(found) == list(range(10))
    assert budget.spent < 10**7


def _some_rows(rows: int, columns: int, filled: float, seed: str) -> list[dict[int, int]]:
    random = Random(seed)
    table = [{k: random.randint(-9, 9) for k in range(columns) if random.random() < filled} for _ in range(rows)]
    table[-1] = {k: table[0].get(k, 0) + 2 * table[1].get(k, 0) for k in table[0] | table[1]}
    return [row for row in ({k: value for k, value in row.items() if value} for row in table) if row]


@pytest.mark.parametrize(
    ("rows", "columns", "filled"),
    [(6, 9, 0.2), (9, 6, 0.5), (40, 50, 0.05), (40, 44, 0.3), (75, 80, 0.08), (36, 40, 1)],
)
def test_sparse_rows_have_the_form_that_rational_arithmetic_tells(rows: int, columns: int, filled: float) -> None:
    given = _some_rows(rows, columns, filled, f"{rows} {columns}")
    reduced = _rational([[row.get(column, 0) for column in range(columns)] for row in given])
    form = {next(k for k, value in enumerate(row) if value): row for row in reduced}

    for known in (set[int](), set(range(0, columns, 2)), set(range(columns))):
        found = reduced_rows(map(dict, given), known)
        assert set(form) - known <= set(found) <= set(form)
        for pivot, row in found.items():
            assert row[pivot] > 0
            assert gcd(*row.values()) == 1
            entries = {column: Fraction(value, row[pivot]) for column, value in row.items()}
            assert entries == {k: value for k, value in enumerate(form[pivot]) if value}
