"""Monomials of the first checker as integers and as tuples, beside their exponents."""

from __future__ import annotations

from itertools import combinations_with_replacement
from random import Random

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from pkm_exact.certify.checker import elimination
from pkm_exact.certify.checker.elimination import Elimination, follow
from pkm_exact.certify.checker.packed_monomials import BITS, FEW, Integers, Monomial, Packing, Tuples, packing_for
from pkm_exact.certify.checker.verdict import Refusal

Pair = tuple[Packing, list[Monomial]]


@st.composite
def pairs(draw: st.DrawFn) -> Pair:
    """Two monomials whose product has a degree that fits, as integers or as tuples."""
    size = draw(st.integers(1, 19))
    most = Integers(size).most // 2
    packing: Packing = Integers(size) if draw(st.booleans()) else Tuples(size)
    found = []
    for _ in range(2):
        left, exponents = most, []
        for _ in range(size):
            exponents.append(draw(st.integers(0, min(left, draw(st.sampled_from([1, 3, most]))))))
            left -= exponents[-1]
        found.append(tuple(draw(st.permutations(exponents))))
    return packing, found


@pytest.mark.parametrize("packing", [Integers(3), Tuples(3)], ids=repr)
def test_order_is_by_degree_then_reverse_lexicographic(packing: Packing) -> None:
    descending = [(3, 0, 0), (2, 0, 0), (1, 1, 0), (0, 2, 0), (1, 0, 1), (0, 1, 1), (0, 0, 2), (1, 0, 0), (0, 0, 0)]
    assert sorted(descending, key=packing.packed) == descending[::-1]


@given(pair=pairs())
def test_order_of_any_monomials(pair: Pair) -> None:
    packing, monomials = pair
    keys = [(sum(monomial), [-exponent for exponent in reversed(monomial)]) for monomial in monomials]
    codes = [packing.packed(monomial) for monomial in monomials]
    assert (codes[0] > codes[1], codes[0] == codes[1]) == (keys[0] > keys[1], keys[0] == keys[1])


@given(pair=pairs(), factors=st.lists(st.integers(0, 18), max_size=3))
def test_exponents_degree_and_products(pair: Pair, factors: list[int]) -> None:
    packing, monomials = pair
    codes = [packing.packed(monomial) for monomial in monomials]
    assert [packing.unpacked(code) for code in codes] == monomials
    assert [packing.degree(code) for code in codes] == [*map(sum, monomials)]
    axes = [factor % packing.size for factor in factors]
    fitting = axes[: max(Integers(packing.size).most - max(map(sum, monomials)), 0)]
    raised = [tuple(e + fitting.count(axis) for axis, e in enumerate(monomial)) for monomial in monomials]
    product = packing.multiple(dict(zip(codes, (5, 7), strict=True)), fitting)
    assert product == dict(zip(map(packing.packed, raised), (5, 7), strict=True))


