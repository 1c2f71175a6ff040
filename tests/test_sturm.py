"""Real roots counted by Sturm's chain in balls, and looked up in intervals that are listed: as they are isolated."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import floor, isqrt, prod

import pytest
from certificate_tools import both_resealed, last_line
from flint import fmpq, fmpz_poly
from forged_listings import LISTINGS, POLYNOMIALS, far_out, listing
from hypothesis import given, settings
from hypothesis import strategies as st

from pkm_exact.certify.checker import listed_roots, sturm
from pkm_exact.certify.checker.budget import Budget, spending
from pkm_exact.certify.checker.descartes import RealRoot, real_roots
from pkm_exact.certify.checker.document import Ends
from pkm_exact.certify.checker.listed_roots import number_of_real_roots, roots_by_intervals
from pkm_exact.certify.checker.sturm import sturm_count
from pkm_exact.certify.checker.verdict import Refusal

T = fmpz_poly([0, 1])


def _of(roots: Sequence[Fraction]) -> fmpz_poly:
    return prod((fmpz_poly([-root.numerator, root.denominator]) for root in roots), start=fmpz_poly([1]))


def _squarefree(polynomial: fmpz_poly) -> fmpz_poly:
    return prod((factor for factor, _ in polynomial.factor()[1]), start=fmpz_poly([1]))


rationals = st.fractions(-30, 30, max_denominator=40)
COMPLEX = st.lists(st.builds(lambda a, b: (T - a) ** 2 + b * b, st.integers(-4, 4), st.integers(1, 3)), max_size=5)


# Counting


@given(st.lists(rationals, max_size=8, unique=True), COMPLEX, st.integers(1, 3))
@settings(max_examples=60)
def test_a_count_is_right_if_there_is_one(roots: list[Fraction], others: list[fmpz_poly], m: int) -> None:
    h = _squarefree(prod(others, start=_of(roots))(T**m))
    if h.degree() < 1:
        return
    found = sturm_count(h)
    assert found is None or found == len(real_roots(h))


@given(st.lists(st.integers(-(10**6), 10**6), min_size=2, max_size=30))
@settings(max_examples=40)
def test_random_polynomials_are_counted(coefficients: list[int]) -> None:
    """Their chains are regular, unless the coefficients are special: some that are tried are."""
    h = _squarefree(fmpz_poly(coefficients))
    if h.degree() < 1:
        return
    assert sturm_count(h) in (None, len(real_roots(h)))
    assert number_of_real_roots(h) == len(real_roots(h))


@pytest.mark.parametrize(
    ("h", "number"),
    [
        (T, 1),
        (2 * T + 3, 1),
        (T**2 - 2, 2),
        (T**2 + 2, 0),
        (T**2 + T + 1, 0),
        (T**3 - 2, 1),
        (T**3 - 3 * T + 1, 3),
        (T**4 - 5 * T**2 + 5, 4),
        (T**4 - T**2 - 1, 2),
        (T**4 + 5 * T**2 + 5, 0),
        (T**6 - 6 * T**3 + 7, 2),
        (_of([Fraction(n, 3) for n in range(-19, 21)]), 40),
        (T * _of([Fraction(1, 3), Fraction(1, 3) + Fraction(1, 10**20)]), 3),
    ],
)
def test_numbers_that_are_known(h: fmpz_poly, number: int) -> None:
    assert sturm_count(h) == number


@pytest.mark.parametrize(
    "h",
    [
        (T - 1) ** 2 * (T + 3),  # a remainder is 0
        T**5 + T + 1,  # the degrees fall from 4 to 1
        _of([Fraction(1, 3), Fraction(1, 3) + Fraction(1, 1 << 1500), Fraction(2)]),  # too close for the precision
    ],
)
def test_no_count_where_it_is_not_proved(h: fmpz_poly) -> None:
    found = sturm_count(h)
    assert found is None or found == len(real_roots(h))
    if not h.gcd(h.derivative()).degree():
        assert number_of_real_roots(h) == len(real_roots(h))


def test_the_precision_is_raised_once(monkeypatch: pytest.MonkeyPatch) -> None:
    h = _of([Fraction(1, 3), Fraction(1, 3) + Fraction(1, 1 << 100), Fraction(2)])
    assert sturm_count(h) == 3
    monkeypatch.setattr(sturm, "FINER", 1)
    assert sturm_count(h) is None


def test_high_degrees_are_not_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    h = T**3 - 3 * T + 1
    monkeypatch.setattr(sturm, "MOST", 2)
    assert sturm_count(h) is None
    assert sturm_count(T**6 - 3 * T**3 + 1) == 2
    assert number_of_real_roots(h) == 3


def test_roots_too_large_are_refused_before_they_are_counted() -> None:
    with pytest.raises(Refusal, match="above 2"):
        number_of_real_roots(T - (1 << 5000))
    with pytest.raises(Refusal, match="above 2"):
        roots_by_intervals(T - (1 << 5000), [(str(fmpq(1 << 5000)), str(fmpq(1 << 5000)))])


def test_what_takes_long_is_charged() -> None:
    budget = Budget(0)
    with spending(budget):
        sturm_count(_of([Fraction(n, 3) for n in range(-19, 21)]))
    assert 10**6 < budget.spent < 10**8


# Looking up

H = (T - 5) * (4 * T + 1) * (T**2 - 2) * (T**2 + 7)
GRID = 33


def _cells(*places: int, grid: int = GRID) -> list[Ends]:
    """From a place of the grid to the next one."""
    return [(str(fmpq(place, 1 << grid)), str(fmpq(place + 1, 1 << grid))) for place in places]


def _point(value: Fraction) -> Ends:
    return str(value), str(value)


ROOT = isqrt(2 << 2 * GRID)
UNIT = Fraction(1, 1 << GRID)
RIGHT = [*_cells(-ROOT - 1), _point(Fraction(-1, 4)), *_cells(ROOT), _point(Fraction(5))]


def _ends(roots: Sequence[RealRoot]) -> list[Ends]:
    return [(str(root.low), str(root.high)) for root in roots]


@pytest.mark.parametrize("grid", [32, 33, 400, 4096])
def test_intervals_that_hold_the_roots_are_taken(grid: int) -> None:
    root = isqrt(2 << 2 * grid)
    listed = [*_cells(-root - 1, grid=grid), RIGHT[1], *_cells(root, grid=grid), RIGHT[3]]
    for order in (listed, listed[::-1]):
        assert _ends(roots_by_intervals(H, order)) == listed


def test_cells_may_have_an_end_in_common_and_points_be_on_any_grid() -> None:
    place = 3 << 30
    h = _of([Fraction(2 * place - 1, 1 << 34), Fraction(2 * place + 1, 1 << 34), Fraction(1, 2)])
    listed = [*_cells(place - 1, place), _point(Fraction(1, 2))]
    assert _ends(roots_by_intervals(h, listed)) == listed
    assert _ends(roots_by_intervals(T * (T - 3), [("3", "3"), ("0", "0")])) == [("0", "0"), ("3", "3")]
    assert _ends(roots_by_intervals(T**2 + 1, [])) == []


WRONG: dict[str, list[Ends]] = {
    "none": [],
    "one is missing": RIGHT[:3],
    "one has no root": [*RIGHT[:3], *_cells(6 << GRID)],
    "one more has no root": [*RIGHT, *_cells(6 << GRID)],
    "one more is a point that is no root": [*RIGHT, _point(Fraction(6))],
    "the same twice": [*RIGHT[:3], RIGHT[2]],
    "the same point twice, and one is missing": [RIGHT[0], RIGHT[1], RIGHT[1], RIGHT[2]],
    "a point in another one": [*RIGHT[:3], (RIGHT[2][0], RIGHT[2][0])],
    "a cell that ends at its root": [*RIGHT[:3], *_cells((5 << GRID) - 1)],
    "a cell that begins at its root": [*RIGHT[:3], *_cells(5 << GRID)],
    "two cells that end at a root, and one is missing": [*RIGHT[1:3], *_cells((5 << GRID) - 1, 5 << GRID)],
    "a cell beside the root": [*_cells(-ROOT), *RIGHT[1:]],
    "a point beside the root": [RIGHT[0], _point(Fraction(-1, 4) + UNIT), *RIGHT[2:]],
    "the wrong way": [RIGHT[0][::-1], *RIGHT[1:]],
    "two places wide": [RIGHT[0], RIGHT[1], (RIGHT[2][0], str(fmpq(ROOT + 2, 1 << GRID))), RIGHT[3]],
    "a coarser grid": [*RIGHT[:2], *_cells(isqrt(2 << 62), grid=31), RIGHT[3]],
    "a finer grid than the other": [*_cells(-isqrt(2 << 68) - 1, grid=34), *RIGHT[1:]],
    "far too wide": [("-" + "9" * 3000, "-1"), RIGHT[1], ("1", "3/2"), ("9/2", "9" * 3000)],
    "over another number than a power of 2": [("-3/2", "-4/3"), RIGHT[1], ("4/3", "5/3"), RIGHT[3]],
    "a cell between two such": [(str(fmpq(-3, 2)), str(fmpq(-3, 2) + fmpq(1, 3 << 32))), *RIGHT[1:]],
    "a point over another number": [*RIGHT[:3], _point(Fraction(14, 3))],
    "a grid that is too fine": [
        *_cells(-isqrt(2 << 8194) - 1, grid=4097),
        RIGHT[1],
        *_cells(isqrt(2 << 8194), grid=4097),
        RIGHT[3],
    ],
    "an end of many digits": [*RIGHT[:3], ("9/2", "9" * 5000)],
}


@pytest.mark.parametrize("name", WRONG)
def test_intervals_that_do_not_hold_the_roots_are_not_taken(name: str) -> None:
    assert _ends(roots_by_intervals(H, WRONG[name])) == _ends(real_roots(H))


def test_they_are_taken_only_if_all_roots_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(listed_roots, "sturm_count", lambda _: None)
    assert _ends(roots_by_intervals(H, RIGHT)) == _ends(real_roots(H))


@given(st.lists(rationals, min_size=1, max_size=5, unique=True), st.integers(32, 60), st.data())
@settings(max_examples=60)
def test_whatever_is_listed_all_roots_are_found(roots: list[Fraction], grid: int, data: st.DataObject) -> None:
    h = _of(roots) * (T**2 + T + 3)

    def near(root: Fraction) -> st.SearchStrategy[Ends]:
        place = floor(root * (1 << grid))
        cell = _point(root) if root * (1 << grid) == place else _cells(place, grid=grid)[0]
        others = st.sampled_from([*_cells(place - 1, place, place + 1, grid=grid), _point(root)])
        return others if data.draw(st.integers(0, 5)) == 0 else st.just(cell)

    listed = [data.draw(near(root)) for root in roots]
    found = roots_by_intervals(h, listed)
    assert len(found) == len(roots)
    for root, value in zip(found, sorted(roots), strict=True):
        exact = fmpq(value.numerator, value.denominator)
        assert root.low == exact == root.high or root.low < exact < root.high
        root.narrow(300)
        assert root.low <= exact <= root.high
        assert root.high - root.low <= fmpq(1, 1 << 300)


# Certificates


@pytest.mark.parametrize("name", LISTINGS)
def test_lists_that_are_wrong(name: str) -> None:
    answer = both_resealed(LISTINGS[name]())
    assert answer.status == "rejected"
    assert last_line(answer).startswith("real poses: ")


@pytest.mark.parametrize("name", POLYNOMIALS)
def test_lists_that_are_right(name: str) -> None:
    answer = both_resealed(listing(POLYNOMIALS[name]))
    assert answer.status == "accepted", last_line(answer)


def test_a_root_that_is_too_large() -> None:
    answer = both_resealed(far_out())
    assert answer.status == "too-large"
    assert last_line(answer).endswith("above 2^4096")
