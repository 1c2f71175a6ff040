"""Entries of certificates of version 2 at each limit of the format, beyond it, and of another sort."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import partial
from itertools import product
from typing import Any

from certificate_tools import Path_

Entry = tuple[str, Path_, Any, str]
PLANAR, BOXED = "kept-2, planar lines", "kept-2, planar lines, boxes"
MOVING = "moving-2, few legs"
CONSTRAINT: Path_ = ("robot", "constraints", 0)


def mechanism_limits() -> Iterator[Entry]:
    """A certificate, the place of an entry, what it becomes, and the verdict."""
    yield from _texts()
    yield from _constraints()
    yield from _points_at_infinity()
    yield from _motions()
    yield from _boxes()


def _texts() -> Iterator[Entry]:
    for key in ("name", "unit", "source"):
        for value, status in (("x" * 10_000, "accepted"), ("x" * 10_001, "too-large"), (5, "malformed")):
            yield PLANAR, ("robot", key), value, status
    for value, status in (("x" * 10_000, "accepted"), ("x" * 10_001, "too-large"), (None, "malformed")):
        yield PLANAR, (*CONSTRAINT, "name"), value, status
    for value, status in (("x" * 10_000, "accepted"), ("x" * 10_001, "too-large"), (5, "malformed")):
        yield PLANAR, ("configuration",), value, status
        yield PLANAR, ("notes",), [value], status
    for value in ("SE2", "", 5, None):
        yield PLANAR, ("formulation",), value, "malformed"
    for value in ("pkm_exact certificates", "", None, 2):
        yield PLANAR, ("format",), value, "malformed"
    for value, status in ((8192, "rejected"), (8193, "too-large"), (-1, "malformed")):
        yield PLANAR, ("box_exponent",), value, status
    for key, value in product(("method", "claim", "completeness_route"), ("faith", "", 5, True)):
        yield PLANAR, (key,), value, "malformed"


def _constraints() -> Iterator[Entry]:
    for value, status in (("1/2", "malformed"), ("3/2", "malformed"), ("0", "malformed"), ("2", "rejected")):
        yield PLANAR, ("robot", "metric", 0), value, status
        yield PLANAR, ("robot", "metric", 1), value, status
    for value in ("1/2", "3/2", "0"):
        yield PLANAR, ("robot", "metric", 2), value, "malformed"
    for value in (None, 5, "x", {}, [], "x" * 64):
        yield PLANAR, ("robot", "constraints"), value, "malformed"
    for number, status in ((64, "accepted"), (65, "malformed")):
        yield PLANAR, ("robot", "constraints"), partial(_repeated, number), status
    for value in (None, 5, "in-plane", [], {}):
        yield PLANAR, CONSTRAINT, value, "malformed"
    yield from _forms()


def _forms() -> Iterator[Entry]:
    for value in ("in-line", "", 5, None, [], {}):
        yield PLANAR, (*CONSTRAINT, "type"), value, "malformed"
        yield PLANAR, ("robot", "motion"), value, "malformed"
    for place, step in product((0, 4, 8, 16), (1, -1)):
        yield PLANAR, (*CONSTRAINT, "forms", 0, place), partial(_plus, step), "rejected"
    for value in (None, [], [[]], "x"):
        yield PLANAR, (*CONSTRAINT, "forms"), value, "rejected" if value == [] else "malformed"
    for digits, status in ((4000, "rejected"), (4001, "too-large")):
        yield PLANAR, (*CONSTRAINT, "forms", 0, 0), "9" * digits, status
        yield PLANAR, (*CONSTRAINT, "forms", 0, 0), "1/" + "9" * digits, status
    for value in (["0", "0", "0"], ["0", "0"], "0"):
        yield PLANAR, (*CONSTRAINT, "normal"), value, "malformed"


def _repeated(number: int, values: list[Any]) -> list[Any]:
    """The last one again and again."""
    return [*values, *[values[-1]] * (number - len(values))]


def _plus(step: int, value: str) -> str:
    """Another number."""
    return str(Fraction(value) + step)


INFINITY: dict[str, Any] = {
    "chart": [1] * 16,
    "separating_form": [0] * 16,
    "eliminant": ["0x0", "0x1"],
    "coordinates": [["0x1"]] * 16,
    "multiplicity": 1,
}


def _points_at_infinity() -> Iterator[Entry]:
    yield PLANAR, ("infinity",), INFINITY, "rejected"
    for key in ("chart", "separating_form", "coordinates"):
        for number in (15, 17):
            yield PLANAR, ("infinity",), {**INFINITY, key: INFINITY[key][:1] * number}, "malformed"
    for eliminant in ([], ["0x1"], "0x1", None):
        yield PLANAR, ("infinity",), {**INFINITY, "eliminant": eliminant}, "malformed"
    yield PLANAR, ("infinity",), {**INFINITY, "eliminant": ["0x0", "0x0", "0x1"]}, "rejected"
    for multiplicity in (-1, "1", None):
        yield PLANAR, ("infinity",), {**INFINITY, "multiplicity": multiplicity}, "malformed"
    for value in ([], 5, {}, "x"):
        yield PLANAR, ("infinity",), value, "malformed"


def _motions() -> Iterator[Entry]:
    for value in (0, 1, "true", None, []):
        yield MOVING, ("self_motion", "real"), value, "malformed"
    for value in ("luck", "", None, 5):
        yield MOVING, ("self_motion", "cause"), value, "malformed"
    for key, value in product(("forms", "slices"), (None, 5, {}, [5], [[]], [{}])):
        yield MOVING, ("self_motion", key), value, "malformed"
    for value in ([], 5, {}, "x"):
        yield MOVING, ("self_motion",), value, "malformed"


def _boxes() -> Iterator[Entry]:
    # Too many, whatever they are: nothing of them is read. Two poses are isolated at most.
    for real, others, status in (
        ([None] * 2, [], "malformed"),
        ([None] * 3, [], "rejected"),
        ([None], [None], "rejected"),
        ([], [None], "malformed"),
        ([], [None] * 2, "rejected"),
        ("x" * 3, [], "malformed"),
        ([], "x" * 3, "malformed"),
        ("x" * 3, [None] * 3, "malformed"),
        ([None] * 3, "x", "malformed"),
        (5, [], "malformed"),
        ([], None, "malformed"),
    ):
        boxes = {"chart": [1, 0, 0, 0], "real": real, "complex": others}
        yield BOXED, ("krawczyk",), boxes, status
    for place, value in product((0, 7), ("0x1", None, ["0x1", "0x0"])):
        yield (
            BOXED,
            ("krawczyk", "complex", 0, "centre", place),
            value,
            "rejected" if value == ["0x1", "0x0"] else "malformed",
        )
