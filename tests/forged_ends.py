"""Certificates in which the first or the last of several things is wrong, so that leaving out either shows."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import partial
from typing import Any

from certificate_subjects import Content, subject
from certificate_tools import Path_, at, with_entry

PLANAR, DOUBLE, BOXED = "planar, representation", "planar, multiple solutions", "planar, boxes"
SPATIAL, TOLERANT, OPEN = "not proven complete", "tolerance, planar, complete", "tolerance-open, planar"


def first_and_last() -> Iterator[tuple[str, Callable[[], Content], str]]:
    """What is wrong, the certificate, and how the reason begins."""
    for name, path, change, reason in (*_poses(), *_numerators(), *_solutions(), *_tolerances(), *_robots()):
        yield f"{name}: {'.'.join(map(str, path))}, {_said(change)}", partial(_changed, name, path, change), reason


def _said(change: Any) -> str:
    return str(change.args[0]) if isinstance(change, partial) else change.__doc__.strip(".")


def _changed(name: str, path: Path_, change: Callable[[Any], Any]) -> Content:
    content = {key: value for key, value in subject(name).items() if key != "digest"}
    return with_entry(content, path, change(at(content, path)))


Change = tuple[str, Path_, Callable[[Any], Any], str]
ENDS = (0, -1)


def _more(text: str) -> str:
    """A greater rational number."""
    return str(Fraction(text) + Fraction(1, 1 << 40))


def _next(text: str) -> str:
    """The next integer."""
    return hex(int(text, 16) + 1)


def _poses() -> Iterator[Change]:
    for name in (PLANAR, BOXED, DOUBLE, SPATIAL):
        for pose in ENDS:
            for end in (0, 1):
                for path in (
                    ("position", 0),
                    ("rotation", 0, 0),
                    ("rotation", 2, 2),
                    ("quaternion", 0),
                    ("quaternion", 3),
                ):
                    yield name, ("poses", pose, *path, end), _more, "boxes: the box of pose"
                if name != BOXED:
                    yield name, ("poses", pose, "parameter", end), _more, "real poses: pose"
            for wrong in (0, 9, None):
                yield name, ("poses", pose, "multiplicity"), partial(_given, wrong), "multiplicity"
            yield BOXED, ("poses", pose, "parameter"), partial(_given, ["0", "0"]), "real poses: a parameter"


def _given(value: Any, _: Any) -> Any:
    """Something else."""
    return value


def _numerators() -> Iterator[Change]:
    for name in (PLANAR, SPATIAL):
        part: Path_ = ("representation",)
        yield name, (*part, "chart", 0), _plus, "chart"
        yield name, (*part, "separating_form", 0), _plus, "separating form"
        for place in ENDS:
            yield name, (*part, "eliminant", place), _next, ""
    for place in range(8):
        key: Path_ = ("quaternion", place) if place < 4 else ("translation", place - 4)
        yield SPATIAL, (*part, *key, 0), _next, ""
        yield SPATIAL, (*part, *key), _longer, "representation"
    for key in (("quaternion", 1), ("quaternion", 2), ("translation", 0), ("translation", 3)):
        yield PLANAR, (*part, *key), partial(_given, ["0x1"]), ""


def _plus(number: int) -> int:
    """One more."""
    return number + 1


def _longer(polynomial: list[str]) -> list[str]:
    """Of the degree of the eliminant."""
    return [*polynomial, *["0x0"] * (16 - len(polynomial)), "0x1"]


def _solutions() -> Iterator[Change]:
    for box in ENDS:
        for place in (0, 3, 5, 6):
            yield BOXED, ("krawczyk", "real", box, "centre", place), _next, "boxes: the centre of real box"
            for part in (0, 1):
                yield BOXED, ("krawczyk", "complex", box, "centre", place, part), _next, "boxes: the centre of complex"
        for kind in ("real", "complex"):
            yield BOXED, ("krawczyk", kind, box, "exponents"), partial(_given, [3, 3]), f"boxes: not proved that {kind}"
    for place in (0, 3):
        yield BOXED, ("krawczyk", "chart", place), _plus, "boxes"


def _tolerances() -> Iterator[Change]:
    for box in ENDS:
        for path in (("position", 0), ("rotation", 0, 0), ("rotation", 1, 1), ("quaternion", 3), ("centroid", 1)):
            for change in (_upper_third, _lower_third):
                yield TOLERANT, ("boxes", box, *path), change, "box of pose"
        for key in ("position_error", "rotation_error"):
            yield OPEN, ("boxes", box, key), _less, "box of pose"
        for kind in ("boxes", "pairs"):
            for place in ENDS:
                for part in (0, 1):
                    yield TOLERANT, (kind, box, "centre", place, part), _next, ""
                yield TOLERANT, (kind, box, "outer", place), partial(_given, "0x1"), ""
                yield TOLERANT, (kind, box, "outer", place), _huge, ""
        for place in ENDS:
            yield TOLERANT, ("boxes", box, "inner", place), _huge, "box of pose"
            yield TOLERANT, ("boxes", box, "inner", place or 1), partial(_given, "0x1"), "box of pose"
        yield OPEN, ("boxes", box, "pose"), _plus, "boxes"


def _upper_third(ends: list[str]) -> list[str]:
    """The lower bound is above the value."""
    low, high = map(Fraction, ends)
    return [str((low + 2 * high) / 3), str(high)]


def _lower_third(ends: list[str]) -> list[str]:
    """The upper bound is below the value."""
    low, high = map(Fraction, ends)
    return [str(low), str((2 * low + high) / 3)]


def _less(text: str) -> str:
    """Less than is proved."""
    return str(Fraction(text) * Fraction(9, 10))


def _huge(_: str) -> str:
    """A half width of 2^46, in units of the robot's size."""
    return hex(1 << 160)


def _robots() -> Iterator[Change]:
    for name in (PLANAR, BOXED, SPATIAL, TOLERANT):
        for leg in ENDS:
            for side in ("base", "platform"):
                for axis in (0, 1):
                    yield name, ("robot", side, leg, axis), _more, ""
            yield name, ("configuration", "lengths_squared", leg), _more, ""
