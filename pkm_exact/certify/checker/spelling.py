"""Reading JSON strictly: every value has one spelling, every size is bounded before a number is made of it."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from fractions import Fraction
from hashlib import sha256
from json.encoder import encode_basestring_ascii
from math import gcd
from typing import Any, Final, TypeVar

from flint import fmpz

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.verdict import (
    MAX_BYTES,
    MAX_COEFFICIENT_BITS,
    MAX_ENTRIES,
    MAX_RATIONAL_LENGTH,
    MAX_TEXT,
    malformed,
    rejected,
    too_large,
)

READING: Final = 1000
"""Operations charged for each byte that is read, whatever it stands for."""

_Value = TypeVar("_Value")

_RATIONAL: Final = re.compile(r"(0|-?[1-9][0-9]*)(?:/([1-9][0-9]*))?", re.ASCII)
_MAX_DEPTH: Final = 16
_LINES: Final = tuple("\n" + depth * " " for depth in range(_MAX_DEPTH))
"""How lines begin, by how many brackets are around them."""
_TEXTS: Final = {str}
_DIGITS: Final = b"0123456789abcdef"
_INTEGER_DIGITS: Final = 12
_RATIONAL_DIGITS: Final = 600


def read_sealed(data: bytes) -> dict[str, Any]:
    """The JSON object in ``data`` without its digest, which must be that of the content, spelled canonically."""
    charge(READING * len(data))
    content = _json(data)
    if not isinstance(content, dict) or not isinstance(content.get("digest"), str):
        raise malformed("file: not a JSON object with a digest")
    digest = content.pop("digest")
    # Without these bytes no text was written with an escape, and none has to be.
    body = _canonical_bytes(content, is_plain=b"\\" not in data and b"\x7f" not in data)
    whole = body.removesuffix(b"\n}\n") + f',\n "digest": {json.dumps(digest)}\n}}\n'.encode("ascii")
    if digest != f"sha256:{sha256(body).hexdigest()}":
        raise rejected("digest: differs from that of the content")
    if data != whole:
        raise malformed("file: not in canonical form, one entry per line with an indent of one space per level")
    return content


def _canonical_bytes(content: object, *, is_plain: bool = False) -> bytes:
    """The canonical form of what a file contains; texts that are plain need no escapes."""
    return (_spelled(content, 0, is_plain) + "\n").encode("ascii")


def _spelled(value: Any, depth: int, is_plain: bool) -> str:
    """The canonical form of a value with so many around it: an entry has a line, one space further in than these."""
    kind = type(value)
    if kind is str:
        return f'"{value}"' if is_plain else encode_basestring_ascii(value)
    if not value or (kind is not list and kind is not dict):
        return json.dumps(value)
    if depth + 1 >= _MAX_DEPTH:  # lines are indented: depth would make the text long
        raise malformed("file: brackets are nested too deeply")
    line, inner = _LINES[depth], _LINES[depth + 1]
    if kind is dict:
        pairs = [f"{_spelled(key, depth, is_plain)}: {_spelled(value[key], depth + 1, is_plain)}" for key in value]
        return f"{{{inner}{f',{inner}'.join(pairs)}{line}}}"
    if is_plain and {*map(type, value)} == _TEXTS:  # most lists
        between = f'",{inner}"'
        return f'[{inner}"{between.join(value)}"{line}]'
    return f"[{inner}{f',{inner}'.join([_spelled(entry, depth + 1, is_plain) for entry in value])}{line}]"


def _json(data: bytes) -> Any:
    if len(data) > MAX_BYTES:
        raise too_large(f"file: more than {MAX_BYTES} bytes")
    if len(data) > MAX_ENTRIES and sum(map(data.count, (b",", b"[", b"{"))) > MAX_ENTRIES:
        raise too_large(f"file: more than {MAX_ENTRIES} entries")
    try:
        return json.loads(
            data.decode("ascii"),
            object_pairs_hook=_unique_keys,
            parse_int=_short_integer,
            parse_float=_no_float,
            parse_constant=_no_float,
        )
    except RecursionError:
        raise malformed("file: brackets are nested too deeply") from None
    except ValueError:
        raise malformed("file: not JSON in ASCII") from None


def _unique_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    content = dict(pairs)
    if len(content) != len(pairs):
        raise malformed("file: a key occurs twice in one object")
    return content


def _short_integer(text: str) -> int:
    if len(text) > _INTEGER_DIGITS:
        raise malformed(f"file: an integer of more than {_INTEGER_DIGITS} digits")
    return int(text)


def _no_float(_text: str) -> float:
    raise malformed("file: a number with a decimal point or an exponent, or no number at all")


def entries(value: object, where: str, keys: tuple[str, ...]) -> list[Any]:
    """The values of an object that has exactly these keys, in this order."""
    if not isinstance(value, dict) or tuple(value) != keys:
        raise malformed(f"{where}: not an object with the keys {', '.join(keys)}, in this order")
    return list(value.values())


def items(value: object, where: str, length: int | None, read: Callable[[Any, str], _Value]) -> tuple[_Value, ...]:
    """The entries of a list of the given length (any if None), each read with ``read``."""
    if not isinstance(value, list) or (length is not None and len(value) != length):
        raise malformed(f"{where}: not a list" + (f" of {length}" if length is not None else ""))
    return tuple([read(entry, f"{where}[{number}]") for number, entry in enumerate(value, 1)])


def text(value: object, where: str) -> str:
    """A text."""
    if not isinstance(value, str):
        raise malformed(f"{where}: not a text")
    if len(value) > MAX_TEXT:
        raise too_large(f"{where}: more than {MAX_TEXT} characters")
    return value


def choice(value: object, where: str, known: tuple[str, ...]) -> str:
    """One of the known words."""
    if not isinstance(value, str) or value not in known:
        raise malformed(f"{where}: not one of {', '.join(known)}")
    return value


def integer(value: object, where: str) -> int:
    """An integer written as a JSON number."""
    if type(value) is not int:
        raise malformed(f"{where}: not an integer")
    return value


def count(value: object, where: str) -> int:
    """An integer that is not negative."""
    number = integer(value, where)
    if number < 0:
        raise malformed(f"{where}: negative")
    return number


def rational_text(value: object, where: str) -> str:
    """A text "p" or "p/q" without sign +, without leading zeros."""
    if not isinstance(value, str):
        raise malformed(f"{where}: not a rational number in quotes")
    if len(value) > MAX_RATIONAL_LENGTH:
        raise too_large(f"{where}: more than {MAX_RATIONAL_LENGTH} characters")
    if not _RATIONAL.fullmatch(value):
        raise malformed(f"{where}: not a rational number p or p/q")
    return value


def rational_texts(value: object, where: str, length: int) -> tuple[str, ...]:
    """A list of so many such texts."""
    if isinstance(value, list) and len(value) == length and all(map(_is_rational_text, value)):
        return tuple(value)
    return items(value, where, length, rational_text)  # says which one is not, and why


def _is_rational_text(value: object) -> bool:
    return isinstance(value, str) and len(value) <= MAX_RATIONAL_LENGTH and _RATIONAL.fullmatch(value) is not None


def rational(value: object, where: str, digits: int = _RATIONAL_DIGITS) -> Fraction:
    """A rational number "p" or "p/q" in lowest terms, q > 1, each of at most 600 digits or another number of them."""
    written = rational_text(value, where)
    numerator, _, denominator = written.partition("/")
    if max(len(numerator), len(denominator)) > digits:
        raise too_large(f"{where}: more than {digits} digits")
    p, q = _integer(numerator), _integer(denominator or "1")
    if denominator and (q == 1 or gcd(p, q) > 1):
        raise malformed(f"{where}: not in lowest terms")
    return Fraction(p, q)


def _integer(digits: str) -> int:
    """The number; of more digits than Python may be set to read (PYTHONINTMAXSTRDIGITS), as FLINT reads it."""
    return int(digits) if len(digits) <= _RATIONAL_DIGITS else int(fmpz(digits))


def rational_as_text(value: Fraction) -> str:
    """The text of a rational number that ``rational`` reads; of one as long as may be."""
    numerator = str(fmpz(value.numerator))
    return numerator if value.denominator == 1 else f"{numerator}/{fmpz(value.denominator)}"


def positive(value: object, where: str) -> Fraction:
    """A rational number greater than 0."""
    number = rational(value, where)
    if number <= 0:
        raise malformed(f"{where}: not positive")
    return number


def hexadecimal(value: object, where: str) -> int:
    """An integer in hexadecimal digits, 0x before them."""
    if not isinstance(value, str):
        raise malformed(f"{where}: not an integer in hexadecimal digits")
    if 4 * len(value) > MAX_COEFFICIENT_BITS:
        raise too_large(f"{where}: more than {MAX_COEFFICIENT_BITS} bits")
    digits = value[3:] if value.startswith("-0x") else value[2:] if value.startswith("0x") else ""
    strange = digits.encode("ascii", "replace").translate(None, _DIGITS)
    if not digits or strange or (digits[0] == "0" and value != "0x0"):
        raise malformed(f"{where}: not an integer in hexadecimal digits")
    return int(value, 16)
