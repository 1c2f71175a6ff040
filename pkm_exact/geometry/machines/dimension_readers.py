"""How dimensions of machines are read from tables of a model file: lengths, numbers, vectors, words."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any, TypeAlias

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.fields import list_field, required
from pkm_exact.geometry.machines.machine_kind import Dimension
from pkm_exact.geometry.rational import parse_positive, parse_rational, parse_vector
from pkm_exact.wording import shown

Read: TypeAlias = Callable[[Mapping[str, Any], str], Any]


def length(key: str, what: str, example: str, *, may_be_zero: bool = False) -> Dimension:
    """A positive number, or 0 where that makes sense."""

    def read(table: Mapping[str, Any], where: str) -> Fraction:
        value = required(dict(table), key, f"{where}.")
        if not may_be_zero:
            return parse_positive(value, f"{where}.{key}")
        number = parse_rational(value, f"{where}.{key}")
        if number < 0:
            raise InputError(f"{where}.{key}: {shown(value)} is negative; give a length, or 0")
        return number

    return Dimension(key, what, read, example)


def number(key: str, what: str, example: str, default: int | None = None) -> Dimension:
    """Any number; ``default`` if the key is left out."""

    def read(table: Mapping[str, Any], where: str) -> Fraction:
        if default is not None and key not in table:
            return Fraction(default)
        return parse_rational(required(dict(table), key, f"{where}."), f"{where}.{key}")

    return Dimension(key, what, read, example, default is not None)


def rods(count: int, example: str, what: str = "length of the rods, or rods = one per leg") -> Dimension:
    """Squared lengths, from ``rod`` (the same for all), ``rods`` or ``rods_squared``, or ``rod_squared``."""
    keys = ("rod", "rods", "rod_squared", "rods_squared")

    def read(table: Mapping[str, Any], where: str) -> tuple[Fraction, ...]:
        given = [key for key in keys if key in table]
        if len(given) != 1:
            raise InputError(
                f"{where}: {' and '.join(given) or 'no rods'} given; give exactly one of {', '.join(keys)}"
            )
        key = given[0]
        place = f"{where}.{key}"
        values = [table[key]] * count if key.startswith("rod_") or key == "rod" else _row(table[key], place, count)
        numbers = [parse_positive(value, f"{place}[{i}]") for i, value in enumerate(values, 1)]
        return tuple(number if key.endswith("squared") else number * number for number in numbers)

    return Dimension("rod", what, read, example, also=keys[1:])


def vectors(
    key: str, what: str, example: str, count: int, size: int = 3, *, table: str = "dimensions", optional: bool = False
) -> Dimension:
    """So many vectors of ``size`` numbers, the third 0 if that is 2; all 0 if they may be left out, and are."""

    def read(found: Mapping[str, Any], where: str) -> tuple[Vector, ...]:
        if optional and key not in found:
            return ((Fraction(0),) * 3,) * count
        rows = _row(required(dict(found), key, f"{where}."), f"{where}.{key}", count)
        return tuple(parse_vector(row, f"{where}.{key}[{i}]", size) for i, row in enumerate(rows, 1))

    return Dimension(key, what, read, example, optional, table)


def vector(key: str, what: str, example: str, size: int, default: tuple[int, ...] | None = None) -> Dimension:
    """One vector."""

    def read(found: Mapping[str, Any], where: str) -> Vector:
        if default is not None and key not in found:
            return parse_vector(list(default), key, size)
        return parse_vector(required(dict(found), key, f"{where}."), f"{where}.{key}", size)

    return Dimension(key, what, read, example, default is not None)


def numbers(key: str, what: str, example: str, count: int) -> Dimension:
    """So many numbers."""

    def read(table: Mapping[str, Any], where: str) -> tuple[Fraction, ...]:
        rows = _row(required(dict(table), key, f"{where}."), f"{where}.{key}", count)
        return tuple(parse_rational(value, f"{where}.{key}[{i}]") for i, value in enumerate(rows, 1))

    return Dimension(key, what, read, example)


def word(key: str, what: str, words: tuple[str, ...], *, table: str = "dimensions") -> Dimension:
    """One of a few words; the first if the key is left out."""

    def read(found: Mapping[str, Any], where: str) -> str:
        value = found.get(key, words[0])
        if not isinstance(value, str) or value not in words:
            raise InputError(f"{where}.{key}: {shown(value)} is unknown; use one of: {', '.join(words)}")
        return str(value)

    return Dimension(key, what, read, f'"{words[0]}"', is_optional=True, table=table)


def _row(value: object, where: str, count: int) -> list[Any]:
    row = list_field(value, where, count)
    if len(row) != count:
        raise InputError(f"{where}: {len(row)} entries; give {count}")
    return row
