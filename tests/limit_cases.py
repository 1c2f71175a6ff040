"""Certificates at each limit of the format and one step beyond it, consistent in all else.

What is written in a certificate has bounds (``docs/certificates.md``, "Spelling" and "Limits"). Those at a bound are
read, and then accepted, or rejected for what they claim; those beyond it are malformed or too large.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from functools import partial
from hashlib import sha256
from itertools import product
from typing import Any

from certificate_subjects import Content, subject
from certificate_tools import Path_, at, with_entry
from mechanism_limits import mechanism_limits
from wrong_sorts import wrong_sorts

from pkm_exact.certify.build import canonical_bytes, sealed

Case = tuple[str, Callable[[], bytes], str]
"""What is tried, the certificate, and the verdict."""

DOUBLE = "planar, multiple solutions"
SPATIAL = "not proven complete"
BOXED = "planar, boxes"
TOLERANT = "tolerance, planar, complete"
NOTHING = "nothing known"
WITNESSES = "moving, joints in a point"
NONE = "inconsistent, joints in a point"


def cases() -> Iterator[Case]:
    """All of them."""
    for name, path, value, status in _entries():
        change = value if isinstance(value, partial) else partial(_given, value)
        yield f"{'.'.join(map(str, path))} of {name}: {_short(value)}", partial(_changed, name, path, change), status
    for more, status in ((0, "accepted"), (1, "too-large")):
        yield f"{more} entries more than 2^20", partial(_with_entries, more), status
    for depth, status in ((16, "rejected"), (17, "malformed")):
        yield f"{depth} levels, and no digest that fits", partial(_nested, depth), status
        yield f"{depth} objects, and no digest that fits", partial(_nested_objects, depth), status
    for digit in "0f":
        yield f"a digest of {digit}", partial(_with_digest, digit), "rejected"
    for text in ('a "name"', "a \\ and no more", "\x7f", "\u00e9"):
        yield f"a note {text!a}", partial(_with_note, text), "accepted"
    yield "a character that has to be escaped and is not, and the digest of that", _with_raw_delete, "rejected"
    for tail in (b"", b"\n\n"):
        yield f"{tail!r} at the end", partial(_with_tail, tail), "malformed"


def _renamed(key: str, other: str, content: Content) -> Content:
    """Another key."""
    return {other if old == key else old: value for old, value in content.items()}


def _reversed(content: Content) -> Content:
    """Keys from the last to the first."""
    return dict(reversed(content.items()))


def _given(value: Any, _: Any) -> Any:
    return value


def _short(value: Any) -> str:
    written = f"{value.func.__doc__} {value.args}" if isinstance(value, partial) else str(value)
    return written if len(written) <= 60 else f"{written[:40]}.. of {len(written)} characters"


def _changed(name: str, path: Path_, change: Callable[[Any], Any]) -> bytes:
    content = {key: value for key, value in subject(name).items() if key != "digest"}
    return canonical_bytes(sealed(with_entry(content, path, change(at(content, path)))))


def _with_entries(more: int) -> bytes:
    """A certificate of 2^20 commas and brackets, most of them in notes, and some more."""
    content = {**subject(NOTHING), "notes": ["," * 10_000] * 105}
    data = canonical_bytes(sealed(content))
    number = sum(map(data.count, (b",", b"[", b"{")))
    last = "," * (10_000 - number + (1 << 20) + more)
    return canonical_bytes(sealed({**content, "notes": [*content["notes"][1:], last]}))


def _nested(depth: int) -> bytes:
    """An object whose values are so many levels deep, with itself."""
    value: list[Any] = []
    for _ in range(depth - 2):
        value = [value]
    return json.dumps({"digest": "none", "a": value}).encode()


def _nested_objects(depth: int) -> bytes:
    value: dict[str, Any] = {}
    for _ in range(depth - 2):
        value = {"a": value}
    return json.dumps({"digest": "none", "a": value}).encode()


def _with_digest(digit: str) -> bytes:
    return canonical_bytes({**subject(NOTHING), "digest": "sha256:" + digit * 64})


def _with_note(text: str) -> bytes:
    return canonical_bytes(sealed(subject(NOTHING) | {"notes": [text]}))


def _with_raw_delete() -> bytes:
    content = {key: value for key, value in subject(NOTHING).items() if key != "digest"}
    body = canonical_bytes(content | {"notes": ["\x7f"]}).replace(b"\\u007f", b"\x7f")
    return body.removesuffix(b"\n}\n") + f',\n "digest": "sha256:{sha256(body).hexdigest()}"\n}}\n'.encode()


def _with_tail(tail: bytes) -> bytes:
    return canonical_bytes(sealed(subject(NOTHING))).rstrip() + tail


def _entries() -> Iterator[tuple[str, Path_, Any, str]]:
    yield from _texts()
    yield from wrong_sorts()
    yield from _numbers()
    yield from _intervals()
    yield from _polynomials()
    yield from _eliminations()
    yield from _boxes()
    yield from _robots()
    yield from _grids()
    yield from _widths()
    yield from _tolerances()
    yield from mechanism_limits()


def _texts() -> Iterator[tuple[str, Path_, Any, str]]:
    yield WITNESSES, ("robot", "name"), "\u00e9\ud800", "accepted"
    for name in (NOTHING, TOLERANT):
        for path, key in (((), "robot"), (("robot",), "kind"), (("configuration",), "name")):
            for other in (f"A{key}", f"z{key}"):
                yield name, path, partial(_renamed, key, other), "malformed"
            if path or name == NOTHING:
                yield name, path, partial(_reversed), "malformed"
    for path in (("robot", "name"), ("robot", "unit"), ("robot", "source"), ("configuration", "name"), ("notes", 0)):
        yield WITNESSES, path, "x" * 10_000, "accepted"
        yield WITNESSES, path, "x" * 10_001, "too-large"
    for code in ("SE3", "AFD1", "AFD6", "AFP1", "AFP4", "AFD4:a", "AFP3:az09azaz90"):
        yield NOTHING, ("formulation",), code, "accepted"
    wrong = (
        "SE2",
        "AFD0",
        "AFD7",
        "AFP0",
        "AFP5",
        "AFD",
        "AFP3:",
        "AFP3:az09azaz909",
        "SE3:A",
        "SE3:-",
        "SE3:{",
        "SE3:/",
    )
    for code in wrong:
        yield NOTHING, ("formulation",), code, "malformed"
    for value, status in ((0, "malformed"), (3, "malformed"), (True, "malformed"), (1, "accepted")):
        yield NOTHING, ("version",), value, status
        yield TOLERANT, ("version",), value, status


def _numbers() -> Iterator[tuple[str, Path_, Any, str]]:
    for value, status in ((10**12 - 1, "rejected"), (10**12, "malformed"), (-1, "malformed"), (-(10**12), "malformed")):
        yield DOUBLE, ("complex_solutions",), value, status
    yield DOUBLE, ("representation", "chart", 0), -(10**11 - 1), "rejected"
    for exponent, status in ((8192, "rejected"), (8193, "too-large")):
        yield NOTHING, ("box_exponent",), exponent, status
    nines, ones = "9" * 600, "1" * 600
    joint: Path_ = ("robot", "base", 0, 0)
    for text in (nines, f"1/{nines}", f"2{ones[1:]}/{nines[:-1]}8", "-" + nines[:-1]):
        yield DOUBLE, joint, text, "rejected"
    for text in (nines + "9", f"1/{nines}9", f"1{nines}/7"):
        yield DOUBLE, joint, text, "too-large"
    end: Path_ = ("poses", 0, "position", 0, 0)
    for digits, status in ((10_000, "rejected"), (10_001, "too-large")):
        yield DOUBLE, end, "1" * digits, status
        yield DOUBLE, ("poses", 0, "parameter", 1), "2/" + "1" * (digits - 2), status
    for text in ("0/1", "2/4", "12/4", "-2/2", "1/1"):
        yield DOUBLE, end, text, "rejected"
        yield DOUBLE, joint, text, "malformed"
    for text in ("-0", "01", "1/0", "1/02", "1/-2", "+1", "1/", "/1", "", "1/2/3", "--1"):
        yield DOUBLE, end, text, "malformed"
        yield DOUBLE, joint, text, "malformed"
    coefficient: Path_ = ("representation", "quaternion", 0, 1)
    for digits, status in ((1 << 16, "rejected"), ((1 << 16) + 1, "too-large")):
        yield DOUBLE, coefficient, "0x" + "9" * (digits - 2), status
    wrong = (
        "-0x0",
        "0x",
        "-0x",
        "0x00",
        "0x0a",
        "-0x01",
        "0xg",
        "x1",
        "-1",
        "1",
        "0x1 ",
        " 0x1",
        "",
        "0x-1",
        "--0x1",
        "1x1",
    )
    stranger = ("+0x1", "0x1_1", "0xA", "0X1", "0x1\n", "0x1\u0663", "\u06630x1", "0x\ud800", "0x1\u00e9", "0x1\x7f")
    for text in (*wrong, *stranger):
        yield DOUBLE, coefficient, text, "malformed"


def _intervals() -> Iterator[tuple[str, Path_, Any, str]]:
    interval: Path_ = ("poses", 0, "position", 0)
    long, longer = "1" * 10_000, "1" * 10_001
    for ends in (["01", "1/0"], ["1/0", "2"], ["1", "\ud800"], [long, "x"], [None, None], ["1"], ["1"] * 3, {"1": "2"}):
        yield DOUBLE, interval, ends, "malformed"
    yield DOUBLE, interval, [longer, longer], "too-large"
    yield DOUBLE, interval, ["x", longer], "malformed"


def _polynomials() -> Iterator[tuple[str, Path_, Any, str]]:
    for length, status in ((2001, "rejected"), (2002, "too-large")):
        for key in (("eliminant",), ("quaternion", 3), ("translation", 0)):
            yield DOUBLE, ("representation", *key), ["0x1"] * length, status
    for key, value in product((("eliminant",), ("quaternion", 0)), (None, 5, "0x1" * 2001, {})):
        yield DOUBLE, ("representation", *key), value, "malformed"
    for polynomial in ([], ["0x1"], ["0x1", "0x0"]):
        yield DOUBLE, ("representation", "eliminant"), polynomial, "malformed"
    for polynomial in (["0x0"], ["0x1", "0x0"]):
        yield DOUBLE, ("representation", "translation", 0), polynomial, "malformed"


def _eliminations() -> Iterator[tuple[str, Path_, Any, str]]:
    for length, status in ((5000, "rejected"), (5001, "too-large")):
        yield DOUBLE, ("elimination",), partial(_with_step, ["999999"] * length), status
    for row in ("0 0 0 0 0 0 0 0 0", "0 1 2 3 4 5", "1", "9"):
        yield DOUBLE, ("elimination",), partial(_with_step, [row]), "accepted"
    for row in ("999999", "100000 0", "190909", "0 6", "0 9", "0 10", "0 15", "0 0 6", "0 0 0 0 0 0 0 0 15"):
        yield DOUBLE, ("elimination",), partial(_with_step, [row]), "rejected"
    for row in (
        "1000000",
        "0 16",
        "0 20",
        "0 0 0 0 0 0 0 0 0 0",
        "00",
        "01",
        "0 00",
        "0 1 0",
        "0 5 4 5",
        "0 ",
        " 0",
        "",
    ):
        yield DOUBLE, ("elimination",), partial(_with_step, [row]), "malformed"
    for place, row in ((0, "0 1 0"), (-1, "0 1 0"), (0, 0), (-1, None)):
        yield DOUBLE, ("elimination", 0, place), row, "malformed"
    for value in ([], [[]], [["0"], None], ["0"], "0", {}, [5], ["0" * 5001]):
        yield DOUBLE, ("elimination",), value, "rejected" if value in ([], [[]]) else "malformed"


def _with_step(step: list[str], steps: Any) -> Any:
    """One more step."""
    return [*steps, step]


def _boxes() -> Iterator[tuple[str, Path_, Any, str]]:
    for kind in ("real", "complex"):
        exponents: Path_ = ("krawczyk", kind, 0, "exponents")
        for value, status in (
            ([2048, 2048], "rejected"),
            ([2049, 0], "too-large"),
            ([0, 2049], "too-large"),
            ([-1, 28], "malformed"),
            ([28, -1], "malformed"),
            ([28], "malformed"),
        ):
            yield BOXED, exponents, value, status
        part: Path_ = () if kind == "real" else (1,)
        for place in (0, 6):
            number: Path_ = ("krawczyk", kind, 0, "centre", place, *part)
            for bits, status in ((4096, "rejected"), (4097, "too-large")):
                for sign in (1, -1):
                    yield BOXED, number, hex(sign * ((1 << bits) - 1)), status
    # Too many, whatever they are: nothing of them is read.
    for real, others, status in (
        ([None] * 40, [], "malformed"),
        ([None] * 41, [], "rejected"),
        ([None], [None] * 20, "rejected"),
        ([], [None] * 20, "malformed"),
        ([], [None] * 21, "rejected"),
        ("x" * 41, [], "malformed"),
        ([], "x" * 41, "malformed"),
        ([None] * 41, "x", "malformed"),
        ("x", [None] * 41, "malformed"),
    ):
        boxes = {"chart": [3, 0, 0, 1], "real": real, "complex": others}
        yield BOXED, ("krawczyk",), boxes, status
    for place in (1, 2):
        yield BOXED, ("krawczyk", "chart", place), 1, "rejected"
        yield BOXED, ("krawczyk", "real", 0, "centre", place), "0x1", "rejected"
        yield BOXED, ("krawczyk", "real", -1, "centre", place + 2), "0x1", "rejected"
    for place in (4, 7):
        yield BOXED, ("krawczyk", "complex", 0, "centre", place, 0), "0x1", "rejected"
        yield BOXED, ("krawczyk", "complex", -1, "centre", place, 1), "0x1", "rejected"


def _robots() -> Iterator[tuple[str, Path_, Any, str]]:
    for value in ("2", "1/2", "0", "-1"):
        yield NOTHING, ("robot", "metric", 2), value, "malformed"
    for value, status in (("2", "accepted"), ("1/2", "malformed"), ("3/2", "malformed"), ("0", "malformed")):
        yield NOTHING, ("robot", "metric", 0), value, status
        yield NOTHING, ("robot", "metric", 1), value, status
    for side in ("base", "platform"):
        for place in (0, 2):
            yield NOTHING, ("robot", side, place, 2), "1", "malformed"
            yield SPATIAL, ("robot", side, place, 2), "1/3", "rejected"
    yield SPATIAL, ("robot", "metric", 2), "2", "rejected"
    for value, status in (("2", "accepted"), ("1/2", "malformed"), ("3/2", "malformed"), ("0", "malformed")):
        yield NONE, ("robot", "metric", 2), value, status
    for value, status in (("0", "malformed"), ("-1", "malformed"), ("1/7", "accepted")):
        for place in (0, -1):
            yield NOTHING, ("configuration", "lengths_squared", place), value, status
    for path in (("configuration", "name"), ("robot", "name"), ("robot", "unit"), ("robot", "source")):
        yield NOTHING, path, 5, "malformed"


def _grids() -> Iterator[tuple[str, Path_, Any, str]]:
    for exponent, status in ((4096, "rejected"), (4097, "too-large")):
        yield TOLERANT, ("exponent",), exponent, status
    for place, part, sign in product((0, 3), (0, 1), (1, -1)):
        yield TOLERANT, ("boxes", 0, "chart", place, part), sign * 10**6, "rejected"
        yield TOLERANT, ("boxes", 0, "chart", place, part), sign * (10**6 + 1), "too-large"
    for kind, place, part, sign in product(("boxes", "pairs"), (0, -1), (0, 1), (1, -1)):
        for bits, status in ((114 + 256, "rejected"), (114 + 257, "too-large")):
            yield TOLERANT, (kind, place, "centre", 3, part), hex(sign * ((1 << bits) - 1)), status
    for kind, box, place, part in product(("boxes", "pairs"), (0, -1), (1, 2), (0, 1)):
        yield TOLERANT, (kind, box, "chart", place, part), 1, "malformed"


def _widths() -> Iterator[tuple[str, Path_, Any, str]]:
    for kind, key in (("boxes", "outer"), ("pairs", "outer"), ("boxes", "inner")):
        for bits, status in ((8192, "rejected"), (8193, "too-large")):
            yield TOLERANT, (kind, 0, key, 1), hex((1 << bits) - 1), status
        for width, status in (("0x0", "malformed"), ("-0x1", "malformed"), ("0x1", "rejected")):
            yield TOLERANT, (kind, 0, key, 1), width, status
    for path in (("position", 0), ("rotation", 1, 1), ("quaternion", 3), ("centroid", 1)):
        yield TOLERANT, ("boxes", 0, *path), ["1", "0"], "malformed"
        yield TOLERANT, ("boxes", 0, *path), ["1", "1"], "rejected"


def _tolerances() -> Iterator[tuple[str, Path_, Any, str]]:
    for key in ("base", "platform", "lengths"):
        yield TOLERANT, ("tolerances", key), "-1/1000000000", "malformed"
        yield TOLERANT, ("tolerances", key), "0", "accepted"
    for key in ("base", "platform"):
        yield TOLERANT, ("frames", key, 2), "1", "malformed"
    for value in ("0", "-4"):
        yield TOLERANT, ("frames", "unit"), value, "malformed"
    for value in (0, 1, None, "true"):
        yield TOLERANT, ("complete",), value, "malformed"
    for key in ("boxes", "pairs"):
        yield TOLERANT, (key,), partial(_repeated, 7), "malformed"
        yield TOLERANT, (key,), partial(_repeated, 6), "rejected"
    yield TOLERANT, ("unproved",), [*range(3, 10)], "malformed"
    yield TOLERANT, ("unproved",), [*range(3, 9)], "rejected"


def _repeated(number: int, values: list[Content]) -> list[Content]:
    """The first one, again and again."""
    return [values[0]] * number
