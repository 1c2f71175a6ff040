"""What lines of CSV files with one column per leg have in common: headers, and numbers as they were written.

Fields are separated by commas, or by semicolons or tabs, as spreadsheets write them. Between semicolons a comma is a
decimal point: programs take semicolons where it is one.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.rational import NumberText, parse_rational
from pkm_exact.wording import shown

_NOT_FINITE: Final = ("nan", "inf", "infinity")
_QUOTED: Final = re.compile(r'"[^"]*"')
_DECIMAL_COMMA: Final = re.compile(r"([+-]?[0-9]{1,100}),([0-9]{1,100}(?:[eE][+-]?[0-9]{1,10})?(?:\s*deg)?)", re.ASCII)


def is_header(fields: Sequence[str]) -> bool:
    """Whether a line has names.

    Examples
    --------
    >>> is_header(["l1", "l2", "l3"]), is_header(["7", "1e1", "nan"])
    (True, False)
    """
    return any(field[:1].isalpha() and field.lower() not in _NOT_FINITE for field in fields)


def delimiter_of(line: str) -> str:
    """What separates the fields of a line.

    >>> [delimiter_of(line) for line in ("l1,l2", "1,5; 2", "1.5\\t2", '"a;b",2')]
    [',', ';', '\\t', ',']
    """
    bare = _QUOTED.sub("", line)
    return next((mark for mark in ";,\t" if mark in bare), ",")


def split_line(line: str, mark: str) -> list[str]:
    """The fields of one line that this mark separates, without blanks around them, decimal commas as points.

    Raises
    ------
    csv.Error
        If it is no line of CSV.

    Examples
    --------
    >>> split_line("7, 5/2,30deg", ","), split_line("7,5; 1.000,5; 30,5deg", ";")
    (['7', '5/2', '30deg'], ['7.5', '1.000,5', '30.5deg'])
    """
    return [_field(cell, mark) for cells in csv.reader([line], delimiter=mark) for cell in cells]


def _field(cell: str, mark: str) -> str:
    text = cell.strip()
    decimal = _DECIMAL_COMMA.fullmatch(text) if mark == ";" else None
    return text if decimal is None else f"{decimal[1]}.{decimal[2]}"


def numbered_rows(text: str) -> Iterator[tuple[int, list[str]]]:
    """The fields of each line, with its number; without empty lines and those that begin with #.

    Raises
    ------
    InputError
        If the text is not CSV.

    Examples
    --------
    >>> list(numbered_rows("# a path\\nl1, l2\\n\\n7,5\\n"))
    [(2, ['l1', 'l2']), (4, ['7', '5'])]
    """
    lines = text.splitlines()
    first = next((line for line in lines if line.strip() and not line.lstrip().startswith("#")), "")
    mark = delimiter_of(first)
    reader = csv.reader(lines, delimiter=mark)
    try:
        for cells in reader:
            fields = [_field(cell, mark) for cell in cells]
            if any(fields) and not fields[0].startswith("#"):
                yield reader.line_num, fields
    except csv.Error as error:
        raise InputError(f"line {reader.line_num}: not CSV ({error}); separate numbers by commas") from None


def header_names(fields: Sequence[str], choices: Sequence[tuple[str, ...]], wanted: str, line: str) -> tuple[str, ...]:
    """The names of the columns, which must be one of the choices.

    Parameters
    ----------
    fields : sequence of str
        Of the header.
    choices : sequence of tuples of str
        In small letters.
    wanted : str
        The choices as they are named to the user.
    line : str
        Where the header stands.

    Raises
    ------
    InputError
        If a name is there twice, or the names are none of the choices.
    """
    found = tuple(field.lower() for field in fields)
    if found in choices:
        return found
    double = next((name for place, name in enumerate(found) if name in found[:place]), None)
    if double is not None:
        raise InputError(f"{line}: two columns are called {shown(double)}; name them {wanted}")
    raise InputError(f"{line}: the columns are {shown(','.join(fields))}; name them {wanted}")


def exact_number(field: str, where: str) -> Fraction:
    """The number that a field denotes: an integer, a fraction, or a decimal, with an exponent too.

    Raises
    ------
    InputError
        If it denotes none, or one with too many digits.

    Examples
    --------
    >>> exact_number("12.5e2", "line 1, l1"), exact_number("-1/3", "line 1, l2")
    (Fraction(1250, 1), Fraction(-1, 3))
    """
    if not field:
        raise InputError(f"{where}: is empty; give a number")
    return parse_rational(field if "/" in field else NumberText(field), where)


def require_length(value: Fraction, where: str) -> None:
    """Refuse a number that is no length."""
    if value <= 0:
        raise InputError(f"{where}: {shown(value)} is not a length; give a number greater than 0")
