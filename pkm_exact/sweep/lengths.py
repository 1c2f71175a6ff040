"""CSV files with one length vector per row, read line by line: a million rows take no more memory than one.

One column per leg (``l1``, ``l2``, ..) or actuated constraint (its name), numbers exact. A first line with these names
may be left out. Blank lines and lines that begin with # are skipped. What is wrong with one row is said in its answer;
the others are not affected.
"""

from __future__ import annotations

import csv
import os
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from hashlib import file_digest
from io import BufferedReader
from pathlib import Path
from typing import Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.csv_fields import (
    delimiter_of,
    exact_number,
    header_names,
    is_header,
    require_length,
    split_line,
)
from pkm_exact.geometry.given_joints import joint_configuration, joint_word
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.path_reader import joint_names
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.robot import Robot
from pkm_exact.wording import printable

MAX_BYTES: Final = 1 << 32
MAX_LINE: Final = 1 << 14
"""Bytes of a line; six fractions of the largest size take less than a third of it."""
_BYTE_ORDER: Final = b"\xef\xbb\xbf"
_COMMENT: Final = b"#"


@dataclass(frozen=True)
class LengthRow:
    """One row of a file.

    Attributes
    ----------
    number : int
        From 1; lines without numbers do not count.
    line : int
        Where it stands in the file, from 1.
    fields : tuple of str
        As they were written, without blanks around them.
    defect : str or None
        What is wrong with the line, if it has no fields.
    """

    number: int
    line: int
    fields: tuple[str, ...]
    defect: str | None = None


@dataclass(frozen=True)
class LengthsFile:
    """A file of length vectors.

    Attributes
    ----------
    path : str
    names : tuple of str
        Of the columns.
    digest : str
        SHA-256 of its bytes.
    count : int
        Number of rows.
    """

    path: str
    names: tuple[str, ...]
    digest: str
    count: int

    def rows(self) -> Iterator[LengthRow]:
        """The rows, each read when it is asked for; at the end it is made sure that they are those of the digest.

        Raises
        ------
        InputError
            If the file cannot be read any more, or was changed.
        """
        try:
            with Path(self.path).open("rb") as stream:
                yield from _rows(stream, self.names)
            if _digest(self.path) != self.digest:
                raise InputError("was changed while it was read; start again with a new output file")
        except (OSError, InputError) as error:
            raise _named(self.path, error) from None


def read_lengths(path: str | os.PathLike[str], robot: Machine, *, joints: bool = False) -> LengthsFile:
    """The file of length vectors of a robot. What concerns it as a whole is checked; its numbers are not read yet.

    With ``joints`` it has joint values of cranks and slides as well (``geometry.given_joints``).

    Raises
    ------
    InputError
        With file, line, value and remedy.
    """
    name = os.fspath(path)
    names = joint_names(robot)
    try:
        if not names:
            raise InputError(f"{robot.name} has no actuated constraints; solve its configurations one by one")
        if isinstance(robot, Robot) and robot.chains and not joints:
            raise InputError(
                f"the rods of a {robot.kind} robot have fixed lengths; give joint values in its rows, and --joints"
            )
        if not Path(name).exists():
            raise InputError("does not exist; give the path of a CSV file")
        if not Path(name).is_file():
            raise InputError("is not a regular file; give the path of a CSV file")
        if Path(name).stat().st_size > MAX_BYTES:
            raise InputError(f"has more than {MAX_BYTES} bytes; cut it in pieces")
        digest = _digest(name)
        with Path(name).open("rb") as stream:
            count = sum(1 for _ in _rows(stream, names))
        if not count:
            raise InputError(f"has no rows; give one row of {len(names)} lengths ({', '.join(names)}) per problem")
    except (OSError, ValueError, InputError) as error:
        raise _named(name, error) from None
    return LengthsFile(name, names, digest, count)


def row_values(row: LengthRow, names: tuple[str, ...]) -> list[Fraction]:
    """The numbers that a row has, exactly.

    Parameters
    ----------
    row : LengthRow
    names : tuple of str
        Of the columns.

    Raises
    ------
    InputError
        If they are not as many numbers as there are columns.

    Examples
    --------
    >>> row_values(LengthRow(1, 2, ("7", "5/2", "0.1")), ("l1", "l2", "l3"))
    [Fraction(7, 1), Fraction(5, 2), Fraction(1, 10)]
    """
    line = f"line {row.line}"
    _require_fields(row, names)
    return [exact_number(field, f"{line}, {name}") for field, name in zip(row.fields, names, strict=True)]


