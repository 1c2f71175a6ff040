"""Numbers are read exactly, or refused in one sentence."""

from decimal import Decimal
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact.errors import InputError
from pkm_exact.geometry.rational import MAX_DIGITS, NumberText, bounded, parse_positive, parse_rational, parse_vector

GOOD = [
    ("0", 0),
    ("-7", -7),
    ("6/4", Fraction(3, 2)),
    ("-1/3", Fraction(-1, 3)),
    ("464.141", Fraction(464141, 1000)),
    ("007", 7),
    (12, 12),
    (Fraction(2, 3), Fraction(2, 3)),
    (Decimal("1.50"), Fraction(3, 2)),
    (Decimal("1E+3"), 1000),
    (Decimal("-2.5e-3"), Fraction(-1, 400)),
    (NumberText("+1_000.5"), Fraction(2001, 2)),
    (NumberText("5e-1"), Fraction(1, 2)),
    ("9" * MAX_DIGITS, 10**MAX_DIGITS - 1),
    (NumberText("1e-200"), Fraction(1, 10**200)),
]

BAD = [
    0.5,
    float("nan"),
    True,
    None,
    [1],
    {"p": 1},
    b"1",
    "",
    " 1",
    "1 ",
    "1\n",
    "+1",
    ".5",
    "5.",
    "1e3",
    "1/0",
    "1/-2",
    "1/2/3",
    "1.5/2",
    "0x10",
    "1_000",
    "nan",
    "-inf",
    "Infinity",
    "__import__('os')",
    "2**9",
    "sqrt(2)",
    "\u0661",
    "\u00bd",
    "1" * (MAX_DIGITS + 1),
    "1/" + "1" * (MAX_DIGITS + 1),
    "9" * 1_000_000,
    10 ** (MAX_DIGITS + 1),
    10**100_000,
    Fraction(1, 10 ** (2 * MAX_DIGITS) + 1),
    Decimal("NaN"),
    Decimal("sNaN123"),
    Decimal("Infinity"),
    Decimal("1e999999999"),
    Decimal("1e-999999999"),
    Decimal("0e999999999"),
    NumberText("1e999999999999999999999999"),
    NumberText("1e-201"),
    NumberText("nan"),
    NumberText("1" * 5000 + ".0"),
]


@pytest.mark.parametrize(("value", "number"), GOOD, ids=range(len(GOOD)))
def test_good_numbers_are_read_exactly(value: object, number: Fraction) -> None:
    assert parse_rational(value, "x") == number


@pytest.mark.parametrize("value", BAD, ids=range(len(BAD)))
def test_bad_numbers_give_one_short_sentence(value: object) -> None:
    with pytest.raises(InputError) as caught:
        parse_rational(value, "base.joints[1][2]")
    message = str(caught.value)
    assert message.startswith("base.joints[1][2]: ")
    assert len(message) < 250
    assert message.isprintable()
    assert "; " in message


def test_a_float_is_refused_with_the_form_to_use() -> None:
    with pytest.raises(InputError, match=r'write a string such as "1/4"'):
        parse_rational(0.1, "x")


@pytest.mark.parametrize("value", [0, "-1", "-0.0", Fraction(-1, 2)])
def test_only_positive_numbers_are_positive(value: object) -> None:
    with pytest.raises(InputError, match="is not positive"):
        parse_positive(value, "x")


def test_a_vector_has_three_numbers() -> None:
    assert parse_vector(["1/2", 0, Decimal("0.1")], "v") == (Fraction(1, 2), 0, Fraction(1, 10))
    for row in ([1, 2], "1,2,3", 3, None):
        with pytest.raises(InputError, match="give a list of 3 numbers"):
            parse_vector(row, "v")


@given(st.text() | st.from_regex(r"[-+0-9eE./_nainf]{1,12}"))
def test_any_text_is_a_number_or_an_input_error(text: str) -> None:
    for value in (text, NumberText(text)):
        try:
            assert isinstance(parse_rational(value, "x"), Fraction)
        except InputError as error:
            assert str(error).isprintable()


@given(st.fractions())
def test_fractions_survive_the_round_trip(number: Fraction) -> None:
    assert parse_rational(str(number), "x") == number == parse_rational(number, "x")


@given(st.decimals(allow_nan=False, allow_infinity=False, places=9))
def test_decimals_survive_the_round_trip(number: Decimal) -> None:
    assert parse_rational(number, "x") == Fraction(number)


def test_the_bound_is_on_both_parts() -> None:
    assert bounded(Fraction(10**3 - 1, 10**3), "shown", "x", 3) == Fraction(999, 1000)
    with pytest.raises(InputError, match="x: 'shown' is too long; use at most 3 digits"):
        bounded(Fraction(10**3), "shown", "x", 3)
