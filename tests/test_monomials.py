"""Packed monomials multiply like sums and compare like the degree reverse lexicographic order."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sympy.polys.orderings import grevlex

from pkm_exact.algebra.monomials import FIELD_BITS, MonomialRing, divides, exponent_fields

SIZE = 4
RING = MonomialRing(SIZE)

exponents = st.tuples(*[st.integers(0, 50)] * SIZE)


@given(exponents, exponents)
def test_the_product_is_the_sum(left: tuple[int, ...], right: tuple[int, ...]) -> None:
    product = tuple(a + b for a, b in zip(left, right, strict=True))
    assert RING.pack(left) + RING.pack(right) == RING.pack(product)
    assert RING.unpack(RING.pack(product)) == product
    assert RING.degree(RING.pack(product)) == sum(product)


@given(exponents, exponents)
def test_the_order_is_degree_reverse_lexicographic(left: tuple[int, ...], right: tuple[int, ...]) -> None:
    assert (RING.pack(left) < RING.pack(right)) == (grevlex(left) < grevlex(right))


def test_unknowns_decrease_and_one_is_smallest() -> None:
    unknowns = [RING.unknown(index) for index in range(SIZE)]
    assert unknowns == sorted(unknowns, reverse=True)
    assert RING.pack((0,) * SIZE) == 0 < unknowns[-1]


def test_a_degree_beyond_the_field_is_refused() -> None:
    assert RING.unpack(RING.pack((2**FIELD_BITS - 1, 0, 0, 0)))[0] == 2**FIELD_BITS - 1
    with pytest.raises(OverflowError, match="packing limit"):
        RING.pack((2**FIELD_BITS - 1, 1, 0, 0))


LARGEST = 2**FIELD_BITS - 1
wide = st.tuples(*[st.integers(0, 3) | st.integers(LARGEST - 3, LARGEST)] * SIZE)


@given(wide, wide)
def test_divisibility_is_that_of_every_exponent(left: tuple[int, ...], right: tuple[int, ...]) -> None:
    expected = all(a <= b for a, b in zip(left, right, strict=True))
    assert divides(exponent_fields(left), exponent_fields(right)) == expected
