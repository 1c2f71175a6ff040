"""How dimensions of machines are read from tables of a model file: lengths, numbers, vectors, words."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any, TypeAlias

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import CosSin
from pkm_exact.geometry.fields import list_field, required
from pkm_exact.geometry.machines.machine_kind import Dimension
from pkm_exact.geometry.mechanism import MOST_CONSTRAINTS
from pkm_exact.geometry.polar_vectors import PolarVector
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


def rods(
    count: int | None,
    example: str,
    what: str = "length of the rods, or rods = one per leg",
    *,
    key: str = "rod",
    table: str = "dimensions",
    squares: str = "rods_squared",
    first: str = "",
) -> Dimension:
    """Squared lengths, from ``rod`` (the same for all), ``rods`` or ``rods_squared``, or ``rod_squared``.

    ``count`` None: one for all, or as many as are given.
    """
    plural = f"{key}s"
    keys = (key, plural, f"{key}_squared", squares)

    def read(found: Mapping[str, Any], where: str) -> tuple[Fraction, ...]:
        given = [name for name in keys if name in found]
        if len(given) != 1:
            raise InputError(
                f"{where}: {' and '.join(given) or 'no rods'} given; give exactly one of {', '.join(keys)}"
            )
        name = given[0]
        place = f"{where}.{name}"
        values = _row(found[name], place, count) if name in (plural, squares) else [found[name]] * (count or 1)
        numbers = [parse_positive(value, f"{place}[{i}]") for i, value in enumerate(values, 1)]
        return tuple(number if name.endswith("squared") else number * number for number in numbers)

    shown_first = first or key
    also = tuple(name for name in keys if name != shown_first)
    return Dimension(shown_first, what, read, example, table=table, also=also, name=key)


def vectors(
    key: str,
    what: str,
    example: str,
    count: int | None,
    size: int | None = 3,
    *,
    table: str = "dimensions",
    optional: bool = False,
    name: str = "",
) -> Dimension:
    """So many vectors of ``size`` numbers, a third one 0 if that is 2; all 0 if they may be left out, and are.

    ``count`` None: at least one. ``size`` None: as many as the first has, 2 or 3.
    """

    def read(found: Mapping[str, Any], where: str) -> tuple[Vector, ...]:
        if optional and key not in found:
            return ((Fraction(0),) * 3,) * (count or 0)
        rows = _row(required(dict(found), key, f"{where}."), f"{where}.{key}", count)
        dimension = size if size is not None else 2 if isinstance(rows[0], list) and len(rows[0]) == 2 else 3
        return tuple(parse_vector(row, f"{where}.{key}[{i}]", dimension) for i, row in enumerate(rows, 1))

    return Dimension(key, what, read, example, optional, table, name=name)


def vector(key: str, what: str, example: str, size: int, default: tuple[int, ...] | None = None) -> Dimension:
    """One vector; one of two numbers is outwards and upwards, which no metric touches."""

    def read(found: Mapping[str, Any], where: str) -> Vector:
        if default is not None and key not in found:
            return parse_vector(list(default), key, size)
        written = required(dict(found), key, f"{where}.")
        if isinstance(written, PolarVector) and size == 2:
            written = written.in_ordinary_coordinates()
        return parse_vector(written, f"{where}.{key}", size)

    return Dimension(key, what, read, example, default is not None)


def numbers(key: str, what: str, example: str, count: int | None, *, angles: bool = False) -> Dimension:
    """So many numbers; with ``angles`` some may be angles between two directions, which the recipe knows."""

    def read(table: Mapping[str, Any], where: str) -> tuple[Fraction | PolarVector, ...]:
        rows = _row(required(dict(table), key, f"{where}."), f"{where}.{key}", count)
        return tuple(
            value if angles and isinstance(value, PolarVector) else parse_rational(value, f"{where}.{key}[{i}]")
            for i, value in enumerate(rows, 1)
        )

    return Dimension(key, what, read, example)


def word(key: str, what: str, words: tuple[str, ...], *, table: str = "dimensions") -> Dimension:
    """One of a few words; the first if the key is left out."""

    def read(found: Mapping[str, Any], where: str) -> str:
        value = found.get(key, words[0])
        if not isinstance(value, str) or value not in words:
            raise InputError(f"{where}.{key}: {shown(value)} is unknown; use one of: {', '.join(words)}")
        return str(value)

    return Dimension(key, what, read, f'"{words[0]}"', is_optional=True, table=table)


def turn(key: str, what: str, words: Mapping[str, CosSin]) -> Dimension:
    """Cosine and sine of an angle, by one of a few words or as { degrees = 30 }; that of the first if left out."""
    by_word = word(key, what, tuple(words))

    def read(found: Mapping[str, Any], where: str) -> CosSin:
        value = found.get(key)
        if isinstance(value, PolarVector):
            cosine, sine = value.in_ordinary_coordinates().numbers(2)
            return cosine, sine
        return words[by_word.read(found, where)]

    return replace(by_word, read=read)


def _row(value: object, where: str, count: int | None) -> list[Any]:
    row = list_field(value, where, count or 1)
    if (count is not None and len(row) != count) or not 1 <= len(row) <= MOST_CONSTRAINTS:
        raise InputError(f"{where}: {len(row)} entries; give {count or f'1 to {MOST_CONSTRAINTS}'}")
    return row
