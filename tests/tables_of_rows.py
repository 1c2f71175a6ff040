"""Tables of certificates whose rows have names of their own, and certificates with one entry changed."""

from __future__ import annotations

from collections.abc import Mapping
from copy import deepcopy
from typing import Any, TypeVar

Entry = TypeVar("Entry")


def merged(*tables: Mapping[str, Entry]) -> dict[str, Entry]:
    """All rows; no name occurs twice."""
    found: dict[str, Entry] = {}
    for table in tables:
        twice = sorted(set(found) & set(table))
        assert not twice, twice
        found |= table
    return found


def put(content: dict[str, Any], value: Any, *path: Any) -> dict[str, Any]:
    """With another entry."""
    found = deepcopy(content)
    entry: Any = found
    for key in path[:-1]:
        entry = entry[key]
    entry[path[-1]] = value
    return found
