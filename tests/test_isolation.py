"""Real roots in disjoint cells: every root in exactly one, rational roots on the grid exact."""

from fractions import Fraction
from itertools import pairwise
from math import prod

import pytest
from flint import acb, arb, ctx, fmpz_poly
from hypothesis import example, given
from hypothesis import strategies as st

from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval
from pkm_exact.roots.isolation import (
    RealRoot,
    enclosures_near,
    isolate_real_roots,
    isolated_and_enclosed,
    real_root_enclosures,
    refined_enclosures,
)

# Polynomials without a real root.
COMPLEX_FACTORS = [fmpz_poly([1]), fmpz_poly([1, 0, 1]), fmpz_poly([3, 1, 1]) * fmpz_poly([7, 0, 0, 0, 2])]

rationals = st.fractions(min_value=-1000, max_value=1000, max_denominator=10**6) | st.builds(
    Fraction, st.integers(-64, 64), st.sampled_from([1, 2, 4, 2**20, 2**32, 2**40])
)


def _product(roots: list[Fraction]) -> fmpz_poly:
    return prod((fmpz_poly([-root.numerator, root.denominator]) for root in roots), start=fmpz_poly([1]))


def _check(isolated: tuple[RealRoot, ...], roots: list[Fraction]) -> None:
    roots = sorted(roots)
    assert len(isolated) == len(roots)
    for cell, root in zip(isolated, roots, strict=True):
        assert cell.lo <= root <= cell.hi
        assert sum(cell.lo <= other <= cell.hi for other in roots) == 1
        assert cell.hi - cell.lo <= Fraction(1, 2**32)
        assert cell.is_exact == (cell.lo == root == cell.hi)
    for left, right in pairwise(isolated):
        assert left.hi <= right.lo


@given(st.lists(rationals, min_size=1, max_size=8, unique=True), st.sampled_from(COMPLEX_FACTORS))
@example([Fraction(0)], COMPLEX_FACTORS[0])
@example([Fraction(0), Fraction(1, 3 * 2**32)], COMPLEX_FACTORS[1])
@example(
    [Fraction(1, 3) - Fraction(1, 10**30), Fraction(1, 3), Fraction(1, 3) + Fraction(1, 10**40)], COMPLEX_FACTORS[0]
)
@example([Fraction(-1, 2**40), Fraction(0), Fraction(1, 2**40)], COMPLEX_FACTORS[0])
@example([Fraction(1, 2**32) - Fraction(1, 10**90), Fraction(1, 2**32) + Fraction(1, 10**90)], COMPLEX_FACTORS[0])
def test_rational_roots_are_isolated(roots: list[Fraction], factor: fmpz_poly) -> None:
    _check(isolate_real_roots(_product(roots) * factor), roots)


def test_dyadic_roots_are_exact() -> None:
    isolated = isolate_real_roots(_product([Fraction(-7, 4), Fraction(0), Fraction(5), Fraction(1, 3)]))
    assert [root.is_exact for root in isolated] == [True, True, False, True]


def test_irrational_roots_lie_where_the_sign_changes() -> None:
    polynomial = fmpz_poly([-2, 0, 1]) * fmpz_poly([-1, -1, 1]) * fmpz_poly([1, 0, 1])
    isolated = isolate_real_roots(polynomial)
    assert len(isolated) == 4
    assert [root.is_exact for root in isolated] == [False] * 4
    assert any(root.lo**2 < 2 < root.hi**2 for root in isolated if root.lo > 0)


def test_close_pairs_of_irrational_roots_are_told_apart() -> None:
    # Mignotte: T^8 - 2 (10^6 T - 1)^2 has two real roots within 10^-29 of 10^-6.
    polynomial = fmpz_poly([0, 1]) ** 8 - 2 * fmpz_poly([-1, 10**6]) ** 2
    isolated = isolate_real_roots(polynomial)
    assert len(isolated) == 4
    close = [root for root in isolated if abs(root.lo - Fraction(1, 10**6)) < Fraction(1, 10**9)]
    assert len(close) == 2
    assert close[0].hi <= close[1].lo


@pytest.mark.parametrize("polynomial", [fmpz_poly([1, 0, 1]), fmpz_poly([5])], ids=str)
def test_no_real_root_is_an_answer(polynomial: fmpz_poly) -> None:
    assert isolate_real_roots(polynomial) == ()


