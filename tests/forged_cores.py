"""Tolerance certificates at the margin of what is proved, and of robots without tolerances around rational poses.

In ``cases/tight-tolerance-*.json`` every bound is, but for some 2^-18 of its width, the narrowest that both checkers
prove, and the outer box the widest; in ``cases/exact-tolerance-*.json`` bounds are exactly those that the plain checker
proves. They were found by bisection, one entry after another.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import cache, partial
from math import ceil, floor
from pathlib import Path
from typing import Any

from certificate_subjects import Content, subject
from certificate_tools import Path_, at, with_entry
from forged_margins import BASES, PLATFORMS, leg_through
from held_mechanisms import Pose

from pkm_exact.certify import pure

Case = tuple[Callable[[], Content], str]
REJECTED, ACCEPTED = "rejected", "accepted"
CASES = Path(__file__).parent / "cases"


@cache
def limit(name: str) -> Content:
    """One of the files of ``cases``."""
    content: Content = json.loads((CASES / f"{name}.json").read_text(encoding="utf-8"))
    return content


# At the margin

BOUNDS: dict[str, tuple[Path_, ...]] = {
    "planar": (
        *(("position", k) for k in (0, 1)),
        *(("rotation", *ij) for ij in ((0, 0), (0, 1), (1, 0), (1, 1), (2, 2))),
        *(("quaternion", k) for k in (0, 3)),
        *(("centroid", k) for k in (0, 1)),
    ),
    "spatial": (("position", 0), ("rotation", 2, 2), ("quaternion", 1), ("centroid", 1), ("centroid", 2)),
}


OUTER = {"planar": (Fraction(135, 64), Fraction(17, 8)), "spatial": (Fraction(9, 4), Fraction(145, 64))}
"""Factors of the outer box: with one it is proved to hold one solution, by a narrower box, with the other no more."""


def _inside(name: str, path: Path_, end: int) -> Content:
    """A bound half a unit of the plain checker's last place narrower than what it proves."""
    content = limit(f"exact-tolerance-{name}")
    k = content["exponent"]
    half = Fraction(1, 2 << (k + k // 2 + pure.GUARD))
    value = Fraction(at(content, path))
    return with_entry(content, path, str(value + half if end == 0 else value - half))


def _scaled(name: str, key: str, place: int | None, factor: Fraction) -> Content:
    content = limit(f"tight-tolerance-{name}")
    path: Path_ = ("boxes", 0, key)
    widths = [int(text, 16) for text in at(content, path)]
    changed = [floor(w * factor) if place in (None, n) else w for n, w in enumerate(widths)]
    return with_entry(content, path, [hex(w) for w in changed])


def _margins() -> Iterator[tuple[str, Case]]:
    for name, bounds in BOUNDS.items():
        yield f"{name}, as narrow as both prove", (partial(limit, f"tight-tolerance-{name}"), ACCEPTED)
        for bound in bounds:
            for end in (0, 1):
                path = ("boxes", 0, *bound, end)
                yield f"{name}, {bound} narrower at end {end}", (partial(_inside, name, path, end), REJECTED)
        for key in ("position_error", "rotation_error"):
            yield f"{name}, {key} smaller", (partial(_inside, name, ("boxes", 0, key), 1), REJECTED)
        for factor, answer in zip(OUTER[name], (ACCEPTED, REJECTED), strict=True):
            yield f"{name}, outer {factor} times as wide", (partial(_scaled, name, "outer", None, factor), answer)
        for place in range(4 if name == "planar" else 8):
            smaller = partial(_scaled, name, "inner", place, 1 - Fraction(1, 1 << 16))
            yield f"{name}, inner {place} narrower", (smaller, REJECTED)


# Without tolerances, around rational poses

Weights = Sequence[int]
TRIANGLE = tuple(zip(PLATFORMS, BASES, strict=True))
SIX = (
    ((1, 2, 0), (0, 7, 1)),
    ((-3, 1, 1), (5, -4, 2)),
    ((2, -5, 3), (-4, 3, 0)),
    ((4, 1, -2), (3, 3, 5)),
    ((0, 3, 5), (-6, -2, 1)),
    ((-2, -4, 1), (1, -8, -3)),
)


def _robot(poses: Sequence[Pose], axis: int) -> Content:
    """With legs that have the same lengths at two poses, or any if there is one pose."""
    joints = TRIANGLE if len(poses[0].e) and axis == 0 else SIX
    legs = [leg_through(poses, b, a, axis) if len(poses) > 1 else poses[0].distance(a, b) for b, a in joints]
    old = subject("planar, multiple solutions" if len(legs) == 3 else "not proven complete")
    robot = {**old["robot"], "metric": ["1", "1", "1"]}
    robot["base"] = [[str(x) for x in leg.base] for leg in legs]
    robot["platform"] = [[str(x) for x in leg.platform] for leg in legs]
    return {
        "format": pure.TOLERANCE_FORMAT,
        "version": 1,
        "robot": robot,
        "configuration": {"name": None, "lengths_squared": [str(leg.length_squared) for leg in legs]},
        "tolerances": dict.fromkeys(("base", "platform", "lengths"), "0"),
        "frames": {"base": ["0"] * 3, "platform": ["0"] * 3, "unit": "1"},
    }


def around(
    poses: Sequence[Pose], chart: Weights, k: int, axis: int = 0, to_grid: Callable[[Fraction], int] = round
) -> Content:
    """Boxes around poses on the grid 2^-k, as wide as the core, with bounds that are a little wider than need be."""
    places = (0, 3, 5, 6) if axis == 0 else tuple(range(8))
    core = 1 << (k - k // 2)
    content = _robot(poses, axis) | {"exponent": k, "boxes": [], "unproved": [], "pairs": [], "complete": False}
    boxes = []
    for number, pose in enumerate(poses, 1):
        scale = sum((w * Fraction(x) for w, x in zip(chart, pose.e, strict=True)), Fraction(0))
        x = [Fraction(v) / scale for v in (*pose.e, *pose.f)]
        box = {
            "pose": number,
            "chart": [[w, 0] for w in chart],
            "centre": [[hex(to_grid(x[place] * (1 << k))), "0x0"] for place in places],
            "outer": [hex(core)] * len(places),
            "inner": [hex(8)] * len(places),
        }
        boxes.append(box | _bounds(content, box, k))
    return content | {"boxes": boxes}


def _bounds(content: Content, box: Content, k: int) -> Content:
    """Those of a pose, and the errors."""
    slack = Fraction(1 << 12, 1 << k)
    none = {"position": [["0", "0"]] * 3, "rotation": [[["0", "0"]] * 3] * 3, "quaternion": [["0", "0"]] * 4}
    errors = {"position_error": str(slack), "rotation_error": str(slack)}
    blank = box | none | {"centroid": [["0", "0"]] * 3} | errors
    read = pure.read_tolerances(content | {"boxes": [blank]})
    bits = max(abs(part).bit_length() for pair in read.boxes[0].place.centre for part in pair)
    family = pure.Family(read, k + k // 2 + pure.GUARD + 2 * max(bits - k, 0))
    centre = [family.rectangle(pair, k).re for pair in read.boxes[0].place.centre]
    ends = [
        [str(Fraction(v.low, 1 << family.p) - slack), str(Fraction(v.high, 1 << family.p) + slack)]
        for v in pure.components(family, centre)[0]
    ]
    rows = [ends[3:6], ends[6:9], ends[9:12]]
    return {"position": ends[:3], "rotation": rows, "quaternion": ends[12:16], "centroid": ends[16:]} | errors


K = 64
PAIR = (Pose((2, 0, 0, 1), (0, 1, 6, 0)), Pose((2, 0, 0, 1), (0, 1, 14, 0)))
FIRST = (1, 0, 0, 0)


def _off(coordinate: str, parts: Fraction, sign: int) -> Content:
    """A centre beside the nearest grid point: the solution is 1/2 + ``parts`` 2^-20 units away from it."""
    distance = sign * (Fraction(1, 2) + parts / (1 << 20)) / (1 << K)
    to_grid = floor if sign > 0 else ceil
    if coordinate == "e0":
        return around([Pose(((1 + distance) * 2, 0, 0, 2), (0, 4, 6, 0))], (0, 0, 0, 1), K, 0, to_grid)
    return around([Pose((2, 0, 0, 1), (0, 1, 2 * (3 + distance), 0))], FIRST, K, 0, to_grid)


def _alike(*order: int) -> Content:
    """Two poses of one orientation, of which the second is farther along both axes, in this order."""
    poses = (Pose((1, 0, 0, 0), (0, 1, 2, 0)), Pose((1, 0, 0, 0), (0, 3, 5, 0)))
    content = around(poses, FIRST, K)
    boxes = [{**content["boxes"][place], "pose": number} for number, place in enumerate(order, 1)]
    return content | {"boxes": boxes}


def _widths(key: str, place: int | None, width: int) -> Content:
    content = around(PAIR[:1], FIRST, K)
    widths = [hex(width if place in (None, n) else CORE) for n in range(4)]
    return with_entry(content, ("boxes", 0, key), widths)


CORE = 1 << (K - K // 2)


def _numbered(labels: Sequence[int], unproved: Sequence[int]) -> Content:
    content = _alike(*range(len(labels)))
    boxes = [{**box, "pose": label} for box, label in zip(content["boxes"], labels, strict=True)]
    return content | {"boxes": boxes, "unproved": list(unproved)}


def _far(bits: int) -> Content:
    """The longest coordinate of the centre has so many bits before the point."""
    content = around([Pose((1, 0, 0, 0), (0, 1 << min(bits, pure.MAX_CENTRE_BITS) - 1, 3, 0))], FIRST, 12 * K)
    if bits <= pure.MAX_CENTRE_BITS:
        return content
    return with_entry(content, ("boxes", 0, "centre", 2, 0), hex(1 << 12 * K + bits - 1))


def _imaginary(path: Path_, value: Any) -> Content:
    return with_entry(around(PAIR[:1], FIRST, K), ("boxes", 0, *path), value)


def _beyond(place: int) -> Content:
    """Bounds of the pose that reach beyond the outer box in one coordinate alone, where it is narrower."""
    content = around(PAIR[:1], FIRST, K)
    content = with_entry(content, ("boxes", 0, "outer"), [hex(CORE if n == place else 1 << 44) for n in range(4)])
    path: Path_ = ("boxes", 0, "quaternion", 0) if place == 0 else ("boxes", 0, "centroid", 1)
    low, high = map(Fraction, at(content, path))
    more = Fraction(1 << 36, 1 << K)
    return with_entry(content, path, [str(low - more), str(high + more)])


def _error(parts: Fraction) -> Content:
    """The centre is about 0.6 units from the pose, and the position is proved to differ by twice that at most."""
    return with_entry(_off("f2", Fraction(3, 4), 1), ("boxes", 0, "position_error"), str(parts / (1 << K)))


def _real_pair(box: int, sign: int) -> Content:
    """A real pose counted as a pair of complex ones, the other left out; the chart makes it the last pair, or first."""
    content = {key: value for key, value in subject("tolerance, planar, complete").items() if key != "digest"}
    real = content["boxes"][box]
    core = 1 << (content["exponent"] - content["exponent"] // 2)
    pair = {
        "chart": [[sign * weight, 0] for weight, _ in real["chart"]],
        "centre": [[hex(sign * int(part, 16)), "0x0"] for part, _ in real["centre"]],
        "outer": [hex(max(int(width, 16), core)) for width in real["inner"]],
    }
    pairs = [*content["pairs"], pair] if sign > 0 else [pair, *content["pairs"]]
    return content | {"boxes": [], "pairs": pairs}


def _near(units: int) -> Content:
    """One of two poses that differ by so many times 2^-34: too near for the core to be mapped into itself."""
    y = 6 + Fraction(units, 1 << 34)
    content = around((PAIR[0], Pose((2, 0, 0, 1), (0, 1, y, 0))), FIRST, K)
    return content | {"boxes": content["boxes"][:1]}


def _wide(weight: int, part: Fraction) -> Content:
    """An outer box as wide in e0 as a part of e0."""
    content = around(PAIR[:1], (weight, 0, 0, 0), K)
    widths = [hex(int(part * (1 << K)) // weight), *[hex(CORE)] * 3]
    return with_entry(content, ("boxes", 0, "outer"), widths)


def _outer(pose: Pose, chart: Weights, *parts: Fraction | None) -> Content:
    """An outer box of these half widths, or that of the core."""
    content = around([pose], chart, K)
    widths = [hex(CORE if part is None else int(part * (1 << K))) for part in parts]
    return with_entry(content, ("boxes", 0, "outer"), widths)


def _half(end: int) -> Content:
    """Only one half of the last bound of a spatial pose."""
    content = limit("tight-tolerance-spatial")
    path: Path_ = ("boxes", 0, "centroid", 2)
    ends = list(map(Fraction, at(content, path)))
    ends[end] = sum(ends) / 2
    return with_entry(content, path, list(map(str, ends)))


CORES: dict[str, Case] = {
    **{f"half of the last bound of a spatial pose, end {end}": (partial(_half, end), REJECTED) for end in (0, 1)},
    "an outer box with singular Jacobians, by one entry of a vector": (
        partial(_outer, Pose((1, 0, 0, 0), (0, 1, 0, 0)), (2, 0, 0, 0), Fraction(11, 100), None, Fraction(1, 2), None),
        REJECTED,
    ),
    "an outer box with singular Jacobians, by the last entry": (
        partial(_outer, Pose((1, 0, 0, 2), (0, 1, 3, 0)), (0, 0, 0, 1), Fraction(65, 100), None, None, None),
        REJECTED,
    ),
    **{f"bounds that reach too far in coordinate {place}": (partial(_beyond, place), REJECTED) for place in (0, 3)},
    **{
        f"a position error of {parts} units": (partial(_error, parts), status)
        for parts, status in ((Fraction(5, 4), ACCEPTED), (Fraction(9, 10), REJECTED))
    },
    **{
        f"the {name} pair is real pose {box}": (partial(_real_pair, box, sign), REJECTED)
        for name, sign in (("last", 1), ("first", -1))
        for box in (0, 1)
    },
    **{f"another pose {units} 2^-34 away": (partial(_near, units), REJECTED) for units in (90, 120)},
    **{f"an outer box of 2/5 of e0 = 1/{w}": (partial(_wide, w, Fraction(2, 5)), ACCEPTED) for w in (1, 4)},
    **{
        f"{coordinate} is {sign} (1/2 + {parts} 2^-20) units from the centre": (
            partial(_off, coordinate, parts, sign),
            status,
        )
        for coordinate in ("e0", "f2")
        for sign in (1, -1)
        for parts, status in ((Fraction(3, 4), ACCEPTED), (Fraction(3, 2), REJECTED), (Fraction(1 << 18), REJECTED))
    },
    **{f"poses of one orientation, {order}": (partial(_alike, *order), ACCEPTED) for order in ((0, 1), (1, 0))},
    **{
        f"one pose twice beside another, {order}": (partial(_alike, *order), REJECTED)
        for order in ((0, 0, 1), (1, 0, 0), (0, 0))
    },
    **{
        f"an outer box of {name} in coordinate {place}": (partial(_widths, "outer", place, width), status)
        for place in (None, 0, 3)
        for name, width, status in (("the core", CORE, ACCEPTED), ("less", CORE - 1, REJECTED))
    },
    **{
        f"an inner box of {name} in coordinate {place}": (partial(_widths, "inner", place, width), status)
        for place in (None, 0, 3)
        for name, width, status in (("the core", CORE, ACCEPTED), ("more", CORE + 1, REJECTED))
    },
    **{
        f"poses numbered {labels}, {unproved} not proved": (partial(_numbered, labels, unproved), status)
        for labels, unproved, status in (
            ((1, 2), (3, 4), ACCEPTED),
            ((1, 2), (4, 3), REJECTED),
            ((2, 1), (), REJECTED),
            ((2, 1), (3, 4), REJECTED),
            ((0, 1), (), REJECTED),
            ((1, 2), (4,), REJECTED),
            ((1, 2), (2,), REJECTED),
            ((1,), (0,), REJECTED),
        )
    },
    "a pose far away": (partial(_far, 200), ACCEPTED),
    "a pose as far away as may be": (partial(_far, 256), ACCEPTED),
    "a pose farther away": (partial(_far, 257), "too-large"),
    "a weight that is not real": (partial(_imaginary, ("chart", 0, 1), 1), REJECTED),
    "a last coordinate that is not real": (partial(_imaginary, ("centre", 3, 1), "0x1"), REJECTED),
    **{
        f"spatial poses that differ in C3 alone, {places}": (
            lambda places=places: around(  # type: ignore[misc]
                [Pose((1, 0, 0, 0), (0, 2, 3, c)) for c in places], FIRST, K, 2
            ),
            ACCEPTED,
        )
        for places in ((-4, 4), (4, -4))
    },
    **dict(_margins()),
}

WIDE: dict[str, Callable[[], Content]] = {
    f"an outer box of 3/5 of e0 = 1/{w}": partial(_wide, w, Fraction(3, 5)) for w in (1, 4)
}
WIDE["an outer box where Jacobians are regular and N(e) may be 0"] = partial(
    _outer, Pose((4, 0, 0, 1), (0, 1, 3, 0)), (4, 0, 0, 0), Fraction(1375, 10000), None, None, None
)
"""In balls N(e) may be 0 there, in intervals not: the plain checker accepts what the other one does not prove."""
PLAIN: dict[str, Callable[[], Content]] = {
    f"{name}, as narrow as the plain checker proves": partial(limit, f"exact-tolerance-{name}") for name in BOUNDS
}
"""What the other checker cannot tell."""