def _require_fields(row: LengthRow, names: tuple[str, ...]) -> None:
    line = f"line {row.line}"
    if row.defect is not None:
        raise InputError(f"{line}: {row.defect}")
    if len(row.fields) != len(names):
        raise InputError(f"{line}: {len(row.fields)} values; give {len(names)}: {', '.join(names)}")
    if is_header(row.fields) and tuple(field.lower() for field in row.fields) == names:
        raise InputError(f"{line}: is a second header; remove it")


def robot_at(robot: Machine, row: LengthRow, names: tuple[str, ...]) -> tuple[Machine, str]:
    """The robot with the joint values of a row as a further configuration, and that configuration's name.

    Raises
    ------
    InputError
        If they are no joint values of the robot.
    """
    _require_fields(row, names)
    line = f"line {row.line}"
    words = [joint_word(field, f"{line}, {name}") for field, name in zip(row.fields, names, strict=True)]
    if not isinstance(robot, Robot | Mechanism):
        raise InputError(f"{line}: {robot.name} has no joint values; solve its configurations one by one")
    return joint_configuration(robot, words, line)


def problem_of(robot: Machine, row: LengthRow, names: tuple[str, ...], *, squared: bool) -> ForwardProblem:
    """The problem that a row poses; its values are lengths, or squared ones, and of a mechanism offsets and products.

    Raises
    ------
    InputError
        As ``row_values``, and if a length is not positive.
    """
    values = row_values(row, names)
    if isinstance(robot, Robot):
        for value, name in zip(values, names, strict=True):
            require_length(value, f"line {row.line}, {name}")
    try:
        return robot.problem_at(values, squared=squared)
    except InputError as error:
        raise InputError(f"line {row.line}: {error}") from None


def _rows(stream: BufferedReader, names: tuple[str, ...]) -> Iterator[LengthRow]:
    """The rows of a file from its beginning."""
    number, is_first, mark = 0, True, ","
    for line, text in enumerate(_lines(stream), 1):
        if is_first and text is not None:
            mark = delimiter_of(text.decode("utf-8", "replace"))
        row = _row(number + 1, line, text, mark)
        if row is None:
            continue
        if is_first and is_header(row.fields):
            header_names(row.fields, (names,), ",".join(names), f"line {line}")
        else:
            yield row
            number += 1
        is_first = False


def _lines(stream: BufferedReader) -> Iterator[bytes | None]:
    """The lines of a file; None for one that is too long, comments shortened."""
    stream.seek(len(_BYTE_ORDER) if stream.read(len(_BYTE_ORDER)) == _BYTE_ORDER else 0)
    while line := stream.readline(MAX_LINE):
        whole = line
        while len(whole) == MAX_LINE and not whole.endswith(b"\n"):
            whole = stream.readline(MAX_LINE)
        yield line if whole is line else _COMMENT if line.lstrip().startswith(_COMMENT) else None


def _row(number: int, line: int, data: bytes | None, mark: str) -> LengthRow | None:
    """The row in a line, or None if the line has none."""
    if data is None:
        return LengthRow(number, line, (), f"has more than {MAX_LINE} bytes; give one length per leg")
    if data.lstrip().startswith(_COMMENT):
        return None
    try:
        text = data.decode("utf-8")
        fields = tuple(split_line(text.rstrip("\r\n"), mark))
    except UnicodeDecodeError:
        return LengthRow(number, line, (), "is not UTF-8 text; save the file as UTF-8")
    except csv.Error as error:
        return LengthRow(number, line, (), f"is not CSV ({error}); separate numbers by commas")
    return LengthRow(number, line, fields) if any(fields) else None


def _digest(path: str) -> str:
    with Path(path).open("rb") as stream:
        return file_digest(stream, "sha256").hexdigest()


def _named(path: str, error: Exception) -> InputError:
    """The error with the name of the file before it."""
    if isinstance(error, OSError):
        return InputError(f"{printable(path)}: cannot be read ({error.strerror}); give the path of a CSV file")
    return InputError(f"{printable(path)}: {error}")
