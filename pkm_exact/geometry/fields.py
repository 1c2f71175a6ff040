"""Fields of the tables in a model file: there or missing, known or not, a label, a list."""

from __future__ import annotations

from typing import Any

from pkm_exact.errors import InputError
from pkm_exact.geometry.rational import NumberText
from pkm_exact.wording import shown


def known_keys(table: dict[str, Any], known: tuple[str, ...], prefix: str) -> None:
    """Refuse a table with a key that is not among the known ones."""
    for key in table:
        if key not in known:
            raise InputError(
                f"{prefix or 'top level'}: unknown key {shown(key)}; the known keys are: {', '.join(known)}"
            )


def required(table: dict[str, Any], key: str, prefix: str) -> Any:
    """The value of a key that must be there."""
    if key not in table:
        raise InputError(f"{prefix}{key}: is missing; add it (see the model format in the documentation)")
    return table[key]


def label(table: dict[str, Any], key: str, prefix: str, *, limit: int = 200) -> str:
    """A text of one line that must be there."""
    value = required(table, key, prefix)
    if isinstance(value, NumberText) or not isinstance(value, str):
        raise InputError(f'{prefix}{key}: {shown(value)} is not text; write it in quotes, such as {key} = "..."')
    if not value.strip() or not value.isprintable() or len(value) > limit:
        raise InputError(f"{prefix}{key}: {shown(value)} is not a label; write 1 to {limit} printable characters")
    return value


def list_field(value: object, where: str, length: int) -> list[Any]:
    """The value itself, which must be a list; ``length`` is only for the message."""
    if not isinstance(value, list):
        raise InputError(f"{where}: {shown(value)} is not a list; give a list of {length}")
    return value


def truth(table: dict[str, Any], key: str, where: str) -> bool:
    """A truth value; false if the key is left out."""
    value = table.get(key, False)
    if not isinstance(value, bool):
        raise InputError(
            f"{where}{'.' if where else ''}{key}: {shown(value)} is neither true nor false; write one of them"
        )
    return value


def table_field(table: dict[str, Any], key: str, example: str) -> dict[str, Any]:
    """A table that must be there; ``example`` is a line to write into it."""
    value = required(table, key, "")
    if not isinstance(value, dict):
        raise InputError(f"{key}: {shown(value)} is not a table; write [{key}] and {example} below it")
    return value
