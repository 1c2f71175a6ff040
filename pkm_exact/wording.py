"""Input values as they appear in messages: short, on one line, and harmless to a terminal."""

from __future__ import annotations

from fractions import Fraction
from typing import Final

_LONGEST: Final = 40
_LONGEST_BITS: Final = 1400
NO_UNIT: Final = "1"
"""The unit of lengths that are pure numbers."""
TOO_LARGE: Final = "to check it takes more work than checkers allow; they will call it too-large"
"""Of a certificate that was written."""


def printable(text: str) -> str:
    r"""The text with every character that a terminal might obey or that ends a line written as an escape.

    >>> printable("a\x1b[2Jb")
    'a\\x1b[2Jb'
    """
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)


def counted(number: int, noun: str) -> str:
    """A number and its noun.

    >>> counted(1, "pose"), counted(0, "pose")
    ('1 pose', '0 poses')
    """
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def three_digits(value: Fraction, *, up: bool = False) -> str:
    """Three significant digits, not more than the value; or not less, if rounded ``up``.

    >>> three_digits(Fraction(2, 3)), three_digits(Fraction(1, 3), up=True), three_digits(Fraction(100))
    ('0.666', '0.334', '100')
    """
    from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal

    context = Context(prec=3, rounding=ROUND_CEILING if up else ROUND_FLOOR)
    return f"{context.divide(Decimal(value.numerator), Decimal(value.denominator)):g}"


def with_unit(number: str, unit: str) -> str:
    """A number and its unit, if there is one.

    Examples
    --------
    >>> with_unit("0.5", "mm"), with_unit("0.5", "1")
    ('0.5 mm', '0.5')
    """
    return number if unit == NO_UNIT else f"{number} {unit}"


def shown(value: object) -> str:
    """A short printable form of any input value.

    >>> shown("x" * 100)
    "'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx'... (100 characters)"
    >>> shown([1, 2, 3])
    'a list of 3'
    """
    if isinstance(value, str):
        if len(value) <= _LONGEST:
            return ascii(value)
        return f"{type(value)(value[:_LONGEST])!a}... ({len(value)} characters)"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int) and value.bit_length() > _LONGEST_BITS:
        return f"an integer of {value.bit_length()} bits"
    if (
        isinstance(value, Fraction)
        and max(value.numerator.bit_length(), value.denominator.bit_length()) > _LONGEST_BITS
    ):
        return f"a fraction of {value.numerator.bit_length()} by {value.denominator.bit_length()} bits"
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, list | tuple):
        return f"a list of {len(value)}"
    text = printable(str(value))
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}... ({len(text)} characters)"
