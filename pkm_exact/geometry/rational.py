"""Exact rational numbers read from text, integers or decimals: bounded, and never through a binary float."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from decimal import Decimal
from fractions import Fraction
from math import isqrt
from typing import Final

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.wording import shown

MAX_DIGITS: Final = 200
"""Most decimal digits of a numerator or a denominator, powers of ten written out; keeps hostile input cheap."""

MAX_COMPUTED_DIGITS: Final = 2 * MAX_DIGITS
"""The same for a ``Fraction``: long enough for the square of a number that was read."""

_PLAIN = re.compile(r"-?[0-9]+(?:/[0-9]+|\.[0-9]+)?", re.ASCII)
_SCIENTIFIC = re.compile(r"([+-]?)([0-9]+)(?:\.([0-9]+))?(?:[eE]([+-]?[0-9]+))?", re.ASCII)
_NOT_FINITE = re.compile(r"[+-]?(?:s?nan[0-9]*|inf(?:inity)?)", re.ASCII | re.IGNORECASE)
_FORMS: Final = 'write a decimal or a string such as "3/4"'


class NumberText(str):
    """A decimal number as it was written, exponent allowed: what a TOML decimal is read as."""

    def __repr__(self) -> str:
        return ascii(str(self))[1:-1]


class WrittenVector(ABC):
    """A vector that a model file does not give by its coordinates (``polar_vectors``)."""

    @abstractmethod
    def numbers(self, dimension: int) -> list[Fraction]:
        """Its coordinates, rational ones, so many."""


def parse_rational(value: object, where: str) -> Fraction:
    """The rational number that ``value`` denotes, exactly.

    Parameters
    ----------
    value : str, int, Decimal or Fraction
        A string ``"p"``, ``"p/q"`` or ``"1.25"``, or a number that is exact already. Binary floats and truth
        values are refused: a float is not the decimal that its writer had in mind.
    where : str
        Name of the field, for the message.

    Raises
    ------
    InputError
        If the value is not such a number or needs more than ``MAX_DIGITS`` digits.

    Examples
    --------
    >>> parse_rational("464.141", "base.joints[1][1]")
    Fraction(464141, 1000)
    >>> parse_rational("-5/10", "x")
    Fraction(-1, 2)
    """
    if isinstance(value, float):
        raise InputError(f'{where}: {value!r} is a binary float, not exact; write a string such as "1/4" or "0.25"')
    if isinstance(value, Fraction):
        return bounded(value, value, where, MAX_COMPUTED_DIGITS)
    if isinstance(value, int) and not isinstance(value, bool):
        return bounded(Fraction(value), value, where)
    if isinstance(value, NumberText):
        return _scientific(value, value, where)
    if isinstance(value, Decimal):
        return _scientific(str(value), value, where)
    if isinstance(value, str):
        return _plain(value, where)
    raise InputError(f"{where}: {shown(value)} is not a number; {_FORMS}")


def parse_positive(value: object, where: str) -> Fraction:
    """The rational number that ``value`` denotes, refused unless it is greater than 0."""
    number = parse_rational(value, where)
    if number <= 0:
        raise InputError(f"{where}: {shown(value)} is not positive; give a number greater than 0")
    return number


def parse_vector(row: object, where: str, dimension: int = 3) -> Vector:
    """Three rational numbers; with ``dimension = 2`` two, and 0.

    Examples
    --------
    >>> parse_vector(["1/2", 3], "x", 2)
    (Fraction(1, 2), Fraction(3, 1), Fraction(0, 1))
    """
    if isinstance(row, WrittenVector):
        row = row.numbers(dimension)
    if isinstance(row, dict):
        angles = "degrees = 30" if dimension == 2 else "degrees = 30, elevation = 0, z = 0"
        raise InputError(
            f"{where}: is a table without degrees or elevation; give a list of {dimension} numbers, or a length and "
            f"angles, as {{ length = 80, {angles} }}"
        )
    if not isinstance(row, list | tuple):
        raise InputError(f"{where}: {shown(row)} is not a list; give a list of {dimension} numbers")
    if len(row) != dimension:
        raise InputError(f"{where}: a list of {len(row)}; give a list of {dimension} numbers")
    numbers = [parse_rational(value, f"{where}[{i}]") for i, value in enumerate(row, 1)]
    x, y, z = numbers + [Fraction(0)] * (3 - dimension)
    return x, y, z


def rational_root(square: Fraction) -> Fraction | None:
    """The square root of a number that is not negative, if it is rational.

    Examples
    --------
    >>> rational_root(Fraction(9, 4)), rational_root(Fraction(2))
    (Fraction(3, 2), None)
    """
    root = Fraction(isqrt(square.numerator), isqrt(square.denominator))
    return root if root * root == square else None


def bounded(value: Fraction, original: object, where: str, digits: int = MAX_DIGITS) -> Fraction:
    """The value itself, refused if numerator or denominator is longer than ``digits``."""
    if abs(value.numerator) >= 10**digits or value.denominator > 10**digits:
        raise _too_long(original, where, digits)
    return value


def finite_decimal(value: Fraction) -> str | None:
    """The number as a decimal with as few digits as it needs; None if no decimal that ends is equal to it.

    Examples
    --------
    >>> finite_decimal(Fraction(-5, 4)), finite_decimal(Fraction(300)), finite_decimal(Fraction(1, 3))
    ('-1.25', '300', None)
    """
    rest, powers = value.denominator, {2: 0, 5: 0}
    for prime in powers:
        while rest % prime == 0:
            rest, powers[prime] = rest // prime, powers[prime] + 1
    if rest != 1:
        return None
    digits = max(powers.values())
    if not digits:
        return str(value)
    whole, part = divmod(abs(value.numerator) * 10**digits // value.denominator, 10**digits)
    return f"{'-' if value < 0 else ''}{whole}.{part:0{digits}d}"


def _plain(text: str, where: str) -> Fraction:
    if _NOT_FINITE.fullmatch(text):
        raise InputError(f"{where}: {shown(text)} is not a finite number; {_FORMS}")
    if not _PLAIN.fullmatch(text):
        raise InputError(f'{where}: {shown(text)} is not a number; a string must read "p", "p/q" or "1.25"')
    if max(map(len, text.lstrip("-").split("/"))) > MAX_DIGITS + 1:
        raise _too_long(text, where)
    if "/" in text and int(text.rpartition("/")[2]) == 0:
        raise InputError(f"{where}: {shown(text)} has denominator 0; give a positive denominator")
    return bounded(Fraction(text), text, where)


def _scientific(text: str, original: object, where: str) -> Fraction:
    if _NOT_FINITE.fullmatch(text):
        raise InputError(f"{where}: {shown(original)} is not a finite number; {_FORMS}")
    match = _SCIENTIFIC.fullmatch(text.replace("_", ""))
    if not match:
        raise InputError(f"{where}: {shown(original)} is not a number; {_FORMS}")
    sign, whole, decimals, exponent = match[1], match[2], match[3] or "", match[4] or "0"
    digits = (whole + decimals).lstrip("0")
    if max(len(digits), len(decimals)) > MAX_DIGITS or len(exponent) > 5 or abs(int(exponent)) > MAX_DIGITS:
        raise _too_long(original, where)
    value = Fraction(int(f"{sign}0{digits}")) * Fraction(10) ** (int(exponent) - len(decimals))
    return bounded(value, original, where)


def _too_long(value: object, where: str, digits: int = MAX_DIGITS) -> InputError:
    return InputError(f"{where}: {shown(value)} is too long; use at most {digits} digits, the exponent written out")
