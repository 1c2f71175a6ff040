"""Rational reconstruction: what fits is found, what does not fit is not believed."""

from fractions import Fraction
from random import Random

from hypothesis import assume, example, given
from hypothesis import strategies as st

from pkm_exact.algebra.reconstruction import MARGIN_BITS, common_fraction

MODULUS = 3**331
"""525 bits, and nothing in common with powers of 2, which examples shrink to."""

numerators = st.lists(st.integers(-(2**200), 2**200), min_size=1, max_size=20)


def _residues(values: list[int], denominator: int, modulus: int = MODULUS) -> list[int]:
    inverse = pow(denominator, -1, modulus)
    return [value * inverse % modulus for value in values]


@given(numerators, st.integers(1, 2**200))
@example([0], 1)
@example([0, 0, 1], 2**200)
@example([-1], 2)
def test_a_common_denominator_is_found(values: list[int], denominator: int) -> None:
    assume(denominator % 3)
    found = common_fraction(_residues(values, denominator), MODULUS)
    assert found is not None
    assert found[1] > 0
    assert [Fraction(value, found[1]) for value in found[0]] == [Fraction(value, denominator) for value in values]


@given(numerators, st.integers(1, 2**150), st.integers(1, 2**50))
def test_a_known_divisor_of_the_denominator_helps(values: list[int], known: int, rest: int) -> None:
    assume(known * rest % 3)
    found = common_fraction(_residues(values, known * rest), MODULUS, known)
    assert found is not None
    assert found[1] % known == 0
    assert [Fraction(value, found[1]) for value in found[0]] == [Fraction(value, known * rest) for value in values]


@given(st.integers(0, 2**64))
def test_random_residues_are_not_believed(seed: int) -> None:
    random = Random(seed)
    assert common_fraction([random.randrange(MODULUS) for _ in range(12)], MODULUS) is None


@given(numerators, st.integers(1, 2**200))
def test_whatever_is_found_fits_and_is_small(values: list[int], denominator: int) -> None:
    modulus = 2**255 - 19
    assume(denominator % modulus)
    residues = _residues(values, denominator, modulus)
    found = common_fraction(residues, modulus)
    if found is not None:
        assert all(
            (residue * found[1] - value) % modulus == 0 for residue, value in zip(residues, found[0], strict=True)
        )
        assert all(abs(value) < modulus >> MARGIN_BITS for value in found[0])


def test_many_numerators_need_little_more_than_their_own_size() -> None:
    random = Random(5)
    denominator = 3 * random.getrandbits(400) + 1
    values = [random.randrange(-(2**400), 2**400) for _ in range(16)]
    found = common_fraction(_residues(values, denominator), MODULUS)
    assert found is not None
    assert [Fraction(value, found[1]) for value in found[0]] == [Fraction(value, denominator) for value in values]


def test_a_right_guess_of_the_weight_needs_less_modulus() -> None:
    random = Random(6)
    denominator = 2 * random.getrandbits(60) + 1
    values = [random.getrandbits(460) for _ in range(16)]
    residues = _residues(values, denominator)
    found = common_fraction(residues, MODULUS, 1, 400)
    assert found is not None
    assert [Fraction(value, found[1]) for value in found[0]] == [Fraction(value, denominator) for value in values]
    assert common_fraction(residues, MODULUS) is None