@example(pair=(Integers(1), [(1,), (1 << BITS // 2 - 2,)]))
@example(pair=(Integers(2), [(0, 1), (3, Integers(2).most)]))
@example(pair=(Tuples(2), [(5, 6), (6, 6)]))
@given(pair=pairs())
def test_one_divides_the_other_if_no_exponent_is_larger(pair: Pair) -> None:
    packing, monomials = pair
    one, other = codes = [packing.packed(monomial) for monomial in monomials]
    divides = all(e <= f for e, f in zip(*monomials, strict=True))
    assert packing.multiples([other, one], [one]) == ({0, 1} if divides else {1})
    assert packing.multiples([one, other], [one]) == ({0, 1} if divides else {0})
    assert packing.multiples(codes, []) == set()
    assert packing.multiples(codes, [packing.packed((0,) * packing.size)]) == {0, 1}


@pytest.mark.parametrize("size", [1, 2, 10, 16])
@pytest.mark.parametrize("kind", [Integers, Tuples])
def test_powers_of_one_unknown(kind: type[Packing], size: int) -> None:
    packing = kind(size)
    assert packing.unknown_of_power(packing.packed((0,) * size)) == 0
    for place in range(size):
        for exponent in {1, 2, Integers(size).most - 1}:
            power = [exponent * (axis == place) for axis in range(size)]
            assert packing.unknown_of_power(packing.packed(tuple(power))) == place
            for axis in {*range(size)} - {place}:
                both = tuple(e + (k == axis) for k, e in enumerate(power))
                assert packing.unknown_of_power(packing.packed(both)) is None


@pytest.mark.parametrize("packing", [Integers(0), Tuples(0)], ids=repr)
def test_no_unknown_leaves_1_alone(packing: Packing) -> None:
    one = packing.packed(())
    assert packing.unpacked(one) == ()
    assert (packing.degree(one), packing.multiples([one], [one])) == (0, {0})


def test_integers_have_hashes_of_their_own() -> None:
    """An integer of more bits has the hash of its remainder by 2^61 - 1: files can be made where all have one."""
    for size in range(65):
        most = Integers(size).most
        assert isinstance(packing_for(size, most + 1, 0), Tuples)
        if most > 0:
            packing = packing_for(size, most, FEW)
            last = packing.packed((most, *[0] * (size - 1))[:size])
            assert isinstance(packing, Integers)
            assert isinstance(packing_for(size, most, FEW + 1), Tuples)
            assert hash(last) == last < 1 << BITS
    assert [Integers(size).most for size in (6, 10, 16, 64)] == [127, 15, 3, -1]


@pytest.mark.parametrize("size", [2, 10, 16, 64])
def test_more_is_left_than_integers_count_to(size: int) -> None:
    """All unknowns but the last have squares among the leading monomials; powers of that are left, however high."""
    squares = [{tuple(2 * (axis == place) for axis in range(size)): 1} for place in range(size - 1)]
    with pytest.raises(Refusal, match="more than 200"):
        Elimination.begun(size, squares).standard(200)


@pytest.mark.parametrize(("size", "kinds"), [(4, [Integers] * 4), (16, [Integers, Integers, Tuples, Tuples])])
@pytest.mark.parametrize("seed", range(3))
def test_steps_yield_the_same_with_tuples_alone(
    size: int, kinds: list[type[Packing]], seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Four quadrics in four of the unknowns, times each of these, and so on: of degrees above those of integers."""
    random = Random(seed)
    zeros = (0,) * (size - 4)
    quadratic = [(*map(axes.count, range(4)), *zeros) for axes in combinations_with_replacement(range(4), 2)]
    quadrics = [{monomial: random.randint(1, 9) for monomial in quadratic} for _ in range(4)]
    found = []
    for packing in (packing_for, lambda size, *_: Tuples(size)):
        monkeypatch.setattr(elimination, "packing_for", packing)
        eliminations = [Elimination.begun(size, quadrics)]
        for _ in range(3):
            last = eliminations[-1]
            step = [(index, (axis,)) for index in range(len(last.packed)) for axis in range(4)]
            eliminations.append(follow(last, [step]))
        if packing is packing_for:
            assert [type(one.packing) for one in eliminations] == kinds
        first = [(index, (axis,)) for index in range(4) for axis in range(4)]
        found.append([(one.elements, one.prepared(first, 1).at_most(first, 40)) for one in eliminations])
    assert found[0] == found[1]
    assert len(found[0][-1][0]) > len(found[0][0][0])


def test_many_terms_are_tuples() -> None:
    line = {(1, 0): 1, (0, 0): 1}
    begun = Elimination.begun(2, [line])
    for rows, packing in ((FEW // 2, Integers), (FEW // 2 + 1, Tuples)):
        assert isinstance(begun.prepared([(0, ())] * rows, 1).packing, packing)
        assert isinstance(Elimination.begun(2, [line] * rows).packing, packing)
    columns = ({(power, k): 1 for k in range(60)} for power in range(FEW // 60 + 1))
    many = Elimination(begun.packing, tuple({begun.packing.packed(m): 1 for m in column} for column in columns))
    assert isinstance(many.prepared([], 1).packing, Tuples)
    assert many.prepared([], 1).elements == many.elements
