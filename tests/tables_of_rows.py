"""Tables of certificates whose rows have names of their own."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

Entry = TypeVar("Entry")


def merged(*tables: Mapping[str, Entry]) -> dict[str, Entry]:
    """All rows; no name occurs twice."""
    found: dict[str, Entry] = {}
    for table in tables:
        twice = sorted(set(found) & set(table))
        assert not twice, twice
        found |= table
    return found
