"""A first model of a machine that has a recipe: its dimensions with what they mean, and a configuration."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.machines.machine_kind import MachineKind
from pkm_exact.wording import shown

_COLUMN: Final = 42
_LONGEST: Final = 2000
_WORD: Final = re.compile(r"-?[0-9A-Za-z]+", re.ASCII)
_FRACTION: Final = re.compile(r"-?[0-9]+/[0-9]+", re.ASCII)


def given_dimensions(kind: MachineKind, words: Sequence[str]) -> dict[str, str]:
    """The dimensions of words such as "arm=120", as a model file has them; what they are worth is seen when it is read.

    Examples
    --------
    >>> from pkm_exact.geometry.machines.machine_kinds import MACHINES
    >>> given_dimensions(MACHINES["delta"], ["arm=1/3"])
    {'arm': '"1/3"'}
    >>> given_dimensions(MACHINES["P-FUS"], ["freedoms=4"])
    {'freedoms': '"4"'}
    """
    known = [key for dimension in kind.dimensions for key in (dimension.key, *dimension.also)]
    found: dict[str, str] = {}
    for word in words:
        key, equals, value = (part.strip() for part in word.partition("="))
        if key not in known or not equals:
            raise InputError(f"--dimension: {shown(word)} is none of a {kind.name}; give one of: {', '.join(known)}")
        if not value.isprintable() or len(value) > _LONGEST:
            raise InputError(f"--dimension {key}: {shown(value)} is no value; give a number, or a list of numbers")
        found[key] = f'"{value}"' if _FRACTION.fullmatch(value) or _is_bare(kind, key, value) else value
    return found


def _is_bare(kind: MachineKind, key: str, value: str) -> bool:
    """Whether it is a word without its quotes, as it is written on a command line."""
    is_word = any(found.key == key and found.is_optional and found.example.startswith('"') for found in kind.dimensions)
    return is_word and _WORD.fullmatch(value) is not None


def machine_text(kind: MachineKind, name: str, unit: str, given: Mapping[str, str] | None = None) -> str:
    """The text of a model file: the dimensions given, as a model file has them, and examples of the others.

    Examples
    --------
    >>> from pkm_exact.geometry.machines.machine_kinds import MACHINES
    >>> print(machine_text(MACHINES["delta"], "example", "m", {"arm": "2"}).splitlines()[12])
    arm = 2                                   # length of the cranks
    """
    chosen = given or {}
    words = "".join(f" --dimension {key}={value}" for key, value in chosen.items())
    lines = [
        "# A model file for certify-poses. What follows a # is comment. Every number means exactly what is written:",
        '# 0.1 is 1/10, and "1/3", in quotes, is a third.',
        _line("schema = 1", "version of this format"),
        _line(f"name = {json.dumps(name, ensure_ascii=False)}", "shown above every result"),
        _line(f"kind = {json.dumps(kind.name)}", kind.description),
        _line(f"unit = {json.dumps(unit, ensure_ascii=False)}", "of all lengths; only shown, nothing is converted"),
        "# Where the numbers come from: a drawing, a paper, a calibration. Say it here once they are yours.",
        f"source = {json.dumps(f'a first design, drawn by certify-poses new --kind {kind.name}{words}')}",
    ]
    for table in kind.tables:
        lines += ["", f"[{table}]", *_dimensions(kind, table, chosen)]
    lines += [
        "",
        "# Locked actuators, under a name; as many of these tables as you like. The first is what `solve` takes.",
        "[[configurations]]",
        'name = "home"',
        *(f"{key} = {value}" for key, value in kind.home_with(chosen).items()),
    ]
    return "\n".join(lines) + "\n"


def _dimensions(kind: MachineKind, table: str, chosen: Mapping[str, str]) -> Iterator[str]:
    for dimension in kind.dimensions:
        if dimension.table != table:
            continue
        key = next((key for key in (dimension.key, *dimension.also) if key in chosen), dimension.key)
        entry = f"{key} = {chosen.get(key, dimension.example)}"
        if dimension.is_optional and key not in chosen:
            yield f"# {dimension.what}; may be left out:"
            yield f"# {entry}"
        elif len(entry) < _COLUMN - 1:
            yield _line(entry, dimension.what)
        else:
            yield f"# {dimension.what}"
            yield entry


def _line(text: str, comment: str) -> str:
    return f"{text:<{_COLUMN - 1}} # {comment}"
