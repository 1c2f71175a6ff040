"""Entries of certificates that are of another sort, other words, or lists that are one longer or shorter: malformed."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import product
from typing import Any

from certificate_tools import Path_

Entry = tuple[str, Path_, Any, str]
NOTHING, DOUBLE = "nothing known", "planar, multiple solutions"
BOXED, TOLERANT = "planar, boxes", "tolerance, planar, complete"


def wrong_sorts() -> Iterator[Entry]:
    """A certificate, the place of an entry, what it becomes, and the verdict."""
    yield from _words()
    yield from _leaves()
    for name, path in _lists():
        for change in (_longer, _shorter):
            yield name, path, partial(change), "malformed"


def _words() -> Iterator[Entry]:
    for path, word in ((("method",), "newton"), (("claim",), "certain"), (("robot", "kind"), "3-RRR")):
        for value in (word, "", 5, None, True, []):
            yield NOTHING, path, value, "malformed"
    for value in ("faith", "", 5, True, []):
        yield NOTHING, ("completeness_route",), value, "malformed"


INTEGERS: tuple[Path_, ...] = (("complex_solutions",), ("box_exponent",), ("representation", "chart", 0))
NUMBERS: tuple[Path_, ...] = (
    ("robot", "base", 0, 0),
    ("poses", 0, "position", 0, 0),
    ("representation", "eliminant", 0),
)
TEXTS: tuple[Path_, ...] = (("robot", "name"), ("robot", "unit"), ("formulation",), ("elimination", 0, 0))


def _leaves() -> Iterator[Entry]:
    for path, value in product(INTEGERS, ("1", True, [], None, {})):
        yield DOUBLE, path, value, "malformed"
    for value in ("1", True, [], {}):
        yield DOUBLE, ("poses", 0, "multiplicity"), value, "malformed"
    for key, value in product(("boxes", "pairs", "unproved"), (None, 5, "x" * 41, {})):
        yield TOLERANT, (key,), value, "malformed"
    for path, other in product((*NUMBERS, *TEXTS), (1, None, True, [], {})):
        yield DOUBLE, path, other, "malformed"


def _lists() -> Iterator[tuple[str, Path_]]:
    """Lists whose lengths are fixed."""
    yield from ((DOUBLE, ("robot", key)) for key in ("metric", "base", "platform"))
    yield DOUBLE, ("configuration", "lengths_squared")
    yield from ((DOUBLE, ("representation", key)) for key in ("chart", "separating_form", "quaternion", "translation"))
    yield from ((DOUBLE, ("poses", 0, key)) for key in ("parameter", "position", "rotation", "quaternion"))
    yield from ((DOUBLE, ("poses", 1, *path)) for path in (("rotation", 2), ("position", 0)))
    yield BOXED, ("krawczyk", "chart")
    yield from ((BOXED, ("krawczyk", "real", 1, key)) for key in ("exponents", "centre"))
    yield from ((BOXED, ("krawczyk", "complex", 1, "centre", *path)) for path in ((), (0,)))
    for key in ("chart", "centre", "outer", "inner", "position", "rotation", "quaternion", "centroid"):
        yield TOLERANT, ("boxes", 0, key)


def _longer(values: list[Any]) -> list[Any]:
    """The last one twice."""
    return [*values, values[-1]]


def _shorter(values: list[Any]) -> list[Any]:
    """Without the last one."""
    return values[:-1]