def test_cells_do_not_depend_on_the_context() -> None:
    polynomial = fmpz_poly([-3, 1, 0, 5, -7, 2])
    expected = isolate_real_roots(polynomial)
    with ctx.workprec(10):
        assert isolate_real_roots(polynomial) == expected


def test_balls_are_as_small_as_asked() -> None:
    polynomial = fmpz_poly([-2, 0, 1])
    balls = real_root_enclosures(polynomial, 500)
    assert len(balls) == len(real_root_enclosures(polynomial, 64)) == 2
    with ctx.workprec(600):
        for ball in balls:
            assert (ball * ball - 2).contains(arb(0))
            assert ball.rad() < arb(2) ** -400


def test_enclosures_are_refined_where_newtons_operator_leads_to_the_root() -> None:
    h = fmpz_poly([-2, 0, 1]) * fmpz_poly([0, 1]) * fmpz_poly([-1, 3])
    rough = real_root_enclosures(h, 40)
    fine = refined_enclosures(h, rough, 1000)

    assert fine is not None
    for ball, before in zip(fine, rough, strict=True):
        assert before.overlaps(ball)
        assert ball.is_exact() or ball.rel_accuracy_bits() > 990
        low, high = (end.fmpq() for end in (ball.lower(), ball.upper()))
        assert h(low) * h(high) <= 0
    wide = [arb(0, 4)]  # the derivative has a zero in it
    assert refined_enclosures(h, wide, 100) is None


def _near(h: fmpz_poly, bits: int) -> list[arb | acb]:
    """Rounded roots, one of each conjugate pair."""
    with working_precision(bits):
        roots = [root for root, _ in h.complex_roots()]
        return [root.real.mid() for root in roots if root.imag == 0] + [r.mid() for r in roots if r.imag > 0]


def test_numbers_near_all_roots_give_the_same_intervals() -> None:
    h = fmpz_poly([2, -5, 1, 0, 3, 1]) * fmpz_poly([-7, 0, 1]) * fmpz_poly([1, 1, 1])
    assert [root for root, _ in isolated_and_enclosed(h, _near(h, 500))] == list(isolate_real_roots(h))
    for bits in (500, 60, 20):
        enclosed = enclosures_near(h, _near(h, bits), 100)
        assert enclosed is not None
        roots = real_root_enclosures(h, 400)
        assert len(enclosed) == len(roots)
        assert all(ball.contains(root) for ball, root in zip(enclosed, roots, strict=True))


def test_numbers_that_do_not_tell_all_roots_apart_give_none() -> None:
    h = fmpz_poly([-2, 0, 1]) * fmpz_poly([1, 1, 1])
    real, pair = _near(h, 200)[:2], _near(h, 200)[2]
    assert len(enclosures_near(h, [*real, pair], 100) or ()) == 2
    wrong: list[list[arb | acb]] = [
        [],
        real,
        [real[0], real[0], pair],
        [*real, pair.real + acb(0, 1e-9)],
        [*real, acb(0, 0)],
        [arb(0), real[1], pair],
        [pair, pair],
    ]
    assert [enclosures_near(h, near, 100) for near in wrong] == [None] * len(wrong)
    assert isolated_and_enclosed(h, wrong[2])[0][0] == isolate_real_roots(h)[0]


def test_a_disc_around_a_real_number_may_hold_two_conjugate_roots() -> None:
    size = 10**9
    h = fmpz_poly([1, 0, size**2]) * fmpz_poly([-1, 1]) * fmpz_poly([-2, 1])
    small = arb(1) / size
    assert enclosures_near(h, [small, arb(1), acb(0, small)], 100) is None
    assert [
        ball.contains(root)
        for ball, root in zip(enclosures_near(h, [arb(1), arb(2), acb(0, small)], 100) or (), (1, 2), strict=True)
    ] == [True, True]


def test_intervals_on_a_grid_have_two_ends_each_and_are_true() -> None:
    """Lists of cells with gaps are told by their truth (``poses.boxes``)."""
    assert all([Interval(Fraction(0), Fraction(0)), *Interval.cells([0, -1], [0, 0], 3)])
    for ends in (([1, 2], [2]), ([1], [2, 3])):
        with pytest.raises(ValueError, match="zip"):
            Interval.cells(*ends, 3)
