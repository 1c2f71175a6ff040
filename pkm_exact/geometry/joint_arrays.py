"""Joints as people have them, in arrays of floating-point numbers or in a CSV file, as exact coordinates.

A float is seldom the number that was meant: it is rounded to so many decimals, or taken exactly as it is in binary, but
only as the user says.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from math import isfinite
from pathlib import Path
from typing import Any, Final

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.csv_fields import exact_number, is_header, numbered_rows
from pkm_exact.geometry.kinds import Joints
from pkm_exact.geometry.rational import NumberText, parse_rational
from pkm_exact.wording import printable, shown

MOST_DIGITS: Final = 30
MOST_ROWS: Final = 64
MOST_BYTES: Final = 1 << 16
SIDES: Final = ("base", "platform")


def exact_joints(
    rows: Iterable[Iterable[object]], where: str, digits: int | None, *, doubles_are_exact: bool
) -> Joints:
    """Joints with exact coordinates, from rows of two or three numbers.

    Parameters
    ----------
    rows : n rows of 2 or 3 numbers
        A numpy array, or lists; of int, Fraction, Decimal, str, and of float if it is said how these are meant.
    where : str
        How messages call them.
    digits : int or None
        Decimals to which every number is rounded; None for none.
    doubles_are_exact : bool
        Whether a float without ``digits`` is the rational number that it is in binary.

    Raises
    ------
    InputError
        If a number is none, or it is not said how floats are meant.

    Examples
    --------
    >>> exact_joints([[0.1, 2]], "base", 3, doubles_are_exact=False)
    ((Fraction(1, 10), Fraction(2, 1), Fraction(0, 1)),)
    """
    if digits is not None and digits not in range(MOST_DIGITS + 1):
        raise InputError(f"digits: {digits} is out of range; give an integer from 0 to {MOST_DIGITS}")
    if digits is not None and doubles_are_exact:
        raise InputError("digits, doubles_are_exact: numbers are rounded or exact; give one of the two")
    table = [_numbers_of(row, f"{where}[{i}]") for i, row in enumerate(_numbers_of(rows, where), 1)]
    found: list[Vector] = []
    for i, row in enumerate(table, 1):
        values = [_exact(value, f"{where}[{i}]", digits, doubles_are_exact) for value in row]
        if len(values) not in (2, 3):
            raise InputError(f"{where}[{i}]: {len(values)} numbers; give 2 or 3 coordinates")
        found.append((values[0], values[1], values[2] if len(values) == 3 else Fraction(0)))
    return tuple(found)


def _numbers_of(entries: Any, where: str) -> list[Any]:
    if isinstance(entries, str) or not isinstance(entries, Iterable):
        raise InputError(f"{where}: {shown(entries)} is no array; give a row of coordinates for each joint")
    return list(entries)


def _exact(value: Any, where: str, digits: int | None, doubles_are_exact: bool) -> Fraction:
    if not isinstance(value, str | int | float | Fraction) and getattr(value, "shape", None) == ():
        value = value.item()  # a number of numpy's
    if isinstance(value, float):
        value = float(value)  # numpy's are shown as such
        if not isfinite(value):
            raise InputError(f"{where}: {value!r} is not a finite number; give one")
        if digits is None and not doubles_are_exact:
            raise InputError(
                f"{where}: {value!r} is a binary float, which is seldom the number that was meant; say digits=6 to "
                "round to six decimals, or doubles_are_exact=True to take it as it is"
            )
        number = Fraction(value)
    else:
        number = parse_rational(NumberText(value) if isinstance(value, str) and "/" not in value else value, where)
    return number if digits is None else Fraction(round(number * 10**digits), 10**digits)


def read_joints_csv(path: str, digits: int | None) -> tuple[Joints, Joints, tuple[Fraction, ...] | None]:
    """Base joints, platform joints and, if there is such a column, leg lengths, from a CSV file with a row per leg.

    The first line names the columns: base_x, base_y, base_z, platform_x, platform_y, platform_z, and length; without
    those of z the robot is planar.

    Raises
    ------
    InputError
        If the file cannot be read, or is not such a table; one sentence with file, line, column and remedy.
    """
    name = printable(path)
    first, header, lines = _lines(path)
    axes = "xyz" if "base_z" in header or "platform_z" in header else "xy"
    names = [f"{side}_{axis}" for side in SIDES for axis in axes]
    wanted = (*names, "length") if "length" in header else tuple(names)
    if sorted(header) != sorted(wanted):
        said = f"the columns are {', '.join(header)[:200]}" if is_header(header) else "has no names of columns"
        axes = "" if "z" in axes else ", with base_z and platform_z unless it is planar,"
        raise InputError(f"{name}, line {first}: {said}; name them {', '.join(names)}{axes} and, if known, length")
    places = [header.index(column) for column in wanted]
    table = []
    for number, fields in lines:
        if len(fields) != len(header):
            raise InputError(f"{name}, line {number}: {len(fields)} values; give {len(header)}, one per column")
        row = [exact_number(fields[p], f"{name}, line {number}, {c}") for p, c in zip(places, wanted, strict=True)]
        table.append(row if digits is None else [Fraction(round(x * 10**digits), 10**digits) for x in row])
    if not table or len(table) > MOST_ROWS:
        raise InputError(f"{name}: {len(table)} rows; give one per leg")
    size = len(axes)
    zero = [Fraction(0)] * (3 - size)
    base, platform = (
        tuple((v[0], v[1], v[2]) for row in table for v in ([*row[k : k + size], *zero],)) for k in (0, size)
    )
    lengths = tuple(row[-1] for row in table) if "length" in header else None
    return base, platform, lengths


def _lines(path: str) -> tuple[int, list[str], list[tuple[int, list[str]]]]:
    """The number of the first line, the names of the columns in it, and the other lines."""
    try:
        data = Path(path).read_bytes()[: MOST_BYTES + 1]
        text = data.decode("utf-8-sig")
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
        raise InputError(f"{printable(path)}: cannot be read ({reason}); give the path of a CSV file") from None
    if len(data) > MOST_BYTES:
        raise InputError(f"{printable(path)}: has more than {MOST_BYTES} bytes; a table of joints must be smaller")
    try:
        rows = list(numbered_rows(text))
    except InputError as error:
        raise InputError(f"{printable(path)}: {error}") from None
    if not rows:
        raise InputError(f"{printable(path)}: is empty; give a header and a row per leg")
    return rows[0][0], [field.lower() for field in rows[0][1]], rows[1:]


def describe_rounding(digits: int | None) -> str:
    """How numbers were taken, as a sentence for the model's source.

    >>> describe_rounding(3)
    'every number rounded to 3 decimals'
    """
    return "every number exactly as it was given" if digits is None else f"every number rounded to {digits} decimals"
